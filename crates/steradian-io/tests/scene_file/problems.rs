//! Every mistake gives one clear message: where it is, and what was expected.

use std::path::Path;

use steradian::scene::{Part, Place, Problem};
use steradian_io::diagnostic::{Diagnostic, Severity, render};
use steradian_io::files::MemoryFiles;
use steradian_io::scene_file::{read_scene, read_scene_str};

use crate::{files, load, problems};

/// A scene without a mistake; each test puts one in.
const GOOD: &str = r#"[scene]
name = "Good"

[materials.grey]
model = "lambertian"
reflectance = 0.5

[[shapes]]
name = "desk"
kind = "polygon"
vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
material = "grey"

[[shapes]]
name = "part"
kind = "mesh"
file = "parts/triangle.obj"

[[lights]]
kind = "spot"
position = [0, 0, 1]
direction = [0, 0, -1]
cutoff = "45 deg"
intensity = "100 W/sr"
repeat = { count = [2, 2], step = [[1, 0, 0], [0, 1, 0]] }

[[sensors]]
name = "points"
kind = "irradiance"
points = [[0, 0, 0, 0, 0, 1]]
"#;

/// The text at a diagnostic's span.
fn place(diagnostic: &Diagnostic) -> &str {
    let (Some(file), Some(span)) = (&diagnostic.file, &diagnostic.span) else {
        return "";
    };
    &file.text[span.clone()]
}

/// Replaces `good` by `bad`, and expects one problem that is at `at` and says `says`.
#[track_caller]
fn one_problem(good: &str, bad: &str, at: &str, says: &str) -> Diagnostic {
    assert!(GOOD.contains(good), "{good}");
    let mut found = problems(&GOOD.replacen(good, bad, 1));
    assert_eq!(found.len(), 1, "{}", render(&found, false));
    let diagnostic = found.remove(0);
    assert_eq!(diagnostic.severity, Severity::Error);
    assert_eq!(place(&diagnostic), at, "{}", diagnostic.message);
    assert!(diagnostic.message.contains(says), "{}", diagnostic.message);
    diagnostic
}

#[test]
fn the_scene_without_a_mistake_is_read() {
    assert_eq!(problems(GOOD), []);
}

#[test]
fn units() {
    one_problem(
        "\"100 W/sr\"",
        "\"5 kg\"",
        "\"5 kg\"",
        "expected an intensity or a luminous intensity such as",
    );
    one_problem("\"100 W/sr\"", "\"100 W\"", "\"100 W\"", "which is a flux");
    one_problem(
        "\"100 W/sr\"",
        "\"much\"",
        "\"much\"",
        "does not begin with a number",
    );
    one_problem(
        "\"100 W/sr\"",
        "100",
        "100",
        "W/sr, mW/sr, kW/sr, cd, mcd, kcd), found \"100\", which has no unit",
    );
    one_problem(
        "\"45 deg\"",
        "0.5",
        "0.5",
        "expected an angle such as \"30 deg\"",
    );
    one_problem("\"45 deg\"", "true", "true", "expected angle in deg, rad");
    one_problem(
        "[0, 0, 1]",
        "[0, 0, \"1 sr\"]",
        "\"1 sr\"",
        "expected a length",
    );
    one_problem(
        "[0, 0, -1]",
        "[0, 0, \"1 m\"]",
        "\"1 m\"",
        "expected a number without a unit",
    );
    one_problem(
        "\"Good\"",
        "\"Good\"\nluminous_efficacy = 179",
        "179",
        "expected a luminous efficacy such as \"179 lm/W\"",
    );
    one_problem(
        "triangle.obj\"",
        "triangle.obj\"\nunit = \"kg\"",
        "\"kg\"",
        "expected a unit of length such as \"mm\"",
    );
}

