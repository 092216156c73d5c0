//! Strips without end.

use super::polygon::of_vertices;
use crate::geometry::{Direction, Point, Vector};

/// The configuration factor of an endless plane strip, by a point on each of its two edges and their direction.
///
/// Seen from the element both edges run from the point d at infinity to the opposite one, so that the strip is the two spherical
/// triangles of the directions ± d, e₁, e₂, and Lambert's sum holds. Wholly above the horizon and parallel to it, that is
/// F = ½ |sin α₂ − sin α₁| with the angles α of the edges from the normal (Howell's catalogue, B-1).
///
/// ```
/// use steradian::geometry::{configuration_factor, Direction, Point};
/// // From the zenith to 30° off it: ½ sin 30°.
/// let edges = [Point::new(0.0, 0.0, 2.0), Point::new(2.0 / f64::sqrt(3.0), 7.0, 2.0)];
/// let found = configuration_factor::of_strip(Point::ORIGIN, Direction::Z, edges, Direction::Y);
/// assert!((found - 0.25).abs() < 1e-15);
/// ```
pub fn of_strip(
    position: Point,
    normal: Direction,
    edges: [Point; 2],
    direction: Direction,
) -> f64 {
    let [first, second] = edges.map(|edge| across(edge - position, direction));
    let end = direction.to_vector();
    of_vertices(&[end, first, second], normal) + of_vertices(&[-end, second, first], normal)
}

/// The part perpendicular to the strip's direction, so that far points on the edges lose no digits.
fn across(point: Vector, direction: Direction) -> Vector {
    point - direction * direction.dot(point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::configuration_factor::of_polygon;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use proptest::prelude::*;

    #[test]
    fn the_two_halves_of_the_sky_and_strips_below() {
        let from = |a: [f64; 3], b: [f64; 3]| {
            of_strip(
                Point::ORIGIN,
                Direction::Z,
                [a.into(), b.into()],
                Direction::Y,
            )
        };
        assert!(close(from([0.0, 0.0, 1.0], [1e9, 0.0, 1.0]), 0.5, 1e-15));
        assert!(close(
            from([1.0, 0.0, -1.0], [1.0, 0.0, 1.0]),
            0.5 - 0.5 * 0.5_f64.sqrt(),
            1e-15
        ));
        assert_eq!(from([1.0, 0.0, -1.0], [3.0, 0.0, -1.0]), 0.0);
        assert!(close(from([-1.0, 0.0, 0.0], [1.0, 5.0, 0.0]), 1.0, 1e-15));
    }

    proptest! {
        #[test]
        fn a_strip_is_the_limit_of_long_rectangles(
            [a, b] in prop::array::uniform2(any_vector(2.0)), normal in any_direction(), direction in any_direction(),
        ) {
            let [a, b] = [Point::ORIGIN + a, Point::ORIGIN + b];
            let step = direction * 1e6;
            let long = of_polygon(Point::ORIGIN, normal, &[a - step, b - step, b + step, a + step]);
            let found = of_strip(Point::ORIGIN, normal, [a, b], direction);
            // The ends fill an angle of 4 m/1000 km.
            prop_assert!(close(found, long, 4e-6), "{found} {long}");
        }
    }
}
