//! Diffuse reflection and transmission, such as that of paper, cloth or leaves: the same radiance in all directions of
//! one side.
//!
//! ρ(d_e, d_i) = ρ_d/π if both directions lie on one side of the surface, τ_d/π if on opposite sides; ρ_d + τ_d ≤ 1.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ρ_d, τ_d | hemispherical reflectance and transmittance, the same from both sides | 1 |
//!
//! The side is chosen in proportion to the means over lanes, the direction with density |cosθ_i|/π: the weight is at most
//! the number of lanes. Source: J. H. Lambert's law on both sides; CIE 130 (1998) for ρ and τ of diffusers. There is no
//! change of index, so that radiance needs no factor.
//!
//! ```
//! use steradian::brdf::DiffuseTransmission;
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! let paper = DiffuseTransmission::new(Spectrum::splat(0.5), Spectrum::splat(0.25))?;
//! let through = paper.evaluate(Direction::Z, -Direction::Z).mean();
//! assert!((through - 0.25 / std::f32::consts::PI).abs() < 1e-8);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::FRAC_1_PI;

use super::error::{at_most_all, share};
use super::sampling::{choose, cosine_direction};
use super::{ModelError, Scatter};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A diffuser.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct DiffuseTransmission {
    reflectance: Spectrum,
    transmittance: Spectrum,
}

impl DiffuseTransmission {
    /// From ρ_d and τ_d.
    ///
    /// # Errors
    /// If a number lies outside 0 … 1, or the sum of a lane exceeds 1.
    pub fn new(reflectance: Spectrum, transmittance: Spectrum) -> Result<Self, ModelError> {
        let model = Self {
            reflectance: share("reflectance", reflectance)?,
            transmittance: share("transmittance", transmittance)?,
        };
        at_most_all("reflectance and transmittance", reflectance, transmittance)?;
        Ok(model)
    }

    /// ρ_d/π or τ_d/π.
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        match wo.z() * wi.z() {
            same if same > 0.0 => self.reflectance * FRAC_1_PI,
            opposite if opposite < 0.0 => self.transmittance * FRAC_1_PI,
            _ => Spectrum::ZERO,
        }
    }

    /// A direction of either side.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let (reflected, u0) = choose(u[0], self.reflected_share()?);
        let up = cosine_direction([u0, u[1]]);
        let wi = if reflected == (wo.z() > 0.0) { up } else { -up };
        Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
    }

    /// |cosθ_i|/π times the probability of the side.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let Some(reflected) = self.reflected_share() else {
            return 0.0;
        };
        let side = match wo.z() * wi.z() {
            same if same > 0.0 => reflected,
            opposite if opposite < 0.0 => 1.0 - reflected,
            _ => 0.0,
        };
        side * wi.z().abs() * FRAC_1_PI
    }

    /// ρ_d.
    pub fn albedo(&self, _wo: Direction) -> Spectrum {
        self.reflectance
    }

    /// τ_d.
    pub fn transmittance(&self, _wo: Direction) -> Spectrum {
        self.transmittance
    }

    fn reflected_share(&self) -> Option<f64> {
        let (reflected, transmitted) = (self.reflectance.mean(), self.transmittance.mean());
        let both = reflected + transmitted;
        (both > 0.0).then(|| f64::from(reflected) / f64::from(both))
    }
}
