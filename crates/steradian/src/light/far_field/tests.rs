use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use super::*;
use crate::geometry::gauss;

/// A lamp of uneven angles and intensities.
fn uneven(planes: Planes) -> FarField {
    let azimuths = [-90.0, -20.0, 45.0, 90.0, 180.0];
    let polars = [10.0, 35.0, 90.0, 95.0, 170.0];
    let value = |k: usize| ((7 * k * k + 3 * k) % 23) as f64;
    let values: Vec<f64> = (0..25).map(value).collect();
    FarField::new(planes, &azimuths, &polars, &values).unwrap()
}

fn downlight(values: [f64; 4]) -> FarField {
    FarField::new(Planes::C, &[0.0, 360.0], &[0.0, 90.0], &values).unwrap()
}

/// Gauss's rule over each cell: analytic integrands over at most 75°, so 16 nodes leave less than rounding.
#[test]
fn flux_is_the_integral_of_the_intensity() {
    let lamp = uneven(Planes::C);
    let [azimuths, polars] = lamp.nodes();
    let cells = |nodes: &[f64]| -> Vec<[f64; 2]> {
        nodes.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    };
    let mut sum = 0.0;
    for band in cells(azimuths) {
        for row in cells(polars) {
            sum += gauss::integrate(16, band, |psi| {
                gauss::integrate(16, row, |theta| {
                    lamp.at_angles(psi, theta) * libm::sin(theta)
                })
            });
        }
    }
    assert!(
        (lamp.flux() / sum - 1.0).abs() < 1e-13,
        "{} {sum}",
        lamp.flux()
    );
}

#[test]
fn closed_forms() {
    assert!((downlight([2.0; 4]).flux() - 4.0 * PI).abs() < 1e-14);
    // I = 1 − 2θ/π: ∫ = 1 − 2/π, over 2π.
    let fading = downlight([1.0, 0.0, 1.0, 0.0]);
    assert!((fading.flux() - TAU * (1.0 - 2.0 / PI)).abs() < 1e-15);
    assert_eq!(fading.intensity(-Direction::Z), 1.0);
    assert!((fading.at_angles(1.0, FRAC_PI_4) - 0.5).abs() < 1e-15);
    assert_eq!(fading.intensity(Direction::Z), 0.0);
}

#[test]
fn flux_within_a_cone_grows_to_the_flux() {
    let half = downlight([3.0; 4]);
    let cone = TAU * 3.0 * (1.0 - libm::cos(1.0));
    assert!((half.flux_within(1.0) - cone).abs() < 1e-14);
    assert_eq!(half.flux_within(2.0), half.flux());
    let lamp = uneven(Planes::C);
    assert_eq!(lamp.flux_within(0.1), 0.0);
    assert_eq!(lamp.flux_within(PI), lamp.flux());
}

#[test]
fn each_system_has_its_axes() {
    let lamp = |planes| uneven(planes);
    let towards = |planes: Planes, azimuth: f64, polar: f64| {
        lamp(planes).direction(azimuth, polar).to_array()
    };
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-15);
    assert!(near(towards(Planes::C, 0.0, 0.0), [0.0, 0.0, -1.0]));
    assert!(near(
        towards(Planes::C, FRAC_PI_2, FRAC_PI_2),
        [0.0, 1.0, 0.0]
    ));
    assert!(near(towards(Planes::B, 0.0, FRAC_PI_2), [0.0, 0.0, -1.0]));
    assert!(near(towards(Planes::B, 0.0, 0.0), [1.0, 0.0, 0.0]));
    assert!(near(towards(Planes::A, 0.0, FRAC_PI_2), [0.0, 0.0, -1.0]));
    assert!(near(
        towards(Planes::A, FRAC_PI_2, FRAC_PI_2),
        [1.0, 0.0, 0.0]
    ));
}

#[test]
fn directions_and_angles_agree() {
    for planes in [Planes::A, Planes::B, Planes::C] {
        let lamp = uneven(planes);
        for (azimuth, polar) in [(-1.0, 0.3), (0.2, 1.0), (2.0, 2.5), (3.0, 1.6)] {
            let (there, back) = (
                lamp.at_angles(azimuth, polar),
                lamp.intensity(lamp.direction(azimuth, polar)),
            );
            assert!((there - back).abs() < 1e-12, "{planes:?} {azimuth} {polar}");
        }
        // 180° to 270° is not in the table.
        assert_eq!(lamp.at_angles(4.0, 1.0), 0.0);
    }
}

/// The share of samples in a cell is the share of the flux there. 20 000 stratified pairs, of which a cell's border cuts at most
/// 2 · (100 + 200) strata: each share is off by less than 600/20 000.
#[test]
fn samples_have_the_shares_of_the_flux() {
    let lamp = uneven(Planes::B);
    let mut count = 0_u32;
    for i in 0..100 {
        for j in 0..200 {
            let u = [(f64::from(i) + 0.5) / 100.0, (f64::from(j) + 0.5) / 200.0];
            let sample = lamp.sample(u).unwrap();
            assert!((sample.pdf * lamp.flux() - sample.intensity).abs() < 1e-12);
            assert!((sample.intensity - lamp.intensity(sample.direction)).abs() < 1e-9);
            count += u32::from(sample.direction.to_array()[0] > 0.0);
        }
    }
    let share = f64::from(count) / 20_000.0;
    let expected = lamp.flux_within(FRAC_PI_2) / lamp.flux();
    assert!((share - expected).abs() < 0.03, "{share} {expected}");
}

/// The inverse of the share of the flux is found to rounding.
#[test]
fn samples_invert_the_flux() {
    let fading = downlight([1.0, 0.0, 1.0, 0.0]);
    for v in [0.0, 1e-6, 0.1, 0.5, 0.9, 1.0 - 1e-9] {
        let polar = fading.sample_polar(0, 0.3, v);
        let share = fading.flux_within(polar) / fading.flux();
        assert!((share - v).abs() < 4e-16 + 1e-14 * v, "{v} {share}");
    }
}

#[test]
fn a_lamp_without_light_has_no_samples() {
    assert_eq!(downlight([0.0; 4]).sample([0.5, 0.5]), None);
}

#[test]
fn bad_tables_are_refused() {
    let make = |azimuths: &[f64], polars: &[f64], values: &[f64]| {
        FarField::new(Planes::C, azimuths, polars, values)
            .unwrap_err()
            .to_string()
    };
    let turn = [0.0, 360.0];
    assert!(make(&[0.0], &turn, &[]).contains("at least two azimuths, found 1"));
    assert!(make(&turn, &[0.0, 90.0, 45.0], &[]).contains("number 2, 45, follows 90"));
    assert!(make(&turn, &[0.0, 181.0], &[]).contains("0 to 181"));
    assert!(make(&[0.0, 361.0], &[0.0, 90.0], &[]).contains("360°"));
    assert!(make(&turn, &[0.0, f64::NAN], &[]).contains("increase"));
    assert!(make(&turn, &[0.0, 90.0], &[1.0; 3]).contains("4 nodes"));
    assert!(make(&turn, &[0.0, 90.0], &[1.0, 1.0, -1.0, 1.0]).contains("number 2 is -1"));
}
