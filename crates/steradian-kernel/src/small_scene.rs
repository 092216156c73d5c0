//! Rays side by side against every triangle, for scenes so small that a tree does not pay.
//!
//! A vector holds one number of as many rays as it has lanes. Vertices that triangles share are sheared once. Rays with
//! different main axes go together: the coordinates are permuted lane by lane. The operations on each ray are those of the
//! tree's leaves, so the hits are the same bits.
//!
//! Walls, floor and ceiling of a room lie in the faces of the box around it, and no shadow ray within that box can meet them: they are left
//! out where all rays of a vector begin and end within it.

use crate::batch::{Hit, HitBatch, MISS, RayBatch};
use crate::geometry::COORDINATE_LIMIT;
use crate::node::Bounds;
use crate::prepared_ray::DIRECTION_RANGE;
use crate::simd::{Floats, Mask, Simd};
use crate::triangle::{Edges, Intersection, Shear, intersect_sheared};

/// Up to this many triangles, trying all is faster than a tree.
pub(crate) const MOST_TRIANGLES: usize = 64;

/// 2⁻²¹, against the 2⁻²² that the end of a ray may be off in units of the greatest coordinate.
const END_ROUNDING: f32 = 1.0 / (1 << 21) as f32;

/// Lanes of the widest vector.
const MOST_LANES: usize = 16;

