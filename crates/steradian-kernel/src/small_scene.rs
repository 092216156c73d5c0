//! Rays side by side against every triangle, for scenes so small that a tree does not pay.
//!
//! Vertices that triangles share are sheared once. Rays are taken in groups with the same main axis, so that a vector holds
//! as many rays as it has lanes; the operations on each are those of the tree's leaves, bit for bit.

use crate::batch::{Hit, HitBatch, RayBatch};
use crate::prepared_ray::{axes_of, is_valid, main_axis, permute};
use crate::simd::{Floats, Mask, Simd};
use crate::triangle::{Edges, Shear, exact_intersection, splat};

/// Up to this many triangles, trying all is faster than a tree.
pub(crate) const MOST_TRIANGLES: usize = 64;

/// Lanes of the widest vector.
const MOST_LANES: usize = 16;

/// Rays sorted into groups at once.
const CHUNK: usize = 1024;

/// Triangles by number, over vertices without duplicates.
#[derive(Clone)]
pub(crate) struct SmallScene {
    vertices: Vec<[f32; 3]>,
    /// Indices of the corners.
    triangles: Vec<[u16; 3]>,
    /// What the triangles are called outside, in ascending order.
    numbers: Vec<u32>,
}

impl SmallScene {
    /// `numbers` are the triangles that can be hit, in ascending order. Nothing if a tree is the better choice.
    pub(crate) fn new(numbers: &[u32], corners: impl Fn(u32) -> [[f32; 3]; 3]) -> Option<Self> {
        if numbers.len() > MOST_TRIANGLES {
            return None;
        }
        let mut scene = Self {
            vertices: Vec::new(),
            triangles: Vec::new(),
            numbers: numbers.to_vec(),
        };
        for &number in numbers {
            let triangle = corners(number).map(|corner| scene.vertex(corner));
            scene.triangles.push(triangle);
        }
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
        for start in (0..rays.len()).step_by(CHUNK) {
            let sorted = Sorted::new(rays, start);
            for main in 0..3 {
                for rows in sorted.groups(main, S::Wide::LANES) {
                    let group = Group::<S::Wide>::load(set, rays, axes_of(main), rows);
                    self.shear(set, &group, axes_of(main), &mut sheared);
                    self.closest_of_group(set, &group, &sheared)
                        .write(&self.numbers, rows, hits);
                }
            }
            sorted
                .invalid()
                .iter()
                .for_each(|&row| hits.set(row as usize, Hit::NONE));
        }
    }

    /// Whether each ray meets a triangle before its `t_max`; `out` has their length.
    #[inline(always)]
    pub(crate) fn occluded<S: Simd>(&self, set: S, rays: &RayBatch, out: &mut [bool]) {
        let mut sheared = vec![[S::Wide::splat(set, 0.0); 3]; self.vertices.len()];
        for start in (0..rays.len()).step_by(CHUNK) {
            let sorted = Sorted::new(rays, start);
            for main in 0..3 {
                for rows in sorted.groups(main, S::Wide::LANES) {
                    let group = Group::<S::Wide>::load(set, rays, axes_of(main), rows);
                    self.shear(set, &group, axes_of(main), &mut sheared);
                    let met = self.occluded_of_group(set, &group, &sheared);
                    for (lane, &row) in rows.iter().enumerate() {
                        out[row as usize] = met >> lane & 1 == 1;
                    }
                }
            }
            sorted
                .invalid()
                .iter()
                .for_each(|&row| out[row as usize] = false);
        }
    }

