//! From the binary tree to the eight-wide one.
//!
//! Each wide node is a cut through a subtree of the binary tree. With A(n) the area of node n's box and C(n, i) the least
//! cost of the subtree below n when it may use up to i slots of its parent,
//!
//! ```text
//! C(n, 1) = min( A(n)·C_leaf  if n has at most 8 triangles,   A(n)·C_node + D(n, 8) )
//! C(n, i) = min( D(n, i), C(n, i − 1) )                       D(n, i) = min over k of C(left, k) + C(right, i − k)
//! ```
//!
//! computed from the leaves up. A leaf costs the same whatever it holds, because its triangles are tested together.
//!
//! Source: H. Ylitie, T. Karras, S. Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs",
//! High-Performance Graphics 2017, §3.1 and equations 1–3.

use crate::binary_tree::BinaryTree;
use crate::node::{Bounds, Child, Leaf, Node, WIDTH};

const NODE_COST: f32 = 1.0;
const LEAF_COST: f32 = 1.0;

/// A primitive of the tree.
#[derive(Copy, Clone)]
pub(crate) enum Item {
    Triangle(u32),
    /// Index among the quadrics.
    Quadric(u32),
}

/// The wide tree; node 0 is the root.
#[derive(Clone, Default)]
pub(crate) struct WideTree {
    pub(crate) nodes: Vec<Node>,
    pub(crate) leaves: Vec<Leaf>,
    /// Nodes on the longest way down.
    pub(crate) depth: usize,
}

impl WideTree {
    /// `items[i]` lies in `boxes[i]`; degenerate triangles are expected to be left out.
    pub(crate) fn build(
        boxes: &[Bounds],
        items: &[Item],
        corners: impl Fn(u32) -> [[f32; 3]; 3],
    ) -> Self {
        if boxes.is_empty() {
            return Self::default();
        }
        let binary = BinaryTree::build(boxes);
        let costs = Costs::new(&binary, items);
        Collapse {
            binary: &binary,
            costs: &costs,
            items,
            corners,
            tree: Self::default(),
        }
        .run()
    }
}

/// The table C(n, i) and the number of triangles below each node.
struct Costs {
    slots: Vec<[f32; WIDTH - 1]>,
    /// More than [`WIDTH`] when a node must not become a leaf.
    triangles: Vec<u8>,
    areas: Vec<f32>,
}

impl Costs {
    fn new(binary: &BinaryTree, items: &[Item]) -> Self {
        let len = binary.len();
        let areas = (0..len).map(|node| binary.half_area(node)).collect();
        let mut costs = Self {
            slots: vec![[0.0; WIDTH - 1]; len],
            triangles: vec![0; len],
            areas,
        };
        for node in binary.top_down().into_iter().rev() {
            match binary.children(node) {
                None => costs.set_primitive(node, items[binary.primitive(node) as usize]),
                Some(children) => costs.set_parent(node, children),
            }
        }
        costs
    }

    fn set_primitive(&mut self, node: usize, item: Item) {
        self.slots[node] = [self.areas[node] * LEAF_COST; WIDTH - 1];
        self.triangles[node] = if matches!(item, Item::Triangle(_)) {
            1
        } else {
            WIDTH as u8 + 1
        };
    }

    fn set_parent(&mut self, node: usize, children: [usize; 2]) {
        let [left, right] = children.map(|child| self.triangles[child]);
        self.triangles[node] = (left + right).min(WIDTH as u8 + 1);
        let inner = self.areas[node] * NODE_COST + self.distribution(children, WIDTH).0;
        let leaf = if self.is_leaf_sized(node) {
            self.areas[node] * LEAF_COST
        } else {
            f32::INFINITY
        };
        self.slots[node][0] = inner.min(leaf);
        for slots in 2..WIDTH {
            self.slots[node][slots - 1] = self
                .distribution(children, slots)
                .0
                .min(self.cost(node, slots - 1));
        }
    }

    fn cost(&self, node: usize, slots: usize) -> f32 {
        self.slots[node][slots - 1]
    }

