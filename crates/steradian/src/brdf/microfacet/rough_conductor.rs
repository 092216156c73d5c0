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
//! 1e-3). The first term is
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

use super::facets::{Facets, Shadowing, Slopes};
use super::half_way;
use super::quadrature::{Fan, Ray};
use super::shelf::{Blend, Recent, Shelf};
use super::table::Table;
use crate::brdf::fresnel::schlick_rise;
use crate::brdf::sampling::choose;
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
    shares: Blend<1>,
    /// F_ms.
    reflectance: [f64; 4],
}

impl RoughConductor {
    /// With multiple scattering.
    ///
    /// Isotropic surfaces share their tables, whatever their roughness; an anisotropic one is made in about a tenth of
    /// a second unless one like it was made before, so that its widths should not vary from point to point.
    pub fn new(facets: Facets, index: ComplexIndex) -> Self {
        Self {
            later: Some(LaterLight::new(white_shares(facets), index)),
            ..Self::single_scattering(facets, index)
        }
    }

    /// The same surface of another metal.
    #[must_use]
    pub fn with_index(&self, index: ComplexIndex) -> Self {
        let later = self.later.as_ref();
        Self {
            later: later.map(|later| LaterLight::new(later.shares.clone(), index)),
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
            Some(later) if again => later.shares.sample(0, [u0, u[1]]),
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
            .map_or(0.0, |later| later.shares.pdf(0, wi));
        (1.0 - share) * self.facets.reflection_density(wo, m) + share * later
    }

    /// By quadrature over the facets: the first term to 2e-4.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            return Spectrum::ZERO;
        }
        let first = self.first(wo, 1);
        let share = self.later_share(wo);
        let later = self
            .later
            .as_ref()
            .map_or([0.0; 4], |later| later.reflectance);
        to_spectrum(std::array::from_fn(|lane| {
            first[lane] + share * later[lane]
        }))
    }

    /// Albedo of the first term.
    pub(super) fn first(&self, wo: Direction, fineness: usize) -> [f64; 4] {
        mirrored_light(self.facets, wo, fineness, |cos| self.index.reflectance(cos))
    }

    /// 1 − E(d_e), or 0 for single scattering.
    pub(super) fn later_share(&self, wo: Direction) -> f64 {
        self.later
            .as_ref()
            .map_or(0.0, |later| later.shares.missing(0, wo))
    }
}

impl LaterLight {
    fn new(shares: Blend<1>, index: ComplexIndex) -> Self {
        let average = 1.0 - shares.average(0);
        let reflectance = index
            .average_reflectance()
            .map(|f| f * f * average / (1.0 - f * (1.0 - average)));
        Self {
            shares,
            reflectance,
        }
    }

    fn evaluate(&self, wo: Direction, wi: Direction) -> [f64; 4] {
        let both = self.shares.missing(0, wo) * self.shares.missing(0, wi);
        let lobe = both * FRAC_1_PI / self.shares.average(0);
        self.reflectance.map(|f| f * lobe)
    }
}

/// ∫ F D G₂/(4 cosθ_e) dω_i, with F by the cosine of d_e to the facet.
pub(super) fn mirrored_light<const N: usize>(
    facets: Facets,
    wo: Direction,
    fineness: usize,
    reflectance: impl Fn(f64) -> [f64; N],
) -> [f64; N] {
    Fan::new(facets, wo, fineness).integrate(Ray::mirroring, |m| {
        let wi = m.mirror(wo);
        let visible = if wi.z() > 0.0 {
            facets.shadowing(wo, wi)
        } else {
            0.0
        };
        reflectance(wo.dot(m).clamp(0.0, 1.0)).map(|f| f * visible)
    })
}

/// What white facets miss, and what they reflect if each reflects (1 − cos)⁵ of the light.
pub(super) fn white_shares(facets: Facets) -> Blend<1> {
    static SHELVES: [Shelf<1>; 4] = [const { Shelf::new() }; 4];
    static ANISOTROPIC: Recent<Facets, [Table; 1]> = Recent::new();
    if !facets.is_isotropic() {
        return Blend::exactly(ANISOTROPIC.get(facets, || [white_table(facets)]));
    }
    let shelf = match (facets.slopes(), facets.visibility()) {
        (Slopes::Ggx, Shadowing::HeightCorrelated) => 0,
        (Slopes::Ggx, Shadowing::Separable) => 1,
        (Slopes::Beckmann, Shadowing::HeightCorrelated) => 2,
        (Slopes::Beckmann, Shadowing::Separable) => 3,
    };
    SHELVES[shelf].blend(facets.widths()[0], |alpha| {
        [white_table(facets.with_width(alpha))]
    })
}

fn white_table(facets: Facets) -> Table {
    Table::new(facets.stretch(), |wo| {
        let [white, schlick] = mirrored_light(facets, wo, 1, |cos| [1.0, schlick_rise(cos)]);
        [1.0 - white, schlick]
    })
}
