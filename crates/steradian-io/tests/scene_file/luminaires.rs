//! Luminaires: what a scene file says of them, and what may be wrong.

use std::sync::Arc;

use steradian::geometry::{Point, Vector};
use steradian::light::Opening;
use steradian::quantity::{Amount, Intensity, LuminousFlux, LuminousIntensity};
use steradian::scene::Scene;
use steradian::scene::description::{LightKind, LuminaireDescription, SceneDescription};

use crate::{describe, load, problems};

const LAMP: &str = r#"
[[lights]]
kind = "luminaire"
file = "parts/downlight.ies"
position = [1, 2, 3]
"#;

const SENSOR: &str = r#"
[[sensors]]
name = "desk"
kind = "illuminance"
points = [[0, 0, 0, 0, 0, 1]]
"#;

fn luminaires(scene: &SceneDescription) -> Vec<&LuminaireDescription> {
    let mut found = Vec::new();
    for light in &scene.lights {
        match &light.kind {
            LightKind::Luminaire(luminaire) => found.push(luminaire.as_ref()),
            other => panic!("{other:?}"),
        }
    }
    found
}

/// The message of the only problem.
fn problem(text: &str) -> String {
    let found = problems(text);
    assert_eq!(found.len(), 1, "{found:?}");
    found[0].message.clone()
}

#[test]
fn keys_have_defaults() {
    let scene = describe(LAMP);
    let lamp = luminaires(&scene)[0];
    assert_eq!(lamp.position, Point::new(1.0, 2.0, 3.0));
    assert_eq!(lamp.aim, Vector::new(0.0, 0.0, -1.0));
    assert_eq!(lamp.c0, Vector::new(1.0, 0.0, 0.0));
    assert_eq!((lamp.dimming, lamp.maintenance_factor), (1.0, 1.0));
    assert_eq!(lamp.flux, None);
    let candela = Amount::Photometric(LuminousIntensity::from_candelas(1.0));
    assert_eq!(lamp.unit, candela);
    let opening = Opening::Box {
        width: 0.6,
        length: 1.2,
        height: 0.0,
    };
    assert_eq!(lamp.opening, opening);
    assert!((lamp.far_field.flux() - 20.0 * std::f64::consts::PI).abs() < 1e-12);
}

#[test]
fn keys_are_read() {
    let keys = r#"
aim = [0, 1, -1]
c0 = [0, 1, 0]
emit = "point"
flux = "3 klm"
dimming = 0.5
maintenance_factor = 0.8
file_unit = "mW/sr"
"#;
    let scene = describe(&format!("{LAMP}{keys}"));
    let lamp = luminaires(&scene)[0];
    assert_eq!(lamp.aim, Vector::new(0.0, 1.0, -1.0));
    assert_eq!(lamp.c0, Vector::new(0.0, 1.0, 0.0));
    assert_eq!((lamp.dimming, lamp.maintenance_factor), (0.5, 0.8));
    let flux = LuminousFlux::from_lumens(3000.0);
    assert_eq!(lamp.flux, Some(Amount::Photometric(flux)));
    let milliwatt = Amount::Radiant(Intensity::from_watts_per_steradian(1e-3));
    assert_eq!((lamp.unit, lamp.opening), (milliwatt, Opening::Point));
}

/// A file with y up: what hangs straight down hangs down, whichever axis that is.
#[test]
fn down_is_down_in_every_file() {
    let scene = describe(&format!("[scene]\nup = \"y\"\n{LAMP}"));
    let lamp = luminaires(&scene)[0];
    assert_eq!(lamp.position, Point::new(1.0, -3.0, 2.0));
    assert_eq!(lamp.aim, Vector::new(0.0, 0.0, -1.0));
    assert_eq!(lamp.c0, Vector::new(1.0, 0.0, 0.0));
}

#[test]
fn lights_of_the_same_file_share_its_table() {
    let scene = describe(&format!("{LAMP}{LAMP}dimming = 0.5\n"));
    let [first, second] = luminaires(&scene)[..] else {
        panic!("{scene:?}")
    };
    assert!(Arc::ptr_eq(&first.far_field, &second.far_field));
}

#[test]
fn the_files_of_luminaires_count_for_the_hash() {
    let other = LAMP.replace("downlight", "point");
    assert_ne!(load(LAMP).hash, load(&other).hash);
    assert_eq!(load(LAMP).hash, load(LAMP).hash);
}

#[test]
fn what_is_wrong_with_a_file_is_told_at_its_line() {
    let other = |file: &str| problem(&LAMP.replace("parts/downlight.ies", file));
    assert!(
        other("parts/lamp.csv").contains("expected a luminaire file (.ies, .ldt or TM-33 .xml)")
    );
    assert!(other("none.ies").contains("cannot read the luminaire"));
    let broken = other("broken.ies");
    assert!(broken.starts_with("broken.ies, line 5: "), "{broken}");
}

#[test]
fn an_opening_must_be_there_to_emit() {
    let lamp = LAMP.replace("downlight", "point");
    assert!(problem(&format!("{lamp}emit = \"opening\"\n")).contains("no luminous opening"));
    assert_eq!(luminaires(&describe(&lamp))[0].opening, Opening::Point);
    assert!(problem(&format!("{LAMP}emit = \"hole\"\n")).contains("one of"));
}

#[test]
fn numbers_out_of_their_range_are_refused() {
    let found = |keys: &str| {
        let scene = load(&format!("{LAMP}{keys}\n{SENSOR}"));
        let problems = Scene::new(&scene.description).err().unwrap_or_default();
        assert_eq!(problems.len(), 1, "{problems:?}");
        let diagnostic = scene.diagnostic(&problems[0]);
        let (file, span) = (diagnostic.file.unwrap(), diagnostic.span.unwrap());
        format!("{}: {}", &file.text[span], diagnostic.message)
    };
    let parallel = found("aim = [0, 2, 0]\nc0 = [0, 1, 0]");
    assert!(parallel.starts_with("[0, 1, 0]: c0 = [0, 1, 0] is parallel to the aim"));
    assert!(found("dimming = 1.2").starts_with("1.2: dimming lies between 0 and 1"));
    assert!(found("maintenance_factor = 0").contains("lies above 0"));
    assert!(found("aim = [0, 0, 0]").contains("finite and not zero"));
    assert!(found("flux = \"-1 lm\"").contains("not negative"));
}
