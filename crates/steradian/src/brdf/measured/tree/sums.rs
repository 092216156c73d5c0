//! Sums over slices of a tree, made once.
//!
//! What a branch holds of a slice is Σ value · area over its leaves there. As a function of what the slice holds fixed it is
//! itself a tree, on halves of the fixed coordinates alone, whose leaves are constant, or p + q/R at a radius R of scattering of
//! rank 3: its circle crosses a box along a side, or from a diagonal on. These trees are added from the leaves up. A total is
//! then one descent; a sample descends by the sums of the children, of which each is one descent.

use super::builder::{DEPTH, Node, Rank};
use super::slice::{Fixed, Slice, Voxel};

/// A function of the fixed coordinates.
#[derive(Copy, Clone, Debug, PartialEq)]
enum Sum {
    /// On the parts of what is fixed, of which this is the first.
    Parts(u32),
    /// p + q/R.
    Leaf([f64; 2]),
}

/// The sum of every branch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sums {
    fixed: Fixed,
    axes: usize,
    /// By the number of the first child over the number of children.
    branches: Vec<Sum>,
    parts: Vec<Sum>,
}

impl Sums {
    pub(super) fn new(rank: Rank, nodes: &[Node], fixed: Fixed) -> Self {
        let axes = rank.axes();
        let mut sums = Self {
            fixed,
            axes,
            branches: vec![Sum::Leaf([0.0; 2]); nodes.len() >> axes],
            parts: vec![],
        };
        sums.add_up(nodes, 0, Voxel::WHOLE);
        sums
    }

    /// Σ value · area over the leaves of a node in a slice; the node halves the box so many times.
    pub(super) fn at(&self, node: Node, voxel: Voxel, depth: usize, slice: &Slice) -> f64 {
        let mut sum = match node {
            Node::Leaf(value) => self.of_leaf(value, voxel),
            Node::Branch(first) => self.branches[first as usize >> self.axes],
        };
        let mut level = match self.fixed {
            Fixed::Radius => depth.saturating_sub(1),
            _ => depth,
        };
        loop {
            match sum {
                Sum::Leaf([p, q]) if self.fixed == Fixed::Radius => return p + q / slice.at[0],
                Sum::Leaf([constant, _]) => return constant,
                Sum::Parts(first) => sum = self.parts[first as usize + self.part(slice, level)],
            }
            level += 1;
        }
    }

    /// The part of what is fixed that a slice has, after so many halvings.
    fn part(&self, slice: &Slice, level: usize) -> usize {
        let bit = |at: f64| ((at * (1_u64 << DEPTH) as f64) as usize >> (DEPTH - 1 - level)) & 1;
        match self.fixed {
            Fixed::Square { .. } => bit(slice.at[0]) | bit(slice.at[1]) << 1,
            Fixed::Incidence | Fixed::Radius => bit(slice.at[0]),
        }
    }

    fn of_leaf(&self, value: f32, voxel: Voxel) -> Sum {
        Sum::Leaf(self.fixed.area(voxel).map(|area| f64::from(value) * area))
    }

    fn add_up(&mut self, nodes: &[Node], node: usize, voxel: Voxel) -> Sum {
        let first = match nodes[node] {
            Node::Leaf(value) => return self.of_leaf(value, voxel),
            Node::Branch(first) => first,
        };
        let children: Vec<_> = (0..1_u32 << self.axes)
            .map(|child| {
                let sum = self.add_up(nodes, (first + child) as usize, voxel.part(child));
                (self.fixed.part_of(voxel, child), sum)
            })
            .collect();
        let of_part = |part: Option<usize>| {
            let same = children.iter().filter(move |(own, _)| *own == part);
            same.map(|(_, sum)| *sum).collect::<Vec<_>>()
        };
        let whole = of_part(None);
        let sum = if whole.is_empty() {
            self.join(|_, part| of_part(Some(part)))
        } else {
            self.merged(&whole)
        };
        self.branches[first as usize >> self.axes] = sum;
        sum
    }

    /// The function that is the sum of the given ones on each part.
    fn join(&mut self, of_part: impl Fn(&Self, usize) -> Vec<Sum>) -> Sum {
        let first = self.parts.len();
        let count = self.fixed.parts();
        self.parts.resize(first + count, Sum::Leaf([0.0; 2]));
        for part in 0..count {
            let terms = of_part(self, part);
            self.parts[first + part] = self.merged(&terms);
        }
        Sum::Parts(first as u32)
    }

    fn merged(&mut self, terms: &[Sum]) -> Sum {
        let is_divided = terms.iter().any(|term| matches!(term, Sum::Parts(_)));
        match terms {
            [only] => *only,
            _ if is_divided => self.join(|sums, part| sums.restricted(terms, part)),
            _ => sum_of_leaves(terms),
        }
    }

    /// Functions on a part of what is fixed.
    fn restricted(&self, terms: &[Sum], part: usize) -> Vec<Sum> {
        let of = |term: &Sum| match term {
            Sum::Parts(first) => self.parts[*first as usize + part],
            Sum::Leaf(_) => *term,
        };
        terms.iter().map(of).collect()
    }
}

/// The sum of leaves.
fn sum_of_leaves(terms: &[Sum]) -> Sum {
    let mut sum = [0.0; 2];
    for term in terms {
        if let Sum::Leaf(leaf) = term {
            (0..2).for_each(|k| sum[k] += leaf[k]);
        }
    }
    Sum::Leaf(sum)
}
