//! The material of glTF 2.0: metallic-roughness with specular, index, transmission, clearcoat, sheen and anisotropy.
//!
//! ρ = ρ_coat + k_coat (ρ_sheen + k_sheen ρ_base),  k(d_e, d_i) = min(1 − E(d_e), 1 − E(d_i)),
//!
//! ρ_base = (1 − m) (1 − t) ρ_opaque + (1 − m) t ρ_clear + m ρ_metal.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | m, t | metallic, transmission | 1 |
//! | E | albedo of the layer above, of its strongest lane; below the surface 0 | 1 |
//! | ρ_metal | GGX with F₀ = base colour, F₉₀ = 1 | 1/sr |
//! | ρ_opaque | GGX with F₀ = s min(((n − 1)/(n + 1))² C_s, 1), F₉₀ = s, and c (1 − E(d_e))(1 − E(d_i))/(π (1 − Ē)) below it | 1/sr |
//! | ρ_clear | a solid: [`RoughDielectric`](super::RoughDielectric) of index n, tinted; a sheet: GGX mirrored to the other side | 1/sr |
//! | ρ_coat | clearcoat times GGX with F₀ = .04, F₉₀ = 1 | 1/sr |
//! | n, s, C_s, c | index, specular, its colour, base colour | 1 |
//!
//! F is Schlick's, α the square of roughness; anisotropy a widens the facets along the tangent to α + (1 − α) a².
//! glTF leaves open how layers share the light. Here every lobe keeps the light that facets pass to one another, what lies below gets at most
//! what is left, and what a coat sends back down is lost: reciprocal, and albedo + transmittance ≤ 1 at every angle. (Mixed
//! by F of the half-way angle, as glTF's sample formulas do, a white dielectric of roughness .5 sends back 1.115 times the light that comes at 85°.) A colour of s C_s above 1 is limited to 1 as a tint of ρ_clear. White metal and white paint keep all light; a clear sheet loses up to 3 % where
//! highlights are broad. Roughness below .03 is .03
//! for reflection, and smooth (a sample is a single direction) for transmission. Absorption inside a solid belongs to the medium.
//!
//! Parts are drawn in proportion to their albedos, of highlights to the root of it. Albedos are quadratures over
//! facets and directions: within 2e-3. Source: Khronos, *glTF 2.0 Specification* (2021), appendix B; KHR_materials_ior, _specular, _transmission, _volume,
//! _clearcoat, _sheen, _anisotropy; C. Kulla and A. Conty, SIGGRAPH 2017 course, for ρ_opaque.
//!
//! ```
//! use steradian::brdf::{Principled, PrincipledParameters};
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! let glossy = PrincipledParameters { roughness: 0.5, base_color: Spectrum::ONE, ..Default::default() };
//! // White below highlights is white: nothing is lost, and nothing gained.
//! let white = Principled::new(&glossy)?;
//! assert!((white.albedo(Direction::Z).mean() - 1.0).abs() < 2e-3);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

mod base;
mod parameters;
mod shares;
mod sheen;

pub use parameters::Parameters;

use std::f64::consts::{FRAC_1_PI, TAU};

use base::{Base, Interface, SMOOTH, Through};
use sheen::Sheen;

use super::sampling::{choose_part, cosine_direction, flipped, hemisphere_direction};
use super::{Facets, Gloss, ModelError, RoughConductor, Scatter, Slopes, to_spectrum};
use crate::geometry::{Direction, Vector};
use crate::quantity::Spectrum;

/// Parts that are drawn: coat, sheen, highlights, diffuse, through.
const PARTS: usize = 5;

/// glTF's material at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Principled {
    base: Base,
    coat: Option<RoughConductor>,
    sheen: Option<Sheen>,
    /// Cosine and sine of the tangent's turn.
    turn: [f64; 2],
}

impl Principled {
    /// From glTF's numbers.
    ///
    /// # Errors
    /// If a number lies outside its range.
    pub fn new(parameters: &Parameters) -> Result<Self, ModelError> {
        let p = parameters.checked()?;
        let alpha = (p.roughness * p.roughness).max(SMOOTH);
        let along = alpha + (1.0 - alpha) * p.anisotropy * p.anisotropy;
        let facets = Facets::anisotropic(Slopes::Ggx, [along, alpha])?;
        let (sin, cos) = libm::sincos(p.anisotropy_rotation);
        Ok(Self {
            base: Base::new(p, facets)?,
            coat: coat(p)?,
            sheen: (!p.sheen_color.is_zero()).then(|| {
                let color = p.sheen_color.to_lanes().map(f64::from);
                Sheen::new(color, p.sheen_roughness)
            }),
            turn: [cos, sin],
        })
    }

