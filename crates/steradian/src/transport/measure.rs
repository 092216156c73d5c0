//! Measuring: the streams of all sensors as one integrand.

use std::f32::consts::FRAC_1_PI;
use std::f64::consts::PI;

use super::MeasureOptions;
use super::channels;
use super::columns::{Flight, Workspace};
use super::flux::{FluxMeter, Looks};
use super::meters::{Meter, Prepared};
use super::next_event::NextEvent;
use super::path::Tracer;
use super::scatter;
use super::scattering::{self, Encounter};
use super::tables::{Candidates, Choice, Model, Receiver, Tables};
use crate::estimation::{Integrand, Run, SampleBatch, Tally};
use crate::sampling::{block, hash, warp};
use crate::sensor::Sensor;
use crate::spectrum::WavelengthDensity;

/// Block of the direction in which a meter looks, out of the way of the blocks of a path's segments.
const DIRECTION_BLOCK: u32 = 1 << 30;
/// Block of the wavelengths of a path, with the numbers of its camera's lens.
pub(super) const WAVELENGTH_BLOCK: u32 = (1 << 30) + 1;
/// First of the blocks with which a meter samples its lights.
const LIGHT_BLOCK: u32 = 1 << 29;

/// One stream: a meter of a sensor.
pub(super) struct Stream<'a> {
    pub sensor: usize,
    pub key: u64,
    pub meter: Meter<'a>,
    /// The exact part of the scalar that tolerances are about.
    pub offset: f64,
}

/// All streams of a block.
pub(super) struct Meters<'a> {
    tracer: Tracer<'a>,
    streams: Vec<Stream<'a>>,
    /// Of the columns, by sensor.
    weights: &'a [Vec<f64>],
    columns: usize,
    /// Of wavelengths, by sensor; none unless the run is spectral.
    densities: &'a [WavelengthDensity],
}

/// Paths that start alike.
#[derive(Copy, Clone, PartialEq, Eq)]
enum Mode {
    /// Those of a `still` meter all begin at the same place.
    Hemisphere {
        delta: bool,
        still: bool,
    },
    Sphere {
        delta: bool,
    },
    Surface,
    Ray,
}

impl Meter<'_> {
    /// With `sums_lights` points know the light of lights without extent.
    fn mode(&self, sums_lights: bool) -> Mode {
        let delta = !sums_lights;
        match self {
            Meter::Irradiance { .. } => Mode::Hemisphere { delta, still: true },
            Meter::Cylinder(_) => Mode::Hemisphere {
                delta,
                still: false,
            },
            Meter::Flux(_) => Mode::Hemisphere {
                delta: true,
                still: false,
            },
            Meter::Scalar { .. } => Mode::Sphere { delta },
            Meter::Surface(_) => Mode::Surface,
            Meter::Ray { .. } => Mode::Ray,
        }
    }

    /// What a path's gathered light is multiplied with.
    fn scale(&self) -> f64 {
        match self {
            Meter::Irradiance { .. } | Meter::Cylinder(_) => PI,
            Meter::Flux(flux) => PI * flux.area,
            Meter::Scalar { .. } => 4.0 * PI,
            Meter::Surface(_) | Meter::Ray { .. } => 1.0,
        }
    }
}

/// Scratch of a thread: the paths, and what each gathers is multiplied with.
#[derive(Default)]
pub(super) struct MeterWorkspace {
    paths: Workspace,
    sign: Vec<f64>,
    columns: Vec<f64>,
}

impl<'a> Meters<'a> {
    pub fn new(
        tables: &'a Tables<'a>,
        options: &MeasureOptions,
        streams: Vec<Stream<'a>>,
        (weights, densities): (&'a [Vec<f64>], &'a [WavelengthDensity]),
    ) -> Self {
        let tracer = Tracer {
            tables,
            set: options.instruction_set,
            max_depth: options.max_depth.unwrap_or(u32::MAX),
            merge_groups: false,
        };
        Self {
            tracer,
            streams,
            weights,
            columns: tables.scene.columns(),
            densities,
        }
    }

