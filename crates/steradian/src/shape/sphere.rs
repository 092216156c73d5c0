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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Frame, Vector};
    use crate::sampling::testing::{assert_proportional, grid_cell, histogram, independent};
    use std::f64::consts::PI;

    fn port(direction: Direction, half_angle: f64) -> SpherePort {
        let cos_half_angle = libm::cos(half_angle);
        SpherePort {
            direction,
            cos_half_angle,
        }
    }

    fn sphere(ports: Vec<SpherePort>) -> Sphere {
        Sphere {
            center: Point::new(4.0, 5.0, 6.0),
            radius: 2.0,
            inside: false,
            ports,
        }
    }

    #[test]
    fn ports_take_their_caps_from_the_area() {
        assert!((sphere(vec![]).area() - 16.0 * PI).abs() < 1e-13);
        // A cap of half angle 60° has the height R/2: area 2πR·R/2.
        let two = vec![port(Direction::Z, PI / 3.0), port(-Direction::Z, PI / 3.0)];
        assert!((sphere(two).area() - (16.0 - 8.0) * PI).abs() < 1e-13);
    }

    #[test]
    fn ports_that_touch_do_not_overlap() {
        let right_angle = |a, b| sphere(vec![port(Direction::X, a), port(Direction::Y, b)]);
        assert!(!right_angle(PI / 4.0, PI / 4.0).ports_overlap());
        assert!(right_angle(PI / 4.0, PI / 4.0 + 1e-6).ports_overlap());
        assert!(!sphere(vec![port(Direction::X, 3.0)]).ports_overlap());
    }

    /// Archimedes: z and φ are uniform.
    #[test]
    fn samples_are_uniform_by_area() {
        let axis = Direction::new(Vector::new(1.0, -1.0, 0.5)).unwrap();
        let frame = Frame::from_normal(axis);
        let cell = |u| {
            let sample = sphere(vec![]).sample_area(u).unwrap();
            let local = frame.to_local(sample.normal);
            grid_cell(
                [
                    0.5 + 0.5 * local.z(),
                    libm::atan2(local.y(), local.x()) / TAU + 0.5,
                ],
                8,
            )
        };
        let counts = histogram(64, independent(4, 65_536).map(cell));
        assert_proportional(&counts, &[1.0; 64]);
    }

    #[test]
    fn samples_lie_on_the_sphere_and_face_its_front() {
        let open = sphere(vec![port(Direction::X, 1.0)]);
        let inside = Sphere {
            inside: true,
            ..open.clone()
        };
        let mut in_port = 0;
        for u in independent(5, 10_000) {
            let Some(sample) = open.sample_area(u) else {
                in_port += 1;
                continue;
            };
            let outwards = sample.point - open.center;
            assert!((sample.normal.to_vector() * 2.0 - outwards).length() < 1e-14);
            assert!(outwards.x <= 2.0 * libm::cos(1.0) + 1e-14);
            assert_eq!(
                inside.sample_area(u).map(|s| s.normal),
                Some(-sample.normal)
            );
        }
        // Binomial with p = (1 − cos 1)/2 = .2298: mean 2298, σ = 42.
        assert!(
            (f64::from(in_port) - 2298.5).abs() < 6.0 * 42.1,
            "{in_port}"
        );
    }
}
