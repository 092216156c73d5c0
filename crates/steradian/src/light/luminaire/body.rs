//! The surface of a luminous opening, and how large it looks.
//!
//! | opening | surface |
//! |---|---|
//! | rectangle, disc | itself, shining to both sides |
//! | ellipse | a polygon of 32 sides with its area |
//! | sphere | itself |
//! | box | itself |
//! | cylinder | a prism over the polygon of 32 sides that has the area of its end |
//! | ellipsoid | 12 rings of 32 facets with corners on it |
//!
//! What looks how large is a closed form: of a convex body, whose facets have the area vectors aᵢ (normal times area), a direction d
//! sees A_p = ½ Σ |aᵢ·d|; of a sphere π r². A flat opening counts as two facets back to back.
//!
//! Source: A. Cauchy, *Mémoire sur la rectification des courbes et la quadrature des surfaces courbées* (1832): each line through a
//! convex body meets its surface twice.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::Opening;
use crate::geometry::{Direction, Frame, Point, Vector};
use crate::shape::{Disc, Form, Parallelogram, Sphere, TriangleMesh};

/// Sides of what stands for something round.
const SIDES: usize = 32;
/// Rings of what stands for an ellipsoid.
const RINGS: usize = 12;

/// What a luminous opening shines from.
#[derive(Clone, Debug)]
pub struct Body {
    /// The surface, in the world; a flat one faces along the luminaire's aim.
    pub form: Form,
    /// Both sides shine.
    pub two_sided: bool,
    /// How large it looks.
    pub extent: Extent,
}

/// How large a convex body looks.
#[derive(Clone, Debug)]
pub enum Extent {
    /// Halves of the area vectors of its facets, in the luminaire's axes.
    Facets(Vec<Vector>),
    /// The same from all directions, in m².
    Round(f64),
}

impl Extent {
    /// A_p in m² as seen from a direction in the luminaire's axes.
    pub fn projected_area(&self, direction: Direction) -> f64 {
        match self {
            Self::Facets(halves) => halves.iter().map(|half| direction.dot(*half).abs()).sum(),
            Self::Round(area) => *area,
        }
    }
}

/// A convex polygon in the luminaire's axes, counter-clockwise from outside.
type Facet = Vec<Vector>;

impl Body {
    /// Of an opening about a point; the luminaire's axes are those of `frame`, its light goes against the normal. `None` if the opening
    /// [has no area](Opening::has_area).
    pub fn new(opening: &Opening, center: Point, frame: &Frame) -> Option<Self> {
        if !opening.has_area() {
            return None;
        }
        let facets = match *opening {
            Opening::Point => return None,
            Opening::Upright {
                width,
                length,
                height: 0.0,
            } if width == length => return Some(Self::disc(center, frame, 0.5 * width)),
            Opening::Ellipsoid {
                diameters: [a, b, c],
            } if a == b && b == c => return Some(Self::sphere(center, 0.5 * a)),
            Opening::Box {
                width,
                length,
                height,
            } => prism(&rectangle(length, width), height),
            Opening::Upright {
                width,
                length,
                height,
            } => prism(&ellipse(length, width), height),
            Opening::Lying {
                along_c0,
                length,
                diameter,
            } => lying(along_c0, &prism(&ellipse(diameter, diameter), length)),
            Opening::Ellipsoid {
                diameters: [across, along, up],
            } => ellipsoid([along, across, up].map(|diameter| 0.5 * diameter)),
        };
        Some(Self::of_facets(&facets, center, frame))
    }

    fn disc(center: Point, frame: &Frame, radius: f64) -> Self {
        let normal = -frame.normal();
        let form = Form::Disc(Disc {
            center,
            normal,
            radius,
            inner_radius: 0.0,
        });
        let area = PI * radius * radius;
        Self {
            form,
            two_sided: true,
            extent: Extent::Facets(vec![Vector::new(0.0, 0.0, area)]),
        }
    }

    fn sphere(center: Point, radius: f64) -> Self {
        let form = Form::Sphere(Sphere {
            center,
            radius,
            inside: false,
            ports: vec![],
        });
        Self {
            form,
            two_sided: false,
            extent: Extent::Round(PI * radius * radius),
        }
    }

    fn of_facets(facets: &[Facet], center: Point, frame: &Frame) -> Self {
        let two_sided = facets.len() == 1;
        let half = if two_sided { 1.0 } else { 0.5 };
        let extent = facets.iter().map(|facet| area_vector(facet) * half);
        let world = |corner: &Vector| center + frame.vector_to_world(*corner);
        Self {
            form: form(facets, world),
            two_sided,
            extent: Extent::Facets(extent.collect()),
        }
    }
}