#[test]
fn numbers() {
    one_problem(
        "[0, 0, 1]",
        "[0, nan, 1]",
        "nan",
        "expected a finite number",
    );
    one_problem(
        "[0, 0, 1]",
        "[0, 0, -inf]",
        "-inf",
        "expected a finite number",
    );
    one_problem(
        "[0, 0, 1]",
        "[0, 0, 1e999]",
        "1e999",
        "expected a finite number",
    );
    one_problem(
        "reflectance = 0.5",
        "reflectance = inf",
        "inf",
        "expected a finite number",
    );
    one_problem(
        "\"100 W/sr\"",
        "\"inf W/sr\"",
        "\"inf W/sr\"",
        "which is not finite",
    );
    one_problem(
        "[2, 2]",
        "[2, -2]",
        "-2",
        "expected a whole number, 0 or more",
    );
    one_problem(
        "[2, 2]",
        "[2, 2.5]",
        "2.5",
        "expected a whole number, 0 or more",
    );
    one_problem(
        "[2, 2]",
        "[2, 5_000_000_000]",
        "5_000_000_000",
        "expected a whole number, 0 or more",
    );
}

#[test]
fn types_and_lengths_of_arrays() {
    one_problem(
        "[0, 0, 1]",
        "3",
        "3",
        "expected a point of three lengths such as [0, 0, 1.5] in metres, found the number 3",
    );
    one_problem("[0, 0, 1]", "[0, 1]", "[0, 1]", "found an array of 2");
    one_problem(
        "[0, 0, -1]",
        "\"down\"",
        "\"down\"",
        "expected three numbers such as [0, 0, 1]",
    );
    one_problem(
        "[[0, 0, 0, 0, 0, 1]]",
        "[[0, 0, 0, 0, 1]]",
        "[0, 0, 0, 0, 1]",
        "expected a point and a direction",
    );
    one_problem("[[0, 0, 0, 0, 0, 1]]", "5", "5", "expected a list");
    one_problem("\"Good\"", "5", "5", "expected a string");
    one_problem(
        "material = \"grey\"",
        "material = 1",
        "1",
        "expected a string, found the number 1",
    );
    one_problem(
        "{ count",
        "3 # { count",
        "3",
        "expected a table { count, step }",
    );
    one_problem(
        "[[1, 0, 0], [0, 1, 0]] }",
        "[[1, 0, 0]] }",
        "[[1, 0, 0]]",
        "a step for each count: 2 counts, 1 steps",
    );
    one_problem(
        "= 0.5",
        "= \"red\"",
        "\"red\"",
        "expected a number, \"#rrggbb\", [r, g, b], a table of bands, [[nm, value], …] or { file, column }",
    );
    one_problem(
        "= 0.5",
        "= [0.5, 0.5]",
        "[0.5, 0.5]",
        "expected a number, \"#rrggbb\"",
    );
    one_problem(
        "= 0.5",
        "= { visible = \"x\" }",
        "\"x\"",
        "expected a number without a unit",
    );
}

#[test]
fn unknown_keys_name_the_nearest() {
    let misspelt = one_problem(
        "intensity",
        "intesity",
        "intesity",
        "unknown key `intesity` of the spot light",
    );
    assert_eq!(misspelt.hints, ["did you mean `intensity`?"]);
    let strange = one_problem(
        "cutoff =",
        "colour = 1\ncutoff =",
        "colour",
        "unknown key `colour`",
    );
    assert!(
        strange.hints[0].starts_with("its keys are position, direction, cutoff"),
        "{:?}",
        strange.hints
    );
    let nested = one_problem(
        "{ count",
        "{ cuont",
        "cuont",
        "unknown key `cuont` of a repeat",
    );
    assert_eq!(nested.hints, ["did you mean `count`?"]);
    let section = one_problem(
        "[[lights]]",
        "[[light]]",
        "light",
        "unknown section `light`",
    );
    assert_eq!(section.hints, ["did you mean `lights`?"]);
}

#[test]
fn unknown_kinds_name_the_nearest() {
    let misspelt = one_problem("\"spot\"", "\"spto\"", "\"spto\"", "unknown light \"spto\"");
    assert_eq!(misspelt.hints, ["did you mean \"spot\"?"]);
    let strange = one_problem(
        "\"lambertian\"",
        "\"velvet\"",
        "\"velvet\"",
        "unknown material \"velvet\"",
    );
    assert!(strange.hints[0].starts_with("it may be lambertian, mirror, two-sided, "));
    one_problem(
        "kind = \"spot\"",
        "",
        "[[lights]]",
        "missing key `kind` of a light, one of point, spot",
    );
    one_problem("\"spot\"", "4", "4", "expected the kind of a light");
}

