//! What `measure` and `verify` print.

use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&steradian(arguments).fine()).unwrap()
}

fn reading<'a>(result: &'a Value, sensor: &str, index: u64, quantity: &str) -> &'a Value {
    let readings = result["readings"].as_array().unwrap().iter();
    let is_wanted =
        |r: &&Value| r["sensor"] == sensor && r["index"] == index && r["quantity"] == quantity;
    readings.into_iter().find(is_wanted).unwrap()
}

#[test]
fn a_point_light_is_measured_exactly() {
    let result = json(&["measure", "scenes/point-light.toml", "--format", "json"]);
    let close =
        |value: &Value, expected: f64| (value.as_f64().unwrap() / expected - 1.0).abs() < 1e-9;
    assert!(close(
        &reading(&result, "points", 0, "irradiance")["value"],
        100.0
    ));
    assert!(close(
        &reading(&result, "points", 1, "irradiance")["value"],
        50.0 / 2.0_f64.sqrt()
    ));
    let square = reading(&result, "square", 0, "flux");
    let expected = 4.0 * std::f64::consts::PI / 6.0 * 100.0;
    let allowed = 4.0 * square["std_error"].as_f64().unwrap() + 1e-6 * expected;
    assert!(
        (square["value"].as_f64().unwrap() - expected).abs() <= allowed,
        "{square}"
    );
}

#[test]
fn json_has_every_key_of_the_format() {
    let result = json(&[
        "measure",
        "scenes/closed-room.toml",
        "--rel-error",
        "5%",
        "--format",
        "json",
    ]);
    assert_eq!(result["schema"], "steradian.result/1");
    for key in [
        "version",
        "scene_hash",
        "seed",
        "luminous_efficacy",
        "complete",
        "converged",
        "unsampled",
        "warnings",
        "stored",
    ] {
        assert!(result.get(key).is_some(), "{key}");
    }
    assert_eq!(
        (&result["complete"], &result["converged"]),
        (&Value::Bool(true), &Value::Bool(true))
    );
    let reading = reading(&result, "arriving", 0, "luminous flux");
    let keys = [
        "sensor",
        "index",
        "position",
        "normal",
        "quantity",
        "unit",
        "value",
        "std_error",
        "confidence_interval",
    ];
    let more = [
        "samples",
        "converged",
        "method",
        "channels",
        "groups",
        "upper_bound",
        "sits_on",
    ];
    for key in keys.iter().chain(&more) {
        assert!(reading.get(key).is_some(), "{key}");
    }
    assert_eq!(
        (&reading["unit"], &reading["method"]),
        (&Value::from("lm"), &Value::from("estimate"))
    );
}

#[test]
fn csv_has_its_fixed_columns() {
    let text = steradian(&[
        "measure",
        "scenes/point-light.toml",
        "--sensor",
        "points",
        "--format",
        "csv",
    ])
    .fine();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "sensor,index,x,y,z,nx,ny,nz,quantity,unit,value,std_error,lo,hi,converged"
    );
    assert_eq!(lines.len(), 3);
    assert!(lines.iter().all(|line| line.split(',').count() == 15));
    assert!(lines[1].starts_with("points,0,0.0,0.0,0.0,0.0,0.0,1.0,irradiance,W/m2,"));
}

#[test]
fn the_table_says_what_its_errors_are() {
    let text = steradian(&["measure", "scenes/lamps-equal.toml", "--rel-error", "5%"]).fine();
    for part in [
        "under each",
        " lx",
        "95 %",
        "Sampling error only",
        "Seed 0",
        "rectangle",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

#[test]
fn the_ending_of_the_output_tells_the_format() {
    let folder = Folder::new();
    let file = folder.path("a.json");
    let printed = steradian(&["measure", "scenes/directional.toml", "-o", &file]).fine();
    assert_eq!(printed, "");
    let result: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
    assert_eq!(result["scene"], "Directional light");
    assert_eq!(folder.names(), ["a.json"]);
}

#[test]
fn points_come_from_a_file() {
    let folder = Folder::new();
    let points = folder.write("p.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n0,0,0,0,0,2\n");
    let result = json(&[
        "measure",
        "scenes/point-light.toml",
        "--points",
        &points,
        "--format",
        "json",
    ]);
    let values: Vec<f64> = result["readings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["value"].as_f64().unwrap())
        .collect();
    assert_eq!(values.len(), 2);
    assert!(
        values
            .iter()
            .all(|value| (value / 100.0 - 1.0).abs() < 1e-9)
    );
}

#[test]
fn a_missed_tolerance_is_exit_status_1() {
    let arguments = [
        "measure",
        "scenes/closed-room.toml",
        "--rel-error",
        "1e-7",
        "--time",
        "1 s",
        "--format",
        "json",
    ];
    let ran = steradian(&arguments);
    assert_eq!(ran.status(), 1, "{}", ran.stderr());
    let result: Value = serde_json::from_str(&ran.stdout()).unwrap();
    assert_eq!(result["converged"], false);
}

#[test]
fn an_absolute_tolerance_has_the_unit_of_the_readings() {
    let scene = "scenes/lamps-equal.toml";
    steradian(&[
        "measure",
        scene,
        "--sensor",
        "under each",
        "--abs-error",
        "0.05 lx",
    ])
    .fine();
    let wrong = steradian(&[
        "measure",
        scene,
        "--sensor",
        "under each",
        "--abs-error",
        "0.05 W/m2",
    ])
    .error();
    assert!(
        wrong.contains("--abs-error") && wrong.contains("illuminance"),
        "{wrong}"
    );
    let several = steradian(&["measure", scene, "--abs-error", "0.05 lx"]).error();
    assert!(several.contains("--sensor"), "{several}");
}

#[test]
fn the_program_verifies_itself() {
    let text = steradian(&["verify", "--rel-error", "5%"]).fine();
    assert!(
        text.contains("agree with their closed forms") && !text.contains("FAILED"),
        "{text}"
    );
    for part in [
        "disc off its axis",
        "all walls of a cube",
        "flux of 5 W that decays",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}
