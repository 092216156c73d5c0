//! Plane polygons with holes: checked once, then triangulated.
//!
//! The outline runs counter-clockwise as seen from the front; its area vector
//!
//! A n = ½ Σ (pᵢ − p₀) × (pᵢ₊₁ − p₀)
//!
//! (M. E. Newell's rule, see Sutherland, Sproull & Schumacker, ACM Computing Surveys 6 (1), 1974, p. 15) gives the
//! normal, and with the areas of the holes subtracted the area. Holes may run either way round. Triangles come from
//! ear clipping; their areas must add up to the polygon's, which they do only if no edges cross and all holes lie
//! inside and apart.
//!
//! ```
//! use steradian::geometry::{Direction, Point, Polygon};
//! let square = |half: f64| {
//!     [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| Point::new(x, y, 0.0)).to_vec()
//! };
//! let frame = Polygon::new(square(2.0), vec![square(1.0)])?;
//! assert_eq!(frame.area().to_square_metres(), 12.0);
//! assert_eq!(frame.normal(), Direction::Z);
//! assert_eq!(frame.triangles().len(), 8);
//! # Ok::<(), steradian::geometry::PolygonError>(())
//! ```

mod validity;
mod view;

use super::bounds::Bounds;
use super::direction::Direction;
use super::frame::Frame;
use super::point::{Point, Vector};
use super::transform::Transform;
use crate::quantity::{Area, Length};
pub use validity::PolygonError;
use validity::{check_planar, check_vertices};

/// A polygon in a plane, with its triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// The outline, then the holes.
    vertices: Vec<Point>,
    /// Where each ring ends in `vertices`, the outline first.
    ring_ends: Vec<usize>,
    normal: Direction,
    area: Area,
    triangles: Vec<[u32; 3]>,
}

impl Polygon {
    /// How far a vertex may lie off the plane in [`Polygon::new`], as a fraction of the polygon's diameter.
    pub const PLANARITY_TOLERANCE: f64 = 1e-6;

    /// The areas of triangles and polygon may differ by this fraction before edges are taken to cross.
    const AREA_TOLERANCE: f64 = 1e-9;

    /// A polygon by its outline, counter-clockwise from the front, and its holes.
    ///
    /// # Errors
    /// If the rings do not bound a plane area; see [`PolygonError`].
    pub fn new(outline: Vec<Point>, holes: Vec<Vec<Point>>) -> Result<Self, PolygonError> {
        let tolerance =
            Bounds::around(outline.iter().copied()).diagonal() * Self::PLANARITY_TOLERANCE;
        Self::with_tolerance(outline, holes, tolerance)
    }

    /// The same, with vertices allowed to lie `tolerance` off the plane.
    ///
    /// # Errors
    /// If the rings do not bound a plane area; see [`PolygonError`].
    pub fn with_tolerance(
        outline: Vec<Point>,
        holes: Vec<Vec<Point>>,
        tolerance: Length,
    ) -> Result<Self, PolygonError> {
        let rings: Vec<Vec<Point>> = std::iter::once(outline).chain(holes).collect();
        check_vertices(&rings)?;
        let outline_area = area_vector(&rings[0]);
        let normal = Direction::new(outline_area).map_err(|_| PolygonError::ZeroArea)?;
        let holes: f64 = rings[1..]
            .iter()
            .map(|hole| normal.dot(area_vector(hole)).abs())
            .sum();
        let area = outline_area.length() - holes;
        let diameter = Bounds::around(rings[0].iter().copied()).diagonal();
        // Rounding alone gives points on a line an area of some 2⁻⁵² of the diameter's square.
        if area <= 1e-14 * diameter.squared().to_square_metres() {
            return Err(PolygonError::ZeroArea);
        }
        check_planar(&rings, normal, tolerance)?;
        let polygon = Self::triangulated(rings, normal, Area::from_square_metres(area));
        let excess = (polygon.area_of_triangles() - polygon.area).abs() / polygon.area;
        if excess <= Self::AREA_TOLERANCE {
            Ok(polygon)
        } else {
            Err(PolygonError::CrossingEdges)
        }
    }

    fn triangulated(rings: Vec<Vec<Point>>, normal: Direction, area: Area) -> Self {
        let ring_ends: Vec<usize> = rings
            .iter()
            .scan(0, |end, ring| {
                *end += ring.len();
                Some(*end)
            })
            .collect();
        let vertices: Vec<Point> = rings.into_iter().flatten().collect();
        let frame = Frame::from_normal(normal);
        let flat = vertices.iter().map(|&vertex| {
            let local = frame.vector_to_local(vertex - vertices[0]);
            [local.x, local.y]
        });
        let hole_starts: Vec<u32> = ring_ends[..ring_ends.len() - 1]
            .iter()
            .map(|&end| end as u32)
            .collect();
        let mut corners: Vec<u32> = Vec::new();
        earcut::Earcut::new().earcut(flat, &hole_starts, &mut corners);
        let triangles = corners
            .chunks_exact(3)
            .map(|c| facing(normal, [c[0], c[1], c[2]], &vertices))
            .collect();
        Self {
            vertices,
            ring_ends,
            normal,
            area,
            triangles,
        }
    }

