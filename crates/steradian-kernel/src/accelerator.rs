//! The public face: build once, then ask in batches.

use crate::batch::{Hit, HitBatch, MISS, Ray, RayBatch};
use crate::geometry::{BuildError, Geometry, Quadric};
use crate::instruction_set::{InstructionSet, Kernel};
use crate::node::{Bounds, WIDTH};
use crate::packet::{Packet, Patience};
use crate::prepared_ray::PreparedRay;
use crate::region::Regions;
use crate::simd::Simd;
use crate::small_scene::SmallScene;
use crate::traversal::{self, Closest, Target};
use crate::triangle::{self, is_degenerate};
use crate::turns::{Question, Turns};
use crate::wide_tree::WideTree;
use std::num::NonZero;

/// With more quadrics than this a tree is faster than trying all.
const MOST_QUADRICS_WITHOUT_TREE: usize = 4;

/// Each takes some 50 MB while it builds.
const MOST_THREADS: usize = 16;

/// A scene prepared for ray queries. Triangles are primitives 0 .. T in input order, quadrics T .. T + Q.
#[derive(Clone)]
pub struct Accelerator {
    /// All triangles that can be hit and all bounded quadrics.
    tree: WideTree,
    bounds: Bounds,
    quadrics: Vec<Quadric>,
    /// Planes, by index.
    unbounded: Vec<u32>,
    triangle_count: usize,
    /// The triangles once more, if there are only a few primitives.
    small: Option<SmallScene>,
}

impl Accelerator {
    /// Checks the geometry and builds the tree, above 2²⁰ triangles on as many threads as the machine runs at once, but no more than 16.
    /// Triangles whose corners lie on a line are kept as numbers but never hit.
    ///
    /// # Errors
    /// [`BuildError`] names the first vertex, triangle or quadric that cannot be used.
    pub fn build(geometry: &Geometry) -> Result<Self, BuildError> {
        let threads = std::thread::available_parallelism().map_or(1, NonZero::get);
        Self::build_on_threads(geometry, threads.min(MOST_THREADS))
    }

    /// The same tree, on so many threads.
    ///
    /// # Errors
    /// Those of [`build`](Self::build).
    pub fn build_on_threads(geometry: &Geometry, threads: usize) -> Result<Self, BuildError> {
        geometry.validate()?;
        let corners = |triangle: u32| geometry.corners(triangle as usize);
        let mut hittable = Vec::with_capacity(geometry.triangles.len());
        hittable
            .extend((0..geometry.triangles.len() as u32).filter(|&n| !is_degenerate(corners(n))));
        let (mut bounded, mut unbounded) = (Vec::new(), Vec::new());
        for (index, quadric) in (0..).zip(&geometry.quadrics) {
            match quadric.bounds() {
                Some(bounds) => bounded.push((bounds, index)),
                None => unbounded.push(index),
            }
        }
        let small = (geometry.quadrics.len() <= MOST_QUADRICS_WITHOUT_TREE)
            .then(|| SmallScene::new(&hittable, corners))
            .flatten();
        let tree = WideTree::build(hittable, &bounded, corners, threads);
        Ok(Self {
            bounds: tree.bounds(),
            tree,
            quadrics: geometry.quadrics.clone(),
            unbounded,
            triangle_count: geometry.triangles.len(),
            small,
        })
    }

    /// For each ray the hit with the smallest `(t, primitive)`, 0 < t ≤ t_max. `hits` gets as many rows as there are rays.
    pub fn closest(&self, rays: &RayBatch, hits: &mut HitBatch, instruction_set: InstructionSet) {
        hits.resize(rays.len());
        instruction_set.dispatch(ClosestHits {
            accelerator: self,
            rays,
            hits,
        });
    }

    /// For each ray whether anything is in 0 < t < t_max. `occluded` gets as many rows as there are rays.
    pub fn occluded(
        &self,
        rays: &RayBatch,
        occluded: &mut Vec<bool>,
        instruction_set: InstructionSet,
    ) {
        occluded.resize(rays.len(), false);
        instruction_set.dispatch(Occlusions {
            accelerator: self,
            rays,
            occluded,
        });
    }

