//! Light from everywhere through the openings of rooms, which samples look for.

use std::f64::consts::PI;
use std::sync::Arc;

use steradian::geometry::{Point, Vector};
use steradian::material::{Bitmap, Texels};
use steradian::quantity::{Amount, Radiance};
use steradian::scene::description::{
    EnvironmentAmount, EnvironmentDescription, GeometryDescription, LightDescription, LightKind,
    Opening, SceneDescription, SensorDescription, ShapeDescription,
};
use steradian_tests::measuring::{measured, reading, samples};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_same};

fn opening(face: &str, rect: [f64; 4], material: Option<&str>) -> Opening {
    Opening {
        face: face.into(),
        rect,
        material: material.map(Into::into),
    }
}

/// A room of 3 m × 4 m × 2.5 m with two windows in one wall, one in the next, and a skylight.
fn room_with_windows(is_room: bool, filling: Option<&str>) -> ShapeDescription {
    let mut room = room(p(3.0, 4.0, 2.5));
    if let GeometryDescription::Box {
        inside, openings, ..
    } = &mut room.geometry
    {
        *inside = is_room;
        *openings = vec![
            opening("y+", [0.2, 0.9, 1.0, 1.2], filling),
            opening("y+", [1.8, 0.9, 0.8, 1.2], None),
            opening("x-", [1.0, 1.0, 0.5, 0.5], None),
            opening("z+", [1.0, 1.0, 0.6, 0.4], None),
        ];
    }
    room.made_of("wall")
}

fn sky(size: [u32; 2], texels: impl Fn(u32) -> f32) -> LightDescription {
    let texel = |index| [texels(index), texels(index), texels(index), 1.0];
    let texels = Texels::Float((0..size[0] * size[1]).map(texel).collect());
    let Ok(picture) = Bitmap::new(size[0], size[1], texels) else {
        panic!("a picture")
    };
    let unit = Radiance::from_watts_per_square_metre_steradian(1.0);
    light(LightKind::EnvironmentMap(EnvironmentDescription {
        picture: Arc::new(picture),
        middle: Vector::new(0.0, 1.0, 0.0),
        amount: EnvironmentAmount::Unit(Amount::Radiant(unit)),
    }))
}

/// At the back of the room, below a window, on the sill of the skylight's shaft of light.
fn meters() -> Vec<SensorDescription> {
    let places = [
        ("floor", p(1.5, 0.4, 0.001), UP),
        ("below", p(0.7, 3.9, 0.5), v(0.2, -1.0, 0.1)),
        ("air", p(1.2, 1.1, 2.0), v(-0.5, 0.3, 1.0)),
    ];
    let meter = |(name, point, normal): (&str, Point, Vector)| {
        sensor(name, irradiance_at([(point, normal)]))
    };
    let mut meters: Vec<_> = places.into_iter().map(meter).collect();
    meters.push(sensor("ball", scalar_irradiance_at(p(1.5, 2.0, 1.2))));
    meters.push(sensor(
        "ray",
        radiance_along(p(1.5, 0.5, 1.2), v(0.3, 1.0, -0.6)),
    ));
    meters
}

/// Walls that emit what they do not reflect, under a sky as bright: L is the same everywhere, whoever finds the light. The glass ball, whose
/// rough surface keeps its energy within 2·10⁻³, covers less than a tenth of what any meter sees.
#[test]
fn a_room_as_bright_as_its_sky_is_a_furnace() {
    let skies = [environment(1.0), sky([8, 4], |_| 1.0)];
    for (number, sky) in skies.into_iter().enumerate() {
        let wall = room_with_windows(true, None).emitting(radiance(0.4));
        let glass = modelled("glass", dielectric(1.5, Some(rough(0.3, true))));
        let ball = ball(p(2.3, 2.8, 0.4), 0.3).made_of("glass");
        let mut scene = scene([lambertian("wall", 0.6), glass], [wall, ball], [sky]);
        scene.sensors = meters();
        let found = measured(&scene, &samples(1 << 14));
        for (name, expected) in [
            ("floor", PI),
            ("below", PI),
            ("air", PI),
            ("ball", 4.0 * PI),
            ("ray", 1.0),
        ] {
            let found = reading(&found, name).estimate;
            assert_agrees(
                &format!("{name} {number}"),
                &found,
                expected,
                2e-4 * expected,
            );
            assert!(found.std_error < 0.01 * expected, "{name}: {found:?}");
        }
    }
}

/// A box turned inside out has the same walls but is no room, and so no portals. Under a bright sun of one texel, and under clouds; with a pane
/// in a window.
#[test]
fn a_room_with_portals_is_the_same_room() {
    let texel = |index: u32| match index {
        _ if index < 512 => 1.0 + 0.1 * (index % 5) as f32,
        _ => 0.3,
    };
    let sunny = sky(
        [32, 32],
        |index| if index == 300 { 300.0 } else { texel(index) },
    );
    for (sky, gain) in [(sunny, None), (sky([32, 32], texel), Some(1.5))] {
        let room = |is_room| -> SceneDescription {
            let room = room_with_windows(is_room, Some("pane"));
            let materials = [lambertian("wall", 0.6), modelled("pane", pane(0.9))];
            let mut scene = scene(materials, [room], [sky.clone()]);
            scene.sensors = meters();
            scene
        };
        let found = [true, false].map(|is_room| measured(&room(is_room), &samples(1 << 14)));
        let ratio = |meter: &str| {
            let [with, without] = found.each_ref().map(|found| reading(found, meter).estimate);
            assert_same(meter, &with, &without);
            libm::log2(without.std_error / with.std_error)
        };
        let ratios = ["floor", "below", "air", "ball", "ray"].map(ratio);
        let mean = ratios.iter().sum::<f64>() / 5.0;
        // 64 replicates give each ratio to 13 %: their mean is beyond the gain only if samples find the windows.
        assert!(
            gain.is_none_or(|gain| mean > libm::log2(gain)),
            "{ratios:?}"
        );
    }
}
