//! A triangle mesh: area ½ Σ |(b − a) × (c − a)|.

use crate::geometry::{Direction, Point};

use super::health::at_same_place;
use super::{AreaSample, Parallelogram};

/// Triangles with the cumulative area that uniform sampling needs.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    /// Vertices.
    pub vertices: Vec<Point>,
    /// Counter-clockwise from the front.
    pub triangles: Vec<[u32; 3]>,
    cumulative_area: Vec<f64>,
    /// What varies over it.
    pub attributes: Attributes,
}

/// Numbers of each vertex, interpolated within triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    /// Texture coordinates; empty if there are none.
    pub coordinates: Vec<[f32; 2]>,
    /// Linear Rec.709 and alpha; empty if there are none.
    pub colors: Vec<[f32; 4]>,
    /// Normals of the surface that the triangles stand for; empty if there are none.
    pub normals: Vec<[f32; 3]>,
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
            attributes: Attributes::default(),
        }
    }

    /// The same with attributes, of which there are none or one for each vertex.
    pub fn with_attributes(self, attributes: Attributes) -> Self {
        Self { attributes, ..self }
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

    /// Whether any triangle spans an area: an angle whose sine is above rounding, 8·2⁻⁵².
    pub fn has_area(&self) -> bool {
        (0..self.triangles.len()).any(|index| {
            let [a, b, c] = self.corners(index);
            Parallelogram::new(a, [b - a, c - a]).is_some()
        })
    }

    /// True when every edge is shared by just two triangles that run along it in opposite ways. Vertices at the same
    /// place count as one, and triangles that this makes a line do not count.
    pub fn is_closed(&self) -> bool {
        let merged = at_same_place(&self.vertices);
        let triangles = self
            .triangles
            .iter()
            .map(|corners| corners.map(|index| merged[index as usize]));
        let mut edges: Vec<(u32, u32, bool)> = triangles
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)])
            .map(|(from, to)| (from.min(to), from.max(to), from < to))
            .collect();
        edges.sort_unstable();
        let mut shared = edges.chunk_by(|one, other| (one.0, one.1) == (other.0, other.1));
        !edges.is_empty() && shared.all(|runs| matches!(runs, [one, other] if one.2 != other.2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::testing::{assert_proportional, histogram, independent};

    /// A fan of 31 triangles around the origin, with areas 1, 2, … 31 and one of no area.
    fn fan() -> TriangleMesh {
        let mut vertices = vec![Point::ORIGIN, Point::new(1.0, 0.0, 0.0)];
        let mut triangles = vec![[0, 1, 1]];
        for k in 1..=31 {
            let [_, last] = [vertices.len() - 2, vertices.len() - 1];
            let from = vertices[last];
            let step = f64::from(k) * 2.0 / (from - Point::ORIGIN).length();
            let outwards = Direction::new(from - Point::ORIGIN).unwrap();
            vertices.push(from + Direction::Z.cross(outwards) * step);
            triangles.push([0, last as u32, last as u32 + 1]);
        }
        TriangleMesh::new(vertices, triangles)
    }

    #[test]
    fn areas_add_up() {
        let area: f64 = (1..=31).map(f64::from).sum();
        assert!((fan().area() - area).abs() < 1e-12 * area);
        let shares: Vec<f64> = fan().cumulative_share().collect();
        assert_eq!((shares[0], shares[31]), (0.0, 1.0));
    }

    #[test]
    fn triangles_are_chosen_by_area() {
        let mesh = fan();
        let face = |u| mesh.sample_area(u).unwrap().face;
        let counts = histogram(32, independent(6, 65_536).map(face));
        assert_eq!(counts[0], 0);
        let areas: Vec<f64> = (1..=31).map(f64::from).collect();
        assert_proportional(&counts[1..], &areas);
    }

    /// Each of the 64 triangles that three halvings give holds as many.
    #[test]
    fn samples_are_uniform_within_a_triangle() {
        let corners = [[0.0, 0.0, 0.0], [4.0, 1.0, 0.0], [1.0, 3.0, 0.0]];
        let mesh = TriangleMesh::new(corners.map(Point::from).to_vec(), vec![[0, 1, 2]]);
        let cell = |u| {
            let p = mesh.sample_area(u).unwrap().point;
            let s = (3.0 * p.x - p.y) / 11.0;
            let t = (4.0 * p.y - p.x) / 11.0;
            subdivision([1.0 - s - t, s, t], 3)
        };
        let counts = histogram(64, independent(7, 65_536).map(cell));
        assert_proportional(&counts, &[1.0; 64]);
    }

    fn subdivision(weights: [f64; 3], depth: u32) -> usize {
        if depth == 0 {
            return 0;
        }
        let corner = weights.iter().position(|weight| *weight > 0.5);
        let doubled = match corner {
            Some(corner) => {
                let mut doubled = weights.map(|weight| 2.0 * weight);
                doubled[corner] -= 1.0;
                doubled
            }
            None => weights.map(|weight| 1.0 - 2.0 * weight),
        };
        corner.map_or(3, |corner| corner) * 4_usize.pow(depth - 1) + subdivision(doubled, depth - 1)
    }

    #[test]
    fn samples_face_the_front() {
        let sample = fan().sample_area([0.5, 0.5]).unwrap();
        assert_eq!(sample.normal, Direction::Z);
        assert_eq!(
            TriangleMesh::new(vec![], vec![]).sample_area([0.5; 2]),
            None
        );
    }

    #[test]
    fn triangles_on_a_line_have_no_area() {
        let along = |t: f64| Point::new(0.1, 0.2, 0.3).lerp(Point::new(0.7, 0.3, 0.9), t);
        let line = vec![along(0.0), along(0.3), along(1.0)];
        assert!(!TriangleMesh::new(line, vec![[0, 1, 2]]).has_area());
        assert!(fan().has_area());
    }

    #[test]
    fn a_tetrahedron_is_closed_also_with_vertices_of_its_own_for_each_face() {
        let corners = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ];
        let corners = corners.map(Point::from).to_vec();
        let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let solid = TriangleMesh::new(corners.clone(), faces.clone());
        assert!(solid.is_closed());
        assert!((solid.signed_volume() - 1.0 / 6.0).abs() < 1e-15);
        let split = faces.iter().flatten().map(|&index| corners[index as usize]);
        let own = (0..4)
            .map(|face| [3 * face, 3 * face + 1, 3 * face + 2])
            .collect();
        assert!(TriangleMesh::new(split.collect(), own).is_closed());
        let open = TriangleMesh::new(corners.clone(), faces[..3].to_vec());
        assert!(!open.is_closed());
        let turned = vec![[0, 1, 2], faces[1], faces[2], faces[3]];
        assert!(!TriangleMesh::new(corners.clone(), turned).is_closed());
        let twice = [faces.clone(), faces].concat();
        assert!(!TriangleMesh::new(corners, twice).is_closed());
    }
}
