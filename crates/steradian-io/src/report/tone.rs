//! From radiance to a display: one exposure for the picture, then the sRGB curve; values beyond white are cut off.
//!
//! The exposure maps the log-average of the picture, exp(mean(ln Y)) over its pixels that are not black, to middle grey,
//! .18 of white (E. Reinhard et al., "Photographic tone reproduction", 2002, eq. 1–2), and a number of stops adjusts it:
//! each stop doubles. Curve: IEC 61966-2-1. A tone-mapped picture is for looking at; numbers are in EXR, HDR or PFM.
//!
//! ```
//! use steradian_io::report::tone::{exposure, srgb};
//!
//! assert!((exposure(&[4.0, 1.0, 0.0], 0.0) - 0.09).abs() < 1e-12); // 0.18 / √(4·1)
//! assert_eq!(srgb(0.18), 118);
//! ```

/// Linear value that a picture's log-average is mapped to.
pub const MIDDLE_GREY: f64 = 0.18;

/// The factor from radiance (or luminance) to display-linear values, white being 1.
pub fn exposure(luminance: &[f64], stops: f64) -> f64 {
    let lit = luminance
        .iter()
        .filter(|value| **value > 0.0 && value.is_finite());
    let (sum, count) = lit.fold((0.0, 0_u32), |(sum, count), value| {
        (sum + libm::log(*value), count + 1)
    });
    if count == 0 {
        return libm::exp2(stops);
    }
    libm::exp2(stops) * MIDDLE_GREY / libm::exp(sum / f64::from(count))
}

/// The 8-bit code of a display-linear value, rounded to nearest; outside 0 … 1 is cut off.
pub fn srgb(linear: f64) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let coded = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    };
    (coded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_doubles_the_exposure() {
        let luminance = [3.0, 0.5, 7.0];
        assert!((exposure(&luminance, 1.0) / exposure(&luminance, 0.0) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_black_picture_has_a_finite_exposure() {
        assert_eq!(exposure(&[0.0, 0.0], 0.0), 1.0);
    }

    #[test]
    fn the_curve_has_its_ends_and_is_monotonic() {
        assert_eq!(
            (srgb(-1.0), srgb(0.0), srgb(1.0), srgb(9.0)),
            (0, 0, 255, 255)
        );
        assert!(
            (0..1000)
                .all(|step| srgb(f64::from(step) / 1000.0) <= srgb(f64::from(step + 1) / 1000.0))
        );
    }
}
