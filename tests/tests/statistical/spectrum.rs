//! Units, lanes and groups: what must not depend on how the same light is stated.

use steradian::quantity::Amount;
use steradian::scene::description::{LightDescription, LightKind, SceneDescription, SpectrumMode};
use steradian_tests::measuring::{measured, reading, samples};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_close};

/// A panel and a lamp over paper, by lumens, read in lux.
pub fn desk(spectrum: SpectrumMode, efficacy: f64) -> SceneDescription {
    let panel = square_facing_down(0.5, 1.5).emitting(emitted_lumens(800.0));
    let mut desk = scene(
        [lambertian("paper", 0.7)],
        [square(4.0, 0.0).made_of("paper"), panel],
        [point_light(p(1.0, 1.0, 1.0), luminous_flux(300.0))],
    );
    desk.spectrum = spectrum;
    desk.luminous_efficacy = Some(efficacy);
    desk.sensors = vec![
        sensor("desk", irradiance_at([(p(0.3, 0.1, 0.0), UP)])),
        sensor("ceiling", irradiance_at([(p(0.3, 0.1, 2.0), DOWN)])),
        sensor("paper", radiance_along(p(0.3, 0.1, 1.0), DOWN)),
    ];
    desk
}

fn values(scene: &SceneDescription) -> Vec<(f64, String)> {
    let readings = measured(scene, &samples(1 << 14)).readings().into_iter();
    readings
        .map(|reading| (reading.estimate.value, reading.unit))
        .collect()
}

/// K cancels: the same samples, up to the rounding of lights in f32.
#[test]
fn lumens_in_lux_out_does_not_depend_on_the_efficacy() {
    for spectrum in [SpectrumMode::Rgb, visible()] {
        let (a, b) = (
            values(&desk(spectrum.clone(), 100.0)),
            values(&desk(spectrum, 250.0)),
        );
        for ((a, unit), (b, _)) in a.iter().zip(&b) {
            assert!(unit == "lx" || unit == "cd/m2", "{unit}");
            assert_close("K", *a, *b, 1e-6 * a);
        }
    }
}

/// Grey in three channels is grey in one band.
#[test]
fn rgb_and_broadband_agree_on_grey() {
    let (rgb, band) = (
        values(&desk(SpectrumMode::Rgb, 179.0)),
        values(&desk(visible(), 179.0)),
    );
    for ((rgb, _), (band, _)) in rgb.iter().zip(&band) {
        assert_close("grey", *rgb, *band, 1e-6 * band);
    }
}

fn sky(group: &str, watts: f64) -> LightDescription {
    LightDescription {
        group: Some(group.into()),
        ..environment(watts)
    }
}

/// Two skies are found by the same rays: their errors are one error, and add up as they are, not in squares.
#[test]
fn groups_add_up_with_their_covariance() {
    let mut scene = scene([lambertian("soil", 0.2)], [ground(0.0).made_of("soil")], []);
    scene.lights = vec![sky("day", 1.0), sky("glow", 2.0)];
    scene.sensors.push(sensor(
        "wall",
        irradiance_at([(p(0.0, 0.0, 1.0), v(1.0, 0.0, 0.2))]),
    ));
    let wall = reading(&measured(&scene, &samples(1 << 14)), "wall");
    let [(_, day), (_, glow)] = &wall.groups[..] else {
        panic!("there are two groups, not {:?}", wall.groups)
    };
    let total = wall.estimate;
    assert_close(
        "sum",
        day.value + glow.value,
        total.value,
        1e-12 * total.value,
    );
    assert_close("ratio", glow.value, 2.0 * day.value, 1e-6 * glow.value);
    assert_close(
        "errors",
        day.std_error + glow.std_error,
        total.std_error,
        1e-3 * total.std_error,
    );
}

/// A group is what is left when the lights of the others are switched off.
#[test]
fn a_group_is_its_lights_alone() {
    let lamp = |group: &str, x: f64| LightDescription {
        group: Some(group.into()),
        ..point_light(p(x, 0.0, 1.5), intensity(10.0))
    };
    let room_of = |lights: Vec<LightDescription>| {
        let mut scene = scene(
            [lambertian("wall", 0.5)],
            [room(p(4.0, 3.0, 2.5)).made_of("wall")],
            lights,
        );
        scene
            .sensors
            .push(sensor("floor", irradiance_at([(p(1.0, 1.0, 0.0), UP)])));
        scene
    };
    let options = samples(1 << 17);
    let both = room_of(vec![lamp("left", 1.0), lamp("right", 3.0)]);
    let both = reading(&measured(&both, &options), "floor");
    let left = reading(
        &measured(&room_of(vec![lamp("left", 1.0)]), &options),
        "floor",
    )
    .estimate;
    let (name, group) = &both.groups[0];
    assert_eq!(name, "left");
    // The two runs share random numbers, so the test is against the error of one of them.
    assert_agrees("left", group, left.value, 4.0 * left.std_error);
}

/// Watts and lumens of the same light are K apart.
#[test]
fn watts_and_lumens_are_linked_by_the_efficacy() {
    let mut scene = desk(visible(), 200.0);
    scene.lights.push(light(LightKind::Environment {
        radiance: Amount::Radiant(
            steradian::quantity::Radiance::from_watts_per_square_metre_steradian(1.0),
        ),
    }));
    let readings = measured(&scene, &samples(1 << 12)).readings();
    let of = |quantity: &str| {
        let reading = readings
            .iter()
            .find(|r| r.sensor == "desk" && r.quantity == quantity);
        reading.map_or(f64::NAN, |reading| reading.estimate.value)
    };
    let lux = of("illuminance");
    assert_close("K", of("irradiance") * 200.0, lux, 1e-9 * lux);
}
