//! What is looked at.

use steradian::geometry::{
    Bounds, Direction, Point, SphericalPatch, Vector, configuration_factor, solid_angle,
};
use steradian::quantity::{Angle, Length, ProjectedSolidAngle, SolidAngle};

use crate::status::Failure;

/// A vertex may lie this part of the mesh's diameter before the plane of a triangle of a convex mesh: rounding of coordinates
/// in single precision.
const FLATNESS: f64 = 1e-6;

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
    /// The triangles of a closed mesh.
    Mesh(Vec<[Point; 3]>),
    /// A rectangle of latitude and longitude.
    Patch(SphericalPatch),
}

impl Object {
    /// How much of the observer's view it fills.
    pub fn solid_angle(&self, observer: Point) -> Result<SolidAngle, Failure> {
        Ok(match self {
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
            Self::SphericalPolygon(corners) => solid_angle::of_spherical_polygon(corners)
                .map_err(|error| Failure::Other(error.into()))?,
            Self::Box(bounds) => solid_angle::of_box(observer, bounds),
            Self::Mesh(triangles) => of_mesh(observer, triangles)?,
            Self::Patch(patch) => patch.solid_angle(),
        })
    }

    /// Ω = ∫ cosθ dω above the horizon of an element of this normal at the observer.
    pub fn projected_solid_angle(
        &self,
        observer: Point,
        normal: Direction,
    ) -> Result<ProjectedSolidAngle, Failure> {
        let factor = match self {
            Self::Sphere { center, radius } => {
                configuration_factor::of_sphere(observer, normal, *center, *radius)
            }
            Self::Disc {
                center,
                normal: axis,
                radius,
            } => configuration_factor::of_disc(observer, normal, *center, *axis, *radius),
            Self::Polygon(outline) => configuration_factor::of_polygon(observer, normal, outline),
            Self::Box(bounds) => faces(bounds)
                .iter()
                .filter(|face| shows_front(observer, &face[..3]))
                .map(|face| configuration_factor::of_polygon(observer, normal, face))
                .sum(),
            Self::Cap(half_angle) if *half_angle < Angle::QUARTER_TURN => {
                let radius = Length::from_metres(half_angle.sin());
                configuration_factor::of_sphere(
                    Point::ORIGIN,
                    normal,
                    Point::new(0.0, 0.0, 1.0),
                    radius,
                )
            }
            _ => {
                let known =
                    "spheres, caps below 90 deg, discs, rectangles, triangles, polygons and boxes";
                return Err(Failure::message(format!(
                    "--projected is known for {known} only"
                )));
            }
        };
        Ok(ProjectedSolidAngle::HEMISPHERE * factor)
    }
}

/// 4π from inside a closed mesh, by its faces from outside a convex one.
fn of_mesh(observer: Point, triangles: &[[Point; 3]]) -> Result<SolidAngle, Failure> {
    let winding = solid_angle::winding_number(observer, triangles.iter().copied());
    if (winding.abs() - 1.0).abs() < 1e-9 {
        return Ok(SolidAngle::SPHERE);
    }
    if winding.abs() > 1e-9 && !is_half(winding) {
        return Err(Failure::message(format!(
            "the mesh is not closed: it goes around the observer {winding} times; steradian inspect tells where"
        )));
    }
    if !is_convex(triangles) {
        let most = solid_angle::of_convex_mesh(observer, triangles.iter().copied()).to_steradians();
        return Err(Failure::message(format!(
            "the mesh is not convex, so some of it may hide other parts: no closed form; it fills at most {most} sr"
        )));
    }
    Ok(solid_angle::of_convex_mesh(
        observer,
        triangles.iter().copied(),
    ))
}

/// On a face of a closed mesh.
fn is_half(winding: f64) -> bool {
    (winding.abs() - 0.5).abs() < 1e-9
}

/// Whether no vertex is before the plane of any triangle, all of which face outwards or all inwards.
fn is_convex(triangles: &[[Point; 3]]) -> bool {
    let vertices = || triangles.iter().flatten().copied();
    let slack = FLATNESS * Bounds::around(vertices()).diagonal().to_metres();
    let is_behind = |triangle: &[Point; 3], side: f64| {
        let [a, b, c] = *triangle;
        Direction::new((b - a).cross(c - a)).map_or(true, |normal| {
            vertices().all(|vertex| side * normal.dot(vertex - a) <= slack)
        })
    };
    [1.0, -1.0]
        .iter()
        .any(|&side| triangles.iter().all(|triangle| is_behind(triangle, side)))
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
