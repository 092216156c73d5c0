//! The closest hits of a packet so far.

use crate::batch::{Hit, MISS};
use crate::side_by_side::{Column, MOST_LANES};
use crate::simd::{Floats, Mask};
use crate::traversal::Closest;
use crate::triangle::Intersection;

/// In columns; before a ray's first hit its `t` is the ray's last.
pub(super) struct Best {
    pub(super) t: Column,
    u: Column,
    v: Column,
    primitive: [u32; MOST_LANES],
    /// The largest `t`.
    pub(super) furthest: f32,
}

impl Best {
    #[inline(always)]
    pub(super) fn up_to<F: Floats>(t_max: F) -> Self {
        let mut best = Self {
            t: [0.0; MOST_LANES],
            u: [0.0; MOST_LANES],
            v: [0.0; MOST_LANES],
            primitive: [MISS; MOST_LANES],
            furthest: 0.0,
        };
        t_max.store(&mut best.t);
        best.look_for_furthest::<F>();
        best
    }

    /// Lets rays that have a hit take no other.
    #[inline(always)]
    pub(super) fn retire(&mut self) {
        for (t, primitive) in self.t.iter_mut().zip(self.primitive) {
            *t = if primitive == MISS { *t } else { 0.0 };
        }
    }

    #[inline(always)]
    pub(super) fn look_for_furthest<F: Floats>(&mut self) {
        self.furthest = super::beam::largest::<F>(self.t);
    }

    /// A triangle's crossings with the rays of a mask. Whether any was better.
    #[inline(always)]
    pub(super) fn offer_all<F: Floats>(
        &mut self,
        set: F::Set,
        primitive: u32,
        rays: F::Mask,
        crossing: &Intersection<F>,
    ) -> bool {
        let last = F::load(set, &self.t);
        let rays = rays & F::splat(set, 0.0).less(crossing.t) & crossing.t.less_equal(last);
        if rays.bits() == 0 {
            return false;
        }
        let nearer = rays & crossing.t.less(last);
        let [u, v] = [
            crossing.v / crossing.determinant,
            crossing.w / crossing.determinant,
        ];
        let ties = rays.without(nearer).bits();
        if ties != 0 {
            self.offer_lanes(primitive, ties, [crossing.t, u, v]);
        }
        replace(set, &mut self.t, nearer, crossing.t);
        replace(set, &mut self.u, nearer, u);
        replace(set, &mut self.v, nearer, v);
        let mut lanes = nearer.bits();
        while lanes != 0 {
            self.primitive[lanes.trailing_zeros() as usize % MOST_LANES] = primitive;
            lanes &= lanes - 1;
        }
        true
    }

    #[inline(always)]
    fn offer_lanes<F: Floats>(&mut self, primitive: u32, lanes: u32, crossing: [F; 3]) {
        let [mut t, mut u, mut v] = [[0.0; MOST_LANES]; 3];
        crossing[0].store(&mut t);
        crossing[1].store(&mut u);
        crossing[2].store(&mut v);
        for lane in (0..F::LANES).filter(|&lane| lanes >> lane & 1 == 1) {
            self.offer(lane, primitive, [t[lane], u[lane], v[lane]]);
        }
    }

    /// A crossing with one ray.
    pub(super) fn offer(&mut self, lane: usize, primitive: u32, crossing: [f32; 3]) {
        let mut closest = Closest(self.row(lane));
        closest.offer(primitive, crossing);
        let Hit { t, u, v, primitive } = closest.0;
        (self.t[lane], self.u[lane], self.v[lane]) = (t, u, v);
        self.primitive[lane] = primitive;
    }

    fn row(&self, lane: usize) -> Hit {
        Hit {
            t: self.t[lane],
            u: self.u[lane],
            v: self.v[lane],
            primitive: self.primitive[lane],
        }
    }

    #[inline(always)]
    pub(super) fn hit(&self, lane: usize) -> Hit {
        Closest(self.row(lane)).into_hit()
    }
}

#[inline(always)]
fn replace<F: Floats>(set: F::Set, column: &mut Column, rays: F::Mask, values: F) {
    let old = F::load(set, column);
    F::select(rays, values, old).store(column);
}
