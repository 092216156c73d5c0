//! Configuration factors in closed form.
//!
//! The configuration factor of an object, seen from a surface element, is the fraction of the element's diffuse
//! radiation that reaches the object; it is the object's projected solid angle over π,
//!
//! F = (1/π) ∫ cosθ dω
//!
//! so that an object of uniform radiance L gives the element the irradiance E = π L F. For a polygon with the
//! vertices r₁ … rₙ relative to the element of normal n, the integral turns into a sum over the edges
//! (J. H. Lambert, *Photometria*, 1760; as derived by Baum, Rushmeier & Winget, SIGGRAPH 1989, eq. 9):
//!
//! F = (1/2π) | Σ Θᵢ n · (rᵢ × rᵢ₊₁)/|rᵢ × rᵢ₊₁| |
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F | configuration factor, 0 … 1 | – |
//! | θ | angle from the element's normal | rad |
//! | Θᵢ | angle that edge i subtends at the element | rad |
//!
//! What lies below the element's horizon is clipped away first. Which side of the polygon faces the element does not
//! matter. An element in the polygon's plane sees nothing of it unless it lies inside, where the limit from above the
//! element's normal is 1; on an edge the factor has no limit, and a value between 0 and 1 is returned.
//!
//! Precision: absolute errors of some 2⁻⁵² for each edge, also upwards of 1.
//!
//! ```
//! use steradian::geometry::{configuration_factor, Direction, Point};
//! // A square of 2 m × 2 m, one metre above the element: F = (4/π) (1/√2) atan(1/√2).
//! let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Point::new(x, y, 1.0));
//! let found = configuration_factor::of_polygon(Point::ORIGIN, Direction::Z, &square);
//! assert!((found - 0.5541264239796).abs() < 1e-12);
//! ```

use std::f64::consts::{PI, TAU};

use super::direction::Direction;
use super::point::{Point, Vector};
use crate::quantity::{Length, ProjectedSolidAngle};

/// The configuration factor of a plane polygon from the element at `position`, by its outline. An outline of fewer
/// than three points has none.
pub fn of_polygon(position: Point, normal: Direction, outline: &[Point]) -> f64 {
    let vertices: Vec<Vector> = outline.iter().map(|&vertex| vertex - position).collect();
    let visible = above_horizon(&vertices, normal);
    let sum: f64 = edges(&visible)
        .map(|(from, to)| edge_term(normal, from, to))
        .sum();
    sum.abs() / TAU
}

/// The configuration factor of a sphere from the element at `position`.
///
/// With d the distance of the centre, h = d/R and θ its angle from the normal: cosθ/h² if the sphere is wholly above the
/// horizon, h cosθ ≥ 1; 0 if wholly below, h cosθ ≤ −1; otherwise, with s = √(h² − 1) and q = √(1 − h² cos²θ),
///
/// F = (cosθ arccos(−s cotθ) − s q)/(π h²) + (1/π) arctan(q/s)
///
/// which is Lambert's sum in the limit, along the visible arc of the sphere's edge and the horizon's arc below. From inside
/// the sphere it is 1, and 0 for a sphere of no or negative radius, or of NaN.
///
/// ```
/// use steradian::geometry::{configuration_factor, Direction, Point};
/// use steradian::quantity::Length;
/// let overhead = Point::new(0.0, 0.0, 4.0);
/// let found = configuration_factor::of_sphere(Point::ORIGIN, Direction::Z, overhead, Length::from_metres(1.0));
/// assert_eq!(found, 1.0 / 16.0); // (R/d)²
/// ```
pub fn of_sphere(position: Point, normal: Direction, center: Point, radius: Length) -> f64 {
    let (to_center, radius) = (center - position, radius.to_metres());
    let distance = to_center.length();
    if radius.is_nan() || radius <= 0.0 {
        return 0.0;
    }
    if distance < radius {
        return 1.0;
    }
    let h = distance / radius;
    let cos = normal.dot(to_center) / distance;
    if h * cos >= 1.0 {
        cos / (h * h)
    } else if h * cos <= -1.0 {
        0.0
    } else {
        of_sphere_cut_by_horizon(
            h,
            cos,
            ((distance - radius) * (distance + radius)).sqrt() / radius,
        )
    }
}

