//! Triangles and polygons by their corners.
//!
//! The triangle a, b, c, as seen from the observer, has
//!
//! tan(ω/2) = a·(b × c) / (|a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|)
//!
//! (Van Oosterom & Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 30 (2), 1983, eq. 8), positive or
//! negative by the side it shows; the arc tangent has the range −π … π, so that one formula serves for all triangles. A polygon is the
//! signed sum over a fan.

use super::super::configuration_factor::above_horizon;
use super::super::direction::Direction;
use super::super::point::{Point, Vector};
use crate::quantity::SolidAngle;

/// The solid angle of a triangle, at most 2π.
pub fn of_triangle(observer: Point, corners: [Point; 3]) -> SolidAngle {
    SolidAngle::from_steradians(signed(observer, corners).abs())
}

/// The solid angle of a plane polygon, convex or not, from its outline. An outline of fewer than three points fills
/// nothing.
pub fn of_polygon(observer: Point, outline: &[Point]) -> SolidAngle {
    let sum: f64 = match outline {
        [apex, rest @ ..] => rest
            .windows(2)
            .map(|edge| signed(observer, [*apex, edge[0], edge[1]]))
            .sum(),
        [] => 0.0,
    };
    SolidAngle::from_steradians(sum.abs())
}

/// The solid angle of the part of a plane polygon that is above the horizon of an element of this normal at the observer.
///
/// ```
/// use steradian::geometry::{Direction, Point, solid_angle};
/// // A wall of which the horizon halves what is seen.
/// let wall = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(y, z)| Point::new(1.0, y, z));
/// let seen = solid_angle::of_polygon_above_horizon(Point::ORIGIN, Direction::Z, &wall);
/// assert!((seen / solid_angle::of_polygon(Point::ORIGIN, &wall) - 0.5).abs() < 1e-15);
/// ```
pub fn of_polygon_above_horizon(
    observer: Point,
    normal: Direction,
    outline: &[Point],
) -> SolidAngle {
    let vertices: Vec<Vector> = outline.iter().map(|&vertex| vertex - observer).collect();
    let visible: Vec<Point> = above_horizon(&vertices, normal)
        .into_iter()
        .map(|vertex| Point::ORIGIN + vertex)
        .collect();
    of_polygon(Point::ORIGIN, &visible)
}

