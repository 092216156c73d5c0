//! What is wrong with a set of triangles: leaks, seams, doubled and degenerate faces.
//!
//! In a closed surface that faces one way every edge is shared by just two triangles that run along it in opposite ways. What deviates
//! from that is found by sorting the edges, in O(n log n):
//!
//! | finding | meaning | what it does to light |
//! |---|---|---|
//! | boundary edge | used by one triangle | light leaks past it, if the surface was meant to be closed |
//! | non-manifold edge | used by three triangles or more | nothing, but inside and outside have no meaning there |
//! | turned edge | two triangles run along it in the same way: one shows its back | wrong materials and emission of the sides |
//! | doubled face | another triangle has the same corners | which one is met is arbitrary, and emission counts twice |
//! | degenerate face | its edges span no area: the sine of their angle is within 8·2⁻⁵² | none is met by a ray |
//!
//! Vertices at the same place count as one, bit by bit, or within a tolerance if one is given. A T-junction, where a vertex of one triangle
//! lies within the edge of another, is told as the boundary edges on its two sides: rays may pass between them.
//!
//! A doubled face is left out when edges are counted, and so is a face that merging makes a line, so that one fault is told once.
//! Triangles that share edges are a *piece*. A piece that lies in a plane, such as a sheet of paper, is open by its nature; its boundary is
//! marked as `flat`, so that leaks can be told from it.

use std::collections::HashMap;

use crate::geometry::{Point, Vector};
use crate::quantity::Length;

use super::Parallelogram;

/// An edge that is not shared as it should be.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Its ends, by number of vertex.
    pub ends: [u32; 2],
    /// The first triangle that has it.
    pub triangle: u32,
    /// How many triangles have it.
    pub uses: u32,
    /// Whether it belongs to a piece that lies in a plane.
    pub flat: bool,
}

/// Two triangles with the same corners.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub struct Doubled {
    /// The later one.
    pub triangle: u32,
    /// The first one.
    pub original: u32,
    /// Whether they face opposite ways.
    pub turned: bool,
}

/// All findings, each kind in the order of the vertices or triangles.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// Edges of one triangle.
    pub boundary: Vec<Edge>,
    /// Edges of three triangles or more.
    pub non_manifold: Vec<Edge>,
    /// Edges along which two triangles run the same way.
    pub turned: Vec<Edge>,
    /// Triangles that another one repeats.
    pub doubled: Vec<Doubled>,
    /// Triangles without area.
    pub degenerate: Vec<u32>,
    /// Number of pieces.
    pub pieces: u32,
}

impl Health {
    /// Whether nothing is to be told: no finding but the boundaries of flat pieces.
    pub fn is_sound(&self) -> bool {
        self.boundary.iter().all(|edge| edge.flat)
            && self.non_manifold.is_empty()
            && self.turned.is_empty()
            && self.doubled.is_empty()
            && self.degenerate.is_empty()
    }
}

/// Examines triangles whose indices lie within `vertices`; those at most `weld` apart count as one vertex.
///
/// ```
/// use steradian::geometry::Point;
/// use steradian::quantity::Length;
/// use steradian::shape::health;
///
/// // A tetrahedron without its last face, 1-2-3.
/// let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Point::from);
/// let open = health::examine(&corners, &[[0, 2, 1], [0, 1, 3], [0, 3, 2]], Length::ZERO);
/// let leaks: Vec<_> = open.boundary.iter().map(|edge| edge.ends).collect();
/// assert_eq!(leaks, [[1, 2], [1, 3], [2, 3]]);
/// ```
pub fn examine(vertices: &[Point], triangles: &[[u32; 3]], weld: Length) -> Health {
    let merged = if weld > Length::ZERO {
        within(vertices, weld.to_metres())
    } else {
        at_same_place(vertices)
    };
    let faces: Vec<[u32; 3]> = triangles
        .iter()
        .map(|corners| corners.map(|index| merged[index as usize]))
        .collect();
    let mut health = Health {
        degenerate: degenerate(vertices, &faces),
        ..Health::default()
    };
    let mut counts: Vec<bool> = faces.iter().map(|face| !is_line(face)).collect();
    health.doubled = doubled(&faces);
    for face in &health.doubled {
        counts[face.triangle as usize] = false;
    }
    let runs = sorted_runs(&faces, &counts);
    let mut pieces = Pieces::new(&runs, faces.len());
    let flat = pieces.flat(vertices, &faces, &counts);
    let is_flat = |triangle: u32, pieces: &mut Pieces| flat[pieces.root(triangle) as usize];
    for shared in runs.chunk_by(|one, other| one.ends == other.ends) {
        let edge = Edge {
            ends: shared[0].ends,
            triangle: shared[0].triangle,
            uses: shared.len() as u32,
            flat: is_flat(shared[0].triangle, &mut pieces),
        };
        match shared {
            [_] => health.boundary.push(edge),
            [one, other] if one.forwards != other.forwards => (),
            [_, _] => health.turned.push(edge),
            _ => health.non_manifold.push(edge),
        }
    }
    health.pieces = pieces.count(&counts);
    health
}

