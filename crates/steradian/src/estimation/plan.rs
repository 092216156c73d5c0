//! How much to compute: seed, stopping rule, replicates, threads, shard.

use std::time::Duration;

use super::EstimationError;

/// Everything that decides how an estimation is run, apart from what is estimated.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Seed of all random numbers.
    pub seed: u64,
    /// When to stop.
    pub stop: Stopping,
    /// Independent replicates of each stream, at least 2.
    pub replicates: u32,
    /// Worker threads; has no influence on the result.
    pub threads: usize,
    /// `Some((k, n))`: compute part k of n, counted from 1, to be put together by [`merge_shards`](super::merge_shards).
    pub shard: Option<(u32, u32)>,
    /// Probability with which an interval holds the true value.
    pub confidence: f64,
    /// The most samples a stream may take to reach a tolerance.
    pub max_samples: u64,
}

/// When to stop. At least one of the five is given.
///
/// - a tolerance (`rel_error`, `abs_error`, or both: the wider one holds), with `time` as a limit if given;
/// - `rms_error` alone, a tolerance of all streams of a sensor together, with `time` as a limit if given;
/// - `samples` alone: exactly that many a stream, rounded up to a multiple of the replicates;
/// - `time` alone: as many as fit; the number is kept in the result, and `samples` with that number gives the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stopping {
    /// Half-width of the interval relative to the value.
    pub rel_error: Option<f64>,
    /// Half-width of the interval in the unit of the scalar.
    pub abs_error: Option<f64>,
    /// Root mean square over the streams of a sensor of their intervals' half-widths, each relative to its value.
    pub rms_error: Option<f64>,
    /// Wall-clock time.
    pub time: Option<Duration>,
    /// Samples a stream.
    pub samples: Option<u64>,
}

impl Stopping {
    /// Stop when the interval is narrower than ± `rel_error` × value.
    #[must_use]
    pub fn at_rel_error(rel_error: f64) -> Self {
        Self {
            rel_error: Some(rel_error),
            ..Self::default()
        }
    }

    /// Stop when the half-widths of a sensor's intervals, relative to the values, are at most `rms_error` in the root mean square.
    #[must_use]
    pub fn at_rms_error(rms_error: f64) -> Self {
        Self {
            rms_error: Some(rms_error),
            ..Self::default()
        }
    }

    /// Stop after this many samples a stream.
    #[must_use]
    pub fn at_samples(samples: u64) -> Self {
        Self {
            samples: Some(samples),
            ..Self::default()
        }
    }

    /// Stop after this time.
    #[must_use]
    pub fn at_time(time: Duration) -> Self {
        Self {
            time: Some(time),
            ..Self::default()
        }
    }

    pub(super) fn has_tolerance(&self) -> bool {
        self.rel_error.is_some() || self.abs_error.is_some() || self.rms_error.is_some()
    }

    /// The half-width allowed for a value when the sensor's mean is `mean`.
    pub(super) fn tolerance(&self, value: f64, mean: f64) -> f64 {
        let relative = self.rel_error.unwrap_or(0.0);
        let absolute = self.abs_error.unwrap_or(0.0);
        (relative * value.abs())
            .max(relative * FLOOR * mean.abs())
            .max(absolute)
    }
}

/// Streams darker than this part of their sensor's mean need not be known any better than at this level.
pub(super) const FLOOR: f64 = 0.01;

/// Samples of a replicate are numbered by 32 bits.
pub(super) const LONGEST_REPLICATE: u64 = 1 << 32;

impl Default for Plan {
    /// 1 % at 95 % confidence with 16 replicates, on as many threads as the machine runs at once.
    fn default() -> Self {
        Self {
            seed: 0,
            stop: Stopping::at_rel_error(0.01),
            replicates: 16,
            threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            shard: None,
            confidence: 0.95,
            max_samples: 1 << 36,
        }
    }
}

