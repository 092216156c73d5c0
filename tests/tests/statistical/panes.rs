//! Panes of glass: lamps are seen through them, and nothing is counted twice.

use std::f64::consts::PI;

use steradian::brdf::Pane;
use steradian::material::Recipe;
use steradian::scene::description::{LaneValues, Opacity, SceneDescription, SpectrumMode};
use steradian::scene::energy_balance;
use steradian::spectrum::{Beyond, Curve, VISIBLE};
use steradian_tests::measuring::{measured, reading, rel_error, samples};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_close};

const TRANSMITTANCE: f64 = 0.8;

/// T(θ) of the pane.
fn through(cos_theta: f64) -> f64 {
    let pane = Pane::new(1.5, [TRANSMITTANCE; 4]).expect("glass");
    pane.shares(cos_theta)[0].1
}

/// A pane at z = 1 over a floor of this reflectance at z = 0.
fn behind_pane(reflectance: f64) -> SceneDescription {
    scene(
        [
            modelled("glass", pane(TRANSMITTANCE)),
            lambertian("floor", reflectance),
        ],
        [
            square(8.0, 1.0).made_of("glass"),
            square(4.0, 0.0).made_of("floor"),
        ],
        [],
    )
}

/// Of a pane that is there in part α the sky comes through as 1 − α + α T; what the pane reflects is black.
#[test]
fn a_pane_may_be_there_in_part() {
    let mut half = modelled("glass", pane(TRANSMITTANCE));
    half.opacity = Some(Opacity {
        factor: 0.5,
        textures: vec![],
        cutoff: None,
    });
    let shapes = [square(400.0, 1.0).made_of("glass"), square(400.0, -1.0)];
    let mut scene = scene([half], shapes, [environment(3.0)]);
    let along = radiance_along(p(0.0, 0.0, 0.0), v(1.0, 0.0, 1.0));
    scene.sensors = vec![sensor("ray", along)];
    let seen = reading(&measured(&scene, &samples(1 << 14)), "ray").estimate;
    let through = 0.5 + 0.5 * through(0.5_f64.sqrt());
    assert_agrees("ray", &seen, 3.0 * through, 0.0);
    assert!(seen.std_error < 0.01 * seen.value, "{seen:?}");
}

/// E = I cosθ/r² T(θ). The cosine at the pane is that of the traced ray, which starts 1e-5 m off
/// the floor.
#[test]
fn a_lamp_is_measured_through_a_pane() {
    let mut scene = behind_pane(0.0);
    scene
        .lights
        .push(point_light(p(0.0, 0.0, 2.0), intensity(10.0)));
    for (k, x) in [0.0, 1.0, 1.9].into_iter().enumerate() {
        let meter = irradiance_at([(p(x, 0.0, 0.0), UP)]);
        scene.sensors.push(sensor(&format!("{k}"), meter));
    }
    let measured = measured(&scene, &samples(1024));
    for (k, x) in [0.0_f64, 1.0, 1.9].into_iter().enumerate() {
        let squared = 4.0 + x * x;
        let cos_theta = 2.0 / squared.sqrt();
        let expected = 10.0 * cos_theta / squared * through(cos_theta);
        let seen = reading(&measured, &format!("{k}")).estimate;
        assert_close("E", seen.value, expected, 3e-6 * expected);
        assert!(seen.std_error < 1e-6 * expected, "{seen:?}");
    }
    assert!(
        measured
            .unsampled
            .iter()
            .all(|class| class.contains("reflected by panes")),
        "{:?}",
        measured.unsampled
    );
}

/// From a lamp thousands of diagonals away nothing is traced, so that what passes a pane is not taken from what it absorbs: the balance tells so, of a pane that reflects nothing, too.
#[test]
fn a_balance_tells_what_it_lacks_of_a_pane() {
    let still = modelled("air", pane_of(1.0, 0.7));
    let lamp = |height: f64| point_light(p(0.0, 0.0, height), intensity(10.0));
    for (height, is_complete) in [(2.0, true), (3e4, false)] {
        let shapes = [square(1.0, 1.0).made_of("air")];
        let mut scene = scene([still.clone()], shapes, [lamp(height)]);
        scene.sensors = energy_balance();
        let measured = measured(&scene, &samples(16));
        assert_eq!(measured.complete(), is_complete, "{:?}", measured.unsampled);
    }
}

/// The radiance of a floor that is lit and seen through the pane.
#[test]
fn surfaces_behind_a_pane_are_lit_through_it() {
    let mut scene = behind_pane(0.5);
    scene
        .lights
        .push(point_light(p(1.5, 0.0, 2.0), intensity(10.0)));
    let (height, back) = (2.0_f64, -1.0_f64);
    let ray = radiance_along(p(back, 0.0, height), v(-back, 0.0, -height));
    scene.sensors.push(sensor("L", ray));
    let mut options = samples(1 << 16);
    options.max_depth = Some(2);
    let seen = reading(&measured(&scene, &options), "L").estimate;
    let (squared, distance) = (4.0 + 1.5 * 1.5, libm::hypot(height, back));
    let cos_theta = 2.0 / f64::sqrt(squared);
    let irradiance = 10.0 * cos_theta / squared * through(cos_theta);
    let expected = 0.5 / PI * irradiance * through(height / distance);
    assert_agrees("L", &seen, expected, 1e-6 * expected);
}

