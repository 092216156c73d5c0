//! Rays side by side that share the main axis and the signs of their directions.

use crate::batch::RayBatch;
use crate::geometry::COORDINATE_LIMIT;
use crate::prepared_ray::{DIRECTION_RANGE, axes_of, main_axis};
use crate::simd::{Floats, Mask};
use crate::triangle::Shear;

/// As many valid rays as a vector has lanes.
pub(super) struct Bundle<F> {
    /// As of a [`PreparedRay`](crate::prepared_ray::PreparedRay).
    pub(super) axes: [usize; 3],
    pub(super) origin: [F; 3],
    /// Absolute components of the directions.
    pub(super) lengths: [F; 3],
    pub(super) is_negative: [bool; 3],
    pub(super) shear: Shear<F>,
    /// Finite.
    pub(super) t_max: F,
}

impl<F: Floats> Bundle<F> {
    /// The rays from this row on, if there are enough, all valid and alike in the way told above. The directions of the first and the last
    /// may differ by `widest`, in units of the larger one's main component.
    #[inline(always)]
    pub(super) fn load(set: F::Set, rays: &RayBatch, start: usize, widest: f32) -> Option<Self> {
        let end = start + F::LANES;
        if end > rays.len() || !ends_are_alike(rays, start, end - 1, widest) {
            return None;
        }
        let main = main_axis(rays.ray(start).direction);
        let origin = [
            F::load(set, &rays.origin_x[start..]),
            F::load(set, &rays.origin_y[start..]),
            F::load(set, &rays.origin_z[start..]),
        ];
        let direction = [
            F::load(set, &rays.direction_x[start..]),
            F::load(set, &rays.direction_y[start..]),
            F::load(set, &rays.direction_z[start..]),
        ];
        let lengths = [
            direction[0].absolute(set),
            direction[1].absolute(set),
            direction[2].absolute(set),
        ];
        let t_max = F::load(set, &rays.t_max[start..]);
        let is_negative = common_signs::<F>(rays, start)?;
        if !are_valid(set, origin, lengths[main], t_max) || !is_main(lengths, main) {
            return None;
        }
        let axes = axes_of(main);
        let [x, y, z] = axes;
        let start = [origin[x], origin[y], origin[z]];
        Some(Self {
            axes,
            origin,
            lengths,
            is_negative,
            shear: Shear::new(set, start, [direction[x], direction[y], direction[z]]),
            t_max: t_max.minimum(F::splat(set, f32::MAX)),
        })
    }
}

/// A quick look at the first and the last ray.
#[inline(always)]
fn ends_are_alike(rays: &RayBatch, first: usize, last: usize, widest: f32) -> bool {
    let [d, e] = [rays.ray(first).direction, rays.ray(last).direction];
    let largest = d[0].abs().max(d[1].abs()).max(d[2].abs());
    let most = widest * largest;
    ((d[0] - e[0]).abs() <= most) & ((d[1] - e[1]).abs() <= most) & ((d[2] - e[2]).abs() <= most)
}

/// Which components are negative, −0 included, if that is the same for all rays.
#[inline(always)]
fn common_signs<F: Floats>(rays: &RayBatch, start: usize) -> Option<[bool; 3]> {
    let x = common_sign::<F>(&rays.direction_x[start..])?;
    let y = common_sign::<F>(&rays.direction_y[start..])?;
    let z = common_sign::<F>(&rays.direction_z[start..])?;
    Some([x, y, z])
}

#[inline(always)]
fn common_sign<F: Floats>(column: &[f32]) -> Option<bool> {
    let first = column[0].to_bits();
    let mut differences = 0;
    for value in &column[..F::LANES] {
        differences |= value.to_bits() ^ first;
    }
    (differences >> 31 == 0).then_some(first >> 31 == 1)
}

/// [`Ray`](crate::Ray) says what is valid; all comparisons fail on NaN. `length` is the main component's.
#[inline(always)]
fn are_valid<F: Floats>(set: F::Set, [x, y, z]: [F; 3], length: F, t_max: F) -> bool {
    let limit = F::splat(set, COORDINATE_LIMIT);
    let near = x.absolute(set).less_equal(limit)
        & y.absolute(set).less_equal(limit)
        & z.absolute(set).less_equal(limit);
    let fits = length.less_equal(F::splat(set, *DIRECTION_RANGE.end()))
        & F::splat(set, *DIRECTION_RANGE.start()).less_equal(length);
    is_full::<F>(near & fits & t_max.less_equal(F::splat(set, f32::INFINITY)))
}

/// Whether this axis is the main one of all rays: the first of the longest.
#[inline(always)]
fn is_main<F: Floats>([x, y, z]: [F; 3], main: usize) -> bool {
    is_full::<F>(match main {
        0 => y.less_equal(x) & z.less_equal(x),
        1 => x.less(y) & z.less_equal(y),
        _ => x.less(z) & y.less(z),
    })
}

#[inline(always)]
fn is_full<F: Floats>(mask: F::Mask) -> bool {
    mask.bits() == u32::MAX >> (32 - F::LANES)
}
