//! Running a simulation: which streams there are, and what their replicates mean.

use steradian_kernel::InstructionSet;
use thiserror::Error;

use super::measure::{Meters, streams};
use super::meters::{self, Prepared};
use super::tables::Tables;
use super::unsampled::unsampled;
use crate::estimation::{EstimationError, Observer, Plan, Replicates, estimate};
use crate::measurement::{LaneRecord, Measurements, PointRecord, SensorRecord};
use crate::scene::Scene;
use crate::sensor::{Kind, Readout};

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
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self {
            plan: Plan::default(),
            max_depth: None,
            instruction_set: InstructionSet::detect(),
            sensors: None,
        }
    }
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

/// Reads the sensors of a scene (all but cameras).
pub fn measure(
    scene: &Scene,
    options: &MeasureOptions,
    observer: &mut dyn Observer,
) -> Result<Measurements, SimulationError> {
    let tables = Tables::new(scene);
    let chosen = chosen_sensors(scene, options.sensors.as_deref())?;
    let depth = options.max_depth.unwrap_or(u32::MAX);
    let prepare = |&sensor: &usize| {
        (
            sensor,
            meters::prepare(&tables, &scene.sensors()[sensor], depth),
        )
    };
    let mut prepared: Vec<(usize, Vec<Prepared>)> = chosen.iter().map(prepare).collect();
    let weights = scalar_weights(scene, &scene.sensors()[chosen[0]].readouts);
    let streams = streams(scene, &mut prepared, &weights);
    let replicates = if streams.is_empty() {
        options.plan.check()?;
        vec![]
    } else {
        estimate(
            &Meters::new(&tables, options, streams, weights),
            &options.plan,
            observer,
        )?
    };
    Ok(record(scene, options, prepared, &replicates))
}

fn chosen_sensors(scene: &Scene, names: Option<&[String]>) -> Result<Vec<usize>, SimulationError> {
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

/// Weights of the columns in the scalar that tolerances are about: the first readout, all groups.
fn scalar_weights(scene: &Scene, readouts: &[Readout]) -> Vec<f64> {
    let lanes = readouts.first().map_or_else(
        || scene.lanes().radiant_weights(),
        |readout| readout.weights.clone(),
    );
    (0..scene.columns())
        .map(|column| lanes[column % lanes.len()])
        .collect()
}

fn record(
    scene: &Scene,
    options: &MeasureOptions,
    prepared: Vec<(usize, Vec<Prepared>)>,
    replicates: &[Replicates],
) -> Measurements {
    let sensors = prepared.into_iter().map(|(sensor, readings)| {
        let sensor = &scene.sensors()[sensor];
        let points = readings
            .into_iter()
            .map(|reading| point(reading, replicates))
            .collect();
        SensorRecord {
            name: sensor.name.clone(),
            quantities: sensor.readouts.clone(),
            points,
        }
    });
    Measurements {
        scene_name: scene.name().into(),
        seed: options.plan.seed,
        confidence: options.plan.confidence,
        luminous_efficacy: scene.reported_efficacy(),
        max_depth: options.max_depth,
        lanes: scene
            .lanes()
            .names()
            .iter()
            .map(|name| LaneRecord { name: name.clone() })
            .collect(),
        groups: scene.groups().to_vec(),
        sensors: sensors.collect(),
        unsampled: unsampled(scene),
        warnings: scene.warnings().to_vec(),
        shard: options.plan.shard,
    }
}

fn point(reading: Prepared, replicates: &[Replicates]) -> PointRecord {
    PointRecord {
        index: reading.index,
        position: reading.position.map(|point| point.to_array()),
        normal: reading.normal.map(|normal| normal.to_array()),
        sits_on: reading.sits_on,
        exact: reading.exact,
        replicates: reading.stream.map(|stream| replicates[stream].clone()),
    }
}
