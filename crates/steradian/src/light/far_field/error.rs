//! What can be wrong with a table of intensities.

use std::cmp::Ordering;

use thiserror::Error;

/// What can be wrong with a table of intensities. Angles are in degrees.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum FarFieldError {
    /// One angle spans nothing.
    #[error("a table needs at least two {kind}, found {found}")]
    TooFew {
        /// Which angles.
        kind: &'static str,
        /// How many there are.
        found: usize,
    },
    /// Angles that do not increase.
    #[error("{kind} must increase: number {index}, {angle}, follows {previous}")]
    NotIncreasing {
        /// Which angles.
        kind: &'static str,
        /// Number of the angle, from 0.
        index: usize,
        /// The angle.
        angle: f64,
        /// The one before it.
        previous: f64,
    },
    /// Angles that are no numbers or reach too far.
    #[error("{kind} go from {from} to {to}, which is not within {expected}")]
    OutOfRange {
        /// Which angles.
        kind: &'static str,
        /// The first.
        from: f64,
        /// The last.
        to: f64,
        /// What is possible.
        expected: &'static str,
    },
    /// As many intensities as nodes.
    #[error("a table of {nodes} nodes needs as many intensities, found {found}")]
    Count {
        /// How many are needed.
        nodes: usize,
        /// How many there are.
        found: usize,
    },
    /// An intensity below zero or none at all.
    #[error("an intensity is finite and not negative: number {index} is {value}")]
    Intensity {
        /// Number of the intensity, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
}

const AZIMUTHS: &str = "azimuths";
const POLARS: &str = "polar angles";

pub(super) fn check(azimuths: &[f64], polars: &[f64], values: &[f64]) -> Result<(), FarFieldError> {
    for (kind, angles) in [(AZIMUTHS, azimuths), (POLARS, polars)] {
        increasing(kind, angles)?;
    }
    within(AZIMUTHS, azimuths, "one turn of 360°", |from, to| {
        to - from <= 360.0
    })?;
    within(POLARS, polars, "0° to 180°", |from, to| {
        from >= 0.0 && to <= 180.0
    })?;
    let nodes = azimuths.len() * polars.len();
    if values.len() != nodes {
        let found = values.len();
        return Err(FarFieldError::Count { nodes, found });
    }
    let is_bad = |value: &f64| !(value.is_finite() && *value >= 0.0);
    match values.iter().position(is_bad) {
        None => Ok(()),
        Some(index) => Err(FarFieldError::Intensity {
            index,
            value: values[index],
        }),
    }
}

fn increasing(kind: &'static str, angles: &[f64]) -> Result<(), FarFieldError> {
    if angles.len() < 2 {
        let found = angles.len();
        return Err(FarFieldError::TooFew { kind, found });
    }
    let pair = angles
        .windows(2)
        .position(|pair| pair[0].partial_cmp(&pair[1]) != Some(Ordering::Less));
    pair.map_or(Ok(()), |at| {
        Err(FarFieldError::NotIncreasing {
            kind,
            index: at + 1,
            angle: angles[at + 1],
            previous: angles[at],
        })
    })
}

fn within(
    kind: &'static str,
    angles: &[f64],
    expected: &'static str,
    holds: impl Fn(f64, f64) -> bool,
) -> Result<(), FarFieldError> {
    let (from, to) = (angles[0], angles[angles.len() - 1]);
    if from.is_finite() && to.is_finite() && holds(from, to) {
        return Ok(());
    }
    Err(FarFieldError::OutOfRange {
        kind,
        from,
        to,
        expected,
    })
}
