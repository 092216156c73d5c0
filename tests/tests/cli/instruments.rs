//! `area`, `direction`, `inspect`.

use serde_json::Value;
use std::f64::consts::{FRAC_PI_4, FRAC_PI_6, PI};
use steradian_tests::command::{Folder, steradian};

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&steradian(arguments).fine()).unwrap()
}

fn assert_close(value: &Value, expected: f64, tolerance: f64) {
    let value = value.as_f64().unwrap();
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} instead of {expected}"
    );
}

#[test]
fn angles_become_a_vector_and_come_back() {
    let to = json(&[
        "direction",
        "--theta",
        "30deg",
        "--phi",
        "45deg",
        "--format",
        "json",
    ]);
    let vector: Vec<f64> = to["vector"]
        .as_array()
        .unwrap()
        .iter()
        .map(|part| part.as_f64().unwrap())
        .collect();
    let expected = [0.5 * 0.5_f64.sqrt(), 0.5 * 0.5_f64.sqrt(), 0.75_f64.sqrt()];
    assert!(
        vector
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-15)
    );
    let text = vector
        .iter()
        .map(f64::to_string)
        .collect::<Vec<_>>()
        .join(",");
    let back = json(&["direction", "--vector", &text, "--format", "json"]);
    assert_close(&back["theta"]["value"], FRAC_PI_6, 1e-15);
    assert_close(&back["phi"]["value"], FRAC_PI_4, 1e-15);
}

#[test]
fn a_direction_needs_units_and_a_length() {
    assert!(
        steradian(&["direction", "--theta", "30"])
            .error()
            .contains("no unit")
    );
    assert_eq!(steradian(&["direction", "--vector", "0,0,0"]).status(), 2);
}

#[test]
fn closed_forms_stand_beside_quadrature() {
    let cases: [(&[&str], f64); 5] = [
        (&["rectangle", "2", "50cm"], 1.0),
        (&["disc", "1"], PI),
        (&["disc", "1", "0.5"], 0.75 * PI),
        (&["sphere", "20 cm"], 4.0 * PI * 0.04),
        (&["polygon", "0,0,0", "2,0,0", "2,1,0", "0,1,0"], 2.0),
    ];
    for (shape, expected) in cases {
        let arguments = [
            &["area"],
            shape,
            &["--quadrature", "200", "--format", "json"],
        ]
        .concat();
        let area = &json(&arguments)["shapes"][0];
        assert_close(&area["value"], expected, 1e-12);
        // The middle rule on a sphere is π²/(24 n²) = 1.03e-5 too large.
        assert_close(&area["quadrature"]["value"], expected, 1.1e-5 * expected);
    }
}

#[test]
fn the_area_of_a_mesh_and_of_a_scene() {
    let folder = Folder::new();
    let mesh = folder.write("a.obj", "v 0 0 0\nv 2 0 0\nv 0 3 0\nf 1 2 3\n");
    assert_close(
        &json(&["area", &mesh, "--format", "json"])["shapes"][0]["value"],
        3.0,
        1e-12,
    );
    let room = json(&["area", "scenes/closed-room.toml", "--format", "json"]);
    assert_close(&room["shapes"][0]["value"], 96.0, 1e-9);
}

#[test]
fn a_bad_size_is_told() {
    assert!(
        steradian(&["area", "sphere", "5 kg"])
            .error()
            .contains("5 kg")
    );
    assert!(
        steradian(&["area", "rectangle", "5"])
            .error()
            .contains("width and a height")
    );
    assert!(steradian(&["area", "cube", "5"]).error().contains("cube"));
}

#[test]
fn inspect_lists_what_a_scene_holds() {
    let text = steradian(&["inspect", "scenes/closed-room.toml"]).fine();
    for part in [
        "room", "96", "wall", "0.95", "point", "10000 lm", "arriving",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}
