//! What can be wrong with something that runs in time.

use thiserror::Error;

/// What can be wrong with something that runs in time. Times are in seconds.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TimeError {
    /// Too short to have a duration.
    #[error("at least two points are needed, found {found}")]
    TooFew {
        /// How many there are.
        found: usize,
    },
    /// A time or value that is infinite or no number.
    #[error("point {index} ({time} s, {value}) is not finite")]
    NotFinite {
        /// Number of the point, from 0.
        index: usize,
        /// Its time.
        time: f64,
        /// Its value in SI units.
        value: f64,
    },
    /// Times that do not increase.
    #[error("times must increase: point {index} at {time} s follows {previous} s")]
    NotIncreasing {
        /// Number of the point, from 0.
        index: usize,
        /// Its time.
        time: f64,
        /// The time before it.
        previous: f64,
    },
    /// A factor of a schedule below zero.
    #[error("a factor is not negative: point {index} at {time} s has {value}")]
    Negative {
        /// Number of the point, from 0.
        index: usize,
        /// Its time.
        time: f64,
        /// The factor.
        value: f64,
    },
    /// An interval without duration.
    #[error("an interval ends after it begins: {from} s to {to} s does not")]
    Interval {
        /// Its beginning.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// An interval, or a moment, that is not within the record.
    #[error("{} was asked for, but the record goes from {first} s to {last} s", asked(*from, *to))]
    Outside {
        /// Beginning of what was asked for.
        from: f64,
        /// End of what was asked for.
        to: f64,
        /// Beginning of the record.
        first: f64,
        /// End of the record.
        last: f64,
    },
    /// A period that is not longer than the points that repeat.
    #[error("a period of {period} s is too short for points that span {span} s")]
    Period {
        /// The period.
        period: f64,
        /// Time from the first point to the last.
        span: f64,
    },
    /// A parameter of a waveform outside its domain.
    #[error("{name} must be {expected}, not {value}")]
    Parameter {
        /// What it is.
        name: &'static str,
        /// What it must be.
        expected: &'static str,
        /// What it is, in SI units.
        value: f64,
    },
    /// An integral beyond the range of numbers.
    #[error("the integral is beyond the range of numbers")]
    Overflow,
}

/// A moment is an interval without duration.
fn asked(from: f64, to: f64) -> String {
    if from == to {
        format!("{from} s")
    } else {
        format!("{from} s to {to} s")
    }
}