/// E = ∫ L T(θ) cosθ cosθ_l/r² dA by a sum of 400² patches, whose error is below 1e-5: light samples and directions that
/// meet the panel through the pane share the light as they do without it.
#[test]
fn a_panel_behind_a_pane_is_counted_once() {
    let (side, height) = (1.5, 1.4);
    let mut scene = behind_pane(0.0);
    let panel = square_facing_down(side, height).emitting(radiance(5.0));
    scene.shapes.push(panel);
    let meter = irradiance_at([(p(0.2, 0.1, 0.0), UP)]);
    scene.sensors.push(sensor("E", meter));
    scene
        .sensors
        .push(sensor("E0", scalar_irradiance_at(p(0.2, 0.1, 0.0))));
    let (n, mut plane, mut scalar) = (400, 0.0, 0.0);
    for i in 0..n {
        for j in 0..n {
            let at = |k: i32| side * ((f64::from(k) + 0.5) / f64::from(n) - 0.5);
            let (x, y) = (at(i) - 0.2, at(j) - 0.1);
            let squared = x * x + y * y + height * height;
            let cos_theta = height / squared.sqrt();
            let part = 5.0 * through(cos_theta) * cos_theta / squared;
            plane += part * cos_theta;
            scalar += part;
        }
    }
    let cell = (side / f64::from(n)) * (side / f64::from(n));
    let measured = measured(&scene, &rel_error(4e-3));
    let [e, e0] = ["E", "E0"].map(|name| reading(&measured, name).estimate);
    assert_agrees("E", &e, plane * cell, 1e-5 * plane * cell);
    assert_agrees("E0", &e0, scalar * cell, 1e-5 * scalar * cell);
}

/// Seen from a diffuse surface, so that the power heuristic decides.
#[test]
fn a_panel_behind_a_pane_lights_a_wall_once() {
    let mut scene = behind_pane(0.5);
    scene
        .shapes
        .push(square_facing_down(1.5, 1.4).emitting(radiance(5.0)));
    let ray = radiance_along(p(1.0, 0.0, 0.5), v(-0.8, 0.1, -0.5));
    let meter = irradiance_at([(p(0.2, 0.1, 0.0), UP)]);
    scene.sensors.extend([sensor("L", ray), sensor("E", meter)]);
    let mut options = rel_error(4e-3);
    options.max_depth = Some(2);
    let radiance = reading(&measured(&scene, &options), "L").estimate;
    options.max_depth = Some(1);
    let irradiance = reading(&measured(&scene, &options), "E").estimate;
    let expected = irradiance.scaled(0.5 / PI);
    steradian_tests::assert_same("L = ρE/π", &radiance, &expected);
}

/// E = ∫ E_λ T(λ) dλ of a tinted pane that stops all of the shortest waves; and the same to a surface, whose paths take
/// their own wavelengths. The rule of .5 nm cells is exact to 1e-6.
#[test]
fn a_tinted_pane_is_summed_over_the_spectrum() {
    let tint = vec![(420.0, 0.0), (500.0, 0.4), (650.0, 0.9)];
    let curve = Curve::new(tint, Beyond::Held).expect("samples in order");
    let mut scene = behind_pane(0.5);
    scene.spectrum = SpectrumMode::Spectral { range: VISIBLE };
    scene.materials[0] = modelled(
        "glass",
        Recipe::Pane {
            ior: 1.5,
            transmittance: LaneValues::table(curve.clone()).into(),
        },
    );
    scene
        .lights
        .push(point_light(p(0.0, 0.0, 2.0), intensity(10.0)));
    let meter = irradiance_at([(p(0.0, 0.0, 0.0), UP)]);
    let ray = radiance_along(p(0.3, 0.0, 0.5), v(-0.3, 0.0, -0.5));
    scene.sensors.extend([sensor("E", meter), sensor("L", ray)]);
    let mut options = samples(1 << 16);
    options.max_depth = Some(2);
    let (n, mut mean) = (4700, 0.0);
    for k in 0..n {
        let part = (f64::from(k) + 0.5) / f64::from(n);
        let tau = curve.at(VISIBLE[0] + part * (VISIBLE[1] - VISIBLE[0]));
        let pane = Pane::new(1.5, [tau; 4]).expect("glass");
        mean += pane.shares(1.0)[0].1 / f64::from(n);
    }
    let expected = 2.5 * mean;
    let measured = measured(&scene, &options);
    let [irradiance, radiance] = ["E", "L"].map(|name| reading(&measured, name).estimate);
    assert_agrees("L", &radiance, 0.5 / PI * expected, 1e-5);
    options.max_depth = Some(1);
    let direct = reading(&steradian_tests::measuring::measured(&scene, &options), "E").estimate;
    assert_close("E", direct.value, expected, 2e-6 * expected);
    assert!(irradiance.value >= direct.value, "{irradiance:?}");
}
