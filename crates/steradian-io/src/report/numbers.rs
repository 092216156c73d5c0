//! Numbers for people: as many digits as the error supports, two digits of the error.
//!
//! ```
//! use steradian_io::report::numbers::{exact, with_half_width};
//!
//! assert_eq!(with_half_width(503.187, 2.2481), "503.2 ± 2.2");
//! assert_eq!(with_half_width(1.23456e-7, 3.1e-10), "(1.2346 ± 0.0031)e-7");
//! assert_eq!(exact(35.35533905932738), "35.35533906");
//! ```

use steradian::estimation::{Estimate, Method};

/// Magnitudes printed without an exponent.
const PLAIN: std::ops::Range<f64> = 1e-4..1e9;
/// Significant digits of a number that has no error to go by.
const EXACT_DIGITS: i32 = 10;
/// Significant digits of an error.
const ERROR_DIGITS: i32 = 2;

/// A number known exactly, to ten significant digits, without trailing zeros.
pub fn exact(value: f64) -> String {
    significant(value, EXACT_DIGITS)
}

/// A number to some significant digits, without trailing zeros.
pub fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let exponent = decimal_exponent(value);
    if PLAIN.contains(&value.abs()) {
        return trimmed(&format!("{value:.*}", decimals(digits - 1 - exponent)));
    }
    let scaled = value / libm::pow(10.0, f64::from(exponent));
    format!(
        "{}e{exponent}",
        trimmed(&format!("{scaled:.*}", decimals(digits - 1)))
    )
}

/// `value ± half_width`, the half-width to two digits and the value to the same decimal place, but to ten significant
/// digits at most.
pub fn with_half_width(value: f64, half_width: f64) -> String {
    let magnitude = value.abs().max(half_width);
    if !(half_width > 0.0 && magnitude.is_finite()) {
        return exact(value);
    }
    let rounded = format!("{half_width:.*e}", decimals(ERROR_DIGITS - 1));
    let (top, last) = (
        decimal_exponent(magnitude),
        exponent_of(&rounded) + 1 - ERROR_DIGITS,
    );
    if top - last >= EXACT_DIGITS {
        return format!("{} ± {rounded}", exact(value));
    }
    let shared = if PLAIN.contains(&magnitude) { 0 } else { top };
    let unit = libm::pow(10.0, f64::from(shared));
    let places = decimals(shared - last);
    let text = format!("{:.places$} ± {:.places$}", value / unit, half_width / unit);
    if shared == 0 {
        text
    } else {
        format!("({text})e{shared}")
    }
}

/// An estimate without its unit: `503.2 ± 2.2`, `100 (exact)`, `< 0.1 (nothing seen)`, `5.1 (error unknown)`. Where a part
/// is known exactly and nothing was seen of the rest, `5 to 5.1 (rest not seen)`.
pub fn estimate(estimate: &Estimate) -> String {
    let value = estimate.value;
    match (estimate.method, estimate.interval, estimate.upper_bound) {
        (Method::ClosedForm, _, _) => format!("{} (exact)", exact(value)),
        (_, Some([low, high]), _) => with_half_width(value, (high - low) / 2.0),
        (_, None, Some(bound)) if value == 0.0 => {
            format!("< {} (nothing seen)", significant(bound, ERROR_DIGITS))
        }
        (_, None, Some(bound)) => format!(
            "{} to {} (rest not seen)",
            significant(value, 4),
            significant(bound, 4)
        ),
        (_, None, None) => format!("{} (error unknown)", significant(value, 4)),
    }
}

fn decimals(places: i32) -> usize {
    usize::try_from(places).unwrap_or(0)
}

/// The exponent of a number in scientific notation, correct at powers of ten.
fn decimal_exponent(value: f64) -> i32 {
    exponent_of(&format!("{value:e}"))
}

fn exponent_of(scientific: &str) -> i32 {
    scientific
        .split_once('e')
        .and_then(|(_, exponent)| exponent.parse().ok())
        .unwrap_or(0)
}

fn trimmed(text: &str) -> String {
    if text.contains('.') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn exact_numbers_are_short() {
        let cases = [
            (100.0, "100"),
            (0.0, "0"),
            (-2.5, "-2.5"),
            (209.43951023931953, "209.4395102"),
            (1e-9, "1e-9"),
            (-1.25e12, "-1.25e12"),
            (0.001, "0.001"),
        ];
        for (value, text) in cases {
            assert_eq!(exact(value), text);
        }
    }

    #[test]
    fn digits_follow_the_error() {
        let cases = [
            (503.187, 22.4, "503 ± 22"),
            (503.187, 0.0224, "503.187 ± 0.022"),
            (0.5, 1.5, "0.5 ± 1.5"),
            (123456.0, 1234.0, "123456 ± 1234"),
            (2e-6, 3e-8, "(2.000 ± 0.030)e-6"),
            (5.0, 0.0, "5"),
            (5.0, 0.09999, "5.00 ± 0.10"),
            (399.9999914, 5.7e-14, "399.9999914 ± 5.7e-14"),
        ];
        for (value, half_width, text) in cases {
            assert_eq!(with_half_width(value, half_width), text);
        }
    }

    proptest! {
        #[test]
        fn what_is_printed_is_within_a_twentieth_of_the_error(value in -1e6..1e6_f64, error in 1e-6..1e3_f64) {
            let text = with_half_width(value, error);
            let (mantissas, exponent) = match text.strip_prefix('(').and_then(|rest| rest.split_once(")e")) {
                Some((inner, exponent)) => (inner.to_owned(), exponent.parse::<i32>().unwrap()),
                None => (text.clone(), 0),
            };
            let printed: f64 = mantissas.split(" ± ").next().unwrap().parse().unwrap();
            let printed = printed * libm::pow(10.0, f64::from(exponent));
            prop_assert!((printed - value).abs() <= 0.0501 * error, "{}", text);
        }
    }
}
