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
//! 5e-4). The first term is
//! drawn from the visible normals (weight at most F), the second in proportion to (1 − E) cosθ (weight at most about
//! F_ms); the second is taken with probability 1 − E(d_e), so that a weight is at most 1/E(d_e).
//!
//! [`schlick`](RoughConductor::schlick) has F = F₀ + (F₉₀ − F₀)(1 − d_e·m)⁵ instead, as glTF asks for.
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
use super::later::Later;
use super::metal::Metal;
use super::quadrature::{Fan, Ray};
use super::shelf::{Blend, Recent, Shelf};
use super::table::Table;
use crate::brdf::error::share;
use crate::brdf::fresnel::schlick_rise;
use crate::brdf::sampling::choose;
use crate::brdf::{ComplexIndex, Gloss, ModelError, Scatter, to_spectrum};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A rough metal.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughConductor {
    facets: Facets,
    mirror: Mirroring,
    later: Option<LaterLight>,
}

/// What a facet reflects.
#[derive(Copy, Clone, Debug, PartialEq)]
enum Mirroring {
    /// By Fresnel's equations.
    Metal(ComplexIndex),
    /// By Schlick's approximation, from reflectances along the normal and at the horizon.
    Schlick { normal: [f64; 4], grazing: [f64; 4] },
}

impl Mirroring {
    fn reflectance(&self, cos: f64) -> [f64; 4] {
        match self {
            Self::Metal(index) => index.reflectance(cos),
            Self::Schlick { normal, grazing } => {
                let rise = schlick_rise(cos);
                std::array::from_fn(|lane| normal[lane] + (grazing[lane] - normal[lane]) * rise)
            }
        }
    }

    /// 2 ∫ (1 − µ)⁵ µ dµ = 1/21.
    fn average(&self) -> [f64; 4] {
        match self {
            Self::Metal(index) => index.average_reflectance(),
            Self::Schlick { normal, grazing } => {
                std::array::from_fn(|lane| normal[lane] + (grazing[lane] - normal[lane]) / 21.0)
            }
        }
    }
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
    /// Isotropic surfaces share their tables, whatever their roughness; the table of an anisotropic one takes tenths of a
    /// second unless one like it was made before, so that its widths should not vary from point to point.
    pub fn new(facets: Facets, index: ComplexIndex) -> Self {
        Self {
            later: Some(LaterLight::new(
                white_shares(facets),
                Mirroring::Metal(index),
            )),
            ..Self::single_scattering(facets, index)
        }
    }

    /// With multiple scattering, of facets that reflect by Schlick's approximation: a share along the normal that rises to another
    /// at the horizon.
    ///
    /// # Errors
    /// If a lane lies outside 0 … 1.
    pub fn schlick(
        facets: Facets,
        normal: Spectrum,
        grazing: Spectrum,
    ) -> Result<Self, ModelError> {
        let lanes =
            |name, found| share(name, found).map(|found: Spectrum| found.to_lanes().map(f64::from));
        let mirror = Mirroring::Schlick {
            normal: lanes("reflectance along the normal", normal)?,
            grazing: lanes("reflectance at the horizon", grazing)?,
        };
        Ok(Self {
            facets,
            mirror,
            later: Some(LaterLight::new(white_shares(facets), mirror)),
        })
    }

    /// The same surface of another metal.
    #[must_use]
    pub fn with_index(&self, index: ComplexIndex) -> Self {
        let later = self.later.as_ref();
        Self {
            later: later
                .map(|later| LaterLight::new(later.shares.clone(), Mirroring::Metal(index))),
            ..Self::single_scattering(self.facets, index)
        }
    }

