//! Glare by daylight: the daylight glare probability and the daylight glare index.
//!
//! DGP = 5.87·10⁻⁵ E_v + 0.0918 log₁₀(1 + Σ L² ω / (E_v^1.87 p²)) + 0.16
//!
//! DGI = 10 log₁₀ Σ 0.478 L^1.6 (ω/p²)^0.8 / (L_b + 0.07 ω^½ L)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E_v | illuminance at the eye | lx |
//! | L, ω, p | luminance, solid angle and position index of a source | cd/m², sr, – |
//! | L_b | luminance of the background | cd/m² |
//!
//! DGP is the share of people who are disturbed. It was found for E_v ≥ 380 lx and between .2 and .8; what is above 1 is given as 1. In dimmer surroundings it
//! is multiplied, if wanted, with e^x/(1 + e^x), x = 0.024 E_v − 4, below 1000 lx.
//!
//! Sources: J. Wienold & J. Christoffersen, Energy and Buildings 38 (2006), equation 10; J. Wienold, *Dynamic daylight glare evaluation*
//! (Building Simulation 2009), and for low light EuroSun 2012; P. Chauvel, J. B. Collins, R. Dogniaux & J. Longmore, Lighting Research & Technology 14 (1982), with ω/p² for the
//! modified solid angle.
//!
//! ```
//! use steradian::glare::daylight_glare_probability;
//! use steradian::quantity::Illuminance;
//! // No source: 5.87e-5 · 2000 + .16.
//! let found = daylight_glare_probability(Illuminance::from_lux(2000.0), &[]);
//! assert!((found - 0.2774).abs() < 1e-12);
//! ```

use super::unified::GlareSource;
use crate::quantity::{Illuminance, Luminance};

/// Of E_v.
pub(super) const C1: f64 = 5.87e-5;
/// Of the logarithm.
pub(super) const C2: f64 = 0.0918;
const C3: f64 = 0.16;
/// Exponent of E_v.
pub(super) const EXPONENT: f64 = 1.87;
/// Where low light ends, in lx.
const BRIGHT: f64 = 1000.0;

/// DGP.
pub fn daylight_glare_probability(illuminance: Illuminance, sources: &[GlareSource]) -> f64 {
    let eye = illuminance.to_lux();
    let sum: f64 = sources.iter().map(GlareSource::weight).sum();
    let contrast = if sum > 0.0 {
        libm::log10(1.0 + sum / libm::pow(eye, EXPONENT))
    } else {
        0.0
    };
    (C1 * eye + C2 * contrast + C3).min(1.0)
}

/// What DGP is multiplied with in dim surroundings.
pub fn low_light_factor(illuminance: Illuminance) -> f64 {
    let eye = illuminance.to_lux();
    if eye >= BRIGHT {
        return 1.0;
    }
    1.0 / (1.0 + libm::exp(4.0 - 0.024 * eye))
}

/// DGI; `None` without sources that shine.
pub fn daylight_glare_index(background: Luminance, sources: &[GlareSource]) -> Option<f64> {
    let background = background.to_candelas_per_square_metre();
    let term = |source: &GlareSource| {
        let luminance = source.luminance.to_candelas_per_square_metre();
        let solid_angle = source.solid_angle.to_steradians();
        let modified = solid_angle / (source.position_index * source.position_index);
        let below = background + 0.07 * solid_angle.sqrt() * luminance;
        0.478 * libm::pow(luminance, 1.6) * libm::pow(modified, 0.8) / below
    };
    let sum: f64 = sources
        .iter()
        .filter(|source| source.luminance > Luminance::ZERO)
        .map(term)
        .sum();
    (sum > 0.0).then(|| 10.0 * libm::log10(sum))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::SolidAngle;

    fn source(luminance: f64) -> GlareSource {
        GlareSource {
            luminance: Luminance::from_candelas_per_square_metre(luminance),
            solid_angle: SolidAngle::from_steradians(0.01),
            position_index: 2.0,
        }
    }

    /// Σ L²ω/p² = 10⁸ · .01/4 = 250 000 and 1000^1.87 = 10^5.61.
    #[test]
    fn one_source_by_hand() {
        let found = daylight_glare_probability(Illuminance::from_lux(1000.0), &[source(10_000.0)]);
        let expected =
            0.0587 + 0.0918 * libm::log10(1.0 + 250_000.0 / 407_380.277_804_112_7) + 0.16;
        assert!((found - expected).abs() < 1e-12, "{found}");
        assert_eq!(
            daylight_glare_probability(Illuminance::from_lux(1e6), &[]),
            1.0
        );
    }

    /// L_b = 100: .478 · 10^6.4 · .0025^.8/(100 + .007 · 10⁴) = 58.53.
    #[test]
    fn the_index_by_hand() {
        let background = Luminance::from_candelas_per_square_metre(100.0);
        let found = daylight_glare_index(background, &[source(10_000.0)]).unwrap();
        let expected = 0.478 * 2_511_886.431_509_58 * 0.008_286_0 / 170.0;
        assert!(
            (found - 10.0 * libm::log10(expected)).abs() < 1e-3,
            "{found}"
        );
        assert_eq!(daylight_glare_index(background, &[source(0.0)]), None);
    }

    #[test]
    fn low_light_counts_less() {
        let at = |lux: f64| low_light_factor(Illuminance::from_lux(lux));
        assert!((at(4.0 / 0.024) - 0.5).abs() < 1e-12);
        assert!(at(10.0) < 0.03 && at(999.0) > 0.9999 && at(1000.0) == 1.0);
    }
}
