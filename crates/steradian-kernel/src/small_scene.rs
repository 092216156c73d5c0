//! Rays side by side against every triangle, for scenes so small that a tree does not pay.
//!
//! A vector holds one number of as many rays as it has lanes. Vertices that triangles share are sheared once. Rays with
//! different main axes go together: the coordinates are permuted lane by lane. The operations on each ray are those of the
//! tree's leaves, so the hits are the same bits.
//!
//! Walls, floor and ceiling of a room lie in the faces of the box around it, and no shadow ray within that box can meet them: they are left
//! out where all rays of a vector begin and end within it.

mod group;
mod quad;

use crate::batch::{Hit, HitBatch, MISS, RayBatch};
use crate::node::Bounds;
use crate::side_by_side::{Column, MOST_LANES};
use crate::simd::{Floats, Mask, Simd};
use crate::triangle::intersect_sheared;
use group::Group;
use quad::{Doubt, Quad, quads};

/// Up to this many triangles, trying all is faster than a tree.
pub(crate) const MOST_TRIANGLES: usize = 64;

/// Triangles by number, over vertices without duplicates.
#[derive(Clone)]
pub(crate) struct SmallScene {
    /// Those of the inner triangles come first.
    vertices: Vec<[f32; 3]>,
    inner_vertices: usize,
    /// Indices of the corners.
    triangles: Vec<[u16; 3]>,
    quads: Vec<Quad>,
    /// The triangles that do not lie in a face of `bounds`.
    inner: Vec<Quad>,
    bounds: Bounds,
    /// What the triangles are called outside, in ascending order, after the name of a miss.
    numbers: Vec<u32>,
}

impl SmallScene {
    /// `numbers` are the triangles that can be hit, in ascending order. Nothing if a tree is the better choice.
    pub(crate) fn new(numbers: &[u32], corners: impl Fn(u32) -> [[f32; 3]; 3]) -> Option<Self> {
        if numbers.len() > MOST_TRIANGLES {
            return None;
        }
        let boxes = numbers
            .iter()
            .map(|&number| Bounds::of_points(&corners(number)));
        let bounds = boxes.fold(Bounds::EMPTY, Bounds::union);
        let mut scene = Self {
            vertices: Vec::new(),
            inner_vertices: 0,
            triangles: Vec::new(),
            quads: Vec::new(),
            inner: Vec::new(),
            bounds,
            numbers: vec![MISS],
        };
        scene.numbers.extend(numbers);
        let mut inner = Vec::new();
        for corners in numbers.iter().map(|&number| corners(number)) {
            if !bounds.has_in_a_face(&Bounds::of_points(&corners)) {
                inner.push(corners.map(|corner| scene.vertex(corner)));
            }
        }
        scene.inner = quads(&inner);
        scene.inner_vertices = scene.vertices.len();
        for &number in numbers {
            let triangle = corners(number).map(|corner| scene.vertex(corner));
            scene.triangles.push(triangle);
        }
        scene.quads = quads(&scene.triangles);
        Some(scene)
    }

    /// The index of the vertex with these coordinates, a new one if there is none yet.
    fn vertex(&mut self, position: [f32; 3]) -> u16 {
        let known = self.vertices.iter().position(|&vertex| vertex == position);
        known.unwrap_or_else(|| {
            self.vertices.push(position);
            self.vertices.len() - 1
        }) as u16
    }

    /// The closest triangle of every ray; `hits` has their length.
    #[inline(always)]
    pub(crate) fn closest<S: Simd>(&self, set: S, rays: &RayBatch, hits: &mut HitBatch) {
        let mut sheared = vec![[S::Wide::splat(set, 0.0); 3]; self.vertices.len()];
        let mut start = 0;
        while start < rays.len() {
            let count = S::Wide::LANES.min(rays.len() - start);
            let group = Group::<S::Wide>::load(set, rays, start, count);
            shear(set, &self.vertices, &group, &mut sheared);
            let best = self.closest_of_group(set, &group, &sheared);
            best.write(&self.numbers, hits, start, count);
            start += count;
        }
    }

    /// Whether each ray meets a triangle before its `t_max`; `out` has their length.
    #[inline(always)]
    pub(crate) fn occluded<S: Simd>(&self, set: S, rays: &RayBatch, out: &mut [bool]) {
        let mut sheared = vec![[S::Wide::splat(set, 0.0); 3]; self.vertices.len()];
        for (index, out) in out.chunks_mut(S::Wide::LANES).enumerate() {
            let group = Group::<S::Wide>::load(set, rays, index * S::Wide::LANES, out.len());
            let (vertices, quads) = if group.stays_within(set, &self.bounds) {
                (&self.vertices[..self.inner_vertices], &self.inner)
            } else {
                (&self.vertices[..], &self.quads)
            };
            shear(set, vertices, &group, &mut sheared);
            let met = occluded_of_group(set, quads, &group, &sheared);
            for (lane, out) in out.iter_mut().enumerate() {
                *out = met >> lane & 1 == 1;
            }
        }
    }

    #[inline(always)]
    fn closest_of_group<F: Floats>(
        &self,
        set: F::Set,
        group: &Group<F>,
        sheared: &[[F; 3]],
    ) -> Best<F> {
        let zero = F::splat(set, 0.0);
        let mut best = Best::none(set);
        let mut doubt = Doubt::none(set);
        for quad in &self.quads {
            let found = quad.crossing(set, sheared, &mut doubt);
            let t = found.crossing.t;
            let nearer = found.certain & zero.less(t) & t.less(best.t);
            best.t = F::select(nearer, t, best.t);
            best.index = F::select(nearer, found.index, best.index);
            best.v = F::select(nearer, found.crossing.v, best.v);
            best.w = F::select(nearer, found.crossing.w, best.w);
            best.determinant = F::select(nearer, found.crossing.determinant, best.determinant);
        }
        if doubt.lanes(set) == 0 {
            best.up_to(set, group.t_max)
        } else {
            self.closest_one_by_one(set, group, sheared)
        }
    }

