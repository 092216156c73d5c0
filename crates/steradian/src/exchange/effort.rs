//! How many samples a row or a pair gets.
//!
//! With a number of samples, that many. With a tolerance ε, three stages as for readings (see [`crate::estimation`]): a pilot, whose
//! samples are thrown away; the final run with fresh random numbers and
//!
//! n = n_pilot · max(1, (1.4 h/(ε max(F, floor)))^(1/s))
//!
//! samples a replicate, rounded up to a power of 2, which nets like best; and, as long as that misses, a run afresh
//! with twice as many.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | h | half-width of the pilot's interval | – |
//! | s | order: errors fall as n⁻ˢ | – |
//!
//! A pilot can be short as every sample lies between 0 and a known bound. For a visibility in four dimensions
//! s = ½ + 1/14 (Z. He & X. Wang, SIAM J. Numer. Anal. 53 (5), 2015, theorem 3.5 with d = 4).

use super::uncertain::Uncertain;
use crate::estimation::{Phase, Plan};
use crate::sampling::hash::combine;

const SAFETY: f64 = 1.4;

/// When a factor is known well enough.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rule {
    pub replicates: u32,
    confidence: f64,
    seed: u64,
    tolerance: Option<f64>,
    floor: f64,
    samples: Option<u32>,
    longest: u32,
}

/// What a run found.
pub(super) struct Found<T> {
    pub value: T,
    /// The largest [`Rule::excess`] in it.
    pub excess: f64,
    /// s.
    pub order: f64,
}

/// A run of samples.
pub(super) struct Attempt {
    pub key: u64,
    /// Samples of each replicate.
    pub samples: u32,
}

impl Rule {
    /// s of visibility in four dimensions.
    pub const ORDER: f64 = 4.0 / 7.0;

    /// Factors below `floor` need only be known as well as one of that size.
    pub fn new(plan: &Plan, floor: f64) -> Self {
        let each = |total: u64| total.div_ceil(u64::from(plan.replicates)).clamp(1, 1 << 31) as u32;
        Self {
            replicates: plan.replicates,
            confidence: plan.confidence,
            seed: plan.seed,
            tolerance: plan.stop.rel_error,
            floor,
            samples: plan.stop.samples.map(each),
            longest: each(plan.max_samples),
        }
    }

    /// Half-width over what is allowed.
    pub fn excess(&self, found: &Uncertain) -> f64 {
        let Some(tolerance) = self.tolerance else {
            return 0.0;
        };
        found.half_width(self.confidence) / (tolerance * found.value.abs().max(self.floor))
    }

    /// Runs `attempt` as often as it takes, and returns the last value with the number of samples and whether the tolerance is met.
    pub fn sample<T>(
        &self,
        identity: u64,
        pilot: u32,
        mut attempt: impl FnMut(&Attempt) -> Found<T>,
    ) -> (T, u64, bool) {
        let mut run = |phase: Phase, samples: u32| {
            let run = combine(phase.key(), u64::from(samples));
            let key = combine(combine(self.seed, identity), run);
            attempt(&Attempt { key, samples })
        };
        let total = |samples: u32| u64::from(samples) * u64::from(self.replicates);
        if let Some(samples) = self.samples {
            return (run(Phase::Final, samples).value, total(samples), true);
        }
        let pilot = pilot.min(self.longest);
        let trial = run(Phase::Pilot, pilot);
        let growth = libm::pow(SAFETY * trial.excess, 1.0 / trial.order).max(1.0);
        let mut samples = self.length(f64::from(pilot) * growth);
        let mut found = run(Phase::Final, samples);
        let mut spent = total(pilot) + total(samples);
        while found.excess > 1.0 && samples < self.longest {
            samples = self.length(2.0 * f64::from(samples));
            found = run(Phase::Rerun, samples);
            spent += total(samples);
        }
        (found.value, spent, found.excess <= 1.0)
    }

    fn length(&self, planned: f64) -> u32 {
        (planned.min(f64::from(1_u32 << 30)) as u32)
            .next_power_of_two()
            .min(self.longest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimation::Stopping;

    fn rule(stop: Stopping) -> Rule {
        let plan = Plan {
            stop,
            max_samples: 16 << 10,
            ..Plan::default()
        };
        Rule::new(&plan, 0.01)
    }

    fn found<T>(value: T, excess: f64) -> Found<T> {
        Found {
            value,
            excess,
            order: 0.5,
        }
    }

    #[test]
    fn a_number_of_samples_is_kept() {
        let rule = rule(Stopping::at_samples(100));
        let (samples, spent, converged) = rule.sample(1, 64, |attempt| found(attempt.samples, 9.0));
        assert_eq!((samples, spent, converged), (7, 112, true));
    }

    #[test]
    fn the_pilot_decides_and_a_miss_runs_again() {
        let rule = rule(Stopping::at_rel_error(0.1));
        let mut lengths = Vec::new();
        let ((), spent, converged) = rule.sample(1, 4, |attempt| {
            lengths.push(attempt.samples);
            found((), [2.0, 1.5, 1.1, 0.9][lengths.len() - 1])
        });
        // 4 · (1.4 · 2)² = 31.4.
        let expected = ([4, 32, 64, 128].as_slice(), 3648, true);
        assert_eq!((lengths.as_slice(), spent, converged), expected);
        let (samples, _, converged) = rule.sample(1, 4, |attempt| found(attempt.samples, 1e9));
        assert_eq!((samples, converged), (1 << 10, false));
    }

    #[test]
    fn small_factors_are_judged_by_the_floor() {
        let rule = rule(Stopping::at_rel_error(0.1));
        let found = |value| Uncertain {
            value,
            std_error: 0.001,
            degrees: 15.0,
        };
        // t(15) = 2.1314.
        assert!((rule.excess(&found(0.5)) - 2.131_449_5e-3 / 0.05).abs() < 1e-9);
        assert!((rule.excess(&found(1e-9)) - 2.131_449_5).abs() < 1e-6);
    }
}
