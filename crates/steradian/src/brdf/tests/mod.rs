//! The contract of [`Brdf`], model by model.

pub(crate) mod cases;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;

use super::*;
use crate::geometry::Vector;
use crate::geometry::testing::any_direction;
use crate::sampling::testing::{
    assert_mean, assert_proportional, grid_cell, histogram, independent,
};

/// Every model that has values in 1/sr.
fn finite_models() -> Vec<Brdf> {
    let reflectances = [[0.0, 0.25, 0.5, 1.0], [0.9; 4]];
    let lambertian = |lanes| Lambertian {
        reflectance: Spectrum::from_lanes(lanes),
    };
    let models = reflectances.map(|lanes| Brdf::Lambertian(lambertian(lanes)));
    models.to_vec()
}

fn mirror() -> Mirror {
    Mirror {
        reflectance: Spectrum::from_lanes([0.1, 0.2, 0.3, 0.4]),
    }
}

fn upwards() -> impl Strategy<Value = Direction> {
    any_direction()
        .prop_filter("on the horizon", |d| d.z().abs() > 1e-3)
        .prop_map(|d| if d.z() < 0.0 { -d } else { d })
}

fn tilted(theta: f64) -> Direction {
    Direction::new(Vector::new(libm::sin(theta), 0.0, libm::cos(theta))).unwrap()
}

/// ∫ f cosθ dω by the midpoint rule in cos²θ and φ.
fn projected_integral(f: impl Fn(Direction) -> f64) -> f64 {
    let cells = 64;
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(cells);
    let row = |i: u32| (0..cells).map(move |j| (at(i), TAU * at(j)));
    let value = |(square, phi): (f64, f64)| {
        let direction = Vector::new(
            (1.0 - square).sqrt() * libm::cos(phi),
            (1.0 - square).sqrt() * libm::sin(phi),
            square.sqrt(),
        );
        f(Direction::new(direction).unwrap())
    };
    let sum: f64 = (0..cells).flat_map(row).map(value).sum();
    PI * sum / f64::from(cells * cells)
}

proptest! {
    #[test]
    fn values_are_reciprocal_and_not_negative(wo in upwards(), wi in upwards()) {
        for model in finite_models() {
            let value = model.evaluate(wo, wi);
            prop_assert_eq!(value, model.evaluate(wi, wo));
            prop_assert!(value.to_lanes().iter().all(|lane| *lane >= 0.0 && lane.is_finite()));
        }
    }

    #[test]
    fn nothing_is_reflected_below_the_surface(wo in upwards(), wi in upwards(), u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
        for model in finite_models().into_iter().chain([Brdf::Mirror(mirror())]) {
            for (wo, wi) in [(-wo, wi), (wo, -wi), (-wo, -wi)] {
                prop_assert!(model.evaluate(wo, wi).is_zero());
                prop_assert_eq!(model.pdf(wo, wi), 0.0);
            }
            prop_assert_eq!(model.sample(-wo, [u, v]), None);
            prop_assert!(model.albedo(-wo).is_zero());
        }
    }

    #[test]
    fn a_sample_tells_its_own_value_and_density(wo in upwards(), u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
        for model in finite_models() {
            let Some(Scatter::Finite { wi, value, pdf }) = model.sample(wo, [u, v]) else {
                return Err(TestCaseError::fail("no sample"));
            };
            prop_assert!(wi.z() > 0.0);
            prop_assert_eq!(value, model.evaluate(wo, wi));
            prop_assert_eq!(pdf, model.pdf(wo, wi));
        }
    }

    #[test]
    fn a_mirror_keeps_the_angle_and_turns_the_azimuth(wo in upwards(), u in 0.0..1.0_f64) {
        let scatter = Brdf::Mirror(mirror()).sample(wo, [u, u]);
        let Some(Scatter::Specular { wi, reflectance }) = scatter else {
            return Err(TestCaseError::fail("not specular"));
        };
        let expected = Vector::new(-wo.x(), -wo.y(), wo.z());
        prop_assert!((wi.to_vector() - expected).length() < 1e-15);
        prop_assert_eq!(reflectance, mirror().reflectance);
        prop_assert!(Brdf::Mirror(mirror()).evaluate(wo, wi).is_zero());
    }
}

/// Single precision: relative 2⁻²³ a value, exact quadrature for a constant ρ.
#[test]
fn the_albedo_is_the_integral_of_the_value() {
    for model in finite_models() {
        for theta in [0.0, 0.7, 1.5] {
            let wo = tilted(theta);
            for lane in 0..4 {
                let value = |wi| f64::from(model.evaluate(wo, wi).to_lanes()[lane]);
                let albedo = f64::from(model.albedo(wo).to_lanes()[lane]);
                assert!((projected_integral(value) - albedo).abs() < 1e-6);
                assert!((0.0..=1.0).contains(&albedo));
            }
        }
    }
    assert_eq!(
        Brdf::Mirror(mirror()).albedo(tilted(1.0)),
        mirror().reflectance
    );
}

#[test]
fn the_mean_weight_of_samples_is_the_albedo() {
    for model in finite_models() {
        for theta in [0.0, 1.2] {
            let wo = tilted(theta);
            for lane in 0..4 {
                let weights = independent(1, 4096).map(|u| match model.sample(wo, u) {
                    Some(Scatter::Finite { wi, value, pdf }) => {
                        f64::from(value.to_lanes()[lane]) * wi.z() / pdf
                    }
                    _ => 0.0,
                });
                let albedo = f64::from(model.albedo(wo).to_lanes()[lane]);
                assert_mean(&weights.collect::<Vec<_>>(), albedo, 1e-6);
            }
        }
    }
}

/// ∫ pdf dω over cells of equal solid angle, by the midpoint rule with 16 × 16 points a cell.
fn expected_shares(model: &Brdf, wo: Direction, cells: usize) -> Vec<f64> {
    let fine = 16 * cells;
    let mut shares = vec![0.0; cells * cells];
    for i in 0..fine * fine {
        let at = |k: usize| (k as f64 + 0.5) / fine as f64;
        let (cos, phi) = (at(i / fine), TAU * at(i % fine));
        let sin = (1.0 - cos * cos).sqrt();
        let wi = Vector::new(sin * libm::cos(phi), sin * libm::sin(phi), cos);
        let density = model.pdf(wo, Direction::new(wi).unwrap());
        shares[grid_cell([cos, phi / TAU], cells)] += density * TAU / (fine * fine) as f64;
    }
    shares
}

#[test]
fn samples_have_their_density() {
    for model in finite_models() {
        let wo = tilted(0.5 * FRAC_PI_2);
        let shares = expected_shares(&model, wo, 8);
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-4);
        let cell = |u| match model.sample(wo, u) {
            Some(Scatter::Finite { wi, .. }) => {
                let turn = libm::atan2(wi.y(), wi.x()) / TAU;
                Some(grid_cell([wi.z(), turn - turn.floor()], 8))
            }
            _ => None,
        };
        let counts = histogram(64, independent(2, 65_536).filter_map(cell));
        assert_proportional(&counts, &shares);
    }
}
