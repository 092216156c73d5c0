//! What a run found: replicate means by sensor, point, light group and lane, and the readings derived from them.
//!
//! A result keeps the replicate means of every column, so that sums, shares and dimmed groups keep their covariances
//! and so that shards can be put together bit for bit. Only [`Estimate`]s leave it.

mod merge;

use serde::{Deserialize, Serialize};

use crate::estimation::{Estimate, Replicates};
use crate::sensor::{Readout, SitsOn};

/// A lane of the run's spectrum.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneRecord {
    /// `red`, `green`, `blue`, or the name of a band.
    pub name: String,
}

/// Relative rounding of a path's light, which is gathered in single precision: 2⁻²², a few units in the last place.
const ROUNDING: f64 = 1.0 / 4_194_304.0;

/// One point, ray or surface of a sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointRecord {
    /// Number within the sensor.
    pub index: usize,
    /// Where, in metres; none for a flux surface.
    pub position: Option<[f64; 3]>,
    /// Its normal, or the direction of a ray.
    pub normal: Option<[f64; 3]>,
    /// What it lies on.
    pub sits_on: Option<SitsOn>,
    /// The part of each column that a closed form gives, with no sampling error.
    pub exact: Vec<f64>,
    /// Columns whose exact part is all there is, so that nothing had to be sampled.
    pub closed: Vec<bool>,
    /// The sampled part; none when all columns are closed.
    pub replicates: Option<Replicates>,
}

/// One sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorRecord {
    /// Its name.
    pub name: String,
    /// What it reports.
    pub quantities: Vec<Readout>,
    /// Its points.
    pub points: Vec<PointRecord>,
}

/// Everything a run found; columns are ordered group by group, lane by lane within a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurements {
    /// Title of the scene.
    pub scene_name: String,
    /// Seed of the run.
    pub seed: u64,
    /// Confidence of the intervals.
    pub confidence: f64,
    /// Luminous efficacy K in lm/W that links watts and lumens in this run.
    pub luminous_efficacy: Option<f64>,
    /// Longest path in segments, if it was limited.
    pub max_depth: Option<u32>,
    /// The lanes.
    pub lanes: Vec<LaneRecord>,
    /// The light groups.
    pub groups: Vec<String>,
    /// The sensors.
    pub sensors: Vec<SensorRecord>,
    /// Path classes that no estimator could sample.
    pub unsampled: Vec<String>,
    /// What a reader of the numbers should know.
    pub warnings: Vec<String>,
    /// Part k of n, if this is a shard.
    pub shard: Option<(u32, u32)>,
}

/// One number of a report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reading {
    /// Name of the sensor.
    pub sensor: String,
    /// Number within the sensor.
    pub index: usize,
    /// Where, in metres.
    pub position: Option<[f64; 3]>,
    /// The receiver's normal, or a ray's direction.
    pub normal: Option<[f64; 3]>,
    /// What the receiver lies on.
    pub sits_on: Option<SitsOn>,
    /// The field's name of the quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// The value with its error.
    pub estimate: Estimate,
    /// Samples behind it.
    pub samples: u64,
    /// By lane.
    pub channels: Vec<(String, Estimate)>,
    /// By light group.
    pub groups: Vec<(String, Estimate)>,
}

impl Measurements {
    /// True when no path class was left out.
    pub fn complete(&self) -> bool {
        self.unsampled.is_empty()
    }

    /// True when every reading met its tolerance.
    pub fn converged(&self) -> bool {
        self.readings()
            .iter()
            .all(|reading| reading.estimate.converged)
    }

    /// The readings of every sensor, in order.
    pub fn readings(&self) -> Vec<Reading> {
        let points = self
            .sensors
            .iter()
            .flat_map(|sensor| sensor.points.iter().map(move |point| (sensor, point)));
        points
            .flat_map(|(sensor, point)| {
                sensor
                    .quantities
                    .iter()
                    .map(move |q| self.reading(sensor, point, q))
            })
            .collect()
    }

    fn reading(&self, sensor: &SensorRecord, point: &PointRecord, quantity: &Readout) -> Reading {
        let all = |_: usize, lane: usize| quantity.weights[lane];
        let channel = |wanted: usize| {
            move |_: usize, lane: usize| {
                if lane == wanted {
                    quantity.channel_factor
                } else {
                    0.0
                }
            }
        };
        let group = |wanted: usize| {
            move |group: usize, lane: usize| {
                if group == wanted {
                    quantity.weights[lane]
                } else {
                    0.0
                }
            }
        };
        let lanes = self.lanes.iter().enumerate();
        let groups = self.groups.iter().enumerate();
        Reading {
            sensor: sensor.name.clone(),
            index: point.index,
            position: point.position,
            normal: point.normal,
            sits_on: point.sits_on.clone(),
            quantity: quantity.name.clone(),
            unit: quantity.unit.clone(),
            estimate: self.combine(point, all),
            samples: point
                .replicates
                .as_ref()
                .map_or(0, Replicates::total_samples),
            channels: lanes
                .map(|(i, lane)| (lane.name.clone(), self.combine(point, channel(i))))
                .collect(),
            groups: groups
                .map(|(i, name)| (name.clone(), self.combine(point, group(i))))
                .collect(),
        }
    }

    /// Σ weight(group, lane) · column, exact and sampled parts together.
    fn combine(&self, point: &PointRecord, weight: impl Fn(usize, usize) -> f64) -> Estimate {
        let lanes = self.lanes.len();
        let weights: Vec<f64> = (0..point.exact.len())
            .map(|column| weight(column / lanes, column % lanes))
            .collect();
        let exact = weights.iter().zip(&point.exact).map(|(w, x)| w * x).sum();
        let open = weights.iter().zip(&point.closed);
        let open: Vec<f64> = open
            .map(|(weight, closed)| if *closed { 0.0 } else { *weight })
            .collect();
        match &point.replicates {
            Some(replicates) if open.iter().any(|weight| *weight != 0.0) => {
                let sampled = replicates.combine(&open);
                sampled
                    .widened(ROUNDING * sampled.value.abs())
                    .plus_exact(exact)
            }
            _ => Estimate::closed_form(exact),
        }
    }
}
