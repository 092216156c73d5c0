//! Spectra by wavelength: tables, illuminants, temperatures, responses and bins.

use std::sync::Arc;

use steradian::scene::description::{
    Bins, LaneValues, MaterialModel, Response, SceneDescription, SpectrumMode,
};
use steradian::spectrum::{Beyond, Curve, Illuminant};
use steradian_io::diagnostic::{Diagnostic, render};
use steradian_io::scene_file::{LoadedScene, read_scene_str};

use crate::files;

const PAINTS: &str = "nm,white,black\n400,0.7,0.02\n500,0.8,0.04\n700,0.9,0.04\n";

const SCENE: &str = r#"
[scene]
spectrum = "spectral"

[materials.paint]
model = "lambertian"
reflectance = REFLECTANCE

[[lights]]
kind = "point"
position = [0, 0, 1]
flux = "1 W"
spectrum = SPECTRUM

[[sensors]]
name = "meter"
kind = "irradiance"
points = [[0, 0, 0, 0, 0, 1]]
SENSOR
"#;

fn read(reflectance: &str, spectrum: &str, sensor: &str) -> Result<LoadedScene, Vec<Diagnostic>> {
    let text = SCENE
        .replace("REFLECTANCE", reflectance)
        .replace("SPECTRUM", spectrum)
        .replace("SENSOR", sensor);
    read_scene_str("scene.toml", &text, &files().with("paints.csv", PAINTS))
}

fn describe(reflectance: &str, spectrum: &str, sensor: &str) -> SceneDescription {
    match read(reflectance, spectrum, sensor) {
        Ok(loaded) => loaded.description,
        Err(problems) => panic!("{}", render(&problems, false)),
    }
}

fn reflectance(text: &str) -> LaneValues {
    let scene = describe(text, "\"E\"", "");
    let MaterialModel::Lambertian { reflectance } = &scene.materials[0].model else {
        panic!("{scene:?}")
    };
    reflectance.factor.clone()
}

