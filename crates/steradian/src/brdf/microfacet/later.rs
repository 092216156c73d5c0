//! The light that the facets of a metal pass to one another, in single precision: for loops over many paths.
//!
//! The second term of [`RoughConductor`](super::RoughConductor) is F_ms M(d_e) M(d_i)/(π M̄), and its density is p₂(d_i), which has the share M(d_e) of the
//! draws. M is linear in √cosθ between nodes and p₂ in cosθ within bands, so that between the tables of two widths both are again. √cosθ
//! is off by half a rounding, and M by less than its step between two nodes times 2⁻¹⁷: 1e-6 where it is steepest.

use std::f64::consts::FRAC_1_PI;

use super::shelf::Blend;

type Lanes = [f32; 4];

/// What loops know of it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Later {
    shares: Blend<1>,
    /// M at the nodes.
    missing: Vec<f32>,
    /// p₂/cosθ in each band.
    bands: Vec<f32>,
    /// F_ms/(π M̄).
    reflectance: Lanes,
}

impl Later {
    /// Of tables that do not depend on azimuth.
    pub(super) fn new(shares: &Blend<1>, reflectance: [f64; 4]) -> Option<Self> {
        let scale = FRAC_1_PI / shares.average(0);
        Some(Self {
            missing: shares.nodes(0)?,
            bands: shares.bands(0),
            reflectance: reflectance.map(|lane| (lane * scale) as f32),
            shares: shares.clone(),
        })
    }

    /// M: the share of the draws of a viewer at this height.
    pub fn share(&self, cos: f32) -> f32 {
        let place = cos.clamp(0.0, 1.0).sqrt() * self.bands.len() as f32;
        let node = (place as usize).min(self.bands.len() - 1);
        let [low, high] = [self.missing[node], self.missing[node + 1]];
        low + (place - node as f32) * (high - low)
    }

    /// ρ cosθ_i of both terms and the density of both, from those of the first one.
    pub fn added_to(&self, (value, pdf): (Lanes, f32), share: f32, cos: f32) -> (Lanes, f32) {
        let band = (cos.clamp(0.0, 1.0).sqrt() * self.bands.len() as f32) as usize;
        let own = self.bands[band.min(self.bands.len() - 1)] * cos;
        let both = share * self.share(cos) * cos;
        let value = std::array::from_fn(|lane| value[lane] + self.reflectance[lane] * both);
        (value, pdf + share * (own - pdf))
    }

    /// A direction of density p₂.
    pub fn sample(&self, u: [f32; 2]) -> [f32; 3] {
        let direction = self.shares.sample(0, u.map(f64::from));
        direction.to_array().map(|axis| axis as f32)
    }
}