    #[inline(always)]
    fn shear<F: Floats>(
        &self,
        set: F::Set,
        group: &Group<F>,
        axes: [usize; 3],
        sheared: &mut [[F; 3]],
    ) {
        for (vertex, sheared) in self.vertices.iter().zip(sheared) {
            *sheared = group.shear.apply(splat(set, permute(*vertex, axes)));
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
        let mut best = Best {
            t: group.past_end,
            index: F::splat(set, -1.0),
            v: zero,
            w: zero,
            determinant: F::splat(set, 1.0),
        };
        for (index, triangle) in self.triangles.iter().enumerate() {
            let [a, b, c] = corners(triangle, sheared);
            let edges = Edges::new(a, b, c);
            let inside = edges.inside(set);
            if inside.bits() == 0 {
                continue;
            }
            let certain = edges.certainly_inside(set);
            let crossing = edges.intersection([a[2], b[2], c[2]]);
            let nearer = certain & zero.less(crossing.t) & crossing.t.less(best.t);
            best.t = F::select(nearer, crossing.t, best.t);
            best.index = F::select(nearer, F::splat(set, index as f32), best.index);
            best.v = F::select(nearer, crossing.v, best.v);
            best.w = F::select(nearer, crossing.w, best.w);
            best.determinant = F::select(nearer, crossing.determinant, best.determinant);
            let uncertain = inside.bits() & !certain.bits();
            if uncertain != 0 {
                best.offer_exact(set, index, uncertain, [a, b, c]);
            }
        }
        best
    }

    /// Lanes whose ray meets something.
    #[inline(always)]
    fn occluded_of_group<F: Floats>(
        &self,
        set: F::Set,
        group: &Group<F>,
        sheared: &[[F; 3]],
    ) -> u32 {
        let zero = F::splat(set, 0.0);
        let mut met = 0;
        for triangle in &self.triangles {
            let [a, b, c] = corners(triangle, sheared);
            let edges = Edges::new(a, b, c);
            let inside = edges.inside(set);
            if inside.bits() & !met == 0 {
                continue;
            }
            let certain = edges.certainly_inside(set);
            let t = edges.intersection([a[2], b[2], c[2]]).t;
            met |= (certain & zero.less(t) & t.less(group.end)).bits();
            let uncertain = inside.bits() & !certain.bits() & !met;
            if uncertain != 0 {
                met |= exact_lanes(uncertain, [a, b, c], group.end);
            }
        }
        met
    }
}

/// Rows of a chunk of the batch, by main axis; the fourth list holds the rays that are not valid.
struct Sorted {
    rows: [[u32; CHUNK]; 4],
    counts: [usize; 4],
}

impl Sorted {
    #[inline(always)]
    fn new(rays: &RayBatch, start: usize) -> Self {
        let mut sorted = Self {
            rows: [[0; CHUNK]; 4],
            counts: [0; 4],
        };
        for row in start..rays.len().min(start + CHUNK) {
            let ray = rays.ray(row);
            let main = main_axis(ray.direction);
            let list = if is_valid(&ray, main) { main } else { 3 };
            sorted.rows[list][sorted.counts[list]] = row as u32;
            sorted.counts[list] += 1;
        }
        sorted
    }

    fn groups(&self, main: usize, lanes: usize) -> impl Iterator<Item = &[u32]> {
        self.rows[main][..self.counts[main]].chunks(lanes)
    }