    fn trace(&self, mode: Mode, runs: &[(usize, Run)], workspace: &mut MeterWorkspace) {
        let tables = self.tracer.tables;
        workspace.paths.vertices.clear();
        workspace.paths.mirrors.clear();
        workspace.paths.encounters.clear();
        workspace.paths.viewer.iter_mut().for_each(Vec::clear);
        workspace.paths.flights.clear();
        for (slot, run) in runs {
            self.start(*slot, run, workspace);
        }
        let paths = &mut workspace.paths;
        match mode {
            Mode::Surface => {
                self.tracer.reflect(paths, 1);
                self.tracer.follow(paths, 1, tables.for_surfaces());
            }
            Mode::Ray => self.tracer.follow(paths, 0, tables.for_surfaces()),
            Mode::Sphere { delta } => {
                self.look(paths, tables.for_meters(delta, Receiver::Scalar), true);
            }
            Mode::Hemisphere { delta, still } => {
                let encounters = std::mem::take(&mut paths.encounters);
                self.look(paths, tables.for_meters(delta, Receiver::Irradiance), still);
                self.look_at_models(paths, encounters);
            }
        }
    }

    /// Follows the paths that look at the surface where they begin.
    fn look_at_models(&self, paths: &mut Workspace, encounters: Vec<Encounter>) {
        if encounters.is_empty() || self.tracer.max_depth < 2 {
            return;
        }
        paths.encounters = encounters;
        paths.flights.clear();
        scattering::scatter(&self.tracer, paths, 1);
        self.tracer
            .follow(paths, 1, self.tracer.tables.for_surfaces());
    }

    /// Samples the lights at meters, still ones or not, and sends paths out.
    fn look(&self, paths: &mut Workspace, candidates: Candidates, still: bool) {
        let next_event = NextEvent {
            tracer: &self.tracer,
            candidates,
            still,
        };
        let fill = |number: u32, paths: &mut Workspace| {
            let (identity, uniforms) = (&paths.vertices.identity, &mut paths.uniforms);
            scatter::fill(&self.tracer, identity, LIGHT_BLOCK + number, uniforms);
        };
        if let Choice::ByImportance { samples } = candidates.choice {
            for stratum in 0..samples {
                fill(stratum, paths);
                next_event.gather_stratum(paths, (stratum, samples));
            }
        } else {
            for emitter in 0..candidates.count {
                fill(emitter as u32, paths);
                next_event.gather_from(paths, emitter);
            }
        }
        scatter::fill(
            &self.tracer,
            &paths.vertices.identity,
            DIRECTION_BLOCK,
            &mut paths.uniforms,
        );
        if candidates.receiver == Receiver::Scalar {
            leave_over_sphere(paths);
        } else {
            scatter::leave_diffusely(&self.tracer, paths, None);
        }
        self.tracer.follow(paths, 0, candidates);
    }

    /// Puts the vertices of a run at its meter.
    fn start(&self, slot: usize, run: &Run, workspace: &mut MeterWorkspace) {
        let stream = &self.streams[run.stream as usize];
        let paths = &mut workspace.paths;
        if let Some(density) = self.densities.get(stream.sensor) {
            for i in 0..run.count {
                let [w, ..] = block::sample(run.key, run.first + i, WAVELENGTH_BLOCK);
                paths.wavelengths[slot + i as usize] = density.sample(w);
            }
        }
        let first = (slot as u32, run.key, run.first);
        match &stream.meter {
            Meter::Irradiance { place, known } => {
                paths.known[slot..][..run.count as usize].fill(*known);
                let response = [FRAC_1_PI; 4];
                paths.vertices.repeat(place, response, first, run.count);
            }
            Meter::Scalar { place, known } => {
                paths.known[slot..][..run.count as usize].fill(*known);
                let response = [0.25 * FRAC_1_PI; 4];
                paths.vertices.repeat(place, response, first, run.count);
            }
            meter => {
                for i in 0..run.count {
                    let identity = (first.0 + i, run.key, run.first + i);
                    let u = block::sample(run.key, run.first + i, 0);
                    self.start_one(meter, u, identity, workspace);
                }
            }
        }
    }

