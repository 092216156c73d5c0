//! Phong's reflection, modified to be reciprocal and normalised: for teaching, and for old scene files.
//!
//! ρ(d_e, d_i) = k_d/π + k_s (n + 2)/(2π) cosⁿα where cosα > 0, with α the angle between d_i and the mirrored d_e.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k_d, k_s | diffuse and glossy reflectance at normal incidence, k_d + k_s ≤ 1 | 1 |
//! | n | exponent | 1 |
//!
//! No surface reflects like this: towards the horizon half of the lobe is cut off and its light is lost. Source: R. Lewis,
//! Computer Graphics Forum 13 (1994) 109; E. Lafortune and Y. Willems, report CW 197 (Leuven, 1994).
//!
//! The lobe is drawn with density (n + 1)/(2π) cosⁿα, or cosθ_i/π for the diffuse part, in proportion to the means of k_s
//! and k_d; the weight is at most (n + 2)/(n + 1) ≤ 2 times the number of lanes.
//!
//! ```
//! use steradian::brdf::Phong;
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! // (30 + 2)/(2π) × .5 where the lobe is highest.
//! let glossy = Phong::new(Spectrum::ZERO, Spectrum::splat(0.5), 30.0)?;
//! let peak = f64::from(glossy.evaluate(Direction::Z, Direction::Z).mean());
//! assert!((peak - 8.0 / std::f64::consts::PI).abs() < 1e-6);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::{FRAC_1_PI, TAU};

use super::error::{at_most_all, in_range, share};
use super::sampling::{above, choose, cosine_direction, mean_over_square};
use super::{ModelError, Scatter};
use crate::geometry::{Direction, Frame};
use crate::quantity::Spectrum;

/// Diffuse reflection and a glossy lobe around the mirrored direction.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Phong {
    diffuse: Spectrum,
    glossy: Spectrum,
    exponent: f64,
}

impl Phong {
    /// From k_d, k_s and n.
    ///
    /// # Errors
    /// If a reflectance lies outside 0 … 1, the sum of a lane exceeds 1, or the exponent lies outside 0 … 1e6.
    pub fn new(diffuse: Spectrum, glossy: Spectrum, exponent: f64) -> Result<Self, ModelError> {
        let model = Self {
            diffuse: share("diffuse reflectance", diffuse)?,
            glossy: share("glossy reflectance", glossy)?,
            exponent: in_range("exponent", exponent, [0.0, 1e6])?,
        };
        at_most_all("diffuse and glossy reflectance", diffuse, glossy)?;
        Ok(model)
    }

    /// ρ(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        if !above(wo, wi) {
            return Spectrum::ZERO;
        }
        let lobe = (self.exponent + 2.0) / TAU * self.power(wo, wi);
        self.diffuse * FRAC_1_PI + self.glossy * lobe
    }

    /// A direction of the diffuse part or of the lobe; `None` where the lobe lies below the surface.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        if wo.z() <= 0.0 {
            return None;
        }
        let (diffuse, u0) = choose(u[0], self.diffuse_share()?);
        let wi = if diffuse {
            cosine_direction([u0, u[1]])
        } else {
            self.lobe_direction(wo, [u0, u[1]])
        };
        Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
    }

    /// The mixture of both densities.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        match self.diffuse_share() {
            Some(share) if above(wo, wi) => {
                let lobe = (self.exponent + 1.0) / TAU * self.power(wo, wi);
                share * wi.z() * FRAC_1_PI + (1.0 - share) * lobe
            }
            _ => 0.0,
        }
    }

    /// k_d + k_s (n + 2)/(n + 1) times the mean of cosθ_i over the lobe, by the midpoint rule: to 1e-4.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            return Spectrum::ZERO;
        }
        let [cosine] = mean_over_square(96, |u| [self.lobe_direction(wo, u).z().max(0.0)]);
        self.diffuse + self.glossy * (cosine * (self.exponent + 2.0) / (self.exponent + 1.0))
    }

    /// cosⁿα.
    fn power(&self, wo: Direction, wi: Direction) -> f64 {
        let cos = Direction::Z.mirror(wo).dot(wi);
        if cos <= 0.0 {
            return 0.0;
        }
        libm::pow(cos.min(1.0), self.exponent)
    }

    fn lobe_direction(&self, wo: Direction, u: [f64; 2]) -> Direction {
        let cos = libm::pow(1.0 - u[0], 1.0 / (self.exponent + 1.0));
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let around = Direction::from_polar(sin, cos, TAU * u[1]);
        Frame::from_normal(Direction::Z.mirror(wo)).to_world(around)
    }

    fn diffuse_share(&self) -> Option<f64> {
        let (diffuse, glossy) = (self.diffuse.mean(), self.glossy.mean());
        let both = diffuse + glossy;
        (both > 0.0).then(|| f64::from(diffuse) / f64::from(both))
    }
}
