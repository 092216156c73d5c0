//! What a run found: replicate means by sensor, point, light group and lane, and the readings derived from them.
//!
//! A result keeps the replicate means of every column, so that sums, shares and dimmed groups keep their covariances
//! and so that shards can be put together bit for bit. Only [`Estimate`]s leave it.

mod balance;
mod blocks;
mod check;
mod dimming;
mod exposure;
mod gathered;
mod merge;
mod resampled;
pub mod solve;
mod statistics;
#[cfg(test)]
mod synthetic;

pub use balance::Balance;
pub use blocks::Unmeasured;
pub use check::Contradiction;
pub use dimming::{Dimming, RelightError, ScheduleError};
pub use exposure::Exposure;
pub use gathered::Gathered;
pub use statistics::{Extreme, Statistics};

use serde::{Deserialize, Serialize};

use crate::estimation::{Estimate, Replicates};
use crate::sensor::{Layout, Readout, SitsOn};

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
    /// What it is about, where that is no point: a light, or a side of a shape.
    #[serde(default)]
    pub about: Option<String>,
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
    /// How its points lie side by side, if they are a grid.
    pub layout: Option<Layout>,
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
    /// The light groups; a name stands once for each schedule that its lights have.
    pub groups: Vec<String>,
    /// How much light each group gives in the course of time, and what is asked about it.
    #[serde(default)]
    pub dimming: Dimming,
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
    /// By lane, of the lanes that count: a band without light has no part in a photometric value. They add up to the
    /// value, but in `rgb`, where the value is their luminance-weighted mean.
    pub channels: Vec<(String, Estimate)>,
    /// By name of the light group; they add up to the value.
    pub groups: Vec<(String, Estimate)>,
    /// What it adds up to over the interval asked for.
    pub exposure: Option<Exposure>,
}

impl Reading {
    /// Whether it was sampled and no light was found.
    pub fn is_dark(&self) -> bool {
        self.estimate.is_dark()
    }
}

impl Measurements {
    /// True when no path class was left out.
    pub fn complete(&self) -> bool {
        self.unsampled.is_empty()
    }

    /// True when every reading met its tolerance; accounts of an energy balance in which no light was found count as 0.
    pub fn converged(&self) -> bool {
        self.missed() == 0
    }

    /// Number of readings that did not.
    pub fn missed(&self) -> usize {
        let is_balance = self.is_balance();
        let is_met = |found: &Estimate| found.converged || (is_balance && found.is_dark());
        let found = self.points_by_quantity();
        found
            .map(|(_, point, quantity)| self.value_of(point, quantity))
            .filter(|found| !is_met(found))
            .count()
    }

    /// The readings of every sensor, in order.
    pub fn readings(&self) -> Vec<Reading> {
        self.iter_readings().collect()
    }

    /// The readings of every sensor, in order, each made when it is asked for.
    pub fn iter_readings(&self) -> impl Iterator<Item = Reading> {
        self.points_by_quantity()
            .map(|(sensor, point, quantity)| self.reading(sensor, point, quantity))
    }

    /// The same without the parts of channels and light groups, which take most of the time.
    pub fn iter_values(&self) -> impl Iterator<Item = Reading> {
        self.points_by_quantity()
            .map(|(sensor, point, quantity)| self.value(sensor, point, quantity))
    }

    /// What there is a reading of, in order.
    fn points_by_quantity(&self) -> impl Iterator<Item = (&SensorRecord, &PointRecord, &Readout)> {
        let points = self
            .sensors
            .iter()
            .flat_map(|sensor| sensor.points.iter().map(move |point| (sensor, point)));
        points.flat_map(|(sensor, point)| {
            let quantities = sensor.quantities.iter();
            quantities.map(move |quantity| (sensor, point, quantity))
        })
    }

    fn reading(&self, sensor: &SensorRecord, point: &PointRecord, quantity: &Readout) -> Reading {
        Reading {
            channels: self.channels(point, quantity),
            groups: self.shares(point, quantity),
            ..self.value(sensor, point, quantity)
        }
    }

