//! Albedos against the reference cases, and white furnaces.

use super::*;
use crate::brdf::tests::cases::{assert_case, cases_of};
use crate::brdf::tests::tilted;
use crate::brdf::{Brdf, ComplexIndex};
use crate::geometry::Direction;

const WIDTHS: [f64; 5] = [0.05, 0.1, 0.25, 0.5, 1.0];
const DEGREES: [f64; 8] = [0.0, 30.0, 45.0, 60.0, 75.0, 80.0, 85.0, 89.0];

/// The quadrature of 512² points is off by less than 2e-5.
#[test]
fn ggx_albedos_agree_with_the_reference_cases() {
    for case in cases_of("ggx_directional_albedo", 17) {
        let facets = Facets::isotropic(Slopes::Ggx, case.number("alpha")).unwrap();
        let wo = tilted(case.number("theta_i_deg").to_radians());
        for (shadowing, name) in [
            (Shadowing::HeightCorrelated, "rho_dh_height_correlated"),
            (Shadowing::Separable, "rho_dh_separable"),
        ] {
            let facets = facets.with_shadowing(shadowing);
            let model = RoughConductor::single_scattering(facets, ComplexIndex::PERFECT);
            assert_case(&case, name, model.first(wo, 32)[0], 2e-5);
        }
    }
}

#[test]
fn rough_glass_agrees_with_the_reference_cases() {
    for case in cases_of("rough_dielectric", 5) {
        let facets = Facets::isotropic(Slopes::Ggx, case.number("alpha")).unwrap();
        let facets = facets.with_shadowing(Shadowing::Separable);
        let eta = case.number("eta_t_over_eta_i");
        let model = RoughDielectric::single_scattering(facets, eta).unwrap();
        let wo = tilted(case.number("theta_i_deg").to_radians());
        let [reflected, transmitted] = model.first(wo, eta, 32);
        assert_case(&case, "reflectance", reflected, 2e-5);
        assert_case(&case, "transmittance", transmitted, 2e-5);
        assert_case(
            &case,
            "lost_to_masking",
            1.0 - reflected - transmitted,
            4e-5,
        );
    }
}

/// Reflected and transmitted light of a model whose first term is integrated with 256² points, 8 times as fine as when
/// its table was made.
fn furnace(model: &Brdf, wo: Direction) -> f64 {
    match model {
        Brdf::RoughConductor(model) => model.first(wo, 16)[0] + model.later_share(wo),
        Brdf::RoughDielectric(model) => {
            let eta = if wo.z() > 0.0 {
                model.eta()
            } else {
                1.0 / model.eta()
            };
            let upper = if wo.z() > 0.0 { wo } else { -wo };
            let first = model.first(upper, eta, 16);
            first[0] + first[1] + model.later_share(wo)
        }
        _ => f64::NAN,
    }
}

fn white_models(facets: Facets) -> [Brdf; 2] {
    [
        Brdf::RoughConductor(RoughConductor::new(facets, ComplexIndex::PERFECT)),
        Brdf::RoughDielectric(RoughDielectric::new(facets, 1.5).unwrap()),
    ]
}

/// The largest deviation from 1 over all angles, on both sides.
fn worst(model: &Brdf, phi: f64) -> f64 {
    let view = |degrees: &f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        Direction::from_polar(sin, cos, phi)
    };
    let above = DEGREES.iter().map(view);
    let inside = above
        .clone()
        .filter(|_| matches!(model, Brdf::RoughDielectric(_)));
    above
        .chain(inside.map(|wo| -wo))
        .map(|wo| (furnace(model, wo) - 1.0).abs())
        .fold(0.0, f64::max)
}

/// The tables of Gaussian slopes are less precise.
#[test]
fn white_furnaces_close_within_their_tolerance() {
    for (slopes, tolerance) in [(Slopes::Ggx, 2e-3), (Slopes::Beckmann, 5e-3)] {
        for alpha in WIDTHS {
            let facets = Facets::isotropic(slopes, alpha).unwrap();
            for model in white_models(facets) {
                let error = worst(&model, 0.3);
                assert!(error < tolerance, "{slopes:?} {alpha}: {error}");
            }
        }
    }
}

#[test]
fn anisotropic_furnaces_close_within_two_per_mille() {
    for widths in [[0.1, 0.5], [1.0, 0.2]] {
        let facets = Facets::anisotropic(Slopes::Ggx, widths).unwrap();
        let model = Brdf::RoughConductor(RoughConductor::new(facets, ComplexIndex::PERFECT));
        for phi in [0.0, 0.2, 0.9, 1.5, 2.5] {
            let error = worst(&model, phi);
            assert!(error < 2e-3, "{widths:?} {phi}: {error}");
        }
    }
}

/// GGX of width 1 seen from above has the albedo 1 − ln 2; Mitsuba's furnaces read .686 at α = .5 and .306 at α = 1.
#[test]
fn single_scattering_loses_light() {
    let albedo = |alpha| {
        let facets = Facets::isotropic(Slopes::Ggx, alpha).unwrap();
        let model = RoughConductor::single_scattering(facets, ComplexIndex::PERFECT);
        model.first(Direction::Z, 4)[0]
    };
    assert!((albedo(1.0) - (1.0 - std::f64::consts::LN_2)).abs() < 1e-9);
    assert!((albedo(0.5) - 0.686).abs() < 2e-3 && (albedo(1.0) - 0.306).abs() < 2e-3);
}
