//! The intervals in which the numbers of a packet's rays lie, and what can be told from them alone.
//!
//! With `o` and `r` anywhere in their intervals and `r` of one sign, `(p − o)·r` is least for one end of `o`, told by the sign of `r`, and
//! one end of `r`. Likewise the sheared coordinate `(p_x − o_x) − s·(p_z − o_z)`: no ray meets a triangle whose vertices are all
//! sheared to the same side of it.

use super::bundle::Bundle;
use crate::node::{Bounds, Leaf, Node};
use crate::prepared_ray::{FLATTEST, permute, reach, shift};
use crate::side_by_side::{Column, MOST_LANES};
use crate::simd::{Floats, Scalar};
use crate::triangle::splat;

/// The widest interval of origins, in units of the scene's largest extent.
const WIDEST_ORIGIN: f32 = 1.0 / 64.0;

/// Around all rays of a packet, copied to the lanes of vectors of boxes or triangles. Pairs are the ends of intervals.
pub(super) struct Beam<F> {
    near_origin: [F; 3],
    far_origin: [F; 3],
    reciprocal: [[F; 3]; 2],
    near_side: [usize; 3],
    axes: [usize; 3],
    /// In the order of the shear, as is the slope.
    origin: [[F; 3]; 2],
    slope: [[F; 2]; 2],
}

impl<F: Floats> Beam<F> {
    /// Nothing if the rays are too far apart, or their slopes by more than `widest`.
    #[inline(always)]
    pub(super) fn around<R: Floats<Set = F::Set>>(
        set: F::Set,
        bundle: &Bundle<R>,
        bounds: &Bounds,
        widest: f32,
    ) -> Option<Self> {
        let slope_x = ends(bundle.shear.slope[0]);
        let slope_y = ends(bundle.shear.slope[1]);
        let origin = ends_of_all(bundle.origin);
        let narrow = slope_x[1] - slope_x[0] <= widest
            && slope_y[1] - slope_y[0] <= widest
            && starts_together(origin, bounds);
        if !narrow {
            return None;
        }
        let slabs = BeamSlabs::new(origin, bundle, bounds);
        let [lower, upper] = origin;
        Some(Self {
            near_origin: splat(set, slabs.near_origin),
            far_origin: splat(set, slabs.far_origin),
            reciprocal: [
                splat(set, slabs.reciprocal[0]),
                splat(set, slabs.reciprocal[1]),
            ],
            near_side: bundle.is_negative.map(usize::from),
            axes: bundle.axes,
            origin: [
                splat(set, permute(lower, bundle.axes)),
                splat(set, permute(upper, bundle.axes)),
            ],
            slope: [
                [F::splat(set, slope_x[0]), F::splat(set, slope_x[1])],
                [F::splat(set, slope_y[0]), F::splat(set, slope_y[1])],
            ],
        })
    }

    /// Where the first ray may enter each child's box, and the children whose box a ray may meet before or at `furthest`.
    #[inline(always)]
    pub(super) fn test(&self, set: F::Set, node: &Node, furthest: F) -> (F, F::Mask) {
        let near = self.near(set, node, 0).maximum(self.near(set, node, 1));
        let entry = near.maximum(self.near(set, node, 2).maximum(F::splat(set, 0.0)));
        let far = self.far(set, node, 0).minimum(self.far(set, node, 1));
        let exit = far.minimum(self.far(set, node, 2).minimum(furthest));
        (entry, entry.less_equal(exit))
    }

    #[inline(always)]
    fn near(&self, set: F::Set, node: &Node, axis: usize) -> F {
        let planes = F::load(set, &node.planes[axis][self.near_side[axis] & 1]);
        let distance = planes - self.near_origin[axis];
        let [r, s] = &self.reciprocal;
        (distance * r[axis]).minimum(distance * s[axis])
    }

    #[inline(always)]
    fn far(&self, set: F::Set, node: &Node, axis: usize) -> F {
        let planes = F::load(set, &node.planes[axis][self.near_side[axis] & 1 ^ 1]);
        let distance = planes - self.far_origin[axis];
        let [r, s] = &self.reciprocal;
        (distance * r[axis]).maximum(distance * s[axis])
    }

    /// The triangles of a leaf that a ray may meet; never an unused lane, whose NaN no comparison accepts.
    #[inline(always)]
    pub(super) fn may_meet(&self, set: F::Set, leaf: &Leaf) -> F::Mask {
        let zero = F::splat(set, 0.0);
        let [[x, y], [x_end, y_end]] = self.sheared(set, leaf, 0);
        let (mut lower, mut upper) = ([x, y], [x_end, y_end]);
        for vertex in 1..3 {
            let [[x, y], [x_end, y_end]] = self.sheared(set, leaf, vertex);
            lower = [lower[0].minimum(x), lower[1].minimum(y)];
            upper = [upper[0].maximum(x_end), upper[1].maximum(y_end)];
        }
        lower[0].less_equal(zero)
            & lower[1].less_equal(zero)
            & zero.less_equal(upper[0])
            & zero.less_equal(upper[1])
    }

