//! The readings of all points of a sensor, whole and with each replicate left out: what errors of minima, ratios and solved
//! factors are made from.
//!
//! The random numbers of each point are keyed by its own number, so that points are independent. Leaving out the replicate r
//! of all points at once holds whether they are or not: the R vectors of readings are independent of each other.

use super::{Measurements, PointRecord, ROUNDING};
use crate::estimation::{Estimate, Replicates, jackknife};

/// A weighted sum of columns at every point of a sensor.
#[derive(Clone, Debug)]
pub(super) struct Resampled {
    /// From all replicates, by point.
    whole: Vec<f64>,
    /// By replicate left out, by point; empty if nothing was sampled.
    without: Vec<Vec<f64>>,
    converged: bool,
    /// Sampled, but nothing was seen anywhere.
    unseen: bool,
}

/// One point: its exact part and the mean of each replicate.
struct Row {
    exact: f64,
    means: Option<Vec<f64>>,
    converged: bool,
}

impl Resampled {
    fn new(rows: &[Row]) -> Self {
        let whole = rows.iter().map(|row| row.exact + row.mean()).collect();
        let sampled = || rows.iter().filter_map(|row| row.means.as_ref());
        let replicates = sampled().map(Vec::len).min().unwrap_or(0);
        let without = |left_out: usize| rows.iter().map(|row| row.without(left_out)).collect();
        let is_dark = sampled().flatten().all(|mean| *mean == 0.0);
        Self {
            whole,
            without: (0..replicates).map(without).collect(),
            converged: rows.iter().all(|row| row.converged),
            unseen: sampled().next().is_some() && is_dark,
        }
    }

    /// Replicates that can be left out.
    pub fn replicates(&self) -> usize {
        self.without.len()
    }

    /// By point, with this replicate left out.
    pub fn values(&self, left_out: Option<usize>) -> &[f64] {
        let without = left_out.and_then(|replicate| self.without.get(replicate));
        without.unwrap_or(&self.whole)
    }

    /// These readings and others, each times a factor.
    pub fn plus(&self, others: &[Self], factors: &[f64]) -> Self {
        let all = || others.iter().chain([self]);
        let replicates = all().map(Self::replicates).max().unwrap_or(0);
        let sum = |left_out: Option<usize>| {
            let mut sum = self.values(left_out).to_vec();
            for (other, factor) in others.iter().zip(factors) {
                let values = sum.iter_mut().zip(other.values(left_out));
                values.for_each(|(sum, value)| *sum += factor * value);
            }
            sum
        };
        Self {
            whole: sum(None),
            without: (0..replicates).map(|r| sum(Some(r))).collect(),
            converged: all().all(|part| part.converged),
            unseen: all().all(|part| part.unseen),
        }
    }

    /// A function of the readings, with its error.
    pub fn estimate(&self, confidence: f64, function: impl Fn(&[f64]) -> f64) -> Estimate {
        let value = function(&self.whole);
        if self.without.is_empty() {
            return Estimate::closed_form(value);
        }
        let without: Vec<f64> = self.without.iter().map(|values| function(values)).collect();
        let known = if self.unseen { &[] } else { &without[..] };
        let found = jackknife(value, known, confidence, self.converged);
        found.widened(ROUNDING * value.abs())
    }
}

impl Row {
    fn mean(&self) -> f64 {
        let means = self.means.as_deref().unwrap_or(&[]);
        means.iter().sum::<f64>() / means.len().max(1) as f64
    }

    fn without(&self, left_out: usize) -> f64 {
        let Some(means) = &self.means else {
            return self.exact;
        };
        let others = means.iter().enumerate().filter(|(r, _)| *r != left_out);
        let sum: f64 = others.map(|(_, mean)| mean).sum();
        self.exact + sum / means.len().saturating_sub(1).max(1) as f64
    }
}

impl Measurements {
    /// Σ factor(group) · weight(group, lane) · column at points of a sensor, at the moment asked for.
    pub(super) fn resampled(
        &self,
        points: &[PointRecord],
        weight: impl Fn(usize, usize) -> f64,
    ) -> Resampled {
        let weight = |group, lane| self.dimming.factor(group) * weight(group, lane);
        let row = |point: &PointRecord| {
            let (exact, open) = self.weighted(point, weight);
            let sampled = point.replicates.as_ref();
            let sampled = sampled.filter(|_| open.iter().any(|weight| *weight != 0.0));
            Row {
                exact,
                means: sampled.map(|replicates| replicates.means(&open).collect()),
                converged: sampled.is_none_or(Replicates::converged),
            }
        };
        Resampled::new(&points.iter().map(row).collect::<Vec<_>>())
    }
}
