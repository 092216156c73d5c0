//! Time in seconds.

use super::define::quantity;
use super::{Unit, UnitTable};

const TIME: UnitTable = UnitTable {
    quantity: "time",
    si: "s",
    example: "8 h",
    units: &[
        Unit::new("s", 1.0, 1.0),
        Unit::new("ms", 1.0, 1e3),
        Unit::new("min", 60.0, 1.0),
        Unit::new("h", 3600.0, 1.0),
        Unit::new("day", 86400.0, 1.0).or(&["days", "d"]),
    ],
    allows_bare_numbers: false,
};

quantity! {
    /// Time, in s.
    ///
    /// ```
    /// use steradian::quantity::{Flux, Time};
    /// let day: Time = "8 h".parse()?;
    /// assert_eq!((Flux::from_watts(10.0) * day).to_string(), "288000 J");
    /// # Ok::<(), steradian::quantity::ParseQuantityError>(())
    /// ```
    Time, TIME, from_seconds, to_seconds, "seconds"
}

impl Time {
    /// From hours.
    pub const fn from_hours(value: f64) -> Self {
        Self(value * 3600.0)
    }

    /// In hours.
    pub const fn to_hours(self) -> f64 {
        self.0 / 3600.0
    }
}
