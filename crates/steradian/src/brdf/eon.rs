//! Energy-preserving Oren–Nayar reflection (EON): rough diffuse, with all light that facets pass to one another.
//!
//! ρ = (ρ_d/π) A (1 + r s/t) + (ρ_ms/π) (1 − E(µ_e))(1 − E(µ_i))/(1 − Ē),  ρ_ms = ρ_d² Ē/(1 − ρ_d (1 − Ē)).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ρ_d | reflectance of a facet | 1 |
//! | r | roughness, 0 (Lambertian) … 1 | 1 |
//! | A | 1/(1 + (1/2 − 2/(3π)) r) | 1 |
//! | s, t | d_e·d_i − µ_e µ_i; the larger of µ_e and µ_i where s > 0, else 1 | 1 |
//! | µ_e, µ_i | cosines of d_e and d_i to the normal | 1 |
//! | E, Ē | albedo of the first term at ρ_d = 1, and its hemispherical mean | 1 |
//!
//! With ρ_d = 1 the albedo is 1 at every angle and roughness. Directions are drawn from a clipped cosine lobe that is
//! linearly transformed, and evenly from the hemisphere for the rest; measured weights stay below 3 ρ_d.
//!
//! Source: J. Portsmouth, P. Kutz and S. Hill, *EON: A Practical Energy-Preserving Rough Diffuse BRDF*, Journal of
//! Computer Graphics Techniques 14 (2025); the lobe's coefficients are that paper's fit.
//!
//! ```
//! use steradian::brdf::EnergyPreservingOrenNayar;
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! let plaster = EnergyPreservingOrenNayar::new(Spectrum::ONE, 0.7)?;
//! assert!((plaster.albedo(Direction::Z).mean() - 1.0).abs() < 1e-6);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use super::error::{in_range, share};
use super::sampling::{above, choose, hemisphere_direction};
use super::{ModelError, Scatter, to_spectrum};
use crate::geometry::{Direction, Vector};
use crate::quantity::Spectrum;

/// A rough diffuse surface that keeps all the light its facets reflect.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct EnergyPreservingOrenNayar {
    reflectance: [f64; 4],
    roughness: f64,
    /// A.
    single: f64,
    /// Ē.
    average: f64,
}

impl EnergyPreservingOrenNayar {
    /// From the facets' reflectance and the roughness.
    ///
    /// # Errors
    /// If a number lies outside 0 … 1.
    pub fn new(reflectance: Spectrum, roughness: f64) -> Result<Self, ModelError> {
        let roughness = in_range("roughness", roughness, [0.0, 1.0])?;
        let single = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness);
        Ok(Self {
            reflectance: share("reflectance", reflectance)?.to_lanes().map(f64::from),
            roughness,
            single,
            average: single * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * roughness),
        })
    }

    /// ρ(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        if !above(wo, wi) {
            return Spectrum::ZERO;
        }
        let s = wo.dot(wi) - wo.z() * wi.z();
        let over_t = if s > 0.0 { s / wo.z().max(wi.z()) } else { s };
        let first = self.single * (1.0 + self.roughness * over_t);
        let lost = 1.0 - self.average;
        let later = if lost > 0.0 {
            self.missing(wo.z()) * self.missing(wi.z()) / lost
        } else {
            0.0
        };
        to_spectrum(
            self.reflectance
                .map(|rho| FRAC_1_PI * (rho * first + self.later_reflectance(rho) * later)),
        )
    }

    /// A direction above the surface.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        if wo.z() <= 0.0 {
            return None;
        }
        let (even, u0) = choose(u[0], self.even_share(wo.z()));
        let wi = if even {
            hemisphere_direction([u0, u[1]])
        } else {
            Lobe::new(wo, self.roughness).sample([u0, u[1]])?
        };
        Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
    }

    /// The mixture of both densities.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        if !above(wo, wi) {
            return 0.0;
        }
        let share = self.even_share(wo.z());
        share / TAU + (1.0 - share) * Lobe::new(wo, self.roughness).pdf(wi)
    }

    /// ρ_d E + ρ_ms (1 − E).
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            return Spectrum::ZERO;
        }
        let missing = self.missing(wo.z());
        to_spectrum(
            self.reflectance
                .map(|rho| rho * (1.0 - missing) + self.later_reflectance(rho) * missing),
        )
    }

    /// 1 − E(µ).
    fn missing(&self, cos: f64) -> f64 {
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let tail = cos * (1.0 + sin + sin * sin) / (1.0 + sin) - 1.0;
        let g = sin * (libm::acos(cos.min(1.0)) - sin * cos) + (2.0 / 3.0) * sin * tail;
        (1.0 - self.single * (1.0 + self.roughness * FRAC_1_PI * g)).max(0.0)
    }

    /// ρ_ms.
    fn later_reflectance(&self, rho: f64) -> f64 {
        rho * rho * self.average / (1.0 - rho * (1.0 - self.average))
    }

    /// How many of the directions are drawn evenly: the paper's fit.
    fn even_share(&self, mu: f64) -> f64 {
        let fit = 0.162_925 + mu * (-0.372_058 + (0.538_233 - 0.290_822 * mu) * mu);
        libm::pow(self.roughness, 0.1) * fit
    }
}

