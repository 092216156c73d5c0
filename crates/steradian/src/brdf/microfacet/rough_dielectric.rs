//! A rough interface of two dielectrics, such as ground glass, with the light that its facets pass to one another.
//!
//! With the index η of the far side of d_e over its near side, reflected and transmitted by one facet:
//!
//! ρ = F D(m) G₂/(4 cosθ_e cosθ_i),
//! ρ = (1 − F) D(m) G₁(d_e) G₁(d_i) |d_e·m| |d_i·m|/(|cosθ_e cosθ_i| (d_e·m + η d_i·m)²),
//!
//! where m halves d_e and d_i, or is along ±(d_e + η d_i).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F | Fresnel reflectance of a facet for unpolarised light | 1 |
//! | D, G₁, G₂ | density and visibility of [`Facets`] | 1/sr, 1 |
//! | M_a | share of the light along a direction of side a that one facet does not send away | 1 |
//! | t_a | share of that light that leaves to the other side | 1 |
//!
//! What is missing is given back by (1 − t_a) M_a M_a/(π M̄_a) on the same side a and t_b M_b M_a/(π M̄_a) from the other
//! side b, with t_a = min(M̄_a, M̄_b)/M̄_a (1 − F̄_a): reciprocal, as n_a² M̄_a t_a = n_b² M̄_b t_b, and albedo and
//! transmittance add up to 1 at every angle (measured for α = .05 … 1: within 5e-4).
//!
//! Facets are drawn as seen from d_e, a number hashed from the two used decides by F between the
//! sides (weight at most 1, over η² when transmitted); the rest
//! with probability M_a(d_e). A weight is at most 1/(1 − M_a(d_e)) (n_e/n_i)².
//!
//! Source: B. Walter et al., EGSR 2007, eq. 16–21, 33–41; C. Kulla and A. Conty, SIGGRAPH 2017 course, made
//! reciprocal as above. Transmission is shadowed separably, as in Walter's paper; the index is the same in all lanes.
//!
//! ```
//! use steradian::brdf::{Facets, RoughDielectric, Slopes};
//! use steradian::geometry::Direction;
//! let facets = Facets::isotropic(Slopes::Ggx, 0.3)?;
//! let ground_glass = RoughDielectric::new(facets, 1.5)?;
//! let both = ground_glass.albedo(Direction::Z) + ground_glass.transmittance(Direction::Z);
//! assert!((both.mean() - 1.0).abs() < 2e-3);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::FRAC_1_PI;

use super::facets::{Facets, Shadowing, Slopes};
use super::interface_light::{first_shares, weighed_shares};
use super::shelf::{Blend, Recent, Shelf};
use super::table::Table;
use crate::brdf::error::{in_range, tints};
use crate::brdf::fresnel::{dielectric, dielectric_average, refract};
use crate::brdf::sampling::{choose, flipped};
use crate::brdf::{ModelError, Scatter};
use crate::geometry::Direction;
use crate::quantity::Spectrum;
use crate::sampling::hash::combine;

/// Where light goes straight on it has no density, so that an index closer to 1 than this is taken to be this far from it.
const LEAST_CHANGE: f64 = 1e-4;

/// A rough interface.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughDielectric {
    facets: Facets,
    /// The index inside over the index outside.
    eta: f64,
    later: Option<LaterLight>,
    /// Of reflected and of transmitted light.
    tints: [Spectrum; 2],
}

/// What one facet does not send away, outside and inside.
#[derive(Clone, Debug, PartialEq)]
struct LaterLight {
    shares: Blend<2>,
    /// t_a.
    transmitted: [f64; 2],
}

/// Both directions as seen from the side of `wo`, which is made the upper one.
struct View {
    wo: Direction,
    wi: Direction,
    /// The index of the lower side over that of the upper.
    eta: f64,
    /// 0 where the upper side is the outside, else 1.
    side: usize,
}

impl RoughDielectric {
    /// With multiple scattering, from the index inside over the index outside.
    ///
    /// Isotropic surfaces of one index share their tables, whatever their roughness; the tables of an anisotropic one take a second
    /// or more unless one like it was made before, so that its widths should not vary from point to point.
    ///
    /// # Errors
    /// If the index lies outside 0.1 … 10.
    pub fn new(facets: Facets, eta: f64) -> Result<Self, ModelError> {
        let single = Self::single_scattering(facets, eta)?;
        let eta = single.eta;
        let shares = interface_shares(facets, eta);
        let averages = [0, 1].map(|side| shares.average(side));
        let least = averages[0].min(averages[1]);
        let through = [eta, 1.0 / eta].map(|eta| 1.0 - dielectric_average(eta));
        let transmitted = [0, 1].map(|side| through[side] * least / averages[side]);
        let later = Some(LaterLight {
            shares,
            transmitted,
        });
        Ok(Self { later, ..single })
    }

