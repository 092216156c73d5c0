use std::f64::consts::{FRAC_1_PI, TAU};

use super::chance::uniform_pairs;
use super::density::{Spot, shares};
use super::*;
use crate::brdf::tests::every_model;
use crate::brdf::{ComplexIndex, Facets, RoughConductor, Slopes};
use crate::geometry::Direction;

#[test]
fn every_model_keeps_its_contract() {
    for model in every_model() {
        for finding in check(&model, &Effort::QUICK) {
            assert!(finding.passed(), "{model:?}: {finding:?}");
        }
    }
}

/// Directions of density (1 + 10 % cosφ)/(2π) above.
fn bent([u, v]: [f64; 2]) -> Direction {
    let phi = TAU * v;
    Direction::from_polar((u * (2.0 - u)).sqrt(), 1.0 - u, phi - 0.1 * libm::sin(phi))
}

fn share_sum(shares: &[density::Share]) -> f64 {
    shares.iter().map(|share| share.expected).sum()
}

#[test]
fn shares_add_up_to_the_integral_of_the_density() {
    let none: [Spot; 0] = [];
    let cosine = |wi: Direction| wi.z().max(0.0) * FRAC_1_PI;
    assert!((share_sum(&shares(&cosine, &none, &none, 1)) - 1.0).abs() < 1e-6);
    // A lobe of 1/100 of a degree about a direction, and the pilot that finds it.
    let axis = views::polar(0.7, 2.0);
    let narrow = libm::pow(0.01_f64.to_radians(), -2.0);
    let lobe = |wi: Direction| {
        let away = wi.to_vector() - axis.to_vector();
        narrow * FRAC_1_PI * libm::exp(-narrow * away.dot(away))
    };
    let pilot = vec![Spot::of(axis); 20];
    let sum = share_sum(&shares(&lobe, &pilot, &none, 10));
    assert!((sum - 1.0).abs() < 1e-4, "{sum}");
}

/// A normal distribution in u = 1 − cosθ and φ, .002 by .05 wide, away from all nodes of a side's rule and of its quarters'.
#[test]
fn a_streak_between_the_nodes_of_a_cell_is_seen() {
    let (middle, widths) = ([0.37, 2.0], [0.002, 0.05]);
    let streak = |wi: Direction| {
        let away = [
            1.0 - wi.z() - middle[0],
            libm::atan2(wi.y(), wi.x()) - middle[1],
        ];
        let steps = [0, 1].map(|k| away[k] / widths[k]);
        let exponent = steps[0] * steps[0] + steps[1] * steps[1];
        FRAC_1_PI * libm::exp(-exponent) / (widths[0] * widths[1])
    };
    let drawn: Vec<Spot> = uniform_pairs(7, 60)
        .map(|[a, b]| {
            let (radius, (sin, cos)) = ((-libm::log(1.0 - a)).sqrt(), libm::sincos(TAU * b));
            let u = middle[0] + widths[0] * radius * cos;
            let phi = middle[1] + widths[1] * radius * sin;
            Spot::of(Direction::from_polar((u * (2.0 - u)).sqrt(), 1.0 - u, phi))
        })
        .collect();
    let none: [Spot; 0] = [];
    let sum = share_sum(&shares(&streak, &none, &drawn, 1));
    assert!((sum - 1.0).abs() < 2e-3, "{sum}");
}

#[test]
fn a_sharp_metal_is_resolved() {
    let facets = Facets::isotropic(Slopes::Ggx, 0.005).unwrap();
    let mirror_like = Brdf::RoughConductor(RoughConductor::single_scattering(
        facets,
        ComplexIndex::PERFECT,
    ));
    for finding in sampling(&mirror_like, &Effort::QUICK) {
        assert!(finding.passed(), "{finding:?}");
    }
}

#[test]
fn directions_that_are_bent_by_a_tenth_are_refused() {
    let draw = |seed, count| -> Vec<Spot> {
        uniform_pairs(seed, count)
            .map(|u| Spot::of(bent(u)))
            .collect()
    };
    let even = |wi: Direction| if wi.z() > 0.0 { 1.0 / TAU } else { 0.0 };
    let bins = shares(&even, &draw(1, 1 << 14), &draw(2, 1 << 16), 1 << 7);
    assert!(sampling::excess(&bins, 1 << 16) > 10.0);
}

#[test]
fn the_furnace_tells_what_single_scattering_loses() {
    let facets = Facets::isotropic(Slopes::Ggx, 1.0).unwrap();
    let single = RoughConductor::single_scattering(facets, ComplexIndex::PERFECT);
    let row = furnace(&Brdf::RoughConductor(single), 4, 1.0, &Effort::QUICK);
    // 1 − ln 2 of the light from above comes back.
    assert!(
        (row.shares[0][0] - (1.0 - std::f64::consts::LN_2)).abs() < 1e-3,
        "{row:?}"
    );
    let finding = furnace_finding(&[row]);
    assert!(!finding.passed() && finding.place.is_some());
    let whole = RoughConductor::new(facets, ComplexIndex::PERFECT);
    let row = furnace(&Brdf::RoughConductor(whole), 4, 1.0, &Effort::QUICK);
    assert!((furnace_finding(&[row]).worst) < 5e-3, "{row:?}");
}

#[test]
fn a_surface_that_gains_light_is_refused() {
    let gain = Brdf::Lambertian(crate::brdf::Lambertian {
        reflectance: crate::quantity::Spectrum::splat(1.1),
    });
    let failed: Vec<_> = check(&gain, &Effort::QUICK)
        .into_iter()
        .filter(|finding| !finding.passed())
        .collect();
    assert!(
        failed.len() == 1 && failed[0].check == Check::Energy,
        "{failed:?}"
    );
}

#[test]
fn what_is_no_number_fails() {
    let nan = Brdf::Lambertian(crate::brdf::Lambertian {
        reflectance: crate::quantity::Spectrum::splat(f32::NAN),
    });
    assert!(!values(&nan, &Effort::QUICK).passed());
    assert!(!energy(&nan).passed());
}
