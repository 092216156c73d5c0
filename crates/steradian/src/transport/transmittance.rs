//! How much light gets along a segment: surfaces that are not opaque let a part pass undeviated.
//!
//! T = Π (1 − α) over the surfaces on the segment, 0 at the first opaque one. Without such surfaces in the scene it is
//! the kernel's any-hit query; else the segments that it stops are followed from surface to surface.

use steradian_kernel::{HitBatch, InstructionSet, MISS, RayBatch};

use super::interaction::hit;
use super::tables::Tables;

/// What gets along the segments of a batch.
#[derive(Default)]
pub(super) struct Transmittance {
    stopped: Vec<bool>,
    /// T of each segment; empty where every surface is opaque.
    parts: Vec<f32>,
}

impl Transmittance {
    /// Traces the segments.
    pub fn trace(&mut self, tables: &Tables<'_>, rays: &RayBatch, set: InstructionSet) {
        tables
            .scene
            .surfaces()
            .occluded(rays, &mut self.stopped, set);
        self.parts.clear();
        if !tables.opacities.is_empty() {
            self.parts.resize(self.stopped.len(), 0.0);
            Stepping::new(rays, &self.stopped).follow(tables, &mut self.parts, set);
        }
    }

    /// T of a segment.
    #[inline(always)]
    pub fn of(&self, segment: usize) -> f32 {
        if self.stopped[segment] {
            self.parts.get(segment).copied().unwrap_or(0.0)
        } else {
            1.0
        }
    }
}

/// Segments that are followed from surface to surface.
struct Stepping {
    rays: RayBatch,
    /// Number of the segment, its end (`None`: infinitely far), and T so far.
    open: Vec<(usize, Option<[f32; 3]>, f32)>,
}

impl Stepping {
    fn new(rays: &RayBatch, occluded: &[bool]) -> Self {
        let mut stepping = Self {
            rays: RayBatch::default(),
            open: vec![],
        };
        for (i, _) in occluded.iter().enumerate().filter(|(_, stopped)| **stopped) {
            let origin = [rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]];
            let span = [
                rays.direction_x[i],
                rays.direction_y[i],
                rays.direction_z[i],
            ];
            let end = (rays.t_max[i] == 1.0).then(|| std::array::from_fn(|k| origin[k] + span[k]));
            stepping.rays.push(origin, span, rays.t_max[i]);
            stepping.open.push((i, end, 1.0));
        }
        stepping
    }

    fn follow(mut self, tables: &Tables<'_>, out: &mut [f32], set: InstructionSet) {
        let mut hits = HitBatch::default();
        while !self.open.is_empty() {
            tables.scene.surfaces().closest(&self.rays, &mut hits, set);
            self = self.step(tables, &hits, out);
        }
    }

    fn step(self, tables: &Tables<'_>, hits: &HitBatch, out: &mut [f32]) -> Self {
        let mut next = Self {
            rays: RayBatch::default(),
            open: vec![],
        };
        for (i, &(segment, end, before)) in self.open.iter().enumerate() {
            if hits.primitive[i] == MISS {
                out[segment] = before;
                continue;
            }
            let hit = hit(tables, &self.rays, hits, i);
            let side = &tables.sides[hit.side as usize];
            let passes = 1.0 - tables.opacity(side, || tables.site(&hit)).unwrap_or(1.0);
            if passes > 0.0 {
                let origin = hit.place.beyond();
                let rays = &self.rays;
                let old = [
                    rays.direction_x[i],
                    rays.direction_y[i],
                    rays.direction_z[i],
                ];
                let span = end.map_or(old, |end| std::array::from_fn(|k| end[k] - origin[k]));
                next.rays.push(origin, span, rays.t_max[i]);
                next.open.push((segment, end, before * passes));
            }
        }
        next
    }
}