    /// A reading without its parts.
    fn value(&self, sensor: &SensorRecord, point: &PointRecord, quantity: &Readout) -> Reading {
        let samples = point.replicates.as_ref();
        Reading {
            sensor: match &point.about {
                Some(about) => format!("{}: {about}", sensor.name),
                None => sensor.name.clone(),
            },
            index: point.index,
            position: point.position,
            normal: point.normal,
            sits_on: point.sits_on.clone(),
            quantity: quantity.name.clone(),
            unit: quantity.unit.clone(),
            estimate: self.value_of(point, quantity),
            samples: samples.map_or(0, Replicates::total_samples),
            channels: vec![],
            groups: vec![],
            exposure: self.exposure(point, quantity),
        }
    }

    fn value_of(&self, point: &PointRecord, quantity: &Readout) -> Estimate {
        self.reading_of(point, |_, lane| quantity.weights[lane])
    }

    /// Names of the light groups, each once.
    pub fn group_names(&self) -> Vec<&String> {
        let groups = self.groups.iter().enumerate();
        let first = groups.filter(|(index, name)| !self.groups[..*index].contains(name));
        first.map(|(_, name)| name).collect()
    }

    fn exposure(&self, point: &PointRecord, quantity: &Readout) -> Option<Exposure> {
        self.dimming.interval()?;
        let weight =
            |group: usize, lane: usize| self.dimming.seconds(group) * quantity.weights[lane];
        let estimate = self.combine(point, weight);
        Some(Exposure::new(&quantity.name, &quantity.unit, estimate))
    }

    /// Each lane that has a part in the quantity.
    fn channels(&self, point: &PointRecord, quantity: &Readout) -> Vec<(String, Estimate)> {
        let lanes = self.lanes.iter().zip(&quantity.weights).enumerate();
        let channel = |wanted: usize| {
            self.reading_of(point, |_, lane| {
                f64::from(u8::from(lane == wanted)) * quantity.channel_factor
            })
        };
        lanes
            .filter(|(_, (_, weight))| **weight != 0.0)
            .map(|(index, (lane, _))| (lane.name.clone(), channel(index)))
            .collect()
    }

    /// What each light group adds to the value.
    fn shares(&self, point: &PointRecord, quantity: &Readout) -> Vec<(String, Estimate)> {
        let share = |wanted: &String| self.reading_of(point, self.share_of(wanted, quantity));
        let groups = self.group_names().into_iter();
        groups.map(|name| (name.clone(), share(name))).collect()
    }

    /// Weights of the columns of one light group, by its name.
    fn share_of(&self, name: &str, quantity: &Readout) -> impl Fn(usize, usize) -> f64 {
        move |group, lane| f64::from(u8::from(self.groups[group] == name)) * quantity.weights[lane]
    }

    /// Σ factor(group) · weight(group, lane) · column, at the moment asked for.
    fn reading_of(&self, point: &PointRecord, weight: impl Fn(usize, usize) -> f64) -> Estimate {
        self.combine(point, |group, lane| {
            self.dimming.factor(group) * weight(group, lane)
        })
    }

