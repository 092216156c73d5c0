//! Running a simulation: which streams there are, and what their replicates mean.

use serde::{Deserialize, Serialize};
use steradian_kernel::InstructionSet;
use thiserror::Error;

use super::blocks::POINTS_OF_A_BLOCK;
use super::camera::CameraSampler;
use super::channels;
use super::path::Tracer;
use super::tables::Tables;
use super::unsampled::unsampled_in_picture;
use crate::estimation::film::{Exposure, Film, Filter, PASSES, expose};
use crate::estimation::{EstimationError, Observer, Plan, Stopping};
use crate::sampling::hash;
use crate::scene::{CAMERA_CHANNELS, Scene};
use crate::sensor::{Camera, Kind, Readout, Sensor};

/// Whether several paths start from what one of a sensor meets first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Branching {
    /// As many as a pilot finds best for the scene and the sensor, however long the run and whatever the seed; one in spectral runs.
    #[default]
    Suited,
    /// One, without a pilot.
    Never,
}

/// How a scene is measured.
#[derive(Clone, Debug)]
pub struct MeasureOptions {
    /// Seed, stopping rule, threads, shard.
    pub plan: Plan,
    /// Longest path in segments; `None` is no limit.
    pub max_depth: Option<u32>,
    /// Instruction set of the batched loops; the result does not depend on it.
    pub instruction_set: InstructionSet,
    /// Names of the sensors to read; `None` is all.
    pub sensors: Option<Vec<String>>,
    /// Points in work at a time: see [`POINTS_OF_A_BLOCK`].
    pub points_of_a_block: usize,
    /// How many paths start from what one meets first.
    pub branching: Branching,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self {
            plan: Plan::default(),
            max_depth: None,
            instruction_set: InstructionSet::detect(),
            sensors: None,
            points_of_a_block: POINTS_OF_A_BLOCK,
            branching: Branching::Suited,
        }
    }
}

/// How a picture is made.
#[derive(Clone, Debug)]
pub struct RenderOptions {
    /// Seed, stopping rule (samples are those of a pixel), passes (as replicates), threads, shard.
    pub plan: Plan,
    /// Reconstruction filter.
    pub filter: Filter,
    /// Longest path in segments; `None` is no limit.
    pub max_depth: Option<u32>,
    /// Instruction set of the batched loops; the result does not depend on it.
    pub instruction_set: InstructionSet,
    /// Width and height instead of the camera's.
    pub resolution: Option<[u32; 2]>,
    /// How many paths start from what a camera ray meets first.
    pub branching: Branching,
}

impl Default for RenderOptions {
    /// 64 samples a pixel in 4 passes.
    fn default() -> Self {
        let plan = Plan {
            stop: Stopping::at_samples(64),
            replicates: PASSES,
            ..Plan::default()
        };
        let instruction_set = InstructionSet::detect();
        Self {
            plan,
            filter: Filter::default(),
            max_depth: None,
            instruction_set,
            resolution: None,
            branching: Branching::Suited,
        }
    }
}

/// A picture with what its numbers mean.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// Title of the scene.
    pub scene_name: String,
    /// Name of the camera.
    pub camera: String,
    /// Seed of the run.
    pub seed: u64,
    /// Luminous efficacy K in lm/W that links watts and lumens in this run.
    pub luminous_efficacy: Option<f64>,
    /// Longest path in segments, if it was limited.
    pub max_depth: Option<u32>,
    /// Lanes of every pixel with their error: radiant, W/(m² sr).
    pub exposure: Exposure,
    /// Names of the lanes.
    pub lanes: Vec<String>,
    /// What is read from the lanes, radiant before photometric.
    pub readouts: Vec<Readout>,
    /// Path classes that no estimator could sample.
    pub unsampled: Vec<String>,
    /// What a reader of the numbers should know.
    pub warnings: Vec<String>,
    /// Part k of n, if this is a shard.
    pub shard: Option<(u32, u32)>,
}

