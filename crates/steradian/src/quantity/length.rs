//! Length in metres. The only quantity that text may give without a unit.

use super::define::quantity;
use super::{Unit, UnitTable};

const LENGTH: UnitTable = UnitTable {
    quantity: "length",
    si: "m",
    example: "2.5 m",
    units: &[
        Unit::new("m", 1.0, 1.0),
        Unit::new("mm", 1.0, 1e3),
        Unit::new("cm", 1.0, 1e2),
        Unit::new("km", 1e3, 1.0),
        Unit::new("um", 1.0, 1e6),
        Unit::new("nm", 1.0, 1e9),
        Unit::new("in", 254.0, 1e4),
        Unit::new("ft", 3048.0, 1e4),
    ],
    allows_bare_numbers: true,
};

quantity! {
    /// Length, in m.
    ///
    /// ```
    /// use steradian::quantity::Length;
    /// assert_eq!("550 nm".parse::<Length>()?.to_nanometres(), 550.0);
    /// assert_eq!("1 ft".parse::<Length>()?, Length::from_metres(0.3048));
    /// # Ok::<(), steradian::quantity::ParseQuantityError>(())
    /// ```
    Length, LENGTH, from_metres, to_metres, "metres"
}

impl Length {
    /// From millimetres.
    pub const fn from_millimetres(value: f64) -> Self {
        Self(value / 1e3)
    }

    /// In millimetres.
    pub const fn to_millimetres(self) -> f64 {
        self.0 * 1e3
    }

    /// From nanometres, the unit of wavelengths.
    pub const fn from_nanometres(value: f64) -> Self {
        Self(value / 1e9)
    }

    /// In nanometres.
    pub const fn to_nanometres(self) -> f64 {
        self.0 * 1e9
    }

    /// The area of a square of this side.
    pub const fn squared(self) -> super::Area {
        super::Area::from_square_metres(self.0 * self.0)
    }
}
