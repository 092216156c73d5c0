//! How an author's numbers become curves in a run by wavelength.

use std::sync::Arc;

use super::{LaneCurve, LaneError, MAX_LANES};
use crate::spectrum::{
    Beyond, Curve, Grid, Illuminant, LaneValues, Observer, Sigmoid, VISIBLE, xyz_of,
};

/// The smooth reflectance of an RGB colour.
pub(super) fn colour(values: &LaneValues, grid: &Grid) -> Result<Curve, LaneError> {
    let LaneValues::Rgb(rgb) = values else {
        return Err(LaneError::BandsInSpectral);
    };
    check_visible(grid)?;
    let range = grid.range();
    if let Some(&outside) = rgb.iter().find(|value| !(0.0..=1.0).contains(*value)) {
        return Err(LaneError::Reflectance(outside));
    }
    Sigmoid::from_rgb(*rgb)
        .curve(range, 1.0)
        .map_err(|_| LaneError::Spectrum)
}

/// A colour of any brightness: the greatest lane times the reflectance of the rest.
pub(super) fn unbounded_colour(values: &LaneValues, grid: &Grid) -> Result<LaneCurve, LaneError> {
    let LaneValues::Rgb(rgb) = values else {
        return Err(LaneError::BandsInSpectral);
    };
    let greatest = rgb.iter().fold(1.0, |a: f64, b| a.max(*b));
    let hue = LaneValues::Rgb(rgb.map(|lane| lane / greatest));
    Ok(by_wavelength(colour(&hue, grid)?).map(|lane| lane * greatest))
}

/// X, Y and Z of a curve under D65, which of 1 are those of D65 with Y = 1.
pub(super) fn daylight_mean(curve: &Curve) -> [f64; 3] {
    let white = Illuminant::D65.curve();
    let [_, y, _] = xyz_of(white, None, Observer::Cie1931);
    xyz_of(white, Some(curve), Observer::Cie1931).map(|value| value / y)
}

/// Nothing is known of a colour beyond what the eye sees.
pub(super) fn check_visible(grid: &Grid) -> Result<(), LaneError> {
    let range = grid.range();
    if range[0] < VISIBLE[0] || range[1] > VISIBLE[1] {
        return Err(LaneError::RgbBeyondVisible { range });
    }
    Ok(())
}

/// The shape of a light's spectrum, and the wavelengths that its watts refer to; equal energy unless stated.
pub(super) fn emission(
    shape: Option<&LaneValues>,
    grid: &Grid,
) -> Result<(Curve, [f64; 2]), LaneError> {
    let (curve, watts) = match shape {
        None => (Curve::constant(1.0), VISIBLE),
        Some(LaneValues::Uniform(value)) => (Curve::constant(*value), VISIBLE),
        Some(LaneValues::Curve { curve, watts }) => (Curve::clone(curve), *watts),
        Some(LaneValues::Bands(_)) => return Err(LaneError::BandsInSpectral),
        Some(LaneValues::Rgb(rgb)) => {
            let greatest = rgb.iter().fold(0.0, |a: f64, b| a.max(*b));
            if greatest.is_nan() || greatest <= 0.0 {
                return Err(LaneError::Spectrum);
            }
            let hue = LaneValues::Rgb(rgb.map(|value| value / greatest));
            let white = Illuminant::D65.curve();
            (colour(&hue, grid)?.times(white), VISIBLE)
        }
    };
    let valid = curve.min() >= 0.0 && curve.max().is_finite() && curve.max() > 0.0;
    if valid {
        Ok((curve, watts))
    } else {
        Err(LaneError::Spectrum)
    }
}

pub(super) fn by_wavelength(curve: Curve) -> LaneCurve {
    LaneCurve {
        lanes: [1.0; MAX_LANES],
        curve: Some(Arc::new(curve)),
    }
}

/// Lanes of a light whose shape has the power `per_unit`.
pub(super) fn scaled_to(
    power: f64,
    per_unit: f64,
    curve: Curve,
    range: [f64; 2],
) -> Result<LaneCurve, LaneError> {
    if per_unit.is_nan() || per_unit <= 0.0 {
        return Err(LaneError::NoPower { range });
    }
    let factor = power / per_unit;
    let is_constant = curve.values().len() == 1 && curve.beyond() == Beyond::Held;
    Ok(if is_constant {
        [factor * curve.values()[0]; MAX_LANES].into()
    } else {
        LaneCurve {
            lanes: [factor; MAX_LANES],
            curve: Some(Arc::new(curve)),
        }
    })
}
