//! Spheres.

use super::dimensions::{DimensionError, positive};
use crate::geometry::configuration_factor;
use crate::geometry::{Direction, Point, gauss};
use crate::quantity::{Angle, Length, SolidAngle};

/// From the inside of a sphere's cap, by its half angle at the centre, to itself: its share of the sphere, sin²(α/2).
///
/// Inside a sphere cosθ₁ cosθ₂/r² is the same for all pairs of points, 1/4R², so that every part sends to every other part its
/// share of the area (Howell's catalogue, C-120; known to F. E. Sumpner, Phil. Mag. 35, 1893).
///
/// # Errors
/// If the half angle is not between 0 and 180°.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Angle;
/// let bowl = form_factor::of_cap_to_itself(Angle::from_degrees(90.0))?;
/// assert!((bowl - 0.5).abs() < 1e-15);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn of_cap_to_itself(half_angle: Angle) -> Result<f64, DimensionError> {
    let half = (half_angle / 2.0).sin();
    if half_angle.to_radians() > 0.0 && half_angle.to_radians() <= std::f64::consts::PI {
        Ok(half * half)
    } else {
        Err(DimensionError::BadAngle {
            name: "half angle of the cap",
            limit: 180.0,
        })
    }
}

/// From the inside of a sphere to a smaller one inside, wherever it is: (r₁/r₂)². All that leaves the inner one arrives, so that
/// this is reciprocity (C-138 for concentric ones), and the outer one sees itself with what is left.
///
/// # Errors
/// If a radius is not positive or the inner one not smaller.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Length;
/// assert_eq!(form_factor::from_outer_to_inner_sphere(Length::from_metres(1.0), Length::from_metres(2.0))?, 0.25);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn from_outer_to_inner_sphere(inner: Length, outer: Length) -> Result<f64, DimensionError> {
    let ratio = positive("inner radius", inner)? / positive("outer radius", outer)?;
    if ratio < 1.0 {
        Ok(ratio * ratio)
    } else {
        Err(DimensionError::Intersecting(
            "the outer radius must be larger than the inner one",
        ))
    }
}

/// From a sphere to anything flat that lies wholly on one side of it, by the solid angle that this fills from the centre: ω/4π.
///
/// An element of the flat surface sees the sphere with R² cosθ/d², whose integral is R² ω; reciprocity gives the rest. The
/// radius does not matter as long as the surface's plane does not cut the sphere.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::SolidAngle;
/// assert_eq!(form_factor::from_sphere_to_plane_surface(SolidAngle::HEMISPHERE), 0.5);
/// ```
pub fn from_sphere_to_plane_surface(solid_angle_from_center: SolidAngle) -> f64 {
    solid_angle_from_center / SolidAngle::SPHERE
}

/// From a sphere to a disc whose axis passes through its centre, at the distance h: ½ (1 − 1/√(1 + (r/h)²))
/// (Howell's catalogue, C-126; B. T. F. Chung & P. S. Sumitra, J. Heat Transfer 94, 1972).
///
/// # Errors
/// If a length is not positive or the disc would cut the sphere.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Length;
/// let [one, three, four] = [1.0, 3.0, 4.0].map(Length::from_metres);
/// assert!((form_factor::from_sphere_to_coaxial_disc(one, three, four)? - 0.1).abs() < 1e-15); // ½ (1 − 4/5)
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn from_sphere_to_coaxial_disc(
    sphere: Length,
    disc: Length,
    distance: Length,
) -> Result<f64, DimensionError> {
    let (sphere, disc) = (
        positive("radius of the sphere", sphere)?,
        positive("radius of the disc", disc)?,
    );
    let h = positive("distance", distance)?;
    if h < sphere {
        return Err(DimensionError::Intersecting(
            "the disc must be farther from the centre than the sphere's radius",
        ));
    }
    let slant = libm::hypot(h, disc);
    Ok(0.5 * disc * disc / (slant * (slant + h)))
}