/// A number for every ray of a group.
type Column = [f32; MOST_LANES];

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
        let mut undecided = zero.less(zero);
        for quad in &self.quads {
            let found = quad.crossing(set, sheared);
            undecided = undecided | found.undecided;
            let crossing = found.crossing;
            let on_ray = zero.less(crossing.t) & crossing.t.less_equal(group.t_max);
            let nearer = found.certain & on_ray & crossing.t.less(best.t);
            best.t = F::select(nearer, crossing.t, best.t);
            best.index = F::select(nearer, found.index, best.index);
            best.v = F::select(nearer, crossing.v, best.v);
            best.w = F::select(nearer, crossing.w, best.w);
            best.determinant = F::select(nearer, crossing.determinant, best.determinant);
        }
        if undecided.bits() == 0 {
            best
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
                    index[lane] = (place + 1) as f32;
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
    let mut undecided = met;
    for quad in quads {
        let found = quad.crossing(set, sheared);
        undecided = undecided | found.undecided;
        let t = found.crossing.t;
        met = met | found.certain & zero.less(t) & t.less(group.t_max);
    }
    if undecided.without(met).bits() == 0 {
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

/// The triangles (a, b, c) and (a, c, d), or a lone one with d = c, of whose second half no ray is inside.
#[derive(Copy, Clone)]
struct Quad {
    /// Indices of a, b, c and d.
    corners: [u16; 4],
    /// Place of the first triangle in [`SmallScene::numbers`]; the second is the next one.
    place: usize,
}

/// Triangles by number, in pairs where two that follow each other are the halves of a quadrilateral.
fn quads(triangles: &[[u16; 3]]) -> Vec<Quad> {
    let mut quads = Vec::new();
    let mut place = 0;
    while let Some(&[a, b, c]) = triangles.get(place) {
        let second = triangles.get(place + 1).filter(|next| next[..2] == [a, c]);
        quads.push(Quad {
            corners: [a, b, c, second.map_or(c, |next| next[2])],
            place: place + 1,
        });
        place += 1 + usize::from(second.is_some());
    }
    quads
}

/// What a quad has to say about a group.
struct Found<F: Floats> {
    /// Where the ray passes through exactly one of the triangles, far from its border.
    certain: F::Mask,
    /// Where that has to be looked at again: at a border, or if the quadrilateral is folded.
    undecided: F::Mask,
    crossing: Intersection<F>,
    index: F,
}

impl Quad {
    #[inline(always)]
    fn crossing<F: Floats>(&self, set: F::Set, sheared: &[[F; 3]]) -> Found<F> {
        let [a, b, c, d] = self.corners.map(|corner| sheared[usize::from(corner)]);
        let first = Edges::new(a, b, c);
        let second = first.of_neighbour(set, a, c, d);
        let (in_first, in_second) = (first.certainly_inside(set), second.certainly_inside(set));
        let edges = Edges::select(in_second, second, first);
        let depths = [
            a[2],
            F::select(in_second, c[2], b[2]),
            F::select(in_second, d[2], c[2]),
        ];
        let [one, next] = [self.place, self.place + 1].map(|place| F::splat(set, place as f32));
        Found {
            certain: in_first | in_second,
            undecided: first.inside(set).without(in_first)
                | second.inside(set).without(in_second)
                | in_first & in_second,
            crossing: edges.intersection(depths),
            index: F::select(in_second, next, one),
        }
    }

    fn triangles(&self) -> [[u16; 3]; 2] {
        let [a, b, c, d] = self.corners;
        [[a, b, c], [a, c, d]]
    }
}

#[inline(always)]
fn shear<F: Floats>(set: F::Set, vertices: &[[f32; 3]], group: &Group<F>, sheared: &mut [[F; 3]]) {
    for (&[x, y, z], sheared) in vertices.iter().zip(sheared) {
        let vertex = [F::splat(set, x), F::splat(set, y), F::splat(set, z)];
        *sheared = group.shear.apply(group.axes.permute(vertex));
    }
}

/// As many rays as a vector has lanes.
struct Group<F: Floats> {
    valid: F::Mask,
    origin: [F; 3],
    direction: [F; 3],
    axes: Axes<F::Mask>,
    /// Not a number in the lanes of invalid rays, which no test accepts.
    shear: Shear<F>,
    t_max: F,
}

impl<F: Floats> Group<F> {
    /// Rays `start .. start + count`; the other lanes hold invalid ones.
    #[inline(always)]
    fn load(set: F::Set, rays: &RayBatch, start: usize, count: usize) -> Self {
        let origin = [
            load(set, &rays.origin_x, start, count),
            load(set, &rays.origin_y, start, count),
            load(set, &rays.origin_z, start, count),
        ];
        let direction = [
            load(set, &rays.direction_x, start, count),
            load(set, &rays.direction_y, start, count),
            load(set, &rays.direction_z, start, count),
        ];
        let t_max: F = load(set, &rays.t_max, start, count);
        let lengths = [
            absolute(set, direction[0]),
            absolute(set, direction[1]),
            absolute(set, direction[2]),
        ];
        let valid = are_valid(set, origin, lengths, t_max);
        let axes = Axes::of(lengths);
        let [x, y, z] = axes.permute(origin);
        let x = F::select(valid, x, F::splat(set, f32::NAN));
        let y = F::select(valid, y, F::splat(set, f32::NAN));
        Self {
            valid,
            origin,
            direction,
            axes,
            shear: Shear::new(set, [x, y, z], axes.permute(direction)),
            t_max,
        }
    }

    /// Whether all valid rays begin and end within a box: a segment between two points of a convex body meets none of its faces, unless it
    /// runs along one, which is to see it edge-on.
    ///
    /// Ends are off by two roundings of numbers below three times the greatest coordinate along the axis; both count as within if they clear
    /// the faces by more.
    #[inline(always)]
    fn stays_within(&self, set: F::Set, bounds: &Bounds) -> bool {
        let mut inside = self.valid;
        for axis in 0..3 {
            let (lower, upper) = (bounds.lower[axis], bounds.upper[axis]);
            let margin = F::splat(set, lower.abs().max(upper.abs()) * END_ROUNDING);
            let (lower, upper) = (F::splat(set, lower), F::splat(set, upper));
            let origin = self.origin[axis];
            let end = origin + self.direction[axis] * self.t_max;
            let (lower, upper) = (lower + margin, upper - margin);
            inside = inside
                & lower.less_equal(origin.minimum(end))
                & origin.maximum(end).less_equal(upper);
        }
        self.valid.without(inside).bits() == 0
    }
}

/// Part of a column, filled up with NaN.
#[inline(always)]
fn load<F: Floats>(set: F::Set, column: &[f32], start: usize, count: usize) -> F {
    let values = &column[start..start + count];
    if count == F::LANES {
        return F::load(set, values);
    }
    let mut padded = [f32::NAN; MOST_LANES];
    padded[..count].copy_from_slice(values);
    F::load(set, &padded)
}

#[inline(always)]
fn absolute<F: Floats>(set: F::Set, x: F) -> F {
    x.maximum(F::splat(set, 0.0) - x)
}

/// [`Ray`](crate::Ray) says what is valid; all comparisons fail on NaN.
#[inline(always)]
fn are_valid<F: Floats>(set: F::Set, [x, y, z]: [F; 3], lengths: [F; 3], t_max: F) -> F::Mask {
    let limit = F::splat(set, COORDINATE_LIMIT);
    let near = absolute(set, x).less_equal(limit)
        & absolute(set, y).less_equal(limit)
        & absolute(set, z).less_equal(limit);
    let longest = F::splat(set, *DIRECTION_RANGE.end());
    let [a, b, c] = lengths;
    let not_long = a.less_equal(longest) & b.less_equal(longest) & c.less_equal(longest);
    let not_short = F::splat(set, *DIRECTION_RANGE.start()).less_equal(a.maximum(b).maximum(c));
    near & not_long & not_short & t_max.less_equal(F::splat(set, f32::INFINITY))
}

/// Which axis is the main one, lane by lane.
#[derive(Copy, Clone)]
struct Axes<M> {
    is_x: M,
    /// Where it is not x.
    is_y: M,
}

impl<M: Mask> Axes<M> {
    /// Of directions with these absolute components.
    #[inline(always)]
    fn of<F: Floats<Mask = M>>([x, y, z]: [F; 3]) -> Self {
        Self {
            is_x: y.less_equal(x) & z.less_equal(x),
            is_y: z.less_equal(y),
        }
    }

    /// Components in the order of the shear, the main one last.
    #[inline(always)]
    fn permute<F: Floats<Mask = M>>(&self, [x, y, z]: [F; 3]) -> [F; 3] {
        [
            F::select(self.is_x, y, F::select(self.is_y, z, x)),
            F::select(self.is_x, z, F::select(self.is_y, x, y)),
            F::select(self.is_x, x, F::select(self.is_y, y, z)),
        ]
    }
}

/// The closest hits of a group.
#[derive(Copy, Clone)]
struct Best<F> {
    t: F,
    /// Place in [`SmallScene::numbers`], a small integer and so exact; 0 for a miss.
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

    #[inline(always)]
    fn write(self, numbers: &[u32], hits: &mut HitBatch, start: usize, count: usize) {
        let end = start + count;
        hits.t[start..end].copy_from_slice(&column(self.t)[..count]);
        hits.u[start..end].copy_from_slice(&column(self.v / self.determinant)[..count]);
        hits.v[start..end].copy_from_slice(&column(self.w / self.determinant)[..count]);
        let places = column(self.index);
        for (primitive, place) in hits.primitive[start..end].iter_mut().zip(places) {
            *primitive = numbers[place as usize];
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
