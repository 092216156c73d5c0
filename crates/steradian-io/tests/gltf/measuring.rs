//! What lights of glTF files give at a point, against closed forms.

use serde_json::{Value, json};
use steradian::estimation::{Plan, Silent, Stopping};
use steradian::geometry::{Point, Vector};
use steradian::scene::Scene;
use steradian::scene::description::{Receivers, SceneDescription, SensorDescription, SensorKind};
use steradian::transport::{MeasureOptions, measure};

use crate::building::{Buffer, scene};

/// A small black square far below these lights, so that nothing is reflected.
fn lit_by(lights: Value, nodes: Value) -> SceneDescription {
    let mut buffer = Buffer::default();
    let mut square = buffer.square();
    square["material"] = json!(0);
    let mut all = vec![json!({ "mesh": 0, "translation": [0, -50, 0] })];
    all.extend(nodes.as_array().cloned().unwrap_or_default());
    let entries = json!({
        "materials": [{ "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1] } }],
        "meshes": [{ "primitives": [square] }], "nodes": all,
        "extensions": { "KHR_lights_punctual": { "lights": lights } },
    });
    scene(entries, &buffer)
}

fn light(number: usize, place: Value) -> Value {
    let mut node = place;
    node["extensions"] = json!({ "KHR_lights_punctual": { "light": number } });
    node
}

/// The one reading of this sensor.
fn reading(mut scene: SceneDescription, kind: SensorKind) -> (f64, String) {
    let (name, response) = ("meter".into(), None);
    scene.sensors = vec![SensorDescription {
        name,
        response,
        bins: None,
        kind,
    }];
    let scene = Scene::new(&scene).unwrap_or_else(|problems| panic!("{problems:?}"));
    let plan = Plan {
        stop: Stopping::at_samples(1024),
        ..Plan::default()
    };
    let options = MeasureOptions {
        plan,
        ..MeasureOptions::default()
    };
    let readings = measure(&scene, &options, &mut Silent).expect("a measurement");
    let readings = readings.readings();
    (readings[0].estimate.value, readings[0].unit.to_string())
}

/// At the origin, facing up.
fn illuminance(scene: SceneDescription) -> f64 {
    let up = Vector::new(0.0, 0.0, 1.0);
    let (value, unit) = reading(
        scene,
        SensorKind::Irradiance(Receivers::Points(vec![(Point::ORIGIN, up)])),
    );
    assert_eq!(unit, "lx");
    value
}

fn luminance(scene: SceneDescription, origin: Point, direction: Vector) -> f64 {
    let (value, unit) = reading(
        scene,
        SensorKind::Radiance {
            rays: vec![(origin, direction)],
        },
    );
    assert_eq!(unit, "cd/m2");
    value
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-6 * expected,
        "{found} is not {expected}"
    );
}

#[test]
fn a_point_light_gives_intensity_over_distance_squared() {
    let lights = json!([
        { "type": "point", "intensity": 450, "range": 10 },
        { "type": "point", "intensity": 100, "color": [0.5, 0.25, 0] },
    ]);
    let white = lit_by(
        lights.clone(),
        json!([light(0, json!({ "translation": [0, 3, 0] }))]),
    );
    assert_close(illuminance(white), 450.0 / 9.0);
    let nodes = json!([light(1, json!({ "translation": [3, 4, 0] }))]);
    let coloured = 100.0 * (0.5 * 0.2126 + 0.25 * 0.7152);
    assert_close(illuminance(lit_by(lights, nodes)), coloured * 0.8 / 25.0);
}

#[test]
fn a_directional_light_gives_its_illuminance_times_the_cosine() {
    let lights = json!([{ "type": "directional", "intensity": 500 }]);
    // −z turned about x by −30° points 30° below the horizon: cos 60° of it arrives.
    let (sin, cos) = libm::sincos((-15.0_f64).to_radians());
    let nodes = json!([light(0, json!({ "rotation": [sin, 0, 0, cos] }))]);
    assert_close(illuminance(lit_by(lights, nodes)), 250.0);
}

#[test]
fn a_spot_falls_off_between_its_angles() {
    let (inner, outer, theta) = (0.2, 0.6, 0.4_f64);
    let lights = json!([{
        "type": "spot", "intensity": 800, "spot": { "innerConeAngle": inner, "outerConeAngle": outer },
    }]);
    // Two metres above the origin and turned away from it by θ.
    let half = (-std::f64::consts::FRAC_PI_2 + theta) / 2.0;
    let (sin, cos) = libm::sincos(half);
    let nodes = json!([light(
        0,
        json!({ "translation": [0, 2, 0], "rotation": [sin, 0, 0, cos] })
    )]);
    let falloff = (libm::cos(theta) - libm::cos(outer)) / (libm::cos(inner) - libm::cos(outer));
    assert_close(
        illuminance(lit_by(lights, nodes)),
        800.0 * falloff * falloff / 4.0,
    );
}

#[test]
fn a_file_without_light_gets_a_sky_and_a_sun() {
    let cos = 1.2 / (0.25 + 0.36 + 1.44_f64).sqrt();
    let expected = 500.0 + 1000.0 * cos;
    assert_close(illuminance(lit_by(json!([]), json!([]))), expected);
}

/// A square of 250 (r, g, b) = (1, 0.5, 0.25) in nits.
fn lamp(double_sided: bool, scale: [f64; 3]) -> SceneDescription {
    let mut buffer = Buffer::default();
    let mut square = buffer.square();
    square["material"] = json!(0);
    let entries = json!({
        "materials": [{
            "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1] },
            "emissiveFactor": [1, 0.5, 0.25], "doubleSided": double_sided,
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 250 } },
        }],
        "meshes": [{ "primitives": [square] }],
        "nodes": [{ "mesh": 0, "scale": scale }],
    });
    scene(entries, &buffer)
}

#[test]
fn an_emitting_surface_has_its_luminance_from_the_sides_it_shows() {
    let expected = 250.0 * (0.2126 + 0.5 * 0.7152 + 0.25 * 0.0722);
    // The front looks along −y.
    let (front, back) = (Vector::new(0.0, 1.0, 0.0), Vector::new(0.0, -1.0, 0.0));
    for (mirror, double_sided) in [(1.0, false), (-1.0, false), (1.0, true)] {
        let scale = [mirror, 1.0, 1.0];
        let from = |y| Point::new(0.5 * mirror, y, 0.5);
        let seen = |origin, direction| luminance(lamp(double_sided, scale), origin, direction);
        assert_close(seen(from(-2.0), front), expected);
        let behind = if double_sided { expected } else { 0.0 };
        assert_close(seen(from(2.0), back), behind);
    }
}
