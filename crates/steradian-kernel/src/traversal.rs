//! What every walk through the wide tree needs, and that of one ray on its own.
//!
//! The walk goes to the nearest child first and keeps the others on a stack, sorted by where the ray enters
//! them. A stack entry packs that `t` above the child's number: for non-negative numbers the order of the bits is the order of
//! the values, so one integer comparison sorts.

use crate::batch::{Hit, MISS, Ray};
use crate::geometry::Quadric;
use crate::node::{Below, Bounds, Child, Leaf, Node, WIDTH};
use crate::prepared_ray::PreparedRay;
use crate::simd::{Floats, Mask, Simd};
use crate::triangle::{Edges, Intersection, Shear, exact_intersection};
use crate::wide_tree::WideTree;

/// What a walk reads.
#[derive(Copy, Clone)]
pub(crate) struct Target<'a> {
    pub(crate) tree: &'a WideTree,
    pub(crate) bounds: &'a Bounds,
    pub(crate) quadrics: &'a [Quadric],
    /// The quadrics that are not in the tree, by index.
    pub(crate) unbounded: &'a [u32],
    /// The number of triangles: the primitive number of the first quadric.
    pub(crate) first_quadric: u32,
}

impl Target<'_> {
    /// Whether a quadric was better than the hit so far, which it then is.
    #[inline(always)]
    pub(crate) fn offer_quadric(&self, index: usize, ray: &Ray, closest: &mut Closest) -> bool {
        let crossing = self.quadrics[index].intersect(ray, closest.0.t);
        crossing.is_some_and(|t| {
            closest.offer(self.first_quadric + index as u32, [t, 0.0, 0.0]);
            true
        })
    }
}

/// The closest hit so far; before the first one, `t` is the ray's last.
#[derive(Copy, Clone)]
pub(crate) struct Closest(pub(crate) Hit);

impl Closest {
    pub(crate) fn up_to(t_max: f32) -> Self {
        Self(Hit {
            t: t_max,
            ..Hit::NONE
        })
    }

    /// Equal `t` goes to the smaller primitive number; a hit at the ray's last `t` counts because [`MISS`] is the largest.
    #[inline(always)]
    pub(crate) fn accepts(&self, t: f32, primitive: u32) -> bool {
        t > 0.0 && (t < self.0.t || (t == self.0.t && primitive < self.0.primitive))
    }

    #[inline(always)]
    pub(crate) fn offer(&mut self, primitive: u32, [t, u, v]: [f32; 3]) {
        if self.accepts(t, primitive) {
            self.0 = Hit { t, u, v, primitive };
        }
    }

    #[inline(always)]
    pub(crate) fn into_hit(self) -> Hit {
        if self.0.primitive == MISS {
            Hit::NONE
        } else {
            self.0
        }
    }
}

/// Room for the children that wait on the way down, enough for any ray through the tree.
pub(crate) fn stack_for(tree: &WideTree) -> Vec<u64> {
    vec![0; (WIDTH - 1) * tree.depth + WIDTH]
}

#[inline(always)]
pub(crate) fn pack(entry: f32, child: Child) -> u64 {
    u64::from(entry.to_bits()) << 32 | u64::from(child.0)
}

#[inline(always)]
fn entry_of(packed: u64) -> f32 {
    f32::from_bits((packed >> 32) as u32)
}

#[inline(always)]
fn child_of(packed: u64) -> Child {
    Child(packed as u32)
}

