//! A quantity that may be given in radiant or in photometric units.

use std::fmt;
use std::str::FromStr;

use super::parse::{ParseQuantityError, parse_any};
use super::value::Quantity;

/// The radiant quantity `R` or its photometric twin `P`, as the input has it.
///
/// ```
/// use steradian::quantity::{Amount, Flux, LuminousFlux};
/// type Power = Amount<Flux, LuminousFlux>;
///
/// assert_eq!("800 lm".parse(), Ok(Power::Photometric(LuminousFlux::from_lumens(800.0))));
/// assert_eq!("9 W".parse(), Ok(Power::Radiant(Flux::from_watts(9.0))));
/// assert_eq!(
///     "9 lx".parse::<Power>().unwrap_err().to_string(),
///     "expected a flux or a luminous flux such as \"60 W\" (accepted units: W, mW, kW, MW, uW, lm, mlm, klm), \
///      found \"9 lx\", which is an illuminance",
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount<R, P> {
    /// Given in units of energy.
    Radiant(R),
    /// Given in units of light as the eye weighs it.
    Photometric(P),
}

impl<R, P> Amount<R, P> {
    /// Whether it was given in photometric units.
    pub const fn is_photometric(&self) -> bool {
        matches!(self, Self::Photometric(_))
    }
}

impl<R: Quantity, P: Quantity> FromStr for Amount<R, P> {
    type Err = ParseQuantityError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match parse_any(text, &[R::TABLE, P::TABLE])? {
            (0, value) => Self::Radiant(R::from_si(value)),
            (_, value) => Self::Photometric(P::from_si(value)),
        })
    }
}

impl<R: fmt::Display, P: fmt::Display> fmt::Display for Amount<R, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Radiant(quantity) => quantity.fmt(f),
            Self::Photometric(quantity) => quantity.fmt(f),
        }
    }
}
