//! Rectangles with parallel sides.
//!
//! | pair | source |
//! |---|---|
//! | in parallel planes, of any size and offset | J. R. Ehlert & T. F. Smith, "View Factors for Perpendicular and Parallel Rectangular Plates", J. Thermophysics 7 (1), 1993; Howell's catalogue, C-13 |
//! | in perpendicular planes, of any size and offset | the same; C-15 |
//! | with a common edge, at any angle | C-16; here by [`between_polygons`], without its integral |
//!
//! The first two are sums over the 16 pairs of corners. Their terms are of the size of the rectangles or of their distance
//! squared, whichever is larger, so that far pairs lose digits; [`between_polygons`] does not.

use std::f64::consts::PI;

use super::dimensions::{DimensionError, interval, positive};
use super::polygons::between_polygons;
use crate::geometry::{Point, Polygon};
use crate::quantity::{Angle, Length};

/// From one rectangle to another at this distance that faces it, each by its extent along x and y.
///
/// # Errors
/// If an extent or the distance is not positive.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Length;
/// let unit = [[Length::ZERO, Length::from_metres(1.0)]; 2];
/// let found = form_factor::between_parallel_rectangles(unit, unit, Length::from_metres(1.0))?;
/// assert!((found - 0.199824895698).abs() < 1e-12);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between_parallel_rectangles(
    from: [[Length; 2]; 2],
    to: [[Length; 2]; 2],
    distance: Length,
) -> Result<f64, DimensionError> {
    let [x, y] = [
        interval("width of the first rectangle", from[0])?,
        interval("height of the first rectangle", from[1])?,
    ];
    let [u, v] = [
        interval("width of the second rectangle", to[0])?,
        interval("height of the second rectangle", to[1])?,
    ];
    let z = positive("distance", distance)?;
    let corner = |x: f64, y: f64| {
        let arm = |a: f64, b: f64| {
            let root = (b * b + z * z).sqrt();
            a * root * libm::atan(a / root)
        };
        (arm(x, y) + arm(y, x) - 0.5 * z * z * libm::log(x * x + y * y + z * z)) / (2.0 * PI)
    };
    Ok(over_corners(|i, j, k, l| corner(x[i] - u[k], y[j] - v[l])) / area(x, y))
}

/// From a rectangle in the plane z = 0, by its extent along x > 0 and y, to one in the plane x = 0, by its extent along y and
/// z > 0; their fronts face each other.
///
/// # Errors
/// If an extent is not positive, or along x or z not beyond the common line.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Length;
/// let unit = [[Length::ZERO, Length::from_metres(1.0)]; 2];
/// let found = form_factor::between_perpendicular_rectangles(unit, unit)?;
/// assert!((found - 0.200043776075).abs() < 1e-12);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between_perpendicular_rectangles(
    from: [[Length; 2]; 2],
    to: [[Length; 2]; 2],
) -> Result<f64, DimensionError> {
    let [x, y] = [
        interval("width of the first rectangle", from[0])?,
        interval("length of the first rectangle", from[1])?,
    ];
    let [v, z] = [
        interval("length of the second rectangle", to[0])?,
        interval("height of the second rectangle", to[1])?,
    ];
    if x[0] < 0.0 || z[0] < 0.0 {
        return Err(DimensionError::Intersecting(
            "perpendicular rectangles must lie on one side of their common line",
        ));
    }
    let corner = |x: f64, y: f64, z: f64| {
        let (square, y2) = (x * x + z * z, y * y);
        let root = square.sqrt();
        let logarithm = if square + y2 > 0.0 {
            libm::log(square + y2)
        } else {
            0.0
        };
        (y * root * libm::atan2(y, root) - 0.25 * (square - y2) * logarithm) / (2.0 * PI)
    };
    Ok(over_corners(|i, j, k, l| corner(x[i], y[j] - v[k], z[l])) / area(x, y))
}

/// From a rectangle to another with the edge of this length in common; `widths` are their other sides, and the angle is the one
/// between their fronts.
///
/// # Errors
/// If a length is not positive or the angle not between 0 and 180°.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::{Angle, Length};
/// let one = Length::from_metres(1.0);
/// let found = form_factor::between_hinged_rectangles([one, one], one, Angle::from_degrees(60.0))?;
/// assert!((found - 0.370905).abs() < 1e-6);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between_hinged_rectangles(
    widths: [Length; 2],
    edge: Length,
    angle: Angle,
) -> Result<f64, DimensionError> {
    let (first, second) = (
        positive("width of the first rectangle", widths[0])?,
        positive("width of the second rectangle", widths[1])?,
    );
    let length = positive("common edge", edge)?;
    let (sin, cos) = libm::sincos(angle.to_radians());
    if !(angle.to_radians() > 0.0 && angle.to_radians() < PI) {
        return Err(DimensionError::BadAngle {
            name: "angle between the rectangles",
            limit: 180.0,
        });
    }
    let rectangle = |corners: [[f64; 3]; 4]| {
        Polygon::new(corners.map(Point::from).to_vec(), vec![]).map_err(|_| {
            DimensionError::Intersecting("a rectangle is too narrow to be told from a line")
        })
    };
    let floor = rectangle([
        [0.0, 0.0, 0.0],
        [first, 0.0, 0.0],
        [first, length, 0.0],
        [0.0, length, 0.0],
    ])?;
    let (x, z) = (second * cos, second * sin);
    let wall = rectangle([
        [0.0, 0.0, 0.0],
        [0.0, length, 0.0],
        [x, length, z],
        [x, 0.0, z],
    ])?;
    Ok(between_polygons(&floor, &wall))
}

