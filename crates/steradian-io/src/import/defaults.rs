//! What an imported scene gets where its file says nothing: a camera that frames it, light, and a material.
//!
//! Each of them is told in the description's warnings.

use std::f64::consts::PI;

use steradian::geometry::{Bounds, Direction, Point, Vector};
use steradian::quantity::{Amount, Angle, Illuminance, Luminance};
use steradian::scene::description::{
    CameraDescription, GeometryDescription, LaneValues, LightDescription, LightKind,
    MaterialDescription, MaterialModel, Projection, SceneDescription, SensorDescription,
    SensorKind, ShapeDescription,
};

/// Illuminance of every surface that sees nothing but the environment, in lx.
const SKY: f64 = 500.0;
/// Illuminance of every surface that faces the parallel light, in lx.
const SUN: f64 = 1000.0;
/// The way of the parallel light: backwards and down, from above the left shoulder of the default camera.
const SUN_DIRECTION: Vector = Vector::new(0.5, 0.6, -1.2);
/// Full horizontal angle of view of the default camera, in degrees.
const FIELD_OF_VIEW: f64 = 45.0;
/// Its picture, in pixels.
const RESOLUTION: [u32; 2] = [960, 720];
/// From the middle of the scene towards the camera: to the front right and above.
const TOWARDS_CAMERA: Vector = Vector::new(0.4, -1.0, 0.5);
/// How much farther away it is than it need be to see every corner of the bounds.
const MARGIN: f64 = 1.05;
/// Reflectance of the default material.
const GREY: f64 = 0.5;

/// Adds what is missing: a grey material for shapes without one, a camera if there is none, and light
/// if nothing emits.
pub fn complete(description: &mut SceneDescription) {
    add_material(description);
    add_camera(description);
    add_light(description);
}

fn add_material(description: &mut SceneDescription) {
    let bare = |shape: &&mut ShapeDescription| shape.material.is_none();
    let name = unused_name("grey", &description.materials);
    let mut count = 0;
    for shape in description.shapes.iter_mut().filter(bare) {
        shape.material = Some(name.clone());
        count += 1;
    }
    if count > 0 {
        let reflectance = LaneValues::Uniform(GREY).into();
        let grey = MaterialDescription::new(name, MaterialModel::Lambertian { reflectance });
        description.materials.push(grey);
        let warning = format!(
            "{count} of {} shapes have no material: a Lambertian one of reflectance {GREY} is used",
            description.shapes.len()
        );
        description.warnings.push(warning);
    }
}

fn unused_name(name: &str, materials: &[MaterialDescription]) -> String {
    let mut name = name.to_owned();
    while materials.iter().any(|material| material.name == name) {
        name.push('\'');
    }
    name
}

fn add_light(description: &mut SceneDescription) {
    let emits = |shape: &ShapeDescription| shape.emission.is_some();
    if description.lights.is_empty() && !description.shapes.iter().any(emits) {
        let warning = format!(
            "the file has no light: lit by a sky of {SKY} lx and parallel light of {SUN} lx"
        );
        description.warnings.push(warning);
        description.lights.extend(lights());
    }
}

fn add_camera(description: &mut SceneDescription) {
    if let (true, Some(camera)) = (description.sensors.is_empty(), camera(description)) {
        let warning = "the file has no camera: shown by one that has everything in its picture";
        description.warnings.push(warning.into());
        description.sensors.push(camera);
    }
}

/// A constant environment, L = E/π, and parallel light: in an environment alone, a white surface is as bright as what is
/// behind it and cannot be seen.
fn lights() -> [LightDescription; 2] {
    let luminance = Luminance::from_candelas_per_square_metre(SKY / PI);
    let sky = LightKind::Environment {
        radiance: Amount::Photometric(luminance),
    };
    let sun = LightKind::Directional {
        direction: SUN_DIRECTION,
        irradiance: Amount::Photometric(Illuminance::from_lux(SUN)),
    };
    [("sky", sky), ("sun", sun)].map(|(name, kind)| LightDescription {
        name: Some(name.into()),
        group: None,
        spectrum: None,
        schedule: None,
        repeat: None,
        kind,
    })
}

