//! How much light gets along a segment: surfaces that are not opaque let a part pass undeviated.
//!
//! T = Π ((1 − α) + α τ(θ)) over the surfaces on the segment, with their opacity α and, of a pane, the share τ that goes
//! straight through at the angle of the segment; 0 at the first surface that lets nothing pass. Without such surfaces in the
//! scene it is the kernel's any-hit query; else the segments that it stops are followed from surface to surface.

use steradian_kernel::{HitBatch, InstructionSet, MISS, Ray, RayBatch};

use super::interaction::hit;
use super::tables::{Lanes4, Tables};
use crate::spectrum::Wavelengths;

/// What gets along the segments of a batch.
#[derive(Default)]
pub(super) struct Transmittance {
    stopped: Vec<bool>,
    /// T of each segment that was stopped; empty where no surface lets anything pass.
    parts: Vec<Lanes4>,
    stepping: Stepping,
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
            self.stepping.begin(rays, &self.stopped);
            self.stepping
                .follow(tables, &mut self.parts, wavelengths, set);
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
#[derive(Default)]
struct Stepping {
    open: Segments,
    /// Those that go on behind a surface.
    beyond: Segments,
    hits: HitBatch,
}

#[derive(Default)]
struct Segments {
    rays: RayBatch,
    all: Vec<Segment>,
}

#[derive(Copy, Clone)]
struct Segment {
    number: usize,
    /// Infinitely far if there is none.
    end: Option<[f32; 3]>,
    /// T so far.
    part: Lanes4,
}

impl Segments {
    fn clear(&mut self) {
        self.rays.clear();
        self.all.clear();
    }

    fn push(&mut self, (origin, span, t_max): ([f32; 3], [f32; 3], f32), segment: Segment) {
        self.rays.push(origin, span, t_max);
        self.all.push(segment);
    }
}

impl Stepping {
    fn begin(&mut self, rays: &RayBatch, occluded: &[bool]) {
        self.open.clear();
        for (number, _) in occluded.iter().enumerate().filter(|(_, stopped)| **stopped) {
            let Ray {
                origin,
                direction,
                t_max,
            } = rays.ray(number);
            let end = std::array::from_fn(|axis| origin[axis] + direction[axis]);
            let segment = Segment {
                number,
                end: (t_max == 1.0).then_some(end),
                part: [1.0; 4],
            };
            self.open.push((origin, direction, t_max), segment);
        }
    }

    fn follow<'w>(
        &mut self,
        tables: &Tables<'_>,
        out: &mut [Lanes4],
        wavelengths: impl Fn(usize) -> &'w Wavelengths,
        set: InstructionSet,
    ) {
        let surfaces = tables.scene.surfaces();
        while !self.open.all.is_empty() {
            surfaces.closest(&self.open.rays, &mut self.hits, set);
            self.step(tables, out, &wavelengths);
            std::mem::swap(&mut self.open, &mut self.beyond);
        }
    }

    fn step<'w>(
        &mut self,
        tables: &Tables<'_>,
        out: &mut [Lanes4],
        wavelengths: &impl Fn(usize) -> &'w Wavelengths,
    ) {
        self.beyond.clear();
        for (i, segment) in self.open.all.iter().enumerate() {
            if self.hits.primitive[i] == MISS {
                out[segment.number] = segment.part;
                continue;
            }
            let hit = hit(tables, &self.open.rays, &self.hits, i);
            let side = &tables.sides[hit.side as usize];
            if !side.lets_pass() {
                continue;
            }
            let passes = tables.passing(side, &hit, wavelengths(segment.number));
            if passes != [0.0; 4] {
                let origin = hit.place.beyond();
                let Ray {
                    direction, t_max, ..
                } = self.open.rays.ray(i);
                let to = |end: [f32; 3]| std::array::from_fn(|axis| end[axis] - origin[axis]);
                let span = segment.end.map_or(direction, to);
                let part = std::array::from_fn(|lane| segment.part[lane] * passes[lane]);
                self.beyond
                    .push((origin, span, t_max), Segment { part, ..*segment });
            }
        }
    }
}