/// Whether merging has made a line or a point of a triangle.
fn is_line([a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}

fn degenerate(vertices: &[Point], faces: &[[u32; 3]]) -> Vec<u32> {
    let spans_nothing = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|index| vertices[index as usize]);
        is_line(face) || Parallelogram::new(a, [b - a, c - a]).is_none()
    };
    let numbered = (0..).zip(faces);
    let faulty = numbered.filter(|(_, face)| spans_nothing(face));
    faulty.map(|(number, _)| number).collect()
}

/// Triangles whose corners are those of an earlier one.
fn doubled(faces: &[[u32; 3]]) -> Vec<Doubled> {
    let mut sorted: Vec<([u32; 3], u32)> = (0..)
        .zip(faces)
        .filter(|(_, face)| !is_line(face))
        .map(|(number, face)| {
            let mut corners = *face;
            corners.sort_unstable();
            (corners, number)
        })
        .collect();
    sorted.sort_unstable();
    let alike = sorted.chunk_by(|one, other| one.0 == other.0);
    let mut doubled: Vec<Doubled> = alike
        .flat_map(|group| {
            let original = group[0].1;
            group[1..].iter().map(move |&(_, triangle)| Doubled {
                triangle,
                original,
                turned: is_turned(&faces[original as usize], &faces[triangle as usize]),
            })
        })
        .collect();
    doubled.sort_unstable_by_key(|face| face.triangle);
    doubled
}

/// Whether two triangles of the same corners run around them in opposite ways.
fn is_turned([a, b, c]: &[u32; 3], other: &[u32; 3]) -> bool {
    ![[*a, *b, *c], [*b, *c, *a], [*c, *a, *b]].contains(other)
}

/// One triangle's use of an edge.
#[derive(Copy, Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Run {
    /// The lesser end first.
    ends: [u32; 2],
    triangle: u32,
    /// From the lesser end to the greater.
    forwards: bool,
}

/// All uses of edges, those of one edge side by side.
fn sorted_runs(faces: &[[u32; 3]], counts: &[bool]) -> Vec<Run> {
    let counted = (0..)
        .zip(faces)
        .filter(|(number, _)| counts[*number as usize]);
    let mut runs: Vec<Run> = counted
        .flat_map(|(triangle, &[a, b, c])| {
            [(a, b), (b, c), (c, a)].map(|(from, to)| Run {
                ends: [from.min(to), from.max(to)],
                triangle,
                forwards: from < to,
            })
        })
        .collect();
    runs.sort_unstable();
    runs
}

/// Which triangles hang together by edges: trees whose roots stand for pieces.
struct Pieces {
    parents: Vec<u32>,
}

impl Pieces {
    fn new(runs: &[Run], faces: usize) -> Self {
        let mut pieces = Self {
            parents: (0..faces as u32).collect(),
        };
        for pair in runs.windows(2) {
            if pair[0].ends == pair[1].ends {
                let (one, other) = (pieces.root(pair[0].triangle), pieces.root(pair[1].triangle));
                pieces.parents[one.max(other) as usize] = one.min(other);
            }
        }
        pieces
    }

