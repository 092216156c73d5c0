//! Radiance of a black body.
//!
//! Planck's law:
//!
//! ```text
//! L(λ, T) = 2 h c² / λ⁵ · 1 / (exp(h c / (λ k T)) − 1)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L | spectral radiance | W/(m² sr nm) |
//! | λ | wavelength in vacuum | nm |
//! | T | temperature | K |
//! | h, c, k | constants of Planck, light, Boltzmann | J s, m/s, J/K: exact since 2019 |
//!
//! Source: M. Planck 1901; constants: SI brochure, 9th ed., table 1. Tables of illuminants are for λ in air of index
//! 1.00028; the difference (a temperature 0.03 % higher) is left out, as CIE 15 does.

use super::{Beyond, Curve, CurveError};

/// Planck's constant, J s.
pub(super) const PLANCK: f64 = 6.626_070_15e-34;
/// Speed of light in vacuum, m/s.
pub(super) const LIGHT_SPEED: f64 = 299_792_458.0;
/// Boltzmann's constant, J/K.
const BOLTZMANN: f64 = 1.380_649e-23;

/// Spectral radiance of a black body at a wavelength in nm, in W/(m² sr nm).
///
/// ```
/// use steradian::spectrum::blackbody_radiance;
///
/// // The sun, at its peak: Wien's 2.8978 mm K / 5772 K = 502 nm.
/// let peak = blackbody_radiance(502.0, 5772.0);
/// assert!((peak / 26_238.0 - 1.0).abs() < 1e-3);
/// assert!(blackbody_radiance(500.0, 5772.0) < peak && blackbody_radiance(504.0, 5772.0) < peak);
/// ```
pub fn blackbody_radiance(wavelength: f64, kelvin: f64) -> f64 {
    let metres = wavelength * 1e-9;
    let exponent = PLANCK * LIGHT_SPEED / (metres * BOLTZMANN * kelvin);
    let numerator = 2.0 * PLANCK * LIGHT_SPEED * LIGHT_SPEED;
    numerator / (metres * metres * metres * metres * metres) / libm::expm1(exponent) * 1e-9
}

/// Spectral radiance of a black body between two wavelengths in nm, in W/(m² sr nm); 0 outside.
///
/// An error if the temperature is not positive, or if the radiance is no finite number.
pub fn blackbody(kelvin: f64, range: [f64; 2], step: f64) -> Result<Curve, CurveError> {
    if !(kelvin > 0.0 && kelvin.is_finite()) {
        return Err(CurveError::Temperature(kelvin));
    }
    Curve::from_function(range, step, Beyond::Zero, |wavelength| {
        blackbody_radiance(wavelength, kelvin)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reference takes c₁ = 2πhc² = 3.741771e-16 W m² and c₂ = hc/k = 1.4388e-2 m K, rounded. As c₂ enters as c₂/T
    /// only, another c₂ is another temperature; then 15 digits are left.
    #[test]
    fn radiance_at_560_nm_agrees_with_a_reference() {
        let c1 = 2.0 * std::f64::consts::PI * PLANCK * LIGHT_SPEED * LIGHT_SPEED;
        let c2 = PLANCK * LIGHT_SPEED / BOLTZMANN;
        for (kelvin, reference) in [
            (2000.0, 5.699743354171516),
            (2856.0, 267.96933295180656),
            (3500.0, 1403.436974569982),
            (5000.0, 12761.128485989884),
            (5777.0, 25621.453975057695),
            (6500.0, 42340.038702532605),
        ] {
            let radiance = blackbody_radiance(560.0, kelvin * c2 / 1.4388e-2) * 3.741771e-16 / c1;
            assert!(
                (radiance / reference - 1.0).abs() < 1e-12,
                "{kelvin} K: {radiance}"
            );
        }
    }

    /// ∫ π L dλ = σ T⁴. Beyond 100 µm lie 15/π⁴ x³/3 with x = hc/(λkT) = 0.024: 7e-7 of the whole; trapezia err by
    /// h²/12 ∫ f'' which is below 1e-6 for steps of 5 nm and a peak 600 nm wide.
    #[test]
    fn exitance_is_that_of_stefan_and_boltzmann() {
        let sigma = 5.670_374_419e-8;
        let curve = blackbody(6000.0, [50.0, 100_000.0], 5.0).unwrap();
        let exitance = std::f64::consts::PI * curve.integral([50.0, 100_000.0]);
        let law = sigma * 6000.0_f64.powi(4);
        assert!((exitance / law - 1.0).abs() < 3e-6, "{exitance} {law}");
    }

    #[test]
    fn cold_and_impossible_bodies() {
        assert_eq!(blackbody_radiance(500.0, 10.0), 0.0);
        for kelvin in [0.0, -300.0, f64::NAN, f64::INFINITY] {
            let refused = blackbody(kelvin, [400.0, 700.0], 10.0);
            assert!(matches!(refused, Err(CurveError::Temperature(_))));
        }
        assert!(blackbody(300.0, [0.0, 700.0], 10.0).is_err());
    }
}
