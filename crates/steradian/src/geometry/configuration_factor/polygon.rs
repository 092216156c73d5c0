//! Polygons: Lambert's sum.
//!
//! Along the edge from rᵢ to rᵢ₊₁ the contour integral is the angle Θᵢ that the edge subtends times the cosine between the
//! element's normal and that of the plane through edge and element
//! (J. H. Lambert, *Photometria*, 1760; as derived by Baum, Rushmeier & Winget, SIGGRAPH 1989, eq. 9):
//!
//! F = (1/2π) | Σ Θᵢ n · (rᵢ × rᵢ₊₁)/|rᵢ × rᵢ₊₁| |

use std::f64::consts::{PI, TAU};

use crate::geometry::{Direction, Point, Vector};
use crate::quantity::ProjectedSolidAngle;

/// The configuration factor of a plane polygon from the element at `position`, by its outline. An outline of fewer
/// than three points has none.
pub fn of_polygon(position: Point, normal: Direction, outline: &[Point]) -> f64 {
    let vertices: Vec<Vector> = outline.iter().map(|&vertex| vertex - position).collect();
    of_vertices(&vertices, normal)
}

/// The same for vertices relative to the element. Their lengths do not matter to the sum.
pub(super) fn of_vertices(vertices: &[Vector], normal: Direction) -> f64 {
    let visible = above_horizon(vertices, normal);
    let sum: f64 = edges(&visible)
        .map(|(from, to)| edge_term(normal, from, to))
        .sum();
    sum.abs() / TAU
}

/// Ω = π F: the projected solid angle of a plane polygon, by its outline.
pub fn projected_solid_angle_of_polygon(
    position: Point,
    normal: Direction,
    outline: &[Point],
) -> ProjectedSolidAngle {
    ProjectedSolidAngle::from_steradians(PI * of_polygon(position, normal, outline))
}

fn edges(vertices: &[Vector]) -> impl Iterator<Item = (Vector, Vector)> {
    vertices
        .iter()
        .copied()
        .zip(vertices.iter().copied().cycle().skip(1))
}

/// Θ n·Γ; 0 for an edge that points at the element, which subtends no angle.
pub(super) fn edge_term(normal: Direction, from: Vector, to: Vector) -> f64 {
    let axis = from.cross(to - from);
    let length = axis.length();
    if length == 0.0 {
        return 0.0;
    }
    libm::atan2(length, from.dot(to)) * normal.dot(axis) / length
}

