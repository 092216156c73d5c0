//! Many places with normals in little memory.

use std::ops::Range;

use super::Layout;
use crate::geometry::{Direction, Point};

/// Points with their normals.
#[derive(Clone, Debug, PartialEq)]
pub enum Places {
    /// One after the other.
    Listed(Vec<(Point, Direction)>),
    /// The centres of the cells of a grid, made when they are asked for.
    Grid {
        /// The cells.
        layout: Layout,
        /// The normal of all of them.
        normal: Direction,
    },
}

impl Places {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Listed(places) => places.len(),
            Self::Grid { layout, .. } => layout.cells() as usize,
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = (Point, Direction)> + Clone {
        self.range(0..self.len())
    }

    /// Those of these numbers, as far as there are any.
    pub fn range(&self, numbers: Range<usize>) -> impl Iterator<Item = (Point, Direction)> + Clone {
        let numbers = numbers.start..numbers.end.min(self.len());
        numbers.map(|number| match self {
            Self::Listed(places) => places[number],
            Self::Grid { layout, normal } => (layout.centre(number as u64).into(), *normal),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    #[test]
    fn a_grid_is_as_if_its_points_were_listed() {
        let normal = Direction::new(Vector::new(0.0, 0.0, 1.0)).unwrap();
        let layout = Layout {
            origin: [1.0, 0.0, 0.8],
            edges: [[4.0, 0.0, 0.0], [0.0, 3.0, 0.0]],
            count: [2, 3],
        };
        let grid = Places::Grid { layout, normal };
        let listed = Places::Listed(grid.iter().collect());
        assert_eq!((grid.len(), listed.len()), (6, 6));
        for range in [0..6, 1..4, 4..9, 7..8] {
            assert!(grid.range(range.clone()).eq(listed.range(range)));
        }
    }
}
