//! Area: A = ∫ dA.

use super::define::quantity;
use super::{Length, Unit, UnitTable};

const AREA: UnitTable = UnitTable {
    quantity: "area",
    si: "m²",
    example: "1.5 m2",
    units: &[
        Unit::new("m2", 1.0, 1.0),
        Unit::new("mm2", 1.0, 1e6),
        Unit::new("cm2", 1.0, 1e4),
        Unit::new("km2", 1e6, 1.0),
        Unit::new("in2", 64516.0, 1e8),
        Unit::new("ft2", 9290304.0, 1e8),
    ],
    allows_bare_numbers: false,
};

quantity! {
    /// Area A = ∫ dA, in m².
    ///
    /// ```
    /// use steradian::quantity::{Area, Length};
    /// let side = Length::from_metres(3.0);
    /// assert_eq!(side * side, Area::from_square_metres(9.0));
    /// assert_eq!("250 cm²".parse(), Ok(Area::from_square_metres(0.025)));
    /// ```
    Area, AREA, from_square_metres, to_square_metres, "square metres"
}

impl Area {
    /// The side of a square of this area.
    pub fn square_root(self) -> Length {
        Length::from_metres(self.0.sqrt())
    }
}
