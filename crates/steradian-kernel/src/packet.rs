//! Neighbouring rays through the tree together.
//!
//! As many consecutive rays as a vector has lanes make a packet if they start close together and point nearly the same way, as those of a
//! camera do. The beam around them, intervals of origins and slopes, is tested against all children of a node at once as a
//! single ray would be; it also sorts out the triangles of a leaf. Only what is left is tested ray by ray, one triangle against
//! all rays.
//!
//! The beam only prunes: each of its bounds is computed by the operations of a single ray from the ends of intervals, and rounding is
//! monotone, so that it never leaves out what one of its rays would meet. The test of a ray and a triangle has the operations of
//! the single ray's, and the closest hit is the smallest `(t, primitive)` in any order: hits are the same bits.
//!
//! Shadow rays that point less alike, as those to a large lamp, make a packet, too, but one that is given up if it does not get through
//! in few steps: where much stands in the way, rays are faster by turns.
//!
//! Sources: I. Wald, P. Slusallek, C. Benthin, M. Wagner, "Interactive Rendering with Coherent Ray Tracing", Computer Graphics
//! Forum 20(3), 2001, for packets; S. Boulos, I. Wald, P. Shirley, "Geometric and Arithmetic Culling Methods for Entire Ray
//! Packets", University of Utah UUCS-06-010, 2006, for intervals in their place.

mod beam;
mod best;
mod bundle;
mod patience;

use crate::batch::{HitBatch, MISS, RayBatch};
use crate::node::{Below, Bounds, Child, Leaf, WIDTH};
use crate::prepared_ray::PreparedRay;
use crate::simd::{Floats, Mask, Simd};
use crate::traversal::{Target, exact_in_lane, pop, push_sorted};
use crate::triangle::{Edges, splat};
use beam::Beam;
use best::Best;
use bundle::Bundle;
pub(crate) use patience::Patience;

/// The most by which slopes in a packet differ: rays further apart go alone.
const WIDEST: f32 = 1.0 / 8.0;

/// What a packet of shadow rays may take: nodes, leaves and triangles. As many rays by turns take two to ten times that.
const MOST_STEPS_OF_SHADOW_RAYS: usize = 64;

/// Neighbouring rays with what they share.
pub(crate) struct Packet<'a, S: Simd> {
    set: S,
    rays: &'a RayBatch,
    /// The row of the first ray.
    start: usize,
    bundle: Bundle<S::Wide>,
    beam: Beam<S::Eight>,
    best: Best,
    /// Whether any hit will do.
    any: bool,
}

impl<'a, S: Simd> Packet<'a, S> {
    /// The rays of a packet.
    pub(crate) const RAYS: usize = S::Wide::LANES;

    /// Of the rays from this row on; nothing if they are too few or not much alike, or one is not valid.
    #[inline(always)]
    pub(crate) fn new(set: S, rays: &'a RayBatch, start: usize, bounds: &Bounds) -> Option<Self> {
        Self::no_wider_than(WIDEST, set, rays, start, bounds)
    }

    #[inline(always)]
    fn no_wider_than(
        widest: f32,
        set: S,
        rays: &'a RayBatch,
        start: usize,
        bounds: &Bounds,
    ) -> Option<Self> {
        let bundle = Bundle::<S::Wide>::load(set, rays, start, widest)?;
        let beam = Beam::around::<S::Wide>(set, &bundle, bounds, widest)?;
        let best = Best::up_to(bundle.t_max);
        Some(Self {
            set,
            rays,
            start,
            bundle,
            beam,
            best,
            any: false,
        })
    }

    /// Of shadow rays, whose slopes may differ by `widest`: any hit before the end of a ray will do, and a ray that has one is done.
    #[inline(always)]
    pub(crate) fn of_shadow_rays(
        set: S,
        rays: &'a RayBatch,
        start: usize,
        bounds: &Bounds,
        widest: f32,
    ) -> Option<Self> {
        let mut packet = Self::no_wider_than(widest, set, rays, start, bounds)?;
        packet.any = true;
        for lane in 0..Self::RAYS {
            packet.best.t[lane] = rays.t_max[start + lane].next_down();
        }
        packet.look_for_furthest();
        Some(packet)
    }

    /// Improves the hits by what is not in the tree.
    pub(crate) fn try_quadrics(&mut self, target: Target<'_>) {
        for &index in target.unbounded {
            self.try_quadric(target, index as usize);
        }
    }

    fn try_quadric(&mut self, target: Target<'_>, index: usize) {
        for lane in 0..Self::RAYS {
            let ray = self.rays.ray(self.start + lane);
            if let Some(t) = target.quadrics[index].intersect(&ray, self.best.t[lane]) {
                let primitive = target.first_quadric + index as u32;
                self.best.offer(lane, primitive, [t, 0.0, 0.0]);
            }
        }
        self.look_for_furthest();
    }

