//! Albedos against the reference cases, and white furnaces.

use super::interface_light::first_shares;
use super::*;
use crate::brdf::tests::cases::{assert_case, cases_of};
use crate::brdf::tests::tilted;
use crate::brdf::{Brdf, ComplexIndex, Lambertian, Mixture};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

const WIDTHS: [f64; 6] = [0.05, 0.1, 0.25, 0.37, 0.5, 1.0];
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
            assert_case(&case, name, model.first(wo, 4)[0], 2e-6);
        }
    }
}

#[test]
fn rough_glass_agrees_with_the_reference_cases() {
    for case in cases_of("rough_dielectric", 5) {
        let facets = Facets::isotropic(Slopes::Ggx, case.number("alpha")).unwrap();
        let facets = facets.with_shadowing(Shadowing::Separable);
        let eta = case.number("eta_t_over_eta_i");
        let wo = tilted(case.number("theta_i_deg").to_radians());
        let [reflected, transmitted] = first_shares(facets, wo, eta, 8);
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

/// Reflected and transmitted light of a white model whose first term is integrated with 9 times as many points as when its
/// tables were made.
fn furnace(facets: Facets, model: &Brdf, wo: Direction) -> f64 {
    match model {
        Brdf::RoughConductor(model) => model.first(wo, 3)[0] + model.later_share(wo),
        Brdf::RoughDielectric(model) => {
            let inside = wo.z() < 0.0;
            let eta = if inside {
                1.0 / model.eta()
            } else {
                model.eta()
            };
            let first = first_shares(facets, if inside { -wo } else { wo }, eta, 3);
            first[0] + first[1] + model.later_share(wo)
        }
        _ => f64::NAN,
    }
}

fn metal(facets: Facets) -> Brdf {
    Brdf::RoughConductor(RoughConductor::new(facets, ComplexIndex::PERFECT))
}

fn glass(facets: Facets) -> Brdf {
    Brdf::RoughDielectric(RoughDielectric::new(facets, 1.5).unwrap())
}

/// The largest deviation from 1 over all angles, on both sides.
fn worst(facets: Facets, model: &Brdf, phi: f64) -> f64 {
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
        .map(|wo| (furnace(facets, model, wo) - 1.0).abs())
        .fold(0.0, f64::max)
}

/// Widths between the tables and next to them: what is left is interpolation in width.
#[test]
fn white_furnaces_close_within_half_a_per_mille() {
    for slopes in [Slopes::Ggx, Slopes::Beckmann] {
        for alpha in WIDTHS {
            let facets = Facets::isotropic(slopes, alpha).unwrap();
            for model in [metal(facets), glass(facets)] {
                let error = worst(facets, &model, 0.3);
                assert!(error < 5e-4, "{slopes:?} {alpha}: {error}");
            }
        }
    }
}

#[test]
fn anisotropic_furnaces_close_within_half_a_per_mille() {
    for (slopes, widths) in [(Slopes::Ggx, [0.1, 0.5]), (Slopes::Beckmann, [1.0, 0.2])] {
        let facets = Facets::anisotropic(slopes, widths).unwrap();
        let model = metal(facets);
        for phi in [0.0, 0.2, 0.9, 1.5, 2.5] {
            let error = worst(facets, &model, phi);
            assert!(error < 5e-4, "{widths:?} {phi}: {error}");
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

/// Nori's rough plastic, as its tests state it: a Lambertian base beside highlights of one facet, scaled by 1 − max k_d.
///
/// Its five albedos come from its own sampling and so from noise: with Walter's rational fit of G₁, which Nori uses, quadrature gives .207090
/// .215898 .247780 .430829 .519011, with the exact G₁ .207090 .215898 .247779 .430510 .518962. Nori's differ from both, up and down, by
/// up to 1.7e-4 and 4.3e-4.
#[test]
fn noris_rough_plastic_is_a_mixture() {
    let facets = Facets::isotropic(Slopes::Beckmann, 0.1).unwrap();
    let facets = facets.with_shadowing(Shadowing::Separable);
    let highlights = RoughDielectric::single_scattering(facets, 1.5 / 1.000_277).unwrap();
    let highlights = highlights
        .with_tints(Spectrum::ONE, Spectrum::ZERO)
        .unwrap();
    let base = Lambertian {
        reflectance: Spectrum::from_lanes([0.5, 1.0, 0.75, 0.0]),
    };
    let parts = vec![
        (0.2, Brdf::Lambertian(base)),
        (0.8, Brdf::RoughDielectric(highlights)),
    ];
    let plastic = Mixture::new(parts).unwrap();
    for (degrees, exact, nori) in [
        (0.0_f64, 0.207_090, 0.207_067),
        (45.0, 0.215_898, 0.215_733),
        (60.0, 0.247_779, 0.247_884),
        (80.0, 0.430_510, 0.430_936),
        (85.0, 0.518_962, 0.519_016),
    ] {
        let albedo = plastic.albedo(tilted(degrees.to_radians())).to_lanes();
        let [r, g, b, _] = albedo.map(f64::from);
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        assert!((luminance - exact).abs() < 1e-4, "{degrees}: {luminance}");
        assert!((luminance - nori).abs() < 5e-4, "{degrees}: {luminance}");
    }
}

/// White bases of plastic: what the coat keeps in comes out in the end.
#[test]
fn white_plastic_is_white_within_two_per_mille() {
    for (slopes, alpha) in [
        (Slopes::Ggx, 0.05),
        (Slopes::Ggx, 0.5),
        (Slopes::Beckmann, 1.0),
    ] {
        let facets = Facets::isotropic(slopes, alpha).unwrap();
        let plastic = RoughPlastic::new(facets, 1.5, Spectrum::ONE).unwrap();
        for degrees in DEGREES {
            let albedo = plastic.albedo(tilted(degrees.to_radians())).mean();
            assert!((albedo - 1.0).abs() < 2e-3, "{alpha} {degrees}: {albedo}");
        }
    }
}

/// Schlick's lobe from its tables against quadrature.
#[test]
fn tabulated_albedos_are_those_of_quadrature() {
    for alpha in WIDTHS {
        let facets = Facets::isotropic(Slopes::Ggx, alpha).unwrap();
        let half = Spectrum::splat(0.5);
        let model = RoughConductor::schlick(facets, Spectrum::splat(0.04), half).unwrap();
        for degrees in DEGREES {
            let wo = tilted(degrees.to_radians());
            let [table, precise] = [model.tabulated_albedo(wo)[0], model.leaving(wo, |_| 1.0)[0]];
            assert!(
                (table - precise).abs() < 1e-3,
                "{alpha} {degrees}: {table} {precise}"
            );
        }
    }
}
