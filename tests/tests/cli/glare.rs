//! What `glare` says of views whose measures are known.

use std::f64::consts::PI;

use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

fn number(value: &Value) -> f64 {
    value["value"].as_f64().unwrap()
}

/// What an observer sees in a scene, in few pixels.
fn observed(scene: &str, eye: &str, look: &str) -> Value {
    let observer = ["glare", scene, "--observer", eye, "--look", look];
    let effort = ["--resolution", "64x64", "--samples", "4"];
    let arguments = [&observer[..], &effort, &["--format", "json"]].concat();
    serde_json::from_str(&steradian(&arguments).fine()).unwrap()
}

/// 64 × 64 pixels of 1 W/(m² sr), which is 179 cd/m².
fn even(folder: &Folder) -> String {
    let mut bytes = b"Pf\n64 64\n-1.0\n".to_vec();
    bytes.extend([1.0_f32.to_le_bytes(); 64 * 64].as_flattened());
    let path = folder.path("even.pfm");
    std::fs::write(&path, bytes).unwrap();
    path
}

/// E_v = πL; of an equisolid picture, whose rim of 64 pixels is off by a part in 64 at most.
#[test]
fn an_even_picture_has_no_source() {
    let folder = Folder::new();
    let arguments = ["glare", &even(&folder), "--view", "fisheye-equisolid"];
    let text = steradian(&arguments).fine();
    for part in ["no error layer", "imperceptible", "none: no source"] {
        assert!(text.contains(part), "{text}");
    }
    let object = steradian(&[&arguments[..], &["--format", "json"]].concat()).fine();
    let object: Value = serde_json::from_str(&object).unwrap();
    assert_eq!(object["schema"], "steradian.glare/1");
    assert!((number(&object["illuminance"]) / (179.0 * PI) - 1.0).abs() < 1.0 / 64.0);
    let expected = 0.16 + 5.87e-5 * number(&object["illuminance"]);
    assert!((number(&object["daylight_glare_probability"]) - expected).abs() < 1e-12);
    assert!(object["illuminance"]["std_error"].is_null());
    assert!(object["unified_glare_rating"].is_null());
}

#[test]
fn what_is_missing_is_asked_for() {
    let folder = Folder::new();
    let picture = even(&folder);
    assert!(steradian(&["glare", &picture]).error().contains("--view"));
    assert!(
        steradian(&["glare", "scenes/open-sky.toml"])
            .error()
            .contains("--observer")
    );
    let observer = ["--observer", "0,0,1", "--look", "1,0,0"];
    let both = [&["glare", &picture][..], &observer].concat();
    assert!(steradian(&both).error().contains("not at a picture"));
    let view = [
        "glare",
        &picture,
        "--view",
        "perspective",
        "--angle",
        "180deg",
    ];
    assert!(steradian(&view).error().contains("between 0 and 180deg"));
    let task = [
        "glare",
        &picture,
        "--view",
        "fisheye-equisolid",
        "--task",
        "32,32,20deg",
    ];
    assert!(steradian(&task).error().contains("--threshold 5x"));
}

/// All that is seen has one luminance, to the seven digits of its lanes: L = 1000 cd/m², E_v = 1000π lx. Where the hemisphere ends, pixels count whole
/// or not at all.
#[test]
fn an_observer_under_an_even_sky_sees_it() {
    let folder = Folder::new();
    let scene = "[scene]\nname = \"Sky\"\nspectrum = \"rgb\"\n\n[[lights]]\nkind = \"environment\"\nradiance = \"1000 cd/m2\"\n";
    let path = folder.path("sky.toml");
    std::fs::write(&path, scene).unwrap();
    let object = observed(&path, "0,0,1.2", "1,0.2,0");
    assert!((number(&object["mean_luminance"]) / 1000.0 - 1.0).abs() < 1e-6);
    assert!((number(&object["illuminance"]) / (1000.0 * PI) - 1.0).abs() < 1.0 / 64.0);
    assert_eq!(object["error_layer"], true);
    assert_eq!(object["sources"].as_array().unwrap().len(), 0);
}

