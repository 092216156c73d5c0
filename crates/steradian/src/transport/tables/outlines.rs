//! Outlines of emitters in f64: what closed forms and samplers by solid angle need to know of them.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use crate::geometry::{Direction, Frame, Point};
use crate::light::AreaLight;
use crate::scene::Scene;
use crate::shape::{Disc, Form, TriangleMesh};

/// Emitters of more facets are sampled by area: each facet costs a closed form wherever the emitter is sampled.
pub(in crate::transport) const MOST_FACETS: usize = 16;

/// An emitter of the same radiance everywhere.
#[derive(Clone, Debug)]
pub(in crate::transport) enum Outline {
    /// Convex polygons.
    Facets(Vec<Facet>),
    /// A whole sphere that shines outwards.
    Sphere { center: Point, radius: f64 },
    /// A disc or ring, within a polygon around it.
    Disc(Disc, Facet),
}

/// A convex polygon that emits, with the primitives that it is made of.
#[derive(Clone, Debug)]
pub(in crate::transport) struct Facet {
    pub corners: Vec<Point>,
    pub normal: Direction,
    pub primitives: Range<u32>,
}

/// The outline of a light's shape; none for one that has textures, ports or too many facets.
pub(super) fn outline(scene: &Scene, light: &AreaLight) -> Option<Outline> {
    if !light.textures.is_empty() {
        return None;
    }
    let surfaces = scene.surfaces();
    let first = surfaces.first_primitive(light.shape);
    match &surfaces.shape(light.shape).form {
        Form::Parallelogram(form) => Some(Outline::Facets(vec![Facet {
            corners: form.corners().to_vec(),
            normal: form.normal,
            primitives: first..first + 2,
        }])),
        Form::Mesh(mesh) if mesh.triangles.len() <= MOST_FACETS => {
            Some(Outline::Facets(triangles(mesh, first)))
        }
        Form::Sphere(sphere) if sphere.ports.is_empty() && (!sphere.inside || light.two_sided) => {
            Some(Outline::Sphere {
                center: sphere.center,
                radius: sphere.radius,
            })
        }
        Form::Disc(disc) => Some(Outline::Disc(disc.clone(), around(disc, first))),
        Form::Mesh(_) | Form::Sphere(_) | Form::Plane { .. } => None,
    }
}

/// Sides of the polygon around a round light: its area is 1.003 of the disc's.
pub(in crate::transport) const SIDES: u32 = 32;

/// Corners around the unit circle, as cosine and sine of the azimuth times 1/cos(π/n), so that the circle touches the sides.
pub(in crate::transport) fn circumscribed() -> impl Iterator<Item = [f64; 2]> {
    let radius = 1.0 / libm::cos(PI / f64::from(SIDES));
    (0..SIDES).map(move |k| {
        let (sin, cos) = libm::sincos(TAU * f64::from(k) / f64::from(SIDES));
        [radius * cos, radius * sin]
    })
}

fn around(disc: &Disc, primitive: u32) -> Facet {
    let frame = Frame::from_normal(disc.normal);
    let corner = |[x, y]: [f64; 2]| {
        disc.center + frame.tangent() * (disc.radius * x) + frame.bitangent() * (disc.radius * y)
    };
    Facet {
        corners: circumscribed().map(corner).collect(),
        normal: disc.normal,
        primitives: primitive..primitive + 1,
    }
}

/// The triangles that have an area.
fn triangles(mesh: &TriangleMesh, first: u32) -> Vec<Facet> {
    let facet = |number: usize| {
        let corners = mesh.corners(number);
        let [a, b, c] = corners;
        let primitive = first + number as u32;
        Some(Facet {
            normal: Direction::new((b - a).cross(c - a)).ok()?,
            corners: corners.to_vec(),
            primitives: primitive..primitive + 1,
        })
    };
    (0..mesh.triangles.len()).filter_map(facet).collect()
}

impl Facet {
    /// Metres of a point above the plane, on the side of the front.
    pub fn height_of(&self, point: Point) -> f64 {
        self.normal.dot(point - self.corners[0])
    }

    /// Whether its light goes where a point is.
    pub fn faces(&self, point: Point, two_sided: bool) -> bool {
        let height = self.height_of(point);
        height > 0.0 || (two_sided && height < 0.0)
    }
}
