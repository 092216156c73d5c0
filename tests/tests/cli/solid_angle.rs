//! `solid-angle`: every reference case, and what a reader sees.

use serde_json::Value;
use std::f64::consts::PI;
use steradian_tests::command::{Folder, steradian};

fn json(arguments: &[&str]) -> Value {
    let all = [&["solid-angle", "--format", "json"], arguments].concat();
    serde_json::from_str(&steradian(&all).fine()).unwrap()
}

fn value(arguments: &[&str]) -> f64 {
    json(arguments)["value"].as_f64().unwrap()
}

fn assert_close(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} instead of {expected}"
    );
}

fn joined(numbers: &Value) -> String {
    let numbers = numbers.as_array().unwrap();
    numbers
        .iter()
        .map(Value::to_string)
        .collect::<Vec<_>>()
        .join(",")
}

/// The option that gives the object of a case, with its value.
fn object(case: &Value) -> [String; 2] {
    let part = |name: &str| case["params"][name].clone();
    let [option, value] = match case["kind"].as_str().unwrap() {
        "sphere" => [
            "--sphere",
            &format!("{},{}", joined(&part("centre")), part("radius")),
        ],
        "spherical_cap" => ["--cap", &format!("{}deg", part("half_angle_deg"))],
        "disc_on_axis" | "disc_off_axis" => {
            let disc = [
                joined(&part("centre")),
                joined(&part("axis")),
                part("radius").to_string(),
            ];
            ["--disc", &disc.join(",")]
        }
        "box" => [
            "--box",
            &format!("{},{}", joined(&part("min")), joined(&part("max"))),
        ],
        outline => {
            let corners = part("vertices");
            let corners: Vec<String> = corners.as_array().unwrap().iter().map(joined).collect();
            return [format!("--{outline}"), corners.join(" ")];
        }
    };
    [option.to_owned(), value.to_owned()]
}

#[test]
fn every_reference_case_comes_out() {
    let file: Value =
        serde_json::from_str(include_str!("../../data/cases/solid-angle.json")).unwrap();
    let cases = file["cases"].as_array().unwrap();
    let error = |case: &Value| {
        let [option, shape] = object(case);
        let expected = case["expect"]["value"].as_f64().unwrap();
        (value(&["--from", "0,0,0", &option, &shape]) / expected - 1.0).abs()
    };
    let errors: Vec<(f64, &Value)> = cases
        .iter()
        .map(|case| (error(case), &case["id"]))
        .collect();
    let worst = errors.iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    println!(
        "{} cases; the worst, {}, is {:e} off",
        cases.len(),
        worst.1,
        worst.0
    );
    assert_eq!(cases.len(), 31);
    // The references are known to 1e-12.
    assert!(worst.0 <= 1.1e-12, "{worst:?}");
}

#[test]
fn projected_values_stand_beside() {
    let found = json(&["--sphere", "0,0,4,1", "--projected", "0,0,1"]);
    assert_close(
        found["configuration_factor"].as_f64().unwrap(),
        1.0 / 16.0,
        1e-15,
    );
    assert_close(
        found["projected"]["value"].as_f64().unwrap(),
        PI / 16.0,
        1e-15,
    );
    assert_eq!(found["method"], "closed-form");
    // A disc face on: R²/(R² + h²). A cube around nothing but the octant above its corner.
    let disc = json(&["--disc", "0,0,2,0,0,1,1", "--projected", "0,0,1"]);
    assert_close(disc["configuration_factor"].as_f64().unwrap(), 0.2, 1e-14);
    // An ellipse that is a disc; half of the sphere around the horizon; an octant.
    for (option, object, expected) in [
        ("--ellipse", "0,0,2,1,0,0,0,1,0", 0.2),
        ("--cap", "90deg", 1.0),
        ("--cap", "150deg", 1.0),
        ("--patch", "0:90deg,0:90deg", 0.25),
        ("--spherical-polygon", "1,0,0 0,1,0 0,0,1", 0.25),
    ] {
        let found = json(&[option, object, "--projected", "0,0,1"]);
        assert_close(
            found["configuration_factor"].as_f64().unwrap(),
            expected,
            1e-14,
        );
    }
}

