//! Discs.

use super::contour::{self, Circle};
use crate::geometry::{Direction, Point};
use crate::quantity::Length;

/// The configuration factor of a disc anywhere and however tilted, from the element at `position`.
///
/// The contour integral along the visible arc, closed along the horizon. Special cases are r²/(h² + r²) for a parallel disc
/// straight ahead (Howell's catalogue, B-12) and, with H = h/a, R = r/a and Z = 1 + H² + R², ½ (1 − (Z − 2R²)/√(Z² − 4R²)) for
/// one whose axis passes at the distance a (B-13).
///
/// A disc of no or negative radius, or of NaN, has none.
///
/// ```
/// use steradian::geometry::{configuration_factor, Direction, Point};
/// use steradian::quantity::Length;
/// let overhead = Point::new(0.0, 0.0, 2.0);
/// let found = configuration_factor::of_disc(Point::ORIGIN, Direction::Z, overhead, -Direction::Z, Length::from_metres(1.0));
/// assert!((found - 0.2).abs() < 1e-15); // 1/(4 + 1)
/// ```
pub fn of_disc(
    position: Point,
    normal: Direction,
    center: Point,
    axis: Direction,
    radius: Length,
) -> f64 {
    let radius = radius.to_metres();
    if radius.is_nan() || radius <= 0.0 {
        return 0.0;
    }
    let circle = Circle::new(center - position, axis, radius);
    contour::factor(normal, &[circle.whole(normal)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Frame;
    use crate::geometry::configuration_factor::of_polygon;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn from_origin(normal: Direction, center: [f64; 3], axis: Direction, radius: f64) -> f64 {
        of_disc(
            Point::ORIGIN,
            normal,
            center.into(),
            axis,
            Length::from_metres(radius),
        )
    }

    #[test]
    fn the_three_forms_of_the_catalogue() {
        for (r, h) in [(1.0, 1.0), (3.0, 0.25), (1.0, 0.01), (0.001, 5.0)] {
            let found = from_origin(Direction::Z, [0.0, 0.0, h], Direction::Z, r);
            assert!(
                close(found * (h * h + r * r) / (r * r), 1.0, 1e-14),
                "{r} {h}"
            );
        }
        for (r, a, h) in [
            (1.0, 0.5, 1.0),
            (1.0, 1.0, 0.5),
            (0.2, 3.0, 2.0),
            (1.0, 10.0, 1.0),
            (1.0, 1e-9, 1.0),
        ] {
            let (h2, r2) = (h * h / (a * a), r * r / (a * a));
            let z: f64 = 1.0 + h2 + r2;
            let expected = 0.5 * (1.0 - (z - 2.0 * r2) / (z * z - 4.0 * r2).sqrt());
            assert!(
                close(
                    from_origin(Direction::Z, [a, 0.0, h], -Direction::Z, r),
                    expected,
                    1e-15
                ),
                "{r} {a} {h}"
            );
            // B-14, the element perpendicular to the disc and the disc in front of it.
            if a > r {
                let expected = 0.5 * h / a * (z / (z * z - 4.0 * r2).sqrt() - 1.0);
                assert!(
                    close(
                        from_origin(Direction::X, [a, 0.0, h], Direction::Z, r),
                        expected,
                        1e-15
                    ),
                    "{r} {a} {h}"
                );
            }
        }
    }

    #[test]
    fn discs_beside_below_around_and_touched() {
        let seen = |center, axis| from_origin(Direction::Z, center, axis, 1.0);
        assert_eq!(seen([3.0, 0.0, 0.0], Direction::Z), 0.0);
        assert_eq!(seen([3.0, 0.0, -2.0], Direction::X), 0.0);
        assert!(close(seen([0.5, 0.0, 0.0], Direction::Z), 1.0, 1e-15));
        // The upper half of a disc that is perpendicular to the element, 1/2 of the whole sphere's view in the limit.
        assert!(close(seen([1e-9, 0.0, 0.0], Direction::X), 0.5, 1e-8));
        assert!((0.0..=1.0).contains(&seen([1.0, 0.0, 0.0], Direction::Z)));
        assert!((0.0..=1.0).contains(&seen([0.0, 0.0, 1.0], Direction::Y)));
        for radius in [0.0, -1.0, f64::NAN] {
            assert_eq!(
                from_origin(Direction::Z, [0.0, 0.0, 1.0], Direction::Z, radius),
                0.0
            );
        }
    }

    /// By polygons of n and 2n corners, extrapolated: the errors fall as 1/n².
    fn by_polygons(normal: Direction, center: Point, axis: Direction) -> f64 {
        let frame = Frame::from_normal(axis);
        let polygon = |corners: u32| {
            let corner = |index: u32| {
                let (sin, cos) = libm::sincos(TAU * f64::from(index) / f64::from(corners));
                center + frame.vector_to_world([cos, sin, 0.0].into())
            };
            of_polygon(
                Point::ORIGIN,
                normal,
                &(0..corners).map(corner).collect::<Vec<_>>(),
            )
        };
        (4.0 * polygon(2000) - polygon(1000)) / 3.0
    }

    proptest! {
        #[test]
        fn a_disc_is_the_limit_of_polygons(center in any_vector(3.0), normal in any_direction(), axis in any_direction()) {
            let aside = center - axis * axis.dot(center);
            prop_assume!(libm::hypot(axis.dot(center), aside.length() - 1.0) > 0.3);
            let center = Point::ORIGIN + center;
            let found = of_disc(Point::ORIGIN, normal, center, axis, Length::from_metres(1.0));
            // Where the horizon cuts an edge the extrapolation leaves a part of 1/n².
            prop_assert!(close(found, by_polygons(normal, center, axis), 1e-5), "{found}");
            if normal.dot(center.to_vector()) > 1.0 {
                prop_assert!(close(found, by_polygons(normal, center, axis), 1e-9), "{found}");
            }
        }

        #[test]
        fn the_horizon_cuts_a_disc_into_what_is_above_and_below(
            center in any_vector(3.0), normal in any_direction(), axis in any_direction(),
        ) {
            // From both sides of the element together, the contour integral without any horizon.
            let center = Point::ORIGIN + center;
            let seen = |normal| of_disc(Point::ORIGIN, normal, center, axis, Length::from_metres(1.0));
            let circle = Circle::new(center.to_vector(), axis, 1.0);
            let whole = circle.integral_of_all(normal) / TAU;
            let from_front = axis.dot(center.to_vector()).signum();
            prop_assert!(close(seen(normal) - seen(-normal), whole * from_front, 1e-13));
        }
    }
}
