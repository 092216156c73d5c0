//! How much a table differs when the directions are exchanged.
//!
//! For two values a ≥ b of the same pair of directions the deviation is (a − b)/(a + 1e-6), as Radiance's checkBSDF has it; pairs of
//! which one is below 1e-4/sr are left out. Matrices are compared at the middles of their patches, trees on a grid of 16 × 16 points
//! of the disc for either direction, where checkBSDF draws points at random.

use std::f64::consts::TAU;

use steradian::brdf::measured::{Block, Side, TwoSided};
use steradian::geometry::{Direction, Vector};

/// Rings and azimuths of the grid for trees.
const GRID: usize = 16;
/// Values that are left out, in 1/sr.
const FAINT: f64 = 1e-4;

/// Deviations from reciprocity over many pairs of directions.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Deviation {
    /// The least.
    pub least: f64,
    /// The mean.
    pub mean: f64,
    /// The largest.
    pub largest: f64,
}

/// Deviations of light that goes from one side to another; none if nothing does.
pub fn deviation(table: &TwoSided, from: Side, to: Side) -> Option<Deviation> {
    let block = match from == to {
        true => table.reflection(from),
        false => table.transmission(from),
    }?;
    let (arriving, leaving) = directions(block, from, to);
    let pairs = arriving
        .iter()
        .flat_map(|wi| leaving.iter().map(move |wo| (*wo, *wi)));
    let differences = pairs.filter_map(|(wo, wi)| {
        let (there, back) = (table.value(wo, wi), table.value(wi, wo));
        let (high, low) = (there.max(back), there.min(back));
        (low > FAINT).then(|| (high - low) / (high + 1e-6))
    });
    summary(differences)
}

fn summary(values: impl Iterator<Item = f64>) -> Option<Deviation> {
    let (mut least, mut sum, mut largest, mut count) = (f64::INFINITY, 0.0, 0.0_f64, 0.0);
    for value in values {
        least = least.min(value);
        largest = largest.max(value);
        sum += value;
        count += 1.0;
    }
    (count > 0.0).then(|| Deviation {
        least,
        mean: sum / count,
        largest,
    })
}

fn directions(block: &Block, from: Side, to: Side) -> (Vec<Direction>, Vec<Direction>) {
    match block {
        Block::Matrix(matrix) => (
            middles(matrix.incident().middles(), from, -1.0),
            middles(matrix.scattered().middles(), to, 1.0),
        ),
        Block::Tree(_) => (middles(grid(), from, -1.0), middles(grid(), to, 1.0)),
    }
}

/// Points of the disc, each of the same area.
fn grid() -> Vec<[f64; 2]> {
    let at = |k: usize| (k as f64 + 0.5) / GRID as f64;
    let point = |k: usize| {
        let (radius, azimuth) = (at(k / GRID).sqrt(), TAU * at(k % GRID));
        [radius * libm::cos(azimuth), radius * libm::sin(azimuth)]
    };
    (0..GRID * GRID).map(point).collect()
}

fn middles(points: Vec<[f64; 2]>, side: Side, sign: f64) -> Vec<Direction> {
    let height = if side == Side::Above { 1.0 } else { -1.0 };
    let direction = |[x, y]: [f64; 2]| {
        let z = height * (1.0 - x * x - y * y).max(0.0).sqrt();
        Direction::new(Vector::new(sign * x, sign * y, z)).ok()
    };
    points.into_iter().filter_map(direction).collect()
}
