//! Texture coordinates and colours at points of surfaces.
//!
//! | form | u | v |
//! |---|---|---|
//! | rectangle | along the first edge, 0 to 1 | along the second |
//! | mesh | of its vertices, interpolated | |
//! | sphere | φ/2π, from +x over +y | 1 − θ/π: 1 at +z |
//! | disc | ½ + ½ x/R in the disc's plane | ½ + ½ y/R |
//! | plane | x in metres from its point | y |
//!
//! The axes of a disc and of a plane are those of [`Frame::from_normal`]: x and y of the world for a level one. A mesh
//! without coordinates has none; polygons and boxes are such meshes.

use std::f64::consts::{FRAC_1_PI, TAU};

use super::{Form, ShapeId, Surfaces};
use crate::geometry::{Frame, Point};

impl Form {
    /// Whether its points have texture coordinates.
    pub fn has_coordinates(&self) -> bool {
        match self {
            Self::Mesh(mesh) => !mesh.attributes.coordinates.is_empty(),
            _ => true,
        }
    }

    /// Texture coordinates of a point; `face` and `weights` are the triangle and the barycentric weights of its second
    /// and third corner on a mesh, or on the two triangles of a rectangle.
    pub fn coordinates(&self, face: usize, [s, t]: [f32; 2], point: Point) -> [f32; 2] {
        match self {
            // Triangles (0, 1, 2) and (0, 2, 3) of the corners (0, 0), (1, 0), (1, 1), (0, 1).
            Self::Parallelogram(_) if face == 0 => [s + t, t],
            Self::Parallelogram(_) => [s, s + t],
            Self::Mesh(mesh) => interpolated(
                &mesh.attributes.coordinates,
                mesh.triangles[face],
                [s, t],
                [0.0; 2],
            ),
            Self::Sphere(sphere) => {
                let out = (point - sphere.center) / sphere.radius;
                let turn = libm::atan2(out.y, out.x) / TAU;
                let height = libm::acos(out.z.clamp(-1.0, 1.0)) * FRAC_1_PI;
                [turn.rem_euclid(1.0) as f32, (1.0 - height) as f32]
            }
            Self::Disc(disc) => {
                let local = Frame::from_normal(disc.normal).vector_to_local(point - disc.center);
                [local.x, local.y].map(|x| (0.5 + 0.5 * x / disc.radius) as f32)
            }
            Self::Plane {
                point: base,
                normal,
            } => {
                let local = Frame::from_normal(*normal).vector_to_local(point - *base);
                [local.x as f32, local.y as f32]
            }
        }
    }

    /// Colour and alpha of a point; white where the form has none.
    pub fn color(&self, face: usize, weights: [f32; 2]) -> [f32; 4] {
        match self {
            Self::Mesh(mesh) => interpolated(
                &mesh.attributes.colors,
                mesh.triangles[face],
                weights,
                [1.0; 4],
            ),
            _ => [1.0; 4],
        }
    }
}

impl Form {
    /// The normals of a mesh's vertices between them, not of unit length; zero where the form has none.
    pub fn vertex_normal(&self, face: usize, weights: [f32; 2]) -> [f32; 3] {
        match self {
            Self::Mesh(mesh) => interpolated(
                &mesh.attributes.normals,
                mesh.triangles[face],
                weights,
                [0.0; 3],
            ),
            _ => [0.0; 3],
        }
    }
}

/// The values of three vertices, weighted; `none` without values.
fn interpolated<const N: usize>(
    values: &[[f32; N]],
    triangle: [u32; 3],
    [s, t]: [f32; 2],
    none: [f32; N],
) -> [f32; N] {
    if values.is_empty() {
        return none;
    }
    let [a, b, c] = triangle.map(|vertex| values[vertex as usize]);
    std::array::from_fn(|k| a[k] + (b[k] - a[k]) * s + (c[k] - a[k]) * t)
}

impl Surfaces {
    /// The shape of a primitive, and the number of the primitive in it.
    pub fn face_of(&self, primitive: u32) -> (ShapeId, usize) {
        let shape = self.shape_of(primitive);
        (shape, (primitive - self.first_primitive(shape)) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Direction, Vector};
    use crate::shape::{Attributes, Disc, Parallelogram, Sphere, TriangleMesh};

    fn close(found: [f32; 2], expected: [f64; 2]) {
        let off = found
            .iter()
            .zip(expected)
            .map(|(a, b)| (f64::from(*a) - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-6, "{found:?} {expected:?}");
    }

    #[test]
    fn rectangles_have_the_coordinates_of_their_edges() {
        let edges = [Vector::new(2.0, 0.0, 0.0), Vector::new(0.0, 3.0, 0.0)];
        let form = Form::Parallelogram(Parallelogram::new(Point::ORIGIN, edges).unwrap());
        // Corner 0 + s (corner 1 − corner 0) + t (corner 2 − corner 0), and the same with corners 0, 2, 3.
        close(
            form.coordinates(0, [0.5, 0.25], Point::ORIGIN),
            [0.75, 0.25],
        );
        close(form.coordinates(1, [0.5, 0.25], Point::ORIGIN), [0.5, 0.75]);
    }

    #[test]
    fn spheres_and_discs_have_natural_coordinates() {
        let sphere = Form::Sphere(Sphere {
            center: Point::new(1.0, 0.0, 0.0),
            radius: 2.0,
            inside: false,
            ports: vec![],
        });
        let at = |x, y, z| sphere.coordinates(0, [0.0; 2], Point::new(1.0 + x, y, z));
        close(at(2.0, 0.0, 0.0), [0.0, 0.5]);
        close(at(0.0, 2.0, 0.0), [0.25, 0.5]);
        close(at(0.0, -2.0, 0.0), [0.75, 0.5]);
        assert_eq!(at(0.0, 0.0, 2.0)[1], 1.0);
        let disc = Form::Disc(Disc {
            center: Point::ORIGIN,
            normal: Direction::Z,
            radius: 2.0,
            inner_radius: 0.0,
        });
        close(
            disc.coordinates(0, [0.0; 2], Point::new(1.0, -2.0, 0.0)),
            [0.75, 0.0],
        );
    }

    #[test]
    fn meshes_interpolate_what_their_vertices_have() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Point::from);
        let plain = TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2]]);
        assert!(!Form::Mesh(plain.clone()).has_coordinates());
        assert_eq!(Form::Mesh(plain.clone()).color(0, [0.2, 0.3]), [1.0; 4]);
        let attributes = Attributes {
            coordinates: vec![[0.0, 1.0], [1.0, 1.0], [0.0, 3.0]],
            colors: vec![[0.0; 4], [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]],
            normals: vec![[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        };
        let form = Form::Mesh(plain.with_attributes(attributes));
        close(form.coordinates(0, [0.25, 0.5], Point::ORIGIN), [0.25, 2.0]);
        assert_eq!(form.color(0, [0.25, 0.5]), [0.25, 0.5, 0.0, 0.75]);
        assert_eq!(form.vertex_normal(0, [0.25, 0.5]), [0.25, 0.5, 0.25]);
    }
}
