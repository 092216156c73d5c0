//! What the models share when they draw directions.

use std::f64::consts::TAU;

use crate::geometry::{Direction, Vector};

/// Whether both directions lie above the surface.
pub(super) fn above(wo: Direction, wi: Direction) -> bool {
    wo.z() > 0.0 && wi.z() > 0.0
}

/// The largest number below 1.
pub(super) const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// True with this probability, and a uniform number that is independent of the choice.
///
/// The number is what is left of `u`, stretched to 0 … 1: of 53 bits, log₂ of the outcome's probability are used up.
pub(super) fn choose(u: f64, probability: f64) -> (bool, f64) {
    if u < probability {
        (true, (u / probability).min(BELOW_ONE))
    } else {
        (
            false,
            ((u - probability) / (1.0 - probability)).min(BELOW_ONE),
        )
    }
}

/// The part that `u` falls into, by probabilities that add up to 1, and a uniform number that is independent of the choice.
pub(super) fn choose_part(probabilities: &[f64], u: f64) -> Option<(usize, f64)> {
    let mut place = u;
    let part = probabilities.iter().position(|&probability| {
        let inside = place < probability;
        if !inside {
            place -= probability;
        }
        inside
    })?;
    Some((part, (place / probabilities[part]).min(BELOW_ONE)))
}

/// Mirrored at the surface.
pub(super) fn flipped(direction: Direction) -> Direction {
    let [x, y, z] = direction.to_array();
    Direction::from_unit(Vector::new(x, y, -z))
}

/// Of density cosθ/π.
pub(super) fn cosine_direction(u: [f64; 2]) -> Direction {
    Direction::from_polar(u[0].sqrt(), (1.0 - u[0]).max(0.0).sqrt(), TAU * u[1])
}

/// Of density 1/(2π) above the surface.
pub(super) fn hemisphere_direction(u: [f64; 2]) -> Direction {
    let cos = 1.0 - u[0];
    Direction::from_polar((1.0 - cos * cos).max(0.0).sqrt(), cos, TAU * u[1])
}

/// Mean of a function of the unit square by the midpoint rule with `n` × `n` points.
pub(super) fn mean_over_square<const N: usize>(
    n: u32,
    mut f: impl FnMut([f64; 2]) -> [f64; N],
) -> [f64; N] {
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
    let mut sum = [0.0; N];
    for i in 0..n {
        for j in 0..n {
            let value = f([at(i), at(j)]);
            (0..N).for_each(|k| sum[k] += value[k]);
        }
    }
    sum.map(|total| total / f64::from(n * n))
}
