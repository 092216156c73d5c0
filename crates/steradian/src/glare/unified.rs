//! The unified glare rating.
//!
//! UGR = 8 log₁₀( ¼/L_b · Σ L² ω / p² )
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L_b | luminance of the background: the vertical illuminance at the eye without that of the sources, over π | cd/m² |
//! | L | luminance of a source towards the eye | cd/m² |
//! | ω | its solid angle | sr |
//! | p | its position index | – |
//!
//! One unit is the least difference that is noticed; 13 is hardly perceived, 28 is uncomfortable. Source: CIE 117:1995, equation 1. It is meant for sources of
//! 3·10⁻⁴ to 10⁻¹ sr; for smaller and larger ones CIE 147:2002 has other formulas, which are not used here.
//!
//! ```
//! use steradian::glare::{GlareSource, unified_glare_rating};
//! use steradian::quantity::{Luminance, SolidAngle};
//! let luminance = Luminance::from_candelas_per_square_metre;
//! let source = GlareSource {
//!     luminance: luminance(2000.0),
//!     solid_angle: SolidAngle::from_steradians(0.01),
//!     position_index: 2.0,
//! };
//! // 8 log₁₀(¼/25 · 4·10⁶ · .01/4) = 8 log₁₀ 100.
//! let rating = unified_glare_rating(luminance(25.0), &[source]).unwrap();
//! assert!((rating - 16.0).abs() < 1e-12);
//! ```

use crate::quantity::{Luminance, SolidAngle};

/// Something bright, of one luminance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlareSource {
    /// L, towards the eye.
    pub luminance: Luminance,
    /// ω.
    pub solid_angle: SolidAngle,
    /// p, from [`Gaze::position_index`](super::Gaze::position_index).
    pub position_index: f64,
}

impl GlareSource {
    /// L² ω / p² in cd²/m⁴ sr.
    pub(super) fn weight(&self) -> f64 {
        let ratio = self.luminance.to_candelas_per_square_metre() / self.position_index;
        ratio * ratio * self.solid_angle.to_steradians()
    }
}

/// UGR; `None` without sources that shine, or without a background.
pub fn unified_glare_rating(background: Luminance, sources: &[GlareSource]) -> Option<f64> {
    let sum = sources.iter().map(GlareSource::weight).sum();
    rating(background.to_candelas_per_square_metre(), sum)
}

/// UGR of L_b in cd/m² and Σ L²ω/p².
pub(super) fn rating(background: f64, sum: f64) -> Option<f64> {
    (background > 0.0 && sum > 0.0).then(|| 8.0 * libm::log10(0.25 / background * sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(luminance: f64, solid_angle: f64, position_index: f64) -> GlareSource {
        GlareSource {
            luminance: Luminance::from_candelas_per_square_metre(luminance),
            solid_angle: SolidAngle::from_steradians(solid_angle),
            position_index,
        }
    }

    /// All luminances doubled: 8 log₁₀ 2 more. Sources twice as many: the same.
    #[test]
    fn it_grows_with_brightness_and_number() {
        let background = Luminance::from_candelas_per_square_metre(40.0);
        let one = source(3000.0, 0.002, 3.0);
        let rate = |background, sources: &[GlareSource]| {
            unified_glare_rating(background, sources).unwrap()
        };
        let base = rate(background, &[one]);
        let step = 8.0 * libm::log10(2.0);
        assert!((rate(background, &[one, one]) - base - step).abs() < 1e-12);
        let doubled = rate(2.0 * background, &[source(6000.0, 0.002, 3.0)]);
        assert!((doubled - base - step).abs() < 1e-12);
    }

    #[test]
    fn without_sources_or_background_there_is_no_rating() {
        let background = Luminance::from_candelas_per_square_metre(40.0);
        assert_eq!(unified_glare_rating(background, &[]), None);
        assert_eq!(
            unified_glare_rating(background, &[source(0.0, 0.1, 1.0)]),
            None
        );
        assert_eq!(
            unified_glare_rating(0.0 * background, &[source(1.0, 0.1, 1.0)]),
            None
        );
    }
}