    /// The first facet alone, which loses light: comparable to renderers without compensation.
    ///
    /// # Errors
    /// If the index lies outside 0.1 … 10.
    pub fn single_scattering(facets: Facets, eta: f64) -> Result<Self, ModelError> {
        let eta = in_range("eta", eta, [0.1, 10.0])?;
        let bends = (eta - 1.0).abs() >= LEAST_CHANGE;
        Ok(Self {
            facets,
            eta: if bends { eta } else { 1.0 + LEAST_CHANGE },
            later: None,
            tints: [Spectrum::ONE; 2],
        })
    }

    /// The same interface, of which reflected and transmitted light are multiplied by these, for looks.
    ///
    /// # Errors
    /// If a lane lies outside 0 … 1.
    pub fn with_tints(
        self,
        reflection: Spectrum,
        transmission: Spectrum,
    ) -> Result<Self, ModelError> {
        let tints = tints(reflection, transmission)?;
        Ok(Self { tints, ..self })
    }

    /// Of reflected and of transmitted light.
    pub(in crate::brdf) const fn tints(&self) -> [Spectrum; 2] {
        self.tints
    }

    /// The index inside over the index outside.
    pub const fn eta(&self) -> f64 {
        self.eta
    }

    /// ρ(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        let Some(view) = View::new(wo, wi, self.eta) else {
            return Spectrum::ZERO;
        };
        let later = self.later.as_ref().map_or(0.0, |later| later.value(&view));
        let tint = self.tints[usize::from(view.wi.z() < 0.0)];
        tint * (self.first_value(&view).unwrap_or(0.0) + later)
    }

    /// A direction on either side; `None` where the direction drawn lies on the wrong one.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let view = View::new(wo, wo, self.eta)?;
        let share = self.later_share(wo);
        let (again, u0) = choose(u[0], share);
        let local = match &self.later {
            Some(later) if again => later.sample(view.side, [u0, u[1]]),
            _ => self.sample_first(&view, [u0, u[1]])?,
        };
        let wi = if view.side == 0 {
            local
        } else {
            flipped(local)
        };
        Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
    }

    /// The mixture of both densities.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let Some(view) = View::new(wo, wi, self.eta) else {
            return 0.0;
        };
        let share = self.later_share(wo);
        let later = self.later.as_ref().map_or(0.0, |later| later.pdf(&view));
        (1.0 - share) * self.first_pdf(&view).unwrap_or(0.0) + share * later
    }

    /// By quadrature over the facets, to about 1e-3.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        self.tints[0] * self.shares(wo)[0]
    }

    /// By quadrature over the facets, to about 1e-3.
    pub fn transmittance(&self, wo: Direction) -> Spectrum {
        self.tints[1] * self.shares(wo)[1]
    }

    /// t of the outside, or 0 for single scattering.
    pub(super) fn later_transmitted(&self) -> f64 {
        self.later
            .as_ref()
            .map_or(0.0, |later| later.transmitted[0])
    }

    fn shares(&self, wo: Direction) -> [f64; 2] {
        self.leaving(wo, |_| 1.0)
    }

    /// Shares of power, without tints, reflected and transmitted light of every direction multiplied by f, which does not depend
    /// on azimuth.
    pub(in crate::brdf) fn leaving(&self, wo: Direction, f: impl Fn(Direction) -> f64) -> [f64; 2] {
        let Some(view) = View::new(wo, wo, self.eta) else {
            return [0.0; 2];
        };
        let seen = |wi: Direction| f(if view.side == 0 { wi } else { flipped(wi) });
        let [reflected, transmitted] = weighed_shares(self.facets, view.wo, view.eta, 1, seen);
        let Some(later) = &self.later else {
            return [reflected, transmitted];
        };
        let share = self.later_share(wo);
        let through = later.transmitted[view.side];
        let near = later.shares.mean(view.side, seen);
        let far = later.shares.mean(1 - view.side, |wi| seen(flipped(wi)));
        [
            reflected + share * (1.0 - through) * near,
            transmitted + share * through * far,
        ]
    }

    fn first_value(&self, view: &View) -> Option<f64> {
        let m = view.normal()?;
        let (wo, wi) = (view.wo, view.wi);
        let (cos_o, cos_i) = (wo.dot(m), wi.dot(m));
        let reflectance = dielectric(cos_o.clamp(0.0, 1.0), view.eta).mean();
        let density = self.facets.density(m);
        if wi.z() > 0.0 {
            let visible = self.facets.shadowing(wo, wi);
            return Some(reflectance * density * visible / (4.0 * wo.z() * wi.z()));
        }
        let visible = self.facets.masking(wo) * self.facets.masking(wi);
        let bend = cos_o + view.eta * cos_i;
        let facing = (cos_o * cos_i / (wo.z() * wi.z())).abs();
        Some((1.0 - reflectance) * density * visible * facing / (bend * bend))
    }

    fn first_pdf(&self, view: &View) -> Option<f64> {
        let m = view.normal()?;
        let (cos_o, cos_i) = (view.wo.dot(m), view.wi.dot(m));
        let reflectance = dielectric(cos_o.clamp(0.0, 1.0), view.eta).mean();
        let density = self.facets.visible_density(view.wo, m);
        if view.wi.z() > 0.0 {
            return Some(reflectance * density / (4.0 * cos_o));
        }
        let bend = cos_o + view.eta * cos_i;
        let stretch = view.eta * view.eta * cos_i.abs() / (bend * bend);
        Some((1.0 - reflectance) * density * stretch)
    }

    /// A direction as seen from the upper side.
    fn sample_first(&self, view: &View, u: [f64; 2]) -> Option<Direction> {
        let m = self.facets.sample_visible(view.wo, u)?;
        let reflectance = dielectric(view.wo.dot(m).clamp(0.0, 1.0), view.eta).mean();
        if third_number(u) < reflectance {
            return Some(m.mirror(view.wo)).filter(|wi| wi.z() > 0.0);
        }
        refract(view.wo, m, view.eta).filter(|wi| wi.z() < 0.0)
    }

    /// M_a of the direction, or 0 for single scattering.
    pub(super) fn later_share(&self, wo: Direction) -> f64 {
        let side = usize::from(wo.z() < 0.0);
        self.later
            .as_ref()
            .map_or(0.0, |later| later.shares.missing(side, upper(wo)))
    }
}