#[test]
fn schedules() {
    let schedule = |text: &str, at: &str, says: &str| {
        one_problem("cutoff", &format!("schedule = {text}\ncutoff"), at, says);
    };
    let expected = "expected a list, each a time and a factor, 0 or more, such as [\"8 h\", 0.5]";
    schedule("1", "1", expected);
    schedule("1", "1", "or a table { linear, held, period }");
    schedule("{ held = 1 }", "1", expected);
    schedule(
        "[[\"0 h\", 1], [8, 1]]",
        "8",
        "expected a time such as \"8 h\"",
    );
    schedule(
        "[[\"0 h\", 1], [\"8 h\"]]",
        "[\"8 h\"]",
        "expected a time and a factor",
    );
    schedule(
        "[[\"0 h\", 1], [\"8 h\", \"1\"]]",
        "\"1\"",
        "expected a number without a unit",
    );
    schedule(
        "[[\"0 h\", 1]]",
        "[[\"0 h\", 1]]",
        "at least two points are needed, found 1",
    );
    schedule(
        "[[\"1 h\", 1], [\"60 min\", 0]]",
        "[\"60 min\", 0]",
        "times must increase",
    );
    schedule(
        "[[\"0 h\", 1], [\"1 h\", -1]]",
        "[\"1 h\", -1]",
        "a factor is not negative",
    );
    let short = "{ held = [[\"0 h\", 1], [\"2 h\", 0]], period = \"1 h\" }";
    schedule(
        short,
        "[[\"0 h\", 1], [\"2 h\", 0]]",
        "a period of 3600 s is too short",
    );
    let both = "{ held = [[\"0 h\", 1], [\"2 h\", 0]], linear = [[\"0 h\", 1], [\"2 h\", 0]] }";
    schedule(both, "[[\"0 h\", 1], [\"2 h\", 0]]", "exclude each other");
    let period = "{ held = [[\"0 h\", 1], [\"2 h\", 0]], period = 3 }";
    schedule(period, "3", "which has no unit");
}

#[test]
fn what_is_planned_is_not_unknown() {
    for (good, planned) in [
        ("\"polygon\"", "\"cylinder\""),
        ("\"polygon\"", "\"cone\""),
        ("\"spot\"", "\"sun\""),
        ("\"spot\"", "\"sky\""),
        ("\"irradiance\"", "\"intensity\""),
        ("\"lambertian\"", "\"glass\""),
    ] {
        one_problem(good, planned, planned, "is not supported yet");
    }
    one_problem(
        "[scene]",
        "[site]\n[scene]",
        "site",
        "section `site` is not supported yet",
    );
}

#[test]
fn missing_keys() {
    one_problem(
        "reflectance = 0.5",
        "",
        "[materials.grey]",
        "missing key `reflectance` of the lambertian material",
    );
    one_problem(
        "position = [0, 0, 1]",
        "",
        "[[lights]]",
        "missing key `position` of the spot light: a point",
    );
    one_problem(
        "intensity = \"100 W/sr\"",
        "",
        "[[lights]]",
        "missing key of the spot light: one of `intensity`, `flux`",
    );
    one_problem(
        "points = ",
        "# ",
        "[[sensors]]",
        "missing key of the irradiance sensor: one of `points`, `grid`, `shape`",
    );
    one_problem("name = \"points\"", "", "[[sensors]]", "missing key `name`");
    one_problem(
        ", step = [[1, 0, 0], [0, 1, 0]]",
        "",
        "{ count = [2, 2] }",
        "missing key `step` of a repeat",
    );
}