/// Improves `closest` by everything in the tree.
#[inline(always)]
pub(crate) fn closest<S: Simd>(
    set: S,
    target: Target<'_>,
    ray: &Ray,
    prepared: &PreparedRay,
    stack: &mut [u64],
    closest: &mut Closest,
) {
    let slabs = prepared.slabs(ray, target.bounds).splat::<S::Eight>(set);
    let shear = prepared.shear.splat::<S::Eight>(set);
    let (mut current, mut top) = (Child::node(0), 0);
    loop {
        match current.below() {
            Below::Node(index) => {
                let node = &target.tree.nodes[index];
                let (entry, met) = slabs.test(set, node, S::Eight::splat(set, closest.0.t));
                if let Some(nearest) =
                    push_sorted(set, target.tree, node, entry, met.bits(), stack, &mut top)
                {
                    current = nearest;
                    continue;
                }
            }
            Below::Leaf(index) => {
                closest_in_leaf(set, &target.tree.leaves[index], prepared, &shear, closest);
            }
            Below::Quadric(index) => {
                target.offer_quadric(index, ray, closest);
            }
        }
        let Some(next) = pop(stack, &mut top, closest.0.t) else {
            return;
        };
        current = next;
    }
}

/// Takes children off the stack down to the first one that begins before or at `last`.
#[inline(always)]
pub(crate) fn pop(stack: &[u64], top: &mut usize, last: f32) -> Option<Child> {
    while *top > 0 {
        *top -= 1;
        if entry_of(stack[*top]) <= last {
            return Some(child_of(stack[*top]));
        }
    }
    None
}

/// Puts the children of the set bits on the stack, the nearest on top, and takes that one off again.
#[inline(always)]
pub(crate) fn push_sorted<S: Simd>(
    set: S,
    tree: &WideTree,
    node: &Node,
    entry: S::Eight,
    mut met: u32,
    stack: &mut [u64],
    top: &mut usize,
) -> Option<Child> {
    if met == 0 {
        return None;
    }
    let first = met.trailing_zeros() as usize;
    met &= met - 1;
    if met == 0 {
        return Some(node.children[first]);
    }
    let mut entries = [0.0; WIDTH];
    entry.store(&mut entries);
    let mut nearest = pack(entries[first], node.children[first]);
    prefetch(set, tree, node.children[first]);
    let bottom = *top;
    while met != 0 {
        let lane = met.trailing_zeros() as usize;
        met &= met - 1;
        prefetch(set, tree, node.children[lane]);
        let key = pack(entries[lane], node.children[lane]);
        let (near, far) = (key.min(nearest), key.max(nearest));
        nearest = near;
        insert(stack, bottom, *top, far);
        *top += 1;
    }
    Some(child_of(nearest))
}

/// Inserts into the run `stack[bottom..top]`, which falls from bottom to top.
#[inline(always)]
fn insert(stack: &mut [u64], bottom: usize, top: usize, key: u64) {
    let mut place = top;
    while place > bottom && stack[place - 1] < key {
        stack[place] = stack[place - 1];
        place -= 1;
    }
    stack[place] = key;
}

#[inline(always)]
fn prefetch<S: Simd>(set: S, tree: &WideTree, child: Child) {
    let (start, lines) = match child.below() {
        Below::Node(index) => (std::ptr::from_ref(&tree.nodes[index]).cast::<[u8; 64]>(), 4),
        Below::Leaf(index) => (
            std::ptr::from_ref(&tree.leaves[index]).cast::<[u8; 64]>(),
            5,
        ),
        Below::Quadric(_) => return,
    };
    for line in 0..lines {
        set.prefetch(start.wrapping_add(line));
    }
}

/// The crossings of one ray with the triangles of a leaf.
struct LeafTest<F: Floats> {
    /// Lanes in which `f32` decides, and `0 < t ≤ t_max` too.
    accepted: u32,
    /// Lanes that need the exact test.
    uncertain: u32,
    intersection: Intersection<F>,
}

#[inline(always)]
fn test_leaf<S: Simd>(
    set: S,
    leaf: &Leaf,
    prepared: &PreparedRay,
    shear: &Shear<S::Eight>,
    t_max: f32,
) -> Option<LeafTest<S::Eight>> {
    let a = shear.apply(load_corner(set, &leaf.corners[0], prepared.axes));
    let b = shear.apply(load_corner(set, &leaf.corners[1], prepared.axes));
    let c = shear.apply(load_corner(set, &leaf.corners[2], prepared.axes));
    let edges = Edges::new(a, b, c);
    let inside = edges.inside(set).bits();
    let certain = edges.certainly_inside(set);
    let intersection = edges.intersection([a[2], b[2], c[2]]);
    let ahead = S::Eight::splat(set, 0.0).less(intersection.t);
    let before_end = intersection.t.less_equal(S::Eight::splat(set, t_max));
    let accepted = (certain & ahead & before_end).bits();
    let uncertain = inside & !certain.bits();
    if accepted | uncertain == 0 {
        return None;
    }
    Some(LeafTest {
        accepted,
        uncertain,
        intersection,
    })
}

