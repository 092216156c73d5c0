//! A polished metal: a mirror with the reflectance of Fresnel's equations, L(d_e) = R(θ) L(p, −d_i).
//!
//! R is that of unpolarised light ([`fresnel::conductor`](super::fresnel::conductor)) at each lane's own η + iκ. Sampling
//! has one outcome, of weight R ≤ 1.
//!
//! ```
//! use steradian::brdf::{ComplexIndex, SmoothConductor};
//! use steradian::geometry::Direction;
//! let silver = SmoothConductor::new(ComplexIndex::new([0.05; 4], [4.2; 4])?);
//! // ((1 − .05)² + 4.2²)/((1 + .05)² + 4.2²) = 18.5425/18.7425.
//! let albedo = f64::from(silver.albedo(Direction::Z).to_lanes()[0]);
//! assert!((albedo - 18.5425 / 18.7425).abs() < 1e-7);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use super::{ComplexIndex, Scatter, to_spectrum};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A polished metal.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct SmoothConductor {
    index: ComplexIndex,
}

impl SmoothConductor {
    /// Of this index of refraction.
    pub const fn new(index: ComplexIndex) -> Self {
        Self { index }
    }

    /// The mirrored direction.
    pub fn sample(&self, wo: Direction) -> Option<Scatter> {
        (wo.z() > 0.0).then(|| Scatter::Specular {
            wi: Direction::Z.mirror(wo),
            reflectance: self.albedo(wo),
        })
    }

    /// R(θ).
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            return Spectrum::ZERO;
        }
        to_spectrum(self.index.reflectance(wo.z()))
    }
}
