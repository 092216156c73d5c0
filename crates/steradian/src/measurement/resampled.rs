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
    sampling: Sampling,
}

/// One point: its exact part and the mean of each replicate.
pub(super) struct Row {
    exact: f64,
    pub means: Option<Vec<f64>>,
    pub converged: bool,
}

/// How a number of several points was sampled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sampling {
    /// Any of them was.
    pub any: bool,
    /// Something was seen.
    pub seen: bool,
    pub converged: bool,
}

impl Sampling {
    /// Of no points.
    pub const NONE: Self = Self {
        any: false,
        seen: false,
        converged: true,
    };

    /// Of these points and one more.
    pub fn and(self, row: &Row) -> Self {
        let means = row.means.as_deref();
        Self {
            any: self.any || means.is_some(),
            seen: self.seen || means.is_some_and(|means| means.iter().any(|mean| *mean != 0.0)),
            converged: self.converged && row.converged,
        }
    }

    fn or(self, other: Self) -> Self {
        Self {
            any: self.any || other.any,
            seen: self.seen || other.seen,
            converged: self.converged && other.converged,
        }
    }

    /// A number with its error, from what it is with each replicate left out.
    pub fn estimate(self, value: f64, without: &[f64], confidence: f64) -> Estimate {
        if !self.any {
            return Estimate::closed_form(value);
        }
        let known = if self.seen { without } else { &[] };
        jackknife(value, known, confidence, self.converged).widened(ROUNDING * value.abs())
    }
}

impl Resampled {
    fn new(rows: &[Row]) -> Self {
        let whole = rows.iter().map(Row::value).collect();
        let sampled = || rows.iter().filter_map(|row| row.means.as_ref());
        let replicates = sampled().map(Vec::len).min().unwrap_or(0);
        let without = |left_out: usize| rows.iter().map(|row| row.without(left_out)).collect();
        Self {
            whole,
            without: (0..replicates).map(without).collect(),
            sampling: rows.iter().fold(Sampling::NONE, Sampling::and),
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
            sampling: all().fold(Sampling::NONE, |sum, part| sum.or(part.sampling)),
        }
    }

    /// A function of the readings, with its error.
    pub fn estimate(&self, confidence: f64, function: impl Fn(&[f64]) -> f64) -> Estimate {
        let without: Vec<f64> = self.without.iter().map(|values| function(values)).collect();
        let value = function(&self.whole);
        self.sampling.estimate(value, &without, confidence)
    }
}

impl Row {
    /// The reading.
    pub fn value(&self) -> f64 {
        self.exact + self.mean()
    }

    fn mean(&self) -> f64 {
        let means = self.means.as_deref().unwrap_or(&[]);
        means.iter().sum::<f64>() / means.len().max(1) as f64
    }

    /// The reading with this replicate left out.
    pub fn without(&self, left_out: usize) -> f64 {
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
        let rows = points.iter().map(|point| self.row(point, &weight));
        Resampled::new(&rows.collect::<Vec<_>>())
    }

    /// The same at one point.
    pub(super) fn row(&self, point: &PointRecord, weight: impl Fn(usize, usize) -> f64) -> Row {
        let weight = |group, lane| self.dimming.factor(group) * weight(group, lane);
        let (exact, open) = self.weighted(point, weight);
        let sampled = point.replicates.as_ref();
        let sampled = sampled.filter(|_| open.iter().any(|weight| *weight != 0.0));
        Row {
            exact,
            means: sampled.map(|replicates| replicates.means(&open).collect()),
            converged: sampled.is_none_or(Replicates::converged),
        }
    }
}
