//! Spheres.

use std::f64::consts::PI;

use crate::geometry::{Direction, Point};
use crate::quantity::Length;

/// The configuration factor of a sphere from the element at `position`.
///
/// With d the distance of the centre, h = d/R and θ its angle from the normal: cosθ/h² if the sphere is wholly above the
/// horizon, h cosθ ≥ 1; 0 if wholly below, h cosθ ≤ −1; otherwise, with s = √(h² − 1) and q = √(1 − h² cos²θ),
///
/// F = (cosθ arccos(−s cotθ) − s q)/(π h²) + (1/π) arctan(q/s)
///
/// which is the contour integral, along the visible arc of the sphere's edge and the horizon's arc below. From inside
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::configuration_factor::of_polygon;
    use crate::geometry::testing::{any_direction, close};
    use crate::geometry::{Frame, Vector};
    use proptest::prelude::*;
    use std::f64::consts::TAU;

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
    }
}
