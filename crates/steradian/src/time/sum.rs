//! Sums that keep their digits.

/// A compensated sum (Neumaier 1974, the improved Kahan–Babuška sum): what each addition rounds away is added up beside
/// the sum, so that the error is one rounding of the result plus n ε² Σ|x|, where a plain sum has n ε Σ|x|.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    pub fn add(&mut self, term: f64) {
        let next = self.sum + term;
        self.lost += if self.sum.abs() >= term.abs() {
            (self.sum - next) + term
        } else {
            (term - next) + self.sum
        };
        self.sum = next;
    }

    /// The sum; infinite where it left the range of numbers.
    pub fn total(self) -> f64 {
        if self.sum.is_finite() {
            self.sum + self.lost
        } else {
            self.sum
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(terms: impl IntoIterator<Item = f64>) -> f64 {
        let mut sum = Sum::default();
        terms.into_iter().for_each(|term| sum.add(term));
        sum.total()
    }

    #[test]
    fn small_terms_beside_large_ones_count() {
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100]), 2.0);
        let tenths = sum(std::iter::repeat_n(0.1, 10_000_000));
        // A plain sum is 1.6e-4 too small. Ten million times the rounding of 0.1 itself is 5.6e-11.
        assert!((tenths - 1e6).abs() <= 1.2e-10, "{tenths}");
    }

    #[test]
    fn an_overflow_is_infinite() {
        assert_eq!(sum([f64::MAX, f64::MAX]), f64::INFINITY);
    }
}
