//! The convex hull of a few points, as the half-spaces that bound it.
//!
//! The hull of points pᵢ is the set of x with
//!
//! n · x ≤ d ,  d = maxᵢ n · pᵢ
//!
//! for every outward normal n of its faces, here in the form in which
//! [`Accelerator::region_is_clear`](steradian_kernel::Accelerator::region_is_clear) asks for a convex region: the shaft between
//! two polygons, or between a point and a polygon, is the hull of all their corners (E. A. Haines & J. R. Wallace,
//! *Shaft culling for efficient ray-cast radiosity*, Eurographics Workshop on Rendering 1991).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | pᵢ | points | m |
//! | n | outward unit normal of a face | – |
//! | d | its distance from the origin along n | m |
//!
//! A face is the plane through three of the points that has all others on one side; with P points that costs P⁴/6 steps, for
//! points up to a dozen or two. As every d is a maximum over all points, the half-spaces hold each of them up to 2⁻⁵¹ of their
//! coordinates whatever rounding has done to n; a face that is missed for rounding makes the region larger, never smaller.
//!
//! Points of a plane give a flat hull (two opposite half-spaces and one for each edge), points of a line a segment, a single point
//! itself. No points give the empty hull, one half-space that nothing fulfils.

use super::direction::Direction;
use super::frame::Frame;
use super::point::{Point, Vector};
use crate::quantity::Length;

/// A convex region as an intersection of half-spaces.
///
/// ```
/// use steradian::geometry::{Hull, Point};
/// use steradian::quantity::Length;
/// let corners = (0..8_u8).map(|k| [k & 1, k >> 1 & 1, k >> 2].map(f64::from).into());
/// let cube = Hull::around(&corners.collect::<Vec<Point>>());
/// assert_eq!(cube.half_spaces().len(), 6);
/// assert!(cube.contains(Point::new(0.5, 0.5, 1.0)));
/// assert!(!cube.shrunk(Length::from_metres(0.1)).contains(Point::new(0.5, 0.5, 1.0)));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    half_spaces: Vec<[f64; 4]>,
}

impl Hull {
    /// Points that lie off a plane or a line by no more than this share of the points' extent count as on it.
    pub const ROUNDING: f64 = 1e-12;

    /// The hull of `points`.
    pub fn around(points: &[Point]) -> Self {
        let Some(&origin) = points.first() else {
            return Self {
                half_spaces: vec![[0.0, 0.0, 0.0, -1.0]],
            };
        };
        let relative: Vec<Vector> = points.iter().map(|&point| point - origin).collect();
        let mut builder = Builder::new(&relative);
        builder.add_faces();
        let to_world =
            |[x, y, z, d]: [f64; 4]| [x, y, z, d + Vector::new(x, y, z).dot(origin.to_vector())];
        Self {
            half_spaces: builder.half_spaces.into_iter().map(to_world).collect(),
        }
    }

    /// The region of all points that lie deeper than `margin` below every face. What only touches the hull from outside, like
    /// the neighbouring facets of a wall, is outside of it; a flat hull leaves nothing.
    #[must_use]
    pub fn shrunk(mut self, margin: Length) -> Self {
        for half_space in &mut self.half_spaces {
            half_space[3] -= margin.to_metres();
        }
        self
    }

    /// `[n_x, n_y, n_z, d]` of each face, n of length 1.
    pub fn half_spaces(&self) -> &[[f64; 4]] {
        &self.half_spaces
    }

    /// The half-spaces in coordinates whose origin is at `origin`.
    pub fn half_spaces_from(&self, origin: Point) -> Vec<[f64; 4]> {
        let moved =
            |&[x, y, z, d]: &[f64; 4]| [x, y, z, d - Vector::new(x, y, z).dot(origin.to_vector())];
        self.half_spaces.iter().map(moved).collect()
    }

    /// Whether a point lies in the region.
    pub fn contains(&self, point: Point) -> bool {
        let p = point.to_vector();
        self.half_spaces
            .iter()
            .all(|&[x, y, z, d]| Vector::new(x, y, z).dot(p) <= d)
    }
}

/// Finds the faces of points around the origin.
struct Builder<'a> {
    points: &'a [Vector],
    /// The size of what counts as no distance.
    tolerance: f64,
    half_spaces: Vec<[f64; 4]>,
}

impl<'a> Builder<'a> {
    fn new(points: &'a [Vector]) -> Self {
        let extent = points
            .iter()
            .fold(0.0_f64, |most, p| most.max(p.max_component()));
        Self {
            points,
            tolerance: Hull::ROUNDING * extent,
            half_spaces: Vec::new(),
        }
    }

    fn add_faces(&mut self) {
        let flat = self.add_planes_of_three();
        match (flat, self.half_spaces.is_empty()) {
            (Some(normal), _) => self.add_edges(normal),
            (None, true) => self.add_segment(),
            (None, false) => {}
        }
    }

