//! Light groups dimmed, switched and solved for from a result, against runs of scenes whose lights are so dimmed.

use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

/// A grey room with a lamp and a window, both with extent, and a shelf that hides a part of them from some points.
fn room(lamp: f64, window: f64) -> String {
    format!(
        r##"
[materials.wall]
model = "lambertian"
reflectance = 0.5

[[shapes]]
name = "room"
kind = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
inside = true
material = "wall"

[[shapes]]
kind = "rectangle"
origin = [1, 1, 1.5]
edges = [[0.5, 0, 0], [0, 0.5, 0]]
material = "wall"

[[shapes]]
kind = "rectangle"
origin = [1.5, 1, 2.45]
edges = [[0, 1, 0], [1, 0, 0]]
material = "wall"
emission = {{ flux = "{} lm", group = "lamp" }}

[[shapes]]
kind = "rectangle"
origin = [0.05, 1, 1]
edges = [[0, 1, 0], [0, 0, 1]]
material = "wall"
emission = {{ flux = "{} lm", group = "window" }}

[[sensors]]
name = "desk"
kind = "illuminance"
grid = {{ origin = [0.5, 0.5, 0.8], edges = [[3, 0, 0], [0, 2, 0]], count = [3, 2] }}
"##,
        2000.0 * lamp,
        3000.0 * window
    )
}

fn measured(arguments: &[&str]) -> Value {
    let arguments = [&["measure"], arguments, &["--format", "json"]].concat();
    serde_json::from_str(&steradian(&arguments).fine()).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} of {value}"))
}

/// Of independent estimates with these errors fewer than one in 1e6 are so far apart, even by Student's t with 15 degrees of freedom (8.0).
fn assert_agree(a: &Value, b: &Value) {
    let [a_error, b_error] = [a, b].map(|value| number(value, "std_error"));
    let errors = (a_error * a_error + b_error * b_error).sqrt();
    let apart = (number(a, "value") - number(b, "value")).abs();
    assert!(apart <= 8.0 * errors, "{a}\n{b}");
    assert!(errors < 0.02 * number(a, "value"), "{a}");
}

fn readings(result: &Value) -> &Vec<Value> {
    result["readings"].as_array().unwrap()
}

/// The result of the room with all its light.
fn result_of_room(folder: &Folder) -> String {
    let scene = folder.write("room.toml", &room(1.0, 1.0));
    let result = folder.path("room.json");
    steradian(&["measure", &scene, "--samples", "2048", "-o", &result]).fine();
    result
}

#[test]
fn relit_readings_agree_with_a_run_of_dimmed_lights() {
    let folder = Folder::new();
    let result = result_of_room(&folder);
    let dimmed = folder.write("dimmed.toml", &room(0.4, 1.5));
    let run = measured(&[&dimmed, "--samples", "2048", "--seed", "7"]);
    let relit = measured(&[&result, "--relight", "lamp=40%,window=1.5"]);
    for (relit, run) in readings(&relit).iter().zip(readings(&run)) {
        assert_agree(relit, run);
        assert_agree(&relit["groups"]["window"], &run["groups"]["window"]);
    }
    assert_agree(
        &relit["statistics"][0]["mean"],
        &run["statistics"][0]["mean"],
    );
    assert_eq!(relit["relit"]["lamp"], 0.4);
    // Switched off and on again by a second factor of zero there is nothing left.
    let dark = measured(&[&result, "--relight", "lamp=off,window=off"]);
    assert!(
        readings(&dark)
            .iter()
            .all(|reading| number(reading, "value") == 0.0)
    );
}

#[test]
fn relit_results_are_results_and_factors_multiply() {
    let folder = Folder::new();
    let result = result_of_room(&folder);
    let half = folder.path("half.json");
    steradian(&["measure", &result, "--relight", "lamp=50%", "-o", &half]).fine();
    let twice = measured(&[&half, "--relight", "lamp=50%"]);
    let once = measured(&[&result, "--relight", "lamp=0.25"]);
    assert_eq!(readings(&twice), readings(&once));
    assert_eq!(twice["relit"]["lamp"], 0.25);
    let text = steradian(&["measure", &half]).fine();
    assert!(
        text.contains("Relit from the result of a run: lamp at 50 %."),
        "{text}"
    );
    let scene = folder.path("room.toml");
    let at_once = measured(&[&scene, "--samples", "2048", "--relight", "lamp=25%"]);
    assert_eq!(readings(&at_once), readings(&once));
}

