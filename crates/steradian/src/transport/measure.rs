//! Measuring: the streams of all sensors as one integrand.

use std::f64::consts::PI;

use super::MeasureOptions;
use super::branching::Branches;
use super::channels;
use super::columns::Workspace;
use super::light_tracing::LightTracer;
use super::meters::{Meter, Prepared};
use super::next_event::NextEvent;
use super::path::Tracer;
use super::scatter;
use super::scattering::{self, Encounter};
use super::tables::{Candidates, Choice, Receiver, Tables};
use super::thrown::{self, Catching, Gathering};
use crate::estimation::{Integrand, Run, SampleBatch, Tally};
use crate::sampling::hash;
use crate::sensor::Sensor;
use crate::spectrum::WavelengthDensity;

pub(super) mod pilot;
mod start;

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
    /// Paths from what a path of a sensor meets first, by sensor.
    branches: &'a [Branches],
    /// Finds what paths from here cannot, if there is any.
    light: Option<&'a LightTracer<'a>>,
}

/// What the streams of a run have in common, by sensor.
#[derive(Clone, Copy)]
pub(super) struct Shared<'a> {
    /// Of the columns.
    pub weights: &'a [Vec<f64>],
    /// Of wavelengths; none unless the run is spectral.
    pub densities: &'a [WavelengthDensity],
    /// Paths from what a path meets first.
    pub branches: &'a [Branches],
    /// Of no sensor in particular: finds what paths from sensors cannot, if there is any.
    pub light: Option<&'a LightTracer<'a>>,
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
    pub(super) fn scale(&self) -> f64 {
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
    /// Paths that look at the surface where they begin, while others are followed.
    looking: Vec<Encounter>,
    /// Runs that start alike.
    alike: Vec<(usize, Run)>,
    sign: Vec<f64>,
    columns: Vec<f64>,
    catching: Catching,
}

impl<'a> Meters<'a> {
    pub fn new(
        tables: &'a Tables<'a>,
        options: &MeasureOptions,
        streams: Vec<Stream<'a>>,
        shared: Shared<'a>,
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
            weights: shared.weights,
            columns: tables.scene.columns(),
            densities: shared.densities,
            branches: shared.branches,
            light: shared.light,
        }
    }

    fn trace(
        &self,
        (mode, branches): (Mode, Branches),
        runs: &[(usize, Run)],
        workspace: &mut MeterWorkspace,
    ) {
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
            Mode::Ray => {
                let candidates = tables.for_surfaces();
                self.tracer.follow_branches(paths, candidates, branches);
            }
            Mode::Sphere { delta } => {
                let candidates = tables.for_meters(delta, Receiver::Scalar);
                self.look(paths, candidates, true);
                self.tracer.follow_branches(paths, candidates, branches);
            }
            Mode::Hemisphere { delta, still } => {
                workspace.looking.clear();
                std::mem::swap(&mut paths.encounters, &mut workspace.looking);
                let candidates = tables.for_meters(delta, Receiver::Irradiance);
                self.look(paths, candidates, still);
                self.tracer.follow_branches(paths, candidates, branches);
                std::mem::swap(&mut paths.encounters, &mut workspace.looking);
                self.look_at_models(paths);
            }
        }
    }

    /// Follows the paths that look at the surface where they begin.
    fn look_at_models(&self, paths: &mut Workspace) {
        if paths.encounters.is_empty() || self.tracer.max_depth < 2 {
            return;
        }
        paths.flights.clear();
        scattering::scatter(&self.tracer, paths, 1);
        self.tracer
            .follow(paths, 1, self.tracer.tables.for_surfaces());
    }

    /// Samples the lights at meters, still ones or not, and sends paths out: they are among the flights then.
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
            let mut slots = paths.vertices.identity.slot.iter();
            let knows_all = slots.all(|slot| paths.rosters.of(*slot).knows_all());
            for stratum in 0..if knows_all { 0 } else { samples } {
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
            start::leave_over_sphere(paths);
        } else {
            scatter::leave_diffusely(&self.tracer, paths, None);
        }
    }

    /// Follows the paths of runs, those that start alike together.
    pub fn follow(
        &self,
        runs: &[Run],
        branches: impl Fn(&Stream) -> Branches,
        workspace: &mut MeterWorkspace,
    ) {
        let count = runs.iter().map(|run| run.count as usize).sum();
        self.tracer.begin(&mut workspace.paths, count);
        workspace.sign.clear();
        workspace.sign.resize(count, 1.0);
        let sums_lights = self.tracer.tables.sums_lights();
        let kind = |run: &Run| {
            let stream = &self.streams[run.stream as usize];
            (stream.meter.mode(sums_lights), branches(stream))
        };
        let mut slot = 0;
        let mut alike = std::mem::take(&mut workspace.alike);
        alike.clear();
        for run in runs {
            if let Some((_, first)) = alike.first()
                && kind(first) != kind(run)
            {
                self.trace(kind(first), &alike, workspace);
                alike.clear();
            }
            alike.push((slot, *run));
            slot += run.count as usize;
        }
        if let Some((_, first)) = alike.first() {
            self.trace(kind(first), &alike, workspace);
        }
        workspace.alike = alike;
    }

    /// Adds what paths from lights bring to the samples of runs.
    fn follow_light(&self, runs: &[Run], workspace: &mut MeterWorkspace) {
        let Some(light) = self.light else {
            return;
        };
        let paths = &mut workspace.paths;
        let gathering = Gathering {
            wavelengths: &paths.wavelengths,
            sign: &workspace.sign,
            gathered: &mut paths.gathered,
        };
        let catching = &mut workspace.catching;
        thrown::gather(light, &self.streams, runs, catching, gathering);
    }

    /// Tells the columns of every sample, with the number of its run.
    pub fn read(
        &self,
        runs: &[Run],
        workspace: &mut MeterWorkspace,
        mut tell: impl FnMut(usize, &[f64]),
    ) {
        let tables = self.tracer.tables;
        let mut slot = 0;
        for (number, run) in runs.iter().enumerate() {
            let scale = self.streams[run.stream as usize].meter.scale();
            for _ in 0..run.count {
                let factor = scale * workspace.sign[slot];
                channels::read(tables, &workspace.paths, slot, &mut workspace.columns);
                workspace
                    .columns
                    .iter_mut()
                    .for_each(|column| *column *= factor);
                tell(number, &workspace.columns);
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

    fn paths_of_a_sample(&self, stream: usize) -> u32 {
        self.branches[self.streams[stream].sensor].count()
    }

    fn new_workspace(&self) -> MeterWorkspace {
        MeterWorkspace {
            columns: vec![0.0; self.columns],
            ..MeterWorkspace::default()
        }
    }

    fn sample(&self, batch: &SampleBatch, workspace: &mut MeterWorkspace, tally: &mut Tally) {
        let branches = |stream: &Stream| self.branches[stream.sensor];
        self.follow(batch.runs, branches, workspace);
        self.follow_light(batch.runs, workspace);
        self.read(batch.runs, workspace, |run, columns| {
            let stream = batch.runs[run].stream as usize;
            tally.sample(run, columns, self.weights(stream));
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
