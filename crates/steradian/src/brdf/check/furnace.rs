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

/// E[weight] over both sides at each angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FurnaceRow {
    /// What is varied.
    pub roughness: f64,
    /// Least and largest share of a lane that leaves, angle by angle of [`FURNACE_ANGLES`].
    pub shares: [[f64; 2]; FURNACE_ANGLES.len()],
    /// Largest standard error.
    pub std_error: f64,
}

/// The row of one model, from its samples and not from its albedo.
pub fn furnace(model: &Brdf, roughness: f64, effort: &Effort) -> FurnaceRow {
    let mut std_error = 0.0_f64;
    let shares = FURNACE_ANGLES.map(|degrees| {
        let found = mean_weights(model, polar(degrees.to_radians(), 0.3), effort);
        for lane in 0..4 {
            std_error = std_error.max(found.std_error[0][lane] + found.std_error[1][lane]);
        }
        let sums: [f64; 4] = std::array::from_fn(|k| found.reflected[k] + found.transmitted[k]);
        [f64::min, f64::max]
            .map(|best: fn(f64, f64) -> f64| sums.into_iter().reduce(best).unwrap_or(0.0))
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
