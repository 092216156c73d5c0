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
