//! How many of many intervals may miss by chance.

use std::ops::RangeInclusive;

/// Numbers of hits in independent trials of this probability, without tails of at most half of `false_alarm` each.
///
/// ```
/// use steradian_tests::binomial::usual_hits;
///
/// // Of ten coins all or none show heads with probability 2/1024, nine or one with 20/1024.
/// assert_eq!(usual_hits(10, 0.5, 0.01), 1..=9);
/// assert_eq!(usual_hits(10, 0.5, 0.03), 2..=8);
/// ```
#[must_use]
pub fn usual_hits(trials: u32, probability: f64, false_alarm: f64) -> RangeInclusive<u32> {
    let hits_up_from_none = |trials_probability: f64| {
        let mut tail = 0.0;
        let in_tail = |hits: &u32| {
            tail += chance(trials, *hits, trials_probability);
            tail <= 0.5 * false_alarm
        };
        (0..=trials).take_while(in_tail).count() as u32
    };
    let fewest = hits_up_from_none(probability);
    let most = trials - hits_up_from_none(1.0 - probability);
    fewest..=most
}

/// n!/(k! (n − k)!) pᵏ (1 − p)ⁿ⁻ᵏ, by logarithms, since powers of thousands of trials underflow.
fn chance(trials: u32, hits: u32, probability: f64) -> f64 {
    let factorial = |count: u32| libm::lgamma(f64::from(count) + 1.0);
    let ways = factorial(trials) - factorial(hits) - factorial(trials - hits);
    let hit = f64::from(hits) * libm::log(probability);
    let missed = f64::from(trials - hits) * libm::log(1.0 - probability);
    libm::exp(ways + hit + missed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chances_add_up_to_one() {
        let sum: f64 = (0..=6000).map(|hits| chance(6000, hits, 0.95)).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    }

    /// σ = √(n p q) = 16.9 about 5700: 4.42 of these either side leave 1e-5 of a normal law; a binomial one is lopsided by less than half of one.
    #[test]
    fn many_trials_are_nearly_normal() {
        let usual = usual_hits(6000, 0.95, 1e-5);
        assert!((5617..=5627).contains(usual.start()), "{usual:?}");
        assert!((5764..=5774).contains(usual.end()), "{usual:?}");
    }

    #[test]
    fn few_trials_have_no_upper_end() {
        assert_eq!(*usual_hits(60, 0.95, 1e-5).end(), 60);
    }
}
