//! The sums of all cells: streams × replicates, each with its columns.

use super::tally::{Moments, Tally};
use super::{EstimationError, Integrand, Plan, Run, student};

/// Sums of every replicate of every stream, filled in the order of the samples.
pub(super) struct Cells {
    columns: usize,
    replicates: usize,
    sums: Vec<f64>,
    samples: Vec<u64>,
    moments: Vec<Moments>,
}

/// What the scalar of one stream looks like.
#[derive(Clone, Copy, Debug)]
pub(super) struct Summary {
    /// Mean of the replicate means.
    pub(super) mean: f64,
    /// Variance of `mean`; infinite with fewer than two replicates.
    pub(super) variance: f64,
    /// Samples in all replicates.
    pub(super) samples: u64,
    /// (Σx)² / Σx²: how many equal samples would be as informative.
    pub(super) effective_samples: f64,
}

/// Mean of `values` and the variance of that mean, from their spread.
pub(super) fn mean_and_variance(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.clone().count() as f64;
    let mean = if count > 0.0 {
        values.clone().sum::<f64>() / count
    } else {
        0.0
    };
    let squares: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
    (
        mean,
        if count > 1.0 {
            squares / (count * (count - 1.0))
        } else {
            f64::INFINITY
        },
    )
}

impl Cells {
    pub(super) fn new<I: Integrand>(integrand: &I, plan: &Plan) -> Self {
        let (columns, replicates) = (integrand.columns(), plan.replicates as usize);
        let count = integrand.streams() * replicates;
        Self {
            columns,
            replicates,
            sums: vec![0.0; count * columns],
            samples: vec![0; count],
            moments: vec![Moments::default(); count],
        }
    }

    pub(super) fn streams(&self) -> usize {
        self.samples.len() / self.replicates
    }

    /// Adds the sums of a batch.
    pub(super) fn add(&mut self, runs: &[Run], tally: &Tally) -> Result<(), EstimationError> {
        for (number, run) in runs.iter().enumerate() {
            let cell = run.stream as usize * self.replicates + run.replicate as usize;
            let (sums, moments) = tally.run(number);
            for (total, sum) in self.sums[cell * self.columns..].iter_mut().zip(sums) {
                *total += sum;
            }
            self.samples[cell] += u64::from(run.count);
            self.moments[cell].merge(moments);
            if self.moments[cell].non_finite > 0 {
                return Err(self.non_finite(cell));
            }
        }
        Ok(())
    }

    fn non_finite(&self, cell: usize) -> EstimationError {
        let (stream, replicate) = (cell / self.replicates, cell % self.replicates);
        EstimationError::NonFinite {
            stream,
            replicate,
            count: self.moments[cell].non_finite,
        }
    }

    fn cells_of(&self, stream: usize) -> std::ops::Range<usize> {
        stream * self.replicates..(stream + 1) * self.replicates
    }

    /// Sums of one stream, by replicate and column.
    pub(super) fn sums(&self, stream: usize) -> &[f64] {
        let cells = self.cells_of(stream);
        &self.sums[cells.start * self.columns..cells.end * self.columns]
    }

    /// Samples of one stream by replicate.
    pub(super) fn samples(&self, stream: usize) -> &[u64] {
        &self.samples[self.cells_of(stream)]
    }

    /// Largest magnitude of one sample's scalar in a stream.
    pub(super) fn largest(&self, stream: usize) -> f64 {
        self.moments[self.cells_of(stream)]
            .iter()
            .fold(0.0, |largest, moments| largest.max(moments.largest))
    }

    /// Copies a stream from other cells of the same shape.
    pub(super) fn replace(&mut self, stream: usize, other: &Self) {
        let cells = self.cells_of(stream);
        let sums = cells.start * self.columns..cells.end * self.columns;
        self.sums[sums.clone()].copy_from_slice(&other.sums[sums]);
        self.samples[cells.clone()].copy_from_slice(&other.samples[cells.clone()]);
        self.moments[cells.clone()].copy_from_slice(&other.moments[cells]);
    }

    pub(super) fn summary(&self, stream: usize) -> Summary {
        let cells = self.cells_of(stream);
        let filled = cells.clone().filter(|&cell| self.samples[cell] > 0);
        let (mean, variance) = mean_and_variance(
            filled.map(|cell| self.moments[cell].sum / self.samples[cell] as f64),
        );
        let mut total = Moments::default();
        self.moments[cells]
            .iter()
            .for_each(|moments| total.merge(moments));
        let effective_samples = if total.squares > 0.0 {
            total.sum * total.sum / total.squares
        } else {
            0.0
        };
        Summary {
            mean,
            variance,
            samples: self.samples(stream).iter().sum(),
            effective_samples,
        }
    }
}

/// The factor from standard error to half-width for this plan.
pub(super) fn half_width_factor(plan: &Plan) -> f64 {
    student::two_sided_quantile(plan.confidence, plan.replicates - 1)
}
