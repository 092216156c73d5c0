//! As many rays as a vector has lanes, ready to be tested.

use crate::batch::RayBatch;
use crate::node::Bounds;
use crate::side_by_side::{Axes, SideBySide};
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
        let SideBySide {
            valid,
            origin,
            direction,
            axes,
            t_max,
            ..
        } = SideBySide::<F>::load(set, rays, start, count);
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
