//! Results read back: the same numbers again, and clear words about other files.

use steradian_tests::command::{Folder, steradian};

/// A result of the furnace, in which everything is sampled.
fn furnace(folder: &Folder) -> String {
    let result = folder.path("furnace.json");
    let scene = "scenes/furnace.toml";
    steradian(&["measure", scene, "--samples", "4096", "-o", &result]).fine();
    result
}

#[test]
fn a_result_prints_as_the_run_did() {
    let folder = Folder::new();
    let result = furnace(&folder);
    for format in ["table", "csv", "json"] {
        let again = steradian(&["measure", &result, "--format", format]).fine();
        let scene = ["measure", "scenes/furnace.toml", "--samples", "4096"];
        let first = steradian(&[&scene[..], &["--format", format]].concat()).fine();
        assert_eq!(again, first);
    }
}

#[test]
fn sensors_are_chosen_from_a_result() {
    let folder = Folder::new();
    let result = furnace(&folder);
    let chosen = ["--sensor", "scalar irradiance", "--format", "csv"];
    let text = steradian(&[&["measure", &result], &chosen[..]].concat()).fine();
    assert!(
        text.lines()
            .skip(1)
            .all(|line| line.starts_with("scalar irradiance,"))
    );
    let message = steradian(&["measure", &result, "--sensor", "desk"]).error();
    assert!(
        message.contains("there is no sensor `desk`; the result has `"),
        "{message}"
    );
}

/// At noon both lamps give 50 lx, as the header of the scene derives.
#[test]
fn a_result_is_read_at_another_time() {
    let folder = Folder::new();
    let result = folder.path("day.json");
    steradian(&["measure", "scenes/working-day.toml", "-o", &result]).fine();
    let noon = steradian(&["measure", &result, "--at", "12h", "--format", "csv"]).fine();
    let value = noon.lines().nth(1).and_then(|line| line.split(',').nth(10));
    let value: f64 = value.unwrap().parse().unwrap();
    assert!((value / 100.0 - 1.0).abs() < 1e-12, "{noon}");
}

#[test]
fn what_needs_the_scene_is_refused() {
    let folder = Folder::new();
    let result = furnace(&folder);
    for (flag, value) in [("--samples", "10"), ("--rel-error", "1%"), ("--seed", "3")] {
        let message = steradian(&["measure", &result, flag, value]).error();
        assert!(
            message.contains(&format!("{flag} needs the scene")),
            "{message}"
        );
    }
}

#[test]
fn other_json_is_told() {
    let folder = Folder::new();
    let other = folder.write("other.json", "{\n  \"asset\": 3\n");
    let message = steradian(&["measure", &other]).error();
    assert!(
        message.contains("other.json:3:0: the file ends too soon"),
        "{message}"
    );
    let other = folder.write("other.json", "{ \"asset\": 3 }");
    let message = steradian(&["measure", &other]).error();
    assert!(message.contains("it has no \"schema\""), "{message}");
}