#[test]
fn patches_and_outlines_of_directions() {
    assert_close(value(&["--patch", "0:90deg,0:90deg"]), PI / 2.0, 1e-15);
    assert_close(
        value(&["--spherical-polygon", "1,0,0 0,1,0 0,0,1"]),
        PI / 2.0,
        1e-15,
    );
    assert_close(
        value(&["--spherical-polygon", "0,0,1 0,1,0 1,0,0"]),
        3.5 * PI,
        1e-14,
    );
    let ellipse = value(&["--ellipse", "1,0,3,0,2,0,2,0,0"]);
    assert_close(ellipse, value(&["--disc", "1,0,3,0,0,1,2"]), 1e-14);
}

#[test]
fn meshes_from_inside_and_outside() {
    let folder = Folder::new();
    let faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let mesh = folder.write(
        "t.obj",
        &format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n{faces}"),
    );
    assert_close(
        value(&["--mesh", &mesh, "--from", "0.1,0.1,0.1"]),
        4.0 * PI,
        1e-12,
    );
    let front = value(&["--triangle", "1,0,0 0,1,0 0,0,1", "--from", "1,1,1"]);
    assert_close(value(&["--mesh", &mesh, "--from", "1,1,1"]), front, 1e-14);
    let from = ["--from", "1,1,1", "--projected", "-1,-1,-1"];
    let [whole, face] = [["--mesh", &mesh], ["--triangle", "1,0,0 0,1,0 0,0,1"]].map(|object| {
        json(&[&object[..], &from].concat())["projected"]["value"]
            .as_f64()
            .unwrap()
    });
    assert_close(whole, face, 1e-14);
}

#[test]
fn open_and_concave_meshes_are_estimated() {
    let folder = Folder::new();
    let triangle = folder.write("o.obj", "v -1 -1 1\nv 1 -1 1\nv 0 1 1\nf 1 2 3\n");
    // Two triangles that meet in one corner, side by side as seen from below.
    let v = folder.write(
        "v.obj",
        "v 1 -1 0\nv 1 1 0\nv 0 0 1\nv -1 -1 0\nv -1 1 0\nf 1 2 3\nf 5 4 3\n",
    );
    for (mesh, parts) in [
        (triangle, vec!["-1,-1,1 1,-1,1 0,1,1"]),
        (v, vec!["1,-1,0 1,1,0 0,0,1", "-1,1,0 -1,-1,0 0,0,1"]),
    ] {
        let common = ["--from", "0.1,0.2,-2", "--projected", "0,0.1,1"];
        let found = json(&[&["--mesh", &mesh, "--seed", "5"], &common[..]].concat());
        assert_eq!(found["method"], "estimate");
        let exact = parts
            .iter()
            .map(|part| json(&[&["--triangle", *part], &common[..]].concat()));
        let exact: Vec<Value> = exact.collect();
        for path in ["", "/projected"] {
            let number = |object: &Value, key: &str| {
                object
                    .pointer(&format!("{path}/{key}"))
                    .and_then(Value::as_f64)
                    .unwrap()
            };
            let expected: f64 = exact.iter().map(|part| number(part, "value")).sum();
            let z = (number(&found, "value") - expected) / number(&found, "std_error");
            assert!(z.abs() < 4.0, "{path} {z} {found}");
            assert!(number(&found, "std_error") < 5e-4 * expected);
        }
        let picture = folder.path("a.svg");
        let table = steradian(&["solid-angle", "--mesh", &mesh, "--plot", &picture]).fine();
        let svg = std::fs::read_to_string(&picture).unwrap();
        assert!(svg.contains("fill-opacity"), "nothing is drawn");
        assert!(
            table.contains('±') && table.contains("95 % interval"),
            "{table}"
        );
    }
}

#[test]
fn the_small_patch_has_an_error_of_second_order() {
    let rows = json(&["--element", "0,0,2,0,0,-1,0.0001"]);
    let rows = rows["rows"].as_array().unwrap();
    let error = |row: usize| rows[row]["ratio"].as_f64().unwrap() - 1.0;
    // dA/r² over 2π (1 − h/√(h² + R²)) is 1 + ¾ (R/h)² + …
    let ratio = rows[0]["radius_over_distance"].as_f64().unwrap();
    assert_close(error(0) / (ratio * ratio), 0.75, 1e-4);
    assert_close(error(1) / error(0), 4.0, 1e-3);
}

