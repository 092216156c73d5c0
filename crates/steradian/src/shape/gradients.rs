//! How texture coordinates grow along surfaces: ∇u and ∇v, in 1/m.
//!
//! | form | ∇u | ∇v |
//! |---|---|---|
//! | rectangle, triangle | u is linear on it: ∇u · e = Δu for its edges e, and ∇u · n = 0 | |
//! | sphere | φ̂/(2π r sinθ) | −θ̂/(π r) |
//! | disc | x̂/(2R) | ŷ/(2R) |
//! | plane | x̂ | ŷ |

use std::f64::consts::{PI, TAU};

use super::{Form, TriangleMesh};
use crate::geometry::{Frame, Point, Vector};

impl Form {
    /// ∇u and ∇v at a point; `None` where there are no coordinates, or where they do not grow.
    pub fn coordinate_gradients(&self, face: usize, point: Point) -> Option<[Vector; 2]> {
        let gradients = match self {
            Self::Parallelogram(form) => duals(form.edges, [[1.0, 0.0], [0.0, 1.0]]),
            Self::Mesh(mesh) => mesh.coordinate_gradients(face)?,
            Self::Sphere(sphere) => around(point - sphere.center),
            Self::Disc(disc) => {
                let frame = Frame::from_normal(disc.normal);
                let axis = |axis| frame.vector_to_world(axis) / (2.0 * disc.radius);
                [
                    axis(Vector::new(1.0, 0.0, 0.0)),
                    axis(Vector::new(0.0, 1.0, 0.0)),
                ]
            }
            Self::Plane { normal, .. } => {
                let frame = Frame::from_normal(*normal);
                [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0)]
                    .map(|axis| frame.vector_to_world(axis))
            }
        };
        growing(gradients)
    }
}

impl TriangleMesh {
    /// ∇u and ∇v on a triangle; `None` where there are no coordinates, or where they do not grow.
    pub fn coordinate_gradients(&self, face: usize) -> Option<[Vector; 2]> {
        let coordinates = &self.attributes.coordinates;
        let at = |corner: u32| coordinates.get(corner as usize).map(|uv| uv.map(f64::from));
        let [a, b, c] = self.triangles[face].map(at);
        let (a, b, c) = (a?, b?, c?);
        let [p, q, r] = self.corners(face);
        let steps = [b, c].map(|corner| [corner[0] - a[0], corner[1] - a[1]]);
        growing(duals([q - p, r - p], steps))
    }
}

/// The direction in which u grows and v does not, of any length: v × (u × v).
pub fn along_u([u, v]: [Vector; 2]) -> Vector {
    u * v.dot(v) - v * u.dot(v)
}

fn growing(gradients: [Vector; 2]) -> Option<[Vector; 2]> {
    let grow = |gradient: &Vector| gradient.is_finite() && gradient.length() > 0.0;
    gradients.iter().all(grow).then_some(gradients)
}

/// The vectors in the plane of two edges whose products with them are the steps of u, and of v.
fn duals([first, second]: [Vector; 2], steps: [[f64; 2]; 2]) -> [Vector; 2] {
    let normal = first.cross(second);
    let area = normal.dot(normal);
    let (along_first, along_second) = (second.cross(normal) / area, normal.cross(first) / area);
    [0, 1].map(|k| along_first * steps[0][k] + along_second * steps[1][k])
}

/// On a sphere, from its centre.
fn around(out: Vector) -> [Vector; 2] {
    let across = Vector::new(-out.y, out.x, 0.0);
    let ring = across.dot(across);
    // θ̂ = φ̂ × r̂.
    let down = across.cross(out) / (ring.sqrt() * out.dot(out));
    [across / (TAU * ring), down / -PI]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Direction;
    use crate::shape::{Attributes, Disc, Parallelogram, Sphere};

    /// Steps of a coordinate along small steps on the surface, against the gradient: second order, below 1e-5 for 1e-3.
    #[track_caller]
    fn grows(form: &Form, point: Point, steps: [Vector; 2], onto: impl Fn(Point) -> Point) {
        let gradients = form.coordinate_gradients(0, point).unwrap();
        let uv = |point| form.coordinates(0, [0.0; 2], point).map(f64::from);
        for step in steps {
            let (there, back) = (uv(onto(point + step)), uv(onto(point - step)));
            for k in 0..2 {
                let found = 0.5 * (there[k] - back[k]);
                assert!(
                    (found - gradients[k].dot(step)).abs() < 1e-6,
                    "{k} {found} {step:?}"
                );
            }
        }
    }

    #[test]
    fn gradients_are_the_growth_of_the_coordinates() {
        let (x, y, z) = (
            Direction::X.to_vector(),
            Direction::Y.to_vector(),
            Direction::Z.to_vector(),
        );
        let center = Point::new(1.0, 2.0, 3.0);
        let sphere = Form::Sphere(Sphere {
            center,
            radius: 2.0,
            inside: false,
            ports: vec![],
        });
        let onto = |point: Point| center + (point - center) * (2.0 / (point - center).length());
        let point = onto(center + Vector::new(1.0, 2.0, -0.5));
        grows(&sphere, point, [x, y].map(|axis| axis * 1e-2), onto);
        grows(&sphere, point, [z, x + z].map(|axis| axis * 1e-2), onto);
        let disc = Form::Disc(Disc {
            center,
            normal: Direction::Z,
            radius: 3.0,
            inner_radius: 0.0,
        });
        grows(&disc, center, [x * 0.1, y * 0.1], |point| point);
    }

    #[test]
    fn a_slanted_rectangle_has_dual_gradients() {
        let edges = [Vector::new(2.0, 0.0, 0.0), Vector::new(1.0, 4.0, 0.0)];
        let form = Form::Parallelogram(Parallelogram::new(Point::ORIGIN, edges).unwrap());
        let [u, v] = form.coordinate_gradients(0, Point::ORIGIN).unwrap();
        assert_eq!((u.dot(edges[0]), u.dot(edges[1])), (1.0, 0.0));
        assert_eq!((v.dot(edges[0]), v.dot(edges[1])), (0.0, 1.0));
    }

    #[test]
    fn meshes_without_coordinates_have_none() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
        let vertices = corners.map(|[x, y, z]| Point::new(x, y, z)).to_vec();
        let plain = TriangleMesh::new(vertices, vec![[0, 1, 2]]);
        assert_eq!(
            Form::Mesh(plain.clone()).coordinate_gradients(0, Point::ORIGIN),
            None
        );
        let attributes = Attributes {
            coordinates: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 3.0]],
            ..Attributes::default()
        };
        let laid = Form::Mesh(plain.with_attributes(attributes));
        let [u, v] = laid.coordinate_gradients(0, Point::ORIGIN).unwrap();
        assert_eq!(
            [u, v].map(|w| [w.x, w.y, w.z]),
            [[0.5, 0.0, 0.0], [0.0, 1.5, 0.0]]
        );
    }
}
