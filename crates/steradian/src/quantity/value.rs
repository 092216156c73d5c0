//! What a quantity may hold, and what all quantities share.

use std::fmt::{Debug, Display};
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::str::FromStr;

use super::{ParseQuantityError, Spectrum, UnitTable};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for super::Spectrum {}
}

/// The number or numbers inside a radiant quantity: one `f64`, or a [`Spectrum`] of four lanes.
///
/// The trait is sealed. Laws between quantities are linear, so addition and scaling are all they need.
pub trait Value:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// The neutral element of addition.
    const ZERO: Self;
}

impl Value for f64 {
    const ZERO: Self = 0.0;
}

impl Value for Spectrum {
    const ZERO: Self = Spectrum::ZERO;
}

/// A quantity of one number, with the name and the units that reports and error messages print.
///
/// ```
/// use steradian::quantity::{Irradiance, Quantity};
/// assert_eq!(Irradiance::NAME, "irradiance");
/// assert_eq!(Irradiance::UNIT, "W/m²");
/// assert_eq!(Irradiance::from_si(2.0).to_si(), 2.0);
/// ```
pub trait Quantity:
    Copy + PartialEq + PartialOrd + Debug + Display + FromStr<Err = ParseQuantityError>
{
    /// The units in which text may give this quantity.
    const TABLE: &'static UnitTable;

    /// The name in running text, such as "luminous flux".
    const NAME: &'static str = Self::TABLE.quantity;

    /// The SI unit, as printed: "W/(m² sr)".
    const UNIT: &'static str = Self::TABLE.si;

    /// The quantity of this many SI units.
    fn from_si(value: f64) -> Self;

    /// The number of SI units.
    fn to_si(self) -> f64;
}
