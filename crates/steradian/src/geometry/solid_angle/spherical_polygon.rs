//! Polygons on the sphere, by the directions of their corners.
//!
//! The sides are arcs of great circles, each shorter than half a circle. The part of the sphere to the left of an outline that does
//! not cross itself has, by the theorem of Gauss and Bonnet (A. Girard's for triangles, 1629), the solid angle
//!
//! ω = 2π − Σ τᵢ
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ω | solid angle to the left, 0 … 4π | sr |
//! | τᵢ | angle by which the outline turns left at corner i, −π … π | rad |
//!
//! Left is as seen from outside the sphere: counter-clockwise outlines hold their inside, clockwise ones all the rest. For
//! small outlines the difference cancels; there the signed sum over a fan of triangles, which equals ω up to multiples of
//! 4π, gives the digits.

use std::f64::consts::{PI, TAU};

use super::super::direction::Direction;
use super::super::point::{Point, Vector};
use super::polygon::signed;
use crate::quantity::SolidAngle;

/// Below this, in sr, the sum of a fan is more precise than 2π − Σ τ.
const SMALL: f64 = 1.0;

/// Why directions bound no part of the sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SphericalPolygonError {
    /// An outline needs three corners at least.
    #[error("a polygon needs three directions at least, but there are {0}")]
    TooFew(usize),
    /// Many arcs of half a circle lead from this corner to the next, or none if they are the same.
    #[error("direction {0} and the next one are the same or opposite, so no arc joins them")]
    NoArc(usize),
    /// The outline goes back the way it came, so that left and right are the same.
    #[error("the outline turns back at direction {0}")]
    TurnsBack(usize),
}

/// The solid angle to the left of an outline on the sphere, which must not cross itself.
///
/// Relative error: some 10⁻¹⁵ for each corner.
///
/// # Errors
/// If there are fewer than three corners, neighbours are the same or opposite, or the outline turns back on itself.
///
/// ```
/// use steradian::geometry::{Direction, solid_angle};
/// use steradian::quantity::SolidAngle;
/// let octant = solid_angle::of_spherical_polygon(&[Direction::X, Direction::Y, Direction::Z])?;
/// assert!((octant / SolidAngle::SPHERE - 1.0 / 8.0).abs() < 1e-15);
/// let rest = solid_angle::of_spherical_polygon(&[Direction::Z, Direction::Y, Direction::X])?;
/// assert!((rest / SolidAngle::SPHERE - 7.0 / 8.0).abs() < 1e-15);
/// # Ok::<(), solid_angle::SphericalPolygonError>(())
/// ```
pub fn of_spherical_polygon(corners: &[Direction]) -> Result<SolidAngle, SphericalPolygonError> {
    let count = corners.len();
    if count < 3 {
        return Err(SphericalPolygonError::TooFew(count));
    }
    // The normals of the arcs from each corner to the next.
    let mut normals = Vec::with_capacity(count);
    for (index, from) in corners.iter().enumerate() {
        let normal = from.cross(corners[(index + 1) % count].to_vector() - from.to_vector());
        normals.push(Direction::new(normal).map_err(|_| SphericalPolygonError::NoArc(index))?);
    }
    let mut turned = 0.0;
    for (index, corner) in corners.iter().enumerate() {
        let (before, after) = (normals[(index + count - 1) % count], normals[index]);
        let (sin, cos) = (corner.dot(before.cross(after)), before.dot(after));
        if sin == 0.0 && cos < 0.0 {
            return Err(SphericalPolygonError::TurnsBack(index));
        }
        turned += libm::atan2(sin, cos);
    }
    let by_turns = TAU - turned;
    let value = if by_turns > SMALL {
        by_turns
    } else {
        let fan = sum_of_fan(corners);
        fan + 4.0 * PI * ((by_turns - fan) / (4.0 * PI)).round()
    };
    Ok(SolidAngle::from_steradians(value))
}

