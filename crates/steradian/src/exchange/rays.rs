//! A whole row from rays: where cosine-distributed rays from uniform points of a surface end.
//!
//! With N rays of a replicate, of which nⱼ meet surface j first,
//!
//! F_ij ≈ nⱼ / N
//!
//! All entries of a row come from the same rays, so in a closed enclosure they add up to 1 exactly. Every sample is 0 or 1, so
//! no weight is above 1. The variance of a replicate is about F(1 − F)/N, that of independent rays, or less.
//!
//! Replicates that agree by chance, or because all rays meet j, do not make a factor exact: no standard error is below 1/(N + 2), N of
//! all replicates. A surface that no ray meets gets no entry. Its factor is then, with 95 % confidence, below 3/N.
//!
//! Points are pulled from the edges of a polygon towards its middle by twice the rounding of the kernel's coordinates, so that none comes to
//! lie in or beyond a surface that meets it there.
//!
//! Source: T. Walker, S.-C. Xue & G. W. Barton, *Numerical determination of radiative view factors using ray tracing*, ASME J. Heat
//! Transfer 132 (7), 2010.

use steradian_kernel::{HitBatch, InstructionSet, MISS, RayBatch};

use super::element::Element;
use super::facets::{Facet, Facets, cosine_direction};
use super::row::{Entry, Rest};
use super::uncertain::Uncertain;
use crate::geometry::{Direction, Point, Vector};
use crate::sampling::block;
use crate::sampling::hash::combine;

/// Rays traced together.
const BATCH: u32 = 1024;

/// Columns in front of those of the surfaces: the sum of those, and the three of [`Rest`].
const FIRST: usize = 4;
const LISTED: usize = 0;
const SKY: usize = 1;
const BELOW: usize = 2;
const OTHER: usize = 3;

/// What a thread needs to trace rays.
pub(super) struct RayWorkspace {
    rays: RayBatch,
    hits: HitBatch,
    directions: Vec<Vector>,
    now: Vec<u32>,
    touched: Vec<u32>,
    sums: Vec<[f64; 2]>,
    seen: Vec<u32>,
}

impl RayWorkspace {
    pub fn new(columns: usize) -> Self {
        Self {
            rays: RayBatch::default(),
            hits: HitBatch::default(),
            directions: Vec::new(),
            now: vec![0; columns + FIRST],
            touched: Vec::new(),
            sums: vec![[0.0; 2]; columns + FIRST],
            seen: Vec::new(),
        }
    }

    fn count(&mut self, column: usize) {
        if self.now[column] == 0 {
            self.touched.push(column as u32);
        }
        self.now[column] += 1;
    }

    /// Closes a replicate of `samples` rays.
    fn close(&mut self, scale: f64) {
        for &column in &self.touched {
            let mean = f64::from(std::mem::take(&mut self.now[column as usize])) * scale;
            let sums = &mut self.sums[column as usize];
            if sums[0] == 0.0 {
                self.seen.push(column);
            }
            *sums = [sums[0] + mean, sums[1] + mean * mean];
        }
        self.touched.clear();
    }

    fn uncertain(&self, column: usize, replicates: u32) -> Uncertain {
        let [sum, squares] = self.sums[column];
        Uncertain::from_replicates(replicates, sum, squares)
    }

    /// Takes the result and clears everything. No factor is known better than to `resolution`.
    fn take(&mut self, replicates: u32, resolution: f64) -> Traced {
        self.seen.sort_unstable();
        let surfaces = self.seen.iter().filter(|&&column| column as usize >= FIRST);
        let entries = surfaces.map(|&column| {
            let mut found = self.uncertain(column as usize, replicates);
            found.std_error = found.std_error.max(resolution);
            Entry::estimated(column - FIRST as u32, found)
        });
        let traced = Traced {
            entries: entries.collect(),
            sum: self.uncertain(LISTED, replicates),
            rest: Rest {
                sky: self.uncertain(SKY, replicates),
                below: self.uncertain(BELOW, replicates),
                other: self.uncertain(OTHER, replicates),
            },
        };
        for column in self.seen.drain(..) {
            self.sums[column as usize] = [0.0; 2];
        }
        traced
    }
}

/// What the rays of a row found.
pub(super) struct Traced {
    pub entries: Vec<Entry>,
    pub sum: Uncertain,
    pub rest: Rest,
}

