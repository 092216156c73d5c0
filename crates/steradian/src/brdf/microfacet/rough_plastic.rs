//! Rough plastic: a rough dielectric coat over a diffuse base, with all light that goes to and fro between them.
//!
//! ρ(d_e, d_i) = ρ_coat(d_e, d_i) + ρ_d T(θ_e) T(θ_i)/(π η² (1 − ρ_d R̄_in)).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ρ_coat | what [`RoughDielectric`] of the same facets and index reflects outside | 1/sr |
//! | T | share of the light along a direction outside that gets through the coat | 1 |
//! | R̄_in | hemispherical mean of the coat's reflectance from inside | 1 |
//! | η | index of the coat over that outside, the same in all lanes | 1 |
//! | ρ_d | reflectance of the base | 1 |
//!
//! With multiple scattering T is all that is not reflected and R̄_in = 1 − T̄/η², so that white plastic is white (to
//! 1e-3). With single scattering T and R̄_in are those of one facet and light is lost: with separable shadowing this is Mitsuba 3's `roughplastic` with
//! `nonlinear = true`. (Its `nonlinear = false` divides by 1 − R̄_in and so leaves out the colour that the base gains from bounces.)
//!
//! T comes from tables ([`RoughDielectric`] shares them). The coat's first lobe is drawn from the facets with a probability in proportion to the
//! root of its albedo R₁, its second lobe and the base to their albedos: a weight is at most the sum of these over √R₁, or the number
//! of lanes. Source: B. Walter et al., EGSR 2007; W. Jakob, Mitsuba 0.5 documentation, `roughplastic`.
//!
//! ```
//! use steradian::brdf::{Facets, RoughPlastic, Slopes};
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! let facets = Facets::isotropic(Slopes::Ggx, 0.3)?;
//! let white = RoughPlastic::new(facets, 1.5, Spectrum::ONE)?;
//! assert!((white.albedo(Direction::Z).mean() - 1.0).abs() < 1e-3);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::FRAC_1_PI;

use super::rough_dielectric::interface_shares;
use super::shelf::Blend;
use super::{Facets, RoughDielectric, half_way};
use crate::brdf::error::{in_range, share};
use crate::brdf::sampling::{above, choose_part, cosine_direction};
use crate::brdf::{Gloss, ModelError, Scatter, to_spectrum};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// Rough plastic.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughPlastic {
    facets: Facets,
    coat: RoughDielectric,
    shares: Blend<2>,
    /// ρ_d/(η² (1 − ρ_d R̄_in)).
    base: [f64; 4],
    /// T̄.
    average: f64,
    /// Whether light that facets pass to one another counts.
    whole: bool,
}

/// What happens to the light along a direction: reflected by one facet, by more of them, and what gets through the coat.
struct Parts {
    first: f64,
    later: f64,
    through: f64,
}

impl RoughPlastic {
    /// With multiple scattering, from the index of the coat over that outside and the reflectance of the base.
    ///
    /// # Errors
    /// If the index lies outside 1 … 10 or the reflectance outside 0 … 1.
    pub fn new(facets: Facets, eta: f64, diffuse: Spectrum) -> Result<Self, ModelError> {
        Self::with_coat(facets, RoughDielectric::new(facets, eta)?, diffuse, true)
    }

    /// One facet alone, which loses light: comparable to renderers without compensation.
    ///
    /// # Errors
    /// If the index lies outside 1 … 10 or the reflectance outside 0 … 1.
    pub fn single_scattering(
        facets: Facets,
        eta: f64,
        diffuse: Spectrum,
    ) -> Result<Self, ModelError> {
        let coat = RoughDielectric::single_scattering(facets, eta)?;
        Self::with_coat(facets, coat, diffuse, false)
    }

    fn with_coat(
        facets: Facets,
        coat: RoughDielectric,
        diffuse: Spectrum,
        whole: bool,
    ) -> Result<Self, ModelError> {
        let eta = in_range("eta", coat.eta(), [1.0, 10.0])?;
        let shares = interface_shares(facets, eta);
        let kept = if whole {
            1.0 - coat.later_transmitted()
        } else {
            1.0
        };
        let [missing, reflected] = shares.averages(0);
        let average = 1.0 - reflected - kept * missing;
        let inside = if whole {
            1.0 - average / (eta * eta)
        } else {
            shares.averages(1)[1]
        };
        let diffuse = share("diffuse reflectance", diffuse)?.to_lanes();
        let base = diffuse.map(|lane| {
            let rho = f64::from(lane);
            rho / (eta * eta * (1.0 - rho * inside))
        });
        Ok(Self {
            facets,
            coat,
            shares,
            base,
            average,
            whole,
        })
    }

    /// ρ(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        if !above(wo, wi) {
            return Spectrum::ZERO;
        }
        let through = self.parts(wo).through * self.parts(wi).through * FRAC_1_PI;
        self.coat.evaluate(wo, wi) + to_spectrum(self.base.map(|base| base * through))
    }

    /// A direction of the coat's two lobes or of the base; `None` where a mirrored direction lies below the surface.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        if wo.z() <= 0.0 {
            return None;
        }
        let (part, u0) = choose_part(&self.probabilities(wo), u[0])?;
        let u = [u0, u[1]];
        let wi = match part {
            0 => self.facets.sample_reflection(wo, u)?,
            1 => self.shares.sample(0, u),
            _ => cosine_direction(u),
        };
        Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
    }

    /// The mixture of the densities of the three.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let Some(m) = half_way(wo, wi) else {
            return 0.0;
        };
        let [first, later, base] = self.probabilities(wo);
        let later = if later > 0.0 {
            later * self.shares.pdf(0, wi)
        } else {
            0.0
        };
        first * self.facets.reflection_density(wo, m) + later + base * wi.z() * FRAC_1_PI
    }

    /// From the tables, to about 1e-3.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            return Spectrum::ZERO;
        }
        let parts = self.parts(wo);
        let through = parts.through * self.average;
        to_spectrum(
            self.base
                .map(|base| parts.first + parts.later + base * through),
        )
    }

    /// Of the coat's first lobe.
    pub(in crate::brdf) fn gloss(&self, wo: Direction) -> Option<Gloss> {
        let parts = self.parts(wo);
        let all = parts.first + parts.later + self.below(&parts);
        (all > 0.0).then(|| Gloss::of_facets(self.facets, parts.first / all))
    }

    fn parts(&self, direction: Direction) -> Parts {
        let [missing, first] = self.shares.at(0, direction);
        let later = if self.whole {
            missing * (1.0 - self.coat.later_transmitted())
        } else {
            0.0
        };
        let lost = if self.whole { 0.0 } else { missing };
        Parts {
            first,
            later,
            through: (1.0 - first - later - lost).max(0.0),
        }
    }

    /// What the base reflects, in the mean over the lanes.
    fn below(&self, parts: &Parts) -> f64 {
        let mean = 0.25 * self.base.iter().sum::<f64>();
        mean * parts.through * self.average
    }

    /// Of the coat's first and second lobe and of the base.
    fn probabilities(&self, wo: Direction) -> [f64; 3] {
        let parts = self.parts(wo);
        let shares = [parts.first.sqrt(), parts.later, self.below(&parts)];
        let sum: f64 = shares.iter().sum();
        shares.map(|share| if sum > 0.0 { share / sum } else { 0.0 })
    }
}
