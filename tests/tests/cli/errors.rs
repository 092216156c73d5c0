//! Bad input: one clear message with place and expectation, several together, exit status 2, no output.

use steradian_tests::command::{Folder, steradian};

const LAMP: &str = "[[lights]]\nkind = \"point\"\nposition = [0, 0, 1]\nintensity = \"100 W/sr\"\n";
const METER: &str =
    "[[sensors]]\nname = \"m\"\nkind = \"irradiance\"\npoints = [[0, 0, 0, 0, 0, 1]]\n";

/// The message about a scene made of these parts; the run must leave no output behind.
fn refusal(parts: &[&str]) -> String {
    let folder = Folder::new();
    let scene = folder.write("bad.toml", &parts.concat());
    let message = steradian(&["measure", &scene, "-o", &folder.path("out.json")]).error();
    assert_eq!(folder.names(), ["bad.toml"]);
    message
}

fn assert_tells(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in\n{message}");
    }
}

#[test]
fn a_missing_file_is_named() {
    assert_tells(
        &steradian(&["measure", "no such scene.toml"]).error(),
        &["no such scene.toml", "cannot read"],
    );
    assert_tells(
        &steradian(&["render", "none.toml", "-o", "x.png"]).error(),
        &["none.toml"],
    );
}

#[test]
fn an_unknown_flag_and_a_bad_value_are_named() {
    assert_tells(
        &steradian(&["measure", "scenes/furnace.toml", "--sampels", "3"]).error(),
        &["--sampels", "--samples"],
    );
    assert_tells(
        &steradian(&["measure", "scenes/furnace.toml", "--time", "5 kg"]).error(),
        &["--time", "5 kg", "8 h"],
    );
    assert_tells(
        &steradian(&[
            "measure",
            "scenes/furnace.toml",
            "--shard",
            "4/3",
            "-o",
            "x",
        ])
        .error(),
        &["2/3"],
    );
    assert_tells(&steradian(&["nonsense"]).error(), &["nonsense"]);
}

#[test]
fn wrong_units_bare_numbers_and_unknown_keys_come_together() {
    let lights = "[[lights]]\nkind = \"point\"\nposition = [0, 0, 1]\nintensity = \"5 kg\"\n\
        [[lights]]\nkind = \"directional\"\ndirection = [0, 0, -1]\nirradiance = 7\nradios = 1\n";
    let message = refusal(&[lights, METER]);
    assert_tells(
        &message,
        &[
            "bad.toml:4:",
            "5 kg",
            "W/sr",
            "bad.toml:8:",
            "W/m2",
            "radios",
        ],
    );
}

#[test]
fn impossible_scenes_are_refused_with_their_place() {
    let shape = |geometry: &str| format!("[[shapes]]\n{geometry}\nmaterial = \"m\"\n");
    let material = "[materials.m]\nmodel = \"lambertian\"\nreflectance = 0.5\n";
    let bent = shape("kind = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[1,1,1],[0,1,0]]");
    assert_tells(
        &refusal(&[material, &bent, LAMP, METER]),
        &["bad.toml:", "plan"],
    );
    let bright = "[materials.m]\nmodel = \"lambertian\"\nreflectance = 1.2\n";
    assert_tells(
        &refusal(&[bright, LAMP, METER]),
        &["bad.toml:3", "1.2", "1"],
    );
    let missing = shape("kind = \"mesh\"\nfile = \"missing.obj\"");
    assert_tells(
        &refusal(&[material, &missing, LAMP, METER]),
        &["missing.obj"],
    );
}

#[test]
fn a_scene_needs_light_and_a_sensor() {
    assert_tells(&refusal(&[METER]), &["light"]);
    assert_tells(&refusal(&[LAMP]), &["sensor"]);
}

#[test]
fn a_sensor_inside_a_solid_is_refused() {
    let ball = "[[shapes]]\nkind = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.5\n";
    assert_tells(&refusal(&[ball, LAMP, METER]), &["sensor", "inside"]);
}

#[test]
fn an_unknown_sensor_is_told_with_those_there_are() {
    let message = steradian(&["measure", "scenes/point-light.toml", "--sensor", "dusk"]).error();
    assert_tells(&message, &["dusk", "desk"]);
}

#[test]
fn the_format_of_a_picture_is_checked_before_it_is_computed() {
    let folder = Folder::new();
    let message = steradian(&[
        "render",
        "scenes/cornell-box.toml",
        "-o",
        &folder.path("a.jpeg"),
    ])
    .error();
    assert_tells(&message, &["a.jpeg", ".exr", ".png"]);
    assert!(folder.names().is_empty());
}

#[test]
fn bad_shards_are_refused() {
    let folder = Folder::new();
    let [one, other, whole] = ["one", "other", "whole.json"].map(|name| folder.path(name));
    let part = |scene: &str, part: &str, file: &str| {
        steradian(&[
            "measure",
            scene,
            "--samples",
            "1024",
            "--shard",
            part,
            "-o",
            file,
        ])
        .fine();
    };
    part("scenes/furnace.toml", "1/2", &one);
    part("scenes/closed-room.toml", "2/2", &other);
    assert_tells(
        &steradian(&["merge", &one, &other, "-o", &whole]).error(),
        &["different scenes"],
    );
    assert_tells(
        &steradian(&["merge", &one, "-o", &whole]).error(),
        &["none of them"],
    );
    let bytes = std::fs::read(&one).unwrap();
    std::fs::write(&other, &bytes[..bytes.len() / 2]).unwrap();
    assert_tells(
        &steradian(&["merge", &one, &other, "-o", &whole]).error(),
        &["other", "cut short"],
    );
    assert!(!folder.names().contains(&"whole.json".to_owned()));
}