    /// Faces through three points each; the normal, if one plane holds all points.
    fn add_planes_of_three(&mut self) -> Option<Direction> {
        let count = self.points.len();
        for i in 0..count {
            for j in i + 1..count {
                let first = self.points[j] - self.points[i];
                for k in j + 1..count {
                    let normal = self.normal(first, self.points[k] - self.points[i]);
                    let Some(normal) = normal else { continue };
                    let (below, above) = self.span(normal, self.points[i]);
                    if above <= self.tolerance {
                        self.add(normal);
                    }
                    if below >= -self.tolerance {
                        self.add(-normal);
                    }
                    if above <= self.tolerance && below >= -self.tolerance {
                        return Some(normal);
                    }
                }
            }
        }
        None
    }

    /// The normal of the plane of two vectors; none if they are parallel.
    fn normal(&self, a: Vector, b: Vector) -> Option<Direction> {
        let cross = a.cross(b);
        let longest = a.length().max(b.length());
        (cross.length() > self.tolerance * longest)
            .then(|| Direction::new(cross).ok())
            .flatten()
    }

    /// How far the points reach along a normal on both sides of one of them.
    fn span(&self, normal: Direction, from: Vector) -> (f64, f64) {
        let level = normal.dot(from);
        self.points.iter().fold((0.0, 0.0), |(below, above), &p| {
            let height = normal.dot(p) - level;
            (below.min(height), above.max(height))
        })
    }

    /// The half-space in which all points lie and one at least on its plane, unless it is known.
    fn add(&mut self, normal: Direction) {
        let d = self
            .points
            .iter()
            .fold(f64::NEG_INFINITY, |most, &p| most.max(normal.dot(p)));
        let [x, y, z] = normal.to_array();
        let known = self.half_spaces.iter().any(|known| {
            let turned = Vector::new(known[0] - x, known[1] - y, known[2] - z);
            turned.max_component() <= Hull::ROUNDING
        });
        if !known {
            self.half_spaces.push([x, y, z, d]);
        }
    }

    /// The edges of points in a plane.
    fn add_edges(&mut self, normal: Direction) {
        for i in 0..self.points.len() {
            for j in 0..self.points.len() {
                let along = self.points[j] - self.points[i];
                if along.length() <= self.tolerance {
                    continue;
                }
                let Ok(outwards) = Direction::new(along.cross(normal.to_vector())) else {
                    continue;
                };
                if self.span(outwards, self.points[i]).1 <= self.tolerance {
                    self.add(outwards);
                }
            }
        }
    }