fn light(text: &str) -> (Arc<Curve>, [f64; 2]) {
    let scene = describe("0.5", text, "");
    match scene.lights[0].spectrum.clone() {
        Some(LaneValues::Curve { curve, watts }) => (curve, watts),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_reflectance_is_held_beyond_its_table() {
    let samples = vec![(400.0, 0.02), (500.0, 0.04), (700.0, 0.04)];
    let black = LaneValues::table(Curve::new(samples, Beyond::Held).unwrap());
    assert_eq!(
        reflectance("[[400, 0.02], [500, 0.04], [700, 0.04]]"),
        black
    );
    assert_eq!(
        reflectance("{ file = \"paints.csv\", column = \"black\" }"),
        black
    );
    let LaneValues::Curve { curve, .. } = reflectance("{ file = \"paints.csv\" }") else {
        panic!("no table")
    };
    assert_eq!((curve.at(300.0), curve.at(450.0)), (0.7, 0.75));
}

#[test]
fn a_lamp_is_dark_beyond_its_table_and_its_watts_are_those_of_the_table() {
    for text in ["[[400, 2], [500, 4]]", "{ file = \"paints.csv\" }"] {
        let (curve, watts) = light(text);
        assert_eq!((curve.at(399.0), curve.beyond()), (0.0, Beyond::Zero));
        assert_eq!(watts, curve.range());
    }
}

#[test]
fn watts_of_illuminants_are_those_from_360_to_830_nm() {
    for (text, illuminant) in [
        ("\"D65\"", Illuminant::D65),
        ("{ illuminant = \"A\" }", Illuminant::A),
        ("\"LED-B3\"", Illuminant::LedB3),
    ] {
        let (curve, watts) = light(text);
        assert_eq!((&*curve, watts), (illuminant.curve(), [360.0, 830.0]));
    }
    let (lamp, watts) = light("{ blackbody = \"2856 K\" }");
    assert_eq!(watts, [360.0, 830.0]);
    // Illuminant A is the black body of 2848 K · 1.4388/1.435 = 2855.5 K: within Wien's 14388/λ · 0.5/2856² of 2856 K.
    let relative = |wavelength: f64| lamp.at(wavelength) / lamp.at(560.0) * 100.0;
    let a = Illuminant::A.curve();
    assert!((relative(400.0) / a.at(400.0) - 1.0).abs() < 1e-3);
    assert!((relative(780.0) / a.at(780.0) - 1.0).abs() < 1e-3);
    let (daylight, _) = light("{ daylight = \"5000 K\" }");
    assert_eq!(daylight.at(560.0), 100.0);
}

#[test]
fn lights_may_still_have_colours() {
    let spectrum = |text: &str| describe("0.5", text, "").lights[0].spectrum.clone();
    assert_eq!(
        spectrum("[1, 0.5, 0]"),
        Some(LaneValues::Rgb([1.0, 0.5, 0.0]))
    );
    assert_eq!(spectrum("\"#ffffff\""), Some(LaneValues::Rgb([1.0; 3])));
    assert_eq!(spectrum("2"), Some(LaneValues::Uniform(2.0)));
}

#[test]
fn ranges_responses_and_bins() {
    let scene = describe(
        "0.5",
        "\"E\"",
        "response = \"melanopic\"\nbins = \"400:700:10 nm\"",
    );
    assert_eq!(
        scene.spectrum,
        SpectrumMode::Spectral {
            range: [360.0, 830.0]
        }
    );
    let sensor = &scene.sensors[0];
    assert_eq!(sensor.response, Some(Response::Melanopic));
    let bins = Bins {
        range: [400.0, 700.0],
        width: 10.0,
        per_nm: false,
    };
    assert_eq!(sensor.bins, Some(bins));
    for (name, response) in [
        ("scotopic", Response::Scotopic),
        ("xyz", Response::Xyz),
        ("par", Response::Par),
    ] {
        let scene = describe("0.5", "\"E\"", &format!("response = {name:?}"));
        assert_eq!(scene.sensors[0].response, Some(response));
    }
    let text = SCENE.replace("\"spectral\"", "{ range = \"380:780 nm\" }");
    let text = text
        .replace("REFLECTANCE", "0.5")
        .replace("SPECTRUM", "\"E\"");
    let scene = crate::describe(&text.replace("SENSOR", "bins = \"380:780:5 nm\"\nper_nm = true"));
    assert_eq!(
        scene.spectrum,
        SpectrumMode::Spectral {
            range: [380.0, 780.0]
        }
    );
    assert!(scene.sensors[0].bins.is_some_and(|bins| bins.per_nm));
}

#[test]
fn a_response_may_be_a_table() {
    let sensor = "response = { file = \"paints.csv\", column = \"white\" }";
    let response = describe("0.5", "\"E\"", sensor).sensors[0].response.clone();
    let Some(Response::Table { name, curve }) = response else {
        panic!("{response:?}")
    };
    assert_eq!(name, "paints.csv white");
    assert_eq!((curve.at(500.0), curve.beyond()), (0.8, Beyond::Zero));
}

/// One problem, with the text it is about.
#[track_caller]
fn one_problem(reflectance: &str, spectrum: &str, sensor: &str, at: &str, says: &str) {
    let problems = match read(reflectance, spectrum, sensor) {
        Ok(_) => panic!("no problem with {reflectance} {spectrum} {sensor}"),
        Err(problems) => problems,
    };
    let shown = render(&problems, false);
    assert_eq!(problems.len(), 1, "{shown}");
    assert!(shown.contains(says), "{shown}");
    let (file, span) = (problems[0].file.clone(), problems[0].span.clone());
    let place = file
        .zip(span)
        .map(|(file, span)| file.text[span].to_owned());
    assert_eq!(place.as_deref(), Some(at));
}

#[test]
fn mistakes_in_tables() {
    let table = |text: &str, at: &str, says: &str| one_problem(text, "\"E\"", "", at, says);
    table(
        "[[400, 0.1], [400, 0.2]]",
        "[400, 0.2]",
        "wavelengths must increase: sample 1 at 400 nm follows 400 nm",
    );
    table("[[400, 0.1], [500]]", "[500]", "an array of 2");
    table("[[400, 0.1], \"x\"]", "\"x\"", "an array of 2");
    table(
        "{ file = \"paints.csv\", column = \"grey\" }",
        "\"paints.csv\"",
        "there is no column \"grey\"; the columns are white, black",
    );
    table("{ file = \"none.csv\" }", "\"none.csv\"", "no such file");
    table(
        "{ file = \"paints.csv\", colum = \"white\" }",
        "colum",
        "did you mean `column`?",
    );
    table("{ file = \"broken.obj\" }", "\"broken.obj\"", "no spectrum");
}

#[test]
fn mistakes_in_lights() {
    let light = |text: &str, at: &str, says: &str| one_problem("0.5", text, "", at, says);
    light("\"D66\"", "\"D66\"", "expected one of \"A\", \"D50\"");
    light(
        "{ illuminant = \"X\" }",
        "\"X\"",
        "expected one of \"A\", \"D50\"",
    );
    light("{ blackbody = 2700 }", "2700", "2700 K");
    light(
        "{ blackbody = \"-1 K\" }",
        "\"-1 K\"",
        "a temperature is positive",
    );
    light(
        "{ daylight = \"2700 K\" }",
        "\"2700 K\"",
        "daylight is defined from 4000 K to 25000 K",
    );
    light(
        "{ illuminant = \"A\", blackbody = \"2700 K\" }",
        "\"2700 K\"",
        "exclude each other",
    );
}

#[test]
fn mistakes_in_sensors() {
    let sensor = |text: &str, at: &str, says: &str| one_problem("0.5", "\"E\"", text, at, says);
    sensor(
        "bins = \"400:700 nm\"",
        "\"400:700 nm\"",
        "two wavelengths and a step",
    );
    sensor("per_nm = true", "true", "only beside `bins`");
    sensor(
        "response = \"photopik\"",
        "\"photopik\"",
        "did you mean \"photopic\"?",
    );
    sensor(
        "response = { column = \"x\" }",
        "{ column = \"x\" }",
        "missing key `file`",
    );
}
