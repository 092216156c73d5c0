//! Everything rays can meet, in the form of the ray kernel.
//!
//! The kernel works in f32 near the origin, so coordinates are rebased: world = [`Surfaces::origin`] + kernel. A form
//! has one or more *parts* (the faces of a box), each with its own material; the kernel's primitive number leads to a
//! part, the part to the shape.

use steradian_kernel::{
    Accelerator, BuildError, Cap, Geometry, HitBatch, InstructionSet, Quadric, RayBatch,
};

use crate::geometry::{Bounds, Direction, Hull, Point, Vector};

use super::{Disc, Form, Sphere, SpherePort};

/// Share of the scene's extent that clears a surface.
const CLEARANCE: f64 = 4e-6;

/// A shape of the scene, by number.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ShapeId(pub u32);

/// A part of a shape with one material, by number.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PartId(pub u32);

/// A form in the scene with the part of each of its faces.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The geometry.
    pub form: Form,
    /// The part of each triangle of a mesh; one entry for every other form.
    pub parts: Vec<PartId>,
}

/// A triangle as shading needs it: kernel coordinates, f32.
#[derive(Copy, Clone, Debug, Default)]
pub struct TriangleRecord {
    /// A corner.
    pub origin: [f32; 3],
    /// The edges that leave it.
    pub edges: [[f32; 3]; 2],
    /// Unit normal of the front.
    pub normal: [f32; 3],
    /// Its part.
    pub part: u32,
}

/// A quadric as shading needs it.
#[derive(Copy, Clone, Debug)]
pub struct QuadricRecord {
    /// Centre, or a point of a plane, in kernel coordinates.
    pub center: [f64; 3],
    /// Normal of a disc or plane.
    pub normal: [f64; 3],
    /// Radius of a sphere, negative when its front is the inside; 0 for flat forms.
    pub signed_radius: f64,
    /// Its part.
    pub part: u32,
}

impl QuadricRecord {
    fn flat(center: [f64; 3], normal: [f64; 3], part: PartId) -> Self {
        Self {
            center,
            normal,
            signed_radius: 0.0,
            part: part.0,
        }
    }
}

/// All shapes of a scene.
pub struct Surfaces {
    origin: Point,
    shapes: Vec<Placed>,
    accelerator: Accelerator,
    triangles: Vec<TriangleRecord>,
    quadrics: Vec<QuadricRecord>,
    primitive_shape: Vec<ShapeId>,
    first_primitive: Vec<u32>,
    bounds: Option<Bounds>,
}

impl Surfaces {
    /// Builds the acceleration structure. `anchor` is where a scene without finite shapes takes place.
    ///
    /// # Errors
    /// If a coordinate is not finite or too far from the middle of the scene.
    pub fn new(shapes: Vec<Placed>, anchor: Point) -> Result<Self, BuildError> {
        let bounds = bounds_of(&shapes);
        let origin = bounds.and_then(|bounds| bounds.center()).unwrap_or(anchor);
        let mut builder = Builder::new(origin, &shapes);
        for (index, shape) in shapes.iter().enumerate() {
            builder.add(ShapeId(index as u32), shape);
        }
        let accelerator = Accelerator::build(&builder.geometry)?;
        let mut primitive_shape = builder.triangle_shape;
        primitive_shape.extend(builder.quadric_shape);
        let mut first_primitive = vec![u32::MAX; shapes.len()];
        for (primitive, shape) in primitive_shape.iter().enumerate().rev() {
            first_primitive[shape.0 as usize] = primitive as u32;
        }
        let (triangles, quadrics) = (builder.triangles, builder.quadrics);
        Ok(Self {
            origin,
            shapes,
            accelerator,
            triangles,
            quadrics,
            primitive_shape,
            first_primitive,
            bounds,
        })
    }

    /// World position of the kernel's origin.
    pub fn origin(&self) -> Point {
        self.origin
    }

    /// A world position in kernel coordinates.
    pub fn to_kernel(&self, point: Point) -> [f32; 3] {
        let p = point - self.origin;
        [p.x as f32, p.y as f32, p.z as f32]
    }

    /// The shapes.
    pub fn shapes(&self) -> &[Placed] {
        &self.shapes
    }

    /// The shape with this number.
    pub fn shape(&self, id: ShapeId) -> &Placed {
        &self.shapes[id.0 as usize]
    }

    /// The shape of a primitive.
    pub fn shape_of(&self, primitive: u32) -> ShapeId {
        self.primitive_shape[primitive as usize]
    }