#[test]
fn tilted_to_edge_on_nothing_is_left() {
    let rows = json(&["--disc", "0,0,2,0,0,1,0.5", "--sweep", "tilt", "0:90deg"]);
    let rows = rows["rows"].as_array().unwrap();
    let exact: Vec<f64> = rows
        .iter()
        .map(|row| row["exact"]["value"].as_f64().unwrap())
        .collect();
    assert!(exact.windows(2).all(|pair| pair[1] < pair[0]));
    assert_close(exact[0], value(&["--disc", "0,0,2,0,0,1,0.5"]), 1e-15);
    assert_close(exact[18], 0.0, 1e-15);
}

#[test]
fn pictures_are_drawn() {
    let folder = Folder::new();
    let picture = folder.path("a.svg");
    let text = steradian(&["solid-angle", "--box", "1,-1,-1,3,1,1", "--plot", &picture]).fine();
    assert!(
        text.contains("2.094395102 sr") && text.contains("16.66667 %"),
        "{text}"
    );
    let svg = std::fs::read_to_string(&picture).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains("ω = 2.0944 sr"));
}

#[test]
fn every_kind_of_object_is_drawn() {
    let folder = Folder::new();
    let mesh = folder.write("t.obj", "v -1 -1 3\nv 1 -1 3\nv 0 1 3\nf 1 3 2\n");
    let picture = folder.path("a.svg");
    for [option, object] in [
        ["--sphere", "1,0,3,1"],
        ["--cap", "30deg"],
        ["--cap", "120deg"],
        ["--disc", "1,0,3,0,0,1,1"],
        ["--ellipse", "0,0,2,1,0,0,0,2,0"],
        ["--rectangle", "-1,-1,1 1,-1,1 1,1,1 -1,1,1"],
        ["--triangle", "-1,-1,1 1,-1,1 0,1,1"],
        ["--polygon", "-1,-1,1 1,-1,1 1,1,1 0,0,1 -1,1,1"],
        ["--spherical-polygon", "1,0,0 0,1,0 0,0,1"],
        ["--box", "1,-1,-1,3,1,1"],
        ["--mesh", &mesh],
        ["--patch", "20deg:60deg,0:90deg"],
    ] {
        steradian(&["solid-angle", option, object, "--plot", &picture]).fine();
        let svg = std::fs::read_to_string(&picture).unwrap();
        // Areas are paths of an opacity; each has some length.
        let areas: Vec<&str> = svg
            .split('<')
            .filter(|tag| tag.contains("fill-opacity"))
            .collect();
        assert!(!areas.is_empty(), "{option}: nothing is filled");
        assert!(
            areas
                .iter()
                .all(|tag| tag.len() > 100 && !tag.contains("NaN")),
            "{option}"
        );
        let (open, close) = (svg.matches('<').count(), svg.matches('>').count());
        assert!(
            open == close && svg.trim_end().ends_with("</svg>"),
            "{option}"
        );
    }
}

#[test]
fn bad_objects_are_told() {
    for (arguments, part) in [
        (&["--sphere", "0,0,2,-1"][..], "radius must be positive"),
        (&["--cap", "30"], "no unit"),
        (&["--disc", "0,0,1,0,0,0,1"], "no direction"),
        (&["--rectangle", "0,0,0 1,0,0 1,1,0 0,2,0"], "no rectangle"),
        (&["--polygon", "0,0,1 1,0,1 2,0,1"], "no area"),
        (&["--patch", "90deg:0deg,0:90deg"], "polar angle must rise"),
        (
            &["--sphere", "0,0,2,1", "--cap", "30deg"],
            "cannot be used with",
        ),
        (
            &[],
            "one of --sphere, --cap, --disc, --ellipse, --rectangle, --triangle, --polygon, --spherical-polygon, --box, \
             --mesh, --patch or --element",
        ),
    ] {
        let told = steradian(&[&["solid-angle"], arguments].concat()).error();
        assert!(told.contains(part), "{arguments:?}: {told}");
    }
}