    /// Six half-spaces around points on a line.
    fn add_segment(&mut self) {
        let longest = self
            .points
            .iter()
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let along = longest.and_then(|&p| Direction::new(p).ok());
        let frame = Frame::from_normal(along.unwrap_or(Direction::Z));
        for axis in [frame.normal(), frame.tangent(), frame.bitangent()] {
            self.add(axis);
            self.add(-axis);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, any_vector};
    use proptest::prelude::*;
    use steradian_kernel::{Accelerator, Geometry};

    fn points(coordinates: &[[f64; 3]]) -> Vec<Point> {
        coordinates.iter().map(|&xyz| xyz.into()).collect()
    }

    fn faces(coordinates: &[[f64; 3]]) -> usize {
        Hull::around(&points(coordinates)).half_spaces().len()
    }

    const SQUARE: [[f64; 3]; 4] = [
        [0.0, 0.0, 1.0],
        [2.0, 0.0, 1.0],
        [2.0, 2.0, 1.0],
        [0.0, 2.0, 1.0],
    ];

    #[test]
    fn faces_are_found_once() {
        let tetrahedron = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(faces(&tetrahedron), 4);
        let mut pyramid = SQUARE.to_vec();
        pyramid.push([1.0, 1.0, 5.0]);
        assert_eq!(faces(&pyramid), 5);
        pyramid.extend([[1.0, 1.0, 2.0], [0.5, 1.0, 1.0], [1.0, 1.0, 5.0]]);
        assert_eq!(faces(&pyramid), 5, "points inside, on a face and twice");
    }

    #[test]
    fn flat_hulls_have_edges_and_vanish_when_shrunk() {
        assert_eq!(faces(&SQUARE), 6);
        let hull = Hull::around(&points(&SQUARE));
        assert!(hull.contains([1.0, 1.9, 1.0].into()));
        for outside in [[1.0, 1.0, 1.001], [1.0, 1.0, 0.999], [2.1, 1.0, 1.0]] {
            assert!(!hull.contains(outside.into()));
        }
        let nothing = hull.shrunk(Length::from_metres(1e-9));
        assert!(!nothing.contains([1.0, 1.0, 1.0].into()));
    }

    #[test]
    fn a_segment_a_point_and_nothing() {
        let segment = Hull::around(&points(&[
            [1.0, 1.0, 1.0],
            [3.0, 1.0, 1.0],
            [2.0, 1.0, 1.0],
        ]));
        assert!(segment.contains([1.5, 1.0, 1.0].into()));
        assert!(
            !segment.contains([3.1, 1.0, 1.0].into()) && !segment.contains([2.0, 1.1, 1.0].into())
        );
        let point = Hull::around(&points(&[[1.0, 2.0, 3.0]; 2]));
        assert!(point.contains([1.0, 2.0, 3.0].into()) && !point.contains([1.0, 2.0, 3.1].into()));
        assert!(!Hull::around(&[]).contains(Point::ORIGIN));
    }

    /// Whether the shaft between `SQUARE` on the floor and a facet of a wall beside it is clear of a rectangle.
    fn shaft_is_clear(margin: f64, obstacle: [[f32; 3]; 4]) -> bool {
        let wall = [
            [4.0, 0.0, 1.0],
            [4.0, 2.0, 1.0],
            [4.0, 2.0, 3.0],
            [4.0, 0.0, 3.0],
        ];
        let corners = [points(&SQUARE), points(&wall)].concat();
        let hull = Hull::around(&corners).shrunk(Length::from_metres(margin));
        let geometry = Geometry {
            positions: obstacle.to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            quadrics: vec![],
        };
        let accelerator = Accelerator::build(&geometry).unwrap();
        accelerator.region_is_clear(hull.half_spaces(), &|_| false)
    }

    #[test]
    fn neighbours_that_touch_a_shaft_do_not_block_it() {
        let further_floor = [
            [2.0, 0.0, 1.0],
            [4.0, 0.0, 1.0],
            [4.0, 2.0, 1.0],
            [2.0, 2.0, 1.0],
        ];
        let higher_wall = [
            [4.0, 0.0, 3.0],
            [4.0, 2.0, 3.0],
            [4.0, 2.0, 5.0],
            [4.0, 0.0, 5.0],
        ];
        let side = [
            [0.0, 0.0, 1.0],
            [4.0, 0.0, 1.0],
            [4.0, 0.0, 3.0],
            [0.0, 0.0, 3.0],
        ];
        for neighbour in [further_floor, higher_wall, side] {
            assert!(!shaft_is_clear(0.0, neighbour), "touching counts");
            assert!(shaft_is_clear(1e-5, neighbour));
        }
        let between = [
            [3.0, 1.0, 1.0],
            [3.5, 1.0, 1.0],
            [3.5, 1.0, 1.5],
            [3.0, 1.0, 1.5],
        ];
        assert!(!shaft_is_clear(1e-5, between));
    }

    proptest! {
        #[test]
        fn all_points_and_what_lies_between_are_inside(
            corners in prop::collection::vec(any_vector(3.0), 1..9), shift in any_vector(100.0), weights in prop::array::uniform8(0.01..1.0_f64),
        ) {
            let corners: Vec<Point> = corners.into_iter().map(|corner| Point::ORIGIN + (corner + shift)).collect();
            // Rounding of coordinates of some 100 m: a few times 100 · 2⁻⁵².
            let hull = Hull::around(&corners).shrunk(Length::from_metres(-1e-12));
            let total: f64 = weights[..corners.len()].iter().sum();
            let offsets = corners.iter().zip(&weights).map(|(&corner, w)| (corner - corners[0]) * (w / total));
            let mean = corners[0] + offsets.fold(Vector::ZERO, |sum, offset| sum + offset);
            prop_assert!(corners.iter().all(|&corner| hull.contains(corner)) && hull.contains(mean));
        }

        /// For a point far out along any direction there is a face that it lies beyond by as much as it lies beyond the points,
        /// less what the angle between direction and face takes: none of the points may be near it.
        #[test]
        fn what_lies_beyond_all_points_is_outside(
            corners in prop::collection::vec(any_vector(3.0), 4..9), towards in any_direction(), beyond in 1e-6..1.0_f64,
        ) {
            let corners: Vec<Point> = corners.into_iter().map(|corner| Point::ORIGIN + corner).collect();
            let most = corners.iter().map(|corner| towards.dot(corner.to_vector())).fold(f64::NEG_INFINITY, f64::max);
            let hull = Hull::around(&corners);
            for across in [Vector::ZERO, Direction::X.to_vector(), Direction::Y.to_vector(), Direction::Z.to_vector()] {
                let level = across - towards * towards.dot(across);
                prop_assert!(!hull.contains(Point::ORIGIN + (level + towards * (most + beyond))));
            }
        }

        #[test]
        fn a_flat_hull_is_as_thin_as_rounding(
            flat in prop::collection::vec(prop::array::uniform2(-3.0..3.0_f64), 3..9), normal in any_direction(),
        ) {
            let frame = Frame::from_normal(normal);
            let world = |[x, y]: [f64; 2]| Point::ORIGIN + frame.vector_to_world(Vector::new(x, y, 0.0));
            let corners: Vec<Point> = flat.iter().map(|&xy| world(xy)).collect();
            let hull = Hull::around(&corners);
            let first = flat[0];
            prop_assert!(!hull.contains(world(first) + normal * 1e-9) && !hull.contains(world(first) - normal * 1e-9));
            prop_assert!(!hull.contains(world([4.3, first[1]])), "beyond every corner in the plane");
        }
    }
}
