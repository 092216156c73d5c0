//! Adaptive quadrature over the unit square.
//!
//! The cell with the largest error is cut into quarters until the errors add up to less than is allowed. A cell's error is
//! the difference between 8 × 8 Gauss nodes on it and on its quarters; since the quarters are kept, the sum of these
//! differences is a cautious estimate: for smooth integrands the quarters are 2¹⁶ times better, along a kink some 8 times.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::geometry::gauss;

/// Nodes along each side of a cell.
const ORDER: usize = 8;

/// Cells after which it ends in any case.
const MOST_CELLS: usize = 20_000;

/// An integral and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Integral {
    pub(super) value: f64,
    pub(super) error: f64,
}

struct Cell {
    corner: [f64; 2],
    side: f64,
    quarters: [f64; 4],
    error: f64,
}

impl Cell {
    fn new(f: &dyn Fn(f64, f64) -> f64, corner: [f64; 2], side: f64, whole: f64) -> Self {
        let quarters = corners(corner, side).map(|corner| once(f, corner, 0.5 * side));
        let error = (quarters.iter().sum::<f64>() - whole).abs();
        Self {
            corner,
            side,
            quarters,
            error,
        }
    }
}

/// ∫₀¹ ∫₀¹ f du dv, to this share of its value if possible.
pub(super) fn over_unit_square(f: &dyn Fn(f64, f64) -> f64, tolerance: f64) -> Integral {
    let mut cells = BinaryHeap::from([Cell::new(f, [0.0; 2], 1.0, once(f, [0.0; 2], 1.0))]);
    loop {
        let total = total(&cells);
        if total.error <= tolerance * total.value.abs() || cells.len() >= MOST_CELLS {
            return total;
        }
        // Several at a time, so that the sums are not formed too often.
        for _ in 0..1 + cells.len() / 8 {
            if let Some(Cell {
                corner,
                side,
                quarters,
                ..
            }) = cells.pop()
            {
                let parts = corners(corner, side).into_iter().zip(quarters);
                cells.extend(parts.map(|(corner, whole)| Cell::new(f, corner, 0.5 * side, whole)));
            }
        }
    }
}

fn total(cells: &BinaryHeap<Cell>) -> Integral {
    let value: f64 = cells.iter().flat_map(|cell| cell.quarters).sum();
    let error: f64 = cells.iter().map(|cell| cell.error).sum();
    Integral {
        value,
        error: error + 16.0 * f64::EPSILON * value.abs(),
    }
}

fn corners([u, v]: [f64; 2], side: f64) -> [[f64; 2]; 4] {
    let half = 0.5 * side;
    [[u, v], [u + half, v], [u, v + half], [u + half, v + half]]
}

fn once(f: &dyn Fn(f64, f64) -> f64, [u, v]: [f64; 2], side: f64) -> f64 {
    let row = |u: f64| gauss::integrate(ORDER, [v, v + side], |v| f(u, v));
    gauss::integrate(ORDER, [u, u + side], row)
}

impl Ord for Cell {
    fn cmp(&self, other: &Self) -> Ordering {
        let place = |cell: &Self| cell.corner[0] + 2.0 * cell.corner[1];
        self.error
            .total_cmp(&other.error)
            .then(place(self).total_cmp(&place(other)))
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_kinked_and_broken_integrands_keep_their_errors() {
        let smooth = over_unit_square(&|u, v| libm::exp(u - 2.0 * v), 1e-12);
        let expected = (libm::exp(1.0) - 1.0) * 0.5 * (1.0 - libm::exp(-2.0));
        assert!((smooth.value - expected).abs() < 1e-15 && smooth.error < 1e-12);
        // A kink along the diagonal, ∫∫ |u − v| = 1/3, and a step along a circle.
        let kinked = over_unit_square(&|u, v| (u - v).abs(), 1e-8);
        assert!((kinked.value - 1.0 / 3.0).abs() <= kinked.error && kinked.error < 1e-8);
        let step = over_unit_square(&|u, v| if u * u + v * v < 1.0 { 1.0 } else { 0.0 }, 1e-4);
        assert!(
            (step.value - std::f64::consts::FRAC_PI_4).abs() <= step.error && step.error < 1e-4
        );
        assert_eq!(over_unit_square(&|_, _| 0.0, 1e-9).value, 0.0);
    }
}