    /// Improves the hits by everything in the tree, which is not empty. False if shadow rays would take too many steps: their answers
    /// are not known then.
    #[inline(always)]
    pub(crate) fn trace(&mut self, target: Target<'_>, stack: &mut [u64]) -> bool {
        let (mut current, mut top) = (Child::node(0), 0);
        let mut steps = 0;
        loop {
            steps += 1;
            if self.any && steps > MOST_STEPS_OF_SHADOW_RAYS {
                return false;
            }
            match current.below() {
                Below::Node(index) => {
                    let node = &target.tree.nodes[index];
                    let furthest = S::Eight::splat(self.set, self.best.furthest);
                    let (entry, met) = self.beam.test(self.set, node, furthest);
                    let (tree, met) = (target.tree, met.bits());
                    if let Some(nearest) =
                        push_sorted(self.set, tree, node, entry, met, stack, &mut top)
                    {
                        current = nearest;
                        continue;
                    }
                }
                Below::Leaf(index) => steps += self.try_leaf(&target.tree.leaves[index]),
                Below::Quadric(index) => self.try_quadric(target, index),
            }
            let Some(next) = pop(stack, &mut top, self.best.furthest) else {
                return true;
            };
            current = next;
        }
    }

    #[inline(always)]
    fn look_for_furthest(&mut self) {
        if self.any {
            self.best.retire();
        }
        self.best.look_for_furthest::<S::Wide>();
    }

    /// Writes to the rays' rows whether they have a hit.
    pub(crate) fn write_any(&self, occluded: &mut [bool]) {
        for lane in 0..Self::RAYS {
            occluded[self.start + lane] = self.best.hit(lane).primitive != MISS;
        }
    }

    /// Writes the hits to the rays' rows.
    pub(crate) fn write(&self, hits: &mut HitBatch) {
        for lane in 0..Self::RAYS {
            hits.set(self.start + lane, self.best.hit(lane));
        }
    }

    /// How many triangles had to be tried.
    #[inline(always)]
    fn try_leaf(&mut self, leaf: &Leaf) -> usize {
        let mut triangles = self.beam.may_meet(self.set, leaf).bits();
        let count = triangles.count_ones() as usize;
        let mut is_better = false;
        while triangles != 0 {
            let triangle = triangles.trailing_zeros() as usize % WIDTH;
            triangles &= triangles - 1;
            is_better |= self.try_triangle(leaf, triangle);
        }
        if is_better {
            self.look_for_furthest();
        }
        count
    }

    /// Whether any hit may be better now.
    #[inline(always)]
    fn try_triangle(&mut self, leaf: &Leaf, triangle: usize) -> bool {
        let [a, b, c] = leaf.triangle(triangle, self.bundle.axes);
        let shear = &self.bundle.shear;
        let a = shear.apply(splat::<S::Wide>(self.set, a));
        let b = shear.apply(splat::<S::Wide>(self.set, b));
        let c = shear.apply(splat::<S::Wide>(self.set, c));
        let edges = Edges::new(a, b, c);
        let inside = edges.inside(self.set).bits();
        if inside == 0 {
            return false;
        }
        let certain = edges.certainly_inside(self.set);
        let crossing = edges.intersection([a[2], b[2], c[2]]);
        let number = leaf.triangles[triangle];
        let is_better = self.best.offer_all(self.set, number, certain, &crossing);
        let uncertain = inside & !certain.bits();
        if uncertain != 0 {
            self.try_exactly(leaf, triangle, uncertain);
        }
        is_better || uncertain != 0
    }

    #[cold]
    fn try_exactly(&mut self, leaf: &Leaf, triangle: usize, lanes: u32) {
        for lane in (0..Self::RAYS).filter(|&lane| lanes >> lane & 1 == 1) {
            let prepared = PreparedRay::new(&self.rays.ray(self.start + lane));
            let crossing = prepared.and_then(|prepared| exact_in_lane(leaf, triangle, &prepared));
            if let Some(crossing) = crossing {
                self.best.offer(lane, leaf.triangles[triangle], crossing);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Packet;
    use crate::batch::RayBatch;
    use crate::instruction_set::{InstructionSet, Kernel};
    use crate::node::Bounds;
    use crate::simd::Simd;

    struct IsPacket<'a>(&'a RayBatch, usize);

    impl Kernel for IsPacket<'_> {
        type Output = bool;
        #[inline(always)]
        fn run<S: Simd>(self, set: S) -> bool {
            let bounds = Bounds::of_points(&[[-1.0; 3], [1.0; 3]]);
            Packet::new(set, self.0, self.1, &bounds).is_some()
        }
    }

    /// Sixteen rays along +x, the third one changed.
    fn rays(origin: [f32; 3], direction: [f32; 3], t_max: f32) -> RayBatch {
        let mut rays = RayBatch::default();
        for row in 0..16 {
            rays.push([0.0; 3], [1.0, 0.005 * row as f32, 0.5], f32::INFINITY);
        }
        rays.set(2, origin, direction, t_max);
        rays
    }

    #[test]
    fn rays_that_are_alike_make_a_packet() {
        let (origin, direction) = ([0.0; 3], [1.0, 0.0, 0.5]);
        for set in InstructionSet::available() {
            let is_packet = |rays: &RayBatch, start| set.dispatch(IsPacket(rays, start));
            assert!(is_packet(&rays(origin, direction, 3.0), 0));
            assert!(!is_packet(&rays(origin, direction, 3.0), 9));
            for other in [
                rays([0.5, 0.0, 0.0], direction, 3.0),
                rays([f32::NAN, 0.0, 0.0], direction, 3.0),
                rays(origin, direction, f32::NAN),
                rays(origin, [1.0, 0.5, 0.5], 3.0),
                rays(origin, [1.0, -0.0, 0.5], 3.0),
                rays(origin, [1.0, 0.0, 1.5], 3.0),
                rays(origin, [1.0, f32::NAN, 0.5], 3.0),
            ] {
                assert!(!is_packet(&other, 0), "{set:?}, {:?}", other.ray(2));
            }
        }
    }
}