#[test]
fn keys_that_exclude_or_need_each_other() {
    let both = one_problem(
        "cutoff",
        "flux = \"5 lm\"\ncutoff",
        "\"100 W/sr\"",
        "keys `flux` and `intensity`",
    );
    assert!(both.message.ends_with("exclude each other"));
    one_problem(
        "cutoff",
        "beam_angle = \"20 deg\"\ncutoff",
        "\"45 deg\"",
        "`beam_angle` and `cutoff`",
    );
    one_problem(
        "points =",
        "side = \"back\"\npoints =",
        "\"back\"",
        "has a meaning only beside `shape`",
    );
    one_problem(
        "material =",
        "transform = [{ rotate = \"1 deg\" }]\nmaterial =",
        "{ rotate = \"1 deg\" }",
        "missing key `axis`",
    );
    let axis = "transform = [{ rotate = \"1 deg\", axis = [0, 0, 0] }]\nmaterial =";
    one_problem("material =", axis, "[0, 0, 0]", "has no direction");
    one_problem(
        "file =",
        "triangles = []\nfile =",
        "[]",
        "has a meaning only beside `vertices`",
    );
    let response = "kind = \"illuminance\"\nresponse = \"radiant\"";
    one_problem(
        "kind = \"irradiance\"",
        response,
        "\"radiant\"",
        "of kind \"illuminance\" is \"photopic\"",
    );
    one_problem(
        "cutoff = \"45 deg\"",
        "beam_angle = \"180 deg\"",
        "\"180 deg\"",
        "between 0 and 180 deg",
    );
}

/// A camera whose keys are `keys` in the place of the sensor.
#[track_caller]
fn camera_problem(keys: &str, at: &str, says: &str) -> Diagnostic {
    let camera = format!(
        "kind = \"camera\"\nposition = [0, 0, 1]\nlook_at = [1, 0, 1]\nresolution = [8, 8]\n{keys}"
    );
    let sensor = "kind = \"irradiance\"\npoints = [[0, 0, 0, 0, 0, 1]]";
    one_problem(sensor, &camera, at, says)
}

#[test]
fn keys_of_another_projection() {
    let width = camera_problem(
        "fov = \"40 deg\"\nwidth = 3",
        "3",
        "key `width` of the camera sensor has no meaning with projection = \"perspective\"",
    );
    assert_eq!(width.hints, ["it belongs to projection = \"orthographic\""]);
    camera_problem(
        "projection = \"panorama\"\nfov = \"40 deg\"",
        "\"40 deg\"",
        "`fov` of the camera sensor has no meaning",
    );
    camera_problem(
        "projection = \"thin-lens\"\nfov = \"40 deg\"\naperture_radius = 0.1",
        "[[sensors]]",
        "missing key `focus_distance`",
    );
    camera_problem("", "[[sensors]]", "missing key `fov`");
    let unknown = "projection = \"fish-eye\"\nfov = \"40 deg\"\nwidth = 2";
    camera_problem(unknown, "\"fish-eye\"", "fisheye-equidistant");
}

#[test]
fn names_are_given_once() {
    let again = "[[sensors]]\nname = \"points\"\nkind = \"radiance\"\nrays = []\n\n[[sensors]]";
    let twice = one_problem(
        "[[sensors]]",
        again,
        "\"points\"",
        "two of the sensors are called \"points\"",
    );
    assert_eq!(twice.hints, ["the other one is in line 28"]);
    one_problem(
        "\"part\"",
        "\"desk\"",
        "\"desk\"",
        "two of the shapes are called \"desk\"",
    );
    let material = "[materials.grey]\nmodel = \"mirror\"\n[materials.grey]";
    assert!(
        problems(&GOOD.replace("[materials.grey]", material))[0]
            .message
            .contains("duplicate key")
    );
}

#[test]
fn files_that_cannot_be_read() {
    one_problem(
        "parts/triangle.obj",
        "none.obj",
        "\"none.obj\"",
        "cannot read none.obj: no such file",
    );
    one_problem(
        "parts/triangle.obj",
        "broken.obj",
        "\"broken.obj\"",
        "broken.obj: line 3: expected a vertex of three finite numbers, found \"v 0 1\"",
    );
    one_problem(
        "parts/triangle.obj",
        "part.3ds",
        "\"part.3ds\"",
        "expected a mesh file (.obj, .ply, .stl, .gltf or .glb), found \"part.3ds\"",
    );
}

