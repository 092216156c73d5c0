//! How much of a ball of lights a highlight shows.
//!
//! l = π D(h)/(4 cosθ_e), D(h) = a²/(π (a² cos²θ_h + sin²θ_h)²), a² = min(α² + r²/4, 1)
//!
//! is ρ cosθ_i of facets that mirror all light and hide none, over that of a white diffuse surface along the normal.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | h | half-way between the viewer and the middle of the ball; θ_h its angle to the normal | |
//! | α | width of the facets' slopes | 1 |
//! | r | sine of the angle under which the ball's radius is seen | 1 |
//!
//! Facets of the width a are those of the surface spread over the ball: half-way normals turn half as far as directions. Where the ball covers
//! the whole highlight l is 1/(r² cosθ_e), along the normal the mean over the ball. Of lights without extent it is exact for facets of
//! Trowbridge and Reitz that do not hide each other. Without it a lamp that stands in the highlight is as rarely sampled as one that does not.
//!
//! Source: B. Walter et al., EGSR 2007, eq. 20 and 33.

use glam::Vec3;

use super::node::{cross, dot};
use super::number::Number;
use crate::brdf::Gloss;

/// Least cosine of the viewer, which keeps highlights finite.
const GRAZING: f32 = 1e-3;

/// How a surface mirrors: unit vectors to the viewer and along the shading normal, and the gloss.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(in crate::transport) struct Highlight {
    pub viewer: Vec3,
    pub normal: Vec3,
    pub gloss: Gloss,
}

impl Highlight {
    /// l of light that comes along `way` out of balls that are seen under `r`.
    #[inline(always)]
    pub fn over<N: Number>(&self, way: [N; 3], r: N) -> N {
        let (viewer, normal) = (self.viewer.to_array(), self.normal.to_array());
        let normal = normal.map(N::splat);
        let half: [N; 3] = std::array::from_fn(|axis| N::splat(viewer[axis]) - way[axis]);
        let alpha = self.gloss.alpha;
        let width = (r * r * N::splat(0.25) + N::splat(alpha * alpha)).least(N::splat(1.0));
        let (along, across) = (dot(half, normal), cross(half, normal));
        let spread = along * along * width + dot(across, across);
        let squared = dot(half, half) / spread.most(N::splat(f32::MIN_POSITIVE));
        let cos_viewer = self.viewer.dot(self.normal).most(GRAZING);
        squared * squared * width * N::splat(0.25 / cos_viewer)
    }
}
