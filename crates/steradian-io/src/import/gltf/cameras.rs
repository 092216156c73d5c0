//! Cameras look along their node's −z, with y up; the scale of a node is passed over.
//!
//! A perspective of vertical angle β and aspect a has the horizontal angle 2 atan(a tan(β/2)). An orthographic
//! camera shows 2 xmag × 2 ymag metres.

use std::f64::consts::PI;

use steradian::geometry::{Direction, Point, Transform, Vector};
use steradian::quantity::{Angle, Length};
use steradian::scene::description::{CameraDescription, Projection};

use super::error::GltfError;
use super::schema::{Camera, Orthographic, Perspective};

/// Rows of a picture; the file states only the ratio of its sides.
const ROWS: u32 = 720;

/// The ratio of width to height of a picture where the file states none.
const WIDE: f64 = 16.0 / 9.0;

/// A camera at a node.
pub(super) fn read(
    camera: &Camera,
    transform: &Transform,
    place: &str,
) -> Result<CameraDescription, GltfError> {
    let (projection, aspect) = match (&camera.perspective, &camera.orthographic) {
        (Some(perspective), _) => of_perspective(perspective, place)?,
        (None, Some(orthographic)) => of_orthographic(orthographic, place)?,
        (None, None) => return Err(GltfError::at(place, "it states no projection")),
    };
    let position = transform.point(Point::ORIGIN);
    let ahead = transform.vector(Vector::new(0.0, 0.0, -1.0));
    let ahead = Direction::new(ahead)
        .map_err(|_| GltfError::at(place, "its node leaves it no direction"))?;
    Ok(CameraDescription {
        position,
        look_at: position + ahead.to_vector(),
        up: transform.vector(Vector::new(0.0, 1.0, 0.0)),
        projection,
        resolution: [(f64::from(ROWS) * aspect).round() as u32, ROWS],
    })
}

/// The projection with the ratio of width to height.
fn of_perspective(perspective: &Perspective, place: &str) -> Result<(Projection, f64), GltfError> {
    let angle = perspective.yfov;
    if !(angle > 0.0 && angle < PI) {
        let fault = format!("its yfov lies between 0 and π, not {angle}");
        return Err(GltfError::at(place, fault));
    }
    let aspect = aspect(perspective.aspect_ratio.unwrap_or(WIDE), place)?;
    let half_width = aspect * libm::tan(angle / 2.0);
    let fov = Angle::from_radians(2.0 * libm::atan(half_width));
    Ok((Projection::Perspective { fov }, aspect))
}

fn of_orthographic(
    orthographic: &Orthographic,
    place: &str,
) -> Result<(Projection, f64), GltfError> {
    let [x, y] = [orthographic.xmag, orthographic.ymag].map(f64::abs);
    let aspect = aspect(x / y, place)?;
    let width = Length::from_metres(2.0 * x);
    Ok((Projection::Orthographic { width }, aspect))
}

/// A ratio that a picture of so many rows can have.
fn aspect(aspect: f64, place: &str) -> Result<f64, GltfError> {
    if aspect > 0.01 && aspect < 80.0 {
        return Ok(aspect);
    }
    let fault = format!("the ratio of its width to its height is {aspect}");
    Err(GltfError::at(place, fault))
}
