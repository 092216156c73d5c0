//! How the points of a grid lie side by side.

use serde::{Deserialize, Serialize};

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
