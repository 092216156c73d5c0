//! Temperature, of black bodies and of daylight.

use super::define::quantity;
use super::{Unit, UnitTable};

const TEMPERATURE: UnitTable = UnitTable {
    quantity: "temperature",
    si: "K",
    example: "2700 K",
    units: &[Unit::new("K", 1.0, 1.0)],
    allows_bare_numbers: false,
};

quantity! {
    /// Thermodynamic temperature, in K.
    ///
    /// ```
    /// use steradian::quantity::Temperature;
    /// assert_eq!("2700 K".parse(), Ok(Temperature::from_kelvin(2700.0)));
    /// assert!("2700".parse::<Temperature>().is_err());
    /// ```
    Temperature, TEMPERATURE, from_kelvin, to_kelvin, "kelvin"
}
