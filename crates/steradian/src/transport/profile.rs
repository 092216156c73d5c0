//! Where the time of a path goes, stage by stage.
//!
//! Every thread's workspace keeps a stop-watch; a lap is taken once a stage and batch, which costs less than a
//! nanosecond a path.

use std::time::{Duration, Instant};

use super::camera::{CameraSampler, CameraWorkspace};
use super::channels;
use super::columns::BATCH;
use super::path::Tracer;
use super::run::{RenderOptions, SimulationError, camera_of};
use super::tables::Tables;
use crate::estimation::film::{PixelBatch, PixelSampler};
use crate::sampling::block;
use crate::scene::Scene;

/// The stages of a batch of paths.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Laying out rays and reading the result.
    Camera,
    /// Closest hits.
    Closest,
    /// From hits to vertices, with the emission they meet.
    Arrive,
    /// Sampling lights.
    Lights,
    /// Shadow rays and what they let through.
    Shadows,
    /// Sampled directions and roulette.
    Scatter,
}

impl Stage {
    /// All stages in order.
    pub const ALL: [Self; 6] = [
        Self::Camera,
        Self::Closest,
        Self::Arrive,
        Self::Lights,
        Self::Shadows,
        Self::Scatter,
    ];
}

/// Time spent in each stage.
#[derive(Copy, Clone, Debug, Default)]
pub struct StageTimes {
    times: [Duration; Stage::ALL.len()],
    /// Rays of the closest-hit stage.
    pub rays: u64,
    /// Paths.
    pub paths: u64,
}

impl StageTimes {
    /// Nanoseconds a path spends in a stage.
    pub fn nanoseconds(&self, stage: Stage) -> f64 {
        self.times[stage as usize].as_secs_f64() * 1e9 / self.paths.max(1) as f64
    }
}

/// Accumulates laps.
pub(super) struct StopWatch {
    last: Instant,
    pub times: StageTimes,
}

impl Default for StopWatch {
    fn default() -> Self {
        Self {
            last: Instant::now(),
            times: StageTimes::default(),
        }
    }
}

impl StopWatch {
    /// Starts without counting what was before.
    pub fn start(&mut self) {
        self.last = Instant::now();
    }

    /// Counts the time since the last lap for a stage.
    pub fn lap(&mut self, stage: Stage) {
        let now = Instant::now();
        self.times.times[stage as usize] += now - self.last;
        self.last = now;
    }
}

/// Traces `batches` of 1024 camera paths on this thread, spread over the picture, and tells where the time went.
pub fn profile(
    scene: &Scene,
    sensor: usize,
    options: &RenderOptions,
    batches: u32,
) -> Result<StageTimes, SimulationError> {
    let camera = camera_of(scene, sensor)?;
    let [width, height] = camera.resolution.map(|pixels| pixels as f32);
    let tables = Tables::new(scene);
    let max_depth = options.max_depth.unwrap_or(u32::MAX);
    let tracer = Tracer {
        tables: &tables,
        set: options.instruction_set,
        max_depth,
        merge_groups: true,
    };
    let sampler = CameraSampler::new(
        tracer,
        camera,
        channels::density(scene, &scene.sensors()[sensor]),
    );
    let mut workspace = CameraWorkspace::default();
    let mut out = [[0.0; 4]; BATCH];
    let keys = [options.plan.seed; BATCH];
    for batch in 0..batches {
        let indices: Vec<u32> = (0..BATCH as u32)
            .map(|i| batch * BATCH as u32 + i)
            .collect();
        let draws: Vec<[f32; 4]> = indices
            .iter()
            .map(|&index| block::sample(keys[0], index, 0))
            .collect();
        let column = |dimension: usize, scale: f32| {
            draws
                .iter()
                .map(|u| u[dimension] * scale)
                .collect::<Vec<f32>>()
        };
        let (x, y, u, v) = (
            column(0, width),
            column(1, height),
            column(2, 1.0),
            column(3, 1.0),
        );
        let batch = PixelBatch {
            x: &x,
            y: &y,
            lens: [&u, &v],
            indices: &indices,
            keys: &keys,
        };
        sampler.sample(&batch, &mut workspace, &mut out);
    }
    Ok(workspace.paths.watch.times)
}
