//! Absorption coefficient, of what light travels through.

use super::define::quantity;
use super::{Unit, UnitTable};

const ABSORPTION: UnitTable = UnitTable {
    quantity: "absorption",
    si: "1/m",
    example: "3 1/m",
    units: &[
        Unit::new("1/m", 1.0, 1.0),
        Unit::new("1/cm", 100.0, 1.0),
        Unit::new("1/mm", 1000.0, 1.0),
    ],
    allows_bare_numbers: false,
};

quantity! {
    /// Absorption coefficient a, in 1/m: radiance falls to exp(−a s) along a path of length s.
    ///
    /// ```
    /// use steradian::quantity::Absorption;
    /// assert_eq!("0.5 1/cm".parse(), Ok(Absorption::from_per_metre(50.0)));
    /// ```
    Absorption, ABSORPTION, from_per_metre, to_per_metre, "per metre"
}
