//! The exchange area of two facets that other surfaces may stand between.
//!
//! G = A_i F_ij = A_j F_ji is found in the first of these ways that applies:
//!
//! 1. One lies behind the other's plane: G = 0 exactly.
//! 2. Nothing reaches into the convex hull of both (but for less than [`Surfaces::clearance`](crate::shape::Surfaces::clearance)): the closed
//!    form G₀ of [`exchange_area_of_polygons`], without error.
//! 3. Samples of the unoccluded integrand with a ray each, in every replicate
//!
//!    G = mean(w V) − β (mean(w) − G₀)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | V | 1 if nothing lies between the points, else 0 | – |
//! | w | weight of a sample: the unoccluded integrand over its density | m² |
//! | G₀ | mean of w, known in closed form | m² |
//! | β | the visible share of the pilot's samples, ½ without a pilot | – |
//!
//! The point x on i is uniform by area. Where the facets are farther apart than the sum of their radii, y is uniform on j and
//! w = A_i A_j cosθ_i cosθ_j/(π r²) varies by less than 9 through r; nearer, y is drawn by projected solid angle from x, and
//! w = A_i F(x→j) is at most A_i. With β fixed before the samples are drawn the estimate is unbiased whatever β is.
//!
//! Where all N samples agree, the spread of the replicates says nothing. The share p of the minority then has, from even odds, the density
//! (N + 1)(1 − p)^N, so G is 0 or G₀ with the standard error w_max/(N + 2), and never without.

use std::f64::consts::PI;

use steradian_kernel::{InstructionSet, RayBatch};

use super::effort::{Attempt, Found, Rule};
use super::facets::Facets;
use super::polygon::ConvexPolygon;
use super::row::Entry;
use super::uncertain::Uncertain;
use crate::geometry::form_factor::exchange_area_of_polygons;
use crate::geometry::{Direction, Frame, Hull, Point, Vector};
use crate::quantity::Length;
use crate::sampling::block;
use crate::sampling::hash::{combine, key_of_name};
use crate::sampling::projected_polygon::ProjectedPolygon;

/// Rays traced together.
const BATCH: usize = 1024;
/// Samples of each replicate in the pilot.
const PILOT: u32 = 2;
/// Corners within this share of the size of a facet lie in its plane.
const IN_PLANE: f64 = 1e-9;

/// Scratch of a thread.
#[derive(Default)]
pub(super) struct PairWorkspace {
    rays: RayBatch,
    occluded: Vec<bool>,
    /// Replicate and weight of each ray.
    waiting: Vec<(u32, f64)>,
    replicates: Vec<Sums>,
}

/// Of the samples of one replicate.
#[derive(Clone, Copy, Default)]
struct Sums {
    all: f64,
    visible: f64,
    seen: u32,
    largest: f64,
}

/// What was found of a pair.
pub(super) struct Exchange {
    /// The exchange area, as an entry of the first facet's row.
    pub area: Entry,
    pub samples: u64,
    pub converged: bool,
}

/// The parts of two facets that can see each other.
struct View {
    from: ConvexPolygon,
    to: ConvexPolygon,
    lifts: [f64; 2],
}

/// Finds exchange areas.
#[derive(Clone, Copy)]
pub(super) struct PairCaster<'a> {
    pub facets: &'a Facets<'a>,
    pub rule: Rule,
    pub set: InstructionSet,
}

