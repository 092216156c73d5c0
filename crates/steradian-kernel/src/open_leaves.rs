//! Several children in one leaf.
//!
//! The children that end the tree hold about half as many triangles as a leaf has lanes, and take most of the memory. A child therefore
//! goes to a leaf of its neighbours if that has room for it. A ray that meets one of these children tests the triangles of the others,
//! too, which takes no longer and finds nothing but true hits.

use crate::node::{Leaf, WIDTH};

/// The leaves that are looked at: those of neighbours are the latest.
const MOST: usize = 8;

/// The latest leaves with unused lanes.
#[derive(Default)]
pub(crate) struct OpenLeaves(Vec<OpenLeaf>);

struct OpenLeaf {
    index: usize,
    used: usize,
}

impl OpenLeaves {
    /// The leaf with the least room that is enough for so many triangles, or a new one, and the first unused lane.
    pub(crate) fn room_for(&mut self, count: usize, leaves: &mut Vec<Leaf>) -> (usize, usize) {
        let places = self.0.iter().enumerate();
        let fitting = places.filter(|(_, leaf)| leaf.used + count <= WIDTH);
        let fullest = fitting.max_by_key(|(_, leaf)| leaf.used);
        let fullest = fullest.map(|(place, _)| place);
        let place = fullest.unwrap_or_else(|| self.open(leaves));
        let leaf = &mut self.0[place];
        let found = (leaf.index, leaf.used);
        leaf.used += count;
        if leaf.used == WIDTH {
            self.0.remove(place);
        }
        found
    }

    /// The place of a new leaf; the oldest one is closed if there are too many.
    fn open(&mut self, leaves: &mut Vec<Leaf>) -> usize {
        if self.0.len() == MOST {
            self.0.remove(0);
        }
        leaves.push(Leaf::EMPTY);
        let index = leaves.len() - 1;
        self.0.push(OpenLeaf { index, used: 0 });
        self.0.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST, OpenLeaves};

    #[test]
    fn children_share_the_fullest_leaf_that_has_room() {
        let (mut open, mut leaves) = (OpenLeaves::default(), Vec::new());
        let mut room_for = |count| open.room_for(count, &mut leaves);
        assert_eq!(room_for(5), (0, 0));
        assert_eq!(room_for(4), (1, 0));
        assert_eq!(room_for(3), (0, 5));
        assert_eq!(room_for(3), (1, 4));
        assert_eq!(room_for(8), (2, 0));
        assert_eq!(room_for(1), (1, 7));
        assert_eq!(room_for(1), (3, 0));
    }

    #[test]
    fn the_oldest_leaves_are_closed() {
        let (mut open, mut leaves) = (OpenLeaves::default(), Vec::new());
        for leaf in 0..=MOST {
            assert_eq!(open.room_for(6, &mut leaves), (leaf, 0));
        }
        for leaf in 1..=MOST {
            assert_eq!(open.room_for(2, &mut leaves).1, 6, "{leaf}");
        }
        assert_eq!(open.room_for(2, &mut leaves), (MOST + 1, 0));
    }
}