    /// The part of a primitive, by number.
    pub fn part_of(&self, primitive: u32) -> u32 {
        let number = primitive as usize;
        match self.triangles.get(number) {
            Some(triangle) => triangle.part,
            None => self.quadrics[number - self.triangles.len()].part,
        }
    }

    /// Triangles for shading, in primitive order.
    pub fn triangles(&self) -> &[TriangleRecord] {
        &self.triangles
    }

    /// Quadrics for shading; primitive number less the number of triangles.
    pub fn quadrics(&self) -> &[QuadricRecord] {
        &self.quadrics
    }

    /// True only if no surface, except the primitives that `ignore` accepts, reaches above the plane through `point`, by
    /// more than `clearance` metres.
    pub fn nothing_above(
        &self,
        point: Point,
        normal: Direction,
        clearance: f64,
        ignore: &dyn Fn(u32) -> bool,
    ) -> bool {
        let p = point - self.origin;
        let down = -normal;
        let plane = [down.x(), down.y(), down.z(), down.dot(p) - clearance];
        self.accelerator.region_is_clear(&[plane], ignore)
    }

    /// True only if no surface, except the primitives that `ignore` accepts, reaches into the region: the condition for
    /// closed forms, which know no obstacles. With the hull shrunk by [`clearance`](Self::clearance) surfaces that merely touch it
    /// do not count.
    pub fn is_clear(&self, region: &Hull, ignore: &dyn Fn(u32) -> bool) -> bool {
        let half_spaces = region.half_spaces_from(self.origin);
        self.accelerator.region_is_clear(&half_spaces, ignore)
    }

    /// Number of the first primitive of a shape.
    pub fn first_primitive(&self, id: ShapeId) -> u32 {
        self.first_primitive[id.0 as usize]
    }

    /// A distance in metres that is small in the scene, yet well above the rounding of its coordinates.
    pub fn clearance(&self) -> f64 {
        clearance_in(self.bounds)
    }

    /// The same for a point that may lie far off the finite shapes, on a plane.
    pub fn clearance_at(&self, point: Point) -> f64 {
        self.clearance()
            .max(CLEARANCE * (point - self.origin).length())
    }

    /// Normal of the front of a primitive near `point`.
    pub fn normal_at(&self, primitive: u32, point: Point) -> Vector {
        if let Some(triangle) = self.triangles.get(primitive as usize) {
            return Vector::from(triangle.normal.map(f64::from));
        }
        let quadric = &self.quadrics[primitive as usize - self.triangles.len()];
        if quadric.signed_radius == 0.0 {
            return Vector::from(quadric.normal);
        }
        (point - self.origin - Vector::from(quadric.center)) / quadric.signed_radius
    }

    /// World bounds of the finite shapes; `None` without any.
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds
    }

    /// The acceleration structure.
    pub fn accelerator(&self) -> &Accelerator {
        &self.accelerator
    }

    /// Closest hits.
    pub fn closest(&self, rays: &RayBatch, hits: &mut HitBatch, set: InstructionSet) {
        self.accelerator.closest(rays, hits, set);
    }

    /// Which rays are stopped before the end of their segment.
    pub fn occluded(&self, rays: &RayBatch, out: &mut Vec<bool>, set: InstructionSet) {
        self.accelerator.occluded(rays, out, set);
    }
}

/// [`Surfaces::clearance`] of shapes within these bounds.
pub(crate) fn clearance_in(bounds: Option<Bounds>) -> f64 {
    let diagonal = bounds.map_or(1.0, |bounds| bounds.diagonal().to_metres());
    CLEARANCE * diagonal
}

fn bounds_of(shapes: &[Placed]) -> Option<Bounds> {
    let boxes = shapes.iter().filter_map(|shape| shape.form.bounds());
    boxes.reduce(Bounds::union)
}

/// Collects the kernel's geometry and the records beside it.
struct Builder {
    origin: Point,
    geometry: Geometry,
    triangles: Vec<TriangleRecord>,
    triangle_shape: Vec<ShapeId>,
    quadrics: Vec<QuadricRecord>,
    quadric_shape: Vec<ShapeId>,
}

impl Builder {
    /// With room for what the shapes are made of: a vector that grows holds everything twice.
    fn new(origin: Point, shapes: &[Placed]) -> Self {
        let count = |of: fn(&Form) -> usize| shapes.iter().map(|shape| of(&shape.form)).sum();
        let (vertices, triangles) = (count(vertex_count), count(triangle_count));
        Self {
            origin,
            geometry: Geometry {
                positions: Vec::with_capacity(vertices),
                triangles: Vec::with_capacity(triangles),
                quadrics: Vec::new(),
            },
            triangles: Vec::with_capacity(triangles),
            triangle_shape: Vec::with_capacity(triangles),
            quadrics: Vec::new(),
            quadric_shape: Vec::new(),
        }
    }

