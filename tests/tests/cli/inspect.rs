//! What `inspect` tells of scenes and meshes.

use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

/// The unit cube with its faces in `kept`, as OBJ with a vertex for each corner.
fn cube(kept: usize) -> String {
    let corners = (0..8).map(|i| format!("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2));
    let faces = [
        "f 1 3 4 2\n",
        "f 5 6 8 7\n",
        "f 1 2 6 5\n",
        "f 3 7 8 4\n",
        "f 1 5 7 3\n",
        "f 2 4 8 6\n",
    ];
    corners.collect::<String>() + &faces[..kept].concat()
}

fn json(path: &str) -> Value {
    let text = steradian(&["inspect", path, "--format", "json"]).fine();
    serde_json::from_str(&text).unwrap()
}

/// Kind and count of each finding.
fn findings(object: &Value) -> Vec<(&str, u64)> {
    let findings = object["findings"].as_array().unwrap().iter();
    let found = findings.map(|one| {
        (
            one["kind"].as_str().unwrap(),
            one["count"].as_u64().unwrap(),
        )
    });
    found.collect()
}

#[test]
fn a_closed_mesh_is_sound() {
    let folder = Folder::new();
    let file = folder.write("cube.obj", &cube(6));
    let object = json(&file);
    assert_eq!(object["schema"], "steradian.inspect/1");
    assert_eq!(object["triangles"], 12);
    assert_eq!(object["pieces"], 1);
    assert_eq!(object["area"], 6.0);
    assert_eq!(findings(&object), []);
    steradian(&["inspect", &file, "--strict"]).fine();
}

/// A mirror throws light of a point on the floor: pictures have it, readings do not.
#[test]
fn what_is_not_sampled_depends_on_the_sensors() {
    let scene = r#"
        [materials.silver]
        model = "mirror"
        reflectance = 0.9

        [[shapes]]
        name = "mirror behind the camera"
        kind = "rectangle"
        origin = [-1, -2, 0]
        edges = [[0, 0, 2], [2, 0, 0]]
        material = "silver"

        [[lights]]
        name = "lamp"
        kind = "point"
        position = [0, 0, 1]
        intensity = "1 W/sr"

        [[sensors]]
        name = "camera"
        kind = "camera"
        position = [0, -1, 1]
        look_at = [0, 5, 0]
        fov = "40 deg"
        resolution = [8, 8]
    "#;
    let meter = r#"
        [[sensors]]
        name = "meter"
        kind = "irradiance"
        points = [[0, 1, 0, 0, -1, 0]]
    "#;
    let folder = Folder::new();
    let not_sampled = |name: &str, text: &str| {
        let file = folder.write(name, text);
        json(&file)["unsampled"].as_array().unwrap().clone()
    };
    assert_eq!(not_sampled("camera.toml", scene), [] as [Value; 0]);
    let classes = not_sampled("both.toml", &format!("{scene}{meter}"));
    assert_eq!(
        classes,
        [
            "light of `lamp` reflected by mirrors of material `silver`, as polished surfaces show it to points of readings"
        ]
    );
}

/// The face x = 1 is missing.
#[test]
fn a_hole_is_told_with_its_place() {
    let folder = Folder::new();
    let file = folder.write("cube.obj", &cube(5));
    let object = json(&file);
    assert_eq!(findings(&object), [("boundary-edge", 4)]);
    let examples = object["findings"][0]["examples"].as_array().unwrap();
    assert_eq!(examples.len(), 4);
    for example in examples {
        for point in example["points"].as_array().unwrap() {
            assert_eq!(point[0], 1.0, "{example}");
        }
    }
    let text = steradian(&["inspect", &file]).fine();
    assert!(text.contains("Found: 4 boundary edges"), "{text}");
    assert!(text.contains("… and 1 more"), "{text}");
    assert_eq!(steradian(&["inspect", &file, "--strict"]).status(), 1);
}

#[test]
fn faults_of_faces_are_told() {
    let folder = Folder::new();
    let twice = folder.write("twice.obj", &(cube(6) + "f 1 3 4\n"));
    assert_eq!(findings(&json(&twice)), [("doubled-face", 1)]);
    let turned = cube(6).replace("f 2 4 8 6", "f 6 8 4 2");
    let turned = folder.write("turned.obj", &turned);
    assert_eq!(findings(&json(&turned)), [("turned-edge", 4)]);
}

/// The same cube with the face x = 1 a hair away closes within a tolerance.
#[test]
fn welding_is_asked_for() {
    let folder = Folder::new();
    let apart = "v 1.00001 0 0\nv 1.00001 1 0\nv 1.00001 1 1\nv 1.00001 0 1\nf 9 10 11 12\n";
    let file = folder.write("cube.obj", &(cube(5) + apart));
    let strict = |more: &[&str]| {
        let arguments = [&["inspect", &file, "--strict"], more].concat();
        steradian(&arguments).status()
    };
    assert_eq!(strict(&[]), 1);
    assert_eq!(strict(&["--weld", "0.1mm"]), 0);
    assert_eq!(strict(&["--weld", "1 um"]), 1);
}

const OUTSIDE: &str = r#"
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

[[lights]]
name = "bulb"
kind = "point"
position = [2, 1, 2]
flux = "800 lm"

[[lights]]
name = "sun"
kind = "directional"
direction = [0, 1, -1]
irradiance = "50 klx"

[[sensors]]
name = "desk"
kind = "illuminance"
points = [[2, 1, 0, 0, 0, 1], [3, 1, 0, 0, 0, 1]]
"#;

#[test]
fn lights_and_sensors_are_told_with_their_place() {
    let folder = Folder::new();
    let object = json(&folder.write("room.toml", OUTSIDE));
    assert_eq!(findings(&object), [("unseen-light", 1)]);
    let example = &object["findings"][0]["examples"][0];
    assert_eq!(
        (&example["name"], &example["remark"]),
        (&"sun".into(), &"outside room".into())
    );
    assert_eq!(object["lights"][0]["power"][0]["unit"], "lm");
    let flux = object["lights"][0]["power"][0]["value"].as_f64().unwrap();
    assert!((flux - 800.0).abs() < 1e-9);
    let on = &object["sensors"][0]["sits_on"][0];
    assert_eq!(
        (&on["shape"], &on["side"], &on["points"]),
        (&"room".into(), &"front".into(), &2.into())
    );
    assert_eq!(object["bounds"]["max"][2], 2.5);
}

/// The open front of the Cornell box; the lamp is a sheet, and no finding.
#[test]
fn rectangles_that_meet_are_one_surface() {
    let object = json("scenes/cornell-box.toml");
    assert_eq!(findings(&object), [("boundary-edge", 4)]);
    assert_eq!(
        (&object["pieces"], &object["sheet_edges"]),
        (&4.into(), &4.into())
    );
}

fn measured(name: &str) -> String {
    let data = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = data
        .join("../crates/steradian-io/tests/data/bsdf")
        .join(name);
    path.display().to_string()
}

/// checkBSDF of Radiance: at most 8751.1 % of the light is reflected, for the values of the file are not those of a surface.
#[test]
fn a_measured_surface_is_told_with_its_totals_and_what_is_wrong() {
    let object = json(&measured("radiance_testBSDF.xml"));
    assert_eq!(object["schema"], "steradian.inspect-measured/1");
    assert_eq!(object["header"][0]["value"], "Bogus");
    assert_eq!(object["blocks"].as_array().unwrap().len(), 1);
    let totals = object["totals"].as_array().unwrap().iter();
    let largest = totals
        .map(|total| total["largest_sum"].as_f64().unwrap())
        .fold(0.0, f64::max);
    assert!((largest - 87.511).abs() < 5e-4, "{largest}");
    let finding = "Visible: 87.5105 of the light from above at 30 degrees leaves again";
    assert_eq!(object["findings"], serde_json::json!([finding]));
    let text = steradian(&["inspect", &measured("radiance_testBSDF.xml")]).fine();
    assert!(text.contains("tensor tree of rank 3, 57 leaves"));
    let strict = steradian(&["inspect", &measured("radiance_testBSDF.xml"), "--strict"]);
    assert_eq!(strict.status(), 1);
}

#[test]
fn a_broken_measured_surface_is_refused_with_its_place() {
    let message = steradian(&["inspect", &measured("klems_small_tab.xml")]).error();
    assert!(message.contains(
        "line 109, column 19: Transmission Front: 21025 values are needed, 4 were found"
    ));
}

fn luminaire(name: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/photometry/");
    format!("{folder}{name}")
}

/// 45 cd everywhere: 180π lm, of which lamps of 2 × 1000 lm are told to give 2000; a quarter of the sphere's half lies within
/// 41.4° of the nadir.
#[test]
fn a_luminaire_is_told_with_its_flux_and_its_beams() {
    let object = json(&luminaire("isotropic_100cd.ies"));
    assert_eq!(object["schema"], "steradian.inspect-luminaire/1");
    let number = |value: &Value| value.as_f64().unwrap();
    assert!(
        (number(&object["flux"]["value"]) / (180.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12
    );
    assert_eq!(object["rated_flux"]["value"], 2000.0);
    assert_eq!(object["rated_flux"]["unit"], "lm");
    assert_eq!(object["power"]["unit"], "W");
    assert_eq!(object["angles"]["C0-C180"]["beam"]["unit"], "deg");
    assert_eq!(object["greatest_intensity"]["value"], 45.0);
    let code: Vec<f64> = object["flux_code"]
        .as_array()
        .unwrap()
        .iter()
        .map(number)
        .collect();
    assert!((code[0] - 0.25).abs() < 1e-12 && (code[3] - 0.5).abs() < 1e-12);
    let text = steradian(&["inspect", &luminaire("tilt_include.ies")]).fine();
    assert!(text.contains("factors of tilt"), "{text}");
}

#[test]
fn a_broken_luminaire_is_refused_with_its_place() {
    let message = steradian(&["inspect", &luminaire("mdl_test_malformed.ies")]).error();
    assert!(message.contains("mdl_test_malformed.ies:3:1"), "{message}");
}

/// The first entry of the table of this file is 20.2 in DIALux and 20.3 in Relux.
#[test]
fn a_luminaire_has_a_ugr_table_and_a_diagram() {
    let path = luminaire("ugr_sample_08.ldt");
    let folder = Folder::new();
    let drawing = folder.path("polar.svg");
    let text = steradian(&["inspect", &path, "--plot", &drawing]).fine();
    assert!(
        text.contains("12H  8H") && text.contains("70/50/20"),
        "{text}"
    );
    let svg = std::fs::read_to_string(&drawing).unwrap();
    assert!(svg.contains("luminous intensity (cd)") && svg.contains("all planes"));
    let object = json(&path);
    let first = object["ugr"]["rooms"][0]["crosswise"][0].as_f64().unwrap();
    assert!((first - 20.1).abs() < 0.3, "{first}");
    let point = json(&luminaire("mdl_rimlight_iesna91.ies"));
    assert!(
        point["ugr"]["missing"]
            .as_str()
            .unwrap()
            .contains("no luminous opening")
    );
    let message = steradian(&["inspect", "scenes/point-light.toml", "--plot", &drawing]).error();
    assert!(message.contains("luminaires"), "{message}");
}

#[test]
fn xml_of_luminaires_is_told_from_xml_of_surfaces() {
    let object = json(&luminaire("quadrant_tm33.xml"));
    assert_eq!(object["format"], "IESTM33-22");
    assert_eq!(object["power"]["value"], 12.5);
}
