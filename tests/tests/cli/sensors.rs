//! Kinds of sensors against closed forms, from the scene file to the report.

use std::f64::consts::PI;

use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

fn measured(scene: &str) -> Value {
    let folder = Folder::new();
    let scene = folder.write("scene.toml", scene);
    let arguments = ["measure", &scene, "--samples", "4096", "--format", "json"];
    serde_json::from_str(&steradian(&arguments).fine()).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} of {value}"))
}

fn value_of(result: &Value, sensor: &str) -> Value {
    let mut readings = result["readings"].as_array().unwrap().iter();
    let found = readings.find(|reading| reading["sensor"] == sensor);
    found.unwrap_or_else(|| panic!("no {sensor}")).clone()
}

const CYLINDERS: &str = r#"
[[sensors]]
name = "whole"
kind = "cylindrical-illuminance"
points = [[0, 0, 0]]

[[sensors]]
name = "facing it"
kind = "semicylindrical-illuminance"
points = [[0, 0, 0]]
facing = [1, 0, 0]

[[sensors]]
name = "sideways"
kind = "semicylindrical-illuminance"
points = [[0, 0, 0]]
facing = [0, 1, 0]

[[sensors]]
name = "turned away"
kind = "semicylindrical-illuminance"
points = [[0, 0, 0]]
facing = [-1, 0, 0]

[[sensors]]
name = "lying"
kind = "cylindrical-illuminance"
points = [[0, 0, 0]]
axis = [0.6, 0, 0.8]
"#;

/// A lamp of I at (3, 0, 4) m, r = 5 m: I/r² = 100 lx and sinε = .6; the axis (.6, 0, .8) points at it.
fn assert_as_of_a_lamp(result: &Value, tolerance: f64) {
    let e = 100.0 * 0.6 / PI;
    for (sensor, expected) in [
        ("whole", e),
        ("facing it", 2.0 * e),
        ("sideways", e),
        ("turned away", 0.0),
        ("lying", 0.0),
    ] {
        let reading = value_of(result, sensor);
        let off = (number(&reading, "value") - expected).abs();
        assert!(off <= tolerance * e, "{sensor}: {reading}");
    }
}

#[test]
fn cylinders_see_a_lamp_exactly() {
    let lamp = "[[lights]]\nkind = \"point\"\nposition = [3, 0, 4]\nintensity = \"2500 cd\"\n";
    let result = measured(&format!("{lamp}{CYLINDERS}"));
    assert_as_of_a_lamp(&result, 1e-12);
    let whole = value_of(&result, "whole");
    assert_eq!(
        (&whole["method"], &whole["quantity"]),
        (&"closed-form".into(), &"cylindrical illuminance".into())
    );
    assert_eq!(
        value_of(&result, "sideways")["quantity"],
        "semicylindrical illuminance"
    );
}

/// The same lamp as a sphere of 5 cm and 2500 cd: its light comes from within .01 rad, which makes the sine on its axis up to .01 and
/// changes the others by 1e-4; the sampling error is below .5 %.
#[test]
fn cylinders_see_a_lamp_with_extent() {
    let flux = 4.0 * PI * 2500.0;
    let lamp = format!(
        "[[shapes]]\nkind = \"sphere\"\ncenter = [3, 0, 4]\nradius = 0.05\nemission = {{ flux = \"{flux} lm\" }}\n"
    );
    assert_as_of_a_lamp(&measured(&format!("{lamp}{CYLINDERS}")), 0.02);
}

/// L = 1 from everywhere: (1/π) ∫ sinε dω = 2 ∫ sin²ε dε = π. Each path carries π L; what is left is single precision.
#[test]
fn cylinders_under_constant_radiance_read_pi_times_it() {
    let sky = "[[lights]]\nkind = \"environment\"\nradiance = \"1 cd/m2\"\n";
    let result = measured(&format!("{sky}{CYLINDERS}"));
    for sensor in ["whole", "facing it", "turned away", "lying"] {
        let found = number(&value_of(&result, sensor), "value");
        assert!((found / PI - 1.0).abs() < 1e-5, "{sensor}: {found}");
    }
}

/// 9 m x 7 m less 0.5 m all around: 8 m x 6 m, p = .2 · 5^(log₁₀ 8) = .8556 m, 10 x 8 points.
#[test]
fn a_grid_has_as_many_points_as_its_area_needs() {
    let scene = r#"
[[lights]]
kind = "point"
position = [4.5, 3.5, 3]
intensity = "100 cd"

[[sensors]]
name = "desks"
kind = "illuminance"
grid = { origin = [0, 0, 0.8], edges = [[9, 0, 0], [0, 7, 0]], spacing = "en12464", border = "50 cm" }

[[sensors]]
name = "faces"
kind = "cylindrical-illuminance"
grid = { origin = [0, 0, 1.2], edges = [[9, 0, 0], [0, 7, 0]], spacing = "en12464", border = 0.5 }
"#;
    let result = measured(scene);
    for (number_of, name) in [(0, "desks"), (1, "faces")] {
        let grid = &result["grids"][number_of];
        assert_eq!(
            (&grid["sensor"], &grid["count"]),
            (&name.into(), &serde_json::json!([10, 8]))
        );
        assert!((number(&grid["greatest_spacing"], "value") - 0.8556).abs() < 1e-4);
        assert_eq!(result["statistics"][number_of]["points"], 80);
    }
    let first = value_of(&result, "desks");
    assert_eq!(first["position"], serde_json::json!([0.9, 0.875, 0.8]));
    let folder = Folder::new();
    let scene_text = scene;
    let scene = folder.write("scene.toml", scene);
    let text = steradian(&["measure", &scene]).fine();
    let note = "desks: 10 x 8 points, 0.8 m x 0.75 m apart; EN 12464-1 asks for 0.856 m at most.";
    assert!(text.contains(note), "{text}");
    let unfit = folder.write("unfit.toml", &scene_text.replace("[9, 0, 0]", "[1, 0, 0]"));
    let message = steradian(&["measure", &unfit]).error();
    assert!(
        message.contains("a border of 0.5 m leaves nothing of a side of 1 m"),
        "{message}"
    );
}
