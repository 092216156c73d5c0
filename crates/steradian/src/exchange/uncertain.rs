//! A number with its standard error and the degrees of freedom that the error was found with.

use serde::{Deserialize, Serialize};

use crate::estimation::student;

/// A value of known uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Uncertain {
    /// The value.
    pub value: f64,
    /// Its standard error; 0 if the value is exact.
    pub std_error: f64,
    /// Degrees of freedom ν of the standard error; infinite if the value is exact.
    #[serde(skip)]
    pub degrees: f64,
}

impl Uncertain {
    /// A value without error.
    pub const fn exact(value: f64) -> Self {
        Self {
            value,
            std_error: 0.0,
            degrees: f64::INFINITY,
        }
    }

    /// From the sum and the sum of squares of a number of independent replicates.
    pub fn from_replicates(count: u32, sum: f64, squares: f64) -> Self {
        let count = f64::from(count);
        let value = sum / count;
        let variance = ((squares - value * sum) / (count * (count - 1.0))).max(0.0);
        Self {
            value,
            std_error: variance.sqrt(),
            degrees: count - 1.0,
        }
    }

    /// The interval that holds the truth with the given probability.
    pub fn interval(&self, confidence: f64) -> [f64; 2] {
        let half_width = self.half_width(confidence);
        [self.value - half_width, self.value + half_width]
    }

    /// Half of the interval's width.
    pub fn half_width(&self, confidence: f64) -> f64 {
        match self.std_error {
            0.0 => 0.0,
            error => error * student::two_sided_quantile(confidence, self.whole_degrees()),
        }
    }

    /// How far it is from what was expected, in standard errors; 0 for a number that agrees to `rounding`.
    pub fn deviation(&self, expected: f64, rounding: f64) -> f64 {
        let off = ((self.value - expected).abs() - rounding).max(0.0);
        match self.std_error {
            _ if off == 0.0 => 0.0,
            0.0 => f64::INFINITY,
            error => off / error,
        }
    }

    /// Whether chance alone deviates as far with a probability of at least `alarm`.
    pub fn agrees_with(&self, expected: f64, rounding: f64, alarm: f64) -> bool {
        let deviation = self.deviation(expected, rounding);
        deviation == 0.0
            || (deviation.is_finite() && deviation * self.std_error <= self.half_width(1.0 - alarm))
    }

    /// The number in another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            std_error: self.std_error * factor.abs(),
            ..self
        }
    }

    /// At most this many are told apart from the normal distribution.
    fn whole_degrees(&self) -> u32 {
        self.degrees.clamp(1.0, 1000.0) as u32
    }
}

/// Sums independent numbers. The degrees of freedom of the sum are
///
/// ν = (Σ sₖ²)² / Σ (sₖ⁴/νₖ)
///
/// (F. E. Satterthwaite, Biometrics Bulletin 2 (6), 1946, eq. 17, after B. L. Welch).
#[derive(Clone, Copy, Debug, Default)]
pub struct IndependentSum {
    value: f64,
    variance: f64,
    fourth: f64,
}

impl IndependentSum {
    /// Adds `factor` times a number.
    pub fn add(&mut self, term: Uncertain, factor: f64) {
        let variance = (term.std_error * factor) * (term.std_error * factor);
        self.value += term.value * factor;
        self.variance += variance;
        self.fourth += variance * variance / term.degrees;
    }

    /// The sum so far.
    pub fn total(&self) -> Uncertain {
        let degrees = match self.fourth {
            0.0 => f64::INFINITY,
            fourth => self.variance * self.variance / fourth,
        };
        Uncertain {
            value: self.value,
            std_error: self.variance.sqrt(),
            degrees,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replicates_by_hand() {
        // 1, 2, 3, 4: mean 2.5, s² = 5/3, standard error √(5/12).
        let found = Uncertain::from_replicates(4, 10.0, 30.0);
        assert_eq!((found.value, found.degrees), (2.5, 3.0));
        assert!((found.std_error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        let [low, high] = found.interval(0.95);
        assert!((high - low - 2.0 * 3.182_446_305_284 * found.std_error).abs() < 1e-9);
    }

    #[test]
    fn equal_terms_add_their_degrees_of_freedom() {
        let mut sum = IndependentSum::default();
        for _ in 0..10 {
            sum.add(
                Uncertain {
                    value: 2.0,
                    std_error: 0.3,
                    degrees: 15.0,
                },
                -1.0,
            );
        }
        let total = sum.total();
        assert!((total.value + 20.0).abs() < 1e-12 && (total.degrees - 150.0).abs() < 1e-9);
        assert!((total.std_error - 0.3 * 10.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(IndependentSum::default().total(), Uncertain::exact(0.0));
    }

    #[test]
    fn agreement_is_judged_by_chance() {
        let found = Uncertain {
            value: 1.02,
            std_error: 0.01,
            degrees: 15.0,
        };
        assert_eq!(found.deviation(1.02, 0.0), 0.0);
        assert!((found.deviation(1.0, 0.0) - 2.0).abs() < 1e-12);
        // t(15) at 5 %: 2.131; at 10 %: 1.753.
        assert!(found.agrees_with(1.0, 0.0, 0.05) && !found.agrees_with(1.0, 0.0, 0.1));
        let exact = Uncertain::exact(1.0 + 1e-13);
        assert!(exact.agrees_with(1.0, 1e-12, 0.01) && !exact.agrees_with(1.0, 1e-14, 0.01));
    }
}