    /// The ends of both coordinates across the rays of one vertex of all triangles.
    #[inline(always)]
    fn sheared(&self, set: F::Set, leaf: &Leaf, vertex: usize) -> [[F; 2]; 2] {
        let corner = &leaf.corners[vertex];
        let [lower, upper] = &self.origin;
        let z = F::load(set, &corner[self.axes[2]]);
        let z = [z - upper[2], z - lower[2]];
        let [left, right] = product(self.slope[0], z);
        let [down, up] = product(self.slope[1], z);
        let x = F::load(set, &corner[self.axes[0]]);
        let y = F::load(set, &corner[self.axes[1]]);
        [
            [x - upper[0] - right, y - upper[1] - up],
            [x - lower[0] - left, y - lower[1] - down],
        ]
    }
}

/// The interval of the products of numbers from two intervals.
#[inline(always)]
fn product<F: Floats>([a, b]: [F; 2], [c, d]: [F; 2]) -> [F; 2] {
    let (p, q, r, s) = (a * c, a * d, b * c, b * d);
    [
        p.minimum(q).minimum(r.minimum(s)),
        p.maximum(q).maximum(r.maximum(s)),
    ]
}

/// What the box test needs, before it is copied to all lanes: the least or greatest of what the rays would have on their own.
struct BeamSlabs {
    near_origin: [f32; 3],
    far_origin: [f32; 3],
    reciprocal: [[f32; 3]; 2],
}

impl BeamSlabs {
    #[inline(always)]
    fn new<R: Floats>([lower, upper]: [[f32; 3]; 2], bundle: &Bundle<R>, bounds: &Bounds) -> Self {
        let reach = reach(Scalar, bounds, lower).max(reach(Scalar, bounds, upper));
        let [shortest, longest] = ends_of_all(bundle.lengths);
        let main = bundle.axes[2];
        let flattest = [longest[main] * FLATTEST, shortest[main] * FLATTEST];
        let mut slabs = Self {
            near_origin: [0.0; 3],
            far_origin: [0.0; 3],
            reciprocal: [[0.0; 3]; 2],
        };
        for k in 0..3 {
            let shift = shift(Scalar, reach, lower[k].abs().max(upper[k].abs()));
            let (behind, ahead) = (lower[k] - shift, upper[k] + shift);
            let (sign, [far, near]) = if bundle.is_negative[k] {
                (-1.0, [ahead, behind])
            } else {
                (1.0, [behind, ahead])
            };
            slabs.near_origin[k] = near;
            slabs.far_origin[k] = far;
            slabs.reciprocal[0][k] = sign / longest[k].max(flattest[0]);
            slabs.reciprocal[1][k] = sign / shortest[k].max(flattest[1]);
        }
        slabs
    }
}

#[inline(always)]
fn starts_together([lower, upper]: [[f32; 3]; 2], bounds: &Bounds) -> bool {
    let extent = |lower: [f32; 3], upper: [f32; 3]| {
        (upper[0] - lower[0])
            .max(upper[1] - lower[1])
            .max(upper[2] - lower[2])
    };
    extent(lower, upper) <= WIDEST_ORIGIN * extent(bounds.lower, bounds.upper)
}

#[inline(always)]
fn ends_of_all<F: Floats>([x, y, z]: [F; 3]) -> [[f32; 3]; 2] {
    let (x, y, z) = (ends(x), ends(y), ends(z));
    [[x[0], y[0], z[0]], [x[1], y[1], z[1]]]
}

/// The smallest and the largest lane.
#[inline(always)]
fn ends<F: Floats>(vector: F) -> [f32; 2] {
    let mut lower = [0.0; MOST_LANES];
    vector.store(&mut lower);
    [smallest::<F>(lower), largest::<F>(lower)]
}

#[inline(always)]
fn smallest<F: Floats>(column: Column) -> f32 {
    folded::<F>(column, Floats::minimum)
}

/// The largest lane of those that vectors of this kind have.
#[inline(always)]
pub(super) fn largest<F: Floats>(column: Column) -> f32 {
    folded::<F>(column, Floats::maximum)
}

/// One lane of all that vectors of this kind have.
#[inline(always)]
fn folded<F: Floats>(mut column: Column, pick: impl Fn(f32, f32) -> f32) -> f32 {
    let mut half = F::LANES / 2;
    while half > 0 {
        for lane in 0..half {
            column[lane] = pick(column[lane], column[lane + half]);
        }
        half /= 2;
    }
    column[0]
}
