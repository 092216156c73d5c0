//! `form-factor`: every case of the table, the catalogue, and what is refused.

use serde_json::{Map, Value};
use steradian_tests::command::steradian;

/// A case of the table, as arguments of the command.
struct Case {
    id: String,
    params: Map<String, Value>,
    expect: Map<String, Value>,
    error: f64,
}

fn cases() -> Vec<Case> {
    let table = include_str!("../../data/cases/form-factor.json");
    let table: Value = serde_json::from_str(table).unwrap();
    let case = |case: &Value| Case {
        id: case["id"].as_str().unwrap().to_owned(),
        params: case["params"].as_object().unwrap().clone(),
        expect: case["expect"].as_object().unwrap().clone(),
        error: case["reference_rel_error"].as_f64().unwrap(),
    };
    table["cases"]
        .as_array()
        .unwrap()
        .iter()
        .map(case)
        .collect()
}

impl Case {
    fn text(&self, key: &str) -> String {
        joined(&self.params[key])
    }

    /// The arguments of the command and the names of its factors beside those of the case.
    fn arguments(&self) -> Vec<String> {
        let text = |key: &str| self.text(key);
        let element = || {
            vec![
                "--element".to_owned(),
                format!("{},{}", text("point"), text("normal")),
            ]
        };
        let (from, to) = match self.id.split('/').nth(1).unwrap() {
            "element_to_sphere" => (
                element(),
                vec![
                    "--sphere2".to_owned(),
                    format!("{},{}", text("centre"), text("radius")),
                ],
            ),
            "element_to_disc_on_axis"
            | "element_to_parallel_disc_offset"
            | "element_to_perpendicular_disc" => {
                let disc = format!("{},{},{}", text("centre"), text("axis"), text("radius"));
                (
                    element(),
                    vec!["--disc2".to_owned(), disc, "--two-sided".to_owned()],
                )
            }
            kind if kind.starts_with("element_to_") => (
                element(),
                vec![
                    "--polygon2".to_owned(),
                    text("vertices"),
                    "--two-sided".to_owned(),
                ],
            ),
            "coaxial_parallel_discs" => {
                let disc = |index, axis| {
                    format!(
                        "{},{axis},{}",
                        text(&format!("centre{index}")),
                        text(&format!("radius{index}"))
                    )
                };
                (
                    vec!["--disc1".to_owned(), disc(1, "0,0,1")],
                    vec!["--disc2".to_owned(), disc(2, "0,0,-1")],
                )
            }
            "sphere_to_coaxial_disc" => {
                let sphere = format!("{},{}", text("sphere_centre"), text("sphere_radius"));
                let disc = format!(
                    "{},{},{}",
                    text("disc_centre"),
                    text("disc_axis"),
                    text("disc_radius")
                );
                (
                    vec!["--sphere1".to_owned(), sphere],
                    vec!["--disc2".to_owned(), disc],
                )
            }
            "polygon_pair" => (
                vec!["--polygon1".to_owned(), text("poly1")],
                vec!["--polygon2".to_owned(), text("poly2")],
            ),
            kind if kind.contains("rectangles") => (
                vec!["--polygon1".to_owned(), text("rect1")],
                vec!["--polygon2".to_owned(), text("rect2")],
            ),
            kind => (vec!["--known".to_owned()], self.known(kind)),
        };
        let end = ["--format", "json"].map(str::to_owned);
        [vec!["form-factor".to_owned()], from, to, end.to_vec()].concat()
    }

    fn known(&self, kind: &str) -> Vec<String> {
        let text = |key: &str| self.text(key);
        let words = match kind {
            "infinite_wedge_equal_plates" => {
                format!("wedge width1=1 width2=1 angle={}deg", text("angle_deg"))
            }
            "infinite_parallel_strips" => format!(
                "parallel-strips width={} distance={}",
                text("width"),
                text("distance")
            ),
            "concentric_cylinders_equal_length" => {
                let radii = format!(
                    "inner={} outer={}",
                    text("inner_radius"),
                    text("outer_radius")
                );
                format!("concentric-cylinders {radii} length={}", text("length"))
            }
            "closed_cylinder" => format!(
                "closed-cylinder radius={} height={}",
                text("radius"),
                text("height")
            ),
            "spherical_cap_to_itself" => {
                format!("spherical-cap half_angle={}deg", text("half_angle_deg"))
            }
            _ => panic!("no command for {}", self.id),
        };
        words.split(' ').map(str::to_owned).collect()
    }
}

/// Numbers with commas, points with spaces.
fn joined(value: &Value) -> String {
    let Value::Array(parts) = value else {
        return value.to_string();
    };
    let separator = if parts[0].is_array() { " " } else { "," };
    parts.iter().map(joined).collect::<Vec<_>>().join(separator)
}