    /// The closest hit of one ray, the same bits as [`closest`](Self::closest) gives.
    pub fn closest_scalar(&self, ray: &Ray) -> Hit {
        let Some(prepared) = PreparedRay::new(ray) else {
            return Hit::NONE;
        };
        let mut stack = traversal::stack_for(&self.tree);
        self.closest_in_tree(crate::simd::Scalar, ray, &prepared, &mut stack)
    }

    /// The closest hit of one ray by trying all primitives: slow, and the judge of everything else here.
    pub fn closest_brute_force(&self, ray: &Ray) -> Hit {
        let Some(prepared) = PreparedRay::new(ray) else {
            return Hit::NONE;
        };
        let mut closest = Closest::up_to(prepared.t_max);
        for leaf in &self.tree.leaves {
            for (lane, number) in leaf.lanes() {
                if let Some(crossing) =
                    triangle::intersect(&prepared.shear, leaf.triangle(lane, prepared.axes))
                {
                    closest.offer(number, crossing);
                }
            }
        }
        self.try_quadrics(0..self.quadrics.len(), ray, &mut closest);
        closest.into_hit()
    }

    /// True only if no primitive, except those that `ignore` accepts, reaches into the convex region of the points x with
    /// n · x ≤ d for every plane `[n_x, n_y, n_z, d]`.
    ///
    /// Touching counts. The answer may be false for a region that is clear by less than about 10⁻¹² of the coordinates,
    /// near an edge of a curved primitive, or inside a sphere; it is never true for one that is blocked.
    pub fn region_is_clear(&self, planes: &[[f64; 4]], ignore: &dyn Fn(u32) -> bool) -> bool {
        self.regions().each(planes, ignore, &mut |_| false)
    }

    /// Asks about many regions.
    pub fn regions(&self) -> Regions<'_> {
        Regions::new(self)
    }

    /// Lower and upper corner of the box around everything that has one; nothing if that is empty.
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        (self.bounds != Bounds::EMPTY).then_some([self.bounds.lower, self.bounds.upper])
    }

    /// The number of triangles, degenerate ones too.
    pub fn triangle_count(&self) -> usize {
        self.triangle_count
    }

    /// Memory of the tree.
    pub fn memory_bytes(&self) -> usize {
        self.tree.memory_bytes()
    }

    pub(crate) fn tree(&self) -> &WideTree {
        &self.tree
    }

    pub(crate) fn quadrics(&self) -> &[Quadric] {
        &self.quadrics
    }

    pub(crate) fn unbounded(&self) -> &[u32] {
        &self.unbounded
    }

    /// The primitive number of a quadric.
    #[inline(always)]
    pub(crate) fn quadric_number(&self, index: usize) -> u32 {
        (self.triangle_count + index) as u32
    }

    fn target(&self) -> Target<'_> {
        Target {
            tree: &self.tree,
            bounds: &self.bounds,
            quadrics: &self.quadrics,
            unbounded: &self.unbounded,
            first_quadric: self.quadric_number(0),
        }
    }

    #[inline(always)]
    fn closest_in_tree<S: Simd>(
        &self,
        set: S,
        ray: &Ray,
        prepared: &PreparedRay,
        stack: &mut [u64],
    ) -> Hit {
        let mut closest = Closest::up_to(prepared.t_max);
        self.try_quadrics(
            self.unbounded.iter().map(|&index| index as usize),
            ray,
            &mut closest,
        );
        if !self.tree.nodes.is_empty() {
            traversal::closest(set, self.target(), ray, prepared, stack, &mut closest);
        }
        closest.into_hit()
    }

    /// Packets where neighbouring rays are alike, the other rays by turns.
    #[inline(always)]
    fn closest_of_many<S: Simd>(&self, set: S, rays: &RayBatch, hits: &mut HitBatch) {
        let mut stack = traversal::stack_for(&self.tree);
        let mut single = Vec::new();
        for start in (0..rays.len()).step_by(Packet::<S>::RAYS) {
            if let Some(mut packet) = Packet::new(set, rays, start, &self.bounds) {
                packet.try_quadrics(self.target());
                packet.trace(self.target(), &mut stack);
                packet.write(hits);
                continue;
            }
            single.push(start as u32);
        }
        Turns::trace(set, self.target(), rays, &single, ClosestRows(hits));
    }

    #[inline(always)]
    fn occlusion_of_many<S: Simd>(&self, set: S, rays: &RayBatch, occluded: &mut [bool]) {
        let mut stack = traversal::stack_for(&self.tree);
        let mut starts = Vec::new();
        let mut patience = Patience::default();
        for start in (0..rays.len()).step_by(Packet::<S>::RAYS) {
            let (bounds, widest) = (&self.bounds, patience.widest());
            if let Some(mut packet) = Packet::of_shadow_rays(set, rays, start, bounds, widest) {
                packet.try_quadrics(self.target());
                let got_through = packet.trace(self.target(), &mut stack);
                patience.learn(got_through);
                if got_through {
                    packet.write_any(occluded);
                    continue;
                }
            }
            starts.push(start as u32);
        }
        Turns::trace(set, self.target(), rays, &starts, OccludedRows(occluded));
    }

    #[inline(always)]
    fn try_quadrics(&self, indices: impl Iterator<Item = usize>, ray: &Ray, closest: &mut Closest) {
        for index in indices {
            if let Some(t) = self.quadrics[index].intersect(ray, closest.0.t) {
                closest.offer(self.quadric_number(index), [t, 0.0, 0.0]);
            }
        }
    }

    #[inline(always)]
    fn occluded_by_quadrics(&self, mut indices: impl Iterator<Item = usize>, ray: &Ray) -> bool {
        indices.any(|index| {
            self.quadrics[index]
                .intersect(ray, ray.t_max.next_down())
                .is_some()
        })
    }
}