    /// Starts a sample of a meter whose samples start differently.
    fn start_one(
        &self,
        meter: &Meter<'_>,
        u: [f32; 4],
        identity: (u32, u64, u32),
        workspace: &mut MeterWorkspace,
    ) {
        let (paths, light) = (&mut workspace.paths, [u[2], u[3]]);
        match meter {
            Meter::Irradiance { .. } | Meter::Scalar { .. } => {}
            Meter::Cylinder(cylinder) => {
                let response = [FRAC_1_PI; 4];
                let vertices = &mut paths.vertices;
                vertices.push(cylinder.place(u[0]), response, identity, light);
            }
            Meter::Surface(seen) => {
                let encounter = Encounter {
                    identity,
                    light,
                    ..seen.clone()
                };
                self.start_at_surface(paths, encounter);
            }
            Meter::Ray { origin, direction } => paths.flights.push(Flight {
                origin: *origin,
                direction: *direction,
                throughput: [1.0; 4],
                pdf: f32::INFINITY,
                identity,
                light,
            }),
            Meter::Flux(flux) => self.start_on_flux(flux, u, identity, workspace),
        }
    }

    fn start_at_surface(&self, paths: &mut Workspace, seen: Encounter) {
        let tables = self.tracer.tables;
        let side = &tables.sides[seen.side as usize];
        if side.model == Model::Any {
            paths.encounters.push(seen);
            return;
        }
        let wavelengths = paths.wavelengths[seen.identity.0 as usize];
        let reflectance = tables.lanes_at(&side.reflectance, &wavelengths, || seen.site);
        match side.model {
            Model::Lambertian => paths.vertices.push(
                seen.place,
                reflectance.map(|lane| lane * FRAC_1_PI),
                seen.identity,
                seen.light,
            ),
            Model::Mirror => {
                let mirrors = &mut paths.mirrors;
                mirrors.push(seen.place, reflectance, seen.identity, seen.light);
                let viewer = paths.viewer.iter_mut().zip(seen.viewer);
                viewer.for_each(|(column, axis)| column.push(axis));
            }
            // A pane is met by a ray.
            Model::Black | Model::Any | Model::Pane => {}
        }
    }

    fn start_on_flux(
        &self,
        flux: &FluxMeter,
        u: [f32; 4],
        identity: (u32, u64, u32),
        workspace: &mut MeterWorkspace,
    ) {
        let tables = self.tracer.tables;
        let Some(drawn) = flux.draw([f64::from(u[0]), f64::from(u[1])]) else {
            return;
        };
        let slot = identity.0 as usize;
        let wavelengths = &workspace.paths.wavelengths[slot];
        let start = match drawn.part {
            None => flux.on_virtual(identity),
            Some(part) if tables.is_any(part, flux.front) => {
                flux.on_model(tables, &drawn, part, wavelengths, identity)
            }
            Some(part) => flux.on_shape(tables, &drawn, part, wavelengths),
        };
        workspace.sign[slot] = start.sign;
        if let Some((group, radiance)) = start.emitted {
            let gathered = &mut workspace.paths.gathered;
            self.tracer
                .add(gathered, group, identity.0, |lane| radiance[lane]);
        }
        if start.weights == [0.0; 4] {
            return;
        }
        if let (Looks::AtModel { .. }, Some(part)) = (start.looks, drawn.part) {
            let [a, b, ..] = block::sample(identity.1, identity.2, DIRECTION_BLOCK);
            let light = [u[2], u[3]];
            workspace.paths.encounters.push(Encounter {
                identity,
                light,
                ..drawn.seen(tables, part, &start, [a, b])
            });
            return;
        }
        workspace.paths.vertices.push(
            drawn.place(tables, start.front),
            start.weights.map(|weight| weight * FRAC_1_PI),
            identity,
            [u[2], u[3]],
        );
    }