    /// ρ(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        self.value(self.turned(wo), self.turned(wi))
    }

    /// A direction of one of the parts.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let local = self.turned(wo);
        let shares = self.shares(local);
        let (part, u0) = choose_part(&shares, u[0])?;
        let scatter = self.sample_part(local, part, shares[part], [u0, u[1]])?;
        if self.turn == [1.0, 0.0] {
            return Some(scatter);
        }
        let wi = self.turned_back(scatter.wi());
        match scatter {
            Scatter::Finite { .. } => Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi)),
            Scatter::Specular { reflectance, .. } => Some(Scatter::Specular { wi, reflectance }),
        }
    }

    /// The mixture of the densities of all parts.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let wo = self.turned(wo);
        self.density(&self.shares(wo), wo, self.turned(wi))
    }

    /// By quadrature over the parts.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        to_spectrum(self.shares_leaving(self.turned(wo))[0])
    }

    /// By quadrature over the parts.
    pub fn transmittance(&self, wo: Direction) -> Spectrum {
        to_spectrum(self.shares_leaving(self.turned(wo))[1])
    }

    /// The index inside over the index outside, of a solid that lets light in.
    pub(super) fn interior_index(&self) -> Option<f64> {
        match &self.base.through {
            Through::Solid { interface, .. } => Some(interface.eta()),
            _ => None,
        }
    }

    /// Of the base, without a coat and where no light goes through.
    pub(super) fn gloss(&self, wo: Direction) -> Option<Gloss> {
        let is_plain = self.coat.is_none() && matches!(self.base.through, Through::Not);
        if !is_plain || wo.z() <= 0.0 {
            return None;
        }
        let mirrored = 0.25 * self.base.gloss.tabulated_albedo(wo).iter().sum::<f64>();
        let all = mirrored + self.base.diffuse_albedo(wo);
        let gloss = self.base.gloss.gloss(wo);
        (all > 0.0).then(|| gloss.scaled(mirrored / all))
    }

    /// In the frame of the tangent.
    fn turned(&self, direction: Direction) -> Direction {
        let [c, s] = self.turn;
        let [x, y, z] = direction.to_array();
        Direction::from_unit(Vector::new(c * x + s * y, c * y - s * x, z))
    }

    fn turned_back(&self, direction: Direction) -> Direction {
        let [c, s] = self.turn;
        let [x, y, z] = direction.to_array();
        Direction::from_unit(Vector::new(c * x - s * y, c * y + s * x, z))
    }

    fn value(&self, wo: Direction, wi: Direction) -> Spectrum {
        let mut value = self.base.evaluate(wo, wi);
        if let Some(sheen) = &self.sheen {
            let fibres = to_spectrum(sheen.evaluate(wo, wi));
            value = fibres + value * below(|d| sheen.passed(d), wo, wi);
        }
        if let Some(coat) = &self.coat {
            value = coat.evaluate(wo, wi) + value * self.below_coat(wo, wi);
        }
        value
    }

    /// How much of what the base reflects and transmits counts under its layers.
    fn layers(&self, wo: Direction, wi: Direction) -> f64 {
        let sheen = self.sheen.as_ref();
        sheen.map_or(1.0, |sheen| below(|d| sheen.passed(d), wo, wi)) * self.below_coat(wo, wi)
    }

    fn below_coat(&self, wo: Direction, wi: Direction) -> f64 {
        let coat = self.coat.as_ref();
        coat.map_or(1.0, |coat| below(|d| passed(coat, d), wo, wi))
    }

    /// Probabilities of the parts.
    fn shares(&self, wo: Direction) -> [f64; PARTS] {
        let mut shares = [0.0; PARTS];
        let sheet = matches!(self.base.through, Through::Sheet { .. });
        let upper = if wo.z() < 0.0 { flipped(wo) } else { wo };
        let highlight = |model: &RoughConductor| {
            let lanes = model.tabulated_albedo(upper);
            (0.25 * lanes.iter().sum::<f64>()).sqrt()
        };
        if wo.z() > 0.0 {
            shares[0] = self.coat.as_ref().map_or(0.0, highlight);
            shares[1] = self.sheen.as_ref().map_or(0.0, |sheen| {
                (sheen.mean_color() * sheen.albedo(upper)).sqrt()
            });
        }
        if wo.z() > 0.0 || sheet {
            shares[2] = highlight(&self.base.gloss);
            shares[3] = self.base.diffuse_albedo(upper);
        }
        shares[4] = match &self.base.through {
            Through::Not => 0.0,
            Through::Sheet { color, .. } => {
                0.25 * color.iter().sum::<f64>() * self.base.entering(upper)
            }
            Through::Solid { share, .. } => *share,
        };
        let sum: f64 = shares.iter().sum();
        shares.map(|share| if sum > 0.0 { share / sum } else { 0.0 })
    }

    fn density(&self, shares: &[f64; PARTS], wo: Direction, wi: Direction) -> f64 {
        let mut density = 0.0;
        if wo.z() > 0.0 && wi.z() > 0.0 {
            let coat = self.coat.as_ref();
            density += coat.map_or(0.0, |coat| shares[0] * coat.pdf(wo, wi)) + shares[1] / TAU;
        }
        if let Some((wo, wi)) = self.base.reflecting(wo, wi) {
            density += shares[2] * self.base.gloss.pdf(wo, wi) + shares[3] * wi.z() * FRAC_1_PI;
        }
        density + shares[4] * self.base.through.density(wo, wi)
    }

    fn sample_part(&self, wo: Direction, part: usize, share: f64, u: [f64; 2]) -> Option<Scatter> {
        if wo.z() == 0.0 {
            return None;
        }
        let upper = if wo.z() < 0.0 { flipped(wo) } else { wo };
        let wi = match part {
            0 => self.coat.as_ref()?.sample(upper, u)?.wi(),
            1 => hemisphere_direction(u),
            2 => self.base.gloss.sample(upper, u)?.wi(),
            3 => cosine_direction(u),
            _ => return self.sample_through(wo, share, u),
        };
        let wi = if wo.z() < 0.0 { flipped(wi) } else { wi };
        self.finite(wo, wi)
    }

    fn sample_through(&self, wo: Direction, share: f64, u: [f64; 2]) -> Option<Scatter> {
        match &self.base.through {
            Through::Not => None,
            Through::Sheet { color, spread } => {
                let upper = if wo.z() < 0.0 { flipped(wo) } else { wo };
                let Some(spread) = spread else {
                    let passed = self.base.let_through(wo, -wo) * self.layers(wo, -wo) / share;
                    return Some(Scatter::Specular {
                        wi: -wo,
                        reflectance: to_spectrum(color.map(|lane| lane * passed)),
                    });
                };
                let wi = spread.sample(upper, u)?.wi();
                self.finite(wo, if wo.z() < 0.0 { wi } else { flipped(wi) })
            }
            Through::Solid {
                share: covered,
                interface,
            } => match interface.sample(wo, u)? {
                Scatter::Finite { wi, .. } => self.finite(wo, wi),
                Scatter::Specular { wi, reflectance } => Some(Scatter::Specular {
                    wi,
                    reflectance: reflectance * (covered * self.layers(wo, wi) / share),
                }),
            },
        }
    }

    fn finite(&self, wo: Direction, wi: Direction) -> Option<Scatter> {
        Scatter::finite(
            wi,
            self.value(wo, wi),
            self.density(&self.shares(wo), wo, wi),
        )
    }
}