fn json(arguments: &[&str]) -> Value {
    let arguments = [&["form-factor"], arguments, &["--format", "json"]].concat();
    serde_json::from_str(&steradian(&arguments).fine()).unwrap()
}

/// `F_outer_to_inner` is `outer to inner`.
fn found(output: &Value, name: &str) -> f64 {
    let name = match name {
        "value" => return output["value"].as_f64().unwrap(),
        "F_outer_to_both_end_rings" => "outer to ends".to_owned(),
        "F_inner_to_both_end_rings" => "inner to ends".to_owned(),
        other => other.trim_start_matches("F_").replace('_', " "),
    };
    output["factors"][name.as_str()]["value"]
        .as_f64()
        .unwrap_or_else(|| panic!("no {name} in {output}"))
}

#[test]
fn every_case_of_the_table_within_its_error() {
    let mut worst = (0.0, String::new());
    for case in cases() {
        let arguments = case.arguments();
        let output = steradian(&arguments.iter().map(String::as_str).collect::<Vec<_>>()).fine();
        let output: Value = serde_json::from_str(&output).unwrap();
        for (name, expected) in &case.expect {
            let (found, expected) = (found(&output, name), expected.as_f64().unwrap());
            let error = if expected == 0.0 {
                found.abs()
            } else {
                (found / expected - 1.0).abs()
            };
            assert!(
                error <= case.error.max(1e-9),
                "{}: {name} is {found} instead of {expected}",
                case.id
            );
            if case.error <= 1e-9 && error > worst.0 {
                worst = (error, case.id.clone());
            }
        }
    }
    println!("worst relative error {:.1e} in {}", worst.0, worst.1);
}

#[test]
fn a_pair_has_its_reverse_and_areas() {
    let floor = "0,0,0 2,0,0 2,1,0 0,1,0";
    let output = json(&["--polygon1", floor, "--disc2", "0.5,0.5,1,0.1,0,-1,0.4"]);
    let [value, back] =
        [&output["value"], &output["reverse"]["value"]].map(|value| value.as_f64().unwrap());
    let [first, second] = [0, 1].map(|index| output["areas"][index]["value"].as_f64().unwrap());
    assert_eq!(first, 2.0);
    assert!((first * value - second * back).abs() < 1e-15);
    assert_eq!(output["method"], "quadrature");
    let error = output["std_error"].as_f64().unwrap();
    assert!(error > 0.0 && error < 1e-8 * value, "{output}");
    // Facing away, it gets nothing; with both sides, the same.
    let away = ["--polygon1", floor, "--disc2", "0.5,0.5,1,-0.1,0,1,0.4"];
    assert_eq!(json(&away)["value"], 0.0);
    let both = json(&[&away[..], &["--two-sided"]].concat())["value"]
        .as_f64()
        .unwrap();
    assert!((both - value).abs() < 1e-8 * value);
}

#[test]
fn tables_name_every_factor() {
    let list = steradian(&["form-factor", "--known", "list"]).fine();
    assert!(
        list.contains("concentric-cylinders") && list.contains("half_angle="),
        "{list}"
    );
    let table = steradian(&[
        "form-factor",
        "--known",
        "closed-cylinder",
        "radius=1",
        "height=1",
    ])
    .fine();
    assert!(
        table.contains("end to side      0.6180339887  closed-form"),
        "{table}"
    );
}

#[test]
fn bad_surfaces_and_sizes_are_told() {
    let error = |arguments: &[&str]| steradian(&[&["form-factor"], arguments].concat()).error();
    let floor = "0,0,0 1,0,0 1,1,0 0,1,0";
    assert!(error(&["--polygon1", floor]).contains("--polygon2"));
    assert!(
        error(&[
            "--polygon1",
            "0,0,0 1,1,0 1,0,0 0,1,0",
            "--sphere2",
            "0,0,2,1"
        ])
        .contains("no area")
    );
    assert!(
        error(&["--polygon1", "0,0,0 1,0,0 2,0,0", "--sphere2", "0,0,2,1"]).contains("no area")
    );
    assert!(error(&["--polygon1", floor, "--sphere2", "0,0,0.5,1"]).contains("intersects"));
    assert!(error(&["--element", "0,0,0,0,0,0", "--sphere2", "0,0,2,1"]).contains("no direction"));
    assert!(error(&["--known", "cube"]).contains("--known list"));
    assert!(
        error(&["--known", "wedge", "width1=1"]).contains("wedge needs width1=, width2=, angle=")
    );
    assert!(error(&["--known", "wedge", "width1=1", "width2=1", "angle=30"]).contains("unit"));
    assert!(
        error(&[
            "--known",
            "coaxial-discs",
            "radius1=-1",
            "radius2=1",
            "distance=1"
        ])
        .contains("must be positive")
    );
}
