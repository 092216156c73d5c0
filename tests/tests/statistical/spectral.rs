//! Spectral runs: wavelengths in, channels out.

use std::sync::Arc;

use steradian::estimation::{Estimate, Method};
use steradian::scene::description::{
    Bins, LaneValues, Response, SceneDescription, SensorDescription, SpectrumMode,
};
use steradian::spectrum::{
    Action, Beyond, Curve, Illuminant, MELANOPIC_EFFICACY_OF_D65, VISIBLE, blackbody,
};
use steradian_tests::measuring::{measured, reading, samples};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_close, assert_same};

use super::spectrum::desk;

fn spectral() -> SpectrumMode {
    SpectrumMode::Spectral { range: VISIBLE }
}

fn table(curve: Curve) -> LaneValues {
    LaneValues::table(curve)
}

/// A reflectance that rises from blue to red, with a corner.
fn rust() -> Curve {
    let samples = vec![(400.0, 0.1), (550.0, 0.2), (600.0, 0.7), (700.0, 0.8)];
    Curve::new(samples, Beyond::Held).expect("samples in order")
}

fn halogen() -> Curve {
    blackbody(2856.0, VISIBLE, 0.5).expect("a temperature")
}

fn with_response(mut sensor: SensorDescription, response: Response) -> SensorDescription {
    sensor.response = Some(response);
    sensor
}

/// A point lamp of 1000 lm over the sensors of every response.
fn lamp(spectrum: LaneValues) -> SceneDescription {
    let mut lamp = point_light(p(0.0, 0.0, 2.0), luminous_flux(1000.0));
    lamp.spectrum = Some(spectrum);
    let mut scene = scene([], [], [lamp]);
    scene.spectrum = spectral();
    let at = |name: &str| sensor(name, irradiance_at([(p(0.0, 0.0, 0.0), UP)]));
    let weights =
        Curve::new(vec![(500.0, 0.0), (600.0, 1.0)], Beyond::Zero).expect("samples in order");
    let custom = Response::Table {
        name: "ramp".into(),
        curve: Arc::new(weights),
    };
    let responses = [
        ("watts", Response::Radiant),
        ("lux", Response::Photopic),
        ("dark", Response::Scotopic),
        ("photons", Response::Par),
        ("clock", Response::Melanopic),
        ("ramp", custom),
    ];
    scene.sensors = responses
        .map(|(name, response)| with_response(at(name), response))
        .to_vec();
    scene
}

/// E = (Φ/4π r²)·∫ R s / 683 ∫ V s for every response, in closed form: no sampling error.
#[test]
fn every_response_to_a_lamp_is_a_closed_form() {
    let source = halogen();
    let found = measured(&lamp(table(source.clone())), &samples(1 << 10));
    let seen = source.product_integral(Action::Photopic.weight(), VISIBLE);
    let lux = 1000.0 / (4.0 * std::f64::consts::PI * 4.0);
    let of = |action: Action| lux * source.product_integral(action.weight(), VISIBLE) / seen;
    let ramp = Curve::new(vec![(500.0, 0.0), (600.0, 1.0)], Beyond::Zero).unwrap();
    let expected = [
        ("watts", "W/m2", lux * source.integral(VISIBLE) / seen),
        ("lux", "lx", lux),
        ("dark", "lx", of(Action::Scotopic)),
        ("photons", "umol/(m2 s)", of(Action::Par)),
        ("clock", "W/m2", of(Action::Melanopic)),
        (
            "ramp",
            "W/m2",
            lux * source.product_integral(&ramp, VISIBLE) / seen,
        ),
    ];
    for (sensor, unit, expected) in expected {
        let reading = reading(&found, sensor);
        assert_eq!(
            (reading.unit.as_str(), reading.estimate.method),
            (unit, Method::ClosedForm)
        );
        assert_agrees(sensor, &reading.estimate, expected, 1e-12 * expected);
    }
    // 122.96 lm/W and .5 melanopic lux a lux: illuminant A.
    assert_close(
        "lm/W",
        lux / reading(&found, "watts").estimate.value,
        122.96,
        0.01,
    );
    let readings = found.readings();
    let daylight = readings
        .iter()
        .find(|r| r.quantity.contains("equivalent daylight"))
        .unwrap();
    let ratio = of(Action::Melanopic) / MELANOPIC_EFFICACY_OF_D65;
    assert_agrees("melanopic EDI", &daylight.estimate, ratio, 1e-9 * ratio);
}