impl View {
    fn new(wo: Direction, wi: Direction, eta: f64) -> Option<Self> {
        match wo.z() {
            z if z > 0.0 => Some(Self {
                wo,
                wi,
                eta,
                side: 0,
            }),
            z if z < 0.0 => Some(Self {
                wo: flipped(wo),
                wi: flipped(wi),
                eta: 1.0 / eta,
                side: 1,
            }),
            _ => None,
        }
    }

    /// The facet, on the upper side, that takes one direction into the other.
    fn normal(&self) -> Option<Direction> {
        let (wo, wi) = (self.wo.to_vector(), self.wi.to_vector());
        if self.wi.z() > 0.0 {
            return Direction::new(wo + wi).ok();
        }
        let along = Direction::new(wo + wi * self.eta).ok()?;
        let m = if along.z() < 0.0 { -along } else { along };
        let apart = self.wi.z() < 0.0 && m.dot(self.wo) > 0.0 && m.dot(self.wi) < 0.0;
        apart.then_some(m)
    }

    /// The side of `wi`, if it is not on the horizon.
    fn other_side(&self) -> Option<usize> {
        match self.wi.z() {
            z if z > 0.0 => Some(self.side),
            z if z < 0.0 => Some(1 - self.side),
            _ => None,
        }
    }
}

impl LaterLight {
    fn value(&self, view: &View) -> f64 {
        let Some(from) = view.other_side() else {
            return 0.0;
        };
        let share = if from == view.side {
            1.0 - self.transmitted[from]
        } else {
            self.transmitted[from]
        };
        let (near, far) = (view.wo, upper(view.wi));
        let both = self.shares.missing(view.side, near) * self.shares.missing(from, far);
        share * both * FRAC_1_PI / self.shares.average(view.side)
    }

    fn pdf(&self, view: &View) -> f64 {
        let Some(from) = view.other_side() else {
            return 0.0;
        };
        let through = self.transmitted[view.side];
        let share = if from == view.side {
            1.0 - through
        } else {
            through
        };
        share * self.shares.pdf(from, upper(view.wi))
    }

    fn sample(&self, side: usize, u: [f64; 2]) -> Direction {
        let (through, u0) = choose(u[0], self.transmitted[side]);
        if through {
            flipped(self.shares.sample(1 - side, [u0, u[1]]))
        } else {
            self.shares.sample(side, [u0, u[1]])
        }
    }
}

/// What facets of this index miss on either side, and what they reflect.
pub(super) fn interface_shares(facets: Facets, eta: f64) -> Blend<2> {
    type Surface = (Slopes, Shadowing, f64);
    static SHELVES: Recent<Surface, Shelf<2>> = Recent::new();
    static ANISOTROPIC: Recent<(Facets, f64), [Table; 2]> = Recent::new();
    if !facets.is_isotropic() {
        let tables = ANISOTROPIC.get((facets, eta), || interface_tables(facets, eta));
        return Blend::exactly(tables);
    }
    let surface = (facets.slopes(), facets.visibility(), eta);
    SHELVES
        .get(surface, Shelf::new)
        .blend(facets.widths()[0], |alpha| {
            interface_tables(facets.with_width(alpha), eta)
        })
}

fn interface_tables(facets: Facets, eta: f64) -> [Table; 2] {
    [eta, 1.0 / eta].map(|eta| {
        Table::new(facets.stretch(), |wo| {
            let [reflected, transmitted] = first_shares(facets, wo, eta, 1);
            [1.0 - reflected - transmitted, reflected]
        })
    })
}

fn upper(direction: Direction) -> Direction {
    if direction.z() < 0.0 {
        flipped(direction)
    } else {
        direction
    }
}

/// A third uniform number, hashed from two that have been used up.
fn third_number(u: [f64; 2]) -> f64 {
    let bits = combine(combine(0, u[0].to_bits()), u[1].to_bits());
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}
