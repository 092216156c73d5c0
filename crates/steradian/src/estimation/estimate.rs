//! A number with its error bar.

use serde::{Deserialize, Serialize};

/// How a value was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// By a formula; the standard error is zero.
    ClosedForm,
    /// By sampling.
    Estimate,
}

/// JSON has no infinity.
mod infinite_as_null {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        value.is_finite().then_some(*value).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}

/// A value, how far it may be off, and whether it is as good as was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The value, in the unit of what is estimated, as are all numbers here.
    pub value: f64,
    /// Standard deviation of `value` over repetitions with other seeds; infinite where it cannot be told: from a single
    /// replicate, or where every sample was zero (`null` in JSON).
    #[serde(with = "infinite_as_null")]
    pub std_error: f64,
    /// The confidence interval; none where every sample was zero, and none with too few replicates.
    pub interval: Option<[f64; 2]>,
    /// How the value was found.
    pub method: Method,
    /// Whether the tolerance was met, or, where none was set, whether the run was complete.
    pub converged: bool,
    /// Where every sample was zero: what the value is probably below. See [`Replicates::combine`](super::Replicates::combine).
    pub upper_bound: Option<f64>,
}

impl Estimate {
    /// A value known exactly.
    ///
    /// ```
    /// let e = steradian::estimation::Estimate::closed_form(100.0);
    /// assert_eq!((e.std_error, e.interval), (0.0, Some([100.0, 100.0])));
    /// ```
    #[must_use]
    pub fn closed_form(value: f64) -> Self {
        Self {
            value,
            std_error: 0.0,
            interval: Some([value, value]),
            method: Method::ClosedForm,
            converged: true,
            upper_bound: None,
        }
    }

    /// A sampled value whose interval is ± `factor` standard errors.
    pub(super) fn sampled(value: f64, std_error: f64, factor: f64, converged: bool) -> Self {
        let half_width = factor * std_error;
        let interval = half_width
            .is_finite()
            .then_some([value - half_width, value + half_width]);
        Self {
            value,
            std_error,
            interval,
            method: Method::Estimate,
            converged: converged && interval.is_some(),
            upper_bound: None,
        }
    }

    /// Whether it was sampled and nothing was found.
    #[must_use]
    pub fn is_dark(&self) -> bool {
        self.value == 0.0 && self.std_error.is_infinite()
    }

    /// This estimate plus a part known exactly.
    #[must_use]
    pub fn plus_exact(self, exact: f64) -> Self {
        let interval = self.interval.map(|[low, high]| [low + exact, high + exact]);
        Self {
            value: self.value + exact,
            interval,
            upper_bound: self.upper_bound.map(|bound| bound + exact),
            ..self
        }
    }

    /// This estimate with another, independent standard error added; the interval widens in proportion.
    #[must_use]
    pub fn widened(self, std_error: f64) -> Self {
        let total = (self.std_error * self.std_error + std_error * std_error).sqrt();
        let widen = |[low, high]: [f64; 2]| {
            let half_width = 0.5 * (high - low) + 2.0 * (total - self.std_error);
            [self.value - half_width, self.value + half_width]
        };
        Self {
            std_error: total,
            interval: self.interval.map(widen),
            ..self
        }
    }

    /// This estimate in another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let scale = |[low, high]: [f64; 2]| {
            if factor < 0.0 {
                [factor * high, factor * low]
            } else {
                [factor * low, factor * high]
            }
        };
        Self {
            value: factor * self.value,
            std_error: factor.abs() * self.std_error,
            interval: self.interval.map(scale),
            upper_bound: self
                .upper_bound
                .filter(|_| factor > 0.0)
                .map(|bound| factor * bound),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_and_exact_parts_move_the_whole_interval() {
        let estimate = Estimate::sampled(10.0, 1.0, 2.0, true);
        assert_eq!(estimate.interval, Some([8.0, 12.0]));
        assert_eq!(estimate.plus_exact(5.0).interval, Some([13.0, 17.0]));
        assert_eq!(estimate.scaled(-3.0).interval, Some([-36.0, -24.0]));
        assert_eq!(estimate.scaled(-3.0).std_error, 3.0);
    }

    #[test]
    fn an_unknown_error_is_never_converged() {
        let estimate = Estimate::sampled(10.0, f64::INFINITY, 2.0, true);
        assert!(!estimate.converged && estimate.interval.is_none());
    }

    #[test]
    fn estimates_survive_json() {
        for std_error in [0.01, f64::INFINITY] {
            let estimate = Estimate::sampled(0.1, std_error, 2.13, true);
            let text = serde_json::to_string(&estimate).unwrap();
            assert!(text.contains("\"method\":\"estimate\""));
            assert_eq!(serde_json::from_str::<Estimate>(&text).unwrap(), estimate);
        }
    }
}
