//! Reflection and transmission of surfaces: the BRDF ρ(d_e, d_i) = dL(d_e) / dH(d_i), in 1/sr, and its like through the
//! surface.
//!
//! Directions are local: the surface's normal is z, and both d_i (`wi`, towards the light) and d_e (`wo`, towards the
//! viewer) point away from the surface. A value never contains the cosine: foreshortening belongs to the reflection
//! integral L(d_e) = ∫ ρ(d_e, d_i) L(p, −d_i) |cosθ_i| dω_i alone. A mirror is no function in 1/sr, so a sampled
//! direction is either [`Scatter::Finite`] or [`Scatter::Specular`].
//!
//! The normal points to the outside. Models that transmit light take either direction on either side; the others reflect
//! on the outside only and are black from below.
//!
//! Every model keeps this contract:
//!
//! | function | law | unit |
//! |---|---|---|
//! | `evaluate` | ρ ≥ 0, ρ(a, b)/n_a² = ρ(b, a)/n_b²; 0 where the model neither reflects nor transmits | 1/sr |
//! | `sample` | draws d_i with density `pdf`; ρ·\|cosθ_i\|/pdf is bounded, the model's doc says by what | |
//! | `pdf` | ∫ pdf dω_i ≤ 1 over the whole sphere | 1/sr |
//! | `albedo` | share of the light along d_e that is reflected: ∫ ρ cosθ_i dω_i over d_e's side | 1 |
//! | `transmittance` | share that goes through: (n_i/n_e)² ∫ ρ \|cosθ_i\| dω_i over the other side | 1 |
//! | `radiance_scale` | (n_e/n_i)² from one side to the other, 1 on the same side | 1 |
//!
//! albedo + transmittance ≤ 1. ρ relates radiances, which change by (n_e/n_i)² across an interface (n_e, n_i are the
//! indices on the sides of d_e and d_i); shares of power do not. Whoever carries power instead of radiance, such as
//! light tracing, divides by `radiance_scale`. Source: E. Veach, *Robust Monte Carlo Methods for Light Transport
//! Simulation* (1997), §5.2, eq. 5.14.

pub mod check;
mod complex_index;
mod diffuse_transmission;
mod eon;
mod error;
pub mod fresnel;
mod gloss;
mod lambertian;
pub mod measured;
mod microfacet;
mod mirror;
mod mixture;
mod oren_nayar;
mod pane;
mod phong;
mod plastic;
mod principled;
mod sampling;
mod smooth_conductor;
mod smooth_dielectric;
mod ward;

pub use complex_index::ComplexIndex;
pub use diffuse_transmission::DiffuseTransmission;
pub use eon::EnergyPreservingOrenNayar;
pub use error::ModelError;
pub(crate) use gloss::Gloss;
pub use lambertian::Lambertian;
pub use measured::Measured;
pub use microfacet::{Facets, RoughConductor, RoughDielectric, RoughPlastic, Shadowing, Slopes};
pub(crate) use microfacet::{Later, Metal};
pub use mirror::Mirror;
pub use mixture::Mixture;
pub use oren_nayar::OrenNayar;
pub use pane::Pane;
pub use phong::Phong;
pub use plastic::Plastic;
pub use principled::{Parameters as PrincipledParameters, Principled};
pub use smooth_conductor::SmoothConductor;
pub use smooth_dielectric::SmoothDielectric;
pub use ward::Ward;

use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A sampled direction of incidence: reflected if it lies on the viewer's side of the surface, else transmitted.
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
    /// One of the directions that a smooth surface couples with d_e.
    Specular {
        /// d_i.
        wi: Direction,
        /// L(d_e) / L(p, −d_i), over the probability of choosing this direction.
        reflectance: Spectrum,
    },
}

impl Scatter {
    /// A sample from a density; `None` if the density is 0.
    fn finite(wi: Direction, value: Spectrum, pdf: f64) -> Option<Self> {
        (pdf > 0.0).then_some(Self::Finite { wi, value, pdf })
    }

    /// d_i.
    pub const fn wi(&self) -> Direction {
        match self {
            Self::Finite { wi, .. } | Self::Specular { wi, .. } => *wi,
        }
    }

    /// By how much radiance from `wi` counts: ρ |cosθ_i|/pdf, or the factor of the smooth surface.
    pub fn weight(&self) -> Spectrum {
        match self {
            Self::Finite { wi, value, pdf } => *value * (wi.z().abs() / pdf),
            Self::Specular { reflectance, .. } => *reflectance,
        }
    }

    /// Whether light goes through the surface on its way to `wo`.
    pub fn is_transmitted(&self, wo: Direction) -> bool {
        (self.wi().z() < 0.0) != (wo.z() < 0.0)
    }
}

