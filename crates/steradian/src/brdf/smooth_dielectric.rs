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
//! Both shares may be tinted, for looks: R and 1 − R are multiplied by numbers up to 1.
//!
//! Both directions are drawn with the probability of their share of the power, so that without tints the weight is 1 when reflected
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

use super::error::{in_range, tints};
use super::fresnel::{dielectric, refract};
use super::{ModelError, Scatter};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A smooth interface.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct SmoothDielectric {
    eta: f64,
    tints: [Spectrum; 2],
}

impl SmoothDielectric {
    /// From the index inside over the index outside.
    ///
    /// # Errors
    /// If it lies outside 0.1 … 10.
    pub fn new(eta: f64) -> Result<Self, ModelError> {
        in_range("eta", eta, [0.1, 10.0]).map(|eta| Self {
            eta,
            tints: [Spectrum::ONE; 2],
        })
    }

    /// The same interface, of which reflected and transmitted light are multiplied by these.
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

    /// The index inside over the index outside.
    pub const fn eta(&self) -> f64 {
        self.eta
    }

    /// The reflected or the refracted direction.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let (normal, eta) = facing(wo, self.eta)?;
        let share = self.reflectance(wo);
        let [reflected, transmitted] = self.tints.map(|tint| f64::from(tint.mean()));
        let (reflected, transmitted) = (share * reflected, (1.0 - share) * transmitted);
        if reflected + transmitted <= 0.0 {
            return None;
        }
        let probability = reflected / (reflected + transmitted);
        let (wi, reflectance) = if u[0] < probability {
            (
                Direction::Z.mirror(wo),
                self.tints[0] * (share / probability),
            )
        } else {
            let scale = (1.0 - share) / (1.0 - probability) / (eta * eta);
            (refract(wo, normal, eta)?, self.tints[1] * scale)
        };
        Some(Scatter::Specular { wi, reflectance })
    }

    /// R(θ), tinted.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        self.tints[0] * self.reflectance(wo)
    }

    /// 1 − R(θ), tinted.
    pub fn transmittance(&self, wo: Direction) -> Spectrum {
        self.tints[1] * (1.0 - self.reflectance(wo))
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
