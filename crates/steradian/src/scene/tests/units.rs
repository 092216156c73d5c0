//! Watts and lumens: what a light's amount becomes in lanes, and what a sensor reports.

use std::f64::consts::PI;

use super::*;
use crate::quantity::{
    Exitance, Flux, Illuminance, Luminance, LuminousExitance, LuminousFlux, Radiance,
};
use crate::sensor::Readout;

fn emitting(amount: EmissionAmount, two_sided: bool) -> SceneDescription {
    let mut description = valid();
    description.lights.clear();
    description.shapes = vec![shape(square(2.0), None)];
    description.shapes[0].emission = Some(EmissionDescription {
        amount,
        spectrum: None,
        textures: vec![],
        two_sided,
        group: Some("panel".into()),
        schedule: None,
    });
    description
}

/// Radiance of the first lane of the only light, which is a square of 4 m².
fn radiance(description: &SceneDescription) -> f64 {
    let scene = scene(description);
    assert_eq!(scene.parts()[0].light, Some(LightId(0)));
    assert_eq!(scene.groups(), ["panel"]);
    match &scene.lights()[0].kind {
        Kind::Area(light) => light.radiance[0].to_watts_per_square_metre_steradian(),
        other => panic!("{other:?}"),
    }
}

fn close(found: f64, expected: f64) -> bool {
    (found / expected - 1.0).abs() < 1e-14
}

/// Φ = πLA for each emitting side; M = πL.
#[test]
fn flux_exitance_and_radiance_of_one_or_both_sides() {
    let flux = EmissionAmount::Flux(Amount::Radiant(Flux::from_watts(8.0)));
    assert!(close(radiance(&emitting(flux, false)), 2.0 / PI));
    assert!(close(radiance(&emitting(flux, true)), 1.0 / PI));
    let exitance =
        EmissionAmount::Exitance(Amount::Radiant(Exitance::from_watts_per_square_metre(5.0)));
    let given = EmissionAmount::Radiance(Amount::Radiant(
        Radiance::from_watts_per_square_metre_steradian(7.0),
    ));
    for two_sided in [false, true] {
        assert!(close(radiance(&emitting(exitance, two_sided)), 5.0 / PI));
        assert_eq!(radiance(&emitting(given, two_sided)), 7.0);
    }
}

#[test]
fn lumens_are_watts_times_the_efficacy() {
    let with = |amount, efficacy| {
        let mut description = emitting(amount, false);
        description.luminous_efficacy = efficacy;
        radiance(&description)
    };
    let flux = EmissionAmount::Flux(Amount::Photometric(LuminousFlux::from_lumens(179.0)));
    assert!(close(with(flux, None), 0.25 / PI));
    assert!(close(with(flux, Some(358.0)), 0.125 / PI));
    let luminance = Amount::Photometric(Luminance::from_candelas_per_square_metre(358.0));
    assert!(close(with(EmissionAmount::Radiance(luminance), None), 2.0));
    let exitance = Amount::Photometric(LuminousExitance::from_lumens_per_square_metre(179.0));
    assert!(close(
        with(EmissionAmount::Exitance(exitance), None),
        1.0 / PI
    ));
}

#[test]
fn each_copy_of_a_repeat_has_the_flux() {
    let flux = EmissionAmount::Flux(Amount::Radiant(Flux::from_watts(8.0)));
    let mut description = emitting(flux, false);
    description.shapes[0].repeat = Some(Repeat {
        count: vec![5],
        step: vec![Vector::new(3.0, 0.0, 0.0)],
    });
    let scene = scene(&description);
    assert_eq!(scene.lights().len(), 5);
    for light in scene.lights() {
        assert!(
            matches!(&light.kind, Kind::Area(light) if close(light.radiance[0].to_watts_per_square_metre_steradian(), 2.0 / PI))
        );
    }
}

#[test]
fn the_flux_of_a_point_or_spot_becomes_its_intensity() {
    let intensity = |kind| {
        let mut description = valid();
        description.lights = vec![light(kind)];
        match &scene(&description).lights()[0].kind {
            Kind::Point(light) => light.intensity[0].to_watts_per_steradian(),
            Kind::Spot(light) => light.peak_intensity[0].to_watts_per_steradian(),
            other => panic!("{other:?}"),
        }
    };
    let (position, power) = (
        Point::new(0.5, 0.5, 1.0),
        PointPower::Flux(Amount::Radiant(Flux::from_watts(10.0))),
    );
    assert!(close(
        intensity(LightKind::Point { position, power }),
        10.0 / (4.0 * PI)
    ));
    let spot = |beam| LightKind::Spot {
        position,
        direction: Vector::new(0.0, 0.0, -3.0),
        beam,
        power,
    };
    let cutoff = Angle::from_degrees(60.0);
    assert!(close(
        intensity(spot(SpotBeam::Uniform { cutoff })),
        10.0 / PI
    ));
    // 2π(1 − cos³60°)/3 for n = 2.
    assert!(close(
        intensity(spot(SpotBeam::CosinePower {
            exponent: 2.0,
            cutoff
        })),
        10.0 / (1.75 * PI / 3.0)
    ));
}

