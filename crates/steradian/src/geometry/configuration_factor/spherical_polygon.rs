//! Polygons on the sphere.
//!
//! Lambert's sum over the arcs, signed: counter-clockwise outlines seen from outside count positively. Where the outline leaves the
//! visible half, the horizon closes it the short way, which may be the wrong one, and an outline may go around all the rest
//! of the sphere: both change the sum by whole hemispheres, so F is its fractional part. Where that is 0 or 1 to rounding, the vector
//! integral tells which: with the whole sum S over 2π, the factors above and below differ by exactly that, and
//!
//! ω − 2π + S ≥ π if F = 1, ≤ −π if F = 0
//!
//! because π F ≤ ω for the part below.

use std::f64::consts::TAU;

use super::polygon::{above_horizon, edge_term};
use crate::geometry::solid_angle::{self, SphericalPolygonError};
use crate::geometry::{Direction, Vector};

/// Parts of a hemisphere that are rounding.
const ROUNDING: f64 = 1e-12;

/// The configuration factor of the directions to the left of an outline on the sphere, which must not cross itself; see
/// [`of_spherical_polygon`](solid_angle::of_spherical_polygon).
///
/// # Errors
/// As for the solid angle.
///
/// ```
/// use steradian::geometry::{Direction, configuration_factor, solid_angle};
/// let outline = [Direction::X, Direction::Y, Direction::Z];
/// let octant = configuration_factor::of_spherical_polygon(Direction::Z, &outline)?;
/// assert!((octant - 0.25).abs() < 1e-15);
/// # Ok::<(), solid_angle::SphericalPolygonError>(())
/// ```
pub fn of_spherical_polygon(
    normal: Direction,
    corners: &[Direction],
) -> Result<f64, SphericalPolygonError> {
    let fills = solid_angle::of_spherical_polygon(corners)?.to_steradians();
    let outline: Vec<Vector> = corners.iter().map(|&corner| corner.into()).collect();
    let hemispheres = sum(normal, &above_horizon(&outline, normal)) / TAU;
    let rest = hemispheres - hemispheres.round();
    if rest.abs() > ROUNDING {
        return Ok(rest.rem_euclid(1.0));
    }
    let is_all = fills - TAU + sum(normal, &outline) > 0.0;
    Ok((f64::from(u8::from(is_all)) + rest).clamp(0.0, 1.0))
}

/// Σ Θᵢ n·Γᵢ around a closed outline.
fn sum(normal: Direction, outline: &[Vector]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    let edges = outline.iter().zip(next);
    edges.map(|(&from, &to)| edge_term(normal, from, to)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::geometry::configuration_factor::{of_cap, of_polygon};
    use crate::geometry::testing::{any_direction, close, ring};
    use crate::quantity::Angle;
    use proptest::prelude::*;

    #[test]
    fn all_or_nothing_of_the_hemisphere() {
        let seen = |outline: &[Direction]| of_spherical_polygon(Direction::Z, outline).unwrap();
        let mut below = ring(-Direction::Z, 0.5, 5);
        assert_eq!(seen(&below), 0.0);
        below.reverse();
        assert_eq!(seen(&below), 1.0);
        assert!(of_spherical_polygon(Direction::Z, &below[..2]).is_err());
    }

    proptest! {
        #[test]
        fn a_plane_polygon_is_one_on_the_sphere(
            pole in any_direction(), half_angle in 0.05..1.5_f64, corners in 3..9_u32, normal in any_direction(),
        ) {
            let outline = ring(pole, half_angle, corners);
            let points: Vec<Point> = outline.iter().map(|&corner| Point::ORIGIN + corner.to_vector()).collect();
            let found = of_spherical_polygon(normal, &outline).unwrap();
            prop_assert!(close(found, of_polygon(Point::ORIGIN, normal, &points), 1e-12), "{found}");
        }

        #[test]
        fn left_and_right_make_the_hemisphere(pole in any_direction(), half_angle in 0.05..3.0_f64, normal in any_direction()) {
            let mut outline = ring(pole, half_angle, 800);
            let left = of_spherical_polygon(normal, &outline).unwrap();
            // The sides are great circles, the cap's rim is none: 2π²/(3 · 800²) of it.
            let cap = of_cap(normal, pole, Angle::from_radians(half_angle));
            prop_assert!(close(left, cap, 4e-5), "{left} {cap}");
            outline.reverse();
            let right = of_spherical_polygon(normal, &outline).unwrap();
            prop_assert!(close(left + right, 1.0, 1e-11));
        }
    }
}
