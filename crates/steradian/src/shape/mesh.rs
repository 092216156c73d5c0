//! A triangle mesh: area ½ Σ |(b − a) × (c − a)|.

use crate::geometry::{Direction, Point};

use super::AreaSample;

/// Triangles with the cumulative area that uniform sampling needs.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    /// Vertices.
    pub vertices: Vec<Point>,
    /// Counter-clockwise from the front.
    pub triangles: Vec<[u32; 3]>,
    cumulative_area: Vec<f64>,
}

impl TriangleMesh {
    /// Indices must lie within `vertices`.
    pub fn new(vertices: Vec<Point>, triangles: Vec<[u32; 3]>) -> Self {
        let mut total = 0.0;
        let areas = triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|index| vertices[index as usize]);
            total += 0.5 * (b - a).cross(c - a).length();
            total
        });
        let cumulative_area = areas.collect();
        Self {
            vertices,
            triangles,
            cumulative_area,
        }
    }

    /// A in m².
    pub fn area(&self) -> f64 {
        self.cumulative_area.last().copied().unwrap_or(0.0)
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [Point; 3] {
        self.triangles[triangle].map(|index| self.vertices[index as usize])
    }

    /// Share of the area up to and including each triangle.
    pub fn cumulative_share(&self) -> impl Iterator<Item = f64> + '_ {
        let total = self.area();
        self.cumulative_area.iter().map(move |area| area / total)
    }

    /// A point of uniform density 1/A (Arvo's square-to-triangle map within the chosen triangle); `None` without area.
    pub fn sample_area(&self, u: [f64; 2]) -> Option<AreaSample> {
        let wanted = u[0] * self.area();
        let index = self
            .cumulative_area
            .partition_point(|area| *area <= wanted)
            .min(self.triangles.len().checked_sub(1)?);
        let before = if index == 0 {
            0.0
        } else {
            self.cumulative_area[index - 1]
        };
        let within = ((wanted - before) / (self.cumulative_area[index] - before)).clamp(0.0, 1.0);
        let [a, b, c] = self.corners(index);
        let normal = Direction::new((b - a).cross(c - a)).ok()?;
        let root = within.sqrt();
        let point = a + (b - a) * (1.0 - root) + (c - a) * (u[1] * root);
        Some(AreaSample {
            point,
            normal,
            face: index,
        })
    }

    /// Signed volume ⅓ ∮ x·n dA, positive when a closed mesh faces outwards.
    pub fn signed_volume(&self) -> f64 {
        let origin = self.vertices.first().copied();
        let terms = (0..self.triangles.len()).map(|i| {
            let [a, b, c] = self.corners(i);
            let base = origin.unwrap_or(a);
            (a - base).dot((b - base).cross(c - base)) / 6.0
        });
        terms.sum()
    }

    /// True when every edge is shared by exactly two triangles that run along it in opposite ways.
    pub fn is_closed(&self) -> bool {
        let mut edges = std::collections::BTreeMap::<(u32, u32), i64>::new();
        for [a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let sign = if from < to { 1 } else { -1 };
                let entry = edges.entry((*from.min(to), *from.max(to))).or_insert(0);
                *entry += sign * 4 + 1;
            }
        }
        !edges.is_empty() && edges.values().all(|count| *count == 2)
    }
}