/// The closed set of models.
#[derive(Clone, Debug, PartialEq)]
pub enum Brdf {
    /// ρ/π.
    Lambertian(Lambertian),
    /// A mirror of constant reflectance.
    Mirror(Mirror),
    /// Rough diffuse reflection, single scattering.
    OrenNayar(OrenNayar),
    /// Rough diffuse reflection that keeps its energy.
    EnergyPreservingOrenNayar(EnergyPreservingOrenNayar),
    /// Diffuse reflection and transmission.
    DiffuseTransmission(DiffuseTransmission),
    /// Diffuse reflection and a glossy lobe, for teaching.
    Phong(Phong),
    /// Rough metal.
    RoughConductor(RoughConductor),
    /// A rough interface of two dielectrics.
    RoughDielectric(RoughDielectric),
    /// Polished metal.
    SmoothConductor(SmoothConductor),
    /// A smooth interface of two dielectrics.
    SmoothDielectric(SmoothDielectric),
    /// A thin pane of glass.
    Pane(Pane),
    /// A table of values.
    Measured(Measured),
    /// A smooth coat over a diffuse base.
    Plastic(Plastic),
    /// A rough coat over a diffuse base.
    RoughPlastic(RoughPlastic),
    /// Ward's gloss, and Radiance's materials.
    Ward(Ward),
    /// Several models side by side.
    Mixture(Mixture),
    /// glTF's material.
    Principled(Box<Principled>),
}

/// What a model with values in 1/sr says, or what is so of the others.
macro_rules! finite {
    ($brdf:expr, $model:ident => $says:expr, $others:expr) => {
        match $brdf {
            Brdf::Lambertian($model) => $says,
            Brdf::OrenNayar($model) => $says,
            Brdf::EnergyPreservingOrenNayar($model) => $says,
            Brdf::DiffuseTransmission($model) => $says,
            Brdf::Measured($model) => $says,
            Brdf::Phong($model) => $says,
            Brdf::RoughConductor($model) => $says,
            Brdf::RoughDielectric($model) => $says,
            Brdf::Plastic($model) => $says,
            Brdf::RoughPlastic($model) => $says,
            Brdf::Ward($model) => $says,
            Brdf::Mixture($model) => $says,
            Brdf::Principled($model) => $says,
            Brdf::Mirror(_)
            | Brdf::SmoothConductor(_)
            | Brdf::SmoothDielectric(_)
            | Brdf::Pane(_) => $others,
        }
    };
}

impl Brdf {
    /// ρ(d_e, d_i) in 1/sr, without cosine; zero for a smooth surface.
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        finite!(self, model => model.evaluate(wo, wi), Spectrum::ZERO)
    }

    /// A direction of incidence from two uniform numbers; `None` where the model is black or the direction drawn lies
    /// where nothing is scattered.
    ///
    /// Models that choose between parts use what is left of the first number again.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        match self {
            Self::Mirror(model) => model.sample(wo),
            Self::SmoothConductor(model) => model.sample(wo),
            Self::SmoothDielectric(model) => model.sample(wo, u),
            Self::Pane(model) => model.sample(wo, u),
            _ => finite!(self, model => model.sample(wo, u), None),
        }
    }

    /// Density of [`sample`](Self::sample) in 1/sr; zero for a smooth surface.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        finite!(self, model => model.pdf(wo, wi), 0.0)
    }

    /// Directional-hemispherical reflectance.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        match self {
            Self::Mirror(model) => model.albedo(wo),
            Self::SmoothConductor(model) => model.albedo(wo),
            Self::SmoothDielectric(model) => model.albedo(wo),
            Self::Pane(model) => model.albedo(wo),
            _ => finite!(self, model => model.albedo(wo), Spectrum::ZERO),
        }
    }

    /// Directional-hemispherical transmittance, a share of power.
    pub fn transmittance(&self, wo: Direction) -> Spectrum {
        match self {
            Self::Measured(model) => model.transmittance(wo),
            Self::DiffuseTransmission(model) => model.transmittance(wo),
            Self::RoughDielectric(model) => model.transmittance(wo),
            Self::SmoothDielectric(model) => model.transmittance(wo),
            Self::Pane(model) => model.transmittance(wo),
            Self::Ward(model) => model.transmittance(wo),
            Self::Mixture(model) => model.transmittance(wo),
            Self::Principled(model) => model.transmittance(wo),
            _ => Spectrum::ZERO,
        }
    }

    /// The index inside over the index outside of an interface between two media; `None` of other surfaces.
    pub fn interior_index(&self) -> Option<f64> {
        match self {
            Self::SmoothDielectric(model) => Some(model.eta()),
            Self::RoughDielectric(model) => Some(model.eta()),
            Self::Mixture(model) => model.interior_index(),
            Self::Principled(model) => model.interior_index(),
            _ => None,
        }
    }

    /// The highlight of light reflected to `wo`, of models that know theirs.
    pub(crate) fn gloss(&self, wo: Direction) -> Option<Gloss> {
        match self {
            Self::RoughConductor(model) => Some(model.gloss(wo)),
            Self::RoughPlastic(model) => model.gloss(wo),
            Self::Principled(model) => model.gloss(wo),
            _ => None,
        }
    }

    /// (n_e/n_i)²: radiance towards `wo` over radiance from `wi` of the same power, by the indices of their sides.
    pub fn radiance_scale(&self, wo: Direction, wi: Direction) -> f64 {
        let eta = self.interior_index().unwrap_or(1.0);
        scale_of(eta, wo, wi)
    }
}

/// (n_e/n_i)² by the index below over that above.
fn scale_of(eta: f64, wo: Direction, wi: Direction) -> f64 {
    match (wo.z() < 0.0, wi.z() < 0.0) {
        (true, false) => eta * eta,
        (false, true) => 1.0 / (eta * eta),
        _ => 1.0,
    }
}

/// Rounded to single precision.
fn to_spectrum(lanes: [f64; 4]) -> Spectrum {
    Spectrum::from_lanes(lanes.map(|lane| lane as f32))
}

#[cfg(test)]
pub(crate) mod tests;
