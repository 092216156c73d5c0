//! Ellipses: a disc that fills the same cone.
//!
//! A cone with the half angles α ≥ β along its planes of symmetry, x² cot²α + y² cot²β = z², has circular sections: in the planes
//! z = 1 + k y with k² tan²β = (tan²α − tan²β)/(1 + tan²α), from which subtracting cot²α (x² + y² + z²) leaves two planes. With
//! s = k tanβ their circle has the diameter from (0, tanβ, 1)/(1 − s) to (0, −tanβ, 1)/(1 + s). So the ellipse has the
//! configuration factor of that disc.

use super::of_disc;
use crate::geometry::solid_angle::semi_axes;
use crate::geometry::{Direction, Frame, Point, Vector};
use crate::quantity::Length;

/// The configuration factor of an ellipse by its centre and half axes, which may be any conjugate ones, from the element at `position`.
/// One that is seen edge-on or has no area has none.
///
/// ```
/// use steradian::geometry::{Direction, Point, Vector, configuration_factor};
/// let half_axes = [Vector::new(2.0, 0.0, 0.0), Vector::new(0.0, 2.0, 0.0)];
/// let found = configuration_factor::of_ellipse(Point::ORIGIN, Direction::Z, Point::new(0.0, 0.0, 2.0), half_axes);
/// assert!((found - 0.5).abs() < 1e-14); // a disc of 2 m, 2 m above: 4/(4 + 4)
/// ```
pub fn of_ellipse(
    position: Point,
    normal: Direction,
    center: Point,
    half_axes: [Vector; 2],
) -> f64 {
    let [u, v] = half_axes;
    let center = center - position;
    let Some(([from, to], axis)) = circular_section(center, u, v) else {
        return 0.0;
    };
    let radius = Length::from_metres(0.5 * (to - from).length());
    let middle = position + (from + to) * 0.5;
    of_disc(position, normal, middle, axis, radius)
}

/// A diameter of a circular section of the cone over c + u cos t + v sin t, and the normal of its plane.
fn circular_section(c: Vector, u: Vector, v: Vector) -> Option<([Vector; 2], Direction)> {
    let size = [c, u, v]
        .map(Vector::max_component)
        .into_iter()
        .fold(0.0, f64::max);
    let [c, u, v] = [c, u, v].map(|vector| vector / size);
    let volume = c.dot(u.cross(v)).abs();
    if volume.is_nan() || volume == 0.0 {
        return None;
    }
    let [wide, narrow, m] = semi_axes(u, v, c, volume);
    let matrix = |x: Vector| u * u.dot(x) + v * v.dot(x) - c * c.dot(x);
    let frame = Frame::from_normal(axis_of(c, |x| matrix(x) + x * m)?);
    let (x, y) = (frame.tangent().to_vector(), frame.bitangent().to_vector());
    // The principal axes across the cone's.
    let (xx, xy, yy) = (x.dot(matrix(x)), x.dot(matrix(y)), y.dot(matrix(y)));
    let (sin, cos) = libm::sincos(0.5 * libm::atan2(2.0 * xy, xx - yy));
    let (narrow_axis, z) = (y * cos - x * sin, frame.normal().to_vector());
    let tan = (narrow / m).sqrt();
    let s = ((wide - narrow) / (m + wide)).max(0.0).sqrt();
    let ends = [
        (narrow_axis * tan + z) / (1.0 - s),
        (z - narrow_axis * tan) / (1.0 + s),
    ];
    let normal = Direction::new(z * tan - narrow_axis * s).ok()?;
    Some((ends, normal))
}

/// The direction that a symmetric matrix of rank 2 takes to 0, on the side of `towards`.
fn axis_of(towards: Vector, matrix: impl Fn(Vector) -> Vector) -> Option<Direction> {
    let rows = [Direction::X, Direction::Y, Direction::Z].map(|axis| matrix(axis.into()));
    let products = [[0, 1], [1, 2], [2, 0]].map(|[i, j]| rows[i].cross(rows[j]));
    let longest = products
        .into_iter()
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
    let axis = Direction::new(longest).ok()?;
    Some(if axis.dot(towards) < 0.0 { -axis } else { axis })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::configuration_factor::of_polygon;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    /// By polygons of n and 2n corners, extrapolated: the errors fall as 1/n².
    fn by_polygons(normal: Direction, c: Vector, [u, v]: [Vector; 2]) -> f64 {
        let polygon = |corners: u32| {
            let corner = |index: u32| {
                let (sin, cos) = libm::sincos(TAU * f64::from(index) / f64::from(corners));
                Point::ORIGIN + c + u * cos + v * sin
            };
            let corners: Vec<Point> = (0..corners).map(corner).collect();
            of_polygon(Point::ORIGIN, normal, &corners)
        };
        (4.0 * polygon(2000) - polygon(1000)) / 3.0
    }

    #[test]
    fn edge_on_or_without_area_there_is_none() {
        let axes = [Direction::X, Direction::Y].map(Vector::from);
        let seen = |center: Point, axes| of_ellipse(Point::ORIGIN, Direction::X, center, axes);
        assert_eq!(seen(Point::new(3.0, 0.0, 0.0), axes), 0.0);
        assert_eq!(seen(Point::new(3.0, 0.0, 1.0), [axes[0], axes[0]]), 0.0);
    }

    proptest! {
        #[test]
        fn an_ellipse_is_the_limit_of_polygons(
            center in any_vector(3.0), axes in prop::array::uniform2(any_vector(1.5)), normal in any_direction(),
        ) {
            let plane = axes[0].cross(axes[1]);
            prop_assume!(plane.length() > 0.1 && (plane.dot(center) / plane.length()).abs() > 0.2);
            let found = of_ellipse(Point::ORIGIN, normal, Point::ORIGIN + center, axes);
            let expected = by_polygons(normal, center, axes);
            // Where the horizon cuts an edge the extrapolation leaves a part of 1/n².
            prop_assert!(close(found, expected, 3e-5), "{found} {expected}");
            if normal.dot(center) > axes[0].length() + axes[1].length() {
                prop_assert!(close(found, expected, 1e-9), "{found} {expected}");
            }
        }
    }
}
