//! A rough metal, with the light that its facets pass to one another.
//!
//! ρ = F(d_e·m) D(m) G₂(d_e, d_i)/(4 cosθ_e cosθ_i) + F_ms (1 − E(d_e))(1 − E(d_i))/(π (1 − Ē)),
//! F_ms = F̄² Ē/(1 − F̄ (1 − Ē)).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F, F̄ | Fresnel reflectance of a facet, and its hemispherical mean | 1 |
//! | m | normal half-way between d_e and d_i | |
//! | D, G₂ | density and visibility of [`Facets`] | 1/sr, 1 |
//! | E, Ē | albedo of the first term at F = 1, and its hemispherical mean | 1 |
//!
//! A perfectly reflecting metal has albedo 1 at every angle (measured for α = .05 … 1: within
//! 2e-3 for GGX, 5e-3 for Beckmann). The first term is
//! drawn from the visible normals (weight at most F), the second in proportion to (1 − E) cosθ (weight at most about
//! F_ms); the second is taken with probability 1 − E(d_e), so that a weight is at most 1/E(d_e).
//!
//! Source: B. Walter et al., EGSR 2007, eq. 20; C. Kulla and A. Conty, SIGGRAPH 2017 course, with F̄² for light
//! that met at least two facets (E. Turquin, *Practical multiple scattering compensation*, 2019). The colour of
//! the second term is an approximation, its energy is not.
//!
//! ```
//! use steradian::brdf::{ComplexIndex, Facets, RoughConductor, Slopes};
//! use steradian::geometry::Direction;
//! let facets = Facets::isotropic(Slopes::Ggx, 1.0)?;
//! let white = RoughConductor::new(facets, ComplexIndex::PERFECT);
//! assert!((white.albedo(Direction::Z).mean() - 1.0).abs() < 2e-3);
//! let peers = RoughConductor::single_scattering(facets, ComplexIndex::PERFECT);
//! // One facet sends back 1 − ln 2 of the light from above.
//! assert!((peers.albedo(Direction::Z).mean() - (1.0 - std::f32::consts::LN_2)).abs() < 1e-6);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

use super::missing::MissingLight;
use super::{Facets, PANELS, mean_over_facets};
use crate::brdf::sampling::{above, choose};
use crate::brdf::{ComplexIndex, Scatter, to_spectrum};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A rough metal.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughConductor {
    facets: Facets,
    index: ComplexIndex,
    later: Option<LaterLight>,
}

/// The second term.
#[derive(Clone, Debug, PartialEq)]
struct LaterLight {
    missing: Arc<MissingLight>,
    /// F_ms.
    reflectance: [f64; 4],
}

impl RoughConductor {
    /// With multiple scattering.
    pub fn new(facets: Facets, index: ComplexIndex) -> Self {
        let white = Self::single_scattering(facets, ComplexIndex::PERFECT);
        let missing =
            MissingLight::new(facets.is_isotropic(), |wo| 1.0 - white.first(wo, PANELS)[0]);
        Self {
            later: Some(LaterLight::new(Arc::new(missing), index)),
            ..Self::single_scattering(facets, index)
        }
    }

    /// The same surface of another metal, which shares the tables of this one.
    #[must_use]
    pub fn with_index(&self, index: ComplexIndex) -> Self {
        let later = self.later.as_ref();
        Self {
            later: later.map(|later| LaterLight::new(Arc::clone(&later.missing), index)),
            ..Self::single_scattering(self.facets, index)
        }
    }

    /// The first term alone, which loses light: comparable to renderers without compensation.
    pub const fn single_scattering(facets: Facets, index: ComplexIndex) -> Self {
        Self {
            facets,
            index,
            later: None,
        }
    }

    /// ρ(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        let Some(m) = half_way(wo, wi) else {
            return Spectrum::ZERO;
        };
        let first =
            self.facets.density(m) * self.facets.shadowing(wo, wi) / (4.0 * wo.z() * wi.z());
        let reflectance = self.index.reflectance(wo.dot(m).clamp(0.0, 1.0));
        let later = self
            .later
            .as_ref()
            .map_or([0.0; 4], |later| later.evaluate(wo, wi));
        to_spectrum(std::array::from_fn(|lane| {
            reflectance[lane] * first + later[lane]
        }))
    }

    /// A direction of the first or the second term; `None` where the mirrored direction lies below the surface.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        if wo.z() <= 0.0 {
            return None;
        }
        let (again, u0) = choose(u[0], self.later_share(wo));
        let wi = match &self.later {
            Some(later) if again => later.missing.sample([u0, u[1]]),
            _ => self.facets.sample_reflection(wo, [u0, u[1]])?,
        };
        Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
    }

    /// The mixture of both densities.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let Some(m) = half_way(wo, wi) else {
            return 0.0;
        };
        let share = self.later_share(wo);
        let later = self
            .later
            .as_ref()
            .map_or(0.0, |later| later.missing.pdf(wi));
        (1.0 - share) * self.facets.reflection_density(wo, m) + share * later
    }

    /// By quadrature over the facets: within a few 1e-3.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            return Spectrum::ZERO;
        }
        let first = self.first(wo, PANELS);
        let share = self.later_share(wo);
        let later = self
            .later
            .as_ref()
            .map_or([0.0; 4], |later| later.reflectance);
        to_spectrum(std::array::from_fn(|lane| {
            first[lane] + share * later[lane]
        }))
    }

    /// Albedo of the first term, by [`mean_over_facets`].
    pub(super) fn first(&self, wo: Direction, panels: u32) -> [f64; 4] {
        let wo = self.facets.turned(wo);
        mean_over_facets(wo, panels, |u| self.first_weight(wo, u).unwrap_or([0.0; 4]))
    }

    /// F D G₂/(4 cosθ_e) over the density of the sampled direction.
    fn first_weight(&self, wo: Direction, u: [f64; 2]) -> Option<[f64; 4]> {
        let wi = self.facets.sample_reflection(wo, u)?;
        let m = half_way(wo, wi)?;
        let density = self.facets.reflection_density(wo, m);
        if density <= 0.0 {
            return None;
        }
        let weight =
            self.facets.density(m) * self.facets.shadowing(wo, wi) / (4.0 * wo.z() * density);
        let reflectance = self.index.reflectance(wo.dot(m).clamp(0.0, 1.0));
        Some(reflectance.map(|f| f * weight))
    }

    /// 1 − E(d_e), or 0 for single scattering.
    pub(super) fn later_share(&self, wo: Direction) -> f64 {
        self.later
            .as_ref()
            .map_or(0.0, |later| later.missing.at(wo))
    }
}

impl LaterLight {
    fn new(missing: Arc<MissingLight>, index: ComplexIndex) -> Self {
        let average = 1.0 - missing.average();
        let reflectance = index
            .average_reflectance()
            .map(|f| f * f * average / (1.0 - f * (1.0 - average)));
        Self {
            missing,
            reflectance,
        }
    }

    fn evaluate(&self, wo: Direction, wi: Direction) -> [f64; 4] {
        let both = self.missing.at(wo) * self.missing.at(wi);
        let lobe = both * FRAC_1_PI / self.missing.average();
        self.reflectance.map(|f| f * lobe)
    }
}

/// The normal that mirrors one direction into the other, both above the surface.
fn half_way(wo: Direction, wi: Direction) -> Option<Direction> {
    if !above(wo, wi) {
        return None;
    }
    Direction::new(wo.to_vector() + wi.to_vector()).ok()
}