/// The part of a polygon with n·r ≥ 0 (Sutherland & Hodgman, CACM 17 (1), 1974). A concave polygon may fall apart; the
/// double edges along the horizon that then join its parts cancel in the sum.
pub(in crate::geometry) fn above_horizon(vertices: &[Vector], normal: Direction) -> Vec<Vector> {
    let mut visible = Vec::with_capacity(vertices.len() + 2);
    for (from, to) in edges(vertices) {
        let (height_from, height_to) = (normal.dot(from), normal.dot(to));
        if height_from >= 0.0 {
            visible.push(from);
        }
        if (height_from < 0.0) != (height_to < 0.0) {
            visible.push((from * height_to - to * height_from) / (height_to - height_from));
        }
    }
    visible
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use proptest::prelude::*;

    /// The parallelogram with this corner and these edges.
    fn parallelogram(corner: [f64; 3], u: [f64; 3], v: [f64; 3]) -> [Point; 4] {
        let (corner, u, v) = (Point::from(corner), Vector::from(u), Vector::from(v));
        [corner, corner + u, corner + u + v, corner + v]
    }

    fn from_origin(outline: &[Point]) -> f64 {
        of_polygon(Point::ORIGIN, Direction::Z, outline)
    }

    #[test]
    fn a_wall_at_right_angles_to_the_element() {
        // Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-4: the wall of width b and height a,
        // one lower corner at the distance c in front of the element; X = a/b, Y = c/b.
        let (a, b, c) = (2.0, 3.0, 1.5);
        let (x, y) = (a / b, c / b);
        let root = f64::sqrt(x * x + y * y);
        let expected = (libm::atan(1.0 / y) - y / root * libm::atan(1.0 / root)) / TAU;
        let wall = parallelogram([c, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, a]);
        assert!(close(from_origin(&wall), expected, 1e-15));
        let sunk = parallelogram([c, 0.0, -7.0], [0.0, b, 0.0], [0.0, 0.0, a + 7.0]);
        assert!(close(from_origin(&sunk), expected, 1e-15));
    }

    #[test]
    fn a_polygon_below_or_beside_or_around_the_element() {
        let floor = |z: f64| parallelogram([-1.0, -1.0, z], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
        assert_eq!(from_origin(&floor(-1.0)), 0.0);
        assert_eq!(
            from_origin(&parallelogram(
                [1.0, 1.0, 0.0],
                [2.0, 0.0, 0.0],
                [0.0, 2.0, 0.0]
            )),
            0.0
        );
        assert!(close(from_origin(&floor(0.0)), 1.0, 1e-15));
        assert!(close(from_origin(&floor(1e-9)), 1.0, 1e-8));
        assert_eq!(from_origin(&floor(1.0)[..2]), 0.0);
        assert_eq!(from_origin(&[]), 0.0);
    }

    #[test]
    fn a_concave_polygon_that_falls_apart_at_the_horizon() {
        let u_shape = [
            (-3, -1),
            (3, -1),
            (3, 2),
            (1, 2),
            (1, -0),
            (-1, 0),
            (-1, 2),
            (-3, 2),
        ]
        .map(|(y, z)| Point::new(2.0, f64::from(y), f64::from(z) - 0.5));
        let prong = |y: f64| parallelogram([2.0, y, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.5]);
        let expected = from_origin(&prong(1.0)) + from_origin(&prong(-3.0));
        for start in 0..8 {
            let mut turned = u_shape;
            turned.rotate_left(start);
            assert!(close(from_origin(&turned), expected, 2e-15));
        }
    }

    #[test]
    fn far_away_it_is_cosine_times_solid_angle_over_pi() {
        let corner = [300.0, 0.0, 400.0];
        let far = parallelogram(corner, [0.0, 0.01, 0.0], [0.008, 0.0, -0.006]);
        // cosθ = 0.8 at 500 m, face on.
        assert!(close(
            from_origin(&far) * PI / (1e-4 / 250_000.0 * 0.8),
            1.0,
            1e-4
        ));
        let projected = projected_solid_angle_of_polygon(Point::ORIGIN, Direction::Z, &far);
        assert_eq!(projected.to_steradians(), PI * from_origin(&far));
    }

    proptest! {
        #[test]
        fn the_inside_of_a_box_fills_the_whole_view(eye in any_vector(0.95), normal in any_direction()) {
            let mut sum = 0.0;
            for axis in 0..3 {
                for side in [-1.0, 1.0] {
                    let (mut corner, mut u, mut v) = ([-1.0; 3], [0.0; 3], [0.0; 3]);
                    (corner[axis], u[(axis + 1) % 3], v[(axis + 2) % 3]) = (side, 2.0, 2.0);
                    sum += of_polygon(Point::ORIGIN + eye, normal, &parallelogram(corner, u, v));
                }
            }
            prop_assert!(close(sum, 1.0, 1e-13), "{sum}");
        }

        #[test]
        fn reversing_the_outline_does_not_matter(corners in prop::array::uniform3(any_vector(2.0)), n in any_direction()) {
            let [a, b, c] = corners.map(|v| Point::ORIGIN + v);
            let forth = of_polygon(Point::ORIGIN, n, &[a, b, c]);
            prop_assert!(close(forth, of_polygon(Point::ORIGIN, n, &[c, b, a]), 1e-14));
            prop_assert!((0.0..=1.0 + 1e-14).contains(&forth));
        }
    }
}
