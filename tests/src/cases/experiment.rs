//! A scene that stands for a case, and what its readings came to.

use steradian::estimation::Estimate;
use steradian::geometry::{Point, Vector};
use steradian::measurement::Reading;
use steradian::sampling::hash;
use steradian::scene::description::{SceneDescription, SensorKind};
use steradian::transport::MeasureOptions;

use super::Case;
use crate::measuring::{measured, rel_error, samples};
use crate::scenes::{irradiance_at, sensor};
use crate::{Certainty, certainty, disagreement, score};

/// Half-width of the 95 % interval relative to the value: a standard error of .2 % at t = 2.
pub const REL_ERROR: f64 = 0.0039;
/// A scene and which of its readings are which numbers of a case.
pub struct Experiment {
    scene: SceneDescription,
    max_depth: Option<u32>,
    samples: Option<u64>,
    probes: Vec<Probe>,
}

/// One number.
struct Probe {
    /// What the case calls it.
    name: String,
    sensor: String,
    index: usize,
    quantity: &'static str,
    factor: f64,
    bias: f64,
    /// The samples are those of another number.
    repeats: bool,
    /// The next reading of the sensor is added.
    opposite: bool,
}

/// What became of one number of a case.
pub struct Outcome {
    /// Case and name.
    pub what: String,
    /// What was expected.
    pub expected: f64,
    /// Known error of the expected value and of the scene that stands for the case.
    pub allowance: f64,
    /// What was read.
    pub estimate: Estimate,
    /// Samples behind it.
    pub samples: u64,
    /// The samples are those of another number.
    pub repeats: bool,
}

impl Experiment {
    /// A scene without sensors yet.
    pub fn new(scene: SceneDescription) -> Self {
        Self {
            scene,
            max_depth: None,
            samples: None,
            probes: vec![],
        }
    }

    /// Reads a number of the case with a sensor of its own.
    pub fn read(mut self, name: &str, kind: SensorKind) -> Self {
        self.scene.sensors.push(sensor(name, kind));
        self.probe(name, name, 0);
        self
    }

    /// Reads irradiances at points with one sensor.
    pub fn read_points(mut self, points: Vec<(String, Point, Vector)>) -> Self {
        let sensor_name = format!("points {}", self.scene.sensors.len());
        for (index, (name, ..)) in points.iter().enumerate() {
            self.probe(name, &sensor_name, index);
        }
        let places: Vec<_> = points
            .into_iter()
            .map(|(_, point, normal)| (point, normal))
            .collect();
        self.scene
            .sensors
            .push(sensor(&sensor_name, irradiance_at(places)));
        self
    }

    /// Reads the sum of the irradiances of both sides of a plane.
    pub fn read_both_sides(mut self, name: &str, point: Point, normal: Vector) -> Self {
        let kind = irradiance_at([(point, normal), (point, -normal)]);
        self = self.read(name, kind);
        self.last().opposite = true;
        self
    }

    /// Reads a number of the case from the sensor of another: the same samples, so not a statistic of its own.
    pub fn read_again(mut self, name: &str, sensor: &str) -> Self {
        self.probe(name, sensor, 0);
        self.last().repeats = true;
        self
    }

    fn probe(&mut self, name: &str, sensor: &str, index: usize) {
        self.probes.push(Probe {
            name: name.into(),
            sensor: sensor.into(),
            index,
            quantity: "",
            factor: 1.0,
            bias: 0.0,
            repeats: false,
            opposite: false,
        });
    }

    /// The readings so far are multiplied with `factor`.
    pub fn times(mut self, factor: f64) -> Self {
        self.probes
            .iter_mut()
            .for_each(|probe| probe.factor *= factor);
        self
    }

    /// The last number is the reading whose quantity begins so (the first reading otherwise).
    pub fn as_quantity(mut self, quantity: &'static str) -> Self {
        self.last().quantity = quantity;
        self
    }

    /// The last number is the reading times `factor`.
    pub fn with_factor(mut self, factor: f64) -> Self {
        self.last().factor = factor;
        self
    }

