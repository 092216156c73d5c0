//! What a file without a camera or without light is shown with.

use std::f64::consts::PI;

use steradian::geometry::{Bounds, Direction, Point, Vector};
use steradian::quantity::{Amount, Angle, Luminance};
use steradian::scene::description::{
    CameraDescription, GeometryDescription, LightDescription, LightKind, Projection,
    SceneDescription, SensorDescription, SensorKind,
};

use super::error::GltfError;

/// Illuminance of every surface that sees nothing but the sky, in lx.
const ILLUMINANCE: f64 = 1000.0;

/// Full horizontal angle of view, in degrees, of a picture of 4 : 3.
const FIELD_OF_VIEW: f64 = 45.0;

/// An environment of constant luminance L = E/π.
pub(super) fn environment() -> LightDescription {
    let luminance = Luminance::from_candelas_per_square_metre(ILLUMINANCE / PI);
    LightDescription {
        name: Some("environment".into()),
        group: None,
        spectrum: None,
        repeat: None,
        kind: LightKind::Environment {
            radiance: Amount::Photometric(luminance),
        },
    }
}

/// A camera to the front right of everything and above it, that has all of it in its picture.
pub(super) fn camera(description: &SceneDescription) -> Result<SensorDescription, GltfError> {
    let bounds = bounds(description);
    let center = bounds.center().ok_or(GltfError::Empty)?;
    let radius = 0.5 * bounds.diagonal().to_metres();
    let [width, height] = [960, 720];
    let half_width = libm::tan(0.5 * FIELD_OF_VIEW.to_radians());
    let half_height = libm::atan(half_width * f64::from(height) / f64::from(width));
    let back = Direction::new(Vector::new(0.4, -1.0, 0.5)).map_err(|_| GltfError::Empty)?;
    let camera = CameraDescription {
        position: center + back * (radius / libm::sin(half_height)),
        look_at: center,
        up: Vector::new(0.0, 0.0, 1.0),
        projection: Projection::Perspective {
            fov: Angle::from_degrees(FIELD_OF_VIEW),
        },
        resolution: [width, height],
    };
    Ok(SensorDescription {
        name: "camera".into(),
        response: None,
        kind: SensorKind::Camera(camera),
    })
}

fn bounds(description: &SceneDescription) -> Bounds {
    let points = description.shapes.iter().flat_map(|shape| {
        let vertices: &[Point] = match &shape.geometry {
            GeometryDescription::Mesh(mesh) => &mesh.vertices,
            _ => &[],
        };
        vertices.iter().map(|vertex| shape.transform.point(*vertex))
    });
    Bounds::around(points)
}