/// A disc of 10 cm radius 2 m ahead under an even sky, perhaps behind a wall.
fn disc(folder: &Folder, wall: bool) -> Value {
    let mut scene = String::from(
        "[scene]\nname = \"Disc\"\nspectrum = \"rgb\"\n\n[materials.black]\nmodel = \"lambertian\"\nreflectance = 0\n\n\
         [[lights]]\nkind = \"environment\"\nradiance = \"1000 cd/m2\"\n\n\
         [[shapes]]\nname = \"lamp\"\nkind = \"disc\"\ncenter = [2, 0, 0]\nnormal = [-1, 0, 0]\nradius = 0.1\nmaterial = \"black\"\n\
         emission = { radiance = \"100000 cd/m2\" }\n",
    );
    if wall {
        scene.push_str("\n[[shapes]]\nkind = \"disc\"\ncenter = [1, 0, 0]\nnormal = [-1, 0, 0]\nradius = 0.1\nmaterial = \"black\"\n");
    }
    let path = folder.path("disc.toml");
    std::fs::write(&path, scene).unwrap();
    let object = observed(&path, "0,0,0", "1,0,0");
    object["lights"].clone()
}

/// ω = 2π (1 − cosθ) with tanθ = .05, p = 1, and L_b = 1000 (1 − sin²θ) cd/m² of what the disc does not hide. Five standard errors fail once in
/// 10⁴ seeds, and the seed is fixed; the disc's 1024 points leave 10⁻³ of its light.
#[test]
fn the_lights_of_a_scene_are_rated() {
    let folder = Folder::new();
    let lights = disc(&folder, false);
    let tangent: f64 = 0.05;
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let solid_angle = 2.0 * PI * (1.0 - cosine);
    let background = 1000.0 * cosine * cosine;
    let expected = 8.0 * libm::log10(0.25 / background * 1e10 * solid_angle);
    let rating = &lights["unified_glare_rating"];
    let off = (number(rating) - expected).abs();
    assert!(
        off < 0.01 + 5.0 * rating["std_error"].as_f64().unwrap(),
        "{rating} {expected}"
    );
    let seen = &lights["seen"][0];
    assert_eq!(seen["name"], "lamp");
    assert!((number(&seen["solid_angle"]) / solid_angle - 1.0).abs() < 1e-3);
    assert!(
        (number(&seen["illuminance"]) / (1e5 * PI * (1.0 - cosine * cosine)) - 1.0).abs() < 1e-3
    );
    let hidden = disc(&folder, true);
    assert!(hidden["unified_glare_rating"].is_null());
    assert_eq!(hidden["seen"].as_array().unwrap().len(), 0);
}

/// Without a picture the lights are rated as beside one, to the last bit.
#[test]
fn lights_are_rated_without_a_picture() {
    let folder = Folder::new();
    let beside = disc(&folder, false);
    let path = folder.path("disc.toml");
    let arguments = [
        "glare",
        &path,
        "--observer",
        "0,0,0",
        "--look",
        "1,0,0",
        "--lights",
    ];
    let text = steradian(&[&arguments[..], &["--format", "json"]].concat()).fine();
    let object: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(object["lights"], beside);
    assert!(object["sources"].is_null());
    let table = steradian(&arguments).fine();
    assert!(
        table.starts_with("unified glare rating of the lights: "),
        "{table}"
    );
    let with_picture = [&arguments[..], &["--samples", "8"]].concat();
    assert!(
        steradian(&with_picture)
            .error()
            .contains("cannot be used with")
    );
    let message = steradian(&[
        "glare",
        "a.hdr",
        "--observer",
        "0,0,0",
        "--look",
        "1,0,0",
        "--lights",
    ]);
    assert!(message.error().contains("not at a picture"));
}
