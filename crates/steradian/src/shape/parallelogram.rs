//! A parallelogram: origin + s·e₁ + t·e₂ with s, t in 0..1; area |e₁ × e₂|.

use crate::geometry::{Direction, Point, Vector};

use super::AreaSample;

/// A parallelogram; its front is the side of e₁ × e₂.
#[derive(Clone, Debug, PartialEq)]
pub struct Parallelogram {
    /// A corner.
    pub origin: Point,
    /// The edges that leave it.
    pub edges: [Vector; 2],
    /// e₁ × e₂, normalised.
    pub normal: Direction,
    /// In m².
    pub area: f64,
}

impl Parallelogram {
    /// `None` when the edges span no area.
    pub fn new(origin: Point, edges: [Vector; 2]) -> Option<Self> {
        let cross = edges[0].cross(edges[1]);
        let area = cross.length();
        let normal = Direction::new(cross).ok()?;
        (area.is_finite() && area > 0.0).then_some(Self {
            origin,
            edges,
            normal,
            area,
        })
    }

    /// Its corners, counter-clockwise from the front.
    pub fn corners(&self) -> [Point; 4] {
        let [a, b] = self.edges;
        [
            self.origin,
            self.origin + a,
            self.origin + a + b,
            self.origin + b,
        ]
    }

    /// A point of uniform density 1/A.
    pub fn sample_area(&self, u: [f64; 2]) -> AreaSample {
        AreaSample {
            point: self.origin + self.edges[0] * u[0] + self.edges[1] * u[1],
            normal: self.normal,
            face: 0,
        }
    }
}