    fn tally(&self, batch: &SampleBatch, workspace: &mut MeterWorkspace, tally: &mut Tally) {
        let tables = self.tracer.tables;
        let mut slot = 0;
        for (number, run) in batch.runs.iter().enumerate() {
            let scale = self.streams[run.stream as usize].meter.scale();
            for _ in 0..run.count {
                let factor = scale * workspace.sign[slot];
                channels::read(tables, &workspace.paths, slot, &mut workspace.columns);
                workspace
                    .columns
                    .iter_mut()
                    .for_each(|column| *column *= factor);
                tally.sample(
                    number,
                    &workspace.columns,
                    self.weights(run.stream as usize),
                );
                slot += 1;
            }
        }
    }
}

impl Integrand for Meters<'_> {
    type Workspace = MeterWorkspace;

    fn streams(&self) -> usize {
        self.streams.len()
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn sensor_of(&self, stream: usize) -> usize {
        self.streams[stream].sensor
    }

    fn stream_key(&self, stream: usize) -> u64 {
        self.streams[stream].key
    }

    fn weights(&self, stream: usize) -> &[f64] {
        &self.weights[self.streams[stream].sensor]
    }

    fn offset(&self, stream: usize) -> f64 {
        self.streams[stream].offset
    }

    fn new_workspace(&self) -> MeterWorkspace {
        MeterWorkspace {
            columns: vec![0.0; self.columns],
            ..MeterWorkspace::default()
        }
    }

    fn sample(&self, batch: &SampleBatch, workspace: &mut MeterWorkspace, tally: &mut Tally) {
        let count = batch.count();
        self.tracer.begin(&mut workspace.paths, count);
        workspace.sign.clear();
        workspace.sign.resize(count, 1.0);
        let sums_lights = self.tracer.tables.sums_lights();
        let mode = |run: &Run| self.streams[run.stream as usize].meter.mode(sums_lights);
        let mut slot = 0;
        let mut alike: Vec<(usize, Run)> = Vec::new();
        for run in batch.runs {
            if let Some((_, first)) = alike.first()
                && mode(first) != mode(run)
            {
                self.trace(mode(first), &alike, workspace);
                alike.clear();
            }
            alike.push((slot, *run));
            slot += run.count as usize;
        }
        if let Some((_, first)) = alike.first() {
            self.trace(mode(first), &alike, workspace);
        }
        self.tally(batch, workspace, tally);
    }
}

/// Sends a path out of every meter of scalar irradiance, uniformly over the sphere.
fn leave_over_sphere(paths: &mut Workspace) {
    let vertices = &paths.vertices;
    paths.flights.clear();
    for i in 0..vertices.len() {
        let identity = &vertices.identity;
        paths.flights.push(Flight {
            origin: vertices.place(i).point,
            direction: warp::sphere(paths.uniforms[0][i], paths.uniforms[1][i]),
            throughput: std::array::from_fn(|lane| {
                vertices.response[lane][i] * 4.0 * std::f32::consts::PI
            }),
            pdf: 0.25 * FRAC_1_PI,
            identity: (identity.slot[i], identity.key[i], identity.index[i]),
            light: [paths.uniforms[2][i], paths.uniforms[3][i]],
        });
    }
}

/// The readings of some points of a sensor.
pub(super) struct Part<'a> {
    /// Which of the chosen sensors.
    pub position: usize,
    pub sensor: &'a Sensor,
    pub readings: Vec<Prepared<'a>>,
}

/// The streams of readings, in their order.
pub(super) fn streams<'a>(parts: &mut [Part<'a>], weights: &[Vec<f64>]) -> Vec<Stream<'a>> {
    let mut streams = Vec::new();
    for part in parts {
        let name = hash::key_of_name(&part.sensor.name);
        for reading in &mut part.readings {
            let Some(meter) = reading.meter.take() else {
                continue;
            };
            let weights = weights[part.position].iter().zip(&reading.exact);
            let offset = weights.map(|(w, x)| w * x).sum();
            let key = hash::combine(name, reading.index as u64);
            reading.is_sampled = true;
            streams.push(Stream {
                sensor: part.position,
                key,
                meter,
                offset,
            });
        }
    }
    streams
}