/// A single facet of four corners stays one shape.
fn form(facets: &[Facet], world: impl Fn(&Vector) -> Point) -> Form {
    if let [facet] = facets
        && let [a, b, _, d] = &facet[..]
    {
        let (origin, edges) = (world(a), [b, d].map(|corner| world(corner) - world(a)));
        if let Some(rectangle) = Parallelogram::new(origin, edges) {
            return Form::Parallelogram(rectangle);
        }
    }
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for facet in facets {
        let first = vertices.len() as u32;
        vertices.extend(facet.iter().map(&world));
        let last = facet.len() as u32 - 1;
        triangles.extend((1..last).map(|k| [first, first + k, first + k + 1]));
    }
    Form::Mesh(TriangleMesh::new(vertices, triangles))
}

fn area_vector(facet: &Facet) -> Vector {
    let corners = facet.windows(2).skip(1);
    let cross = corners.map(|pair| (pair[0] - facet[0]).cross(pair[1] - facet[0]));
    cross.fold(Vector::ZERO, |sum, part| sum + part * 0.5)
}

/// Counter-clockwise from above.
fn rectangle(x: f64, y: f64) -> Vec<[f64; 2]> {
    let (x, y) = (0.5 * x, 0.5 * y);
    vec![[-x, -y], [x, -y], [x, y], [-x, y]]
}

/// The regular polygon with the area of a circle, stretched to an ellipse of these diameters.
fn ellipse(x: f64, y: f64) -> Vec<[f64; 2]> {
    let step = TAU / SIDES as f64;
    let scale = (step / libm::sin(step)).sqrt();
    let corner = |k: usize| {
        let (sin, cos) = libm::sincos(step * (k as f64 + 0.5));
        [0.5 * x * scale * cos, 0.5 * y * scale * sin]
    };
    (0..SIDES).map(corner).collect()
}

/// The body over an outline, from half its height below to half above; the outline itself, facing down, if it has no height.
fn prism(outline: &[[f64; 2]], height: f64) -> Vec<Facet> {
    let at = |z: f64| move |[x, y]: &[f64; 2]| Vector::new(*x, *y, z);
    let [below, above] = [-0.5 * height, 0.5 * height];
    let bottom: Facet = outline.iter().rev().map(at(below)).collect();
    if height == 0.0 {
        return vec![bottom];
    }
    let next = outline.iter().cycle().skip(1);
    let side = |(a, b): (&[f64; 2], &[f64; 2])| {
        let [low, high] = [at(below), at(above)];
        vec![low(a), low(b), high(b), high(a)]
    };
    let mut facets: Vec<Facet> = outline.iter().zip(next).map(side).collect();
    facets.push(bottom);
    facets.push(outline.iter().map(at(above)).collect());
    facets
}

/// An upright body laid along C0 or C90: a turn of the axes, which keeps the order of corners.
fn lying(along_c0: bool, facets: &[Facet]) -> Vec<Facet> {
    let turn = |corner: &Vector| match along_c0 {
        true => Vector::new(corner.z, corner.x, corner.y),
        false => Vector::new(corner.y, corner.z, corner.x),
    };
    let turned = |facet: &Facet| facet.iter().map(turn).collect();
    facets.iter().map(turned).collect()
}

/// Facets between circles of latitude and longitude; those at the poles are triangles.
fn ellipsoid([x, y, z]: [f64; 3]) -> Vec<Facet> {
    let corner = |ring: usize, side: usize| {
        let latitude = FRAC_PI_2 * (2.0 * ring as f64 / RINGS as f64 - 1.0);
        let (sin, cos) = libm::sincos(TAU * (side % SIDES) as f64 / SIDES as f64);
        let around = libm::cos(latitude);
        Vector::new(x * around * cos, y * around * sin, z * libm::sin(latitude))
    };
    let facet = |ring: usize, side: usize| -> Facet {
        match ring {
            0 => vec![corner(1, side), corner(0, 0), corner(1, side + 1)],
            last if last == RINGS - 1 => {
                vec![corner(last, side), corner(last, side + 1), corner(RINGS, 0)]
            }
            ring => vec![
                corner(ring, side),
                corner(ring, side + 1),
                corner(ring + 1, side + 1),
                corner(ring + 1, side),
            ],
        }
    };
    let ring = |ring: usize| (0..SIDES).map(move |side| facet(ring, side));
    (0..RINGS).flat_map(ring).collect()
}

#[cfg(test)]
mod tests;
