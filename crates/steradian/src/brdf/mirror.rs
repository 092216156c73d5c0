//! A smooth mirror: L(d_e) = ρ_s · L(p, −d_i) with d_i = d_e reflected about the normal.
//!
//! The reflectance ρ_s is the same at every angle (a Fresnel conductor is another model). A mirror has no value in
//! 1/sr; only sampling finds its one direction.

use super::Scatter;
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A mirror.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Mirror {
    /// ρ_s of each lane.
    pub reflectance: Spectrum,
}

impl Mirror {
    /// (x, y, z) → (−x, −y, z).
    pub fn sample(&self, wo: Direction) -> Option<Scatter> {
        let wi = Direction::Z.mirror(wo);
        (wo.z() > 0.0).then_some(Scatter::Specular {
            wi,
            reflectance: self.reflectance,
        })
    }

    /// ρ_s.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        if wo.z() <= 0.0 {
            Spectrum::ZERO
        } else {
            self.reflectance
        }
    }
}