fn readouts(response: Response, lights: &[LightKind], spectrum: SpectrumMode) -> Vec<Readout> {
    let mut description = valid();
    description.luminous_efficacy = Some(100.0);
    description.response = response;
    description.spectrum = spectrum;
    description.lights = lights.iter().cloned().map(light).collect();
    scene(&description).sensors()[0].readouts.clone()
}

fn watts() -> LightKind {
    point(Amount::Radiant(Intensity::from_watts_per_steradian(1.0)))
}

fn lux() -> LightKind {
    LightKind::Directional {
        direction: Vector::new(0.0, 0.0, -1.0),
        irradiance: Amount::Photometric(Illuminance::from_lux(1.0)),
    }
}

#[test]
fn auto_reports_the_units_that_lights_are_given_in() {
    let units = |response, lights: &[LightKind]| {
        let found = readouts(response, lights, SpectrumMode::Rgb);
        found
            .into_iter()
            .map(|readout| readout.unit)
            .collect::<Vec<_>>()
    };
    assert_eq!(units(Response::Auto, &[watts()]), ["W/m2"]);
    assert_eq!(units(Response::Auto, &[lux()]), ["lx"]);
    assert_eq!(units(Response::Auto, &[watts(), lux()]), ["W/m2", "lx"]);
    assert_eq!(units(Response::Radiant, &[lux()]), ["W/m2"]);
    assert_eq!(units(Response::Photopic, &[watts()]), ["lx"]);
}

#[test]
fn only_the_visible_band_weighs_in_lumens() {
    let bands = SpectrumMode::Broadband {
        bands: vec!["nir".into(), "visible".into()],
    };
    let found = readouts(Response::Photopic, &[lux()], bands.clone());
    assert_eq!(
        (&found[0].weights[..], found[0].channel_factor),
        (&[0.0, 100.0][..], 100.0)
    );
    let found = readouts(Response::Radiant, &[lux()], bands);
    assert_eq!(found[0].weights, [1.0, 1.0]);
}

/// lm in, lx out: K cancels; W in, W out: K is not used.
#[test]
fn the_efficacy_is_used_only_across_units() {
    for (light_kind, response, links) in [
        (lux(), Response::Auto, false),
        (watts(), Response::Auto, false),
        (lux(), Response::Radiant, true),
        (watts(), Response::Photopic, true),
    ] {
        let mut description = valid();
        description.spectrum = SpectrumMode::Rgb;
        description.response = response;
        description.lights = vec![light(light_kind)];
        assert_eq!(scene(&description).links_watts_and_lumens(), links);
    }
}

#[test]
fn a_flux_sensor_reports_the_flux_and_its_mean() {
    let mut description = valid();
    description.shapes[0].name = Some("desk".into());
    description.shapes[0].transform = Transform::scale(2.0);
    let names = |of| {
        let mut description = description.clone();
        let surface = FluxSurface::Shape {
            name: "desk".into(),
            side: Side::Front,
        };
        description.sensors = vec![sensor("flux", SensorKind::Flux { surface, of })];
        let found = scene(&description).sensors()[0].readouts.clone();
        assert_eq!(
            (&found[0].weights[..], &found[1].weights[..]),
            (&[1.0][..], &[0.25][..])
        );
        found
            .into_iter()
            .map(|readout| format!("{} {}", readout.name, readout.unit))
            .collect::<Vec<_>>()
    };
    assert_eq!(names(FluxOf::Incident), ["flux W", "mean irradiance W/m2"]);
    assert_eq!(names(FluxOf::Leaving), ["flux W", "mean exitance W/m2"]);
    assert_eq!(
        names(FluxOf::Absorbed),
        ["flux W", "mean absorbed irradiance W/m2"]
    );
    assert_eq!(names(FluxOf::Net), ["flux W", "mean net irradiance W/m2"]);
}
