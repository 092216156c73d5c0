//! Pictures: radiance arriving at a camera, by paths through the film.

use glam::Vec3;

use super::columns::{BATCH, Flight, Workspace};
use super::path::Tracer;
use super::profile::Stage;
use super::tables::Tables;
use crate::estimation::film::{PixelBatch, PixelSampler};
use crate::sensor::Camera;

/// Samples the pixels of a camera.
pub(super) struct CameraSampler<'a> {
    tracer: Tracer<'a>,
    origin: [f32; 3],
    axes: [Vec3; 3],
    resolution: [f32; 2],
}

impl<'a> CameraSampler<'a> {
    pub fn new(tracer: Tracer<'a>, camera: &Camera) -> Self {
        let axes = camera
            .axes()
            .map(|axis| Vec3::from_array(axis.to_array().map(|x| x as f32)));
        let origin = tracer.tables.scene.surfaces().to_kernel(camera.position);
        Self {
            tracer,
            origin,
            axes,
            resolution: camera.resolution.map(|pixels| pixels as f32),
        }
    }

    /// Direction through a film position, as [`Camera::direction`] in f32.
    #[inline(always)]
    fn direction(&self, x: f32, y: f32) -> [f32; 3] {
        let [width, height] = self.resolution;
        let across = 2.0 * x / width - 1.0;
        let down = (2.0 * y - height) / width;
        (self.axes[0] + self.axes[1] * across - self.axes[2] * down)
            .normalize()
            .into()
    }

    fn launch(&self, batch: &PixelBatch<'_>, paths: &mut Workspace) {
        for i in 0..batch.len() {
            let direction = self.direction(batch.x[i], batch.y[i]);
            paths.flights.push(Flight {
                origin: self.origin,
                direction,
                throughput: [1.0; 4],
                pdf: f32::INFINITY,
                identity: (i as u32, batch.keys[i], batch.indices[i]),
                light: [batch.lens[0][i], batch.lens[1][i]],
            });
        }
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

impl CameraSampler<'_> {
    fn tables(&self) -> &Tables<'_> {
        self.tracer.tables
    }
}
