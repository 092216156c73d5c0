//! Scenes from descriptions, and what is said of those that are none.

mod building;
mod problems;
mod units;
mod unseen;

use std::sync::Arc;

use super::description::*;
use super::*;
use crate::geometry::{Transform, Vector};
use crate::quantity::{Amount, Angle, Intensity, LuminousIntensity};

/// A grey square, a point light above it and a sensor on it.
fn valid() -> SceneDescription {
    SceneDescription {
        name: "valid".into(),
        materials: vec![lambertian("grey", 0.5)],
        shapes: vec![shape(square(1.0), Some("grey"))],
        lights: vec![light(point(Amount::Radiant(
            Intensity::from_watts_per_steradian(100.0),
        )))],
        sensors: vec![irradiance("desk", [0.5, 0.5, 0.0])],
        ..SceneDescription::default()
    }
}

fn lambertian(name: &str, reflectance: f64) -> MaterialDescription {
    let reflectance = LaneValues::Uniform(reflectance).into();
    MaterialDescription::new(name, MaterialModel::Lambertian { reflectance })
}

fn shape(geometry: GeometryDescription, material: Option<&str>) -> ShapeDescription {
    ShapeDescription {
        name: None,
        geometry,
        material: material.map(String::from),
        transform: Transform::IDENTITY,
        repeat: None,
        emission: None,
    }
}

/// In the plane z = 0, from the origin.
fn square(side: f64) -> GeometryDescription {
    GeometryDescription::Rectangle {
        origin: Point::ORIGIN,
        edges: [Vector::new(side, 0.0, 0.0), Vector::new(0.0, side, 0.0)],
    }
}

fn polygon(corners: &[[f64; 3]]) -> GeometryDescription {
    GeometryDescription::Polygon {
        vertices: corners.iter().copied().map(Point::from).collect(),
        holes: vec![],
    }
}

fn sphere(center: [f64; 3], radius: f64) -> GeometryDescription {
    GeometryDescription::Sphere {
        center: Point::from(center),
        radius,
        inside: false,
        ports: vec![],
    }
}

/// From the origin to (1, 2, 3).
fn block(inside: bool) -> GeometryDescription {
    GeometryDescription::Box {
        min: Point::ORIGIN,
        max: Point::new(1.0, 2.0, 3.0),
        inside,
        faces: vec![],
        openings: vec![],
    }
}

fn mesh(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> GeometryDescription {
    GeometryDescription::Mesh(Arc::new(MeshData {
        vertices: vertices.iter().copied().map(Point::from).collect(),
        triangles: triangles.to_vec(),
        ..MeshData::default()
    }))
}

fn light(kind: LightKind) -> LightDescription {
    LightDescription {
        name: None,
        group: None,
        spectrum: None,
        schedule: None,
        repeat: None,
        kind,
    }
}

fn point(intensity: Amount<Intensity, LuminousIntensity>) -> LightKind {
    LightKind::Point {
        position: Point::new(0.5, 0.5, 1.0),
        power: PointPower::Intensity(intensity),
    }
}

fn irradiance(name: &str, at: [f64; 3]) -> SensorDescription {
    sensor(
        name,
        SensorKind::Irradiance(Receivers::Points(vec![(
            Point::from(at),
            Vector::new(0.0, 0.0, 1.0),
        )])),
    )
}

fn sensor(name: &str, kind: SensorKind) -> SensorDescription {
    SensorDescription {
        name: name.into(),
        response: None,
        bins: None,
        kind,
    }
}

#[track_caller]
fn scene(description: &SceneDescription) -> Scene {
    Scene::new(description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

#[track_caller]
fn problems(description: &SceneDescription) -> Vec<Problem> {
    Scene::new(description).err().expect("a problem")
}

/// Expects one problem, at this place, that says this.
#[track_caller]
fn one_problem(description: &SceneDescription, part: Part, key: Option<&'static str>, says: &str) {
    let found = problems(description);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].place, Place { part, key }, "{}", found[0].message);
    assert!(found[0].message.contains(says), "{}", found[0].message);
}
