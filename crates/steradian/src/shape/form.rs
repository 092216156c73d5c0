//! One shape in world coordinates.

use crate::geometry::{Direction, Point};

use super::{Disc, Parallelogram, Sphere, TriangleMesh};

/// A point on a surface, drawn uniformly by area.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct AreaSample {
    /// Where.
    pub point: Point,
    /// Normal of the front there.
    pub normal: Direction,
    /// Number of the triangle of a mesh, else 0.
    pub face: usize,
}

/// The closed set of shapes.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A parallelogram.
    Parallelogram(Parallelogram),
    /// Triangles: polygons, boxes, meshes.
    Mesh(TriangleMesh),
    /// A sphere.
    Sphere(Sphere),
    /// A disc.
    Disc(Disc),
    /// An infinite plane.
    Plane {
        /// A point of it.
        point: Point,
        /// Normal of the front.
        normal: Direction,
    },
}

impl Form {
    /// A in m²; infinite for a plane.
    pub fn area(&self) -> f64 {
        match self {
            Self::Parallelogram(form) => form.area,
            Self::Mesh(form) => form.area(),
            Self::Sphere(form) => form.area(),
            Self::Disc(form) => form.area(),
            Self::Plane { .. } => f64::INFINITY,
        }
    }

    /// Area of the domain of [`sample_area`](Self::sample_area); more than [`area`](Self::area) for a sphere with ports.
    pub fn sampling_area(&self) -> f64 {
        match self {
            Self::Sphere(form) => form.full_area(),
            _ => self.area(),
        }
    }

    /// A point of uniform density 1/[`sampling_area`](Self::sampling_area); `None` outside the shape and on a plane.
    pub fn sample_area(&self, u: [f64; 2]) -> Option<AreaSample> {
        match self {
            Self::Parallelogram(form) => Some(form.sample_area(u)),
            Self::Mesh(form) => form.sample_area(u),
            Self::Sphere(form) => form.sample_area(u),
            Self::Disc(form) => Some(form.sample_area(u)),
            Self::Plane { .. } => None,
        }
    }

    /// What the form is called in messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Parallelogram(_) => "rectangle",
            Self::Mesh(_) => "mesh",
            Self::Sphere(_) => "sphere",
            Self::Disc(_) => "disc",
            Self::Plane { .. } => "ground",
        }
    }

    /// Whether `point` lies within a solid of which this is the outer surface (by more than `margin` metres).
    pub fn encloses(&self, point: Point, margin: f64) -> bool {
        match self {
            Self::Sphere(form) if !form.inside && form.ports.is_empty() => {
                (point - form.center).length() < form.radius - margin
            }
            Self::Mesh(mesh) => {
                mesh.is_closed() && mesh.signed_volume() > 0.0 && winding_number(mesh, point) > 0.9
            }
            _ => false,
        }
    }
}

/// Solid angle of the mesh from `point` over 4π: 1 inside a closed mesh that faces outwards, 0 outside
/// (Jacobson, Kavan & Sorkine-Hornung 2013), by the triangle formula of Van Oosterom & Strackee (1983).
fn winding_number(mesh: &TriangleMesh, point: Point) -> f64 {
    let solid_angles = (0..mesh.triangles.len()).map(|index| {
        let [a, b, c] = mesh.corners(index).map(|corner| corner - point);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let triple = a.dot(b.cross(c));
        let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * libm::atan2(triple, denominator)
    });
    solid_angles.sum::<f64>() / (4.0 * std::f64::consts::PI)
}