/// In a closed sphere of reflectance ρ(λ) with a lamp in the middle, every wavelength has E = Φ/A/(1 − ρ).
#[test]
fn an_integrating_sphere_multiplies_each_wavelength() {
    let mut lamp = point_light(p(0.0, 0.0, 0.0), flux(100.0));
    lamp.spectrum = Some(table(halogen()));
    let wall = hollow_sphere(p(0.0, 0.0, 0.0), 1.0, &[]).made_of("rust");
    let mut sphere = scene([coloured("rust", table(rust()))], [wall], [lamp]);
    sphere.spectrum = spectral();
    let place = irradiance_at([(p(0.0, 0.0, -1.0), UP)]);
    let mut watts = with_response(sensor("watts", place.clone()), Response::Radiant);
    watts.bins = Some(Bins {
        range: [400.0, 700.0],
        width: 50.0,
        per_nm: false,
    });
    let lux = with_response(sensor("lux", place.clone()), Response::Photopic);
    let clock = with_response(sensor("clock", place), Response::Melanopic);
    sphere.sensors = vec![watts, lux, clock];
    let found = measured(&sphere, &samples(1 << 16));
    let source = halogen();
    let direct = 100.0 / (4.0 * std::f64::consts::PI) / source.integral(VISIBLE);
    let gained = Curve::from_function(VISIBLE, 0.05, Beyond::Zero, |nm| {
        direct * source.at(nm) / (1.0 - rust().at(nm))
    });
    let gained = gained.unwrap();
    // The chord of 1/(1 − ρ) over .05 nm is off by less than 1e-6.
    let check = |what: &str, estimate: &Estimate, expected: f64| {
        assert_agrees(what, estimate, expected, 2e-5 * expected);
        assert!(estimate.std_error < 0.02 * expected, "{what}: {estimate:?}");
    };
    check(
        "watts",
        &reading(&found, "watts").estimate,
        gained.integral(VISIBLE),
    );
    let of = |action: Action| gained.product_integral(action.weight(), VISIBLE);
    check(
        "lux",
        &reading(&found, "lux").estimate,
        of(Action::Photopic),
    );
    check(
        "clock",
        &reading(&found, "clock").estimate,
        of(Action::Melanopic),
    );
    let bins = found
        .readings()
        .into_iter()
        .filter(|r| r.quantity.ends_with(" nm"));
    for (index, bin) in bins.enumerate() {
        let low = 400.0 + 50.0 * index as f64;
        assert_eq!(bin.quantity, format!("irradiance {low}-{} nm", low + 50.0));
        check(
            &bin.quantity,
            &bin.estimate,
            gained.integral([low, low + 50.0]),
        );
    }
}

/// Lumens over grey paper: lux do not depend on the mode.
#[test]
fn grey_scenes_agree_in_all_modes() {
    let all = [spectral(), SpectrumMode::Rgb, visible()];
    let [spectral, rgb, band] = all.map(|mode| measured(&desk(mode, 179.0), &samples(1 << 16)));
    for name in ["desk", "ceiling", "paper"] {
        let of = |found| reading(found, name).estimate;
        assert_same(name, &of(&spectral), &of(&rgb));
        assert_same(name, &of(&spectral), &of(&band));
    }
}

/// Colours given as [r, g, b] come back: radiance of white under D65 reflected by a colour has its channels.
#[test]
fn colours_are_seen_as_they_were_given() {
    let colour = [0.6, 0.3, 0.1];
    let mut sun = directional_lux(DOWN, 1000.0);
    sun.spectrum = Some(table(Illuminant::D65.curve().clone()));
    let mut card = scene(
        [coloured("card", LaneValues::Rgb(colour))],
        [square(4.0, 0.0).made_of("card")],
        [sun],
    );
    card.spectrum = spectral();
    let ray = radiance_along(p(0.1, 0.1, 1.0), DOWN);
    card.sensors = vec![with_response(sensor("card", ray), Response::Xyz)];
    let found = measured(&card, &samples(1 << 18)).readings();
    let xyz: Vec<&Estimate> = found.iter().map(|reading| &reading.estimate).collect();
    let white = 1000.0 / std::f64::consts::PI;
    let expected = steradian::spectrum::apply(&steradian::spectrum::xyz_from_rgb(), colour);
    for (value, expected) in xyz.into_iter().zip(expected) {
        // The white of sRGB is D65 to four digits, and the colour is solved for to 1e-4.
        assert_agrees("tristimulus", value, expected * white, 5e-4 * white);
        assert!(value.std_error < 3e-3 * white);
    }
}

/// Infrared: a body of 500 K radiates nothing the eye sees, and its power within 2 to 4 µm is Planck's.
#[test]
fn wavelengths_reach_from_ultraviolet_to_infrared() {
    let range = [280.0, 4000.0];
    let body = blackbody(1500.0, range, 1.0).unwrap();
    let mut panel = square_facing_down(1.0, 1.0).emitting(radiance(50.0));
    panel.emission.as_mut().unwrap().spectrum = Some(table(body.clone()));
    let mut plate = scene([], [panel], []);
    plate.spectrum = SpectrumMode::Spectral { range };
    let mut meter = sensor("meter", radiance_along(p(0.0, 0.0, 0.0), UP));
    meter.response = Some(Response::Radiant);
    meter.bins = Some(Bins {
        range: [2000.0, 4000.0],
        width: 2000.0,
        per_nm: true,
    });
    plate.sensors = vec![meter];
    let found = measured(&plate, &samples(1 << 10)).readings();
    assert_agrees("total", &found[0].estimate, 50.0, 1e-9);
    assert_eq!(found[0].quantity, "radiance (280-4000 nm)");
    let part = body.integral([2000.0, 4000.0]) / body.integral(range);
    assert_eq!(found[1].unit, "W/(m2 sr nm)");
    assert_agrees("infrared", &found[1].estimate, 50.0 * part / 2000.0, 1e-9);
}

/// Lights without a spectrum and tables that end within the run are told.
#[test]
fn what_is_assumed_of_spectra_is_told() {
    let mut scene = lamp(table(rust()));
    scene.materials = vec![coloured("rust", table(rust()))];
    scene
        .lights
        .push(point_light(p(1.0, 0.0, 2.0), luminous_flux(1.0)));
    let warnings = measured(&scene, &samples(1 << 10)).warnings;
    let told = [
        "lights without a spectrum have equal energy at every wavelength (illuminant E): `light 1`",
        "light `light 0`: its table goes from 400 to 700 nm; beyond it emits nothing",
        "material `rust`: its table goes from 400 to 700 nm and keeps its last value beyond",
    ];
    assert_eq!(warnings, told);
    scene.spectrum = SpectrumMode::Spectral {
        range: [400.0, 700.0],
    };
    assert_eq!(measured(&scene, &samples(1 << 10)).warnings, told[..1]);
}
