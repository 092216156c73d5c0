//! Time in seconds, and how fast an angle grows in it.

use std::f64::consts::PI;

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

const ANGULAR_FREQUENCY: UnitTable = UnitTable {
    quantity: "angular frequency",
    si: "rad/s",
    example: "50 Hz",
    units: &[
        Unit::new("rad/s", 1.0, 1.0),
        Unit::new("deg/s", PI, 180.0),
        Unit::new("Hz", 2.0 * PI, 1.0),
        Unit::new("kHz", 2e3 * PI, 1.0),
    ],
    allows_bare_numbers: false,
};

quantity! {
    /// Angular frequency ω = dφ/dt, in rad/s. One hertz is a turn a second, 2π rad/s.
    ///
    /// ```
    /// use steradian::quantity::{Angle, AngularFrequency, Time};
    /// let mains: AngularFrequency = "50 Hz".parse()?;
    /// let quarter = mains * "5 ms".parse::<Time>()?;
    /// assert!((quarter / Angle::QUARTER_TURN - 1.0).abs() < 1e-15);
    /// # Ok::<(), steradian::quantity::ParseQuantityError>(())
    /// ```
    AngularFrequency, ANGULAR_FREQUENCY, from_radians_per_second, to_radians_per_second, "radians per second"
}