    /// The first term alone, which loses light: comparable to renderers without compensation.
    pub const fn single_scattering(facets: Facets, index: ComplexIndex) -> Self {
        Self {
            facets,
            mirror: Mirroring::Metal(index),
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
        let reflectance = self.mirror.reflectance(wo.dot(m).clamp(0.0, 1.0));
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
        to_spectrum(self.leaving(wo, |_| 1.0))
    }

    /// ∫ ρ f cosθ_i dω_i, where f does not depend on azimuth.
    pub(in crate::brdf) fn leaving(&self, wo: Direction, f: impl Fn(Direction) -> f64) -> [f64; 4] {
        let reflectance = |cos| self.mirror.reflectance(cos);
        let first = mirrored_light(self.facets, wo, 1, reflectance, &f);
        let Some(later) = &self.later else {
            return first;
        };
        let again = later.shares.missing(0, wo) * later.shares.mean(0, f);
        std::array::from_fn(|lane| first[lane] + again * later.reflectance[lane])
    }

    /// Albedo of the first term.
    #[cfg(test)]
    pub(super) fn first(&self, wo: Direction, fineness: usize) -> [f64; 4] {
        let reflectance = |cos| self.mirror.reflectance(cos);
        mirrored_light(self.facets, wo, fineness, reflectance, |_| 1.0)
    }

    /// The albedo of a surface by Schlick's approximation with multiple scattering, from the tables; of others 1, which it never
    /// exceeds.
    pub(in crate::brdf) fn tabulated_albedo(&self, wo: Direction) -> [f64; 4] {
        self.mixed_by(|shares| shares.at(0, wo))
    }

    /// Its hemispherical mean.
    pub(in crate::brdf) fn tabulated_average(&self) -> [f64; 4] {
        self.mixed_by(|shares| shares.averages(0))
    }

    /// F₀ (1 − M − N) + F₉₀ N + F_ms M.
    fn mixed_by(&self, shares: impl Fn(&Blend<1>) -> [f64; 2]) -> [f64; 4] {
        let (Mirroring::Schlick { normal, grazing }, Some(later)) = (self.mirror, &self.later)
        else {
            return [1.0; 4];
        };
        let [missing, rise] = shares(&later.shares);
        std::array::from_fn(|lane| {
            normal[lane] * (1.0 - missing - rise)
                + grazing[lane] * rise
                + later.reflectance[lane] * missing
        })
    }

    /// Both terms as loops over many paths know them; none of Gaussian facets, Schlick's approximation, and anisotropic surfaces with a
    /// second term.
    pub(crate) fn in_columns(&self) -> Option<(Metal, Option<Later>)> {
        let Mirroring::Metal(index) = self.mirror else {
            return None;
        };
        let first = Metal::new(self.facets, index.parts())?;
        let later = self.later.as_ref();
        let later = later.map(|later| Later::new(&later.shares, later.reflectance));
        match later {
            Some(None) => None,
            later => Some((first, later.flatten())),
        }
    }

    /// α_x and α_y.
    #[cfg(test)]
    pub(super) const fn widths(&self) -> [f64; 2] {
        self.facets.widths()
    }

    /// Of the first term.
    pub(in crate::brdf) fn gloss(&self, wo: Direction) -> Gloss {
        Gloss::of_facets(self.facets, 1.0 - self.later_share(wo))
    }

    /// 1 − E(d_e), or 0 for single scattering.
    pub(super) fn later_share(&self, wo: Direction) -> f64 {
        self.later
            .as_ref()
            .map_or(0.0, |later| later.shares.missing(0, wo))
    }
}

impl LaterLight {
    fn new(shares: Blend<1>, mirror: Mirroring) -> Self {
        let average = 1.0 - shares.average(0);
        let reflectance = mirror
            .average()
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

/// ∫ F D G₂/(4 cosθ_e) f dω_i, with F by the cosine of d_e to the facet and f by d_i.
pub(super) fn mirrored_light<const N: usize>(
    facets: Facets,
    wo: Direction,
    fineness: usize,
    reflectance: impl Fn(f64) -> [f64; N],
    f: impl Fn(Direction) -> f64,
) -> [f64; N] {
    Fan::new(facets, wo, fineness).integrate(Ray::mirroring, |m| {
        let wi = m.mirror(wo);
        let visible = if wi.z() > 0.0 {
            facets.shadowing(wo, wi) * f(wi)
        } else {
            0.0
        };
        reflectance(wo.dot(m).clamp(0.0, 1.0)).map(|share| share * visible)
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
        let both = |cos| [1.0, schlick_rise(cos)];
        let [white, schlick] = mirrored_light(facets, wo, 1, both, |_| 1.0);
        [1.0 - white, schlick]
    })
}