fn of_sphere_cut_by_horizon(h: f64, cos: f64, s: f64) -> f64 {
    let q = ((1.0 - h * cos) * (1.0 + h * cos)).sqrt();
    // √(1 − s² cot²θ) = q/sinθ, so the arc cosine is this arc tangent, which is precise at both ends.
    let visible_arc = libm::atan2(q, -s * cos);
    ((cos * visible_arc - s * q) / (h * h) + libm::atan2(q, s)) / PI
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
fn edge_term(normal: Direction, from: Vector, to: Vector) -> f64 {
    let axis = from.cross(to - from);
    let length = axis.length();
    if length == 0.0 {
        return 0.0;
    }
    libm::atan2(length, from.dot(to)) * normal.dot(axis) / length
}

/// The part of a polygon with n·r ≥ 0 (Sutherland & Hodgman, CACM 17 (1), 1974). A concave polygon may fall apart; the
/// double edges along the horizon that then join its parts cancel in the sum.
fn above_horizon(vertices: &[Vector], normal: Direction) -> Vec<Vector> {
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
    use crate::geometry::Frame;
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

    #[test]
    fn a_sphere_half_below_the_horizon_or_touched() {
        let sphere = |center: [f64; 3], radius: f64| {
            of_sphere(
                Point::ORIGIN,
                Direction::Z,
                center.into(),
                Length::from_metres(radius),
            )
        };
        // h = √2, θ = 90°: (−1/2 + π/4)/π.
        assert!(close(
            sphere([1.0, 0.0, 0.0], f64::sqrt(0.5)),
            0.25 - 0.5 / PI,
            1e-15
        ));
        // On the sphere itself: (1 + cosθ)/2.
        for (center, expected) in [
            ([0.0, 0.0, 1.0], 1.0),
            ([1.0, 0.0, 0.0], 0.5),
            ([0.0, 0.0, -1.0], 0.0),
        ] {
            assert!(close(sphere(center, 1.0), expected, 1e-15));
        }
        assert_eq!(sphere([0.0, 0.0, -0.9], 1.0), 1.0);
        assert_eq!(sphere([0.0, 0.0, -1.1], 1.0), 0.0);
        assert_eq!(
            [
                sphere([0.0, 0.0, 1.0], 0.0),
                sphere([0.0, 0.0, 1.0], f64::NAN)
            ],
            [0.0; 2]
        );
    }

    /// The edge of a sphere of radius 1 around `center` as seen from the origin, as a polygon inside it.
    fn edge_of_sphere(center: Vector, corners: u32) -> Vec<Point> {
        let square = center.length_squared();
        let frame = Frame::from_normal(Direction::new(center).unwrap());
        let radius = (1.0 - 1.0 / square).sqrt();
        let corner = |index| {
            let (sin, cos) = libm::sincos(TAU * f64::from(index) / f64::from(corners));
            let offset = frame.vector_to_world(Vector::new(radius * cos, radius * sin, 0.0));
            Point::ORIGIN + (center * (1.0 - 1.0 / square) + offset)
        };
        (0..corners).map(corner).collect()
    }

    proptest! {
        #[test]
        fn a_sphere_is_the_limit_of_polygons_in_its_edge(
            towards in any_direction(), distance in 1.05..10.0_f64, normal in any_direction(),
        ) {
            let center = towards * distance;
            let found = of_sphere(Point::ORIGIN, normal, Point::ORIGIN + center, Length::from_metres(1.0));
            let polygon = of_polygon(Point::ORIGIN, normal, &edge_of_sphere(center, 1000));
            // The polygon lacks the fraction (2π/N)²/6 of the disc; near the rim of the view up to h times as much.
            prop_assert!(close(found, polygon, 1e-4), "{found} {polygon}");
        }

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