struct ClosestHits<'a> {
    accelerator: &'a Accelerator,
    rays: &'a RayBatch,
    hits: &'a mut HitBatch,
}

impl Kernel for ClosestHits<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, set: S) {
        let Self {
            accelerator,
            rays,
            hits,
        } = self;
        let Some(small) = &accelerator.small else {
            accelerator.closest_of_many(set, rays, hits);
            return;
        };
        small.closest(set, rays, hits);
        if !accelerator.quadrics.is_empty() {
            for row in 0..rays.len() {
                hits.set(
                    row,
                    accelerator.closest_quadric(&rays.ray(row), hits.hit(row)),
                );
            }
        }
    }
}

struct Occlusions<'a> {
    accelerator: &'a Accelerator,
    rays: &'a RayBatch,
    occluded: &'a mut [bool],
}

impl Kernel for Occlusions<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, set: S) {
        let Self {
            accelerator,
            rays,
            occluded,
        } = self;
        let Some(small) = &accelerator.small else {
            accelerator.occlusion_of_many(set, rays, occluded);
            return;
        };
        small.occluded(set, rays, occluded);
        if !accelerator.quadrics.is_empty() {
            for (row, occluded) in occluded.iter_mut().enumerate() {
                let ray = rays.ray(row);
                *occluded = *occluded || accelerator.occluded_by_quadric(&ray);
            }
        }
    }
}

impl Accelerator {
    /// The better one of a hit on a triangle and all quadrics.
    fn closest_quadric(&self, ray: &Ray, on_triangle: Hit) -> Hit {
        let Some(prepared) = PreparedRay::new(ray) else {
            return Hit::NONE;
        };
        let mut closest = Closest::up_to(prepared.t_max);
        closest.offer(
            on_triangle.primitive,
            [on_triangle.t, on_triangle.u, on_triangle.v],
        );
        self.try_quadrics(0..self.quadrics.len(), ray, &mut closest);
        closest.into_hit()
    }

    fn occluded_by_quadric(&self, ray: &Ray) -> bool {
        PreparedRay::new(ray).is_some() && self.occluded_by_quadrics(0..self.quadrics.len(), ray)
    }
}

const _: () = assert!(WIDTH == 8, "the vectors of `Simd::Eight` have eight lanes");

/// Where closest hits go.
struct ClosestRows<'a>(&'a mut HitBatch);

impl Question for ClosestRows<'_> {
    const ANY: bool = false;

    #[inline(always)]
    fn settle(&mut self, row: usize, hit: Hit) {
        self.0.set(row, hit);
    }
}

/// Where it goes whether there is any hit.
struct OccludedRows<'a>(&'a mut [bool]);

impl Question for OccludedRows<'_> {
    const ANY: bool = true;

    #[inline(always)]
    fn settle(&mut self, row: usize, hit: Hit) {
        self.0[row] = hit.primitive != MISS;
    }
}
