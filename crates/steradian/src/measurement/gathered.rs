//! What is known of all points of a run although they come block after block and are forgotten: sums, extremes, and what was missed.
//!
//! Mean and extremes with each replicate left out, of which errors [are made](crate::estimation::jackknife), need one sum and two readings a
//! replicate, however many points there are; added in the order of the points they are the same bits as from all points at once.

use super::resampled::{Row, Sampling};
use super::statistics::{Extreme, Statistics};
use super::{Measurements, PointRecord, SensorRecord};
use crate::estimation::{Estimate, LargestSamples};
use crate::sensor::Readout;

/// What the blocks of a run have in common.
#[derive(Clone, Debug, Default)]
pub struct Gathered {
    missed: usize,
    largest: LargestSamples,
    sensors: Vec<OfSensor>,
}

#[derive(Clone, Debug)]
struct OfSensor {
    name: String,
    points: usize,
    quantities: Vec<OfQuantity>,
}

#[derive(Clone, Debug)]
struct OfQuantity {
    confidence: f64,
    quantity: String,
    unit: String,
    whole: Spread,
    groups: Vec<(String, Spread)>,
}

impl Gathered {
    /// Of measurements in one piece.
    pub fn of(measurements: &Measurements) -> Self {
        let mut gathered = Self::default();
        gathered.add(measurements);
        gathered
    }

    /// Takes notice of the next block.
    pub fn add(&mut self, block: &Measurements) {
        self.missed += block.missed();
        block
            .replicates()
            .for_each(|stream| self.largest.see(stream));
        for sensor in &block.sensors {
            if !self.goes_on(sensor) {
                self.sensors.push(OfSensor::new(block, sensor));
            }
            if let Some(gathered) = self.sensors.last_mut() {
                gathered.add(block, sensor);
            }
        }
    }

    fn goes_on(&self, sensor: &SensorRecord) -> bool {
        let last = self.sensors.last();
        sensor.goes_on() && last.is_some_and(|last| last.name == sensor.name)
    }

    /// Number of readings that did not meet their tolerance.
    pub fn missed(&self) -> usize {
        self.missed
    }

    /// The statistics of every quantity of each sensor that has several points.
    pub fn statistics(&self) -> Vec<Statistics> {
        let sensors = self.sensors.iter().filter(|sensor| sensor.points > 1);
        let of_sensor = |sensor: &OfSensor| -> Vec<_> {
            let quantities = sensor.quantities.iter();
            quantities
                .map(|quantity| quantity.statistics(&sensor.name, sensor.points))
                .collect()
        };
        sensors.flat_map(of_sensor).collect()
    }

    /// Tells the streams of a block the largest sample that was seen in any block of their sensor.
    pub fn share_largest(&self, block: &mut Measurements) {
        block
            .replicates_mut()
            .for_each(|stream| self.largest.tell(stream));
    }
}

impl OfSensor {
    fn new(run: &Measurements, sensor: &SensorRecord) -> Self {
        let quantities = sensor.quantities.iter();
        Self {
            name: sensor.name.clone(),
            points: 0,
            quantities: quantities
                .map(|quantity| OfQuantity::new(run, quantity))
                .collect(),
        }
    }

    fn add(&mut self, run: &Measurements, sensor: &SensorRecord) {
        for (gathered, quantity) in self.quantities.iter_mut().zip(&sensor.quantities) {
            let points = (self.points..).zip(&sensor.points);
            points.for_each(|(number, point)| gathered.add(run, quantity, (number, point)));
        }
        self.points += sensor.points.len();
    }
}

impl OfQuantity {
    fn new(run: &Measurements, quantity: &Readout) -> Self {
        let groups = run.group_names().into_iter();
        Self {
            confidence: run.confidence,
            quantity: quantity.name.clone(),
            unit: quantity.unit.clone(),
            whole: Spread::default(),
            groups: groups
                .map(|name| (name.clone(), Spread::default()))
                .collect(),
        }
    }

    fn add(
        &mut self,
        run: &Measurements,
        quantity: &Readout,
        (number, point): (usize, &PointRecord),
    ) {
        let row = run.row(point, |_, lane| quantity.weights[lane]);
        self.whole.add(number, point, &row);
        for (name, share) in &mut self.groups {
            let row = run.row(point, run.share_of(name, quantity));
            share.add(number, point, &row);
        }
    }

    fn statistics(&self, sensor: &str, points: usize) -> Statistics {
        let count = points as f64;
        let estimate =
            |function: &dyn Fn(&Sums) -> f64| self.whole.estimate(self.confidence, function);
        let ratio = |below: f64, function: &dyn Fn(&Sums) -> f64| {
            (below != 0.0).then(|| estimate(function))
        };
        let whole = &self.whole.whole;
        let extreme = |place: Place, estimate| Extreme {
            index: place.index,
            position: place.position,
            estimate,
        };
        let share = |(name, share): &(String, Spread)| {
            let mean = share.estimate(self.confidence, &|sums| sums.mean(count));
            (name.clone(), mean)
        };
        Statistics {
            sensor: sensor.to_owned(),
            quantity: self.quantity.clone(),
            unit: self.unit.clone(),
            points,
            mean: estimate(&|sums| sums.mean(count)),
            min: extreme(self.whole.lowest, estimate(&|sums| sums.least)),
            max: extreme(self.whole.highest, estimate(&|sums| sums.greatest)),
            uniformity: ratio(whole.mean(count), &|sums| sums.least / sums.mean(count)),
            diversity: ratio(whole.greatest, &|sums| sums.least / sums.greatest),
            groups: self.groups.iter().map(share).collect(),
        }
    }
}

