//! The binary tree under the wide one, built by `obvhs`: parallel locally-ordered clustering (Meister & Bittner 2018)
//! and reinsertion (Meister & Bittner 2018b), one primitive a leaf.

use crate::node::Bounds;
pub(crate) use obvhs::Boundable;
use obvhs::BvhBuildParams;
pub(crate) use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, reinsertion::ReinsertionOptimizer};
use obvhs::ploc::PlocBuilder;

impl From<Bounds> for Aabb {
    fn from(bounds: Bounds) -> Self {
        Self::new(bounds.lower.into(), bounds.upper.into())
    }
}

/// Nodes are numbers; the root is 0.
pub(crate) struct BinaryTree(Bvh2);

impl BinaryTree {
    /// There must be at least one box.
    pub(crate) fn build(boxes: &[impl Boundable]) -> Self {
        let quality = BvhBuildParams::medium_build();
        let mut tree = PlocBuilder::new().build(
            quality.ploc_search_distance,
            boxes,
            (0..boxes.len() as u32).collect(),
            quality.sort_precision,
            quality.search_depth_threshold,
        );
        ReinsertionOptimizer::default().run(&mut tree, quality.reinsertion_batch_ratio, None);
        Self(tree)
    }

    pub(crate) fn len(&self) -> usize {
        self.0.nodes.len()
    }

    pub(crate) fn children(&self, node: usize) -> Option<[usize; 2]> {
        let node = &self.0.nodes[node];
        let first = node.first_index as usize;
        (!node.is_leaf()).then_some([first, first + 1])
    }

    /// The box of a node without children; an index into the boxes it was built from.
    pub(crate) fn primitive(&self, leaf: usize) -> u32 {
        self.0.primitive_indices[self.0.nodes[leaf].first_index as usize]
    }

    pub(crate) fn bounds(&self, node: usize) -> Bounds {
        let bounds = self.0.nodes[node].aabb();
        Bounds {
            lower: bounds.min.into(),
            upper: bounds.max.into(),
        }
    }

    /// Half the surface of the box: the probability of a hit, up to a factor.
    pub(crate) fn half_area(&self, node: usize) -> f32 {
        self.0.nodes[node].aabb().half_area()
    }

    /// All nodes, parents before their children.
    pub(crate) fn top_down(&self) -> Vec<usize> {
        let mut order = Vec::with_capacity(self.len());
        order.push(0);
        let mut next = 0;
        while let Some(&node) = order.get(next) {
            order.extend(self.children(node).into_iter().flatten());
            next += 1;
        }
        order
    }
}
