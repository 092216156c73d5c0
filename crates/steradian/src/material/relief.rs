//! Relief that is too fine for a mesh, told by a picture: it turns the normal that reflection reckons with, and moves nothing.
//!
//! | picture | normal of the front |
//! |---|---|
//! | normals | x s t + y s b + z n, with (x, y, z) = 2 (r, g, b) − 1 |
//! | heights | n − s (h_u ∇u + h_v ∇v) |
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | n | the normal without relief | |
//! | t, b | along growing u, and across it along growing v, in the surface | |
//! | h_u, h_v | growth of the picture's grey value with u and v, by central differences over a texel | 1 |
//! | s | scale | 1; m for heights |
//!
//! Source: J. Blinn, *Simulation of wrinkled surfaces* (SIGGRAPH 1978), eq. 5, for a relief that is flat against its width;
//! Khronos, *glTF 2.0 Specification*, §3.9.3 (normal textures; green points along +v of the upward image, as our v does).

use std::sync::Arc;

use super::{Bitmap, Picture, Site};
use crate::geometry::{Direction, Vector};
use crate::shape::along_u;

/// A relief.
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    /// Of linear numbers.
    pub bitmap: Arc<Bitmap>,
    /// Row i gives coordinate i of the picture as row · (u, v, 1).
    pub placement: [[f64; 3]; 2],
    /// What it shows.
    pub kind: ReliefKind,
}

/// What the picture of a relief shows.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum ReliefKind {
    /// Normals; their x and y are multiplied.
    Normals {
        /// By this.
        scale: f64,
    },
    /// Heights.
    Heights {
        /// Of the grey value 1, in m.
        scale: f64,
    },
}

impl Relief {
    /// The picture that shows it.
    pub fn picture(&self) -> Picture {
        Picture {
            bitmap: Arc::clone(&self.bitmap),
            placement: self.placement,
            channel: 0,
        }
    }

    /// The normal of the front from that without relief and the gradients of the texture coordinates; `None` where the picture
    /// has no normal that faces outwards.
    pub fn normal(
        &self,
        site: &Site,
        plain: Direction,
        gradients: [Vector; 2],
    ) -> Option<Direction> {
        let turned = match self.kind {
            ReliefKind::Normals { scale } => self.mapped(site, plain, gradients, scale)?,
            ReliefKind::Heights { scale } => {
                let [by_u, by_v] = self.slopes(site);
                plain.to_vector() - (gradients[0] * by_u + gradients[1] * by_v) * scale
            }
        };
        let turned = Direction::new(turned).ok()?;
        (turned.dot(plain) > 0.0).then_some(turned)
    }

    fn mapped(
        &self,
        site: &Site,
        plain: Direction,
        gradients: [Vector; 2],
        scale: f64,
    ) -> Option<Vector> {
        let n = plain.to_vector();
        let along = along_u(gradients);
        let t = Direction::new(along - n * along.dot(n)).ok()?.to_vector();
        let b = n.cross(t);
        let b = if b.dot(gradients[1]) < 0.0 { -b } else { b };
        let [x, y, z, _] = self
            .bitmap
            .at(self.place(site))
            .map(|code| 2.0 * f64::from(code) - 1.0);
        Some(t * (x * scale) + b * (y * scale) + n * z)
    }

    /// h_u and h_v.
    fn slopes(&self, site: &Site) -> [f64; 2] {
        let place = self.place(site);
        let by_picture = [0, 1].map(|axis| {
            let half = 0.5 / f64::from(self.bitmap.size()[axis]);
            let at = |side: f64| {
                let mut there = place;
                there[axis] += side * half;
                let [r, g, b, _] = self.bitmap.at(there).map(f64::from);
                (r + g + b) / 3.0
            };
            (at(1.0) - at(-1.0)) / (2.0 * half)
        });
        [0, 1].map(|k| by_picture[0] * self.placement[0][k] + by_picture[1] * self.placement[1][k])
    }

    fn place(&self, site: &Site) -> [f64; 2] {
        let [u, v] = site.coordinates.map(f64::from);
        self.placement.map(|[a, b, c]| a * u + b * v + c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Texels;

    const AXES: [Vector; 2] = [Vector::new(0.5, 0.0, 0.0), Vector::new(0.0, 0.25, 0.0)];
    const SAME: [[f64; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    fn relief(width: u32, texels: Vec<[f32; 4]>, kind: ReliefKind) -> Relief {
        let height = texels.len() as u32 / width;
        let bitmap = Bitmap::new(width, height, Texels::Float(texels)).unwrap();
        Relief {
            bitmap: Arc::new(bitmap),
            placement: SAME,
            kind,
        }
    }

    fn at(relief: &Relief, coordinates: [f32; 2], gradients: [Vector; 2]) -> Option<Direction> {
        let site = Site {
            coordinates,
            ..Site::NOWHERE
        };
        relief.normal(&site, Direction::Z, gradients)
    }

    #[test]
    fn a_normal_of_the_picture_stands_in_the_axes_of_the_coordinates() {
        // (.6, 0, .8): codes (1.6, 1, 1.8)/2.
        let texel = [0.8, 0.5, 0.9, 1.0];
        let map = relief(1, vec![texel], ReliefKind::Normals { scale: 1.0 });
        let close = |found: Direction, expected: [f64; 3]| {
            let found = found.to_array();
            assert!(
                (0..3).all(|k| (found[k] - expected[k]).abs() < 1e-6),
                "{found:?}"
            );
        };
        close(at(&map, [0.5; 2], AXES).unwrap(), [0.6, 0.0, 0.8]);
        // u grows along −y, v along x.
        let turned = [Vector::new(0.0, -1.0, 0.0), Vector::new(1.0, 0.0, 0.0)];
        close(at(&map, [0.5; 2], turned).unwrap(), [0.0, -0.6, 0.8]);
        let flat = relief(1, vec![texel], ReliefKind::Normals { scale: 0.0 });
        close(at(&flat, [0.5; 2], AXES).unwrap(), [0.0, 0.0, 1.0]);
        let inwards = relief(
            1,
            vec![[0.5, 0.5, 0.0, 1.0]],
            ReliefKind::Normals { scale: 1.0 },
        );
        assert_eq!(at(&inwards, [0.5; 2], AXES), None);
    }

    /// Four texels across grow by ¼ each: between their middles h_u = 1, over 2 m of surface a slope of ½ · scale.
    #[test]
    fn a_ramp_of_heights_tilts_the_normal_by_its_slope() {
        let grey = |h: f32| [h, h, h, 1.0];
        let texels = [0.125, 0.375, 0.625, 0.875].map(grey).to_vec();
        let ramp = relief(4, texels, ReliefKind::Heights { scale: 0.5 });
        let [x, y, z] = at(&ramp, [0.5; 2], AXES).unwrap().to_array();
        assert!((x / z + 0.25).abs() < 1e-6 && y.abs() < 1e-9, "{x} {y} {z}");
    }
}
