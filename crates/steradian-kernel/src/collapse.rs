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

use crate::binary_tree::{Aabb, BinaryTree, Boundable};
use crate::node::{Bounds, Child, Node, WIDTH};
use crate::open_leaves::OpenLeaves;
use crate::wide_tree::WideTree;

const NODE_COST: f32 = 1.0;
const LEAF_COST: f32 = 1.0;

/// What a binary tree is built over.
#[derive(Copy, Clone)]
pub(crate) enum Item {
    Triangle(u32),
    /// Index among the quadrics.
    Quadric(u32),
    /// Some of the triangles.
    Subtree(Child),
}

/// An item in its box.
pub(crate) struct Boxed(pub(crate) Bounds, pub(crate) Item);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        self.0.into()
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
    fn new(binary: &BinaryTree, items: &[Boxed]) -> Self {
        let len = binary.len();
        let areas = (0..len).map(|node| binary.half_area(node)).collect();
        let mut costs = Self {
            slots: vec![[0.0; WIDTH - 1]; len],
            triangles: vec![0; len],
            areas,
        };
        for node in binary.top_down().into_iter().rev() {
            match binary.children(node) {
                None => costs.set_primitive(node, items[binary.primitive(node) as usize].1),
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

/// Fills the node `root` by the tree over some items, and says how deep that is.
pub(crate) fn grow(
    tree: &mut WideTree,
    root: usize,
    items: &[Boxed],
    corners: impl Fn(u32) -> [[f32; 3]; 3],
) -> usize {
    let binary = BinaryTree::build(items);
    let costs = Costs::new(&binary, items);
    let collapse = Collapse {
        binary: &binary,
        costs: &costs,
        items,
        corners,
        tree,
        open_leaves: OpenLeaves::default(),
    };
    collapse.run(root)
}

struct Collapse<'a, F> {
    binary: &'a BinaryTree,
    costs: &'a Costs,
    items: &'a [Boxed],
    corners: F,
    tree: &'a mut WideTree,
    open_leaves: OpenLeaves,
}

impl<F: Fn(u32) -> [[f32; 3]; 3]> Collapse<'_, F> {
    /// How deep the tree below and with the wide node is.
    fn run(mut self, root: usize) -> usize {
        let mut deepest = 0;
        // A binary node, the wide one made of it, and how deep that is.
        let mut open = vec![(0, root, 1)];
        while let Some((binary, wide, depth)) = open.pop() {
            deepest = deepest.max(depth);
            for (lane, below) in self.cut(binary).into_iter().enumerate() {
                let child = if self.becomes_leaf(below) {
                    self.end(below)
                } else {
                    self.tree.nodes.push(Node::EMPTY);
                    let index = self.tree.nodes.len() - 1;
                    open.push((below, index, depth + 1));
                    Child::node(index)
                };
                self.tree.nodes[wide].set(lane, &self.binary.bounds(below), child);
            }
        }
        deepest
    }

    /// The binary nodes that become the children of `node`. A shadow ray tries the last one first: leaves come after nodes, because
    /// they cost least, and the largest last, because it is the likeliest to be hit.
    fn cut(&self, node: usize) -> Vec<usize> {
        let mut cut = Vec::with_capacity(WIDTH);
        match self.binary.children(node) {
            Some(children) if node != 0 || !self.costs.is_leaf(node) => {
                self.split(children, WIDTH, &mut cut)
            }
            _ => cut.push(node),
        }
        cut.sort_by(|&a, &b| {
            let by_kind = self.becomes_leaf(a).cmp(&self.becomes_leaf(b));
            by_kind.then(self.costs.areas[a].total_cmp(&self.costs.areas[b]))
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

    /// What has no node of its own in this tree: a leaf of triangles, a quadric or what has been built before.
    fn end(&mut self, node: usize) -> Child {
        let mut triangles = Vec::with_capacity(WIDTH);
        if let Some(child) = self.gather(node, &mut triangles) {
            return child;
        }
        let leaves = &mut self.tree.leaves;
        let (leaf, used) = self.open_leaves.room_for(triangles.len(), leaves);
        for (lane, triangle) in (used..).zip(triangles) {
            leaves[leaf].set(lane, triangle, (self.corners)(triangle));
        }
        Child::leaf(leaf)
    }

    /// The triangles below a node that becomes a leaf, or the only other item.
    fn gather(&self, node: usize, triangles: &mut Vec<u32>) -> Option<Child> {
        if let Some([left, right]) = self.binary.children(node) {
            return self
                .gather(left, triangles)
                .or(self.gather(right, triangles));
        }
        match self.items[self.binary.primitive(node) as usize].1 {
            Item::Quadric(quadric) => return Some(Child::quadric(quadric as usize)),
            Item::Subtree(child) => return Some(child),
            Item::Triangle(triangle) => triangles.push(triangle),
        }
        None
    }
}
