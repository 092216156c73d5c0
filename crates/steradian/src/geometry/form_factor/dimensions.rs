//! What sizes a form factor can be asked for.

use crate::quantity::Length;

/// Why there is no form factor between shapes of these sizes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DimensionError {
    /// A size that must be positive and finite and is not.
    #[error("the {name} is {value}, but must be positive and finite")]
    NotPositive {
        /// Which size.
        name: &'static str,
        /// What was given.
        value: Length,
    },
    /// An interval that ends before it begins, or at the same place.
    #[error("the {name} runs from {from} to {to}, but must have a length")]
    EmptyInterval {
        /// Which interval.
        name: &'static str,
        /// Where it begins.
        from: Length,
        /// Where it ends.
        to: Length,
    },
    /// An angle out of its range.
    #[error("the {name} must lie between 0 and {limit} degrees")]
    BadAngle {
        /// Which angle.
        name: &'static str,
        /// The largest.
        limit: f64,
    },
    /// Surfaces that would have to lie inside one another.
    #[error("{0}")]
    Intersecting(&'static str),
}

/// Metres, if positive and finite.
pub(super) fn positive(name: &'static str, value: Length) -> Result<f64, DimensionError> {
    let metres = value.to_metres();
    if metres > 0.0 && metres.is_finite() {
        Ok(metres)
    } else {
        Err(DimensionError::NotPositive { name, value })
    }
}

/// Metres, if the interval has a length.
pub(super) fn interval(
    name: &'static str,
    [from, to]: [Length; 2],
) -> Result<[f64; 2], DimensionError> {
    let ends = [from.to_metres(), to.to_metres()];
    if ends[1] > ends[0] && (ends[1] - ends[0]).is_finite() {
        Ok(ends)
    } else {
        Err(DimensionError::EmptyInterval { name, from, to })
    }
}