/// 200 lx and 50 lx, by a closed form each; here in two groups.
#[test]
fn closed_forms_stay_exact() {
    let folder = Folder::new();
    let lamp = |group: &str, height: f64, candela: f64| {
        format!(
            "[[lights]]\nkind = \"point\"\ngroup = \"{group}\"\nposition = [0, 0, {height}]\nintensity = \"{candela} cd\"\n"
        )
    };
    let meter =
        "[[sensors]]\nname = \"desk\"\nkind = \"illuminance\"\npoints = [[0, 0, 0, 0, 0, 1]]\n";
    let scene = [
        lamp("a", 2.0, 800.0),
        lamp("b", 3.0, 450.0),
        meter.to_owned(),
    ]
    .concat();
    let scene = folder.write("two.toml", &scene);
    let relit = measured(&[&scene, "--relight", "a=10%,b=2"]);
    let reading = &readings(&relit)[0];
    assert!((number(reading, "value") - 120.0).abs() < 1e-9);
    assert_eq!(
        (number(reading, "std_error"), &reading["method"]),
        (0.0, &"closed-form".into())
    );
    let solved = measured(&[&scene, "--solve", "desk[0] = 125 lx", "--vary", "a"]);
    assert!((number(&solved["factors"][0], "value") - 0.375).abs() < 1e-9);
    assert_eq!(solved["factors"][0]["method"], "closed-form");
}

#[test]
fn solved_factors_agree_with_a_run_of_lights_so_dimmed() {
    let folder = Folder::new();
    let result = result_of_room(&folder);
    let targets = [
        "--solve",
        "desk: mean = 100 lx",
        "--solve",
        "desk[5] = 80 lx",
    ];
    let solved = measured(
        &[
            &[&result[..]],
            &targets[..],
            &["--vary", "lamp=0..2,window=0..2"],
        ]
        .concat(),
    );
    let factor = |index: usize| number(&solved["factors"][index], "value");
    assert!(
        solved["factors"]
            .as_array()
            .unwrap()
            .iter()
            .all(|factor| number(factor, "std_error") > 0.0)
    );
    let dimmed = folder.write("dimmed.toml", &room(factor(0), factor(1)));
    let run = measured(&[&dimmed, "--samples", "2048", "--seed", "7"]);
    assert_agree(&solved["targets"][0], &run["statistics"][0]["mean"]);
    assert_agree(&solved["targets"][1], &readings(&run)[5]);
    for target in solved["targets"].as_array().unwrap() {
        assert!(
            (number(target, "value") / number(target, "wanted") - 1.0).abs() < 1e-9,
            "{target}"
        );
    }
    // What the answer suggests gives what it promises.
    let relit = measured(&[&result, "--relight", solved["relight"].as_str().unwrap()]);
    assert!((number(&relit["statistics"][0]["mean"], "value") - 100.0).abs() < 1e-6);
}

#[test]
fn a_target_out_of_reach_is_exit_status_1() {
    let folder = Folder::new();
    let result = result_of_room(&folder);
    let ran = steradian(&[
        "measure",
        &result,
        "--solve",
        "desk: mean = 9 klx",
        "--vary",
        "lamp",
    ]);
    assert_eq!(ran.status(), 1);
    let text = ran.stdout();
    for part in ["held at 1", "not met", "Not every target can be met"] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

#[test]
fn wrong_names_and_units_are_told() {
    let folder = Folder::new();
    let result = result_of_room(&folder);
    let refusal =
        |arguments: &[&str]| steradian(&[&["measure", &result], arguments].concat()).error();
    for (arguments, expected) in [
        (
            &["--relight", "lmap=off"][..],
            "did you mean `lamp`? (there is `lamp`, `window`)",
        ),
        (&["--relight", "lamp"], "such as desk=50%,window=off"),
        (
            &["--solve", "dsk: mean = 5 lx", "--vary", "lamp"],
            "no sensor `dsk`; did you mean `desk`?",
        ),
        (
            &["--solve", "desk: mean = 5 W", "--vary", "lamp"],
            "reads in lx; `5 W` is no such quantity",
        ),
        (
            &["--solve", "desk: mean = 5 lx", "--vary", "lamp,window"],
            "leave a choice",
        ),
        (
            &["--solve", "desk[6] = 5 lx", "--vary", "lamp"],
            "has no such point; the last one is 5",
        ),
        (&["--solve", "desk: mean = 5 lx"], "--vary"),
    ] {
        let message = refusal(arguments);
        assert!(
            message.contains(expected),
            "{expected} is not in\n{message}"
        );
    }
}