    /// All vertices: the outline, then the holes.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// The outline, counter-clockwise from the front.
    pub fn outline(&self) -> &[Point] {
        &self.vertices[..self.ring_ends[0]]
    }

    /// The outlines of the holes.
    pub fn holes(&self) -> impl ExactSizeIterator<Item = &[Point]> {
        self.ring_ends
            .windows(2)
            .map(|ends| &self.vertices[ends[0]..ends[1]])
    }

    /// The direction the front faces.
    pub const fn normal(&self) -> Direction {
        self.normal
    }

    /// The area of one side, without the holes.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// Triangles that cover the polygon once, as indices into [`vertices`](Self::vertices), counter-clockwise from the
    /// front.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of each triangle.
    pub fn triangle_corners(&self) -> impl ExactSizeIterator<Item = [Point; 3]> {
        self.triangles
            .iter()
            .map(|triangle| triangle.map(|index| self.vertices[index as usize]))
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        Bounds::around(self.outline().iter().copied())
    }

    /// The image of the polygon; its front is the image of this front, also if the transform mirrors.
    ///
    /// # Errors
    /// If the image is no polygon: the transform flattens it or is not finite.
    pub fn transformed(&self, transform: &Transform) -> Result<Self, PolygonError> {
        let image = |ring: &[Point]| {
            let mut ring: Vec<Point> = ring.iter().map(|&vertex| transform.point(vertex)).collect();
            if transform.is_mirroring() {
                ring.reverse();
            }
            ring
        };
        // An affine image of a plane is a plane: there is nothing to check.
        let tolerance = Length::from_metres(f64::INFINITY);
        let holes = self.holes().map(image).collect();
        Self::with_tolerance(image(self.outline()), holes, tolerance)
    }

    /// Of the triangles' projections onto the plane.
    fn area_of_triangles(&self) -> Area {
        let area = |corners: [Point; 3]| self.normal.dot(area_vector(&corners));
        Area::from_square_metres(self.triangle_corners().map(area).sum())
    }
}

/// A n = ½ Σ (pᵢ − p₀) × (pᵢ₊₁ − p₀).
pub(super) fn area_vector(ring: &[Point]) -> Vector {
    let cross = |edge: &[Point]| (edge[0] - ring[0]).cross(edge[1] - ring[0]);
    ring.windows(2)
        .map(cross)
        .fold(Vector::ZERO, |sum, term| sum + term)
        * 0.5
}