    /// The first triangle of the piece; halves the way to it.
    fn root(&mut self, triangle: u32) -> u32 {
        let mut at = triangle;
        while self.parents[at as usize] != at {
            let above = self.parents[self.parents[at as usize] as usize];
            self.parents[at as usize] = above;
            at = above;
        }
        at
    }

    fn count(&mut self, counts: &[bool]) -> u32 {
        let is_root =
            |&triangle: &u32| counts[triangle as usize] && self.root(triangle) == triangle;
        (0..counts.len() as u32).filter(is_root).count() as u32
    }

    /// For each root whether its piece lies in a plane: all corners on that of its largest triangle, within 10⁻⁵ of the
    /// piece's extent, as coordinates may have been rounded to f32.
    fn flat(&mut self, vertices: &[Point], faces: &[[u32; 3]], counts: &[bool]) -> Vec<bool> {
        let mut planes = vec![Plane::NONE; faces.len()];
        let corners =
            |triangle: u32| faces[triangle as usize].map(|index| vertices[index as usize]);
        let counted = || (0..faces.len() as u32).filter(|triangle| counts[*triangle as usize]);
        for triangle in counted() {
            planes[self.root(triangle) as usize].grow(corners(triangle));
        }
        let mut off = vec![(0.0_f64, 0.0_f64); faces.len()];
        for triangle in counted() {
            let root = self.root(triangle) as usize;
            for corner in corners(triangle) {
                let offset = corner - planes[root].origin;
                let height = offset.dot(planes[root].normal).abs();
                off[root] = (off[root].0.max(height), off[root].1.max(offset.length()));
            }
        }
        off.into_iter()
            .map(|(height, extent)| height <= 1e-5 * extent)
            .collect()
    }
}

/// The plane of the largest triangle so far.
#[derive(Copy, Clone)]
struct Plane {
    area: f64,
    origin: Point,
    normal: Vector,
}

impl Plane {
    const NONE: Self = Self {
        area: 0.0,
        origin: Point::ORIGIN,
        normal: Vector::ZERO,
    };

    fn grow(&mut self, [a, b, c]: [Point; 3]) {
        let cross = (b - a).cross(c - a);
        let area = 0.5 * cross.length();
        if area > self.area {
            *self = Self {
                area,
                origin: a,
                normal: cross / cross.length(),
            };
        }
    }
}

/// For each vertex the number of the first one at the same place.
pub(super) fn at_same_place(vertices: &[Point]) -> Vec<u32> {
    let mut first = HashMap::with_capacity(vertices.len());
    let place = |vertex: &Point| vertex.to_array().map(|x| (x + 0.0).to_bits());
    let numbered = vertices.iter().zip(0..);
    numbered
        .map(|(vertex, index)| *first.entry(place(vertex)).or_insert(index))
        .collect()
}

/// For each vertex the number of the first one that stands for itself and is at most `distance` away, found among the cells of a grid of that
/// size around it.
fn within(vertices: &[Point], distance: f64) -> Vec<u32> {
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut merged = Vec::with_capacity(vertices.len());
    for (vertex, index) in vertices.iter().zip(0..) {
        let cell = vertex.to_array().map(|x| (x / distance).floor() as i64);
        let near = neighbours(cell).filter_map(|cell| cells.get(&cell));
        let close =
            |other: &&u32| vertices[**other as usize].distance(*vertex).to_metres() <= distance;
        let found = near.flatten().filter(close).min().copied();
        if found.is_none() {
            cells.entry(cell).or_default().push(index);
        }
        merged.push(found.unwrap_or(index));
    }
    merged
}

/// A cell and the 26 around it.
fn neighbours([x, y, z]: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    let step = |code: i64| [code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1];
    (0..27).map(step).map(move |[dx, dy, dz]| {
        [
            x.saturating_add(dx),
            y.saturating_add(dy),
            z.saturating_add(dz),
        ]
    })
}

#[cfg(test)]
mod tests;