impl Through {
    fn density(&self, wo: Direction, wi: Direction) -> f64 {
        match self {
            Self::Sheet {
                spread: Some(spread),
                ..
            } if wo.z() * wi.z() < 0.0 => {
                let upward = |d: Direction| if d.z() < 0.0 { flipped(d) } else { d };
                spread.pdf(upward(wo), upward(wi))
            }
            Self::Solid {
                interface: Interface::Rough(rough),
                ..
            } => rough.pdf(wo, wi),
            _ => 0.0,
        }
    }
}

/// The clear coat, if there is one.
fn coat(p: &Parameters) -> Result<Option<RoughConductor>, ModelError> {
    if p.clearcoat == 0.0 {
        return Ok(None);
    }
    let alpha = (p.clearcoat_roughness * p.clearcoat_roughness).max(SMOOTH);
    let facets = Facets::isotropic(Slopes::Ggx, alpha)?;
    let [normal, grazing] = [0.04, 1.0].map(|f| Spectrum::splat((f * p.clearcoat) as f32));
    RoughConductor::schlick(facets, normal, grazing).map(Some)
}

/// The share of the light along a direction that the coat leaves.
fn passed(coat: &RoughConductor, direction: Direction) -> f64 {
    1.0 - coat.tabulated_albedo(direction)[0]
}

/// min over both directions of what a layer above the surface leaves.
fn below(passed: impl Fn(Direction) -> f64, wo: Direction, wi: Direction) -> f64 {
    let one = |d: Direction| if d.z() > 0.0 { passed(d) } else { 1.0 };
    one(wo).min(one(wi)).max(0.0)
}