    /// Σ weight(group, lane) · column, exact and sampled parts together.
    fn combine(&self, point: &PointRecord, weight: impl Fn(usize, usize) -> f64) -> Estimate {
        let (exact, open) = self.weighted(point, weight);
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

    /// Σ weight(group, lane) · exact part, and the weights of those columns that have a sampled part.
    fn weighted(
        &self,
        point: &PointRecord,
        weight: impl Fn(usize, usize) -> f64,
    ) -> (f64, Vec<f64>) {
        let lanes = self.lanes.len();
        let columns = 0..point.exact.len();
        let weights: Vec<f64> = columns
            .map(|column| weight(column / lanes, column % lanes))
            .collect();
        let exact = weights.iter().zip(&point.exact).map(|(w, x)| w * x).sum();
        let open = weights.iter().zip(&point.closed);
        let open = open.map(|(weight, closed)| if *closed { 0.0 } else { *weight });
        (exact, open.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimation::Method;
    use crate::quantity::Time;
    use crate::spectrum::Lanes;
    use crate::time::{Interval, Rule, Schedule};

    /// Four replicates of 10 samples each, with the columns of two groups.
    fn replicates(columns: usize, sums: &[f64]) -> Replicates {
        let stored = serde_json::json!({
            "sensor": 0, "confidence": 0.95, "weights": vec![1.0; columns], "sums": sums,
            "samples": [10, 10, 10, 10], "largest": 1.0, "largest_of_sensor": 1.0, "converged": true,
        });
        serde_json::from_value(stored).unwrap()
    }

    fn measured(lanes: &Lanes, readout: Readout, exact: Vec<f64>, sampled: &[f64]) -> Reading {
        let closed = vec![sampled.is_empty(); exact.len()];
        measured_with(lanes, readout, exact, sampled, closed)
    }

    fn measured_with(
        lanes: &Lanes,
        readout: Readout,
        exact: Vec<f64>,
        sampled: &[f64],
        closed: Vec<bool>,
    ) -> Reading {
        measured_while(lanes, readout, (exact, closed), sampled, Dimming::default())
    }

    fn measured_while(
        lanes: &Lanes,
        readout: Readout,
        (exact, closed): (Vec<f64>, Vec<bool>),
        sampled: &[f64],
        dimming: Dimming,
    ) -> Reading {
        let replicates = (!sampled.is_empty()).then(|| replicates(exact.len(), sampled));
        let point = PointRecord {
            index: 3,
            position: Some([1.0, 2.0, 3.0]),
            normal: None,
            sits_on: None,
            about: None,
            exact,
            closed,
            replicates,
        };
        let names = lanes.names().iter().cloned();
        let measurements = Measurements {
            scene_name: "test".into(),
            seed: 1,
            confidence: 0.95,
            luminous_efficacy: None,
            max_depth: None,
            lanes: names.map(|name| LaneRecord { name }).collect(),
            groups: vec!["lamps".into(), "sky".into()],
            dimming,
            sensors: vec![SensorRecord {
                name: "desk".into(),
                quantities: vec![readout],
                layout: None,
                points: vec![point],
            }],
            unsampled: vec![],
            warnings: vec![],
            shard: None,
        };
        measurements.readings().remove(0)
    }

    fn bands() -> Lanes {
        Lanes::broadband(&["visible".into(), "nir".into()]).unwrap()
    }

    fn readout(lanes: &Lanes, photometric: bool) -> Readout {
        let names = crate::sensor::readout::IRRADIANCE;
        crate::sensor::readouts(lanes, names, !photometric, photometric, 100.0).remove(0)
    }

    /// By group and lane: lamps visible, lamps nir, sky visible, sky nir; the lamps' bands vary against each other.
    const SAMPLED: [f64; 16] = [
        10.0, 40.0, 5.0, 5.0, 20.0, 30.0, 5.0, 6.0, 30.0, 20.0, 5.0, 7.0, 40.0, 10.0, 5.0, 8.0,
    ];
    const EXACT: [f64; 4] = [100.0, 0.0, 0.0, 7.0];

    fn sum(parts: &[(String, Estimate)]) -> f64 {
        parts.iter().map(|(_, part)| part.value).sum()
    }

    #[test]
    fn bands_and_groups_add_up_to_the_value() {
        let reading = measured(&bands(), readout(&bands(), false), EXACT.to_vec(), &SAMPLED);
        assert_eq!(
            (reading.sensor.as_str(), reading.index, reading.samples),
            ("desk", 3, 40)
        );
        // Sampled means: 2.5 + 2.5 + .5 + .65.
        assert!((reading.estimate.value - (107.0 + 6.15)).abs() < 1e-12);
        assert!((sum(&reading.channels) - reading.estimate.value).abs() < 1e-12);
        assert!((sum(&reading.groups) - reading.estimate.value).abs() < 1e-12);
        let values: Vec<f64> = reading.groups.iter().map(|(_, part)| part.value).collect();
        assert!((values[0] - 105.0).abs() < 1e-12 && (values[1] - 8.15).abs() < 1e-12);
    }

    /// The lamps' visible and nir light add up to the same in every replicate: their sum has no sampling error, and only
    /// the rounding of single precision is left.
    #[test]
    fn a_sum_keeps_the_covariance_of_its_columns() {
        let reading = measured(&bands(), readout(&bands(), false), EXACT.to_vec(), &SAMPLED);
        let (lamps, visible) = (&reading.groups[0].1, &reading.channels[0].1);
        // Means 1, 2, 3, 4 (and .5 each): s² = 5/3, standard error √(5/12).
        assert!((visible.std_error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-6);
        assert!((lamps.std_error / (ROUNDING * 5.0) - 1.0).abs() < 1e-9);
        assert_eq!(lamps.method, Method::Estimate);
    }

    #[test]
    fn only_bands_with_light_are_channels_of_a_photometric_value() {
        let reading = measured(&bands(), readout(&bands(), true), EXACT.to_vec(), &SAMPLED);
        assert_eq!(
            (reading.quantity.as_str(), reading.unit.as_str()),
            ("illuminance", "lx")
        );
        let names: Vec<&str> = reading
            .channels
            .iter()
            .map(|(name, _)| name.as_str())
            .collect();
        assert_eq!(names, ["visible"]);
        assert!((reading.estimate.value - 100.0 * 103.0).abs() < 1e-9);
        assert!((sum(&reading.channels) - reading.estimate.value).abs() < 1e-9);
    }

    #[test]
    fn an_rgb_value_is_the_luminance_weighted_mean_of_its_channels() {
        let lanes = Lanes::rgb();
        let exact = vec![1.0, 2.0, 3.0, 10.0, 20.0, 30.0];
        for (photometric, factor) in [(false, 1.0), (true, 100.0)] {
            let reading = measured(&lanes, readout(&lanes, photometric), exact.clone(), &[]);
            let channels: Vec<f64> = reading
                .channels
                .iter()
                .map(|(_, part)| part.value)
                .collect();
            assert_eq!(channels, [11.0, 22.0, 33.0].map(|lane| lane * factor));
            let mean = 0.2126 * channels[0] + 0.7152 * channels[1] + 0.0722 * channels[2];
            assert!((reading.estimate.value - mean).abs() < 1e-9);
            assert!((sum(&reading.groups) - mean).abs() < 1e-9);
        }
    }

    /// The first group is known; what its columns hold of samples does not count.
    #[test]
    fn a_closed_group_has_no_error_beside_a_sampled_one() {
        let closed = vec![true, true, false, false];
        let readout = readout(&bands(), false);
        let reading = measured_with(&bands(), readout, EXACT.to_vec(), &SAMPLED, closed);
        let (lamps, sky) = (&reading.groups[0].1, &reading.groups[1].1);
        assert_eq!(*lamps, Estimate::closed_form(100.0));
        assert!((sky.value - 8.15).abs() < 1e-12 && sky.std_error > 0.01);
        assert!((reading.estimate.value - 108.15).abs() < 1e-12);
    }

    /// The lamps at half for eight hours, the sky at a quarter.
    fn eight_hours() -> Dimming {
        let constant = |factor: f64| {
            let points = [(Time::ZERO, factor), (Time::from_hours(8.0), factor)];
            Schedule::new(points, Rule::Held, None).unwrap()
        };
        let groups = ["lamps".to_owned(), "sky".to_owned()];
        let dimming = Dimming::new(vec![Some(constant(0.5)), Some(constant(0.25))]);
        let day = Interval::lasting(Time::from_hours(8.0), Time::ZERO).unwrap();
        let dimming = dimming.over(day, &groups).unwrap();
        dimming.at(Time::from_hours(1.0), &groups).unwrap()
    }

    /// Of the lamps' 105 and the sky's 8.15: the lamps' bands cancel in every replicate, so that the error is that of the sky's
    /// nir alone, whose means are .5, .6, .7, .8: √(.05/3/4).
    #[test]
    fn schedules_weigh_groups_in_every_replicate() {
        let (lanes, closed) = (bands(), vec![false; 4]);
        let reading = measured_while(
            &lanes,
            readout(&lanes, false),
            (EXACT.to_vec(), closed),
            &SAMPLED,
            eight_hours(),
        );
        let close = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-5;
        let sky_error = (0.05_f64 / 12.0).sqrt();
        assert!(close(reading.estimate.value, 0.5 * 105.0 + 0.25 * 8.15));
        assert!(close(reading.estimate.std_error, 0.25 * sky_error));
        assert!(close(sum(&reading.groups), reading.estimate.value));
        assert!(close(sum(&reading.channels), reading.estimate.value));
        let exposure = reading.exposure.unwrap();
        let hours = exposure.in_hours.unwrap().1;
        assert!(close(hours.value, 4.0 * 105.0 + 2.0 * 8.15));
        assert!(close(hours.std_error, 2.0 * sky_error));
        assert!(close(exposure.estimate.value, 3600.0 * hours.value));
        assert_eq!(exposure.unit, "J/m2");
    }

    /// Of the lamps' 105 and the sky's 8.15, dimmed in two steps; what the bands of the lamps share still cancels.
    #[test]
    fn dimmed_groups_keep_their_covariances() {
        let groups = ["lamps".to_owned(), "sky".to_owned()];
        let half = Dimming::default().relit("sky", 0.5, &groups).unwrap();
        let dimming = half.relit("sky", 0.5, &groups).unwrap();
        let dimming = dimming.relit("lamps", 2.0, &groups).unwrap();
        assert_eq!(dimming.levels(&groups), [("lamps", 2.0), ("sky", 0.25)]);
        let lanes = bands();
        let columns = (EXACT.to_vec(), vec![false; 4]);
        let readout = readout(&lanes, false);
        let reading = measured_while(&lanes, readout, columns, &SAMPLED, dimming);
        let close = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-5;
        assert!(close(reading.estimate.value, 2.0 * 105.0 + 0.25 * 8.15));
        assert!(close(
            reading.estimate.std_error,
            0.25 * (0.05_f64 / 12.0).sqrt()
        ));
        assert!(close(sum(&reading.groups), reading.estimate.value));
    }

    #[test]
    fn light_that_is_not_there_cannot_be_dimmed() {
        let groups = ["lamps".to_owned()];
        let relit = |name, factor| Dimming::default().relit(name, factor, &groups);
        assert_eq!(
            relit("sky", 0.5),
            Err(RelightError::UnknownGroup("sky".into()))
        );
        for factor in [-0.1, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                relit("lamps", factor),
                Err(RelightError::Factor { .. })
            ));
        }
    }

    #[test]
    fn a_schedule_that_is_too_short_is_told_with_its_group() {
        let groups = ["lamps".to_owned(), "sky".to_owned()];
        let fault = eight_hours()
            .at(Time::from_hours(9.0), &groups)
            .unwrap_err();
        assert_eq!(
            fault.to_string(),
            "the schedule of a light in group `lamps`: 32400 s was asked for, but the record goes from 0 s to 28800 s"
        );
    }

    #[test]
    fn what_needs_no_sampling_has_no_error() {
        let reading = measured(&bands(), readout(&bands(), false), EXACT.to_vec(), &[]);
        assert_eq!(reading.estimate, Estimate::closed_form(107.0));
        assert_eq!(reading.samples, 0);
    }
}