/// Readings of points so far: sum and extremes.
#[derive(Clone, Copy, Debug)]
struct Sums {
    sum: f64,
    least: f64,
    greatest: f64,
}

impl Sums {
    fn of(first: f64) -> Self {
        Self {
            sum: first,
            least: first,
            greatest: first,
        }
    }

    fn add(&mut self, value: f64) {
        self.sum += value;
        if value < self.least {
            self.least = value;
        }
        if value > self.greatest {
            self.greatest = value;
        }
    }

    fn mean(&self, points: f64) -> f64 {
        self.sum / points
    }
}

/// Which point, and where.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    index: usize,
    position: Option<[f64; 3]>,
}

/// Readings of points so far, from all replicates and with each left out.
#[derive(Clone, Debug)]
struct Spread {
    whole: Sums,
    without: Vec<Sums>,
    sampling: Sampling,
    lowest: Place,
    highest: Place,
}

impl Default for Spread {
    fn default() -> Self {
        Self {
            whole: Sums::of(0.0),
            without: vec![],
            sampling: Sampling::NONE,
            lowest: Place::default(),
            highest: Place::default(),
        }
    }
}

impl Spread {
    /// Adds the reading of the point of this number.
    fn add(&mut self, number: usize, point: &PointRecord, row: &Row) {
        self.agree_on_replicates(row);
        let value = row.value();
        let place = Place {
            index: point.index,
            position: point.position,
        };
        if number == 0 || value < self.whole.least {
            self.lowest = place;
        }
        if number == 0 || value > self.whole.greatest {
            self.highest = place;
        }
        let add = |sums: &mut Sums, value: f64| match number {
            0 => *sums = Sums::of(value),
            _ => sums.add(value),
        };
        add(&mut self.whole, value);
        let without = self.without.iter_mut().enumerate();
        without.for_each(|(left_out, sums)| add(sums, row.without(left_out)));
        self.sampling = self.sampling.and(row);
    }

    /// As many replicates can be left out as all sampled points have; those before the first one have none to leave out.
    fn agree_on_replicates(&mut self, row: &Row) {
        let Some(means) = &row.means else {
            return;
        };
        if self.sampling.any {
            self.without.truncate(means.len());
        } else {
            self.without = vec![self.whole; means.len()];
        }
    }

    fn estimate(&self, confidence: f64, function: &dyn Fn(&Sums) -> f64) -> Estimate {
        let without: Vec<f64> = self.without.iter().map(function).collect();
        let value = function(&self.whole);
        self.sampling.estimate(value, &without, confidence)
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::Synthetic;
    use super::*;

    /// A block of some points of the one sensor.
    fn block(run: &Measurements, points: std::ops::Range<usize>) -> Measurements {
        let mut block = run.clone();
        block.sensors[0].points = run.sensors[0].points[points].to_vec();
        block
    }

    fn in_blocks(run: &Measurements, of: usize) -> Gathered {
        let mut gathered = Gathered::default();
        let count = run.sensors[0].points.len();
        for first in (0..count).step_by(of) {
            gathered.add(&block(run, first..(first + of).min(count)));
        }
        gathered
    }

    /// Among them points known exactly, before sampled ones and after.
    fn run() -> Measurements {
        let truth = [3.0, 1.0, 4.0, 1.5, 9.0, 2.6, 5.0].map(|x| [x, 0.1 * x]);
        let mut run = Synthetic::new(&["lamp", "window"], &truth).sampled(3, 0.2);
        let closed = Synthetic::new(&["lamp", "window"], &truth).closed();
        for number in [0, 1, 4] {
            run.sensors[0].points[number] = closed.sensors[0].points[number].clone();
        }
        run
    }

    #[test]
    fn blocks_have_the_statistics_of_the_whole_bit_for_bit() {
        let run = run();
        let whole = Gathered::of(&run);
        for of in 1..=7 {
            let gathered = in_blocks(&run, of);
            assert_eq!(gathered.statistics(), whole.statistics(), "{of}");
            assert_eq!(gathered.missed(), whole.missed());
            assert_eq!(gathered.largest, whole.largest);
        }
    }

    #[test]
    fn extremes_are_where_the_readings_are_least_and_greatest() {
        let run = run();
        let found = &Gathered::of(&run).statistics()[0];
        let readings = run.readings();
        let values = readings.iter().map(|reading| reading.estimate.value);
        let least = values.clone().fold(f64::INFINITY, f64::min);
        let greatest = values.fold(0.0, f64::max);
        assert_eq!(found.min.estimate.value, least);
        assert_eq!(found.max.estimate.value, greatest);
        assert_eq!(readings[found.min.index].estimate.value, least);
        assert_eq!(readings[found.max.index].position, found.max.position);
    }

    /// Samples that were never taken leave the error unknown, not zero.
    #[test]
    fn a_point_without_samples_makes_errors_unknown() {
        let mut run = run();
        let mut stored = serde_json::to_value(&run.sensors[0].points[2]).unwrap();
        stored["replicates"]["samples"] = serde_json::json!(vec![0; 16]);
        run.sensors[0].points[2] = serde_json::from_value(stored).unwrap();
        let mean = Gathered::of(&run).statistics()[0].mean;
        assert!(mean.std_error.is_infinite() && !mean.converged);
    }
}