/// Σ (−1)^(i+j+k+l) term(i, j, k, l).
fn over_corners(term: impl Fn(usize, usize, usize, usize) -> f64) -> f64 {
    let signed = |bits: usize| {
        let value = term(bits & 1, bits >> 1 & 1, bits >> 2 & 1, bits >> 3);
        if bits.count_ones().is_multiple_of(2) {
            value
        } else {
            -value
        }
    };
    (0..16).map(signed).sum()
}

fn area([x1, x2]: [f64; 2], [y1, y2]: [f64; 2]) -> f64 {
    (x2 - x1) * (y2 - y1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;
    use proptest::prelude::*;

    fn polygon(corners: [[f64; 3]; 4]) -> Polygon {
        Polygon::new(corners.map(Point::from).to_vec(), vec![]).unwrap()
    }

    fn lengths(ends: [f64; 2]) -> [Length; 2] {
        ends.map(Length::from_metres)
    }

    fn any_interval(least: f64) -> impl Strategy<Value = [f64; 2]> {
        (least..2.0, 0.05..2.0_f64).prop_map(|(from, length)| [from, from + length])
    }

    #[test]
    fn sizes_that_make_no_sense_are_refused() {
        let unit = [lengths([0.0, 1.0]); 2];
        let error =
            between_parallel_rectangles(unit, [lengths([1.0, 1.0]); 2], Length::from_metres(1.0))
                .unwrap_err();
        assert_eq!(
            error.to_string(),
            "the width of the second rectangle runs from 1 m to 1 m, but must have a length"
        );
        let error = between_parallel_rectangles(unit, unit, Length::ZERO).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the distance is 0 m, but must be positive and finite"
        );
        assert!(between_perpendicular_rectangles([lengths([-1.0, 1.0]); 2], unit).is_err());
        for degrees in [0.0, 180.0, -5.0, f64::NAN] {
            assert!(
                between_hinged_rectangles(
                    unit[0].map(|l| l + Length::from_metres(1.0)),
                    Length::from_metres(1.0),
                    Angle::from_degrees(degrees)
                )
                .is_err()
            );
        }
    }

    proptest! {
        #[test]
        fn parallel_rectangles_are_polygons(
            x in any_interval(-2.0), y in any_interval(-2.0), u in any_interval(-2.0), v in any_interval(-2.0), z in 0.01..4.0_f64,
        ) {
            let found = between_parallel_rectangles([lengths(x), lengths(y)], [lengths(u), lengths(v)], Length::from_metres(z)).unwrap();
            let lower = polygon([[x[0], y[0], 0.0], [x[1], y[0], 0.0], [x[1], y[1], 0.0], [x[0], y[1], 0.0]]);
            let upper = polygon([[u[0], v[0], z], [u[0], v[1], z], [u[1], v[1], z], [u[1], v[0], z]]);
            let scale = 1e-14 * (1.0 + z * z) / area(x, y);
            prop_assert!(close(found, between_polygons(&lower, &upper), scale), "{found}");
        }

        #[test]
        fn perpendicular_rectangles_are_polygons(
            x in any_interval(0.0), y in any_interval(-2.0), v in any_interval(-2.0), z in any_interval(0.0),
        ) {
            let found = between_perpendicular_rectangles([lengths(x), lengths(y)], [lengths(v), lengths(z)]).unwrap();
            let floor = polygon([[x[0], y[0], 0.0], [x[1], y[0], 0.0], [x[1], y[1], 0.0], [x[0], y[1], 0.0]]);
            let wall = polygon([[0.0, v[0], z[0]], [0.0, v[1], z[0]], [0.0, v[1], z[1]], [0.0, v[0], z[1]]]);
            prop_assert!(close(found, between_polygons(&floor, &wall), 1e-13 / area(x, y)), "{found}");
        }

        #[test]
        fn a_hinge_opened_to_a_right_angle_is_perpendicular(w in 0.1..3.0_f64, h in 0.1..3.0_f64, l in 0.1..3.0_f64) {
            let widths = [w, h].map(Length::from_metres);
            let hinged = between_hinged_rectangles(widths, Length::from_metres(l), Angle::from_degrees(90.0)).unwrap();
            let flat = between_perpendicular_rectangles([lengths([0.0, w]), lengths([0.0, l])], [lengths([0.0, l]), lengths([0.0, h])]).unwrap();
            prop_assert!(close(hinged, flat, 1e-13));
        }

        #[test]
        fn a_long_hinge_is_a_wedge(w in 0.1..3.0_f64, h in 0.1..3.0_f64, degrees in 5.0..175.0_f64) {
            let widths = [w, h].map(Length::from_metres);
            let angle = Angle::from_degrees(degrees);
            let long = between_hinged_rectangles(widths, Length::from_metres(1e6), angle).unwrap();
            let wedge = super::super::strips::between_wedge_sides(widths, angle).unwrap();
            prop_assert!(close(long, wedge, 1e-5), "{long} {wedge}");
        }
    }
}
