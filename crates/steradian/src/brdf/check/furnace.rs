//! The white furnace: in light that comes evenly from everywhere a surface without loss cannot be seen.

use super::Effort;
use super::finding::{Check, Finding, Place};
use super::views::polar;
use super::weights::mean_weights;
use crate::brdf::Brdf;

/// What a compensated model may lose or gain.
pub const FURNACE_TOLERANCE: f64 = 2e-3;

/// Angles to the normal, in degrees.
pub const FURNACE_ANGLES: [f64; 6] = [0.0, 30.0, 45.0, 60.0, 75.0, 85.0];

/// E(weight) over both sides at each angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FurnaceRow {
    /// What is varied.
    pub roughness: f64,
    /// Least and largest share of a lane that leaves, angle by angle of [`FURNACE_ANGLES`].
    pub shares: [[f64; 2]; FURNACE_ANGLES.len()],
    /// Largest standard error.
    pub std_error: f64,
}

/// The row of one model, from its samples and not from its albedo, by the first `lanes` of its lanes.
pub fn furnace(model: &Brdf, lanes: usize, roughness: f64, effort: &Effort) -> FurnaceRow {
    let mut std_error = 0.0_f64;
    let shares = FURNACE_ANGLES.map(|degrees| {
        let found = mean_weights(model, polar(degrees.to_radians(), 0.3), effort);
        let errors = found.sum_error.into_iter().take(lanes);
        std_error = errors.fold(std_error, f64::max);
        let both = found.reflected.into_iter().zip(found.transmitted);
        both.take(lanes)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (r, t)| {
                [low.min(r + t), high.max(r + t)]
            })
    });
    FurnaceRow {
        roughness,
        shares,
        std_error,
    }
}

/// The largest difference from 1, in either direction.
pub fn furnace_finding(rows: &[FurnaceRow]) -> Finding {
    let mut finding = Finding::new(Check::Furnace, FURNACE_TOLERANCE);
    for row in rows {
        for (degrees, ends) in FURNACE_ANGLES.into_iter().zip(row.shares) {
            let place = Place::view(polar(degrees.to_radians(), 0.3));
            ends.into_iter()
                .for_each(|share| finding.see((share - 1.0).abs(), place));
        }
    }
    finding
}
