//! Pictures: radiance arriving at a camera, by paths through the film.
//!
//! Of the four numbers of block 0 a sample's first two are its place on the film. A thin lens takes the other two for the place on the
//! lens, so that film and lens are stratified together, and the first vertex draws its numbers from a block of its own, as it does
//! where paths [branch](super::branching). Else the first vertex has them for its light.

mod optics;
mod pilot;

use std::ops::Range;

use self::optics::Optics;
use super::branching::{BRANCHES, Branches, LIGHT_BLOCK};
use super::channels;
use super::columns::{BATCH, Flight, Workspace};
use super::light_tracing::{FilmBatch, FilmTracer, LightTracer};
use super::measure::WAVELENGTH_BLOCK;
use super::path::Tracer;
use super::profile::Stage;
use super::scatter;
use super::tables::Tables;
use crate::estimation::film::{PixelBatch, PixelSampler, Splat};
use crate::sampling::block;
use crate::scene::CAMERA_CHANNELS;
use crate::sensor::Camera;
use crate::spectrum::WavelengthDensity;

/// Samples the pixels of a camera.
pub(super) struct CameraSampler<'a> {
    tracer: Tracer<'a>,
    origin: [f32; 3],
    optics: Optics,
    /// Of wavelengths; none unless the run is spectral.
    density: Option<WavelengthDensity>,
    /// Channels of the film, of a spectral run.
    channels: [usize; 4],
    /// Paths from what a camera ray meets first.
    branches: Branches,
    /// Finds what paths from here cannot, if there is any.
    light: Option<FilmTracer<'a>>,
}

/// Scratch of a thread.
#[derive(Default)]
pub(super) struct CameraWorkspace {
    pub paths: Workspace,
    light: FilmBatch,
}

impl<'a> CameraSampler<'a> {
    pub fn new(tracer: Tracer<'a>, camera: &Camera, density: Option<WavelengthDensity>) -> Self {
        let lanes = tracer.tables.scene.lanes();
        let channels = CAMERA_CHANNELS.map(|name| lanes.channel(name).unwrap_or(0));
        let light = LightTracer::new(tracer.tables, tracer.set, tracer.max_depth);
        let light = light.map(|light| FilmTracer {
            light,
            camera: camera.clone(),
            density: density.clone(),
            channels,
        });
        Self {
            origin: tracer.tables.scene.surfaces().to_kernel(camera.position),
            optics: Optics::new(camera),
            tracer,
            channels,
            // Those of a spectral run would share their wavelengths.
            branches: match density {
                Some(_) => Branches::ONE,
                None => Branches::all(BRANCHES),
            },
            density,
            light,
        }
    }

    /// Sends a path from every film position that sees anything.
    fn launch(&self, batch: &PixelBatch<'_>, paths: &mut Workspace) {
        for i in 0..batch.len() {
            let numbers = [batch.lens[0][i], batch.lens[1][i]];
            let Some((start, direction)) = self.optics.ray(batch.x[i], batch.y[i], numbers) else {
                continue;
            };
            if let Some(density) = &self.density {
                let [w, ..] = block::sample(batch.keys[i], batch.indices[i], WAVELENGTH_BLOCK);
                paths.wavelengths[i] = density.sample(w);
            }
            paths.flights.push(Flight {
                origin: std::array::from_fn(|axis| self.origin[axis] + start[axis]),
                direction: direction.into(),
                throughput: [1.0; 4],
                pdf: f32::INFINITY,
                identity: (i as u32, batch.keys[i], batch.indices[i]),
                light: numbers,
            });
        }
        if self.optics.has_lens() && self.branches == Branches::ONE {
            self.renew_light_numbers(paths);
        }
    }

    fn renew_light_numbers(&self, paths: &mut Workspace) {
        let (flights, uniforms) = (&mut paths.flights, &mut paths.uniforms);
        scatter::fill(&self.tracer, &flights.identity, LIGHT_BLOCK, uniforms);
        std::mem::swap(&mut flights.light_u, &mut uniforms[2]);
        std::mem::swap(&mut flights.light_v, &mut uniforms[3]);
    }

    fn tables(&self) -> &Tables<'_> {
        self.tracer.tables
    }
}

impl PixelSampler for CameraSampler<'_> {
    type Workspace = CameraWorkspace;

    fn new_workspace(&self) -> CameraWorkspace {
        CameraWorkspace::default()
    }

    fn sample(
        &self,
        batch: &PixelBatch<'_>,
        workspace: &mut CameraWorkspace,
        out: &mut [[f32; 4]],
    ) {
        self.sample_by(self.branches, batch, &mut workspace.paths, out);
    }

    fn has_splats(&self) -> bool {
        self.light.is_some()
    }

    fn splat(
        &self,
        indices: Range<u32>,
        key: u64,
        workspace: &mut CameraWorkspace,
        out: &mut Vec<Splat>,
    ) {
        if let Some(light) = &self.light {
            light.trace(indices, key, &mut workspace.light, out);
        }
    }
}

impl CameraSampler<'_> {
    /// The mean of these branches of a sample for each position.
    fn sample_by(
        &self,
        branches: Branches,
        batch: &PixelBatch<'_>,
        paths: &mut Workspace,
        out: &mut [[f32; 4]],
    ) {
        paths.watch.start();
        paths.watch.times.paths += batch.len() as u64 * u64::from(branches.count());
        self.tracer.begin(paths, batch.len());
        self.launch(batch, paths);
        paths.watch.lap(Stage::Camera);
        let candidates = self.tables().for_surfaces();
        self.tracer.follow_branches(paths, candidates, branches);
        for (slot, lanes) in out.iter_mut().enumerate() {
            if self.density.is_some() {
                *lanes = self.channels(paths, slot);
                continue;
            }
            for lane in 0..self.tables().lanes {
                lanes[lane] = paths.gathered[lane * BATCH + slot];
            }
        }
        paths.watch.lap(Stage::Camera);
    }

    /// Channels of the film, from the path of a slot.
    fn channels(&self, paths: &Workspace, slot: usize) -> [f32; 4] {
        let (tables, waves) = (self.tables(), &paths.wavelengths[slot]);
        self.channels.map(|channel| {
            let gathered = |lane: usize| paths.gathered[lane * BATCH + slot];
            channels::counted(&tables.responses[channel], waves, gathered)
        })
    }
}
