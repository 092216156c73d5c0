//! As many rays as a vector has lanes, ready to be tested.

use super::MOST_LANES;
use crate::batch::RayBatch;
use crate::geometry::COORDINATE_LIMIT;
use crate::node::Bounds;
use crate::prepared_ray::DIRECTION_RANGE;
use crate::simd::{Floats, Mask};
use crate::triangle::Shear;

/// 2⁻²¹, against the 2⁻²² that the end of a ray may be off in units of the greatest coordinate.
const END_ROUNDING: f32 = 1.0 / (1 << 21) as f32;

/// As many rays as a vector has lanes.
pub(super) struct Group<F: Floats> {
    valid: F::Mask,
    origin: [F; 3],
    direction: [F; 3],
    pub(super) axes: Axes<F::Mask>,
    /// Not a number in the lanes of invalid rays, which no test accepts.
    pub(super) shear: Shear<F>,
    pub(super) t_max: F,
}

impl<F: Floats> Group<F> {
    /// Rays `start .. start + count`; the other lanes hold invalid ones.
    #[inline(always)]
    pub(super) fn load(set: F::Set, rays: &RayBatch, start: usize, count: usize) -> Self {
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
    pub(super) fn stays_within(&self, set: F::Set, bounds: &Bounds) -> bool {
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
pub(super) struct Axes<M> {
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
    pub(super) fn permute<F: Floats<Mask = M>>(&self, [x, y, z]: [F; 3]) -> [F; 3] {
        [
            F::select(self.is_x, y, F::select(self.is_y, z, x)),
            F::select(self.is_x, z, F::select(self.is_y, x, y)),
            F::select(self.is_x, x, F::select(self.is_y, y, z)),
        ]
    }
}