fn sum_of_fan(corners: &[Direction]) -> f64 {
    let place = |corner: Direction| Point::ORIGIN + Vector::from(corner);
    let triangle = |pair: &[Direction]| [corners[0], pair[0], pair[1]].map(place);
    corners[1..]
        .windows(2)
        .map(|pair| signed(Point::ORIGIN, triangle(pair)))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, close, ring};
    use proptest::prelude::*;

    fn direction(x: f64, y: f64, z: f64) -> Direction {
        Direction::new(Vector::new(x, y, z)).unwrap()
    }

    fn area(corners: &[Direction]) -> f64 {
        of_spherical_polygon(corners).unwrap().to_steradians()
    }

    #[test]
    fn more_than_a_hemisphere() {
        // A square around the south pole seen from the north: half angle 135°, sides bulging to the pole.
        let small = area(&ring(-Direction::Z, 0.25 * PI, 4));
        let mut large = ring(-Direction::Z, 0.25 * PI, 4);
        large.reverse();
        assert!(close(area(&large) + small, 4.0 * PI, 1e-14));
        // A cube's face as seen from its centre has half diagonals of acos(1/√3).
        let face = ring(Direction::X, libm::acos(1.0 / f64::sqrt(3.0)), 4);
        assert!(close(area(&face), 4.0 * PI / 6.0, 1e-14));
    }

    #[test]
    fn a_star_is_its_points_and_its_middle() {
        let (inner, outer) = (ring(Direction::Z, 0.3, 10), ring(Direction::Z, 0.9, 10));
        let star: Vec<Direction> = (0..10)
            .map(|i| if i % 2 == 0 { outer[i] } else { inner[i] })
            .collect();
        let middle: Vec<Direction> = (1..10).step_by(2).map(|i| inner[i]).collect();
        let points: f64 = (0..10)
            .step_by(2)
            .map(|i| area(&[inner[(i + 9) % 10], outer[i], inner[i + 1]]))
            .sum();
        assert!(close(area(&star), area(&middle) + points, 1e-13));
    }

    #[test]
    fn tiny_outlines_keep_their_digits() {
        let size = 1e-8;
        let corners = ring(direction(1.0, 2.0, 3.0), size, 4);
        // The corners are rounded to 2⁻⁵³, some 10⁻⁸ of the size.
        assert!(close(area(&corners) / (2.0 * size * size), 1.0, 1e-7));
        let exact = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| direction(x * size, y * size, 1.0));
        assert!(close(area(&exact) / (4.0 * size * size), 1.0, 1e-14));
    }

    #[test]
    fn what_bounds_nothing_is_refused() {
        use SphericalPolygonError::{NoArc, TooFew, TurnsBack};
        let [x, y, z] = [Direction::X, Direction::Y, Direction::Z];
        assert_eq!(of_spherical_polygon(&[x, y]), Err(TooFew(2)));
        assert_eq!(of_spherical_polygon(&[x, y, y]), Err(NoArc(1)));
        assert_eq!(of_spherical_polygon(&[x, y, -y, z]), Err(NoArc(1)));
        assert_eq!(of_spherical_polygon(&[x, y, x, z]), Err(TurnsBack(1)));
    }

    proptest! {
        #[test]
        fn left_and_right_make_the_sphere(
            pole in any_direction(), half_angle in 0.01..3.0_f64, corners in 3..40_u32, turn in 0..40_usize,
        ) {
            let mut outline = ring(pole, half_angle, corners);
            let left = area(&outline);
            outline.rotate_left(turn % corners as usize);
            prop_assert!(close(area(&outline), left, 1e-13));
            outline.reverse();
            prop_assert!(close(left + area(&outline), 4.0 * PI, 1e-13));
        }

        #[test]
        fn rings_of_many_corners_tend_to_caps(pole in any_direction(), half_angle in 0.05..3.0_f64) {
            let cap = 4.0 * PI * libm::pow(libm::sin(half_angle / 2.0), 2.0);
            // The polygon differs by (2π/N)²/6 of 2π sin²α cosα: its sides are great circles, the ring is none.
            prop_assert!(close(area(&ring(pole, half_angle, 1000)), cap, 5e-5));
        }
    }
}
