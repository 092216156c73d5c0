//! `KHR_lights_punctual`: point, spot and directional lights.
//!
//! Intensities are in cd, that of a directional light in lx. A light of linear colour c and intensity I has the
//! luminous intensity I · Y(c), Y = 0.2126 r + 0.7152 g + 0.0722 b, and the colour c. Spots and directional lights shine
//! along the node's −z. A spot falls off as ((cosθ − cosθ_o)/(cosθ_i − cosθ_o))² between its inner and outer angles.
//! `range`, an aid of rasterisers, is passed over, and so is the scale of a node.

use std::f64::consts::FRAC_PI_4;

use steradian::geometry::{Point, Transform, Vector};
use steradian::quantity::{Amount, Angle, Illuminance, LuminousIntensity};
use steradian::scene::description::{
    LaneValues, LightDescription, LightKind, PointPower, SpotBeam,
};

use super::error::GltfError;
use super::materials::luminance_of;
use super::notes::Notes;
use super::schema::Light;

/// A light at a node; `None` if it is off.
pub(super) fn read(
    light: &Light,
    transform: &Transform,
    place: &str,
    notes: &mut Notes,
) -> Result<Option<LightDescription>, GltfError> {
    let color = light.color.unwrap_or([1.0; 3]);
    let amount = light.intensity.unwrap_or(1.0) * luminance_of(color);
    if color.iter().any(|lane| *lane < 0.0) || !(amount >= 0.0 && amount.is_finite()) {
        return Err(GltfError::at(
            place,
            "its intensity is negative or infinite",
        ));
    }
    if light.range.is_some() {
        notes.count("lights", "the range of lights is passed over", place);
    }
    if amount == 0.0 {
        return Ok(None);
    }
    Ok(Some(LightDescription {
        name: light.name.clone(),
        group: None,
        spectrum: Some(LaneValues::Rgb(color)),
        schedule: None,
        repeat: None,
        kind: kind(light, amount, transform, place)?,
    }))
}

fn kind(
    light: &Light,
    amount: f64,
    transform: &Transform,
    place: &str,
) -> Result<LightKind, GltfError> {
    let position = transform.point(Point::ORIGIN);
    let direction = transform.vector(Vector::new(0.0, 0.0, -1.0));
    let intensity = LuminousIntensity::from_candelas(amount);
    let power = PointPower::Intensity(Amount::Photometric(intensity));
    Ok(match light.r#type.as_str() {
        "point" => LightKind::Point { position, power },
        "spot" => LightKind::Spot {
            position,
            direction,
            beam: SpotBeam::Smooth {
                inner: Angle::from_radians(light.spot.inner_cone_angle),
                cutoff: Angle::from_radians(light.spot.outer_cone_angle.unwrap_or(FRAC_PI_4)),
            },
            power,
        },
        "directional" => LightKind::Directional {
            direction,
            irradiance: Amount::Photometric(Illuminance::from_lux(amount)),
        },
        other => {
            let fault = format!("there is no light of type {other:?}");
            return Err(GltfError::at(place, fault));
        }
    })
}
