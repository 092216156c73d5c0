//! Many triangles in parts, whose trees are built on their own.
//!
//! To build a binary tree takes several times the memory of the tree that is kept. So a large mesh is cut into parts before, along the
//! planes of a grid over the middles of the triangles' boxes. Of all planes through a block of cells that one is taken that makes
//!
//! ```text
//! A(left)·⌈n(left)/m⌉ + A(right)·⌈n(right)/m⌉
//! ```
//!
//! smallest, the surface-area heuristic with parts of at most m triangles as the unit of cost: A is the surface of the box around the
//! triangles of one side, n their number. A cell that holds more than m is cut again by a grid of its own.

use crate::node::Bounds;
use std::ops::Range;

/// Along each axis.
const CELLS: usize = 32;

/// Sorts the triangles so that parts are ranges of at most `most` each.
pub(crate) fn divide(
    triangles: &mut [u32],
    bounds_of: impl Fn(u32) -> Bounds,
    most: usize,
) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let mut open = Vec::new();
    open.push(0..triangles.len());
    while let Some(range) = open.pop() {
        if range.len() <= most {
            parts.push(range);
            continue;
        }
        let lengths = cut(&mut triangles[range.clone()], &bounds_of, most);
        let mut start = range.start;
        for length in lengths {
            open.push(start..start + length);
            start += length;
        }
    }
    parts
}

/// Sorts the triangles by group, and says how many are in each; at least two groups.
fn cut(triangles: &mut [u32], bounds_of: &impl Fn(u32) -> Bounds, most: usize) -> Vec<usize> {
    let grid = Grid::around(triangles, bounds_of);
    let mut cells = vec![Content::NOTHING; CELLS * CELLS * CELLS];
    for &triangle in &*triangles {
        let bounds = bounds_of(triangle);
        cells[grid.cell(&bounds)].add(&Content { count: 1, bounds });
    }
    let mut groups = Groups {
        cells: &cells,
        group_of: vec![0; cells.len()],
        lengths: Vec::new(),
    };
    groups.split(Block::ALL, most);
    let Groups {
        group_of, lengths, ..
    } = groups;
    if lengths.len() < 2 {
        let half = triangles.len() / 2;
        return vec![half, triangles.len() - half];
    }
    let mut next = starts(&lengths);
    let unsorted = triangles.to_vec();
    for triangle in unsorted {
        let place = &mut next[group_of[grid.cell(&bounds_of(triangle))]];
        triangles[*place] = triangle;
        *place += 1;
    }
    lengths
}

/// Where each group begins.
fn starts(lengths: &[usize]) -> Vec<usize> {
    let next = |sum: &mut usize, &length: &usize| Some(std::mem::replace(sum, *sum + length));
    lengths.iter().scan(0, next).collect()
}

/// Over the middles of boxes.
struct Grid {
    lower: [f32; 3],
    /// Cells in a unit of length.
    density: [f32; 3],
}

impl Grid {
    fn around(triangles: &[u32], bounds_of: &impl Fn(u32) -> Bounds) -> Self {
        let middle = |&triangle: &u32| Bounds::of_points(&[middle(&bounds_of(triangle))]);
        let bounds = triangles
            .iter()
            .map(middle)
            .fold(Bounds::EMPTY, Bounds::union);
        Self {
            lower: bounds.lower,
            density: [0, 1, 2].map(|k| CELLS as f32 / (bounds.upper[k] - bounds.lower[k])),
        }
    }

    /// The number of the cell; where the grid is flat, the first along that axis.
    fn cell(&self, bounds: &Bounds) -> usize {
        let middle = middle(bounds);
        let [x, y, z] = [0, 1, 2].map(|k| {
            let place = (middle[k] - self.lower[k]) * self.density[k];
            (place as usize).min(CELLS - 1)
        });
        number([x, y, z])
    }
}

fn middle(bounds: &Bounds) -> [f32; 3] {
    [0, 1, 2].map(|k| 0.5 * bounds.lower[k] + 0.5 * bounds.upper[k])
}

fn number([x, y, z]: [usize; 3]) -> usize {
    (x * CELLS + y) * CELLS + z
}

/// What a cell or several hold.
#[derive(Copy, Clone)]
struct Content {
    count: usize,
    bounds: Bounds,
}

impl Content {
    const NOTHING: Self = Self {
        count: 0,
        bounds: Bounds::EMPTY,
    };

    fn add(&mut self, other: &Self) {
        self.count += other.count;
        self.bounds = self.bounds.union(other.bounds);
    }

    fn cost(&self, most: usize) -> f32 {
        self.bounds.half_area() * self.count.div_ceil(most) as f32
    }
}

/// Cells that form a box.
#[derive(Clone)]
struct Block([Range<usize>; 3]);

