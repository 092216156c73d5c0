//! The accounts of an energy balance: emitted = absorbed + escaped.
//!
//! | account | what it holds | how it is known |
//! |---|---|---|
//! | emitted | Φ of each light | in closed form, Φ = πLA, 4πI, ∫ I dω; sampled where emission varies over a surface |
//! | | light that comes from infinitely far | sampled on a sphere around the scene, as what arrives from outside |
//! | absorbed | ∫ (1 − ρ) E dA on each side of each shape | sampled from that side |
//! | escaped | what passes the sphere outwards | sampled on it |
//!
//! Each account looks for light by itself, with random numbers of its own, so that their agreement is a test: of the models'
//! albedos, of the lights, and of the paths between them.

use super::{FluxOf, FluxSurface};
use crate::light::LightId;

/// A side of the balance.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Term {
    /// What lights give.
    Emitted,
    /// What surfaces keep.
    Absorbed,
    /// What goes away for good.
    Escaped,
}

impl Term {
    /// All of them, in the order of reports.
    pub const ALL: [Self; 3] = [Self::Emitted, Self::Absorbed, Self::Escaped];

    /// The name of the sensor that reads it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Emitted => "emitted",
            Self::Absorbed => "absorbed",
            Self::Escaped => "escaped",
        }
    }
}

/// A reading of the balance.
#[derive(Clone, Debug)]
pub struct Account {
    /// The lights or the surface.
    pub about: String,
    /// What is read.
    pub entry: Entry,
}

/// What an account holds.
#[derive(Clone, Debug)]
pub enum Entry {
    /// The flux of lights, in closed form.
    Lights(Vec<LightId>),
    /// The flux of a surface.
    Flux(FluxSurface, FluxOf),
}
