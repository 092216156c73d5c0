//! What the integration tests share: how a reading is compared with the truth, scenes in a few words, and the table
//! cases turned into scenes; and running the program.
//!
//! A reading agrees with an expected value when it lies within what its [`Method`] promises:
//!
//! | reading | agrees when |
//! |---|---|
//! | closed form | \|value − expected\| ≤ allowance, and the allowance is at least 1e-9 relative |
//! | every sample equal but for rounding | \|value − expected\| ≤ allowance + 1e-6 \|expected\| |
//! | sampled | \|value − expected\| ≤ allowance + 4 standard errors |
//! | every sample zero | expected is 0 |
//!
//! The allowance is the known error of the expected value and of the scene that stands for the case. With R replicates a
//! sampled reading fails by chance with the probability that Student's t with R − 1 degrees of freedom exceeds 4:
//! 1.2e-3 at R = 16, 1.7e-4 at R = 64.

pub mod binomial;
pub mod cases;
pub mod command;
pub mod luminaires;
pub mod measuring;
pub mod scenes;

use steradian::estimation::{Estimate, Method};

/// The most standard errors a sampled reading may be off.
pub const LARGEST_SCORE: f64 = 4.0;
/// Relative error of a closed form in f64.
pub const CLOSED_FORM_ERROR: f64 = 1e-9;
/// Relative error of light gathered in f32 along paths that all carry the same.
pub const ROUNDING_ERROR: f64 = 1e-6;
/// A relative standard error below this is rounding, not sampling.
const SMALLEST_SAMPLING_ERROR: f64 = 1e-6;

/// What kind of error bar a reading has.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Certainty {
    /// A formula gave it.
    ClosedForm,
    /// It was sampled, and every sample was the same but for rounding.
    Constant,
    /// It was sampled.
    Sampled,
    /// It was sampled, and every sample was zero.
    Unlit,
}

/// The kind of error bar of an estimate.
pub fn certainty(estimate: &Estimate) -> Certainty {
    match estimate.method {
        Method::ClosedForm => Certainty::ClosedForm,
        Method::Estimate if estimate.interval.is_none() => Certainty::Unlit,
        Method::Estimate
            if estimate.std_error <= SMALLEST_SAMPLING_ERROR * estimate.value.abs() =>
        {
            Certainty::Constant
        }
        Method::Estimate => Certainty::Sampled,
    }
}

/// Standard errors between an estimate and the truth.
pub fn score(estimate: &Estimate, expected: f64) -> f64 {
    (estimate.value - expected) / estimate.std_error
}

/// Why an estimate disagrees with the truth, if it does; `allowance` is the absolute error of `expected`.
pub fn disagreement(estimate: &Estimate, expected: f64, allowance: f64) -> Option<String> {
    let limit = match certainty(estimate) {
        Certainty::ClosedForm => allowance.max(CLOSED_FORM_ERROR * expected.abs()),
        Certainty::Constant => allowance + ROUNDING_ERROR * expected.abs(),
        Certainty::Sampled => allowance + LARGEST_SCORE * estimate.std_error,
        Certainty::Unlit => 0.0,
    };
    let off = (estimate.value - expected).abs();
    (off.is_nan() || off > limit).then(|| {
        format!(
            "{} ± {:.1e} is {off:.2e} from {expected}, more than {limit:.2e}",
            estimate.value, estimate.std_error
        )
    })
}

/// Fails unless the estimate agrees with `expected`, which is known to ± `allowance`.
#[track_caller]
pub fn assert_agrees(what: &str, estimate: &Estimate, expected: f64, allowance: f64) {
    if let Some(why) = disagreement(estimate, expected, allowance) {
        panic!("{what}: {why}");
    }
}

/// Fails unless two independent estimates agree with each other.
#[track_caller]
pub fn assert_same(what: &str, a: &Estimate, b: &Estimate) {
    let difference = Estimate {
        value: a.value - b.value,
        std_error: (a.std_error * a.std_error + b.std_error * b.std_error).sqrt(),
        ..*a
    };
    let sampled = certainty(&difference) == Certainty::Sampled;
    let limit = if sampled {
        LARGEST_SCORE * difference.std_error
    } else {
        ROUNDING_ERROR * a.value.abs()
    };
    assert_close(what, a.value, b.value, limit);
}

/// Fails unless two numbers differ by at most `tolerance`.
#[track_caller]
pub fn assert_close(what: &str, value: f64, expected: f64, tolerance: f64) {
    let off = (value - expected).abs();
    assert!(
        off <= tolerance,
        "{what}: {value} is {off:.2e} from {expected}, more than {tolerance:.2e}"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(value: f64, std_error: f64) -> Estimate {
        Estimate {
            std_error,
            interval: Some([value - 2.0 * std_error, value + 2.0 * std_error]),
            method: Method::Estimate,
            ..Estimate::closed_form(value)
        }
    }

    #[test]
    fn four_standard_errors_pass_and_more_fail() {
        assert_eq!(disagreement(&sampled(10.0, 0.1), 10.399, 0.0), None);
        assert!(disagreement(&sampled(10.0, 0.1), 10.401, 0.0).is_some());
        assert_eq!(disagreement(&sampled(10.0, 0.1), 10.401, 0.002), None);
        assert_eq!(score(&sampled(10.0, 0.1), 10.5), -5.0);
    }

    #[test]
    fn closed_forms_have_nine_digits() {
        let exact = Estimate::closed_form(100.0);
        assert_eq!(disagreement(&exact, 100.0 + 9e-8, 0.0), None);
        assert!(disagreement(&exact, 100.0 + 2e-7, 0.0).is_some());
        assert!(disagreement(&Estimate::closed_form(1e-12), 0.0, 0.0).is_some());
    }

    #[test]
    fn equal_samples_have_six_digits() {
        assert_eq!(certainty(&sampled(1.0, 1e-7)), Certainty::Constant);
        assert_eq!(disagreement(&sampled(1.0, 1e-7), 1.0 + 9e-7, 0.0), None);
        assert!(disagreement(&sampled(1.0, 1e-7), 1.0 + 2e-6, 0.0).is_some());
    }

    #[test]
    fn darkness_agrees_with_zero_only() {
        let unlit = Estimate {
            interval: None,
            ..sampled(0.0, f64::INFINITY)
        };
        assert_eq!(disagreement(&unlit, 0.0, 0.0), None);
        assert!(disagreement(&unlit, 1e-9, 0.0).is_some());
    }

    #[test]
    fn what_is_no_number_never_agrees() {
        assert!(disagreement(&sampled(f64::NAN, 0.1), 1.0, 0.0).is_some());
        assert!(disagreement(&Estimate::closed_form(f64::NAN), 1.0, 1.0).is_some());
    }

    #[test]
    fn errors_of_two_estimates_add_in_squares() {
        assert_same("within", &sampled(10.0, 0.3), &sampled(11.9, 0.4));
        let apart = std::panic::catch_unwind(|| {
            assert_same("beyond", &sampled(10.0, 0.3), &sampled(12.1, 0.4));
        });
        assert!(apart.is_err());
    }
}