/// From one sphere to another outside it, by the radii and the distance of the centres.
///
/// There is no elementary closed form (J. D. Felske, J. Heat Transfer 100, 1978, reviews the approximations). It is the mean of
/// [`configuration_factor::of_sphere`] over the first sphere, an integral over the angle α from the line of centres,
///
/// F₁₂ = ½ ∫ F(α) sinα dα
///
/// in two parts, where the second sphere is seen wholly and where the horizon cuts it. A substitution takes away the roots at
/// the ends of the second, and Gauss rules leave an error below 10⁻¹¹.
///
/// # Errors
/// If a length is not positive or the spheres overlap.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Length;
/// // Far away a sphere is a disc in the sky: r²/4d².
/// let [one, far] = [1.0, 1e6].map(Length::from_metres);
/// assert!((form_factor::between_spheres([one, one], far)? * 4e12 - 1.0).abs() < 1e-11);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between_spheres(radii: [Length; 2], distance: Length) -> Result<f64, DimensionError> {
    let [from, to] = [
        positive("first radius", radii[0])?,
        positive("second radius", radii[1])?,
    ];
    let between_centers = positive("distance", distance)?;
    if between_centers < from + to {
        return Err(DimensionError::Intersecting(
            "the distance of the centres must not be less than both radii together",
        ));
    }
    let seen = |alpha: f64| {
        let (sin, cos) = libm::sincos(alpha);
        let normal = Direction::from_polar(sin, cos, 0.0);
        let position = Point::ORIGIN + normal * from;
        sin * configuration_factor::of_sphere(
            position,
            normal,
            Point::new(0.0, 0.0, between_centers),
            radii[1],
        )
    };
    // The horizon at α touches the second sphere on either side where d cosα = r₁ ± r₂.
    let [wholly, at_all] =
        [from + to, from - to].map(|height| libm::acos(height / between_centers));
    Ok(0.5 * (smooth(seen, [0.0, wholly]) + smooth(seen, [wholly, at_all])))
}

/// ∫ f, on panels of x = a + (b − a) sin²(t/2), which takes away roots at both ends.
fn smooth(f: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> f64 {
    const PANELS: usize = 8;
    let transformed = |t: f64| {
        let half = libm::sin(0.5 * t);
        0.5 * libm::sin(t) * f(from + (to - from) * half * half)
    };
    let panel = |k: usize| {
        let ends = [k, k + 1].map(|k| std::f64::consts::PI * k as f64 / PANELS as f64);
        gauss::integrate(gauss::MAX_ORDER, ends, transformed)
    };
    (to - from) * (0..PANELS).map(panel).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_coaxial_disc_is_seen_in_its_solid_angle(r in 0.1..5.0_f64, h in 1.0..5.0_f64) {
            let [one, disc, distance] = [1.0, r, h].map(Length::from_metres);
            let cap = crate::geometry::solid_angle::of_cap(Angle::from_radians(libm::atan2(r, h)));
            let found = from_sphere_to_coaxial_disc(one, disc, distance).unwrap();
            prop_assert!(close(found, from_sphere_to_plane_surface(cap), 1e-15));
        }

        #[test]
        fn reciprocity_of_spheres(a in 0.05..3.0_f64, b in 0.05..3.0_f64, gap in 0.0..3.0_f64) {
            let [x, y, d] = [a, b, a + b + gap].map(Length::from_metres);
            let (forth, back) = (between_spheres([x, y], d).unwrap(), between_spheres([y, x], d).unwrap());
            prop_assert!(close(a * a * forth, b * b * back, 1e-11 * a * b), "{} {}", a * a * forth, b * b * back);
        }
    }

    #[test]
    fn a_small_sphere_sees_a_large_one_in_its_solid_angle() {
        // The mean over all directions of a small sphere's elements: a quarter of the share of the sky seen, times 2.
        let [tiny, one, two] = [1e-7, 1.0, 2.0].map(Length::from_metres);
        let share =
            crate::geometry::solid_angle::of_sphere(Point::ORIGIN, Point::new(2.0, 0.0, 0.0), one)
                / SolidAngle::SPHERE;
        assert!(close(
            between_spheres([tiny, one], two).unwrap(),
            share,
            1e-7
        ));
    }

    #[test]
    fn spheres_that_nearly_touch_are_reciprocal() {
        for gap in [0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2] {
            let [x, y, d] = [1.0, 0.3, 1.3 + gap].map(Length::from_metres);
            let (forth, back) = (
                between_spheres([x, y], d).unwrap(),
                between_spheres([y, x], d).unwrap(),
            );
            assert!(
                close(forth, 0.09 * back, 1e-11),
                "{gap}: {}",
                forth - 0.09 * back
            );
        }
    }

    #[test]
    fn spheres_that_overlap_are_refused() {
        let [one, two] = [1.0, 2.0].map(Length::from_metres);
        assert!(between_spheres([two, two], one).is_err());
        assert!(from_outer_to_inner_sphere(one, one).is_err());
        assert!(from_sphere_to_coaxial_disc(two, one, one).is_err());
        assert!(of_cap_to_itself(Angle::from_degrees(181.0)).is_err());
    }
}
