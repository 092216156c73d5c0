//! The unit sphere as it is drawn: seen from far away, in parallel projection.

use std::f64::consts::PI;

use steradian::geometry::{Direction, Frame, Spherical, Vector};
use steradian::quantity::Angle;

/// A half of the sphere.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Half {
    /// Towards the reader.
    Front,
    /// Away from the reader.
    Back,
}

/// Where the reader stands and how large the sphere is drawn.
pub struct Projection {
    frame: Frame,
    center: [f64; 2],
    radius: f64,
}

impl Projection {
    /// So that `subject` is on the half towards the reader, somewhat to the side, with Z upwards.
    pub fn towards(subject: Direction, center: [f64; 2], radius: f64) -> Self {
        let Spherical { theta, phi } = Spherical::from_direction(subject);
        let height = Angle::from_degrees((theta.to_degrees() * 0.6 + 28.0).clamp(45.0, 115.0));
        let reader = Spherical::new(height, phi - Angle::from_degrees(25.0)).to_direction();
        let across = Direction::Z.cross(reader);
        let frame =
            Frame::from_normal_and_tangent(reader, across).unwrap_or(Frame::from_normal(reader));
        Self {
            frame,
            center,
            radius,
        }
    }

    /// The place of a direction on the sheet.
    pub fn place(&self, direction: Direction) -> [f64; 2] {
        self.on_sheet(self.frame.vector_to_local(direction.into()))
    }

    fn on_sheet(&self, local: Vector) -> [f64; 2] {
        [
            self.center[0] + self.radius * local.x,
            self.center[1] - self.radius * local.y,
        ]
    }

    /// Whether a direction is on this half.
    pub fn is_on(&self, half: Half, direction: Direction) -> bool {
        self.height(half, direction) >= 0.0
    }

    fn height(&self, half: Half, direction: Direction) -> f64 {
        let towards_reader = self.frame.normal().dot(direction);
        if half == Half::Front {
            towards_reader
        } else {
            -towards_reader
        }
    }

    /// The azimuth φ in degrees, a multiple of `spacing`, of the meridian that runs nearest before the reader.
    pub fn front_meridian(&self, spacing: f64) -> f64 {
        let phi = Spherical::from_direction(self.frame.normal())
            .phi
            .to_degrees();
        (phi / spacing).round() * spacing
    }

    /// The parts of a line of small steps that are on this half.
    pub fn runs(&self, half: Half, line: &[Direction]) -> Vec<Vec<[f64; 2]>> {
        let is_on = |direction: &&Direction| self.is_on(half, **direction);
        let runs = line.split(|direction| !self.is_on(half, *direction));
        runs.map(|run| {
            run.iter()
                .filter(is_on)
                .map(|&direction| self.place(direction))
                .collect::<Vec<_>>()
        })
        .filter(|run| run.len() > 1)
        .collect()
    }

    /// The part of an area that is on this half, closed along the limb; none if there is nothing of it.
    pub fn area(&self, half: Half, outline: &[Direction]) -> Option<Vec<[f64; 2]>> {
        let start = outline
            .iter()
            .position(|&direction| !self.is_on(half, direction));
        let Some(start) = start else {
            return (outline.len() > 2).then(|| {
                outline
                    .iter()
                    .map(|&direction| self.place(direction))
                    .collect()
            });
        };
        let turned = outline[start..].iter().chain(&outline[..start]);
        let mut places: Vec<[f64; 2]> = Vec::new();
        let mut left_at: Option<f64> = None;
        let mut first: Option<f64> = None;
        for &direction in turned {
            let azimuth = self.azimuth(direction);
            if self.is_on(half, direction) {
                if let Some(from) = left_at.take() {
                    self.along_limb(&mut places, from, azimuth);
                }
                first.get_or_insert(azimuth);
                places.push(self.place(direction));
            } else if !places.is_empty() {
                left_at.get_or_insert(azimuth);
            }
        }
        let to = first?;
        let from = left_at.unwrap_or_else(|| self.azimuth(outline[start]));
        self.along_limb(&mut places, from, to);
        Some(places)
    }

    /// The edge of the sphere on the sheet.
    pub fn limb(&self) -> Vec<[f64; 2]> {
        let at = |degrees| libm::sincos(Angle::from_degrees(f64::from(degrees)).to_radians());
        (0..360)
            .map(at)
            .map(|(sin, cos)| self.on_sheet(Vector::new(cos, sin, 0.0)))
            .collect()
    }

    /// Where around the limb a direction lies.
    fn azimuth(&self, direction: Direction) -> f64 {
        let local = self.frame.vector_to_local(direction.into());
        libm::atan2(local.y, local.x)
    }

    /// Places on the limb from one azimuth to another, the short way.
    fn along_limb(&self, places: &mut Vec<[f64; 2]>, from: f64, to: f64) {
        let turn = (to - from + PI).rem_euclid(2.0 * PI) - PI;
        let steps = (turn.abs() / 0.02).ceil() as u32;
        for index in 0..=steps {
            let azimuth = from + turn * f64::from(index) / f64::from(steps.max(1));
            let (sin, cos) = libm::sincos(azimuth);
            places.push(self.on_sheet(Vector::new(cos, sin, 0.0)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(theta: f64) -> Vec<Direction> {
        let at = |phi| {
            Spherical::new(
                Angle::from_degrees(theta),
                Angle::from_degrees(f64::from(phi)),
            )
            .to_direction()
        };
        (0..360).map(at).collect()
    }

    /// Area of a polygon on the sheet.
    fn area(places: &[[f64; 2]]) -> f64 {
        let next = places.iter().cycle().skip(1);
        places
            .iter()
            .zip(next)
            .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
            .sum::<f64>()
            .abs()
            / 2.0
    }

    #[test]
    fn the_equator_is_cut_at_the_limb() {
        let projection = Projection::towards(Direction::X, [0.0, 0.0], 1.0);
        let halves =
            [Half::Front, Half::Back].map(|half| projection.area(half, &ring(90.0)).unwrap());
        // Between an ellipse's half and the limb's half on either side.
        let tilt = projection.frame.normal().z();
        for places in halves {
            let expected = PI / 2.0 * (1.0 - tilt);
            let found = area(&places);
            let other = PI / 2.0 * (1.0 + tilt);
            assert!(
                (found - expected).abs() < 0.02 || (found - other).abs() < 0.02,
                "{found} {expected} {other}"
            );
        }
    }

    #[test]
    fn what_is_on_one_half_is_not_on_the_other() {
        let projection = Projection::towards(Direction::Z, [0.0, 0.0], 1.0);
        let cap = ring(5.0);
        assert!(projection.area(Half::Front, &cap).is_some());
        assert!(projection.area(Half::Back, &cap).is_none());
        // The projected area of a small cap is its area times the cosine.
        let solid_angle = 2.0 * PI * (1.0 - libm::cos(5.0_f64.to_radians()));
        let expected = solid_angle * projection.frame.normal().z();
        assert!((area(&projection.area(Half::Front, &cap).unwrap()) / expected - 1.0).abs() < 0.01);
    }
}