impl PairCaster<'_> {
    /// The exchange area of two polygons; `None` where they cannot see each other.
    pub fn exchange(
        &self,
        from: usize,
        to: usize,
        workspace: &mut PairWorkspace,
    ) -> Option<Exchange> {
        let view = self.view(from, to)?;
        let unoccluded = self.unoccluded(from, to);
        if unoccluded == 0.0 {
            return None;
        }
        if self.is_clear(&view) {
            return Some(Exchange {
                area: Entry::exact(to as u32, unoccluded),
                samples: 0,
                converged: true,
            });
        }
        Some(self.sampled([from, to], &view, unoccluded, workspace))
    }

    fn view(&self, from: usize, to: usize) -> Option<View> {
        let list = self.facets.list();
        let (a, b) = (list[from].polygon()?, list[to].polygon()?);
        Some(View {
            to: in_front(b, a)?,
            from: in_front(a, b)?,
            lifts: [self.facets.lift(from), self.facets.lift(to)],
        })
    }

    fn unoccluded(&self, from: usize, to: usize) -> f64 {
        let [a, b] = [from, to].map(|index| self.facets.outline(index));
        match (a, b) {
            (Some(a), Some(b)) => exchange_area_of_polygons(a, b).to_square_metres().max(0.0),
            _ => 0.0,
        }
    }

    fn is_clear(&self, view: &View) -> bool {
        let surfaces = self.facets.surfaces();
        let corners = [view.from.corners(), view.to.corners()].concat();
        let margin = Length::from_metres(surfaces.clearance());
        surfaces.is_clear(&Hull::around(&corners).shrunk(margin), &|_| false)
    }

    fn sampled(
        &self,
        [from, to]: [usize; 2],
        view: &View,
        unoccluded: f64,
        workspace: &mut PairWorkspace,
    ) -> Exchange {
        let pair = combine(from as u64, to as u64);
        let identity = combine(key_of_name("pair"), pair);
        let [a, b] = [from, to].map(|index| self.facets.list()[index].area);
        let mut beta = 0.5;
        let (area, samples, converged) = self.rule.sample(identity, PILOT, |attempt| {
            self.trace(view, attempt, workspace);
            let found = estimate(&workspace.replicates, attempt.samples, beta, unoccluded);
            let visible: f64 = workspace.replicates.iter().map(|sums| sums.visible).sum();
            let all: f64 = workspace.replicates.iter().map(|sums| sums.all).sum();
            beta = if all > 0.0 { visible / all } else { 0.5 };
            Found {
                excess: self.rule.excess(&found.value.scaled(1.0 / a.min(b))),
                order: found.order,
                value: found.value,
            }
        });
        let area = Entry::estimated(to as u32, area);
        Exchange {
            area,
            samples,
            converged,
        }
    }

    /// Fills the sums of all replicates.
    fn trace(&self, view: &View, attempt: &Attempt, workspace: &mut PairWorkspace) {
        workspace.replicates.clear();
        workspace
            .replicates
            .resize(self.rule.replicates as usize, Sums::default());
        let is_far = view.is_far();
        for replicate in 0..self.rule.replicates {
            let key = combine(attempt.key, u64::from(replicate));
            for index in 0..attempt.samples {
                let u = block::sample(key, index, 0).map(f64::from);
                let sample = if is_far {
                    view.by_area(u)
                } else {
                    view.by_angle(u)
                };
                if let Some((points, weight)) = sample {
                    self.push(view, points, workspace);
                    workspace.waiting.push((replicate, weight));
                }
                if workspace.waiting.len() == BATCH {
                    self.flush(workspace);
                }
            }
        }
        self.flush(workspace);
    }

    fn push(&self, view: &View, [x, y]: [Point; 2], workspace: &mut PairWorkspace) {
        let start = x + view.from.normal() * view.lifts[0];
        let end = y + view.to.normal() * view.lifts[1];
        let direction = (end - start).to_array().map(|component| component as f32);
        let origin = self.facets.surfaces().to_kernel(start);
        workspace.rays.push(origin, direction, 1.0);
    }

    fn flush(&self, workspace: &mut PairWorkspace) {
        let PairWorkspace {
            rays,
            occluded,
            waiting,
            replicates,
        } = workspace;
        self.facets.surfaces().occluded(rays, occluded, self.set);
        for ((replicate, weight), blocked) in waiting.drain(..).zip(occluded.iter()) {
            let sums = &mut replicates[replicate as usize];
            sums.all += weight;
            sums.largest = sums.largest.max(weight);
            if !blocked {
                sums.visible += weight;
                sums.seen += 1;
            }
        }
        rays.clear();
    }
}

