//! A sphere with circular ports: area 4πR² less 2πR²(1 − cos a) for each port of half angle a.

use std::f64::consts::TAU;

use crate::geometry::{Direction, Point};

use super::AreaSample;

/// A circular opening: the cap of directions within the half angle of `direction`, seen from the centre.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct SpherePort {
    /// Middle of the port.
    pub direction: Direction,
    /// Cosine of the half angle.
    pub cos_half_angle: f64,
}

/// A sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// The centre.
    pub center: Point,
    /// R in metres.
    pub radius: f64,
    /// The front is the inside.
    pub inside: bool,
    /// Openings; they do not overlap.
    pub ports: Vec<SpherePort>,
}

impl Sphere {
    /// Area of what is left beside the ports.
    pub fn area(&self) -> f64 {
        let open: f64 = self
            .ports
            .iter()
            .map(|port| TAU * (1.0 - port.cos_half_angle))
            .sum();
        (2.0 * TAU - open) * self.radius * self.radius
    }

    /// Area of the whole sphere, the domain of [`sample_area`](Self::sample_area).
    pub fn full_area(&self) -> f64 {
        2.0 * TAU * self.radius * self.radius
    }

    /// A point of uniform density 1/(4πR²) over the whole sphere; `None` in a port.
    pub fn sample_area(&self, u: [f64; 2]) -> Option<AreaSample> {
        let cos = 1.0 - 2.0 * u[0];
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let phi = TAU * u[1];
        let outwards = Direction::from_polar(sin, cos, phi);
        if self.in_port(outwards) {
            return None;
        }
        let normal = if self.inside { -outwards } else { outwards };
        Some(AreaSample {
            point: self.center + outwards.to_vector() * self.radius,
            normal,
            face: 0,
        })
    }

    /// Whether a direction from the centre leads through a port.
    pub fn in_port(&self, outwards: Direction) -> bool {
        self.ports
            .iter()
            .any(|port| port.direction.dot(outwards) > port.cos_half_angle)
    }

    /// Whether two ports overlap.
    pub fn ports_overlap(&self) -> bool {
        let angle = |cos: f64| libm::acos(cos.clamp(-1.0, 1.0));
        let overlap = |a: &SpherePort, b: &SpherePort| {
            let between = angle(a.direction.dot(b.direction));
            between < (angle(a.cos_half_angle) + angle(b.cos_half_angle)) * (1.0 - 1e-12)
        };
        self.ports
            .iter()
            .enumerate()
            .any(|(i, a)| self.ports[..i].iter().any(|b| overlap(a, b)))
    }
}
