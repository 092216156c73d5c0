//! Measured surfaces: tables of values instead of laws.
//!
//! | model | table | of |
//! |---|---|---|
//! | [`TwoSided`] | patches of Klems, tensor trees; four blocks | LBNL BSDF XML |
//! | [`Merl`] | half and difference angles, red, green and blue | MERL |
//! | [`Rgl`] | warped half vectors, spectra or colours | EPFL's RGL |
//!
//! Directions keep the contract of [`brdf`](super): the table's incidence is d_i, where the light comes from, and its
//! scattering is d_e. ρ is what the table holds, constant on its patches or leaves; nothing is made reciprocal, so the
//! directional-hemispherical share of the light that arrives along d (`hemispherical`) may differ from the albedo towards d.
//! Above, z > 0, is the interior, which files of WINDOW call `Back`; azimuths of incidence and scattering are the same for light
//! that goes straight on. These are the conventions of Radiance.
//!
//! Directions are drawn from the tables themselves: for [`TwoSided`] every weight is albedo + transmittance; the others state their bounds.
//!
//! ```
//! use steradian::brdf::measured::{AngleBasis, Block, PatchMatrix, Side, TwoSided};
//! use steradian::geometry::Direction;
//! // 41 × 41 patches of .5/π are a Lambertian surface of reflectance .5.
//! let basis = AngleBasis::named("LBNL/Klems Quarter").remove(0);
//! let values = vec![0.5 / std::f32::consts::PI; 41 * 41];
//! let matrix = PatchMatrix::new(basis.clone(), basis, values)?;
//! let mut paper = TwoSided::default();
//! paper.set_reflection(Side::Above, Block::Matrix(matrix));
//! let [reflected, transmitted] = paper.hemispherical(Direction::Z);
//! assert!((reflected - 0.5).abs() < 1e-7 && transmitted == 0.0);
//! # Ok::<(), steradian::brdf::measured::MeasuredError>(())
//! ```

mod basis;
mod disc;
mod error;
mod matrix;
mod merl;
mod reading;
mod rgl;
#[cfg(test)]
pub(crate) mod testing;
mod tree;
mod two_sided;
mod warp;

use std::sync::Arc;

pub use basis::AngleBasis;
pub use error::MeasuredError;
pub use matrix::PatchMatrix;
pub use merl::Merl;
pub use reading::Reading;
pub use rgl::{Rgl, RglTables};
pub use tree::{Rank, TensorTree, TreeBuilder};
pub use two_sided::{Block, Side, TwoSided};
pub use warp::Sheets;

use super::Scatter;
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A table of values; copies share it.
#[derive(Clone, Debug, PartialEq)]
pub enum Measured {
    /// Blocks of reflection and transmission of either side.
    TwoSided(Arc<TwoSided>),
    /// Isotropic reflection by half and difference vector.
    Merl(Arc<Merl>, Reading),
    /// Reflection on warped half vectors.
    Rgl(Arc<Rgl>, Reading),
}

impl Measured {
    /// The same table for the lanes of a run; none if it says nothing about them, as colours do about wavelengths.
    pub fn in_lanes(&self, lanes: Reading) -> Option<Self> {
        match (self, lanes) {
            (Self::TwoSided(_), _) => Some(self.clone()),
            (Self::Merl(..), Reading::Wavelengths(_)) => None,
            (Self::Rgl(table, _), Reading::Wavelengths(_)) if table.wavelengths().is_none() => None,
            (Self::Rgl(table, _), _) => Some(Self::Rgl(Arc::clone(table), lanes)),
            (Self::Merl(table, _), _) => Some(Self::Merl(Arc::clone(table), lanes)),
        }
    }

    /// Whether its lanes are single wavelengths, so that it changes from path to path.
    pub const fn is_at_wavelengths(&self) -> bool {
        matches!(self, Self::Rgl(_, Reading::Wavelengths(_)))
    }

    /// ρ(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        match self {
            Self::TwoSided(table) => table.evaluate(wo, wi),
            Self::Merl(table, reading) => table.evaluate(wo, wi, *reading),
            Self::Rgl(table, reading) => table.evaluate(wo, wi, *reading),
        }
    }

    /// A direction drawn from the table.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        match self {
            Self::TwoSided(table) => table.sample(wo, u),
            Self::Merl(table, reading) => table.sample(wo, u, *reading),
            Self::Rgl(table, reading) => table.sample(wo, u, *reading),
        }
    }

    /// Density of [`sample`](Self::sample).
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        match self {
            Self::TwoSided(table) => table.pdf(wo, wi),
            Self::Merl(table, _) => table.pdf(wo, wi),
            Self::Rgl(table, _) => table.pdf(wo, wi),
        }
    }

    /// ∫ ρ cosθ_i dω_i over d_e's side.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        match self {
            Self::TwoSided(table) => to_spectrum(table.totals(wo)[0]),
            Self::Merl(table, reading) => reading.of_colour(table.albedo(wo)),
            Self::Rgl(table, reading) => table.albedo(wo, *reading),
        }
    }

    /// ∫ ρ |cosθ_i| dω_i over the other side.
    pub fn transmittance(&self, wo: Direction) -> Spectrum {
        match self {
            Self::TwoSided(table) => to_spectrum(table.totals(wo)[1]),
            Self::Merl(..) | Self::Rgl(..) => Spectrum::ZERO,
        }
    }
}

/// Refuses values that no surface has.
fn check_values(values: &[f32]) -> Result<(), MeasuredError> {
    match values
        .iter()
        .position(|value| !(*value >= 0.0 && value.is_finite()))
    {
        Some(index) => Err(MeasuredError::Value {
            index,
            found: values[index],
        }),
        None => Ok(()),
    }
}

fn to_spectrum(value: f64) -> Spectrum {
    Spectrum::splat(value as f32)
}
