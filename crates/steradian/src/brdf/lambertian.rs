//! Lambertian reflection: the same radiance in every direction.
//!
//! ρ(d_e, d_i) = ρ_d/π, so that ∫ ρ cosθ_i dω_i = ρ_d.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ρ_d | directional-hemispherical reflectance | 1 |
//! | ρ | BRDF | 1/sr |
//!
//! Sampled in proportion to cosθ_i (density cosθ_i/π), so that ρ·cosθ_i/pdf = ρ_d exactly. Source: J. H. Lambert,
//! *Photometria* (1760); F. E. Nicodemus et al., NBS Monograph 160 (1977), eq. 16.
//!
//! ```
//! use steradian::brdf::Lambertian;
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! let paper = Lambertian { reflectance: Spectrum::splat(0.5) };
//! let value = paper.evaluate(Direction::Z, Direction::Z).to_lanes()[0];
//! assert!((value - 0.5 / std::f32::consts::PI).abs() < 1e-7);
//! ```

use std::f64::consts::{FRAC_1_PI, TAU};

use super::Scatter;
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A Lambertian surface.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Lambertian {
    /// ρ_d of each lane.
    pub reflectance: Spectrum,
}

impl Lambertian {
    /// ρ/ρ_d in 1/sr: the one place that holds Lambert's 1/π.
    pub const VALUE_PER_REFLECTANCE: f64 = FRAC_1_PI;

    /// ρ_d/π above the surface.
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        if wo.z() <= 0.0 || wi.z() <= 0.0 {
            return Spectrum::ZERO;
        }
        self.reflectance * Self::VALUE_PER_REFLECTANCE as f32
    }

    /// A direction of density cosθ/π.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let wi = Direction::from_polar(u[0].sqrt(), (1.0 - u[0]).max(0.0).sqrt(), TAU * u[1]);
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| Scatter::Finite {
            wi,
            value: self.evaluate(wo, wi),
            pdf,
        })
    }

    /// cosθ_i/π.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        if wo.z() <= 0.0 {
            0.0
        } else {
            wi.z().max(0.0) * FRAC_1_PI
        }
    }

    /// ρ_d.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            Spectrum::ZERO
        } else {
            self.reflectance
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::tests::cases::{assert_case, cases_of};

    /// Values are single precision.
    #[test]
    fn values_and_albedos_agree_with_the_reference_cases() {
        for case in cases_of("lambert", 3) {
            let reflectance = Spectrum::splat(case.number("reflectance") as f32);
            let model = Lambertian { reflectance };
            let value = f64::from(model.evaluate(Direction::Z, Direction::Z).mean());
            assert_case(&case, "f", value, 1e-7);
            let albedo = f64::from(model.albedo(Direction::Z).mean());
            assert_case(&case, "rho_dh", albedo, 1e-7);
        }
    }
}
