//! How much light gets along a segment: surfaces that are not opaque let a part pass undeviated.
//!
//! T = Π ((1 − α) + α τ(θ)) over the surfaces on the segment, with their opacity α and, of a pane, the share τ that goes
//! straight through at the angle of the segment; 0 at the first surface that lets nothing pass. Without such surfaces in the
//! scene it is the kernel's any-hit query; else the segments that it stops are followed from surface to surface.

use steradian_kernel::{HitBatch, InstructionSet, MISS, RayBatch};

use super::interaction::hit;
use super::tables::{Lanes4, Tables};
use crate::spectrum::Wavelengths;

/// What gets along the segments of a batch.
#[derive(Default)]
pub(super) struct Transmittance {
    stopped: Vec<bool>,
    /// T of each segment that was stopped; empty where no surface lets anything pass.
    parts: Vec<Lanes4>,
}

impl Transmittance {
    /// Traces the segments of paths of these wavelengths.
    pub fn trace<'w>(
        &mut self,
        tables: &Tables<'_>,
        rays: &RayBatch,
        wavelengths: impl Fn(usize) -> &'w Wavelengths,
        set: InstructionSet,
    ) {
        tables
            .scene
            .surfaces()
            .occluded(rays, &mut self.stopped, set);
        self.parts.clear();
        if tables.lets_pass {
            self.parts.resize(self.stopped.len(), [0.0; 4]);
            Stepping::new(rays, &self.stopped).follow(tables, &mut self.parts, wavelengths, set);
        }
    }

    /// Which segments meet a surface.
    pub fn stopped(&self) -> &[bool] {
        &self.stopped
    }

    /// Whether nothing gets along a segment.
    #[inline(always)]
    pub fn stops(&self, segment: usize) -> bool {
        self.stopped[segment]
            && self
                .parts
                .get(segment)
                .is_none_or(|lanes| *lanes == [0.0; 4])
    }

    /// T of a segment.
    pub fn of(&self, segment: usize) -> Lanes4 {
        if self.stopped[segment] {
            self.parts.get(segment).copied().unwrap_or_default()
        } else {
            [1.0; 4]
        }
    }
}

/// Segments that are followed from surface to surface.
struct Stepping {
    rays: RayBatch,
    /// Number of the segment, its end (`None`: infinitely far), and T so far.
    open: Vec<(usize, Option<[f32; 3]>, Lanes4)>,
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
            stepping.open.push((i, end, [1.0; 4]));
        }
        stepping
    }

    fn follow<'w>(
        mut self,
        tables: &Tables<'_>,
        out: &mut [Lanes4],
        wavelengths: impl Fn(usize) -> &'w Wavelengths,
        set: InstructionSet,
    ) {
        let mut hits = HitBatch::default();
        while !self.open.is_empty() {
            tables.scene.surfaces().closest(&self.rays, &mut hits, set);
            self = self.step(tables, &hits, out, &wavelengths);
        }
    }

    fn step<'w>(
        self,
        tables: &Tables<'_>,
        hits: &HitBatch,
        out: &mut [Lanes4],
        wavelengths: &impl Fn(usize) -> &'w Wavelengths,
    ) -> Self {
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
            if !side.lets_pass() {
                continue;
            }
            let passes = tables.passing(side, &hit, wavelengths(segment));
            if passes != [0.0; 4] {
                let origin = hit.place.beyond();
                let rays = &self.rays;
                let old = [
                    rays.direction_x[i],
                    rays.direction_y[i],
                    rays.direction_z[i],
                ];
                let span = end.map_or(old, |end| std::array::from_fn(|k| end[k] - origin[k]));
                next.rays.push(origin, span, rays.t_max[i]);
                let part = std::array::from_fn(|lane| before[lane] * passes[lane]);
                next.open.push((segment, end, part));
            }
        }
        next
    }
}