/// Positive if the corners run clockwise as seen by the observer, in which case (b − a) × (c − a) points away.
pub(super) fn signed(observer: Point, corners: [Point; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - observer);
    let [la, lb, lc] = [a, b, c].map(Vector::length);
    let volume = a.dot((corners[1] - corners[0]).cross(corners[2] - corners[0]));
    if volume == 0.0 {
        return 0.0;
    }
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(volume, denominator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn point(x: f64, y: f64, z: f64) -> Point {
        Point::new(x, y, z)
    }

    #[test]
    fn an_octant_is_an_eighth_of_the_sphere() {
        let corners = [
            point(1.0, 0.0, 0.0),
            point(0.0, 2.0, 0.0),
            point(0.0, 0.0, 3.0),
        ];
        assert!(close(
            of_triangle(Point::ORIGIN, corners) / SolidAngle::SPHERE,
            0.125,
            1e-16
        ));
    }

    #[test]
    fn a_rectangle_over_its_centre() {
        // ω = 4 asin(ab / √((a² + h²)(b² + h²))) for half sides a, b at height h.
        let (a, b, h) = (1.5, 0.5, 2.0_f64);
        let outline = [(-a, -b), (a, -b), (a, b), (-a, b)].map(|(x, y)| point(x, y, h));
        let expected = 4.0 * libm::asin(a * b / ((a * a + h * h) * (b * b + h * h)).sqrt());
        assert!(close(
            of_polygon(Point::ORIGIN, &outline).to_steradians(),
            expected,
            1e-15
        ));
    }

    #[test]
    fn a_tiny_or_far_triangle_keeps_its_digits() {
        let corners = [
            point(0.0, 0.0, 1.0),
            point(1e-8, 0.0, 1.0),
            point(0.0, 1e-8, 1.0),
        ];
        assert!(close(
            of_triangle(Point::ORIGIN, corners).to_steradians() / 0.5e-16,
            1.0,
            1e-15
        ));
    }

    #[test]
    fn in_the_plane_an_object_is_edge_on() {
        let triangle = [
            point(0.0, 0.0, 0.0),
            point(1.0, 0.0, 0.0),
            point(0.0, 1.0, 0.0),
        ];
        for observer in [point(0.25, 0.25, 0.0), point(1.0, 1.0, 0.0), triangle[1]] {
            assert_eq!(of_triangle(observer, triangle), SolidAngle::ZERO);
        }
        let near = of_triangle(point(0.25, 0.25, 1e-12), triangle);
        assert!(close(near.to_steradians(), 2.0 * PI, 1e-10));
        assert_eq!(of_polygon(Point::ORIGIN, &triangle[..2]), SolidAngle::ZERO);
        assert_eq!(of_polygon(Point::ORIGIN, &[]), SolidAngle::ZERO);
    }

    #[test]
    fn a_concave_outline_is_its_parts() {
        let outline = [
            (0.0, 0.0),
            (2.0, 0.0),
            (2.0, 1.0),
            (1.0, 1.0),
            (1.0, 2.0),
            (0.0, 2.0),
        ]
        .map(|(x, y)| point(x, y, 1.0));
        let rectangle = |x: [f64; 2], y: [f64; 2]| {
            of_polygon(
                Point::ORIGIN,
                &[(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| point(x[i], y[j], 1.0)),
            )
        };
        let parts = rectangle([0.0, 2.0], [0.0, 1.0]) + rectangle([0.0, 1.0], [1.0, 2.0]);
        for start in 0..6 {
            let mut turned = outline;
            turned.rotate_left(start);
            assert!(close(
                of_polygon(Point::ORIGIN, &turned) / parts,
                1.0,
                1e-15
            ));
        }
    }

    proptest! {
        #[test]
        fn the_faces_of_a_tetrahedron_close_the_sphere_around_its_inside(
            corners in prop::array::uniform4(any_vector(1.0)),
            weights in prop::array::uniform4(0.05..1.0_f64),
        ) {
            let corners = corners.map(|v| Point::ORIGIN + v);
            let [a, b, c, d] = corners;
            prop_assume!((b - a).cross(c - a).dot(d - a).abs() > 1e-3);
            let total: f64 = weights.iter().sum();
            let inside = corners.iter().zip(weights)
                .fold(Point::ORIGIN, |sum, (corner, weight)| sum + corner.to_vector() * (weight / total));
            let sum: SolidAngle =
                [[a, b, c], [a, b, d], [a, c, d], [b, c, d]].map(|face| of_triangle(inside, face)).into_iter().sum();
            prop_assert!(close(sum / SolidAngle::SPHERE, 1.0, 1e-12));
        }

        #[test]
        fn splitting_a_triangle_does_not_change_it(
            corners in prop::array::uniform3(any_vector(1.0)), t in 0.0..1.0_f64, eye in any_vector(2.0)
        ) {
            let [a, b, c] = corners.map(|v| Point::ORIGIN + v);
            let eye = Point::ORIGIN + eye;
            let middle = b.lerp(c, t);
            let parts = of_triangle(eye, [a, b, middle]) + of_triangle(eye, [a, middle, c]);
            let normal = (b - a).cross(c - a);
            prop_assume!(normal.dot(eye - a).abs() > 1e-2 * normal.length());
            prop_assert!(close(parts.to_steradians(), of_triangle(eye, [a, b, c]).to_steradians(), 1e-12));
        }

        #[test]
        fn both_sides_of_a_horizon_make_the_polygon(
            corners in prop::array::uniform3(any_vector(1.0)), eye in any_vector(2.0), normal in any_direction(),
        ) {
            let [a, b, c] = corners.map(|v| Point::ORIGIN + v);
            let eye = Point::ORIGIN + eye;
            let face = (b - a).cross(c - a);
            prop_assume!(face.dot(eye - a).abs() > 1e-2 * face.length());
            let parts = [normal, -normal].map(|normal| of_polygon_above_horizon(eye, normal, &[a, b, c]));
            let sum = parts[0] + parts[1];
            prop_assert!(close(sum.to_steradians(), of_triangle(eye, [a, b, c]).to_steradians(), 1e-12));
        }
    }
}
