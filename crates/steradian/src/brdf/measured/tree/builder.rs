//! Trees in the order of a file.

use super::TensorTree;
use crate::brdf::measured::{MeasuredError, check_values};

/// Halvings of the unit box at most.
pub(super) const DEPTH: usize = 16;

/// Which directions the numbers of a tree belong to, as it is read.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Rank {
    /// Isotropic.
    Three,
    /// Anisotropic.
    Four,
}

impl Rank {
    /// The number of axes.
    pub const fn axes(self) -> usize {
        match self {
            Self::Three => 3,
            Self::Four => 4,
        }
    }
}

/// A part of the box.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) enum Node {
    /// The number of its first child; the others follow.
    Branch(u32),
    Leaf(f32),
}

/// Builds a tree from its branches and grids in the order of a file.
#[derive(Clone, Debug)]
pub struct TreeBuilder {
    rank: Rank,
    nodes: Vec<Node>,
    /// Children that are still to come, the next one last; with its depth.
    open: Vec<(u32, usize)>,
}

impl TreeBuilder {
    /// An empty tree.
    pub fn new(rank: Rank) -> Self {
        Self {
            rank,
            nodes: vec![Node::Leaf(0.0)],
            open: vec![(0, 0)],
        }
    }

    /// Whether nothing is missing.
    pub fn is_complete(&self) -> bool {
        self.open.is_empty()
    }

    /// The next part of the box is halved along every axis; its parts follow.
    ///
    /// # Errors
    /// If the tree is complete or too deep.
    pub fn branch(&mut self) -> Result<(), MeasuredError> {
        let (node, depth) = self.open.pop().ok_or(MeasuredError::TreeComplete)?;
        let first = self.split(node, depth)?;
        let children = first..first + (1 << self.rank.axes());
        self.open
            .extend(children.rev().map(|child| (child, depth + 1)));
        Ok(())
    }

    /// The next part of the box holds a grid of these values in 1/sr, one or a power of 2ʳᵃⁿᵏ of them.
    ///
    /// # Errors
    /// If the tree is complete or too deep, their number is wrong, or one is negative or not finite.
    pub fn grid(&mut self, values: &[f32]) -> Result<(), MeasuredError> {
        let (node, depth) = self.open.pop().ok_or(MeasuredError::TreeComplete)?;
        let halvings = values.len().max(1).ilog2() as usize / self.rank.axes();
        if values.len() != 1 << (halvings * self.rank.axes()) {
            let found = values.len();
            return Err(MeasuredError::Grid { found });
        }
        check_values(values)?;
        self.fill(node, depth, halvings, [0; 4], values)
    }

    fn fill(
        &mut self,
        node: u32,
        depth: usize,
        halvings: usize,
        corner: [usize; 4],
        values: &[f32],
    ) -> Result<(), MeasuredError> {
        let axes = self.rank.axes();
        let Some(finer) = halvings.checked_sub(1) else {
            let side = values.len().max(1).ilog2() as usize / axes;
            let index = corner[..axes].iter().fold(0, |sum, at| (sum << side) + at);
            self.nodes[node as usize] = Node::Leaf(values[index]);
            return Ok(());
        };
        let first = self.split(node, depth)?;
        for child in 0..1_u32 << axes {
            let part: [usize; 4] =
                std::array::from_fn(|axis| corner[axis] + ((child as usize >> axis & 1) << finer));
            self.fill(first + child, depth + 1, finer, part, values)?;
        }
        Ok(())
    }

    fn split(&mut self, node: u32, depth: usize) -> Result<u32, MeasuredError> {
        let first = self.nodes.len();
        let end = first + (1 << self.rank.axes());
        if depth >= DEPTH || end > u32::MAX as usize {
            return Err(MeasuredError::TreeDepth { most: DEPTH });
        }
        self.nodes.resize(end, Node::Leaf(0.0));
        self.nodes[node as usize] = Node::Branch(first as u32);
        Ok(first as u32)
    }

    /// The tree.
    ///
    /// # Errors
    /// If parts are missing.
    pub fn build(self) -> Result<TensorTree, MeasuredError> {
        match self.is_complete() {
            true => Ok(TensorTree::new(self.rank, self.nodes, false)),
            false => Err(MeasuredError::TreeIncomplete),
        }
    }
}
