//! Pictures and pages of results.

use steradian_tests::command::{Folder, steradian};

/// A grid over a floor below a lamp and beside a window.
const ROOM: &str = r#"
[scene]
name = "Room"

[materials.floor]
model = "lambertian"
reflectance = 0.2

[[shapes]]
name = "floor"
kind = "rectangle"
origin = [0, 0, 0]
edges = [[4, 0, 0], [0, 3, 0]]
material = "floor"

[[lights]]
kind = "point"
position = [1, 1, 2]
intensity = "400 cd"
group = "lamp"

[[lights]]
kind = "directional"
direction = [1, 0, -1]
irradiance = "40 lx"
group = "window"

[[sensors]]
name = "desk"
kind = "illuminance"
grid = { origin = [0, 0, 0.8], edges = [[4, 0, 0], [0, 3, 0]], count = [8, 6] }

[[sensors]]
name = "eye"
kind = "illuminance"
points = [[2, 1, 1.2, -1, 0, 0]]
"#;

fn measured(folder: &Folder) -> String {
    let (scene, result) = (folder.path("room.toml"), folder.path("room.json"));
    std::fs::write(&scene, ROOM).unwrap();
    steradian(&["measure", &scene, "-o", &result]).fine();
    result
}

fn drawn(folder: &Folder, arguments: &[&str], ending: &str) -> Vec<u8> {
    let (result, picture) = (measured(folder), folder.path(&format!("picture.{ending}")));
    let words = [&["plot", &result, "-o", &picture], arguments].concat();
    assert_eq!(steradian(&words).fine(), "");
    std::fs::read(picture).unwrap()
}

#[test]
fn each_kind_is_drawn() {
    let folder = Folder::new();
    for (arguments, parts) in [
        (&[][..], &["Room: desk", "illuminance (lx)", ">max<"][..]),
        (&["--sensor", "eye"], &["Room: eye", "<circle"]),
        (
            &["--kind", "isolux", "--levels", "100,150"],
            &[">100<", ">150<", "values are exact"],
        ),
        (
            &["--kind", "shares"],
            &[">lamp<", ">window<", ">eye<", "desk (mean of 48)"],
        ),
        (&["--kind", "matrix"], &[">lamp<", ">window<", ">lx<"]),
    ] {
        let picture = String::from_utf8(drawn(&folder, arguments, "svg")).unwrap();
        for part in parts {
            assert!(
                picture.contains(part),
                "{arguments:?}: {part} is not in {picture}"
            );
        }
    }
    assert!(drawn(&folder, &["--kind", "isolux"], "png").starts_with(b"\x89PNG"));
}

#[test]
fn what_cannot_be_drawn_is_told_with_what_can() {
    let folder = Folder::new();
    let result = measured(&folder);
    for (arguments, expected) in [
        (
            &["-o", "a.svg", "--sensor", "floor"][..],
            "there is no sensor `floor`; the result has `desk`, `eye`",
        ),
        (
            &["-o", "a.svg", "--quantity", "luminance"],
            "the result does not report `luminance`, but `illuminance`",
        ),
        (
            &["-o", "a.svg", "--kind", "isolux", "--sensor", "eye"],
            "sensors that do: `desk`",
        ),
        (
            &["-o", "a.svg", "--levels", "1"],
            "--levels goes with --kind isolux",
        ),
        (
            &["-o", "a.svg", "--kind", "shares", "--errors"],
            "--errors goes with --kind plan",
        ),
        (&["-o", "a.pdf"], "expected -o FILE.svg or -o FILE.png"),
    ] {
        let message = steradian(&[&["plot", &result], arguments].concat()).error();
        assert!(message.contains(expected), "{message}");
    }
    let scene = steradian(&["plot", "scenes/point-light.toml", "-o", "a.svg"]).error();
    assert!(
        scene.contains("not a result of `steradian measure"),
        "{scene}"
    );
}

#[test]
fn a_report_is_one_page() {
    let folder = Folder::new();
    let result = measured(&folder);
    let page = steradian(&["report", &result]).fine();
    for part in [
        "<!DOCTYPE html>",
        "<h1>Room</h1>",
        "desk: illuminance",
        "eye: illuminance",
        "<svg",
        "Converged",
    ] {
        assert!(page.contains(part), "{part} is not in the page");
    }
    let file = folder.path("room.html");
    assert_eq!(steradian(&["report", &result, "-o", &file]).fine(), "");
    assert_eq!(std::fs::read_to_string(file).unwrap(), page);
}
