//! Cylinders.

use super::contour::{self, Circle, Piece};
use crate::geometry::{Direction, Point};
use crate::quantity::Length;

/// The configuration factor of the outer side of a right circular cylinder, without its ends, from the element at `position`.
///
/// `ends` are the centres of the two ends. What the element sees is bounded by the two lines in which planes through it touch
/// the cylinder and by the arcs of both ends between them, on the near side. So it is a contour integral in closed form, for any
/// direction of the element and with any part of the cylinder below its horizon. The catalogue's special case is an element in
/// the plane of one end that faces the axis at the distance H, in units of the radius, of a cylinder of length L; with
/// X = (1 + H)² + L² and Y = (1 − H)² + L² (Howell, B-31),
///
/// π F = 1/H atan(L/√(H² − 1)) + L (X − 2H)/(H √(XY)) atan √(X (H − 1)/(Y (H + 1))) − L/H atan √((H − 1)/(H + 1))
///
/// Inside the cylinder, or before one of its ends, nothing of the outer side is seen, nor of a cylinder without radius or length.
///
/// ```
/// use steradian::geometry::{configuration_factor, Direction, Point};
/// use steradian::quantity::Length;
/// // Facing the axis of a very long cylinder from four radii: 1/4.
/// let ends = [Point::new(4.0, 0.0, -1e9), Point::new(4.0, 0.0, 1e9)];
/// let found = configuration_factor::of_cylinder(Point::ORIGIN, Direction::X, ends, Length::from_metres(1.0));
/// assert!((found - 0.25).abs() < 1e-12);
/// ```
pub fn of_cylinder(position: Point, normal: Direction, ends: [Point; 2], radius: Length) -> f64 {
    let (Ok(axis), radius) = (Direction::new(ends[1] - ends[0]), radius.to_metres()) else {
        return 0.0;
    };
    let to_start = ends[0] - position;
    let distance = (to_start - axis * axis.dot(to_start)).length();
    if !(radius > 0.0 && distance > radius) {
        return 0.0;
    }
    let [start, end] = ends.map(|center| Circle::new(center - position, axis, radius));
    let half_width = libm::acos(radius / distance);
    let [left, right] = [-half_width, half_width].map(|side| std::f64::consts::PI + side);
    let contour = [
        Piece::Arc(start, [left, right]),
        Piece::Line([start.at(right), end.at(right)]),
        Piece::Arc(end, [right, left]),
        Piece::Line([end.at(left), start.at(left)]),
    ];
    contour::factor(normal, &contour)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::configuration_factor::of_polygon;
    use crate::geometry::testing::{any_direction, close};
    use crate::geometry::{Transform, Vector};
    use crate::quantity::Angle;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn unit(position: Point, normal: Direction, length: f64) -> f64 {
        let ends = [Point::ORIGIN, Point::new(0.0, 0.0, length)];
        of_cylinder(position, normal, ends, Length::from_metres(1.0))
    }

    #[test]
    fn an_element_at_the_foot_that_faces_the_axis() {
        for (h, l) in [(1.5_f64, 1.0), (3.0, 0.2), (10.0, 40.0), (1.001, 2.0)] {
            let (x, y) = ((1.0 + h) * (1.0 + h) + l * l, (1.0 - h) * (1.0 - h) + l * l);
            let ratio = (h - 1.0) / (h + 1.0);
            let sum = libm::atan(l / (h * h - 1.0).sqrt()) / h
                + l * (x - 2.0 * h) / (h * (x * y).sqrt()) * libm::atan((x / y * ratio).sqrt())
                - l / h * libm::atan(ratio.sqrt());
            let found = unit(Point::new(-h, 0.0, 0.0), Direction::X, l);
            assert!(close(found, sum / PI, 1e-14), "{h} {l}: {found}");
        }
    }

    #[test]
    fn what_of_a_cylinder_cannot_be_seen() {
        let nought = [
            unit(Point::new(0.5, 0.0, 0.5), Direction::Z, 1.0),
            unit(Point::new(0.5, 0.0, 3.0), -Direction::Z, 1.0),
            unit(Point::new(3.0, 0.0, 0.5), Direction::X, 1.0),
            unit(Point::new(3.0, 0.0, 2.0), Direction::Z, 1.0),
            unit(Point::new(3.0, 0.0, 2.0), -Direction::X, 0.0),
            of_cylinder(
                Point::ORIGIN,
                Direction::X,
                [Point::new(2.0, 0.0, 0.0), Point::new(2.0, 0.0, 1.0)],
                Length::from_metres(f64::NAN),
            ),
        ];
        assert_eq!(nought, [0.0; 6]);
    }

    /// What the element sees of the cylinder, as a polygon with corners on the contour; twice, and extrapolated.
    fn by_polygons(position: Point, normal: Direction, length: f64) -> f64 {
        let axis_distance = libm::hypot(position.x, position.y);
        let (towards, half_width) = (
            libm::atan2(position.y, position.x),
            libm::acos(1.0 / axis_distance),
        );
        let polygon = |parts: u32| {
            let corner = |index: u32, z: f64| {
                let angle =
                    towards + half_width * (2.0 * f64::from(index) / f64::from(parts) - 1.0);
                Point::new(libm::cos(angle), libm::sin(angle), z)
            };
            let lower = (0..=parts).map(|index| corner(index, 0.0));
            let upper = (0..=parts).rev().map(|index| corner(index, length));
            of_polygon(position, normal, &lower.chain(upper).collect::<Vec<_>>())
        };
        (4.0 * polygon(2000) - polygon(1000)) / 3.0
    }

    proptest! {
        #[test]
        fn a_cylinder_anywhere_is_the_limit_of_its_outline(
            normal in any_direction(), distance in 1.2..5.0_f64, turn in 0.0..360.0_f64, z in -3.0..3.0_f64, length in 0.1..4.0_f64,
        ) {
            let (sin, cos) = libm::sincos(turn.to_radians());
            let position = Point::new(distance * cos, distance * sin, z);
            let found = unit(position, normal, length);
            let expected = by_polygons(position, normal, length);
            prop_assert!(close(found, expected, 1e-5), "{found} {expected}");
            let lowest = [0.0, length].map(|z| normal.dot(Point::new(0.0, 0.0, z) - position)).into_iter().fold(9.0, f64::min);
            if lowest > 1.0 {
                prop_assert!(close(found, expected, 1e-9), "{found} {expected}");
            }
        }

        #[test]
        fn moving_all_together_changes_nothing(
            normal in any_direction(), axis in any_direction(), angle in 0.0..360.0_f64, length in 0.1..4.0_f64,
        ) {
            let position = Point::new(2.0, 0.3, 0.4);
            let turn = Transform::rotate(axis, Angle::from_degrees(angle), position).then(Transform::translate(Vector::new(1.0, 2.0, 3.0)));
            let ends = [Point::ORIGIN, Point::new(0.0, 0.0, length)].map(|end| turn.point(end));
            let turned = of_cylinder(turn.point(position), turn.normal(normal).unwrap(), ends, Length::from_metres(1.0));
            prop_assert!(close(turned, unit(position, normal, length), 1e-13));
        }
    }
}