/// The triangle turned so that it is counter-clockwise around `normal`.
fn facing(normal: Direction, [a, b, c]: [u32; 3], vertices: &[Point]) -> [u32; 3] {
    let corners = [a, b, c].map(|index| vertices[index as usize]);
    if normal.dot(area_vector(&corners)) < 0.0 {
        [a, c, b]
    } else {
        [a, b, c]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use crate::quantity::Angle;
    use proptest::prelude::*;

    fn flat<const N: usize>(corners: [(f64, f64); N]) -> Vec<Point> {
        corners.map(|(x, y)| Point::new(x, y, 0.0)).to_vec()
    }

    fn square(half: f64) -> Vec<Point> {
        flat([(-half, -half), (half, -half), (half, half), (-half, half)])
    }

    #[test]
    fn an_l_shape_and_its_winding() {
        let corners = flat([
            (0.0, 0.0),
            (2.0, 0.0),
            (2.0, 1.0),
            (1.0, 1.0),
            (1.0, 2.0),
            (0.0, 2.0),
        ]);
        let polygon = Polygon::new(corners.clone(), vec![]).unwrap();
        assert_eq!(polygon.area().to_square_metres(), 3.0);
        assert_eq!(
            (polygon.triangles().len(), polygon.normal()),
            (4, Direction::Z)
        );
        let reversed = Polygon::new(corners.into_iter().rev().collect(), vec![]).unwrap();
        assert_eq!(
            (reversed.area(), reversed.normal()),
            (polygon.area(), -Direction::Z)
        );
        assert!(
            reversed
                .triangle_corners()
                .all(|corners| area_vector(&corners).z < 0.0)
        );
    }

    #[test]
    fn what_is_no_polygon_is_told_why() {
        let error =
            |outline: Vec<Point>, holes: Vec<Vec<Point>>| Polygon::new(outline, holes).unwrap_err();
        assert_eq!(
            error(square(1.0)[..2].to_vec(), vec![]),
            PolygonError::TooFewVertices { ring: 0, count: 2 }
        );
        assert_eq!(
            error(square(1.0), vec![vec![]]),
            PolygonError::TooFewVertices { ring: 1, count: 0 }
        );
        let mut broken = square(1.0);
        broken[2].y = f64::NAN;
        assert_eq!(
            error(broken, vec![]),
            PolygonError::NotFinite { ring: 0, vertex: 2 }
        );
        assert_eq!(
            error(flat([(0.1, 0.1), (0.2, 0.2), (0.7, 0.7)]), vec![]),
            PolygonError::ZeroArea
        );
        assert_eq!(error(flat([(1.0, 1.0); 3]), vec![]), PolygonError::ZeroArea);
        assert_eq!(
            error(square(1.0), vec![square(1.0)]),
            PolygonError::ZeroArea
        );
        let crossed = flat([(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, -1.0), (0.0, 2.0)]);
        assert_eq!(error(crossed, vec![]), PolygonError::CrossingEdges);
        let outside = square(0.5)
            .into_iter()
            .map(|p| p + Vector::new(5.0, 0.0, 0.0))
            .collect();
        assert_eq!(
            error(square(1.0), vec![outside]),
            PolygonError::CrossingEdges
        );
    }

    #[test]
    fn a_vertex_off_the_plane_is_named_with_its_distance() {
        let mut bent = square(1.0);
        bent[3].z = 0.4;
        let PolygonError::NotPlanar {
            distance,
            tolerance,
            ..
        } = Polygon::new(bent.clone(), vec![]).unwrap_err()
        else {
            panic!("not planar");
        };
        // Newell's normal of a square with one raised corner leaves all four corners 0.1 cosα off, tanα = 0.4/(2√2).
        let expected = 0.1 / (1.0 + 0.02_f64).sqrt();
        assert!(close(distance.to_metres(), expected, 1e-15), "{distance}");
        assert!(close(tolerance.to_metres(), 1e-6 * 8.16_f64.sqrt(), 1e-15));
        assert!(Polygon::with_tolerance(bent, vec![], Length::from_metres(0.1)).is_ok());
        let raised = square(0.5)
            .into_iter()
            .map(|p| p + Vector::new(0.0, 0.0, 0.1))
            .collect();
        let error = Polygon::new(square(1.0), vec![raised])
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("of hole 1 lies 0.1 m off the plane"),
            "{error}"
        );
    }

    #[test]
    fn a_mirrored_polygon_keeps_its_front() {
        let polygon = Polygon::new(square(2.0), vec![square(1.0)]).unwrap();
        let image = polygon
            .transformed(&Transform::scale_axes([-1.0, 1.0, 1.0]))
            .unwrap();
        assert_eq!(
            (image.normal(), image.area()),
            (polygon.normal(), polygon.area())
        );
        assert_eq!(image.holes().len(), 1);
        let flattened = polygon.transformed(&Transform::scale_axes([1.0, 0.0, 1.0]));
        assert_eq!(flattened, Err(PolygonError::ZeroArea));
    }

    fn any_ring() -> impl Strategy<Value = Vec<Point>> {
        let corner =
            (0..5_i32, 0..5_i32).prop_map(|(x, y)| Point::new(f64::from(x), f64::from(y), 0.0));
        prop::collection::vec(corner, 0..9)
    }

    proptest! {
        #[test]
        fn rings_on_a_small_grid_are_covered_once_or_refused(
            outline in any_ring(), holes in prop::collection::vec(any_ring(), 0..3),
        ) {
            if let Ok(polygon) = Polygon::new(outline, holes) {
                prop_assert!(close(polygon.area_of_triangles() / polygon.area(), 1.0, 1e-9));
                prop_assert!(polygon.triangle_corners().all(|c| polygon.normal().dot(area_vector(&c)) >= 0.0));
            }
        }

        #[test]
        fn stars_have_the_area_of_their_sectors(
            radii in prop::collection::vec(0.2..2.0_f64, 3..40),
            axis in any_direction(), angle in 0.0..360.0_f64, step in any_vector(5.0),
        ) {
            let turn = std::f64::consts::TAU / radii.len() as f64;
            let corner = |(index, radius): (usize, &f64)| {
                let (sin, cos) = libm::sincos(turn * index as f64);
                Point::new(radius * cos, radius * sin, 0.0)
            };
            let outline: Vec<Point> = radii.iter().enumerate().map(corner).collect();
            let pairs = radii.iter().zip(radii.iter().cycle().skip(1));
            let expected: f64 = pairs.map(|(a, b)| a * b * libm::sin(turn) / 2.0).sum();
            let transform = Transform::rotate(axis, Angle::from_degrees(angle), Point::ORIGIN)
                .then(Transform::translate(step));
            let star = Polygon::new(outline, vec![]).unwrap().transformed(&transform).unwrap();
            prop_assert!(close(star.area().to_square_metres() / expected, 1.0, 1e-13));
            prop_assert!(close(star.area_of_triangles() / star.area(), 1.0, 1e-12));
            prop_assert!(close(star.normal().dot(transform.normal(Direction::Z).unwrap()), 1.0, 1e-14));
            prop_assert!(star.triangle_corners().all(|corners| star.normal().dot(area_vector(&corners)) > -1e-12));
        }
    }
}
