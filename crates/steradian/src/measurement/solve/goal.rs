//! A target with the readings that it is about.

use super::least_squares::Row;
use super::{Achieved, Relation, SolveError, Target, TargetOf, Vary};
use crate::measurement::resampled::Resampled;
use crate::measurement::statistics::{highest, lowest, mean};
use crate::measurement::{Measurements, SensorRecord};

/// A target is met when it is missed by no more than this part, which is far below any error and far above rounding.
const MET: f64 = 1e-9;

/// A target and the readings it is about.
pub(super) struct Goal<'a> {
    target: &'a Target,
    unit: &'a str,
    /// At the points that it may be about.
    base: Resampled,
    parts: Vec<Resampled>,
}

impl Measurements {
    pub(super) fn goal<'a>(
        &'a self,
        target: &'a Target,
        vary: &[Vary],
    ) -> Result<Goal<'a>, SolveError> {
        let missing = |what: String| SolveError::Missing {
            sensor: target.sensor.clone(),
            what,
        };
        let mut sensors = self.sensors.iter();
        let sensor: &SensorRecord = sensors
            .find(|sensor| sensor.name == target.sensor)
            .ok_or_else(|| SolveError::UnknownSensor(target.sensor.clone()))?;
        let quantity = sensor
            .quantities
            .get(target.quantity)
            .ok_or_else(|| missing(format!("quantity {}", target.quantity)))?;
        let points = match target.of {
            TargetOf::Point(index) => sensor.points.get(index).map(std::slice::from_ref),
            _ => Some(&sensor.points[..]),
        };
        let points = points.ok_or_else(|| {
            let last = sensor.points.len().saturating_sub(1);
            missing(format!("such point; the last one is {last}"))
        })?;
        let unknown = |vary: &&Vary| !self.groups.contains(&vary.group);
        if let Some(vary) = vary.iter().find(unknown) {
            return Err(SolveError::UnknownGroup(vary.group.clone()));
        }
        let of = |chosen: &dyn Fn(&String) -> bool| {
            self.resampled(points, |group, lane| {
                let chosen = f64::from(u8::from(chosen(&self.groups[group])));
                chosen * quantity.weights[lane]
            })
        };
        let varies = |name: &String| vary.iter().any(|vary| vary.group == *name);
        Ok(Goal {
            target,
            unit: &quantity.unit,
            base: of(&|name| !varies(name)),
            parts: vary
                .iter()
                .map(|vary| of(&|name| vary.group == *name))
                .collect(),
        })
    }
}

impl Goal<'_> {
    pub fn replicates(&self) -> usize {
        let parts = self.parts.iter().chain([&self.base]);
        parts.map(Resampled::replicates).max().unwrap_or(0)
    }

    /// Whether the group of this number adds nothing to what the target is about.
    pub fn is_without(&self, number: usize) -> bool {
        let values = self.parts[number].values(None);
        values.iter().all(|value| *value == 0.0)
    }

    fn readings(&self, factors: &[f64], left_out: Option<usize>) -> Vec<f64> {
        let mut readings = self.base.values(left_out).to_vec();
        for (part, factor) in self.parts.iter().zip(factors) {
            let values = readings.iter_mut().zip(part.values(left_out));
            values.for_each(|(sum, value)| *sum += factor * value);
        }
        readings
    }

    /// Which of its points the target is about with these factors; none if it is about all that there are.
    pub fn point(&self, factors: &[f64], left_out: Option<usize>) -> Option<usize> {
        match self.target.of {
            TargetOf::Mean | TargetOf::Point(_) => None,
            TargetOf::Min => Some(lowest(&self.readings(factors, left_out))),
            TargetOf::Max => Some(highest(&self.readings(factors, left_out))),
        }
    }

    pub fn row(&self, point: Option<usize>, left_out: Option<usize>) -> Row {
        let at = |values: &Resampled| {
            let values = values.values(left_out);
            point.map_or_else(|| mean(values), |index| values[index])
        };
        let coefficients: Vec<f64> = self.parts.iter().map(at).collect();
        let wanted = self.target.value - at(&self.base);
        let largest = coefficients
            .iter()
            .fold(0.0_f64, |most, a| most.max(a.abs()));
        let size = self.target.value.abs();
        let scale = if size > 0.0 {
            size
        } else {
            largest.max(f64::MIN_POSITIVE)
        };
        let coefficients = coefficients.iter().map(|a| a / scale).collect();
        (coefficients, wanted / scale)
    }

    fn reading(&self, factors: &[f64], left_out: Option<usize>) -> f64 {
        let readings = self.readings(factors, left_out);
        self.point(factors, left_out)
            .map_or_else(|| mean(&readings), |point| readings[point])
    }

    /// By how much the target is missed, relative to it.
    fn missed(&self, reading: f64) -> f64 {
        let wanted = self.target.value;
        let off = (reading - wanted) / wanted.abs().max(f64::MIN_POSITIVE);
        match self.target.relation {
            Relation::Equal => off.abs(),
            Relation::AtLeast => (-off).max(0.0),
            Relation::AtMost => off.max(0.0),
        }
    }

    /// Whether the target has a say with these factors: an inequality only where it is broken or, if it had one, where it is just kept.
    pub fn pulls(&self, pulled: bool, factors: &[f64], left_out: Option<usize>) -> bool {
        let reading = self.reading(factors, left_out);
        let off =
            (reading - self.target.value).abs() / self.target.value.abs().max(f64::MIN_POSITIVE);
        match self.target.relation {
            Relation::Equal => true,
            _ => self.missed(reading) > MET || (pulled && off <= MET),
        }
    }

    pub fn achieved(&self, factors: &[f64], confidence: f64) -> Achieved {
        let reading = self.base.plus(&self.parts, factors);
        let reading = reading.estimate(confidence, |readings| match self.target.of {
            TargetOf::Mean | TargetOf::Point(_) => mean(readings),
            TargetOf::Min => readings[lowest(readings)],
            TargetOf::Max => readings[highest(readings)],
        });
        Achieved {
            target: self.target.clone(),
            unit: self.unit.to_owned(),
            met: self.missed(reading.value) <= MET,
            reading,
        }
    }
}