/// The transformed cosine lobe, clipped to the hemisphere before the transform: M = [[a, 0, b], [0, c, 0], [d, 0, 1]] in
/// the frame in which d_e has azimuth 0.
struct Lobe {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    /// Cosine and sine of d_e's azimuth.
    azimuth: (f64, f64),
    /// Share of the cosine lobe that is left.
    kept: f64,
}

impl Lobe {
    fn new(wo: Direction, r: f64) -> Self {
        let mu = wo.z();
        let d = (0.540_852 + (-1.016_25 + 0.475_392 * mu) * mu) * r
            / (-1.0743 + mu * (0.072_562_8 + mu));
        let length = (wo.x() * wo.x() + wo.y() * wo.y()).sqrt();
        Self {
            a: 1.0
                + r * (0.303_392
                    + (-0.518_982 + 0.111_709 * mu) * mu
                    + (-0.276_266 + 0.335_918 * mu) * r),
            b: r * (-1.164_07 + 1.158_59 * mu + (0.150_815 - 0.150_105 * mu) * r)
                / (mu * mu * mu - 1.435_45),
            c: 1.0 + (0.200_13 + (-0.506_373 + 0.261_777 * mu) * mu) * r,
            d,
            azimuth: if length > 0.0 {
                (wo.x() / length, wo.y() / length)
            } else {
                (1.0, 0.0)
            },
            kept: 0.5 * (1.0 + 1.0 / (d * d + 1.0).sqrt()),
        }
    }

    fn sample(&self, u: [f64; 2]) -> Option<Direction> {
        let radius = u[0].sqrt();
        let (sin, cos) = libm::sincos(TAU * u[1]);
        let (x, y) = (radius * cos, radius * sin);
        let x = -((1.0 - y * y).max(0.0).sqrt() * (1.0 - self.kept) + x * self.kept);
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let local = Vector::new(self.a * x + self.b * z, self.c * y, self.d * x + z);
        let (cos, sin) = self.azimuth;
        let turned = Vector::new(
            cos * local.x - sin * local.y,
            sin * local.x + cos * local.y,
            local.z,
        );
        Direction::new(turned).ok()
    }

    fn pdf(&self, wi: Direction) -> f64 {
        let (cos, sin) = self.azimuth;
        let (x, y) = (cos * wi.x() + sin * wi.y(), cos * wi.y() - sin * wi.x());
        let determinant = self.c * (self.a - self.b * self.d);
        let before = Vector::new(
            self.c * (x - self.b * wi.z()),
            (self.a - self.b * self.d) * y,
            self.c * (self.a * wi.z() - self.d * x),
        );
        let square = before.length_squared();
        let jacobian = determinant * determinant / (square * square);
        jacobian * before.z.max(0.0) * FRAC_1_PI / self.kept
    }
}