    /// D and the slots of the left child.
    fn distribution(&self, [left, right]: [usize; 2], slots: usize) -> (f32, usize) {
        let cost = |k: usize| self.cost(left, k) + self.cost(right, slots - k);
        (1..slots)
            .map(|k| (cost(k), k))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((f32::INFINITY, 1))
    }

    fn is_leaf_sized(&self, node: usize) -> bool {
        usize::from(self.triangles[node]) <= WIDTH
    }

    fn is_leaf(&self, node: usize) -> bool {
        self.is_leaf_sized(node) && self.areas[node] * LEAF_COST <= self.cost(node, 1)
    }
}

struct Collapse<'a, F> {
    binary: &'a BinaryTree,
    costs: &'a Costs,
    items: &'a [Item],
    corners: F,
    tree: WideTree,
}

impl<F: Fn(u32) -> [[f32; 3]; 3]> Collapse<'_, F> {
    fn run(mut self) -> WideTree {
        self.tree.nodes.push(Node::EMPTY);
        // A binary node, the wide one made of it, and how deep that is.
        let mut open = vec![(0, 0, 1)];
        while let Some((binary, wide, depth)) = open.pop() {
            self.tree.depth = self.tree.depth.max(depth);
            for (lane, below) in self.cut(binary).into_iter().enumerate() {
                let child = self.child(below);
                self.tree.nodes[wide].set(lane, &self.binary.bounds(below), child);
                if let crate::node::Below::Node(index) = child.below() {
                    open.push((below, index, depth + 1));
                }
            }
        }
        self.tree
    }

    /// The binary nodes that become the children of `node`, in the order in which a shadow ray tries them: leaves
    /// before nodes, because they cost least, and the largest first, because it is the likeliest to be hit.
    fn cut(&self, node: usize) -> Vec<usize> {
        let mut cut = Vec::with_capacity(WIDTH);
        match self.binary.children(node) {
            Some(children) if node != 0 || !self.costs.is_leaf(node) => {
                self.split(children, WIDTH, &mut cut)
            }
            _ => cut.push(node),
        }
        cut.sort_by(|&a, &b| {
            let by_kind = self.becomes_leaf(b).cmp(&self.becomes_leaf(a));
            by_kind.then(self.costs.areas[b].total_cmp(&self.costs.areas[a]))
        });
        cut
    }

    fn becomes_leaf(&self, node: usize) -> bool {
        self.binary.children(node).is_none() || self.costs.is_leaf(node)
    }

    fn split(&self, children: [usize; 2], slots: usize, cut: &mut Vec<usize>) {
        let (_, left) = self.costs.distribution(children, slots);
        for (child, mut slots) in children.into_iter().zip([left, slots - left]) {
            while slots > 1 && self.costs.cost(child, slots) == self.costs.cost(child, slots - 1) {
                slots -= 1;
            }
            match self.binary.children(child) {
                Some(children) if slots > 1 => self.split(children, slots, cut),
                _ => cut.push(child),
            }
        }
    }

    fn child(&mut self, node: usize) -> Child {
        if !self.becomes_leaf(node) {
            self.tree.nodes.push(Node::EMPTY);
            return Child::node(self.tree.nodes.len() - 1);
        }
        let mut triangles = Vec::with_capacity(WIDTH);
        if let Some(quadric) = self.gather(node, &mut triangles) {
            return Child::quadric(quadric as usize);
        }
        self.tree.leaves.push(Leaf::new(&triangles, &self.corners));
        Child::leaf(self.tree.leaves.len() - 1)
    }

    /// The triangles below a node that becomes a leaf, or its only quadric.
    fn gather(&self, node: usize, triangles: &mut Vec<u32>) -> Option<u32> {
        if let Some([left, right]) = self.binary.children(node) {
            return self
                .gather(left, triangles)
                .or(self.gather(right, triangles));
        }
        match self.items[self.binary.primitive(node) as usize] {
            Item::Quadric(quadric) => return Some(quadric),
            Item::Triangle(triangle) => triangles.push(triangle),
        }
        None
    }
}