    fn add(&mut self, id: ShapeId, shape: &Placed) {
        match &shape.form {
            Form::Parallelogram(form) => {
                let [a, b, c, d] = form.corners();
                let base = self.vertices([a, b, c, d]);
                for indices in [[0, 1, 2], [0, 2, 3]] {
                    self.triangle(id, shape.parts[0], indices.map(|i| base + i));
                }
            }
            Form::Mesh(mesh) => {
                let base = self.vertices(mesh.vertices.iter().copied());
                for (triangle, part) in mesh.triangles.iter().zip(&shape.parts) {
                    self.triangle(id, *part, triangle.map(|i| base + i));
                }
            }
            Form::Sphere(sphere) => self.sphere(id, shape.parts[0], sphere),
            Form::Disc(disc) => self.disc(id, shape.parts[0], disc),
            Form::Plane { point, normal } => {
                let (point, normal) = (self.rebased(*point), normal.to_array());
                let record = QuadricRecord::flat(point, normal, shape.parts[0]);
                self.quadric(id, Quadric::Plane { point, normal }, record);
            }
        }
    }

    fn disc(&mut self, id: ShapeId, part: PartId, disc: &Disc) {
        let (center, normal) = (self.rebased(disc.center), disc.normal.to_array());
        let quadric = Quadric::Disc {
            center,
            normal,
            radius: disc.radius,
            inner_radius: disc.inner_radius,
        };
        self.quadric(id, quadric, QuadricRecord::flat(center, normal, part));
    }

    fn sphere(&mut self, id: ShapeId, part: PartId, sphere: &Sphere) {
        let center = self.rebased(sphere.center);
        let cap = |port: &SpherePort| Cap {
            direction: port.direction.to_array(),
            cos_half_angle: port.cos_half_angle,
        };
        let quadric = Quadric::Sphere {
            center,
            radius: sphere.radius,
            ports: sphere.ports.iter().map(cap).collect(),
        };
        let front = if sphere.inside { -1.0 } else { 1.0 };
        let record = QuadricRecord {
            center,
            normal: [0.0; 3],
            signed_radius: front * sphere.radius,
            part: part.0,
        };
        self.quadric(id, quadric, record);
    }

    fn quadric(&mut self, id: ShapeId, quadric: Quadric, record: QuadricRecord) {
        self.geometry.quadrics.push(quadric);
        self.quadrics.push(record);
        self.quadric_shape.push(id);
    }

    fn vertices(&mut self, points: impl IntoIterator<Item = Point>) -> u32 {
        let base = self.geometry.positions.len() as u32;
        let origin = self.origin;
        self.geometry
            .positions
            .extend(points.into_iter().map(|point| {
                let p = point - origin;
                [p.x as f32, p.y as f32, p.z as f32]
            }));
        base
    }

    fn triangle(&mut self, id: ShapeId, part: PartId, indices: [u32; 3]) {
        let corners = indices.map(|index| self.geometry.positions[index as usize]);
        self.geometry.triangles.push(indices);
        self.triangle_shape.push(id);
        self.triangles.push(record(corners, part));
    }

    fn rebased(&self, point: Point) -> [f64; 3] {
        let p = point - self.origin;
        [p.x, p.y, p.z]
    }
}

fn vertex_count(form: &Form) -> usize {
    match form {
        Form::Parallelogram(_) => 4,
        Form::Mesh(mesh) => mesh.vertices.len(),
        Form::Sphere(_) | Form::Disc(_) | Form::Plane { .. } => 0,
    }
}

fn triangle_count(form: &Form) -> usize {
    match form {
        Form::Parallelogram(_) => 2,
        Form::Mesh(mesh) => mesh.triangles.len(),
        Form::Sphere(_) | Form::Disc(_) | Form::Plane { .. } => 0,
    }
}

fn record(corners: [[f32; 3]; 3], part: PartId) -> TriangleRecord {
    let [a, b, c] = corners.map(glam::Vec3::from_array);
    let normal = (b - a)
        .as_dvec3()
        .cross((c - a).as_dvec3())
        .normalize_or_zero()
        .as_vec3();
    TriangleRecord {
        origin: a.into(),
        edges: [(b - a).into(), (c - a).into()],
        normal: normal.into(),
        part: part.0,
    }
}

#[cfg(test)]
mod tests;
