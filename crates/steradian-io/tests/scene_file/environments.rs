//! Pictures of all directions as lights: what a scene file says of them, and what may be wrong.

use steradian::geometry::Vector;
use steradian::quantity::{Amount, Irradiance, Luminance, Radiance};
use steradian::scene::Scene;
use steradian::scene::description::{
    EnvironmentAmount, EnvironmentDescription, LightKind, SceneDescription,
};

use crate::{describe, load, problems};

const SKY: &str = "[[lights]]\nkind = \"environment\"\nfile = \"parts/half.hdr\"\n";
const SENSOR: &str =
    "[[sensors]]\nname = \"up\"\nkind = \"irradiance\"\npoints = [[0, 0, 0, 0, 0, 1]]\n";

fn sky(scene: &SceneDescription) -> &EnvironmentDescription {
    match &scene.lights[0].kind {
        LightKind::EnvironmentMap(environment) => environment,
        other => panic!("{other:?}"),
    }
}

#[test]
fn keys_have_defaults() {
    let scene = describe(SKY);
    let one = Radiance::from_watts_per_square_metre_steradian(1.0);
    let unit = EnvironmentAmount::Unit(Amount::Radiant(one));
    assert_eq!(sky(&scene).amount, unit);
    assert_eq!(sky(&scene).middle, Vector::new(0.0, 1.0, 0.0));
    assert_eq!(sky(&scene).picture.size(), [1, 1]);
}

#[test]
fn keys_are_read() {
    let scene = describe(&format!("{SKY}middle = [1, 0, 0]\nunit = \"3 cd/m2\"\n"));
    let three = Luminance::from_candelas_per_square_metre(3.0);
    let unit = EnvironmentAmount::Unit(Amount::Photometric(three));
    assert_eq!(sky(&scene).amount, unit);
    assert_eq!(sky(&scene).middle, Vector::new(1.0, 0.0, 0.0));
    let scene = describe(&format!("{SKY}irradiance = \"100 W/m2\"\n"));
    let hundred = Irradiance::from_watts_per_square_metre(100.0);
    let stated = EnvironmentAmount::Irradiance(Amount::Radiant(hundred));
    assert_eq!(sky(&scene).amount, stated);
}

#[test]
fn keys_exclude_each_other() {
    let message = |text: &str| {
        let found = problems(text);
        assert_eq!(found.len(), 1, "{found:?}");
        found[0].message.clone()
    };
    let both = format!("{SKY}unit = \"1 cd/m2\"\nirradiance = \"100 lx\"\n");
    assert!(message(&both).contains("exclude each other"));
    let radiance = format!("{SKY}radiance = \"1 cd/m2\"\n");
    assert!(message(&radiance).contains("exclude each other"));
    let alone = "[[lights]]\nkind = \"environment\"\nradiance = \"1 cd/m2\"\nmiddle = [1, 0, 0]\n";
    assert!(message(alone).contains("only beside `file`"));
    let neither = "[[lights]]\nkind = \"environment\"\n";
    assert!(message(neither).contains("one of `radiance`, `file`"));
    let missing = SKY.replace("half", "none");
    assert!(message(&missing).contains("cannot read"));
}

#[test]
fn the_middle_is_not_upright() {
    let scene = load(&format!("{SKY}middle = [0, 0, 1]\n{SENSOR}"));
    let problems = Scene::new(&scene.description).err().unwrap_or_default();
    assert!(problems[0].message.contains("not upright"), "{problems:?}");
}
