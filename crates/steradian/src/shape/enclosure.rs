//! Enclosures: closed surfaces, which have two sides that no path joins unless it passes through them.
//!
//! Which side a point is on is told by the winding number w, |w| = 1 inside and 0 outside, whichever way the surface faces; see
//! [`Solid`](super::Solid). All answers err on the safe side: where something lies on the surface, or might cross it, there is none.

use crate::geometry::{Bounds, Point, Vector};

use super::health::at_same_place;
use super::solid::{octahedron, winding_number};
use super::{Form, Sphere, TriangleMesh};

/// Pairs of a triangle and a vertex beyond which a mesh is not examined for convexity.
const MOST_PAIRS: usize = 4_000_000;

/// A side of a closed surface.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Side {
    /// Enclosed.
    Inside,
    /// Not enclosed.
    Outside,
}

/// A closed surface.
#[derive(Clone, Debug)]
pub struct Enclosure<'a> {
    surface: Surface<'a>,
    bounds: Bounds,
    margin: f64,
}

#[derive(Clone, Debug)]
enum Surface<'a> {
    Sphere(&'a Sphere),
    Mesh(&'a TriangleMesh),
}

impl<'a> Enclosure<'a> {
    /// The enclosure that a form is, if it is closed; nothing is told of points less than `margin` metres from it.
    pub fn of(form: &'a Form, margin: f64) -> Option<Self> {
        let surface = match form {
            Form::Sphere(sphere) if sphere.ports.is_empty() => Surface::Sphere(sphere),
            Form::Mesh(mesh) if mesh.is_closed() => Surface::Mesh(mesh),
            _ => return None,
        };
        Some(Self {
            surface,
            bounds: form.bounds()?,
            margin,
        })
    }

    /// The side of a point.
    pub fn side_of(&self, point: Point) -> Option<Side> {
        if self.is_beyond(Bounds::around([point])) {
            return Some(Side::Outside);
        }
        match self.surface {
            Surface::Sphere(sphere) => {
                let depth = sphere.radius - (point - sphere.center).length();
                side(depth > self.margin, depth < -self.margin)
            }
            Surface::Mesh(mesh) => {
                let around = octahedron(self.margin).into_iter();
                let mut steps = std::iter::once(Vector::ZERO).chain(around);
                let first = winding_number(mesh, point).abs();
                let agrees = |step| (winding_number(mesh, point + step).abs() - first).abs() < 0.1;
                let sure = steps.all(agrees);
                side(sure && first > 0.9, sure && first < 0.1)
            }
        }
    }

    /// The side of everything within the convex hull of some points; inside only for a convex enclosure.
    pub fn side_of_hull(&self, points: &[Point]) -> Option<Side> {
        match points {
            [] => None,
            [point] => self.side_of(*point),
            _ if self.is_beyond(Bounds::around(points.iter().copied())) => Some(Side::Outside),
            _ => {
                let mut sides = points.iter().map(|point| self.side_of(*point));
                let all_inside = sides.all(|side| side == Some(Side::Inside));
                (all_inside && self.is_convex()).then_some(Side::Inside)
            }
        }
    }

    fn is_convex(&self) -> bool {
        match self.surface {
            Surface::Sphere(_) => true,
            Surface::Mesh(mesh) => is_convex(mesh, self.margin),
        }
    }

    /// Whether there is space between the bounds of the enclosure and others.
    fn is_beyond(&self, other: Bounds) -> bool {
        let (min, max) = (self.bounds.min().to_array(), self.bounds.max().to_array());
        let (from, to) = (other.min().to_array(), other.max().to_array());
        (0..3)
            .any(|axis| from[axis] > max[axis] + self.margin || to[axis] < min[axis] - self.margin)
    }
}

fn side(is_inside: bool, is_outside: bool) -> Option<Side> {
    match (is_inside, is_outside) {
        (true, _) => Some(Side::Inside),
        (_, true) => Some(Side::Outside),
        _ => None,
    }
}

/// Whether all vertices are on one side of all triangles; a mesh too large to be examined is not called convex.
fn is_convex(mesh: &TriangleMesh, margin: f64) -> bool {
    let distinct = (0..).zip(at_same_place(&mesh.vertices));
    let vertices: Vec<Point> = distinct
        .filter(|(index, first)| index == first)
        .map(|(index, _): (u32, u32)| mesh.vertices[index as usize])
        .collect();
    if vertices.len() * mesh.triangles.len() > MOST_PAIRS {
        return false;
    }
    let outwards = if mesh.signed_volume() < 0.0 {
        -1.0
    } else {
        1.0
    };
    (0..mesh.triangles.len()).all(|triangle| {
        let [a, b, c] = mesh.corners(triangle);
        let normal = (b - a).cross(c - a);
        let most = margin * normal.length();
        vertices
            .iter()
            .all(|vertex| outwards * normal.dot(*vertex - a) <= most)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A prism over a polygon in the plane z = 0, of height 1, facing outwards; the polygon is star-shaped around its first corner.
    fn prism(outline: &[[f64; 2]]) -> Form {
        let n = outline.len() as u32;
        let level = |z: f64| outline.iter().map(move |&[x, y]| Point::new(x, y, z));
        let vertices = level(0.0).chain(level(1.0)).collect();
        let caps = (1..n - 1).flat_map(|i| [[0, i + 1, i], [n, n + i, n + i + 1]]);
        let walls = (0..n).flat_map(|i| {
            let next = (i + 1) % n;
            [[i, next, n + next], [i, n + next, n + i]]
        });
        Form::Mesh(TriangleMesh::new(vertices, caps.chain(walls).collect()))
    }

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    /// The square without its upper right quarter.
    const ELL: [[f64; 2]; 6] = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];

    fn at(x: f64, y: f64) -> Point {
        Point::new(x, y, 0.5)
    }

    #[test]
    fn points_are_inside_outside_or_on_the_surface() {
        let mut turned = prism(&ELL);
        if let Form::Mesh(mesh) = &mut turned {
            let inwards = mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
            *mesh = TriangleMesh::new(mesh.vertices.clone(), inwards);
        }
        for form in [prism(&ELL), turned] {
            let ell = Enclosure::of(&form, 1e-6).unwrap();
            assert_eq!(ell.side_of(at(0.5, 1.5)), Some(Side::Inside));
            assert_eq!(ell.side_of(at(1.5, 1.5)), Some(Side::Outside));
            assert_eq!(ell.side_of(at(1.0, 1.5)), None);
            assert_eq!(ell.side_of(at(7.0, 7.0)), Some(Side::Outside));
        }
    }

    /// The hull of two points in the arms of the L passes outside, which is why nothing is told.
    #[test]
    fn hulls_are_inside_of_convex_enclosures_only() {
        let (square, ell) = (prism(&SQUARE), prism(&ELL));
        let square = Enclosure::of(&square, 1e-6).unwrap();
        let ell = Enclosure::of(&ell, 1e-6).unwrap();
        let arms = [at(1.8, 0.5), at(0.5, 1.8)];
        assert_eq!(square.side_of_hull(&arms), Some(Side::Inside));
        assert_eq!(ell.side_of_hull(&arms), None);
        assert_eq!(square.side_of_hull(&[at(1.0, 1.0), at(3.0, 1.0)]), None);
        let far = [at(3.0, 0.0), at(3.0, 9.0)];
        assert_eq!(ell.side_of_hull(&far), Some(Side::Outside));
        assert_eq!(square.side_of_hull(&[]), None);
    }

    #[test]
    fn spheres_are_enclosures_and_open_forms_are_not() {
        let mut sphere = Sphere {
            center: at(0.0, 0.0),
            radius: 1.0,
            inside: true,
            ports: vec![],
        };
        let form = Form::Sphere(sphere.clone());
        let ball = Enclosure::of(&form, 1e-6).unwrap();
        assert_eq!(ball.side_of(at(0.5, 0.5)), Some(Side::Inside));
        assert_eq!(ball.side_of(at(0.8, 0.8)), Some(Side::Outside));
        assert_eq!(ball.side_of(at(1.0, 0.0)), None);
        sphere.ports.push(crate::shape::SpherePort {
            direction: crate::geometry::Direction::X,
            cos_half_angle: 0.9,
        });
        assert!(Enclosure::of(&Form::Sphere(sphere), 1e-6).is_none());
        let Form::Mesh(mesh) = prism(&SQUARE) else {
            panic!("a mesh")
        };
        let open = TriangleMesh::new(mesh.vertices.clone(), mesh.triangles[1..].to_vec());
        assert!(Enclosure::of(&Form::Mesh(open), 1e-6).is_none());
    }
}
