//! The result of one stream: the sums of its replicates, by column.
//!
//! They are kept, and not only their mean and spread, so that sums, differences and re-weighted columns of one stream (channels,
//! light groups, dimmed lamps) get the error they have with their covariances.

use serde::{Deserialize, Serialize};

use super::cells::{Cells, mean_and_variance};
use super::{Estimate, Integrand, Plan, student};

/// A sample with more than this part of the sum is a sign of rare bright paths.
const FLAGGED_PART: f64 = 0.05;
/// −ln(1 − .95): N samples that are all dark leave, at 95 %, at most this many lit ones per N.
const UNSEEN: f64 = 2.995_732_273_553_991;

/// Replicate sums of one stream.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Replicates {
    pub(super) sensor: usize,
    pub(super) confidence: f64,
    /// Weights of the columns in the scalar of the tolerance.
    pub(super) weights: Vec<f64>,
    /// Sums by replicate and column.
    pub(super) sums: Vec<f64>,
    /// Samples by replicate; none where another shard has them.
    pub(super) samples: Vec<u64>,
    /// Largest magnitude of the scalar of one sample, in this stream and in all streams of the sensor.
    pub(super) largest: f64,
    pub(super) largest_of_sensor: f64,
    pub(super) converged: bool,
}

impl Replicates {
    pub(super) fn new<I: Integrand>(
        integrand: &I,
        plan: &Plan,
        cells: &Cells,
        stream: usize,
        converged: bool,
    ) -> Self {
        Self {
            sensor: integrand.sensor_of(stream),
            confidence: plan.confidence,
            weights: integrand.weights(stream).to_vec(),
            sums: cells.sums(stream).to_vec(),
            samples: cells.samples(stream).to_vec(),
            largest: cells.largest(stream),
            largest_of_sensor: 0.0,
            converged,
        }
    }

    /// Whether sums, samples and confidence are such as a run of so many columns has.
    pub(crate) fn are_of(&self, columns: usize) -> bool {
        let cells = self.samples.len() * columns;
        // A run that was stopped need not have come to it.
        let sampled = self.samples.iter().any(|samples| *samples > 0)
            || self.sums.iter().all(|sum| *sum == 0.0);
        let within = self.confidence > 0.0 && self.confidence < 1.0;
        self.columns() == columns && self.sums.len() == cells && sampled && within
    }

    /// Number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.weights.len()
    }

    /// Samples of each replicate.
    #[must_use]
    pub fn samples(&self) -> &[u64] {
        &self.samples
    }

    /// Samples of all replicates.
    #[must_use]
    pub fn total_samples(&self) -> u64 {
        self.samples.iter().sum()
    }

    /// Whether the tolerance was met, or, without one, whether the run was complete.
    #[must_use]
    pub fn converged(&self) -> bool {
        self.converged
    }

    /// Whether one sample alone made up more than 5 % of the sum: a sign of rare, bright paths, whose error is easily underrated.
    #[must_use]
    pub fn flagged(&self) -> bool {
        let sum: f64 = self
            .sums
            .chunks(self.columns())
            .map(|sums| dot(sums, &self.weights))
            .sum();
        self.largest > FLAGGED_PART * sum.abs()
    }

    /// The weighted sum of columns of each replicate that has samples.
    pub fn means<'a>(&'a self, weights: &'a [f64]) -> impl Iterator<Item = f64> + Clone + 'a {
        let cells = self.sums.chunks(self.columns()).zip(&self.samples);
        cells
            .filter(|(_, samples)| **samples > 0)
            .map(|(sums, samples)| dot(sums, weights) / *samples as f64)
    }

    /// The weighted sum of columns with its error.
    ///
    /// Where every replicate is zero the error is unknown: `std_error` is infinite, there is no interval, and `converged` is false. `upper_bound` then is 3/N times the largest
    /// sample seen in any stream of the sensor: with N dark samples, lit ones are at 95 % confidence rarer than 3/N (as if they
    /// were independent; a net does better), and *assumed* no brighter than that sample. Columns are assumed not to be negative.
    /// If nothing was seen in the whole sensor, there is no bound.
    ///
    /// # Panics
    /// If `weights` is not as long as there are columns.
    #[must_use]
    pub fn combine(&self, weights: &[f64]) -> Estimate {
        assert_eq!(weights.len(), self.columns(), "a weight for every column");
        let means: Vec<f64> = self.means(weights).collect();
        let (value, variance) = mean_and_variance(means.iter().copied());
        if means.iter().all(|mean| *mean == 0.0) {
            let unknown = Estimate::sampled(0.0, f64::INFINITY, 1.0, false);
            return Estimate {
                upper_bound: self.bound(weights),
                ..unknown
            };
        }
        Estimate::sampled(
            value,
            variance.sqrt(),
            self.factor(means.len()),
            self.converged,
        )
    }

    fn factor(&self, replicates: usize) -> f64 {
        if replicates < 2 {
            f64::INFINITY
        } else {
            student::two_sided_quantile(self.confidence, replicates as u32 - 1)
        }
    }

    fn bound(&self, weights: &[f64]) -> Option<f64> {
        let parts = weights
            .iter()
            .zip(&self.weights)
            .filter(|(weight, _)| **weight != 0.0);
        let scale = parts.map(|(weight, own)| weight / own).fold(0.0, f64::max);
        let bound = UNSEEN / self.total_samples() as f64 * self.largest_of_sensor * scale;
        (bound > 0.0 && bound.is_finite()).then_some(bound)
    }
}