/// One vertex of all triangles of a leaf.
#[inline(always)]
fn load_corner<F: Floats>(
    set: F::Set,
    corner: &[[f32; WIDTH]; 3],
    [x, y, z]: [usize; 3],
) -> [F; 3] {
    [
        F::load(set, &corner[x]),
        F::load(set, &corner[y]),
        F::load(set, &corner[z]),
    ]
}

/// Improves `closest` by the triangles of a leaf; false if none was worth a look.
#[inline(always)]
pub(crate) fn closest_in_leaf<S: Simd>(
    set: S,
    leaf: &Leaf,
    prepared: &PreparedRay,
    shear: &Shear<S::Eight>,
    closest: &mut Closest,
) -> bool {
    let Some(test) = test_leaf(set, leaf, prepared, shear, closest.0.t) else {
        return false;
    };
    if test.accepted != 0 {
        offer_lanes(leaf, test.accepted, &test.intersection, closest);
    }
    let mut uncertain = test.uncertain;
    while uncertain != 0 {
        let lane = uncertain.trailing_zeros() as usize;
        uncertain &= uncertain - 1;
        if let Some(crossing) = exact_in_lane(leaf, lane, prepared) {
            closest.offer(leaf.triangles[lane], crossing);
        }
    }
    true
}

#[inline(always)]
fn offer_lanes<F: Floats>(
    leaf: &Leaf,
    mut lanes: u32,
    intersection: &Intersection<F>,
    closest: &mut Closest,
) {
    let [mut t, mut v, mut w, mut determinant] = [[0.0; WIDTH]; 4];
    intersection.t.store(&mut t);
    intersection.v.store(&mut v);
    intersection.w.store(&mut w);
    intersection.determinant.store(&mut determinant);
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        if closest.accepts(t[lane], leaf.triangles[lane]) {
            let [u, v] = [v[lane] / determinant[lane], w[lane] / determinant[lane]];
            closest.0 = Hit {
                t: t[lane],
                u,
                v,
                primitive: leaf.triangles[lane],
            };
        }
    }
}

#[cold]
pub(crate) fn exact_in_lane(leaf: &Leaf, lane: usize, prepared: &PreparedRay) -> Option<[f32; 3]> {
    let [a, b, c] = leaf
        .triangle(lane, prepared.axes)
        .map(|corner| prepared.shear.apply(corner));
    exact_intersection(a, b, c)
}

/// Whether any triangle is hit in 0 < t ≤ the ray's last; the hit then has some primitive and nothing else.
#[inline(always)]
pub(crate) fn occluded_in_leaf<S: Simd>(
    set: S,
    leaf: &Leaf,
    prepared: &PreparedRay,
    shear: &Shear<S::Eight>,
    any: &mut Closest,
) -> bool {
    let last = any.0.t;
    let Some(test) = test_leaf(set, leaf, prepared, shear, last) else {
        return false;
    };
    let is_hit = test.accepted != 0 || exactly_occluded(leaf, test.uncertain, prepared, last);
    if is_hit {
        any.0.primitive = leaf.triangles[0];
    }
    is_hit
}

#[cold]
fn exactly_occluded(leaf: &Leaf, lanes: u32, prepared: &PreparedRay, last: f32) -> bool {
    (0..WIDTH)
        .filter(|&lane| lanes >> lane & 1 == 1)
        .any(|lane| exact_in_lane(leaf, lane, prepared).is_some_and(|[t, ..]| t > 0.0 && t <= last))
}
