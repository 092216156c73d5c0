//! As many consecutive rays as a vector has lanes, in columns.

use crate::batch::RayBatch;
use crate::geometry::COORDINATE_LIMIT;
use crate::prepared_ray::DIRECTION_RANGE;
use crate::simd::{Floats, Mask};

/// Lanes of the widest vector.
pub(crate) const MOST_LANES: usize = 16;

/// A number for every ray.
pub(crate) type Column = [f32; MOST_LANES];

/// Rays as they come.
pub(crate) struct SideBySide<F: Floats> {
    /// As [`Ray`](crate::Ray) tells.
    pub(crate) valid: F::Mask,
    pub(crate) origin: [F; 3],
    pub(crate) direction: [F; 3],
    /// Absolute components of the directions.
    pub(crate) lengths: [F; 3],
    pub(crate) axes: Axes<F::Mask>,
    pub(crate) t_max: F,
}

impl<F: Floats> SideBySide<F> {
    /// Rays `start .. start + count`; the other lanes hold invalid ones.
    #[inline(always)]
    pub(crate) fn load(set: F::Set, rays: &RayBatch, start: usize, count: usize) -> Self {
        let origin = [
            load(set, &rays.origin_x, start, count),
            load(set, &rays.origin_y, start, count),
            load(set, &rays.origin_z, start, count),
        ];
        let direction: [F; 3] = [
            load(set, &rays.direction_x, start, count),
            load(set, &rays.direction_y, start, count),
            load(set, &rays.direction_z, start, count),
        ];
        let t_max = load(set, &rays.t_max, start, count);
        let lengths = [
            direction[0].absolute(set),
            direction[1].absolute(set),
            direction[2].absolute(set),
        ];
        Self {
            valid: are_valid(set, origin, lengths, t_max),
            origin,
            direction,
            lengths,
            axes: Axes::of(lengths),
            t_max,
        }
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

/// [`Ray`](crate::Ray) says what is valid; all comparisons fail on NaN.
#[inline(always)]
fn are_valid<F: Floats>(set: F::Set, [x, y, z]: [F; 3], lengths: [F; 3], t_max: F) -> F::Mask {
    let limit = F::splat(set, COORDINATE_LIMIT);
    let near = x.absolute(set).less_equal(limit)
        & y.absolute(set).less_equal(limit)
        & z.absolute(set).less_equal(limit);
    let longest = F::splat(set, *DIRECTION_RANGE.end());
    let [a, b, c] = lengths;
    let not_long = a.less_equal(longest) & b.less_equal(longest) & c.less_equal(longest);
    let not_short = F::splat(set, *DIRECTION_RANGE.start()).less_equal(a.maximum(b).maximum(c));
    near & not_long & not_short & t_max.less_equal(F::splat(set, f32::INFINITY))
}

/// Which axis is the main one, lane by lane.
#[derive(Copy, Clone)]
pub(crate) struct Axes<M> {
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

    /// The main component.
    #[inline(always)]
    pub(crate) fn main<F: Floats<Mask = M>>(&self, [x, y, z]: [F; 3]) -> F {
        F::select(self.is_x, x, F::select(self.is_y, y, z))
    }

    /// The number of the main axis in one lane.
    #[inline(always)]
    pub(crate) fn number(&self, lane: usize) -> usize {
        let (is_x, is_y) = (self.is_x.bits() >> lane & 1, self.is_y.bits() >> lane & 1);
        ((1 - is_x) * (2 - is_y)) as usize
    }

    /// Components in the order of the shear, the main one last.
    #[inline(always)]
    pub(crate) fn permute<F: Floats<Mask = M>>(&self, [x, y, z]: [F; 3]) -> [F; 3] {
        [
            F::select(self.is_x, y, F::select(self.is_y, z, x)),
            F::select(self.is_x, z, F::select(self.is_y, x, y)),
            self.main([x, y, z]),
        ]
    }
}
