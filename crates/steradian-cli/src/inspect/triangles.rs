//! All triangles of a scene as one surface.

use steradian::geometry::Point;
use steradian::quantity::Length;
use steradian::scene::Scene;
use steradian::shape::health::{Health, examine};
use steradian::shape::{Form, ShapeId};

/// Triangles with the shapes they come from.
#[derive(Debug, Default)]
pub struct Triangles {
    vertices: Vec<Point>,
    corners: Vec<[u32; 3]>,
    /// The first triangle of each shape that has any, with the shape.
    starts: Vec<(u32, ShapeId)>,
}

impl Triangles {
    /// Those of meshes, boxes, polygons and rectangles.
    pub fn of(scene: &Scene) -> Self {
        let mut all = Self::default();
        for (placed, number) in scene.surfaces().shapes().iter().zip(0..) {
            let shape = ShapeId(number);
            match &placed.form {
                Form::Mesh(mesh) => all.add(shape, &mesh.vertices, &mesh.triangles),
                Form::Parallelogram(form) => {
                    all.add(shape, &form.corners(), &[[0, 1, 2], [0, 2, 3]]);
                }
                Form::Sphere(_) | Form::Disc(_) | Form::Plane { .. } => (),
            }
        }
        all
    }

    fn add(&mut self, shape: ShapeId, vertices: &[Point], triangles: &[[u32; 3]]) {
        let base = self.vertices.len() as u32;
        self.starts.push((self.corners.len() as u32, shape));
        self.vertices.extend_from_slice(vertices);
        let moved = triangles
            .iter()
            .map(|corners| corners.map(|index| base + index));
        self.corners.extend(moved);
    }

    /// Their number.
    pub fn count(&self) -> usize {
        self.corners.len()
    }

    /// What is wrong with them.
    pub fn examine(&self, weld: Length) -> Health {
        examine(&self.vertices, &self.corners, weld)
    }

    /// The shape of a triangle.
    pub fn shape(&self, triangle: u32) -> ShapeId {
        let next = self.starts.partition_point(|(first, _)| *first <= triangle);
        self.starts[next.saturating_sub(1)].1
    }

    /// Where a vertex is.
    pub fn place(&self, vertex: u32) -> [f64; 3] {
        self.vertices[vertex as usize].to_array()
    }

    /// Where the corners of a triangle are.
    pub fn places(&self, triangle: u32) -> Vec<[f64; 3]> {
        let corners = self.corners[triangle as usize];
        corners.map(|vertex| self.place(vertex)).to_vec()
    }
}
