//! Blocks of sixteen paths: a number of each in a row, so that loops over a block run in vectors of any width.

/// Paths of a block.
pub(super) const WIDTH: usize = 16;

/// A number of each path of a block.
pub(super) type Wide = [f32; WIDTH];

/// The first numbers of a column, filled up with 0.
#[inline(always)]
pub(super) fn wide(column: &[f32]) -> Wide {
    let mut numbers = [0.0; WIDTH];
    let count = column.len().min(WIDTH);
    numbers[..count].copy_from_slice(&column[..count]);
    numbers
}

/// The numbers of one path.
#[inline(always)]
pub(super) fn get<const N: usize>(columns: &[Wide; N], lane: usize) -> [f32; N] {
    std::array::from_fn(|k| columns[k][lane])
}

/// Sets the numbers of one path.
#[inline(always)]
pub(super) fn put<const N: usize>(columns: &mut [Wide; N], lane: usize, values: [f32; N]) {
    for k in 0..N {
        columns[k][lane] = values[k];
    }
}
