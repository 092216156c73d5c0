//! What is looked at.

use steradian::estimation::Estimate;
use steradian::geometry::solid_angle::SphericalPolygonError;
use steradian::geometry::{
    Bounds, Direction, Point, SphericalPatch, Vector, configuration_factor, solid_angle,
};
use steradian::quantity::{Angle, Length, ProjectedSolidAngle};

use super::mesh::{self, Sampling};
use crate::status::Failure;

/// An object, or a set of directions.
pub enum Object {
    /// A ball.
    Sphere { center: Point, radius: Length },
    /// Directions around the Z axis.
    Cap(Angle),
    /// A flat disc.
    Disc {
        center: Point,
        normal: Direction,
        radius: Length,
    },
    /// A flat ellipse.
    Ellipse {
        center: Point,
        half_axes: [Vector; 2],
    },
    /// An outline of points.
    Polygon(Vec<Point>),
    /// An outline of directions.
    SphericalPolygon(Vec<Direction>),
    /// A box along the axes.
    Box(Bounds),
    /// The triangles of a mesh.
    Mesh(Vec<[Point; 3]>),
    /// A rectangle of latitude and longitude.
    Patch(SphericalPatch),
}

impl Object {
    /// ω in sr: how much of the observer's view it fills.
    pub fn solid_angle(
        &self,
        observer: Point,
        sampling: &mut Sampling,
    ) -> Result<Estimate, Failure> {
        let found = match self {
            Self::Sphere { center, radius } => solid_angle::of_sphere(observer, *center, *radius),
            Self::Cap(half_angle) => solid_angle::of_cap(*half_angle),
            Self::Disc {
                center,
                normal,
                radius,
            } => solid_angle::of_disc(observer, *center, *normal, *radius),
            Self::Ellipse { center, half_axes } => {
                solid_angle::of_ellipse(observer, *center, *half_axes)
            }
            Self::Polygon(outline) => solid_angle::of_polygon(observer, outline),
            Self::SphericalPolygon(corners) => {
                solid_angle::of_spherical_polygon(corners).map_err(no_outline)?
            }
            Self::Box(bounds) => solid_angle::of_box(observer, bounds),
            Self::Patch(patch) => patch.solid_angle(),
            Self::Mesh(triangles) => return mesh::solid_angle(triangles, observer, sampling),
        };
        Ok(Estimate::closed_form(found.to_steradians()))
    }

    /// Ω = ∫ cosθ dω in sr, above the horizon of an element of this normal at the observer.
    pub fn projected_solid_angle(
        &self,
        observer: Point,
        normal: Direction,
        sampling: &mut Sampling,
    ) -> Result<Estimate, Failure> {
        let factor = match self {
            Self::Sphere { center, radius } => {
                configuration_factor::of_sphere(observer, normal, *center, *radius)
            }
            Self::Cap(half_angle) => {
                configuration_factor::of_cap(normal, Direction::Z, *half_angle)
            }
            Self::Disc {
                center,
                normal: axis,
                radius,
            } => configuration_factor::of_disc(observer, normal, *center, *axis, *radius),
            Self::Ellipse { center, half_axes } => {
                configuration_factor::of_ellipse(observer, normal, *center, *half_axes)
            }
            Self::Polygon(outline) => configuration_factor::of_polygon(observer, normal, outline),
            Self::SphericalPolygon(corners) => {
                configuration_factor::of_spherical_polygon(normal, corners).map_err(no_outline)?
            }
            Self::Box(bounds) => faces(bounds)
                .iter()
                .filter(|face| shows_front(observer, &face[..3]))
                .map(|face| configuration_factor::of_polygon(observer, normal, face))
                .sum(),
            Self::Patch(patch) => configuration_factor::of_patch(normal, patch),
            Self::Mesh(triangles) => {
                return mesh::projected_solid_angle(triangles, observer, normal, sampling);
            }
        };
        let found = ProjectedSolidAngle::HEMISPHERE * factor;
        Ok(Estimate::closed_form(found.to_steradians()))
    }
}

fn no_outline(error: SphericalPolygonError) -> Failure {
    Failure::Other(error.into())
}

/// The faces of a box, counter-clockwise seen from outside.
pub fn faces(bounds: &Bounds) -> [[Point; 4]; 6] {
    let ends = [bounds.min().to_array(), bounds.max().to_array()];
    let corner =
        |sides: [usize; 3]| Point::new(ends[sides[0]][0], ends[sides[1]][1], ends[sides[2]][2]);
    [0, 1, 2, 3, 4, 5].map(|face| {
        let (axis, side) = (face / 2, face % 2);
        let square = if side == 1 {
            [[0, 0], [1, 0], [1, 1], [0, 1]]
        } else {
            [[0, 0], [0, 1], [1, 1], [1, 0]]
        };
        square.map(|[u, v]| {
            let mut sides = [side; 3];
            (sides[(axis + 1) % 3], sides[(axis + 2) % 3]) = (u, v);
            corner(sides)
        })
    })
}

/// Whether three corners run counter-clockwise as the observer sees them.
pub fn shows_front(observer: Point, corners: &[Point]) -> bool {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    normal.dot(observer - corners[0]) > 0.0
}
