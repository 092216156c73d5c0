//! Polygons for tests.

use std::f64::consts::TAU;

use crate::geometry::{Direction, Frame, Point, Polygon, Transform, Vector};
use crate::quantity::Angle;

pub(super) fn polygon(corners: &[[f64; 3]]) -> Polygon {
    outlined(corners.iter().map(|&corner| corner.into()).collect())
}

pub(super) fn outlined(outline: Vec<Point>) -> Polygon {
    Polygon::new(outline, vec![]).unwrap()
}

/// The unit square on the ground, facing upwards.
pub(super) fn floor() -> Polygon {
    polygon(&[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ])
}

/// The unit square at the height z, facing downwards.
pub(super) fn ceiling(z: f64) -> Polygon {
    polygon(&[[0.0, 0.0, z], [0.0, 1.0, z], [1.0, 1.0, z], [1.0, 0.0, z]])
}

/// The rectangle 0 ≤ y ≤ 1, 0 ≤ z ≤ height at this x, facing along X.
pub(super) fn wall(x: f64, height: f64) -> Polygon {
    polygon(&[
        [x, 0.0, 0.0],
        [x, 1.0, 0.0],
        [x, 1.0, height],
        [x, 0.0, height],
    ])
}

/// Numbers that look random: fractional parts.
pub(super) struct Numbers(pub(super) u32);

impl Numbers {
    pub(super) fn between(&mut self, from: f64, to: f64) -> f64 {
        self.0 += 1;
        let x = libm::sin(f64::from(self.0) * 12.9898) * 43_758.545_3;
        from + (to - from) * (x - x.floor())
    }

    pub(super) fn vector(&mut self, size: f64) -> Vector {
        Vector::from([(); 3].map(|()| self.between(-size, size)))
    }

    pub(super) fn direction(&mut self) -> Direction {
        Direction::new(self.vector(1.0)).unwrap()
    }

    pub(super) fn motion(&mut self) -> Transform {
        let angle = Angle::from_degrees(self.between(0.0, 360.0));
        Transform::rotate(self.direction(), angle, Point::ORIGIN)
            .then(Transform::translate(self.vector(3.0)))
    }

    /// A convex outline of 3 … 6 corners on the unit circle of a plane through the origin.
    fn outline(&mut self) -> Vec<Point> {
        let count = self.between(3.0, 7.0) as u32;
        let frame = Frame::from_normal(self.direction());
        let start = self.between(0.0, 1.0);
        let mut corner = |index: u32| {
            let turn = start + (f64::from(index) + self.between(0.0, 0.7)) / f64::from(count);
            let (sin, cos) = libm::sincos(TAU * turn);
            Point::ORIGIN + frame.vector_to_world(Vector::new(cos, sin, 0.0))
        };
        (0..count).map(&mut corner).collect()
    }

    /// Two polygons: apart, in planes that cut the other one, with a common corner, or with a common edge, by turns.
    pub(super) fn pair(&mut self, index: u32) -> [Polygon; 2] {
        let [a, b] = [self.outline(), self.outline()];
        let size = self.between(0.1, 1.5);
        let step = match index % 4 {
            0 => self.direction() * self.between(2.5, 6.0),
            1 => self.vector(0.7),
            2 => a[0].to_vector() - b[1].to_vector() * size,
            _ => {
                let axis = Direction::new(a[1] - a[0]).unwrap();
                let turn =
                    Transform::rotate(axis, Angle::from_degrees(self.between(5.0, 175.0)), a[0]);
                let turned = a.iter().rev().map(|&corner| turn.point(corner)).collect();
                return [outlined(a), outlined(turned)];
            }
        };
        let placed = b
            .iter()
            .map(|corner| Point::ORIGIN + corner.to_vector() * size + step)
            .collect();
        [outlined(a), outlined(placed)]
    }
}
