//! Sets of directions: caps, and rectangles of latitude and longitude.
//!
//! They are closed contours on the unit sphere around the element: meridians are great circles, parallels are arcs of circles, so
//! that F is the contour integral of lines and arcs, clipped at the horizon. Patches are cut into pieces that fit into an octant, for which
//! the horizon joins the ends of the visible contour the short way.

use std::f64::consts::FRAC_PI_2;

use super::contour::{self, Circle, Piece};
use super::of_sphere;
use crate::geometry::{Direction, Point, SphericalPatch};
use crate::quantity::{Angle, Length};

/// The configuration factor of the directions within `half_angle` of `axis`.
///
/// Half the directions have (1 + cosγ)/2, γ between axis and normal, and more than half what is left by the others.
///
/// ```
/// use steradian::geometry::{Direction, configuration_factor};
/// use steradian::quantity::Angle;
/// let cap = |axis, degrees| configuration_factor::of_cap(Direction::Z, axis, Angle::from_degrees(degrees));
/// assert!((cap(Direction::Z, 30.0) - 0.25).abs() < 1e-15); // sin² 30°
/// assert_eq!(cap(Direction::X, 90.0), 0.5);
/// assert!((cap(-Direction::Z, 150.0) - 0.75).abs() < 1e-15);
/// ```
pub fn of_cap(normal: Direction, axis: Direction, half_angle: Angle) -> f64 {
    if half_angle > Angle::QUARTER_TURN {
        return 1.0 - of_cap(normal, -axis, Angle::HALF_TURN - half_angle);
    }
    if half_angle == Angle::QUARTER_TURN {
        return 0.5 * (1.0 + normal.dot(axis));
    }
    // The ball of this radius, 1 m away, fills the cap.
    let radius = Length::from_metres(half_angle.sin());
    of_sphere(
        Point::ORIGIN,
        normal,
        Point::ORIGIN + axis.to_vector(),
        radius,
    )
}

/// The configuration factor of a rectangle of latitude and longitude.
///
/// ```
/// use steradian::geometry::{Direction, SphericalPatch, configuration_factor};
/// use steradian::quantity::Angle;
/// let octant = SphericalPatch::new([Angle::ZERO, Angle::QUARTER_TURN], [Angle::ZERO, Angle::QUARTER_TURN])?;
/// let up = configuration_factor::of_patch(Direction::Z, &octant);
/// assert!((up - 0.25).abs() < 1e-15); // a quarter of the hemisphere
/// # Ok::<(), steradian::geometry::PatchError>(())
/// ```
pub fn of_patch(normal: Direction, patch: &SphericalPatch) -> f64 {
    let ([top, bottom], [west, east]) = (patch.theta(), patch.phi());
    let middle = Angle::from_radians(FRAC_PI_2.clamp(top.to_radians(), bottom.to_radians()));
    let quarters = ((east - west) / Angle::QUARTER_TURN).ceil() as u32;
    let at = |index: u32| west + (east - west) * (f64::from(index) / f64::from(quarters));
    let mut sum = 0.0;
    for thetas in [[top, middle], [middle, bottom]] {
        if thetas[0] < thetas[1] {
            let pieces = (0..quarters).map(|index| [at(index), at(index + 1)]);
            sum += pieces
                .map(|phis| of_piece(normal, thetas, phis))
                .sum::<f64>();
        }
    }
    sum
}

/// A patch within an octant.
fn of_piece(normal: Direction, thetas: [Angle; 2], phis: [Angle; 2]) -> f64 {
    let [top, bottom] = thetas.map(Circle::of_latitude);
    let [west, east] = phis.map(Angle::to_radians);
    let contour = [
        Piece::Line([top.at(west), bottom.at(west)]),
        Piece::Arc(bottom, [west, east]),
        Piece::Line([bottom.at(east), top.at(east)]),
        Piece::Arc(top, [east, west]),
    ];
    // At a pole the parallel is a point.
    let has_length = |piece: &Piece| !matches!(piece, Piece::Arc(circle, _) if circle.is_point());
    let contour: Vec<Piece> = contour.into_iter().filter(has_length).collect();
    contour::factor(normal, &contour)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Spherical;
    use crate::geometry::testing::{any_direction, close};
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn patch(thetas: [f64; 2], phis: [f64; 2]) -> SphericalPatch {
        SphericalPatch::new(
            thetas.map(Angle::from_radians),
            phis.map(Angle::from_radians),
        )
        .unwrap()
    }

    /// The midpoint rule, whose error the horizon makes of order 1/N.
    fn by_quadrature(normal: Direction, thetas: [f64; 2], phis: [f64; 2]) -> f64 {
        const N: u32 = 200;
        let at =
            |[from, to]: [f64; 2], i: u32| from + (to - from) * (f64::from(i) + 0.5) / f64::from(N);
        let mut sum = 0.0;
        for i in 0..N {
            let theta = at(thetas, i);
            for j in 0..N {
                let place = [theta, at(phis, j)].map(Angle::from_radians);
                let direction = Spherical::new(place[0], place[1]).to_direction();
                sum += normal.dot(direction).max(0.0) * libm::sin(theta);
            }
        }
        let cells = f64::from(N * N);
        sum * (thetas[1] - thetas[0]) * (phis[1] - phis[0]) / (cells * PI)
    }

    #[test]
    fn above_the_horizon_it_is_the_closed_form_of_the_patch() {
        let strip = patch([0.2, 1.3], [-1.0, 4.0]);
        let expected = strip.projected_solid_angle().to_steradians() / PI;
        assert!(close(of_patch(Direction::Z, &strip), expected, 1e-14));
        assert_eq!(of_patch(-Direction::Z, &strip), 0.0);
        let nothing = patch([0.2, 0.2], [0.0, 1.0]);
        assert_eq!(of_patch(Direction::X, &nothing), 0.0);
    }

    proptest! {
        #[test]
        fn a_patch_is_its_quadrature(
            normal in any_direction(), a in 0.0..PI, b in 0.0..PI, west in -3.0..3.0_f64, turn in 0.1..6.2_f64,
        ) {
            let (thetas, phis) = ([a.min(b), a.max(b)], [west, west + turn]);
            let found = of_patch(normal, &patch(thetas, phis));
            prop_assert!(close(found, by_quadrature(normal, thetas, phis), 3e-4), "{found}");
        }

        #[test]
        fn the_sphere_in_patches_fills_the_hemisphere(normal in any_direction(), theta in 0.01..3.1_f64, phi in 0.1..6.2_f64) {
            let parts = [[0.0, theta], [theta, PI]].map(|thetas| {
                [[0.0, phi], [phi, 2.0 * PI]].map(|phis| of_patch(normal, &patch(thetas, phis)))
            });
            prop_assert!(close(parts.iter().flatten().sum::<f64>(), 1.0, 1e-13));
            let cap = of_cap(normal, Direction::Z, Angle::from_radians(theta));
            prop_assert!(close(parts[0].iter().sum::<f64>(), cap, 1e-12));
        }
    }
}
