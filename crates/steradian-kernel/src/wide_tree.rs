//! The eight-wide tree, and how it is built: at once, or in parts.

use crate::collapse::{Boxed, Item, grow};
use crate::huge_pages;
use crate::in_order::in_order;
use crate::node::{Below, Bounds, Child, Leaf, Node, WIDTH};
use crate::parts::divide;

/// Up to so many triangles make one binary tree, which takes 300 bytes for each while it is built, and more are cut into parts.
const MOST_AT_ONCE: usize = 1 << 20;

/// The triangles of a part: what is built at once is small beside a large mesh.
const MOST_IN_A_PART: usize = 1 << 17;

/// For these triangles there is room for a node, and for a leaf: a fifth more than what meshes need, for memory that is never touched costs
/// nothing.
const TRIANGLES_A_NODE: usize = 23;
const TRIANGLES_A_LEAF: usize = 6;

/// The wide tree; node 0 is the root.
#[derive(Clone, Default)]
pub(crate) struct WideTree {
    pub(crate) nodes: Vec<Node>,
    pub(crate) leaves: Vec<Leaf>,
    /// Nodes on the longest way down.
    pub(crate) depth: usize,
}

impl WideTree {
    /// Of quadrics by index and triangles by number; degenerate triangles are expected to be left out. The tree does not depend on
    /// the number of threads.
    pub(crate) fn build(
        triangles: Vec<u32>,
        quadrics: &[(Bounds, u32)],
        corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync,
        threads: usize,
    ) -> Self {
        let most = if triangles.len() <= MOST_AT_ONCE {
            MOST_AT_ONCE
        } else {
            MOST_IN_A_PART
        };
        Self::build_in_parts(triangles, quadrics, corners, most, threads)
    }

    fn build_in_parts(
        triangles: Vec<u32>,
        quadrics: &[(Bounds, u32)],
        corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync,
        most: usize,
        threads: usize,
    ) -> Self {
        let mut tree = Self::default();
        if triangles.is_empty() && quadrics.is_empty() {
            return tree;
        }
        tree.make_room(triangles.len());
        tree.nodes.push(Node::EMPTY);
        let quadrics = quadrics.iter();
        let mut items: Vec<Boxed> = quadrics
            .map(|&(bounds, index)| Boxed(bounds, Item::Quadric(index)))
            .collect();
        if triangles.len() <= most {
            items.extend(boxed(&triangles, &corners));
            drop(triangles);
        } else {
            tree.add_parts(triangles, &corners, most, threads, &mut items);
        }
        tree.depth += grow(&mut tree, 0, &items, &corners);
        tree
    }

    /// Builds the parts, of which each thread has one in hand, and adds what is below their roots, which give way to nodes that know
    /// of all parts.
    fn add_parts(
        &mut self,
        triangles: Vec<u32>,
        corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync,
        most: usize,
        threads: usize,
        items: &mut Vec<Boxed>,
    ) {
        let work = |part: Vec<u32>| Self::of_part(&part, &corners);
        let parts = parts(triangles, &corners, most);
        in_order(threads, parts, work, |part| {
            items.extend(self.append(part));
        });
    }

    fn of_part(triangles: &[u32], corners: impl Fn(u32) -> [[f32; 3]; 3]) -> Self {
        let mut tree = Self::default();
        tree.nodes.push(Node::EMPTY);
        tree.depth = grow(&mut tree, 0, &boxed(triangles, &corners), &corners);
        tree
    }

    /// Moves another tree in here, but for its root, whose children are given back.
    fn append(&mut self, other: Self) -> Vec<Boxed> {
        let (nodes, leaves) = (self.nodes.len() - 1, self.leaves.len());
        let moved = |child: Child| match child.below() {
            _ if child == Child::NONE => child,
            Below::Node(index) => Child::node(index + nodes),
            Below::Leaf(index) => Child::leaf(index + leaves),
            Below::Quadric(_) => child,
        };
        let mut added = other.nodes.into_iter().map(|mut node| {
            node.children = node.children.map(moved);
            node
        });
        let root = added.next().unwrap_or(Node::EMPTY);
        self.nodes.extend(added);
        self.leaves.extend(other.leaves);
        self.depth = self.depth.max(other.depth);
        root.used()
            .map(|(bounds, child)| Boxed(bounds, Item::Subtree(child)))
            .collect()
    }

