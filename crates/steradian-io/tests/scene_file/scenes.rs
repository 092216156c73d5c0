//! The shipped scenes are read, and say what their headers derive.

use std::path::{Path, PathBuf};

use steradian::geometry::{Point, Vector};
use steradian::quantity::Amount;
use steradian::scene::description::{
    EmissionAmount, GeometryDescription, LaneValues, MaterialModel, Projection, SceneDescription,
    SensorKind, ShapeDescription, SpectrumMode,
};
use steradian_io::diagnostic::render;
use steradian_io::files::DiskFiles;
use steradian_io::scene_file::read_scene;

fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

/// A scene of the `scenes` directory.
pub fn shipped(name: &str) -> SceneDescription {
    let path = directory().join(name);
    match read_scene(&path, &DiskFiles::default()) {
        Ok(loaded) => loaded.description,
        Err(problems) => panic!("{}", render(&problems, false)),
    }
}

/// The names of the shipped scenes.
pub fn names() -> Vec<String> {
    let entries = std::fs::read_dir(directory())
        .into_iter()
        .flatten()
        .flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.ends_with(".toml")).collect()
}

#[test]
fn every_shipped_scene_is_read() {
    assert!(names().len() >= 7, "{:?}", names());
    for name in names() {
        let scene = shipped(&name);
        assert!(
            !scene.name.is_empty() && !scene.sensors.is_empty(),
            "{name}"
        );
    }
}

#[test]
fn the_sphere_light_has_the_radiance_of_100_watts_per_steradian() {
    let lamp = shipped("sphere-light.toml").shapes.remove(0);
    let GeometryDescription::Sphere { radius, .. } = lamp.geometry else {
        panic!("{lamp:?}")
    };
    let Some(EmissionAmount::Radiance(Amount::Radiant(radiance))) =
        lamp.emission.map(|emission| emission.amount)
    else {
        panic!("no radiance")
    };
    let intensity =
        radiance.to_watts_per_square_metre_steradian() * std::f64::consts::PI * radius * radius;
    assert!((intensity / 100.0 - 1.0).abs() < 1e-15, "{intensity}");
}

/// The corners of a rectangle of the Cornell box, and its normal, in Mitsuba's axes (y up).
fn rectangle(scene: &SceneDescription, name: &str) -> (Point, Vector) {
    let shape = scene
        .shapes
        .iter()
        .find(|shape| shape.name.as_deref() == Some(name))
        .expect("a shape of this name");
    let GeometryDescription::Rectangle { origin, edges } = shape.geometry else {
        panic!("{shape:?}")
    };
    (
        origin + (edges[0] + edges[1]) * 0.5,
        edges[0].cross(edges[1]),
    )
}

#[test]
fn the_rectangles_of_the_cornell_box_are_mitsubas() {
    let scene = shipped("cornell-box.toml");
    // Centres and normals (times the area) by hand from the transforms in `mitsuba.cornell_box()`.
    let expected = [
        ("lamp", [0.0, 0.99, 0.01], [0.0, -0.46 * 0.38, 0.0]),
        ("floor", [0.0, -1.0, 0.0], [0.0, 4.0, 0.0]),
        ("ceiling", [0.0, 1.0, 0.0], [0.0, -4.0, 0.0]),
        ("back", [0.0, 0.0, -1.0], [0.0, 0.0, 4.0]),
        ("green wall", [1.0, 0.0, 0.0], [-4.0, 0.0, 0.0]),
        ("red wall", [-1.0, 0.0, 0.0], [4.0, 0.0, 0.0]),
    ];
    for (name, center, normal) in expected {
        let (found, found_normal) = rectangle(&scene, name);
        assert!(
            found.distance(center.into()).to_metres() < 1e-15,
            "{name}: {found:?}"
        );
        assert!(
            (found_normal - normal.into()).length() < 1e-15,
            "{name}: {found_normal:?}"
        );
    }
}

/// Where the turned corner (1, 1, 1) of a box of the Cornell box is, in Mitsuba's axes.
fn far_corner(shape: &ShapeDescription) -> Point {
    let image = shape.transform.point(Point::new(1.0, 1.0, 1.0));
    Point::new(image.x, image.z, -image.y)
}

#[test]
fn the_boxes_of_the_cornell_box_are_mitsubas() {
    let scene = shipped("cornell-box.toml");
    let turned = |degrees: f64, half: [f64; 3], center: [f64; 3]| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let [x, y, z] = half;
        Point::new(
            center[0] + x * cos + z * sin,
            center[1] + y,
            center[2] - x * sin + z * cos,
        )
    };
    let small = turned(-17.0, [0.3; 3], [0.335, -0.7, 0.38]);
    let large = turned(18.25, [0.3, 0.61, 0.3], [-0.33, -0.4, -0.28]);
    for (shape, corner) in scene.shapes[6..].iter().zip([small, large]) {
        assert!(
            far_corner(shape).distance(corner).to_metres() < 1e-15,
            "{:?}",
            far_corner(shape)
        );
    }
}

#[test]
fn the_light_and_camera_of_the_cornell_box_are_mitsubas() {
    let scene = shipped("cornell-box.toml");
    assert_eq!(scene.spectrum, SpectrumMode::Rgb);
    let white = MaterialModel::Lambertian {
        reflectance: LaneValues::Rgb([0.885809, 0.698859, 0.666422]).into(),
    };
    assert_eq!(scene.materials[0].model, white);
    let emission = scene.shapes[0].emission.as_ref().unwrap();
    let (Some(LaneValues::Rgb([r, g, b])), EmissionAmount::Radiance(Amount::Radiant(mean))) =
        (&emission.spectrum, emission.amount)
    else {
        panic!("{emission:?}")
    };
    assert_eq!([*r, *g, *b], [18.387, 13.9873, 6.75357]);
    let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    assert!(
        (mean.to_watts_per_square_metre_steradian() / luminance - 1.0).abs() < 1e-12,
        "{luminance}"
    );
    let SensorKind::Camera(camera) = &scene.sensors[0].kind else {
        panic!("no camera")
    };
    // Mitsuba's (0, 0, 3.9) with y up is (0, −3.9, 0) with z up.
    assert!(
        camera
            .position
            .distance(Point::new(0.0, -3.9, 0.0))
            .to_metres()
            == 0.0
    );
    assert_eq!(camera.up, Vector::new(0.0, 0.0, 1.0));
    let Projection::Perspective { fov } = camera.projection else {
        panic!("{:?}", camera.projection)
    };
    assert!((fov.to_degrees() - 39.3077).abs() < 1e-12);
}
