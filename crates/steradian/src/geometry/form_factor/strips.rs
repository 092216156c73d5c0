//! Endless strips: Hottel's crossed strings.
//!
//! Between two surfaces that are endless in one direction, the exchange area of a unit of length is half the difference
//! between two strings that cross and two that do not, spanned between their ends
//! (H. C. Hottel, in W. H. McAdams, *Heat Transmission*, 3rd ed., 1954, chap. 4):
//!
//! w₁ F₁₂ = ½ (crossed − uncrossed)

use super::dimensions::{DimensionError, positive};
use crate::quantity::{Angle, Length};

/// Between two strips of the same width that face each other: √(1 + (d/w)²) − d/w (Howell's catalogue, C-1).
///
/// # Errors
/// If a length is not positive.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Length;
/// let found = form_factor::between_parallel_strips(Length::from_metres(4.0), Length::from_metres(3.0))?;
/// assert!((found - 0.5).abs() < 1e-15); // (5 − 3)/4
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between_parallel_strips(width: Length, distance: Length) -> Result<f64, DimensionError> {
    let ratio = positive("distance", distance)? / positive("width", width)?;
    Ok(1.0 / ((1.0 + ratio * ratio).sqrt() + ratio))
}

/// From one side of a wedge to the other, by their widths: (1 + k − √(1 + k² − 2k cosα))/2, k = w₂/w₁ (C-5 and C-5a).
///
/// # Errors
/// If a width is not positive or the angle not between 0 and 180°.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::{Angle, Length};
/// let sides = [Length::from_metres(2.0); 2];
/// let found = form_factor::between_wedge_sides(sides, Angle::from_degrees(60.0))?;
/// assert!((found - 0.5).abs() < 1e-15); // 1 − sin 30°
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between_wedge_sides(widths: [Length; 2], angle: Angle) -> Result<f64, DimensionError> {
    let [from, to] = [
        positive("first width", widths[0])?,
        positive("second width", widths[1])?,
    ];
    let radians = angle.to_radians();
    if !(radians > 0.0 && radians < std::f64::consts::PI) {
        return Err(DimensionError::BadAngle {
            name: "angle of the wedge",
            limit: 180.0,
        });
    }
    let half_cos = libm::cos(0.5 * radians);
    let third = ((from - to) * (from - to)
        + 4.0 * from * to * libm::sin(0.5 * radians) * libm::sin(0.5 * radians))
    .sqrt();
    // (w₁ + w₂)² − third² = 4 w₁ w₂ cos²(α/2), so that nothing cancels.
    Ok(2.0 * to * half_cos * half_cos / (from + to + third))
}

/// From the strip with the first cross-section to the one with the second, each by its two ends in a plane perpendicular to
/// both; the strips see each other wholly, and ends of the same index are on the same side.
///
/// ```
/// use steradian::geometry::form_factor;
/// let found = form_factor::between_strips([[0.0, 0.0], [4.0, 0.0]], [[0.0, 3.0], [4.0, 3.0]]);
/// assert_eq!(found, 0.5); // (5 + 5 − 3 − 3)/(2·4)
/// ```
pub fn between_strips(from: [[f64; 2]; 2], to: [[f64; 2]; 2]) -> f64 {
    let string = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]);
    let crossed = string(from[0], to[1]) + string(from[1], to[0]);
    let uncrossed = string(from[0], to[0]) + string(from[1], to[1]);
    0.5 * (crossed - uncrossed) / string(from[0], from[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn wedges_and_parallel_strips_are_spanned_by_strings(w in 0.1..3.0_f64, h in 0.1..3.0_f64, degrees in 1.0..179.0_f64) {
            let angle = Angle::from_degrees(degrees);
            let (sin, cos) = libm::sincos(angle.to_radians());
            let wedge = between_wedge_sides([w, h].map(Length::from_metres), angle).unwrap();
            prop_assert!(close(wedge, between_strips([[0.0, 0.0], [w, 0.0]], [[0.0, 0.0], [h * cos, h * sin]]), 1e-14 / w));
            let facing = between_parallel_strips(Length::from_metres(w), Length::from_metres(h)).unwrap();
            prop_assert!(close(facing, between_strips([[0.0, 0.0], [w, 0.0]], [[0.0, h], [w, h]]), 1e-14 / w));
        }

        #[test]
        fn the_sides_of_an_endless_prism_close_it(a in 0.5..1.0_f64, b in 0.5..1.0_f64, c in 0.5..1.0_f64) {
            let opposite = |a: f64, b: f64, c: f64| Angle::from_radians(libm::acos((a * a + b * b - c * c) / (2.0 * a * b)));
            let [to_b, to_c] = [(b, opposite(a, b, c)), (c, opposite(a, c, b))]
                .map(|(other, angle)| between_wedge_sides([a, other].map(Length::from_metres), angle).unwrap());
            prop_assert!(close(to_b + to_c, 1.0, 1e-14));
        }
    }

    #[test]
    fn widths_and_angles_must_be_positive() {
        let one = Length::from_metres(1.0);
        assert!(between_parallel_strips(one, -one).is_err());
        assert!(between_parallel_strips(Length::from_metres(f64::NAN), one).is_err());
        let error = between_wedge_sides([one; 2], Angle::from_degrees(200.0)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the angle of the wedge must lie between 0 and 180 degrees"
        );
    }
}
