//! Pictures: radiance arriving at a camera, by paths through the film.
//!
//! Of the four numbers of block 0 a sample's first two are its place on the film. A camera without a lens lets the first
//! vertex have the other two for its light; a thin lens takes them for the place on the lens, so that film and lens are
//! stratified together, and the first vertex draws its numbers from a block of its own.

mod optics;

use self::optics::Optics;
use super::columns::{BATCH, Flight, Workspace};
use super::path::Tracer;
use super::profile::Stage;
use super::scatter;
use super::tables::Tables;
use crate::estimation::film::{PixelBatch, PixelSampler};
use crate::sensor::Camera;

/// Block of the first vertex behind a lens, out of the way of the blocks of a path's segments.
const LIGHT_BLOCK: u32 = 1 << 30;

/// Samples the pixels of a camera.
pub(super) struct CameraSampler<'a> {
    tracer: Tracer<'a>,
    origin: [f32; 3],
    optics: Optics,
}

impl<'a> CameraSampler<'a> {
    pub fn new(tracer: Tracer<'a>, camera: &Camera) -> Self {
        Self {
            origin: tracer.tables.scene.surfaces().to_kernel(camera.position),
            optics: Optics::new(camera),
            tracer,
        }
    }

    /// Sends a path from every film position that sees anything.
    fn launch(&self, batch: &PixelBatch<'_>, paths: &mut Workspace) {
        for i in 0..batch.len() {
            let numbers = [batch.lens[0][i], batch.lens[1][i]];
            let Some((start, direction)) = self.optics.ray(batch.x[i], batch.y[i], numbers) else {
                continue;
            };
            paths.flights.push(Flight {
                origin: std::array::from_fn(|axis| self.origin[axis] + start[axis]),
                direction: direction.into(),
                throughput: [1.0; 4],
                pdf: f32::INFINITY,
                identity: (i as u32, batch.keys[i], batch.indices[i]),
                light: numbers,
            });
        }
        if self.optics.has_lens() {
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
    type Workspace = Workspace;

    fn new_workspace(&self) -> Workspace {
        Workspace::default()
    }

    fn sample(&self, batch: &PixelBatch<'_>, paths: &mut Workspace, out: &mut [[f32; 4]]) {
        paths.watch.start();
        paths.watch.times.paths += batch.len() as u64;
        self.tracer.begin(paths, batch.len());
        self.launch(batch, paths);
        paths.watch.lap(Stage::Camera);
        self.tracer.follow(paths, 0, self.tables().for_surfaces());
        for (slot, lanes) in out.iter_mut().enumerate() {
            for lane in 0..self.tables().lanes {
                lanes[lane] = paths.gathered[lane * BATCH + slot];
            }
        }
        paths.watch.lap(Stage::Camera);
    }
}
