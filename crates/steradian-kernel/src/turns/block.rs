//! Consecutive rays prepared side by side.

use crate::batch::RayBatch;
use crate::node::Bounds;
use crate::prepared_ray::{PreparedRay, SlabNumbers, axes_of};
use crate::side_by_side::{Column, MOST_LANES, SideBySide};
use crate::simd::{Floats, Mask};
use crate::triangle::Shear;

/// What rays become, in columns.
pub(super) struct Block {
    valid: u32,
    main_axis: [usize; MOST_LANES],
    slabs: [[Column; 3]; 3],
    shear: [[Column; 3]; 2],
    t_max: Column,
}

impl Block {
    pub(super) const EMPTY: Self = Self {
        valid: 0,
        main_axis: [0; MOST_LANES],
        slabs: [[[0.0; MOST_LANES]; 3]; 3],
        shear: [[[0.0; MOST_LANES]; 3]; 2],
        t_max: [0.0; MOST_LANES],
    };

    /// Takes the rays from this row on, as many as a vector has lanes or, at the end of the batch, fewer.
    #[inline(always)]
    pub(super) fn load<F: Floats>(
        &mut self,
        set: F::Set,
        rays: &RayBatch,
        start: usize,
        bounds: &Bounds,
    ) {
        let count = F::LANES.min(rays.len() - start);
        let SideBySide {
            valid,
            origin,
            direction,
            lengths,
            axes,
            t_max,
        } = SideBySide::<F>::load(set, rays, start, count);
        self.valid = valid.bits();
        for (lane, axis) in self.main_axis[..F::LANES].iter_mut().enumerate() {
            *axis = axes.number(lane);
        }
        let longest = axes.main(lengths);
        let slabs = SlabNumbers::new(set, origin, direction, longest, bounds);
        let shear = Shear::new(set, axes.permute(origin), axes.permute(direction));
        for k in 0..3 {
            slabs.near_origin[k].store(&mut self.slabs[0][k]);
            slabs.far_origin[k].store(&mut self.slabs[1][k]);
            slabs.reciprocal[k].store(&mut self.slabs[2][k]);
            shear.origin[k].store(&mut self.shear[0][k]);
            shear.slope[k].store(&mut self.shear[1][k]);
        }
        t_max
            .minimum(F::splat(set, f32::MAX))
            .store(&mut self.t_max);
    }

    /// Nothing if the ray is not valid.
    #[inline(always)]
    pub(super) fn ray(&self, lane: usize) -> Option<(PreparedRay, SlabNumbers<f32>)> {
        let lane = lane % MOST_LANES;
        if self.valid >> lane & 1 == 0 {
            return None;
        }
        let [near_origin, far_origin, reciprocal] = &self.slabs;
        let [origin, slope] = &self.shear;
        let prepared = PreparedRay {
            axes: axes_of(self.main_axis[lane]),
            shear: Shear {
                origin: row(origin, lane),
                slope: row(slope, lane),
            },
            t_max: self.t_max[lane],
        };
        let slabs = SlabNumbers {
            near_origin: row(near_origin, lane),
            far_origin: row(far_origin, lane),
            reciprocal: row(reciprocal, lane),
        };
        Some((prepared, slabs))
    }
}

#[inline(always)]
fn row([x, y, z]: &[Column; 3], lane: usize) -> [f32; 3] {
    [x[lane], y[lane], z[lane]]
}
