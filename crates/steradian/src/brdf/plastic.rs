//! Smooth plastic: a clear dielectric coat over a diffuse base, with all light that goes to and fro between them.
//!
//! L(d_e) = R(θ_e) L(p, −mirrored d_e), and besides
//!
//! ρ(d_e, d_i) = ρ_d (1 − R(θ_e))(1 − R(θ_i))/(π η² (1 − ρ_d R̄_in)).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | R | Fresnel reflectance of the coat from outside | 1 |
//! | R̄_in | hemispherical mean of the coat's reflectance from inside | 1 |
//! | η | index of the coat over that outside, 1 … 10, the same in all lanes | 1 |
//! | ρ_d | reflectance of the base | 1 |
//!
//! A white base gives a white plastic, as 1 − R̄_in = (1 − R̄)/η². Source: L. B. Wolff, *Diffuse-reflectance model for
//! smooth dielectric surfaces*, J. Opt. Soc. Am. A 11 (1994) 2956, with one R for both polarisations; Mitsuba's `plastic` with `nonlinear` is
//! the same. Valid if the base sends the light back evenly inside the coat.
//!
//! The mirrored direction is taken with the probability of its share of the mean over lanes, else one of density cosθ_i/π: a weight is
//! at most the number of lanes, times (1 − R(θ_i))/(1 − R̄) ≤ 1.2 for glass.
//!
//! ```
//! use steradian::brdf::Plastic;
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! let white = Plastic::new(1.5, Spectrum::ONE)?;
//! assert!((white.albedo(Direction::Z).mean() - 1.0).abs() < 1e-6);
//! // .96²/(π 1.5² (1 − R̄_in)) = .96²/(π (1 − R̄)), R̄ = .091776.
//! let value = f64::from(white.evaluate(Direction::Z, Direction::Z).mean());
//! assert!((value - 0.9216 / (std::f64::consts::PI * 0.908_224)).abs() < 1e-5);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::FRAC_1_PI;

use super::error::{in_range, share};
use super::fresnel::{dielectric, dielectric_average};
use super::sampling::{above, choose, cosine_direction};
use super::{ModelError, Scatter, to_spectrum};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// Smooth plastic.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Plastic {
    eta: f64,
    /// ρ_d (1 − R̄)/(η² (1 − ρ_d R̄_in)): what leaves of the light that got in.
    base: [f64; 4],
    /// 1 − R̄.
    average: f64,
}

impl Plastic {
    /// From the index of the coat and the reflectance of the base.
    ///
    /// # Errors
    /// If the index lies outside 1 … 10 or the reflectance outside 0 … 1.
    pub fn new(eta: f64, diffuse: Spectrum) -> Result<Self, ModelError> {
        let eta = in_range("eta", eta, [1.0, 10.0])?;
        let inside = dielectric_average(1.0 / eta);
        let diffuse = share("diffuse reflectance", diffuse)?.to_lanes();
        Ok(Self {
            eta,
            base: diffuse.map(|rho| base_albedo(f64::from(rho), inside)),
            average: 1.0 - dielectric_average(eta),
        })
    }

    /// ρ(d_e, d_i) of the base.
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        if !above(wo, wi) {
            return Spectrum::ZERO;
        }
        let through = self.transmitted(wo) * self.transmitted(wi) * FRAC_1_PI / self.average;
        to_spectrum(self.base.map(|base| base * through))
    }

    /// The mirrored direction or one from the base.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        if wo.z() <= 0.0 {
            return None;
        }
        let mirrored = self.mirrored_share(wo)?;
        let (specular, u0) = choose(u[0], mirrored);
        if specular {
            return Some(Scatter::Specular {
                wi: Direction::Z.mirror(wo),
                reflectance: Spectrum::splat(((1.0 - self.transmitted(wo)) / mirrored) as f32),
            });
        }
        let wi = cosine_direction([u0, u[1]]);
        Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
    }

    /// cosθ_i/π times the probability of the base.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        match self.mirrored_share(wo) {
            Some(mirrored) if above(wo, wi) => (1.0 - mirrored) * wi.z() * FRAC_1_PI,
            _ => 0.0,
        }
    }

    /// R + (1 − R) ρ_d (1 − R̄_in)/(1 − ρ_d R̄_in).
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            return Spectrum::ZERO;
        }
        let through = self.transmitted(wo);
        to_spectrum(self.base.map(|base| 1.0 - through + through * base))
    }

    /// 1 − R(θ).
    fn transmitted(&self, direction: Direction) -> f64 {
        1.0 - dielectric(direction.z().clamp(0.0, 1.0), self.eta).mean()
    }

    /// Of the light reflected along `wo`; `None` if there is none.
    fn mirrored_share(&self, wo: Direction) -> Option<f64> {
        let through = self.transmitted(wo);
        let base = 0.25 * self.base.iter().sum::<f64>() * through;
        let both = 1.0 - through + base;
        (both > 0.0).then(|| (1.0 - through) / both)
    }
}

/// ρ (1 − R̄_in)/(1 − ρ R̄_in): the share of light inside that leaves through a coat, after any number of bounces on a base.
pub(super) fn base_albedo(rho: f64, inside: f64) -> f64 {
    rho * (1.0 - inside) / (1.0 - rho * inside)
}
