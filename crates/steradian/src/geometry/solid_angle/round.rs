//! Caps and spheres.

use std::f64::consts::PI;

use super::super::point::Point;
use crate::quantity::{Angle, Length, SolidAngle};

/// The solid angle of a cone of directions: 2π (1 − cosα), to full relative precision for narrow cones.
///
/// ```
/// use steradian::geometry::solid_angle;
/// use steradian::quantity::{Angle, SolidAngle};
/// let cone = solid_angle::of_cap(Angle::from_degrees(60.0)); // 2π (1 − ½)
/// assert!((cone / SolidAngle::HEMISPHERE - 0.5).abs() < 1e-15);
/// ```
pub fn of_cap(half_angle: Angle) -> SolidAngle {
    let sin = (half_angle / 2.0).sin();
    SolidAngle::from_steradians(4.0 * PI * sin * sin)
}

/// The solid angle of a sphere: 2π (1 − √(1 − R²/d²)) from outside, 2π on its surface, 4π from inside.
///
/// A sphere of no or negative radius, or of NaN, fills nothing.
pub fn of_sphere(observer: Point, center: Point, radius: Length) -> SolidAngle {
    let (distance, radius) = (observer.distance(center).to_metres(), radius.to_metres());
    if radius.is_nan() || radius <= 0.0 {
        return SolidAngle::ZERO;
    }
    if distance < radius {
        return SolidAngle::SPHERE;
    }
    let sin = radius / distance;
    let cos = ((distance - radius) * (distance + radius)).sqrt() / distance;
    // 1 − cosα = sin²α / (1 + cosα) has no cancellation.
    SolidAngle::from_steradians(2.0 * PI * sin * sin / (1.0 + cos))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;

    #[test]
    fn spheres_from_outside_on_and_inside() {
        let sphere = |distance, radius| {
            of_sphere(
                Point::ORIGIN,
                Point::new(distance, 0.0, 0.0),
                Length::from_metres(radius),
            )
        };
        // sinα = ½, α = 30°.
        assert!(close(
            sphere(2.0, 1.0) / of_cap(Angle::from_degrees(30.0)),
            1.0,
            1e-15
        ));
        assert!(close(
            sphere(1e9, 1.0).to_steradians() / (PI * 1e-18),
            1.0,
            1e-15
        ));
        assert_eq!(sphere(1.0, 1.0), SolidAngle::HEMISPHERE);
        assert_eq!(sphere(0.5, 1.0), SolidAngle::SPHERE);
        assert_eq!(sphere(1.0, 0.0), SolidAngle::ZERO);
        assert_eq!(sphere(1.0, f64::NAN), SolidAngle::ZERO);
    }
}
