//! The part of a polygon that another one can see, as closed rings of edges.

use crate::geometry::polygon::area_vector;
use crate::geometry::{Point, Polygon, Vector};

/// Where two polygons are and how large.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// A vertex of the first.
    origin: Point,
    /// A power of two near the largest distance from there, so that the change of units is exact and logarithms are small.
    pub(super) unit: f64,
    /// Vertices this close to the other polygon's plane lie in it: some roundings of the largest coordinate.
    tolerance: f64,
}

impl Scale {
    pub(super) fn of(a: &Polygon, b: &Polygon) -> Self {
        let origin = a.outline()[0];
        let largest = |size: &dyn Fn(Point) -> f64| {
            a.outline()
                .iter()
                .chain(b.outline())
                .map(|&vertex| size(vertex))
                .fold(f64::MIN_POSITIVE, f64::max)
        };
        Self {
            origin,
            unit: power_of_two_below(largest(&|vertex| (vertex - origin).max_component())),
            tolerance: 16.0 * f64::EPSILON * largest(&|vertex| vertex.to_vector().max_component()),
        }
    }
}

/// The number with its exponent alone.
fn power_of_two_below(number: f64) -> f64 {
    f64::from_bits(number.to_bits() & (0x7ff << 52))
}

/// A straight edge from `start` to `end`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) start: Vector,
    pub(super) end: Vector,
    pub(super) direction: Vector,
    pub(super) length: f64,
}

impl Edge {
    /// `None` for points that coincide.
    pub(super) fn new(start: Vector, end: Vector) -> Option<Self> {
        let length = (end - start).length();
        (length > 0.0).then(|| Self {
            start,
            end,
            direction: (end - start) / length,
            length,
        })
    }

    pub(super) fn middle(&self) -> Vector {
        (self.start + self.end) * 0.5
    }

    /// The point at this distance from the start.
    pub(super) fn at(&self, distance: f64) -> Vector {
        self.start + self.direction * distance
    }

    pub(super) fn reversed(&self) -> Self {
        Self {
            start: self.end,
            end: self.start,
            direction: -self.direction,
            length: self.length,
        }
    }

    /// The distance of a point from the edge.
    pub(super) fn distance(&self, point: Vector) -> f64 {
        let along = (point - self.start)
            .dot(self.direction)
            .clamp(0.0, self.length);
        (point - self.at(along)).length()
    }
}

/// Rings of edges around the area n A, counter-clockwise around n.
#[derive(Clone, Debug)]
pub(super) struct Outline {
    pub(super) rings: Vec<Vec<Edge>>,
    pub(super) normal: Vector,
    /// The middle of the vertices, and how far the farthest is from it.
    pub(super) center: Vector,
    pub(super) radius: f64,
}

impl Outline {
    /// The part of `polygon` in front of the plane of `other`, if there is any.
    pub(super) fn in_front_of(other: &Polygon, polygon: &Polygon, scale: &Scale) -> Option<Self> {
        let plane = |vertex: Point| {
            let height = other.normal().dot(vertex - other.outline()[0]);
            if height.abs() > scale.tolerance {
                height
            } else {
                0.0
            }
        };
        let normal = polygon.normal().to_vector();
        let outline = clip(polygon.outline().iter().copied(), plane);
        let mut rings = vec![outline];
        for hole in polygon.holes() {
            let ring = clip(hole.iter().copied(), plane);
            let is_counter_clockwise = normal.dot(area_vector(&ring)) > 0.0;
            rings.push(if is_counter_clockwise {
                ring.into_iter().rev().collect()
            } else {
                ring
            });
        }
        let rings: Vec<Vec<Edge>> = rings
            .iter()
            .map(|ring| edges(ring, scale))
            .filter(|ring| ring.len() > 2)
            .collect();
        let (center, radius) = ball(&rings)?;
        Some(Self {
            rings,
            normal,
            center,
            radius,
        })
    }

    pub(super) fn edges(&self) -> impl Iterator<Item = &Edge> {
        self.rings.iter().flatten()
    }
}

/// The part of a ring at heights ≥ 0, empty if nothing is higher than 0 (Sutherland & Hodgman, CACM 17 (1), 1974).
fn clip(
    ring: impl ExactSizeIterator<Item = Point> + Clone,
    height: impl Fn(Point) -> f64,
) -> Vec<Point> {
    let mut kept = Vec::with_capacity(ring.len() + 2);
    let Some(mut from) = ring.clone().last() else {
        return kept;
    };
    let mut height_from = height(from);
    let mut highest = 0.0_f64;
    for to in ring {
        let height_to = height(to);
        if height_from * height_to < 0.0 {
            kept.push(from.lerp(to, height_from / (height_from - height_to)));
        }
        if height_to >= 0.0 {
            kept.push(to);
        }
        highest = highest.max(height_to);
        (from, height_from) = (to, height_to);
    }
    if highest > 0.0 { kept } else { Vec::new() }
}

fn edges(ring: &[Point], scale: &Scale) -> Vec<Edge> {
    let next = ring.iter().cycle().skip(1);
    let local = |point: &Point| (*point - scale.origin) / scale.unit;
    ring.iter()
        .zip(next)
        .filter_map(|(start, end)| Edge::new(local(start), local(end)))
        .collect()
}

fn ball(rings: &[Vec<Edge>]) -> Option<(Vector, f64)> {
    let vertices = || rings.iter().flatten().map(|edge| edge.start);
    let count = vertices().count();
    let center = vertices().fold(Vector::ZERO, |sum, vertex| sum + vertex) / count as f64;
    let radius = vertices()
        .map(|vertex| (vertex - center).length())
        .fold(0.0, f64::max);
    (count > 0).then_some((center, radius))
}