/// Why a simulation was refused or given up.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SimulationError {
    /// No sensor of this name.
    #[error("there is no sensor `{name}`; the scene has {known}")]
    UnknownSensor {
        /// What was asked for.
        name: String,
        /// What there is.
        known: String,
    },
    /// A camera where a meter was asked for, or the other way round.
    #[error("sensor `{name}` is {is}, not {expected}")]
    WrongSensor {
        /// Its name.
        name: String,
        /// What it is.
        is: &'static str,
        /// What was expected.
        expected: &'static str,
    },
    /// Nothing to do.
    #[error("the scene has no {0} to simulate")]
    NothingToDo(&'static str),
    /// The estimation failed.
    #[error(transparent)]
    Estimation(#[from] EstimationError),
}

/// Makes a picture with the camera of this number among the sensors.
pub fn render(
    scene: &Scene,
    sensor: usize,
    options: &RenderOptions,
    observer: &mut dyn Observer,
) -> Result<Picture, SimulationError> {
    let camera = camera_of(scene, sensor)?;
    let sensor = &scene.sensors()[sensor];
    let resolution = options.resolution.unwrap_or(camera.resolution);
    let tables = Tables::new(scene);
    let max_depth = options.max_depth.unwrap_or(u32::MAX);
    let tracer = Tracer {
        tables: &tables,
        set: options.instruction_set,
        max_depth,
        merge_groups: true,
    };
    let density = channels::density(scene, sensor);
    let camera = camera.with_resolution(resolution);
    let film = film(scene, sensor, resolution, options.filter);
    let sampler = CameraSampler::new(tracer, &camera, density);
    let sampler = sampler.branching(options.branching, &film, options.plan.threads);
    let exposure = expose(&sampler, &film, &options.plan, observer)?;
    Ok(Picture {
        scene_name: scene.name().into(),
        camera: sensor.name.clone(),
        seed: options.plan.seed,
        luminous_efficacy: scene.reported_efficacy(),
        max_depth: options.max_depth,
        exposure,
        lanes: camera_channels(scene),
        readouts: sensor.readouts.clone(),
        unsampled: unsampled_in_picture(scene, &camera),
        warnings: scene.warnings().to_vec(),
        shard: options.plan.shard,
    })
}

/// The camera of this number among the sensors.
pub(super) fn camera_of(scene: &Scene, sensor: usize) -> Result<&Camera, SimulationError> {
    let sensor = scene
        .sensors()
        .get(sensor)
        .ok_or(SimulationError::NothingToDo("camera"))?;
    let wrong = || SimulationError::WrongSensor {
        name: sensor.name.clone(),
        is: "a meter",
        expected: "a camera",
    };
    if let Kind::Camera(camera) = &sensor.kind {
        Ok(camera)
    } else {
        Err(wrong())
    }
}

/// Names of the channels of a picture.
fn camera_channels(scene: &Scene) -> Vec<String> {
    if scene.lanes().is_spectral() {
        CAMERA_CHANNELS.map(String::from).to_vec()
    } else {
        scene.lanes().names().to_vec()
    }
}

fn film(scene: &Scene, camera: &Sensor, [width, height]: [u32; 2], filter: Filter) -> Film {
    let lanes = camera.readouts.first().map_or_else(
        || scene.lanes().radiant_weights(),
        |readout| readout.weights.clone(),
    );
    let weights = std::array::from_fn(|channel| lanes.get(channel).copied().unwrap_or(0.0));
    Film {
        width,
        height,
        filter,
        key: hash::key_of_name(&camera.name),
        weights,
    }
}

/// Numbers of the sensors of these names, or of all that are no cameras.
pub(super) fn chosen_sensors(
    scene: &Scene,
    names: Option<&[String]>,
) -> Result<Vec<usize>, SimulationError> {
    let is_meter = |index: &usize| !matches!(scene.sensors()[*index].kind, Kind::Camera(_));
    let Some(names) = names else {
        let all: Vec<_> = (0..scene.sensors().len()).filter(is_meter).collect();
        return if all.is_empty() {
            Err(SimulationError::NothingToDo("meter"))
        } else {
            Ok(all)
        };
    };
    let find = |name: &String| {
        let index = scene
            .sensors()
            .iter()
            .position(|sensor| sensor.name == *name)
            .ok_or_else(|| unknown(scene, name))?;
        let wrong = || SimulationError::WrongSensor {
            name: name.clone(),
            is: "a camera",
            expected: "a meter",
        };
        is_meter(&index).then_some(index).ok_or_else(wrong)
    };
    let chosen: Vec<_> = names.iter().map(find).collect::<Result<_, _>>()?;
    if chosen.is_empty() {
        Err(SimulationError::NothingToDo("meter"))
    } else {
        Ok(chosen)
    }
}

fn unknown(scene: &Scene, name: &str) -> SimulationError {
    let known: Vec<_> = scene
        .sensors()
        .iter()
        .map(|sensor| format!("`{}`", sensor.name))
        .collect();
    SimulationError::UnknownSensor {
        name: name.into(),
        known: known.join(", "),
    }
}
