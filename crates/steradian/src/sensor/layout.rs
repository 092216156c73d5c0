//! How the points of a grid lie side by side, and how far apart they may be.
//!
//! EN 12464-1:2021 (4.4; the rule is that of EN 12193) wants cells that are about square and no longer than
//!
//! ```text
//! p = 0.2 m · 5^(log₁₀ (d / 1 m)) ,    p ≤ 10 m
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d | the longer side of the area, or the shorter one where the longer is twice as long or more | m |
//! | p | greatest distance of points | m |

use serde::{Deserialize, Serialize};

/// Most that points may be apart on any area, in m.
const GREATEST_SPACING: f64 = 10.0;

/// Equal cells that fill a parallelogram; the points of a sensor are their centres, row by row along the first edge.
///
/// ```
/// let layout = steradian::sensor::Layout {
///     origin: [0.0, 0.0, 0.8],
///     edges: [[4.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
///     count: [4, 2],
/// };
/// assert_eq!(layout.centre(0), [0.5, 0.5, 0.8]);
/// assert_eq!(layout.centre(6), [2.5, 1.5, 0.8]);
/// assert_eq!(layout.spacing(), [1.0, 1.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layout {
    /// A corner, in metres.
    pub origin: [f64; 3],
    /// The edges that leave it, in metres.
    pub edges: [[f64; 3]; 2],
    /// Cells along each edge.
    pub count: [u32; 2],
}

impl Layout {
    /// Lengths of the edges, in metres.
    pub fn lengths(&self) -> [f64; 2] {
        self.edges
            .map(|edge| edge.iter().map(|x| x * x).sum::<f64>().sqrt())
    }

    /// How far points are apart along each edge, in metres.
    pub fn spacing(&self) -> [f64; 2] {
        let [first, second] = self.lengths();
        [
            first / f64::from(self.count[0]),
            second / f64::from(self.count[1]),
        ]
    }

    /// p, the most that EN 12464-1 lets points of this area be apart, in metres.
    pub fn greatest_spacing(&self) -> f64 {
        greatest_spacing(self.lengths())
    }

    /// Number of cells.
    pub const fn cells(&self) -> u64 {
        self.count[0] as u64 * self.count[1] as u64
    }

    /// Centre of a cell.
    pub fn centre(&self, index: u64) -> [f64; 3] {
        let [columns, rows] = self.count.map(u64::from);
        let along = |number: u64, count: u64| (number as f64 + 0.5) / count as f64;
        let u = along(index % columns, columns);
        let v = along(index / columns, rows);
        let [first, second] = &self.edges;
        std::array::from_fn(|axis| self.origin[axis] + first[axis] * u + second[axis] * v)
    }
}

/// p for an area with sides of these lengths, all in metres.
pub(crate) fn greatest_spacing([a, b]: [f64; 2]) -> f64 {
    let (long, short) = (a.max(b), a.min(b));
    let decisive = if long >= 2.0 * short { short } else { long };
    let spacing = 0.2 * libm::pow(5.0, libm::log10(decisive));
    spacing.min(GREATEST_SPACING)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p by the formula: 1 m → .2; 10 m → 1 m; 100 m → 5 m; 5 m: .2 · 5^.69897 = .61601.
    #[test]
    fn spacing_follows_the_longer_side() {
        for (sides, expected) in [
            ([1.0, 1.0], 0.2),
            ([10.0, 6.0], 1.0),
            ([100.0, 60.0], 5.0),
            ([5.0, 3.0], 0.616_012),
            ([1000.0, 999.0], 10.0),
            // Twice as long or more: the shorter side decides.
            ([20.0, 10.0], 1.0),
            ([19.9, 10.0], 1.617_668),
        ] {
            let found = greatest_spacing(sides);
            assert!((found / expected - 1.0).abs() < 1e-5, "{sides:?}: {found}");
            assert_eq!(greatest_spacing([sides[1], sides[0]]), found);
        }
    }
}