/// G from the sums of the replicates, each of n samples, and how its error falls with n.
fn estimate(replicates: &[Sums], samples: u32, beta: f64, unoccluded: f64) -> Found<Uncertain> {
    let n = f64::from(samples);
    let total = n * replicates.len() as f64;
    let seen: u64 = replicates.iter().map(|sums| u64::from(sums.seen)).sum();
    if seen == 0 || seen as f64 == total {
        let largest = replicates
            .iter()
            .map(|sums| sums.largest)
            .fold(0.0, f64::max);
        let value = Uncertain {
            value: if seen == 0 { 0.0 } else { unoccluded },
            std_error: largest / (total + 2.0),
            degrees: replicates.len() as f64 - 1.0,
        };
        return Found {
            value,
            excess: 0.0,
            order: 1.0,
        };
    }
    let mean = |sums: &Sums| (sums.visible - beta * sums.all) / n + beta * unoccluded;
    let moments = replicates
        .iter()
        .map(mean)
        .fold((0.0, 0.0), |(sum, squares), mean| {
            (sum + mean, squares + mean * mean)
        });
    let value = Uncertain::from_replicates(replicates.len() as u32, moments.0, moments.1);
    Found {
        value,
        excess: 0.0,
        order: Rule::ORDER,
    }
}

/// The part of `polygon` in front of the plane of `other`.
fn in_front(polygon: &ConvexPolygon, other: &ConvexPolygon) -> Option<ConvexPolygon> {
    let (point, normal) = (other.corners()[0], other.normal());
    let [low, high] = polygon.heights(point, normal);
    let tolerance = IN_PLANE * (other.diameter() + polygon.diameter());
    match (low >= -tolerance, high > tolerance) {
        (_, false) => None,
        (true, true) => Some(polygon.clone()),
        (false, true) => polygon.above(point, normal),
    }
}

impl View {
    /// Whether the facets are farther apart than the sum of their radii.
    fn is_far(&self) -> bool {
        let between = (self.to.middle() - self.from.middle()).length();
        between > 2.0 * (self.from.radius() + self.to.radius())
    }

    fn by_area(&self, [a, b, c, d]: [f64; 4]) -> Option<([Point; 2], f64)> {
        let (x, y) = (self.from.sample([a, b]), self.to.sample([c, d]));
        let r = y - x;
        let cosines = self.from.normal().dot(r) * -self.to.normal().dot(r);
        let square = r.length_squared();
        let weight = cosines / (PI * square * square) * self.from.area() * self.to.area();
        Some(([x, y], weight.max(0.0)))
    }

    fn by_angle(&self, [a, b, c, d]: [f64; 4]) -> Option<([Point; 2], f64)> {
        let x = self.from.sample([a, b]);
        let frame = Frame::from_normal(self.from.normal());
        let corners = self.to.corners().iter();
        let seen: Vec<Vector> = corners.map(|&y| frame.vector_to_local(y - x)).collect();
        let polygon = ProjectedPolygon::new(&seen)?;
        let direction = frame.to_world(polygon.sample([c, d]));
        let y = self.to.meet(x, direction)?;
        let weight = polygon.projected_solid_angle().to_steradians() / PI * self.from.area();
        Some(([x, y], weight))
    }
}

impl ConvexPolygon {
    /// Where a ray meets the plane.
    fn meet(&self, from: Point, direction: Direction) -> Option<Point> {
        let t = self.normal().dot(self.corners()[0] - from) / self.normal().dot(direction);
        (t.is_finite() && t > 0.0).then(|| from + direction * t)
    }

    /// Of the corners from the middle.
    fn radius(&self) -> f64 {
        let middle = self.middle();
        let squares = self
            .corners()
            .iter()
            .map(|&corner| (corner - middle).length_squared());
        squares.fold(0.0_f64, f64::max).sqrt()
    }
}
