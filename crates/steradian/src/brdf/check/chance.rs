//! Uniform numbers, and how far chance may lead.

use crate::estimation::student::two_sided_quantile;
use crate::sampling::hash::{combine, mix_64};

/// Freedom at which Student's distribution is as good as normal: quantiles are off by 1 % at seven standard deviations.
const NEARLY_NORMAL: u32 = 1001;
const TO_UNIT: f64 = 1.0 / (1_u64 << 53) as f64;

/// Independent pairs of uniform numbers of 53 bits.
pub(super) fn uniform_pairs(key: u64, count: u32) -> impl Iterator<Item = [f64; 2]> {
    let number = move |index: u64| (mix_64(combine(key, index)) >> 11) as f64 * TO_UNIT;
    (0..u64::from(count)).map(move |index| [number(2 * index), number(2 * index + 1)])
}

/// The probability left to each of `tests` independent tests that shall fail with probability `all` together.
pub(super) fn share_of_alarms(all: f64, tests: usize) -> f64 {
    -libm::expm1(libm::log1p(-all) / tests.max(1) as f64)
}

/// What a standard normal number exceeds with this probability.
pub(super) fn normal_limit(probability: f64) -> f64 {
    two_sided_quantile(1.0 - 2.0 * probability, NEARLY_NORMAL)
}

/// χ² of this freedom as a standard normal number (E. Wilson and M. Hilferty, PNAS 17 (1931) 684).
pub(super) fn normal_of_chi_squared(chi_squared: f64, freedom: f64) -> f64 {
    let ninth = 2.0 / (9.0 * freedom);
    (libm::cbrt(chi_squared / freedom) - (1.0 - ninth)) / ninth.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alarms_are_shared_after_sidak() {
        let each = share_of_alarms(0.05, 10);
        assert!((1.0 - libm::pow(1.0 - each, 10.0) - 0.05).abs() < 1e-15);
        assert_eq!(share_of_alarms(0.05, 0), share_of_alarms(0.05, 1));
    }

    #[test]
    fn limits_are_those_of_tables() {
        assert!((normal_limit(0.025) / 1.959_964 - 1.0).abs() < 2e-3);
        // The 99.9 % quantile of χ² with 100 degrees of freedom is 149.449.
        assert!((normal_of_chi_squared(149.449, 100.0) - 3.0902).abs() < 0.01);
    }

    #[test]
    fn pairs_fill_the_square() {
        let pairs: Vec<_> = uniform_pairs(5, 4096).collect();
        let mean = |k: usize| pairs.iter().map(|pair| pair[k]).sum::<f64>() / 4096.0;
        let product = pairs.iter().map(|[u, v]| u * v).sum::<f64>() / 4096.0;
        // Five standard errors of 1/√(12 · 4096).
        assert!((mean(0) - 0.5).abs() < 0.023 && (mean(1) - 0.5).abs() < 0.023);
        assert!((product - 0.25).abs() < 0.018);
    }
}
