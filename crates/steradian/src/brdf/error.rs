//! What is wrong with the parameters of a model.

use crate::quantity::Spectrum;

/// A parameter that no surface can have.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// Outside its range, infinite or NaN.
    #[error("{parameter} must lie between {low} and {high}, got {found}")]
    OutOfRange {
        /// The parameter's name.
        parameter: &'static str,
        /// The least value allowed.
        low: f64,
        /// The largest value allowed.
        high: f64,
        /// What was given.
        found: f64,
    },
    /// More light would leave the surface than reached it.
    #[error("{parts} add up to {sum}, but a surface cannot scatter more light than it receives")]
    GainsEnergy {
        /// The parameters that are added.
        parts: &'static str,
        /// The largest sum of a lane.
        sum: f64,
    },
    /// Interfaces to media of different indices in one surface.
    #[error("parts that let light through must do so at one index, got {first} and {other}")]
    DifferentIndices {
        /// Of the first part that is an interface.
        first: f64,
        /// Of another.
        other: f64,
    },
}

/// `found`, if it lies in this range.
pub(super) fn in_range(
    parameter: &'static str,
    found: f64,
    [low, high]: [f64; 2],
) -> Result<f64, ModelError> {
    if (low..=high).contains(&found) {
        return Ok(found);
    }
    Err(ModelError::OutOfRange {
        parameter,
        low,
        high,
        found,
    })
}

/// All four numbers, if they lie in this range.
pub(super) fn lanes_in_range(
    parameter: &'static str,
    found: [f64; 4],
    range: [f64; 2],
) -> Result<[f64; 4], ModelError> {
    for lane in found {
        in_range(parameter, lane, range)?;
    }
    Ok(found)
}

/// Lanes that all lie between 0 and 1.
pub(super) fn share(parameter: &'static str, found: Spectrum) -> Result<Spectrum, ModelError> {
    lanes_in_range(parameter, found.to_lanes().map(f64::from), [0.0, 1.0])?;
    Ok(found)
}

/// What reflected and transmitted light are multiplied by.
pub(super) fn tints(
    reflection: Spectrum,
    transmission: Spectrum,
) -> Result<[Spectrum; 2], ModelError> {
    Ok([
        share("tint of reflection", reflection)?,
        share("tint of transmission", transmission)?,
    ])
}

/// Refuses two shares of the same light that add up to more than 1, but for the rounding of single precision.
pub(super) fn at_most_all(parts: &'static str, a: Spectrum, b: Spectrum) -> Result<(), ModelError> {
    let sum = f64::from((a + b).max_lane());
    if sum > 1.0 + f64::from(f32::EPSILON) {
        return Err(ModelError::GainsEnergy { parts, sum });
    }
    Ok(())
}