    fn invalid(&self) -> &[u32] {
        &self.rows[3][..self.counts[3]]
    }
}

/// As many rays as a vector has lanes, with one main axis.
struct Group<F> {
    shear: Shear<F>,
    /// The last `t`.
    end: F,
    /// The number after the last `t`.
    past_end: F,
}

impl<F: Floats> Group<F> {
    #[inline(always)]
    fn load(set: F::Set, rays: &RayBatch, axes: [usize; 3], rows: &[u32]) -> Self {
        let columns = rays.columns();
        let [x, y, z] = axes;
        let permuted = [x, y, z, 3 + x, 3 + y, 3 + z, 6].map(|column| columns[column].as_slice());
        // Lanes without a ray get one that ends where it starts.
        let mut lanes = [
            [0.0; MOST_LANES],
            [0.0; MOST_LANES],
            [0.0; MOST_LANES],
            [0.0; MOST_LANES],
            [0.0; MOST_LANES],
            [1.0; MOST_LANES],
            [0.0; MOST_LANES],
        ];
        let mut past_end = [0.0; MOST_LANES];
        for (lane, &row) in rows.iter().enumerate() {
            for (lanes, column) in lanes.iter_mut().zip(permuted) {
                lanes[lane] = column[row as usize];
            }
            past_end[lane] = lanes[6][lane].min(f32::MAX).next_up();
        }
        let [x, y, z, dx, dy, dz, end] = &lanes;
        Self {
            shear: Shear::new(
                set,
                [F::load(set, x), F::load(set, y), F::load(set, z)],
                [F::load(set, dx), F::load(set, dy), F::load(set, dz)],
            ),
            end: F::load(set, end),
            past_end: F::load(set, &past_end),
        }
    }
}

/// The sheared corners of a triangle.
#[inline(always)]
fn corners<F: Floats>(&[a, b, c]: &[u16; 3], sheared: &[[F; 3]]) -> [[F; 3]; 3] {
    [
        sheared[usize::from(a)],
        sheared[usize::from(b)],
        sheared[usize::from(c)],
    ]
}

/// The closest hits of a group.
struct Best<F> {
    t: F,
    /// Place in the list of triangles, −1 for a miss; a small integer, exact as a float.
    index: F,
    v: F,
    w: F,
    determinant: F,
}

impl<F: Floats> Best<F> {
    #[cold]
    fn offer_exact(&mut self, set: F::Set, index: usize, lanes: u32, corners: [[F; 3]; 3]) {
        let mut columns = [[0.0; MOST_LANES]; 5];
        let [t, place, v, w, determinant] = &mut columns;
        self.t.store(t);
        self.index.store(place);
        self.v.store(v);
        self.w.store(w);
        self.determinant.store(determinant);
        for (lane, crossing) in exact_crossings(lanes, corners) {
            if crossing[0] > 0.0 && crossing[0] < t[lane] {
                [t[lane], v[lane], w[lane]] = crossing;
                place[lane] = index as f32;
                determinant[lane] = 1.0;
            }
        }
        let [t, place, v, w, determinant] = &columns;
        *self = Self {
            t: F::load(set, t),
            index: F::load(set, place),
            v: F::load(set, v),
            w: F::load(set, w),
            determinant: F::load(set, determinant),
        };
    }

    #[inline(always)]
    fn write(self, numbers: &[u32], rows: &[u32], hits: &mut HitBatch) {
        let (mut t, mut index, mut u, mut v) = (
            [0.0; MOST_LANES],
            [0.0; MOST_LANES],
            [0.0; MOST_LANES],
            [0.0; MOST_LANES],
        );
        self.t.store(&mut t);
        self.index.store(&mut index);
        (self.v / self.determinant).store(&mut u);
        (self.w / self.determinant).store(&mut v);
        for (lane, &row) in rows.iter().enumerate() {
            let hit = if index[lane] < 0.0 {
                Hit::NONE
            } else {
                Hit {
                    t: t[lane],
                    u: u[lane],
                    v: v[lane],
                    primitive: numbers[index[lane] as usize],
                }
            };
            hits.set(row as usize, hit);
        }
    }
}

/// The exact test in the lanes of the set bits, where it finds a crossing.
fn exact_crossings<F: Floats>(
    lanes: u32,
    corners: [[F; 3]; 3],
) -> impl Iterator<Item = (usize, [f32; 3])> {
    let corners = corners.map(|corner| {
        corner.map(|vector| {
            let mut column = [0.0; MOST_LANES];
            vector.store(&mut column);
            column
        })
    });
    (0..F::LANES)
        .filter(move |lane| lanes >> lane & 1 == 1)
        .filter_map(move |lane| {
            let [a, b, c] = corners.map(|corner| corner.map(|column| column[lane]));
            Some((lane, exact_intersection(a, b, c)?))
        })
}

#[cold]
fn exact_lanes<F: Floats>(lanes: u32, corners: [[F; 3]; 3], end: F) -> u32 {
    let mut ends = [0.0; MOST_LANES];
    end.store(&mut ends);
    exact_crossings(lanes, corners)
        .filter(|&(lane, [t, ..])| t > 0.0 && t < ends[lane])
        .fold(0, |met, (lane, _)| met | 1 << lane)
}