fn dot(sums: &[f64], weights: &[f64]) -> f64 {
    sums.iter()
        .zip(weights)
        .map(|(sum, weight)| sum * weight)
        .sum()
}

/// Tells every stream the largest sample of its sensor.
pub(super) fn share_largest(streams: &mut [Replicates]) {
    let mut largest = LargestSamples::default();
    streams.iter().for_each(|stream| largest.see(stream));
    streams.iter_mut().for_each(|stream| largest.tell(stream));
}

/// The largest sample of each sensor of a run: what bounds the streams in which nothing was seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LargestSamples(Vec<f64>);

impl LargestSamples {
    /// Takes notice of a stream.
    pub fn see(&mut self, stream: &Replicates) {
        if self.0.len() <= stream.sensor {
            self.0.resize(stream.sensor + 1, 0.0);
        }
        let largest = &mut self.0[stream.sensor];
        *largest = largest.max(stream.largest);
    }

    /// Tells a stream what was seen of its sensor.
    pub fn tell(&self, stream: &mut Replicates) {
        let largest = self.0.get(stream.sensor);
        stream.largest_of_sensor = largest.copied().unwrap_or(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn replicates(sums: &[f64], columns: usize) -> Replicates {
        Replicates {
            sensor: 0,
            confidence: 0.95,
            weights: vec![1.0; columns],
            sums: sums.to_vec(),
            samples: vec![10; sums.len() / columns],
            largest: 1.0,
            largest_of_sensor: 50.0,
            converged: true,
        }
    }

    #[test]
    fn four_replicates_by_hand() {
        // Means 1, 2, 3, 4: s² = 5/3, standard error √(5/12), t(3) = 3.18245.
        let estimate = replicates(&[10.0, 20.0, 30.0, 40.0], 1).combine(&[1.0]);
        assert_eq!(estimate.value, 2.5);
        assert!((estimate.std_error - 0.645_497_224_367_903).abs() < 1e-15);
        let [low, high] = estimate.interval.unwrap();
        assert!((high - low - 2.0 * 3.182_446_305_284 * estimate.std_error).abs() < 1e-9);
    }

    #[test]
    fn a_sum_of_columns_keeps_their_covariance() {
        let two = replicates(&[10.0, -10.0, 20.0, -20.0, 30.0, -20.0], 2);
        let sum = two.combine(&[1.0, 1.0]);
        assert!((sum.value - 1.0 / 3.0).abs() < 1e-15);
        assert!((sum.std_error - 1.0 / 3.0).abs() < 1e-15);
        assert!(two.combine(&[1.0, 0.0]).std_error > sum.std_error);
    }

    #[test]
    fn nothing_seen_is_a_bound_and_never_zero_plus_minus_zero() {
        let dark = replicates(&[0.0; 8], 2).combine(&[2.0, 0.0]);
        assert_eq!((dark.interval, dark.converged), (None, false));
        assert!((dark.upper_bound.unwrap() - 2.0 * 50.0 * UNSEEN / 40.0).abs() < 1e-12);
        let mut alone = replicates(&[0.0; 8], 2);
        share_largest(std::slice::from_mut(&mut alone));
        alone.largest_of_sensor = 0.0;
        assert_eq!(alone.combine(&[1.0, 1.0]).upper_bound, None);
    }

    #[test]
    fn one_replicate_has_no_error_bar() {
        let single = replicates(&[5.0], 1).combine(&[1.0]);
        assert_eq!(
            (single.value, single.interval, single.converged),
            (0.5, None, false)
        );
        assert!(single.std_error.is_infinite());
    }

    #[test]
    fn a_dominant_sample_is_flagged() {
        let mut stream = replicates(&[10.0, 10.0], 1);
        assert!(!stream.flagged());
        stream.largest = 1.01;
        assert!(stream.flagged());
    }
}
