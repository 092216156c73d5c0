//! What is wrong with a description is shown where the file says it.

use steradian::scene::Scene;
use steradian_io::diagnostic::{Diagnostic, render};

use crate::{load, scenes};

const GOOD: &str = r#"[materials.grey]
model = "lambertian"
reflectance = 0.5

[[shapes]]
name = "desk"
kind = "polygon"
vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
material = "grey"

[[lights]]
kind = "point"
position = [0, 0, 1]
intensity = "100 W/sr"

[[sensors]]
name = "desk"
kind = "irradiance"
shape = "desk"
"#;

/// What validation says about GOOD with `good` replaced.
fn found(good: &str, bad: &str) -> Vec<Diagnostic> {
    assert!(GOOD.contains(good), "{good}");
    let loaded = load(&GOOD.replacen(good, bad, 1));
    let problems = Scene::new(&loaded.description).err().unwrap_or_default();
    problems
        .iter()
        .map(|problem| loaded.diagnostic(problem))
        .collect()
}

#[test]
fn the_good_scene_is_valid() {
    assert_eq!(found("0.5", "0.5"), []);
}

#[test]
fn problems_are_shown_at_their_place() {
    for (good, bad, line, says) in [
        ("0.5", "1.2", "reflectance = 1.2", "reflectance"),
        ("[1, 1, 0]", "[1, 1, 0.3]", "", "plan"),
        (
            "material = \"grey\"",
            "material = \"gray\"",
            "material = \"gray\"",
            "gray",
        ),
        (
            "shape = \"desk\"",
            "shape = \"disk\"",
            "shape = \"disk\"",
            "disk",
        ),
        ("0.5", "[1, 0, 0]", "reflectance = [1, 0, 0]", "rgb"),
    ] {
        let diagnostics = found(good, bad);
        let text = render(&diagnostics, false);
        assert_eq!(diagnostics.len(), 1, "{bad}: {text}");
        assert!(
            text.contains(line) && text.contains(says) && text.contains("scene.toml:"),
            "{bad}: {text}"
        );
    }
}

#[test]
fn the_shipped_scenes_are_valid() {
    for name in scenes::names() {
        let scene = scenes::shipped(&name);
        if let Err(problems) = Scene::new(&scene) {
            panic!("{name}: {problems:?}");
        }
    }
}