    /// The scene differs from the case by at most `bias` in the last number.
    pub fn with_bias(mut self, bias: f64) -> Self {
        self.last().bias = bias;
        self
    }

    /// The same in all numbers so far.
    pub fn with_bias_of_all(mut self, bias: f64) -> Self {
        self.probes.iter_mut().for_each(|probe| probe.bias = bias);
        self
    }

    fn last(&mut self) -> &mut Probe {
        self.probes.last_mut().expect("a number was read before")
    }

    /// Paths end after this many segments.
    pub fn with_max_depth(mut self, segments: u32) -> Self {
        self.max_depth = Some(segments);
        self
    }

    /// Takes so many samples a reading instead of stopping at a tolerance, whose pilot is dear where paths are long.
    pub fn with_samples(mut self, samples: u64) -> Self {
        self.samples = Some(samples);
        self
    }

    /// Names of the numbers that are read.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.probes.iter().map(|probe| probe.name.as_str())
    }

    /// Measures the scene.
    pub fn run(&self, case: &Case) -> Vec<Outcome> {
        let mut options = MeasureOptions {
            max_depth: self.max_depth,
            ..self.effort(case)
        };
        options.plan.seed = hash::key_of_name(&case.id);
        let readings = measured(&self.scene, &options).readings();
        self.probes
            .iter()
            .map(|probe| probe.outcome(case, &readings))
            .collect()
    }

    /// Darkness has no relative error to stop at.
    fn effort(&self, case: &Case) -> MeasureOptions {
        let dark = self.names().all(|name| case.expected(name) == 0.0);
        match self.samples {
            Some(number) => samples(number),
            None if dark => samples(1 << 16),
            None => rel_error(REL_ERROR),
        }
    }
}

impl Probe {
    fn outcome(&self, case: &Case, readings: &[Reading]) -> Outcome {
        let find = |index: usize| {
            let reading = readings.iter().find(|reading| {
                reading.sensor == self.sensor
                    && reading.index == index
                    && reading.quantity.starts_with(self.quantity)
            });
            reading.unwrap_or_else(|| panic!("{} has no {}", case.id, self.name))
        };
        let reading = find(self.index);
        let estimate = if self.opposite {
            sum(&reading.estimate, &find(self.index + 1).estimate)
        } else {
            reading.estimate
        };
        let expected = case.expected(&self.name);
        Outcome {
            what: format!("{} {}", case.id, self.name),
            expected,
            allowance: case.reference_error(expected) + self.bias,
            estimate: estimate.scaled(self.factor),
            samples: reading.samples,
            repeats: self.repeats,
        }
    }
}

/// The sum of two independent estimates.
fn sum(a: &Estimate, b: &Estimate) -> Estimate {
    Estimate {
        std_error: (a.std_error * a.std_error + b.std_error * b.std_error).sqrt(),
        ..a.plus_exact(b.value)
    }
}

impl Outcome {
    /// Why the reading disagrees with the case, if it does.
    pub fn disagreement(&self) -> Option<String> {
        let why = disagreement(&self.estimate, self.expected, self.allowance)?;
        Some(format!("{}: {why}", self.what))
    }

    /// Whether the sampling error is the only one that matters, so that the score is that of a statistic.
    pub fn is_statistic(&self) -> bool {
        !self.repeats
            && certainty(&self.estimate) == Certainty::Sampled
            && self.allowance <= 0.1 * self.estimate.std_error
    }

    /// Standard errors between the reading and the expected value.
    pub fn score(&self) -> f64 {
        score(&self.estimate, self.expected)
    }

    /// A row of the table.
    pub fn row(&self) -> String {
        let (value, error) = (self.estimate.value, self.estimate.std_error);
        let score = if self.is_statistic() {
            format!("{:+.2}", self.score())
        } else {
            "–".into()
        };
        format!(
            "{:<72} {:>14.7} {:>14.7} ± {:<8.1e} {:>6} {:>9} {:?}",
            self.what,
            self.expected,
            value,
            error,
            score,
            self.samples,
            certainty(&self.estimate)
        )
    }
}