impl Plan {
    /// Says what is wrong with the plan, if anything is.
    pub fn check(&self) -> Result<(), EstimationError> {
        let positive =
            |value: Option<f64>| value.is_none_or(|value| value > 0.0 && value.is_finite());
        let Stopping {
            rel_error,
            abs_error,
            rms_error,
            time,
            samples,
        } = self.stop;
        let of_each = rel_error.is_some() || abs_error.is_some();
        let faults = [
            (
                !self.stop.has_tolerance() && time.is_none() && samples.is_none(),
                "nothing says when to stop: give a tolerance, a time or a number of samples",
            ),
            (
                ![rel_error, abs_error, rms_error].into_iter().all(positive),
                "a tolerance must be a positive number",
            ),
            (
                rms_error.is_some() && of_each,
                "a root mean square error excludes a tolerance of each interval",
            ),
            (
                samples == Some(0),
                "the number of samples must be at least 1",
            ),
            (
                samples.is_some() && (self.stop.has_tolerance() || time.is_some()),
                "a number of samples excludes a tolerance and a time",
            ),
            (self.replicates < 2, "an error needs at least 2 replicates"),
            (self.threads == 0, "at least 1 thread is needed"),
            (
                !(self.confidence > 0.0 && self.confidence < 1.0),
                "the confidence must lie between 0 and 1",
            ),
            (
                self.shard.is_some_and(|(k, n)| k == 0 || k > n),
                "shards are counted from 1 to their number",
            ),
            (
                self.shard.is_some() && rms_error.is_some(),
                "shards cannot agree on a root mean square over all of them: give a tolerance or a number of samples",
            ),
            (
                self.shard.is_some() && time.is_some() && !self.stop.has_tolerance(),
                "shards of a timed run cannot agree on a number of samples: give a tolerance or a number of samples",
            ),
            (
                samples
                    .unwrap_or(0)
                    .div_ceil(u64::from(self.replicates.max(1)))
                    > LONGEST_REPLICATE,
                "more than 2³² samples a replicate: use more replicates",
            ),
        ];
        faults
            .iter()
            .find(|(wrong, _)| *wrong)
            .map_or(Ok(()), |(_, fault)| Err(EstimationError::Plan(fault)))
    }

    /// The same for what has no streams whose errors could be shared out.
    pub(crate) fn check_without_rms(&self) -> Result<(), EstimationError> {
        let message = "only the readings of sensors have a root mean square error";
        let fault = Err(EstimationError::Plan(message));
        self.stop.rms_error.map_or(self.check(), |_| fault)
    }

    /// Whether this shard computes number `cell`, of streams or of cells.
    pub(super) fn owns(&self, cell: usize) -> bool {
        self.shard
            .is_none_or(|(k, n)| cell as u64 % u64::from(n) == u64::from(k) - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contradictions_are_told() {
        let plan = |change: fn(&mut Plan)| {
            let mut plan = Plan::default();
            change(&mut plan);
            plan.check()
        };
        assert_eq!(plan(|_| ()), Ok(()));
        let wrong: [fn(&mut Plan); 11] = [
            |plan| plan.stop = Stopping::default(),
            |plan| plan.stop.rel_error = Some(-0.1),
            |plan| plan.stop.abs_error = Some(f64::NAN),
            |plan| plan.stop.samples = Some(100),
            |plan| plan.stop.rms_error = Some(0.01),
            |plan| (plan.stop, plan.shard) = (Stopping::at_rms_error(0.01), Some((1, 2))),
            |plan| plan.replicates = 1,
            |plan| plan.threads = 0,
            |plan| plan.confidence = 1.0,
            |plan| plan.shard = Some((4, 3)),
            |plan| {
                (plan.stop, plan.shard) = (Stopping::at_time(Duration::from_secs(1)), Some((1, 2)))
            },
        ];
        assert!(wrong.iter().all(|change| plan(*change).is_err()));
    }

    #[test]
    fn the_widest_tolerance_holds() {
        let stop = Stopping {
            rel_error: Some(0.1),
            abs_error: Some(0.5),
            ..Stopping::default()
        };
        assert_eq!(stop.tolerance(-20.0, 1.0), 2.0);
        assert_eq!(stop.tolerance(1.0, 10.0), 0.5);
        assert_eq!(stop.tolerance(0.0, 1000.0), 1.0);
    }
}