    /// The box around everything in the tree.
    pub(crate) fn bounds(&self) -> Bounds {
        let root = self.nodes.first();
        root.map_or(Bounds::EMPTY, |root| {
            (0..WIDTH).fold(Bounds::EMPTY, |bounds, lane| {
                bounds.union(root.bounds(lane))
            })
        })
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.nodes.len() * size_of::<Node>() + self.leaves.len() * size_of::<Leaf>()
    }

    /// Makes room for so many triangles: a vector that grows holds everything twice.
    fn make_room(&mut self, triangles: usize) {
        self.nodes.reserve_exact(triangles / TRIANGLES_A_NODE + 1);
        self.leaves.reserve_exact(triangles / TRIANGLES_A_LEAF + 1);
        huge_pages::ask_for(self.nodes.spare_capacity_mut());
        huge_pages::ask_for(self.leaves.spare_capacity_mut());
    }
}

/// The triangles of each part.
fn parts(
    mut triangles: Vec<u32>,
    corners: impl Fn(u32) -> [[f32; 3]; 3],
    most: usize,
) -> Vec<Vec<u32>> {
    let mut parts = divide(&mut triangles, |n| Bounds::of_points(&corners(n)), most);
    parts.sort_by_key(|part| part.start);
    let parts = parts.into_iter();
    parts.map(|part| triangles[part].to_vec()).collect()
}

/// Triangles with their boxes.
fn boxed(triangles: &[u32], corners: impl Fn(u32) -> [[f32; 3]; 3]) -> Vec<Boxed> {
    let triangles = triangles.iter();
    triangles
        .map(|&number| Boxed(Bounds::of_points(&corners(number)), Item::Triangle(number)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::WideTree;
    use crate::node::{Below, Bounds};

    /// A triangle over each unit square of a plane.
    fn corners(number: u32) -> [[f32; 3]; 3] {
        let [x, y] = [number % 40, number / 40].map(|k| k as f32);
        [[x, y, 0.0], [x + 1.0, y, 0.5], [x, y + 1.0, 1.0]]
    }

    /// Notes which triangles lie in a leaf of a child whose box is around them, and counts quadrics and the nodes of the longest way down.
    fn check(tree: &WideTree, node: usize, is_found: &mut [bool], quadrics: &mut u32) -> usize {
        let mut depth = 0;
        for (bounds, child) in tree.nodes[node].used() {
            match child.below() {
                Below::Node(child) => {
                    depth = depth.max(check(tree, child, is_found, quadrics));
                    let inside = tree.nodes[child].used();
                    let around = inside.fold(bounds, |around, (inside, _)| around.union(inside));
                    assert_eq!(around, bounds);
                }
                Below::Leaf(leaf) => {
                    for (_, number) in tree.leaves[leaf].lanes() {
                        let inside = Bounds::of_points(&corners(number));
                        is_found[number as usize] |= bounds.union(inside) == bounds;
                    }
                }
                Below::Quadric(_) => *quadrics += 1,
            }
        }
        depth + 1
    }

    /// How often each triangle lies in a leaf.
    fn counts(tree: &WideTree) -> Vec<u32> {
        let mut counts = vec![0; 1600];
        for (_, number) in tree.leaves.iter().flat_map(|leaf| leaf.lanes()) {
            counts[number as usize] += 1;
        }
        counts
    }

    #[test]
    fn every_primitive_is_in_the_tree_once() {
        let sphere = (Bounds::of_points(&[[50.0; 3], [51.0; 3]]), 0);
        for most in [7, 100, 1 << 17] {
            let tree = WideTree::build_in_parts((0..1600).collect(), &[sphere], corners, most, 1);
            let (mut is_found, mut quadrics) = ([false; 1600], 0);
            let depth = check(&tree, 0, &mut is_found, &mut quadrics);
            assert_eq!((is_found, quadrics), ([true; 1600], 1));
            assert_eq!(counts(&tree), [1; 1600]);
            assert!(
                depth <= tree.depth && tree.depth <= depth + 2,
                "{depth}, {}",
                tree.depth
            );
            assert_eq!(tree.bounds().upper, [51.0; 3]);
        }
    }

    #[test]
    fn the_tree_is_the_same_on_any_number_of_threads() {
        let build = |threads| {
            let tree = WideTree::build_in_parts((0..1600).collect(), &[], corners, 30, threads);
            let nodes = tree.nodes.iter().map(|node| (node.planes, node.children));
            let leaves = tree.leaves.iter().map(|leaf| leaf.triangles);
            (
                nodes.collect::<Vec<_>>(),
                leaves.collect::<Vec<_>>(),
                tree.depth,
            )
        };
        let expected = build(1);
        for threads in [2, 3, 16] {
            assert_eq!(build(threads), expected, "{threads}");
        }
    }
}
