//! Where an integrand puts its samples: sums per run and column in f64.

/// Sum, sum of squares and largest magnitude of the scalar that tolerances are about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Moments {
    pub(super) sum: f64,
    pub(super) squares: f64,
    pub(super) largest: f64,
    pub(super) non_finite: u64,
}

impl Moments {
    fn add(&mut self, scalar: f64) {
        self.sum += scalar;
        self.squares += scalar * scalar;
        self.largest = self.largest.max(scalar.abs());
    }

    pub(super) fn merge(&mut self, other: &Self) {
        self.sum += other.sum;
        self.squares += other.squares;
        self.largest = self.largest.max(other.largest);
        self.non_finite += other.non_finite;
    }
}

/// The sums of one batch.
///
/// Every sample is told once: either whole with [`sample`](Self::sample), or, where only few columns are not zero,
/// by [`add`](Self::add) for each of them and [`scalar`](Self::scalar) for the weighted sum. Samples that are
/// zero need not be told. A value that is not finite is counted, kept out of the sums, and makes the estimation fail.
#[derive(Clone, Debug)]
pub struct Tally {
    columns: usize,
    sums: Vec<f64>,
    moments: Vec<Moments>,
}

impl Tally {
    pub(super) fn new(columns: usize) -> Self {
        Self {
            columns,
            sums: Vec::new(),
            moments: Vec::new(),
        }
    }

    pub(super) fn reset(&mut self, runs: usize) {
        self.sums.clear();
        self.sums.resize(runs * self.columns, 0.0);
        self.moments.clear();
        self.moments.resize(runs, Moments::default());
    }

    /// Adds one sample: all its columns, and their sum weighted as the stream of the run weights them.
    ///
    /// # Panics
    /// If `columns` is not as long as the integrand's columns, or there is no such run in the batch.
    #[inline]
    pub fn sample(&mut self, run: usize, columns: &[f64], weights: &[f64]) {
        assert_eq!(columns.len(), self.columns, "a sample has every column");
        let scalar: f64 = columns
            .iter()
            .zip(weights)
            .map(|(value, weight)| value * weight)
            .sum();
        if !scalar.is_finite() {
            self.moments[run].non_finite += 1;
            return;
        }
        self.moments[run].add(scalar);
        let first = run * columns.len();
        for (sum, value) in self.sums[first..first + columns.len()]
            .iter_mut()
            .zip(columns)
        {
            *sum += value;
        }
    }

    /// Adds to one column only.
    #[inline]
    pub fn add(&mut self, run: usize, column: usize, value: f64) {
        if value.is_finite() {
            self.sums[run * self.columns + column] += value;
        } else {
            self.moments[run].non_finite += 1;
        }
    }

    /// Tells the weighted sum of the columns of one sample that was added by columns.
    #[inline]
    pub fn scalar(&mut self, run: usize, scalar: f64) {
        if scalar.is_finite() {
            self.moments[run].add(scalar);
        } else {
            self.moments[run].non_finite += 1;
        }
    }

    pub(super) fn run(&self, run: usize) -> (&[f64], &Moments) {
        let columns = self.columns;
        (
            &self.sums[run * columns..(run + 1) * columns],
            &self.moments[run],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_and_sparse_samples_are_the_same() {
        let (mut whole, mut sparse) = (Tally::new(2), Tally::new(2));
        whole.reset(2);
        sparse.reset(2);
        whole.sample(1, &[3.0, 0.0], &[0.5, 2.0]);
        whole.sample(1, &[0.0, -7.0], &[0.5, 2.0]);
        sparse.add(1, 0, 3.0);
        sparse.scalar(1, 1.5);
        sparse.add(1, 1, -7.0);
        sparse.scalar(1, -14.0);
        assert_eq!(whole.run(1), sparse.run(1));
        assert_eq!(whole.run(1).0, [3.0, -7.0]);
        assert_eq!(
            *whole.run(1).1,
            Moments {
                sum: -12.5,
                squares: 198.25,
                largest: 14.0,
                non_finite: 0
            }
        );
        assert_eq!(whole.run(0), (&[0.0, 0.0][..], &Moments::default()));
    }

    #[test]
    fn values_that_are_not_finite_are_counted_and_kept_out() {
        let mut tally = Tally::new(1);
        tally.reset(1);
        tally.sample(0, &[f64::NAN], &[0.0]);
        tally.sample(0, &[f64::INFINITY], &[0.0]);
        tally.add(0, 0, f64::NEG_INFINITY);
        tally.scalar(0, f64::NAN);
        assert_eq!(tally.run(0).0, [0.0]);
        assert_eq!(tally.run(0).1.non_finite, 4);
    }
}