    /// The same, triangle by triangle and lane by lane, with the exact test where it is needed.
    #[cold]
    fn closest_one_by_one<F: Floats>(
        &self,
        set: F::Set,
        group: &Group<F>,
        sheared: &[[F; 3]],
    ) -> Best<F> {
        let none = Best::none(set);
        let (mut t, mut index) = (column(none.t), column(none.index));
        let (mut v, mut w, t_max) = (column(none.v), column(none.w), column(group.t_max));
        for (place, &corners) in self.triangles.iter().enumerate() {
            for (lane, crossing) in crossings(corners, sheared) {
                if crossing[0] > 0.0 && crossing[0] <= t_max[lane] && crossing[0] < t[lane] {
                    [t[lane], v[lane], w[lane]] = crossing;
                    index[lane] = f32::from_bits(place as u32 + 1);
                }
            }
        }
        Best {
            t: F::load(set, &t),
            index: F::load(set, &index),
            v: F::load(set, &v),
            w: F::load(set, &w),
            determinant: none.determinant,
        }
    }
}

/// Lanes whose ray meets something.
#[inline(always)]
fn occluded_of_group<F: Floats>(
    set: F::Set,
    quads: &[Quad],
    group: &Group<F>,
    sheared: &[[F; 3]],
) -> u32 {
    let zero = F::splat(set, 0.0);
    let mut met = zero.less(zero);
    let mut doubt = Doubt::none(set);
    for quad in quads {
        let found = quad.crossing(set, sheared, &mut doubt);
        let t = found.crossing.t;
        met = met | found.certain & zero.less(t) & t.less(group.t_max);
    }
    if doubt.lanes(set) & !met.bits() == 0 {
        met.bits()
    } else {
        met.bits() | occluded_one_by_one(quads, group, sheared)
    }
}

#[cold]
fn occluded_one_by_one<F: Floats>(quads: &[Quad], group: &Group<F>, sheared: &[[F; 3]]) -> u32 {
    let t_max = column(group.t_max);
    let mut met = 0;
    for triangle in quads.iter().flat_map(Quad::triangles) {
        for (lane, [t, ..]) in crossings(triangle, sheared) {
            met |= u32::from(t > 0.0 && t < t_max[lane]) << lane;
        }
    }
    met
}

#[inline(always)]
fn shear<F: Floats>(set: F::Set, vertices: &[[f32; 3]], group: &Group<F>, sheared: &mut [[F; 3]]) {
    for (&[x, y, z], sheared) in vertices.iter().zip(sheared) {
        let vertex = [F::splat(set, x), F::splat(set, y), F::splat(set, z)];
        *sheared = group.shear.apply(group.axes.permute(vertex));
    }
}

/// The closest hits of a group.
#[derive(Copy, Clone)]
struct Best<F> {
    t: F,
    /// Place in [`SmallScene::numbers`], as bits; 0 for a miss.
    index: F,
    v: F,
    w: F,
    determinant: F,
}

impl<F: Floats> Best<F> {
    #[inline(always)]
    fn none(set: F::Set) -> Self {
        let (zero, one) = (F::splat(set, 0.0), F::splat(set, 1.0));
        Self {
            t: F::splat(set, Hit::NONE.t),
            index: zero,
            v: zero,
            w: zero,
            determinant: one,
        }
    }

    /// The hits that are not behind the ends of the rays.
    #[inline(always)]
    fn up_to(self, set: F::Set, t_max: F) -> Self {
        let (none, keeps) = (Self::none(set), self.t.less_equal(t_max));
        let keep = |found, none| F::select(keeps, found, none);
        Self {
            t: keep(self.t, none.t),
            index: keep(self.index, none.index),
            v: keep(self.v, none.v),
            w: keep(self.w, none.w),
            determinant: keep(self.determinant, none.determinant),
        }
    }

    #[inline(always)]
    fn write(self, numbers: &[u32], hits: &mut HitBatch, start: usize, count: usize) {
        let end = start + count;
        hits.t[start..end].copy_from_slice(&column(self.t)[..count]);
        hits.u[start..end].copy_from_slice(&column(self.v / self.determinant)[..count]);
        hits.v[start..end].copy_from_slice(&column(self.w / self.determinant)[..count]);
        let places = column(self.index);
        for (primitive, place) in hits.primitive[start..end].iter_mut().zip(places) {
            *primitive = numbers[place.to_bits() as usize];
        }
    }
}

/// The lanes of a vector.
#[inline(always)]
fn column<F: Floats>(vector: F) -> Column {
    let mut lanes = [0.0; MOST_LANES];
    vector.store(&mut lanes);
    lanes
}

/// Crossings of a triangle, lane by lane.
fn crossings<F: Floats>(
    corners: [u16; 3],
    sheared: &[[F; 3]],
) -> impl Iterator<Item = (usize, [f32; 3])> {
    let corners = corners.map(|corner| sheared[usize::from(corner)].map(column));
    (0..F::LANES).filter_map(move |lane| {
        let [a, b, c] = corners.map(|corner| corner.map(|column| column[lane]));
        Some((lane, intersect_sheared(a, b, c)?))
    })
}
