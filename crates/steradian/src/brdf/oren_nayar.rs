//! Oren and Nayar's rough diffuse reflection, qualitative form.
//!
//! ρ(d_e, d_i) = (ρ_d/π)(A + B max(0, cosΔφ) sinα tanβ),  A = 1 − σ²/(2(σ² + .33)),  B = .45 σ²/(σ² + .09).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ρ_d | reflectance of a facet | 1 |
//! | σ | standard deviation of the facets' slope angle | rad |
//! | Δφ | azimuth between d_e and d_i | rad |
//! | α, β | the larger and the smaller of θ_e and θ_i | rad |
//!
//! Source: M. Oren and S. Nayar, SIGGRAPH 1994, eq. 30. It leaves out light scattered more than once, so that it is too
//! dark; prefer [`EnergyPreservingOrenNayar`](super::EnergyPreservingOrenNayar). Valid for σ up to π/2.
//!
//! Near grazing angles ρ grows without bound, ρ·cosθ_i does not. So A/(A+B) of the directions are drawn with density
//! cosθ_i/π and the rest evenly from the hemisphere, which bounds the weight by 2 ρ_d (A + B).
//!
//! ```
//! use steradian::brdf::OrenNayar;
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! // σ² = .33: A = 3/4, and from above only A counts.
//! let clay = OrenNayar::new(Spectrum::ONE, 0.33_f64.sqrt())?;
//! assert!((clay.albedo(Direction::Z).mean() - 0.75).abs() < 1e-6);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, TAU};

use super::error::{in_range, share};
use super::sampling::{above, choose, cosine_direction, hemisphere_direction};
use super::{ModelError, Scatter};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A rough diffuse surface.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct OrenNayar {
    reflectance: Spectrum,
    a: f64,
    b: f64,
}

impl OrenNayar {
    /// From the facets' reflectance and σ in radians.
    ///
    /// # Errors
    /// If the reflectance lies outside 0 … 1 or σ outside 0 … π/2.
    pub fn new(reflectance: Spectrum, sigma: f64) -> Result<Self, ModelError> {
        let square = in_range("sigma", sigma, [0.0, FRAC_PI_2])? * sigma;
        Ok(Self {
            reflectance: share("reflectance", reflectance)?,
            a: 1.0 - square / (2.0 * (square + 0.33)),
            b: 0.45 * square / (square + 0.09),
        })
    }

    /// ρ(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        if !above(wo, wi) {
            return Spectrum::ZERO;
        }
        // sinθ_e sinθ_i cosΔφ; divided by the larger cosine it is cosΔφ sinα tanβ.
        let tangential = wo.dot(wi) - wo.z() * wi.z();
        let retro = tangential.max(0.0) / wo.z().max(wi.z());
        self.reflectance * ((self.a + self.b * retro) * FRAC_1_PI)
    }

    /// A direction above the surface.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let (cosine, u0) = choose(u[0], self.cosine_share());
        let wi = if cosine {
            cosine_direction([u0, u[1]])
        } else {
            hemisphere_direction([u0, u[1]])
        };
        Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
    }

    /// The mixture of both densities.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        if !above(wo, wi) {
            return 0.0;
        }
        let share = self.cosine_share();
        share * wi.z() * FRAC_1_PI + (1.0 - share) / TAU
    }

    /// ρ_d [A + (2B/π)(sinθ (θ − sinθ cosθ)/2 + sinθ cosθ (1 + sinθ + sin²θ)/(3 (1 + sinθ)))].
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        let cos = wo.z();
        if cos <= 0.0 {
            return Spectrum::ZERO;
        }
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let retro = 0.5 * sin * (libm::acos(cos.min(1.0)) - sin * cos)
            + sin * cos * (1.0 + sin + sin * sin) / (3.0 * (1.0 + sin));
        self.reflectance * (self.a + 2.0 * FRAC_1_PI * self.b * retro)
    }

    fn cosine_share(&self) -> f64 {
        self.a / (self.a + self.b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::tests::cases::{assert_case, cases_of};
    use crate::brdf::tests::tilted;

    #[test]
    fn albedos_agree_with_the_reference_cases() {
        for case in cases_of("oren_nayar", 16) {
            let model = OrenNayar::new(Spectrum::ONE, case.number("sigma_rad")).unwrap();
            let albedo = model.albedo(tilted(case.number("theta_i_deg").to_radians()));
            assert_case(&case, "value", f64::from(albedo.mean()), 1e-7);
        }
    }
}
