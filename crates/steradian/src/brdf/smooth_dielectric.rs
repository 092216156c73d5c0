//! A smooth interface of two dielectrics, such as the surface of water or of a block of glass.
//!
//! Reflected: L(d_e) = R L(p, −d_i). Refracted: L(d_e) = (1 − R) (n_e/n_i)² L(p, −d_i), where n_e and n_i are the indices
//! on the sides of d_e and d_i. The normal points to the outside, whose index is 1; inside it is η.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | R | Fresnel reflectance of unpolarised light | 1 |
//! | η | index inside over index outside, the same in all lanes | 1 |
//!
//! Both directions are drawn with the probability of their share of the power, so that the weight is 1 when reflected
//! and (n_e/n_i)² when refracted. Absorption inside belongs to the medium, dispersion to whoever makes one interface a
//! wavelength. Source: as [`fresnel`](super::fresnel); E. Veach (1997), §5.2 for (n_e/n_i)².
//!
//! ```
//! use steradian::brdf::SmoothDielectric;
//! use steradian::geometry::Direction;
//! let glass = SmoothDielectric::new(1.5)?;
//! assert!((glass.albedo(Direction::Z).mean() - 0.04).abs() < 1e-8);
//! assert!((glass.transmittance(-Direction::Z).mean() - 0.96).abs() < 1e-7);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use super::error::in_range;
use super::fresnel::{dielectric, refract};
use super::{ModelError, Scatter};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A smooth interface.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct SmoothDielectric {
    eta: f64,
}

impl SmoothDielectric {
    /// From the index inside over the index outside.
    ///
    /// # Errors
    /// If it lies outside 0.1 … 10.
    pub fn new(eta: f64) -> Result<Self, ModelError> {
        in_range("eta", eta, [0.1, 10.0]).map(|eta| Self { eta })
    }

    /// The index inside over the index outside.
    pub const fn eta(&self) -> f64 {
        self.eta
    }

    /// The reflected or the refracted direction.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let (normal, eta) = facing(wo, self.eta)?;
        let specular = |wi, scale| Scatter::Specular {
            wi,
            reflectance: Spectrum::splat(scale),
        };
        if u[0] < self.reflectance(wo) {
            return Some(specular(Direction::Z.mirror(wo), 1.0));
        }
        let wi = refract(wo, normal, eta)?;
        Some(specular(wi, (1.0 / (eta * eta)) as f32))
    }

    /// R(θ).
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        Spectrum::splat(self.reflectance(wo) as f32)
    }

    /// 1 − R(θ).
    pub fn transmittance(&self, wo: Direction) -> Spectrum {
        Spectrum::splat((1.0 - self.reflectance(wo)) as f32)
    }

    fn reflectance(&self, wo: Direction) -> f64 {
        facing(wo, self.eta).map_or(1.0, |(_, eta)| dielectric(wo.z().abs(), eta).mean())
    }
}

/// The normal on the side of `wo` and the index of the other side over that of this side; `None` on the horizon.
pub(super) fn facing(wo: Direction, eta: f64) -> Option<(Direction, f64)> {
    match wo.z() {
        z if z > 0.0 => Some((Direction::Z, eta)),
        z if z < 0.0 => Some((-Direction::Z, 1.0 / eta)),
        _ => None,
    }
}
