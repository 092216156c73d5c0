//! An interval of time.

use serde::{Deserialize, Serialize};

use super::TimeError;
use crate::quantity::Time;

/// From one moment to a later one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    from: f64,
    to: f64,
}

impl Interval {
    /// The interval between two moments.
    ///
    /// # Errors
    /// If they are not finite, or the second is not later than the first.
    pub fn new(from: Time, to: Time) -> Result<Self, TimeError> {
        let (from, to) = (from.to_seconds(), to.to_seconds());
        if (to - from).is_finite() && from < to {
            return Ok(Self { from, to });
        }
        Err(TimeError::Interval { from, to })
    }

    /// The interval of this duration.
    ///
    /// # Errors
    /// If the duration is not positive, or a number not finite.
    pub fn lasting(duration: Time, from: Time) -> Result<Self, TimeError> {
        Self::new(from, from + duration)
    }

    /// The interval that a record covers, which has checked its ends.
    pub(super) const fn of_record([from, to]: [f64; 2]) -> Self {
        Self { from, to }
    }

    /// When it begins.
    pub const fn from(self) -> Time {
        Time::from_seconds(self.from)
    }

    /// When it ends.
    pub const fn to(self) -> Time {
        Time::from_seconds(self.to)
    }

    /// How long it is.
    pub const fn duration(self) -> Time {
        Time::from_seconds(self.to - self.from)
    }

    /// Both ends in seconds.
    pub(super) const fn ends(self) -> [f64; 2] {
        [self.from, self.to]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_has_a_duration() {
        let time = Time::from_seconds;
        let night = Interval::lasting(Time::from_hours(2.0), time(100.0)).unwrap();
        assert_eq!((night.to(), night.duration()), (time(7300.0), time(7200.0)));
        for (from, to) in [
            (1.0, 1.0),
            (2.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
        ] {
            assert!(Interval::new(time(from), time(to)).is_err());
        }
    }
}
