//! Cameras: which numbers make a projection.

use super::Fault;
use super::description::{CameraDescription, Fisheye, Projection};
use crate::quantity::{Angle, Length};
use crate::sensor::{Camera, Kind};

/// Most pixels along a side of a picture.
const MOST_PIXELS: u32 = 65_536;

pub(super) fn camera_of(camera: &CameraDescription) -> Result<Kind, Fault> {
    check(camera.projection)?;
    let mut sides = camera.resolution.iter();
    if sides.any(|pixels| !(1..=MOST_PIXELS).contains(pixels)) {
        let message = format!("a picture has 1 to {MOST_PIXELS} pixels each way");
        return Err(("resolution", message));
    }
    let prepared = Camera::new(
        camera.position,
        camera.look_at,
        camera.up,
        camera.projection,
        camera.resolution,
    );
    prepared.map(Kind::Camera).ok_or((
        "look_at",
        "look_at differs from position, and up from the direction of view".into(),
    ))
}

fn check(projection: Projection) -> Result<(), Fault> {
    match projection {
        Projection::Perspective { fov } => below(fov, "a perspective camera's fov", 180.0),
        Projection::ThinLens {
            fov,
            aperture_radius,
            focus_distance,
        } => {
            below(fov, "a thin-lens camera's fov", 180.0)?;
            if aperture_radius != Length::ZERO {
                positive("aperture_radius", aperture_radius)?;
            }
            positive("focus_distance", focus_distance)
        }
        Projection::Orthographic { width } => positive("width", width),
        Projection::Panorama => Ok(()),
        Projection::Fisheye { mapping, fov } => {
            let most = if mapping == Fisheye::Hemispherical {
                180.0
            } else {
                360.0
            };
            up_to(fov, "the fov of this fisheye", most)
        }
    }
}

fn below(fov: Angle, what: &str, limit: f64) -> Result<(), Fault> {
    let degrees = fov.to_degrees();
    if degrees > 0.0 && degrees < limit {
        return Ok(());
    }
    let message = format!("{what} lies between 0 and {limit} deg, not {degrees} deg");
    Err(("fov", message))
}

fn up_to(fov: Angle, what: &str, most: f64) -> Result<(), Fault> {
    let degrees = fov.to_degrees();
    if degrees > 0.0 && degrees <= most {
        return Ok(());
    }
    let message = format!("{what} is above 0 and at most {most} deg, not {degrees} deg");
    Err(("fov", message))
}

fn positive(key: &'static str, length: Length) -> Result<(), Fault> {
    if length.is_finite() && length > Length::ZERO {
        return Ok(());
    }
    let metres = length.to_metres();
    Err((key, format!("{key} is above 0, not {metres} m")))
}