#[test]
fn scenes_that_cannot_be_read() {
    let files = MemoryFiles::default()
        .with("bytes.toml", [0xff, 0xfe])
        .with("room.ply", "");
    for (name, says) in [
        ("none.toml", "cannot read the scene file: no such file"),
        ("bytes.toml", "not UTF-8"),
        ("room.obj", "cannot read room.obj: no such file"),
        ("room.ply", "not a PLY file"),
        ("room.glb", "cannot read room.glb: no such file"),
    ] {
        let found = read_scene(Path::new(name), &files).unwrap_err();
        assert_eq!(found.len(), 1, "{name}");
        assert!(found[0].message.contains(says), "{}", found[0].message);
        assert!(render(&found, false).contains(name));
    }
}

#[test]
fn syntax_errors_come_with_their_place() {
    let found = problems("[scene]\nname = Good\n\n[[lights]\n");
    assert!(found.len() >= 2, "{}", render(&found, false));
    assert!(
        found.iter().all(
            |problem| problem.message.starts_with("not valid TOML: ") && problem.span.is_some()
        )
    );
    assert!(render(&found, false).contains("scene.toml:2:8"));
}

/// Many mistakes at once, as a user sees them. `STERADIAN_BLESS=1 cargo test` writes the file that it compares with.
#[test]
fn all_problems_are_shown_together() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/mistakes.txt");
    let text = include_str!("../golden/mistakes.toml");
    let rendered = render(
        &read_scene_str("mistakes.toml", text, &files()).unwrap_err(),
        false,
    );
    if std::env::var_os("STERADIAN_BLESS").is_some() {
        std::fs::write(&golden, &rendered).unwrap();
    }
    assert!(
        rendered == std::fs::read_to_string(golden).unwrap(),
        "{rendered}"
    );
}

#[test]
fn problems_of_the_description_are_shown_in_the_file() {
    let scene = load(GOOD);
    for (part, key, at) in [
        (
            Part::Shape(0),
            Some("vertices"),
            "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]",
        ),
        (Part::Shape(1), None, "[[shapes]]"),
        (Part::Shape(1), Some("radius"), "[[shapes]]"),
        (Part::Material(0), Some("reflectance"), "0.5"),
        (Part::Light(0), Some("count"), "[2, 2]"),
        (Part::Sensor(0), Some("points"), "[[0, 0, 0, 0, 0, 1]]"),
        (Part::Scene, Some("name"), "\"Good\""),
        (Part::Light(7), None, ""),
    ] {
        let problem = Problem {
            place: Place { part, key },
            message: "wrong".into(),
            hint: Some("mend it".into()),
        };
        let diagnostic = scene.diagnostic(&problem);
        assert_eq!(place(&diagnostic), at, "{part:?} {key:?}");
        assert_eq!(
            (diagnostic.message.as_str(), diagnostic.hints.len()),
            ("wrong", 1)
        );
        assert!(render(&[diagnostic], false).contains("scene.toml"));
    }
}

/// A line `key = value` of which the value is complete, and does not say which keys the table has.
fn key_of(line: &str) -> Option<&str> {
    let (key, _) = line.split_once(" = ")?;
    let complete = line.parse::<toml::Table>().is_ok();
    let tells_keys = ["kind", "model", "projection"].contains(&key);
    (complete && !line.starts_with(' ') && !tells_keys).then_some(key)
}

#[test]
fn no_mistake_hides_another() {
    // A date is nowhere right: put one into every key at once.
    let lines = include_str!("every-key.toml").lines();
    let spoilt: Vec<String> = lines
        .map(|line| key_of(line).map_or(line.to_owned(), |key| format!("{key} = 1979-05-27")))
        .collect();
    let text = spoilt.join("\n");
    let found = problems(&text);
    let reported = |line: usize| {
        let start: usize = spoilt[..line].iter().map(|line| line.len() + 1).sum();
        let spans = found.iter().filter_map(|problem| problem.span.clone());
        spans
            .map(|span| span.start)
            .any(|at| (start..start + spoilt[line].len()).contains(&at))
    };
    let dates: Vec<usize> = (0..spoilt.len())
        .filter(|line| spoilt[*line].ends_with("1979-05-27"))
        .collect();
    assert!(dates.len() > 150, "{}", dates.len());
    for line in dates {
        assert!(reported(line), "line {}: {}", line + 1, spoilt[line]);
    }
}
