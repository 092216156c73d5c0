//! Reflection of surfaces: the BRDF ρ(d_e, d_i) = dL(d_e) / dH(d_i), in 1/sr.
//!
//! Directions are local: the surface's normal is z, and both d_i (`wi`, towards the light) and d_e (`wo`, towards the
//! viewer) point away from the surface. A value never contains the cosine: foreshortening belongs to the reflection
//! integral L(d_e) = ∫ ρ(d_e, d_i) L(p, −d_i) cosθ_i dω_i alone. A mirror is no function in 1/sr, so a sampled
//! direction is either [`Scatter::Finite`] or [`Scatter::Specular`].
//!
//! Every model keeps this contract:
//!
//! | function | law | unit |
//! |---|---|---|
//! | `evaluate` | ρ ≥ 0, ρ(a, b) = ρ(b, a), 0 if either direction lies below the surface | 1/sr |
//! | `sample` | draws d_i with density `pdf`; ρ·cosθ_i/pdf is bounded | |
//! | `pdf` | ∫ pdf dω_i ≤ 1 | 1/sr |
//! | `albedo` | ∫ ρ(d_e, d_i) cosθ_i dω_i ≤ 1: the directional-hemispherical reflectance | 1 |

pub mod fresnel;
mod lambertian;
mod mirror;

pub use lambertian::Lambertian;
pub use mirror::Mirror;

use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A sampled direction of incidence.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum Scatter {
    /// From a density in solid angle.
    Finite {
        /// d_i.
        wi: Direction,
        /// ρ(d_e, d_i) in 1/sr.
        value: Spectrum,
        /// Density of `wi` in 1/sr.
        pdf: f64,
    },
    /// The one direction that a smooth surface couples with d_e.
    Specular {
        /// d_i.
        wi: Direction,
        /// L(d_e) / L(p, −d_i).
        reflectance: Spectrum,
    },
}

/// The closed set of models.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum Brdf {
    /// ρ/π.
    Lambertian(Lambertian),
    /// A smooth mirror.
    Mirror(Mirror),
}

impl Brdf {
    /// ρ(d_e, d_i) in 1/sr, without cosine; zero for a mirror.
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        match self {
            Self::Lambertian(model) => model.evaluate(wo, wi),
            Self::Mirror(_) => Spectrum::ZERO,
        }
    }

    /// A direction of incidence from two uniform numbers; `None` when `wo` lies below the surface.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        match self {
            Self::Lambertian(model) => model.sample(wo, u),
            Self::Mirror(model) => model.sample(wo),
        }
    }

    /// Density of [`sample`](Self::sample) in 1/sr; zero for a mirror.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        match self {
            Self::Lambertian(model) => model.pdf(wo, wi),
            Self::Mirror(_) => 0.0,
        }
    }

    /// Directional-hemispherical reflectance.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        match self {
            Self::Lambertian(model) => model.albedo(wo),
            Self::Mirror(model) => model.albedo(wo),
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