impl Block {
    const ALL: Self = Self([0..CELLS, 0..CELLS, 0..CELLS]);

    fn cells(&self) -> impl Iterator<Item = [usize; 3]> {
        let [x, y, z] = self.0.clone();
        x.flat_map(move |x| {
            let z = z.clone();
            y.clone()
                .flat_map(move |y| z.clone().map(move |z| [x, y, z]))
        })
    }

    fn split(&self, axis: usize, plane: usize) -> [Self; 2] {
        let [mut left, mut right] = [self.clone(), self.clone()];
        left.0[axis].end = plane;
        right.0[axis].start = plane;
        [left, right]
    }
}

/// Cells put together.
struct Groups<'a> {
    cells: &'a [Content],
    group_of: Vec<usize>,
    lengths: Vec<usize>,
}

impl Groups<'_> {
    fn split(&mut self, block: Block, most: usize) {
        let count = block
            .cells()
            .map(|cell| self.cells[number(cell)].count)
            .sum();
        let plane = if count > most {
            self.best_plane(&block, most)
        } else {
            None
        };
        let Some((axis, plane)) = plane else {
            for cell in block.cells() {
                self.group_of[number(cell)] = self.lengths.len();
            }
            self.lengths.push(count);
            return;
        };
        for half in block.split(axis, plane) {
            self.split(half, most);
        }
    }

    /// The axis, and the first cell above the plane; of equal ones that which halves best, and nothing if no plane has triangles on both sides.
    fn best_plane(&self, block: &Block, most: usize) -> Option<(usize, usize)> {
        let costs = (0..3).flat_map(|axis| {
            let slabs = self.slabs(block, axis);
            let below = sums(slabs.iter());
            let mut above = sums(slabs.iter().rev());
            above.reverse();
            let start = block.0[axis].start;
            (1..slabs.len())
                .map(move |plane| (below[plane - 1], above[plane], (axis, start + plane)))
        });
        costs
            .filter(|(below, above, _)| below.count > 0 && above.count > 0)
            .map(|(below, above, place)| {
                let cost = below.cost(most) + above.cost(most);
                (cost, below.count.abs_diff(above.count), place)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(.., place)| place)
    }

    /// What is in each layer of cells across an axis.
    fn slabs(&self, block: &Block, axis: usize) -> Vec<Content> {
        let mut slabs = vec![Content::NOTHING; block.0[axis].len()];
        for cell in block.cells() {
            slabs[cell[axis] - block.0[axis].start].add(&self.cells[number(cell)]);
        }
        slabs
    }
}

/// What is in the first slab, the first two, and so on.
fn sums<'a>(slabs: impl Iterator<Item = &'a Content>) -> Vec<Content> {
    let next = |sum: &mut Content, slab: &Content| {
        sum.add(slab);
        Some(*sum)
    };
    slabs.scan(Content::NOTHING, next).collect()
}

#[cfg(test)]
mod tests {
    use super::divide;
    use crate::node::Bounds;

    /// Sorted parts of cubes around points.
    fn parts(points: &[[f32; 3]], most: usize) -> Vec<Vec<u32>> {
        let mut numbers: Vec<u32> = (0..points.len() as u32).collect();
        let cube = |[x, y, z]: [f32; 3]| Bounds {
            lower: [x - 0.5, y - 0.5, z - 0.5],
            upper: [x + 0.5, y + 0.5, z + 0.5],
        };
        let bounds = |number: u32| cube(points[number as usize]);
        let ranges = divide(&mut numbers, bounds, most);
        let mut parts: Vec<_> = ranges
            .into_iter()
            .map(|range| numbers[range].to_vec())
            .collect();
        parts.iter_mut().for_each(|part| part.sort_unstable());
        parts.sort_unstable();
        parts
    }

    #[test]
    fn what_lies_apart_is_parted() {
        let points = [[0.0; 3], [9.0, 0.0, 0.0], [1.0, 0.0, 0.0], [10.0, 1.0, 0.0]];
        assert_eq!(parts(&points, 2), [[0, 2], [1, 3]]);
        assert_eq!(parts(&points, 4), [[0, 1, 2, 3]]);
    }

    #[test]
    fn a_dense_cell_is_cut_again() {
        let mut points = vec![[1e6, 0.0, 0.0]];
        points.extend((0..100).map(|k| [1.0, k as f32, 0.0]));
        let parts = parts(&points, 10);
        assert!(parts.len() <= 20, "{parts:?}");
        assert!(parts.contains(&vec![0]) && parts.iter().all(|part| part.len() <= 10));
        assert_eq!(parts.concat().len(), 101);
    }

    #[test]
    fn what_lies_at_one_place_is_halved() {
        assert_eq!(parts(&[[2.0; 3]; 5], 2), [vec![0, 1], vec![2], vec![3, 4]]);
    }
}
