//! Whether a surface hides all of a convex body from a point.
//!
//! Rays run from s to points e of the body, but rounded: they start at s′ and end at e′, each within δ of s and e. A triangle, or
//! two that share an edge and lie on different sides of the plane through it and s, are seen from s within the cone W = {n_k · (x − s) ≥ 0} of their outer edges k, n_k of unit
//! length. The body is hidden from all such rays if, for every corner c of it,
//!
//! | | |
//! |---|---|
//! | s and c are on different sides of each triangle's plane, at heights h_s and h_c, both | > 4 δ |
//! | t n_k · (c − s), with the least t = h_s/(h_s + h_c) of all corners and triangles | > 2 δ |
//!
//! *Proof.* Both hold for all e of the body, as heights and distances are affine and t is least at a corner. On the ray x(t) from s′ to e′
//!
//! n_k · (x(t) − s) ≥ t n_k · (e − s) − δ,
//!
//! so that x is in W from t₀ = δ/min n_k·(e − s) on, which is less than half the t of the proposition. Up to t₀ it comes at most the part t₀ of the way from a height
//! of h_s − δ to the planes, which it crosses at (h_s − δ)/(h_s + h_c) > ¾ t at the earliest: there it is on the near side of both, at its end on the far side of both. W is divided
//! by the triangles into what is nearer than they are, in which all that is on the near side of both planes lies, and what is farther; a ray that goes from one into the other within W
//! meets a triangle. Neither do rays pass between two triangles that share the corners of an edge to the last bit, as the kernel's test is watertight. ∎
//!
//! δ is four times the clearance that ends of shadow rays keep, which holds the rounding of their starts, too.

use steradian_kernel::Obstacle;

use super::super::shaft::View;
use super::super::tables::Tables;
use crate::geometry::{Point, Vector};

type Corners = [[f32; 3]; 3];

/// A convex body as a point sees it, in kernel coordinates.
pub(super) struct Pyramid {
    start: Vector,
    corners: Vec<Vector>,
    /// δ.
    rounding: f64,
}

impl Pyramid {
    /// The body with these corners.
    pub fn new(tables: &Tables<'_>, view: &View, corners: &[Point]) -> Self {
        let kernel = |point: &Point| *point - tables.scene.surfaces().origin();
        Self {
            start: kernel(&view.start),
            corners: corners.iter().map(kernel).collect(),
            rounding: 4.0 * view.clearance(tables, corners),
        }
    }

    /// Whether one opaque triangle, or two neighbours by number, hide it.
    pub fn is_hidden_by(&self, tables: &Tables<'_>, obstacles: &[Obstacle]) -> bool {
        let opaque = |obstacle: &&Obstacle| is_opaque(tables, obstacle.primitive);
        obstacles.iter().filter(opaque).any(|obstacle| {
            let Some(least) = obstacle.corners.and_then(|corners| self.least(&corners)) else {
                return false;
            };
            let next = |other: &&Obstacle| other.primitive == obstacle.primitive + 1;
            let next = obstacles.iter().filter(opaque).find(next);
            let Some(corners) = &obstacle.corners else {
                return false;
            };
            self.is_within(corners, least, None)
                || next.and_then(|next| next.corners).is_some_and(|other| {
                    let both = self.least(&other).map(|t| t.min(least));
                    both.is_some_and(|least| self.are_around(corners, &other, least))
                })
        })
    }

    /// The least t at which rays cross the plane of a triangle, if all do.
    fn least(&self, triangle: &Corners) -> Option<f64> {
        let [a, b, c] = triangle.map(double);
        let normal = (b - a).cross(c - a);
        let size = normal.length();
        let height = |point: &Vector| normal.dot(*point - a) / size;
        let near = height(&self.start);
        let mut least = f64::INFINITY;
        for corner in &self.corners {
            let far = -height(corner) * near.signum();
            // Triangles without area have no heights.
            if far.is_nan() || far <= 4.0 * self.rounding {
                return None;
            }
            least = least.min(near.abs() / (near.abs() + far));
        }
        (near.abs() > 4.0 * self.rounding).then_some(least)
    }

    fn are_around(&self, triangle: &Corners, other: &Corners, least: f64) -> bool {
        let Some(edge) = (0..3).find(|k| {
            let ends = [triangle[*k], triangle[(k + 1) % 3]];
            ends.iter().all(|end| other.contains(end))
        }) else {
            return false;
        };
        let [from, to] = [edge, (edge + 1) % 3].map(|k| triangle[k]);
        let Some(shared) = (0..3).find(|k| {
            let ends = [other[*k], other[(k + 1) % 3]];
            ends == [from, to] || ends == [to, from]
        }) else {
            return false;
        };
        let [apex, beyond] = [triangle[(edge + 2) % 3], other[(shared + 2) % 3]].map(double);
        let normal = self.normal([double(from), double(to)]);
        normal.dot(apex - self.start) * normal.dot(beyond - self.start) < 0.0
            && self.is_within(triangle, least, Some(edge))
            && self.is_within(other, least, Some(shared))
    }

    /// Whether the body is within the edges of a triangle, but for one of them.
    fn is_within(&self, triangle: &Corners, least: f64, except: Option<usize>) -> bool {
        (0..3).filter(|k| Some(*k) != except).all(|k| {
            let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| double(triangle[k]));
            let normal = self.normal([a, b]);
            let inwards = normal.dot(c - self.start).signum();
            let bound = 2.0 * self.rounding * normal.length();
            let depth = |corner: &Vector| inwards * normal.dot(*corner - self.start) * least;
            self.corners.iter().all(|corner| depth(corner) > bound)
        })
    }

    /// Of the plane through the start and an edge.
    fn normal(&self, [a, b]: [Vector; 2]) -> Vector {
        (a - self.start).cross(b - self.start)
    }
}

fn is_opaque(tables: &Tables<'_>, primitive: u32) -> bool {
    let part = 2 * tables.scene.surfaces().part_of(primitive) as usize;
    tables.sides[part..part + 2]
        .iter()
        .all(|side| !side.lets_pass())
}

fn double(corner: [f32; 3]) -> Vector {
    Vector::from(corner.map(f64::from))
}
