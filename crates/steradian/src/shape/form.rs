//! One shape in world coordinates.

use crate::geometry::{Bounds, Direction, Point, Vector};

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

    /// What it is called in lists; polygons and boxes are meshes here.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Parallelogram(_) => "rectangle",
            Self::Mesh(_) => "mesh",
            Self::Sphere(_) => "sphere",
            Self::Disc(_) => "disc",
            Self::Plane { .. } => "ground",
        }
    }

    /// The smallest box around it, a little wide for a disc; `None` for a plane.
    pub fn bounds(&self) -> Option<Bounds> {
        match self {
            Self::Parallelogram(form) => Some(Bounds::around(form.corners())),
            Self::Mesh(form) => Some(Bounds::around(form.vertices.iter().copied())),
            Self::Sphere(form) => Some(ball(form.center, form.radius)),
            Self::Disc(form) => Some(ball(form.center, form.radius)),
            Self::Plane { .. } => None,
        }
    }
}

fn ball(center: Point, radius: f64) -> Bounds {
    let corner = Vector::new(radius, radius, radius);
    Bounds::around([center - corner, center + corner])
}
