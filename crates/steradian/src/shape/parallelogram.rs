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
    /// `None` when the edges span no area: sin(e₁, e₂) is within rounding, 8·2⁻⁵², of 0.
    pub fn new(origin: Point, edges: [Vector; 2]) -> Option<Self> {
        let cross = edges[0].cross(edges[1]);
        let area = cross.length();
        let normal = Direction::new(cross).ok()?;
        let rounding = 8.0 * f64::EPSILON * edges[0].length() * edges[1].length();
        (area.is_finite() && area > rounding).then_some(Self {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::testing::{assert_proportional, grid_cell, histogram, independent};

    fn skew() -> Parallelogram {
        let edges = [Vector::new(3.0, 0.0, 0.0), Vector::new(1.0, 2.0, 0.0)];
        Parallelogram::new(Point::new(1.0, 1.0, 5.0), edges).unwrap()
    }

    #[test]
    fn area_normal_and_corners() {
        assert_eq!((skew().area, skew().normal), (6.0, Direction::Z));
        let corners = skew().corners().map(Point::to_array);
        let expected = [[1.0, 1.0], [4.0, 1.0], [5.0, 3.0], [2.0, 3.0]];
        assert_eq!(corners, expected.map(|[x, y]| [x, y, 5.0]));
    }

    #[test]
    fn edges_without_area_are_refused() {
        let along = Vector::new(0.1, 0.2, 0.3);
        for other in [Vector::ZERO, along * 3.0, -along / 7.0, along * f64::NAN] {
            assert_eq!(Parallelogram::new(Point::ORIGIN, [along, other]), None);
        }
        let slender = [Vector::new(1e3, 0.0, 0.0), Vector::new(1e3, 1e-9, 0.0)];
        assert!(Parallelogram::new(Point::ORIGIN, slender).is_some());
    }

    #[test]
    fn samples_are_uniform_by_area() {
        let cell = |u| {
            let Vector { x, y, z } = skew().sample_area(u).point - skew().origin;
            assert_eq!(z, 0.0);
            grid_cell([(x - y / 2.0) / 3.0, y / 2.0], 8)
        };
        let counts = histogram(64, independent(3, 65_536).map(cell));
        assert_proportional(&counts, &[1.0; 64]);
    }
}