/// Where rays come from.
#[derive(Clone, Copy)]
pub(super) enum Source {
    /// Uniform points of a facet.
    Facet(usize),
    /// One place.
    Element(Element),
}

/// The same, as rays start there.
enum Start<'a> {
    Facet {
        facet: &'a Facet,
        lift: f64,
        middle: Point,
        inwards: f64,
    },
    Element {
        start: Point,
        normal: Direction,
    },
}

impl Start<'_> {
    /// Where a ray starts and its direction; none in the port of a sphere.
    fn ray(&self, [a, b, c, d]: [f64; 4]) -> Option<(Point, Vector)> {
        match *self {
            Self::Facet {
                facet,
                lift,
                middle,
                inwards,
            } => {
                let (point, normal) = facet.sample([a, b])?;
                let start = point + (middle - point) * inwards + normal * lift;
                Some((start, cosine_direction(normal, [c, d])))
            }
            Self::Element { start, normal } => Some((start, cosine_direction(normal, [a, b]))),
        }
    }
}

/// Sends rays from facets.
#[derive(Clone, Copy)]
pub(super) struct RayCaster<'a> {
    pub facets: &'a Facets<'a>,
    /// The column of each facet.
    pub columns: &'a [u32],
    pub set: InstructionSet,
}

impl RayCaster<'_> {
    /// A row from `samples` rays in each replicate.
    pub fn row(
        &self,
        from: Source,
        key: u64,
        replicates: u32,
        samples: u32,
        workspace: &mut RayWorkspace,
    ) -> Traced {
        let share = match from {
            Source::Facet(facet) => self.facets.list()[facet].sampled_share(),
            Source::Element(_) => 1.0,
        };
        let from = self.start_of(from);
        for replicate in 0..replicates {
            let key = combine(key, u64::from(replicate));
            for first in (0..samples).step_by(BATCH as usize) {
                self.start(&from, key, first..(first + BATCH).min(samples), workspace);
                self.trace(workspace);
            }
            workspace.close(1.0 / (share * f64::from(samples)));
        }
        let total = f64::from(samples) * f64::from(replicates);
        workspace.take(replicates, 1.0 / (share * (total + 2.0)))
    }

    fn start_of(&self, source: Source) -> Start<'_> {
        match source {
            Source::Facet(index) => {
                let (facet, lift) = (&self.facets.list()[index], self.facets.lift(index));
                let (middle, inwards) = facet.pull(lift);
                Start::Facet {
                    facet,
                    lift,
                    middle,
                    inwards,
                }
            }
            Source::Element(Element { position, normal }) => {
                let start = position + normal * self.facets.surfaces().clearance();
                Start::Element { start, normal }
            }
        }
    }

    fn start(
        &self,
        from: &Start<'_>,
        key: u64,
        indices: std::ops::Range<u32>,
        workspace: &mut RayWorkspace,
    ) {
        workspace.rays.clear();
        workspace.directions.clear();
        for index in indices {
            let Some((start, direction)) = from.ray(block::sample(key, index, 0).map(f64::from))
            else {
                continue;
            };
            let origin = self.facets.surfaces().to_kernel(start);
            let towards = direction.to_array().map(|x| x as f32);
            workspace.rays.push(origin, towards, f32::INFINITY);
            workspace.directions.push(direction);
        }
    }

    fn trace(&self, workspace: &mut RayWorkspace) {
        let surfaces = self.facets.surfaces();
        surfaces.closest(&workspace.rays, &mut workspace.hits, self.set);
        for row in 0..workspace.rays.len() {
            let primitive = workspace.hits.primitive[row];
            let direction = workspace.directions[row];
            if primitive == MISS {
                workspace.count(if direction.z > 0.0 { SKY } else { BELOW });
                continue;
            }
            let point = self.hit_point(workspace, row, direction);
            let from_back = surfaces.normal_at(primitive, point).dot(direction) > 0.0;
            match self.facets.of_hit(primitive, from_back) {
                Some(facet) => {
                    workspace.count(LISTED);
                    workspace.count(self.columns[facet] as usize + FIRST);
                }
                None => workspace.count(OTHER),
            }
        }
    }

    /// Near enough to tell the sides of a sphere.
    fn hit_point(&self, workspace: &RayWorkspace, row: usize, direction: Vector) -> Point {
        let origin = workspace.rays.ray(row).origin.map(f64::from);
        let t = f64::from(workspace.hits.t[row]);
        self.facets.surfaces().origin() + Vector::from(origin) + direction * t
    }
}
