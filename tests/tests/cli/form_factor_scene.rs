//! `form-factor` of scenes.

use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

/// A room of 2 m × 2 m × 2 m with a block in it, as polygons of an OBJ file; the room faces inwards.
fn room(folder: &Folder) -> String {
    let mut text = String::new();
    for (low, high) in [([0.0; 3], [2.0; 3]), ([0.5, 0.6, 0.3], [1.2, 1.4, 1.1])] {
        for corner in 0..8 {
            let at = |axis: usize| {
                if corner >> axis & 1 == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            };
            text += &format!("v {} {} {}\n", at(0), at(1), at(2));
        }
    }
    for quad in [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ] {
        let [a, b, c, d] = quad.map(|corner| corner + 1);
        text += &format!("f {d} {c} {b} {a}\n");
        let [a, b, c, d] = quad.map(|corner| corner + 9);
        text += &format!("f {a} {b} {c} {d}\n");
    }
    folder.write("room.obj", &text)
}

#[test]
fn the_matrix_of_a_mesh_is_closed_within_its_errors() {
    let folder = Folder::new();
    let room = room(&folder);
    let run = |more: &[&str]| steradian(&[&["form-factor", &room], more].concat());
    let table = run(&["--rel-error", "5%"]).fine();
    assert!(
        table.contains("12 surfaces") && table.contains("; explained by its error"),
        "{table}"
    );
    let json = run(&["--rel-error", "5%", "--format", "json"]).fine();
    let object: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(object["rows"].as_array().unwrap().len(), 12);
    let smooth = run(&["--rel-error", "5%", "--smooth", "--format", "json"]).fine();
    let object: Value = serde_json::from_str(&smooth).unwrap();
    for row in object["rows"].as_array().unwrap() {
        assert!(
            (row["sum"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-11,
            "{row}"
        );
    }
}

#[test]
fn rows_go_to_files_by_their_ending() {
    let folder = Folder::new();
    let room = room(&folder);
    let [csv, npz, svg] = ["m.csv", "m.npz", "m.svg"].map(|name| folder.path(name));
    for threads in ["1", "3"] {
        steradian(&[
            "form-factor",
            &room,
            "--samples",
            "64",
            "-o",
            &csv,
            "--threads",
            threads,
        ])
        .fine();
    }
    let text = std::fs::read_to_string(&csv).unwrap();
    assert!(text.starts_with("from,to,") && text.lines().count() > 60);
    steradian(&[
        "form-factor",
        &room,
        "--samples",
        "64",
        "-o",
        &npz,
        "--plot",
        &svg,
    ])
    .fine();
    assert!(std::fs::read(&npz).unwrap().starts_with(b"PK"));
    assert!(std::fs::read_to_string(&svg).unwrap().contains("log10 F"));
}

#[test]
fn one_temperature_exchanges_nothing() {
    let folder = Folder::new();
    let room = room(&folder);
    let boundary = folder.write("b.csv", "surface,emissivity,temperature\n*,0.8,300\n");
    let arguments = [
        "form-factor",
        &room,
        "--rel-error",
        "5%",
        "--exchange",
        &boundary,
    ];
    let json = steradian(&[&arguments[..], &["--format", "json"]].concat()).fine();
    let object: Value = serde_json::from_str(&json).unwrap();
    for surface in object["surfaces"].as_array().unwrap() {
        assert!(
            surface["net_flux"]["value"].as_f64().unwrap().abs() < 1e-9,
            "{surface}"
        );
    }
}

#[test]
fn what_cannot_be_is_told() {
    let error = |arguments: &[&str]| steradian(&[&["form-factor"], arguments].concat()).error();
    assert!(error(&["scenes/cornell-box.toml", "--format", "npz"]).contains("-o FILE.npz"));
    let open = error(&[
        "scenes/cornell-box.toml",
        "--samples",
        "16",
        "--smooth",
        "--format",
        "csv",
        "-o",
        "/dev/null/x",
    ]);
    assert!(open.contains("cannot write"), "{open}");
}

/// The block is in full view of the corner, and the factors of one pair are those of the matrix within their errors.
#[test]
fn two_surfaces_and_an_element_are_asked_for_by_themselves() {
    let folder = Folder::new();
    let room = room(&folder);
    let run =
        |more: &[&str]| steradian(&[&["form-factor", &room, "--rel-error", "5%"], more].concat());
    let names = run(&["--format", "csv"]).fine();
    let first = names.lines().nth(1).unwrap();
    let columns: Vec<&str> = first
        .split(',')
        .map(|text| text.trim_matches('"'))
        .collect();
    let pair = run(&["--between", columns[2], columns[3], "--format", "csv"]).fine();
    let value: f64 = pair
        .lines()
        .nth(1)
        .unwrap()
        .split(',')
        .nth(4)
        .unwrap()
        .parse()
        .unwrap();
    let expected: f64 = columns[4].parse().unwrap();
    assert!((value / expected - 1.0).abs() < 0.1, "{value} {expected}");
    assert!(
        run(&["--between", "nobody", columns[3]])
            .error()
            .contains("no surface is called `nobody`")
    );
    let json = run(&[
        "--element",
        "0.1,0.1,0,0,0,1",
        "--by",
        "object",
        "--format",
        "json",
    ])
    .fine();
    let object: Value = serde_json::from_str(&json).unwrap();
    let factors = object["factors"].as_array().unwrap();
    let sum: f64 = factors
        .iter()
        .map(|factor| factor["value"].as_f64().unwrap())
        .sum();
    assert!((sum - 1.0).abs() < 0.05, "{json}");
    let png = folder.path("m.png");
    run(&["--matrix", "--plot", &png]).fine();
    assert!(std::fs::read(&png).unwrap().starts_with(b"\x89PNG"));
}
