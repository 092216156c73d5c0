//! A disc or annulus: area π(R² − r²).

use std::f64::consts::{PI, TAU};

use crate::geometry::{Direction, Frame, Point};

use super::AreaSample;

/// A disc of outer radius R and inner radius r.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// The centre.
    pub center: Point,
    /// Normal of the front.
    pub normal: Direction,
    /// R in metres.
    pub radius: f64,
    /// r in metres.
    pub inner_radius: f64,
}

impl Disc {
    /// A = π(R² − r²).
    pub fn area(&self) -> f64 {
        PI * (self.radius * self.radius - self.inner_radius * self.inner_radius)
    }

    /// A point of uniform density 1/A: ρ² is uniform between r² and R².
    pub fn sample_area(&self, u: [f64; 2]) -> AreaSample {
        let (inner, outer) = (
            self.inner_radius * self.inner_radius,
            self.radius * self.radius,
        );
        let rho = (inner + (outer - inner) * u[0]).sqrt();
        let (sin, cos) = (libm::sin(TAU * u[1]), libm::cos(TAU * u[1]));
        let frame = Frame::from_normal(self.normal);
        let local = frame.tangent() * (rho * cos) + frame.bitangent() * (rho * sin);
        AreaSample {
            point: self.center + local,
            normal: self.normal,
            face: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::sampling::testing::{assert_proportional, grid_cell, histogram, independent};

    fn annulus() -> Disc {
        Disc {
            center: Point::new(1.0, 2.0, 3.0),
            normal: Direction::new(Vector::new(1.0, 2.0, 2.0)).unwrap(),
            radius: 2.0,
            inner_radius: 1.0,
        }
    }

    #[test]
    fn the_area_of_an_annulus() {
        assert_eq!(annulus().area(), 3.0 * PI);
    }

    #[test]
    fn samples_lie_on_the_annulus() {
        for u in independent(1, 1000) {
            let sample = annulus().sample_area(u);
            let from_center = sample.point - annulus().center;
            assert!((1.0 - 1e-12..2.0 + 1e-12).contains(&from_center.length()));
            assert!(sample.normal.dot(from_center).abs() < 1e-14);
            assert_eq!(sample.normal, annulus().normal);
        }
    }

    /// Cells of equal area: ρ² and φ are uniform.
    #[test]
    fn samples_are_uniform_by_area() {
        let frame = Frame::from_normal(annulus().normal);
        let cell = |u| {
            let local = frame.vector_to_local(annulus().sample_area(u).point - annulus().center);
            let turn = libm::atan2(local.y, local.x) / TAU + 0.5;
            grid_cell([(local.length_squared() - 1.0) / 3.0, turn], 8)
        };
        let counts = histogram(64, independent(2, 65_536).map(cell));
        assert_proportional(&counts, &[1.0; 64]);
    }
}