/// A camera to the front right of all meshes and above them, that has all of them in its picture; `None` if there are none.
fn camera(description: &SceneDescription) -> Option<SensorDescription> {
    let bounds = bounds(description);
    let middle = bounds.center()?;
    let towards = Direction::new(TOWARDS_CAMERA).ok()?;
    let fov = Angle::from_degrees(FIELD_OF_VIEW);
    let distance = distance(&bounds, middle, towards, fov).max(f64::MIN_POSITIVE);
    let camera = CameraDescription {
        position: middle + towards * (distance * MARGIN),
        look_at: middle,
        up: Vector::new(0.0, 0.0, 1.0),
        projection: Projection::Perspective { fov },
        resolution: RESOLUTION,
    };
    Some(SensorDescription {
        name: "camera".into(),
        response: None,
        bins: None,
        kind: SensorKind::Camera(camera),
    })
}

/// From the middle of the bounds to the nearest place from which all their corners are in the picture.
fn distance(bounds: &Bounds, middle: Point, towards: Direction, fov: Angle) -> f64 {
    let [width, height] = RESOLUTION.map(f64::from);
    let across = libm::tan(fov.to_radians() / 2.0);
    let upwards = across * height / width;
    let towards = Vector::from(towards);
    let right = Vector::new(0.0, 0.0, 1.0).cross(towards);
    let right = right / right.length();
    let up = towards.cross(right);
    let needed = bounds.corners().map(|corner| {
        let corner = corner - middle;
        let aside = (corner.dot(right).abs() / across).max(corner.dot(up).abs() / upwards);
        corner.dot(towards) + aside
    });
    needed.into_iter().fold(0.0, f64::max)
}

/// Around all vertices that triangles use.
fn bounds(description: &SceneDescription) -> Bounds {
    let points = description.shapes.iter().flat_map(|shape| {
        let mesh = match &shape.geometry {
            GeometryDescription::Mesh(mesh) => Some(mesh),
            _ => None,
        };
        let corners = mesh.into_iter().flat_map(|mesh| {
            let corners = mesh.triangles.iter().flatten();
            corners.filter_map(|corner| mesh.vertices.get(*corner as usize))
        });
        corners.map(|vertex| shape.transform.point(*vertex))
    });
    Bounds::around(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use steradian::geometry::Transform;
    use steradian::scene::Scene;
    use steradian::scene::description::{MeshData, SpectrumMode};

    fn triangle() -> SceneDescription {
        let mesh = MeshData {
            vertices: vec![
                Point::new(-1.0, 0.0, 0.0),
                Point::new(3.0, 0.0, 0.0),
                Point::new(0.0, 0.0, 2.0),
                Point::new(0.0, 0.0, 99.0),
            ],
            triangles: vec![[0, 1, 2]],
            ..MeshData::default()
        };
        let shape = ShapeDescription {
            name: None,
            geometry: GeometryDescription::Mesh(Arc::new(mesh)),
            material: None,
            transform: Transform::IDENTITY,
            repeat: None,
            emission: None,
        };
        SceneDescription {
            spectrum: SpectrumMode::Rgb,
            shapes: vec![shape],
            ..SceneDescription::default()
        }
    }

    #[test]
    fn what_is_missing_is_added_once_and_told() {
        let mut description = triangle();
        complete(&mut description);
        assert_eq!(description.warnings.len(), 3);
        assert!(Scene::new(&description).is_ok());
        let SensorKind::Camera(camera) = &description.sensors[0].kind else {
            panic!("no camera")
        };
        assert_eq!(camera.look_at, Point::new(1.0, 0.0, 1.0));
        let (shapes, warnings) = (description.materials.len(), description.warnings.len());
        complete(&mut description);
        assert_eq!(
            (description.materials.len(), description.warnings.len()),
            (shapes, warnings)
        );
    }

    #[test]
    fn every_corner_is_in_the_picture_and_one_touches_its_edge() {
        let bounds = Bounds::around([Point::new(-3.0, -1.0, -2.0), Point::new(3.0, 1.0, 2.0)]);
        let distance = distance(
            &bounds,
            Point::ORIGIN,
            -Direction::Y,
            Angle::from_degrees(90.0),
        );
        // The near face is 1 m before the middle; half its width of 3 m needs 3 m, half its height 2 · 4/3 m.
        assert!((distance - 4.0).abs() < 1e-12);
    }

    #[test]
    fn nothing_needs_no_camera() {
        let mut description = SceneDescription::default();
        complete(&mut description);
        assert!(description.sensors.is_empty());
    }
}
