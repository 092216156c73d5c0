//! Surfaces of exchange: what the rows and columns of a matrix of form factors are about.
//!
//! A *facet* is one side of a convex plane polygon (a rectangle, a face of a box, a polygon of a mesh that was cut into a
//! fan, or else a triangle) or of a whole disc or sphere. Its front is the side that the scene calls so. Facets of flat
//! polygons do not see themselves.

use std::f64::consts::TAU;

use crate::geometry::{Direction, Point, Polygon, Vector};
use crate::scene::Scene;
use crate::shape::{Disc, Form, PartId, ShapeId, Sphere, Surfaces, TriangleMesh};

use super::ExchangeError;
use super::polygon::ConvexPolygon;

/// Which sides of surfaces take part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sides {
    /// The fronts. What reaches a back is counted as [`Rest::other`](super::Rest::other).
    #[default]
    Front,
    /// The backs.
    Back,
    /// Both, each as a facet of its own.
    Both,
}

/// Marks a side of a primitive that is no facet.
pub(super) const NO_FACET: u32 = u32::MAX;

/// The geometry of a facet.
#[derive(Clone, Debug, PartialEq)]
pub enum Extent {
    /// A convex polygon, counter-clockwise seen from where it radiates to.
    Polygon(ConvexPolygon),
    /// A disc or annulus; its normal points to where it radiates.
    Disc(Disc),
    /// A sphere; its front is where it radiates.
    Sphere(Sphere),
}

/// One side of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// Its shape.
    pub shape: ShapeId,
    /// The part of the shape that it belongs to.
    pub part: PartId,
    /// Its number within the shape.
    pub number: u32,
    /// Whether it is the back of its surface.
    pub is_back: bool,
    /// Its geometry.
    pub extent: Extent,
    /// Its area in m².
    pub area: f64,
}

impl Facet {
    /// The polygon, if it is one.
    pub fn polygon(&self) -> Option<&ConvexPolygon> {
        match &self.extent {
            Extent::Polygon(polygon) => Some(polygon),
            Extent::Disc(_) | Extent::Sphere(_) => None,
        }
    }

    /// A point with its normal, uniform by area; none in the port of a sphere.
    pub(super) fn sample(&self, u: [f64; 2]) -> Option<(Point, Direction)> {
        match &self.extent {
            Extent::Polygon(polygon) => Some((polygon.sample(u), polygon.normal())),
            Extent::Disc(disc) => Some((disc.sample_area(u).point, disc.normal)),
            Extent::Sphere(sphere) => sphere
                .sample_area(u)
                .map(|sample| (sample.point, sample.normal)),
        }
    }

    /// Where to and by which share points are pulled so that those on an edge leave it by twice `lift`, in a square.
    pub(super) fn pull(&self, lift: f64) -> (Point, f64) {
        match &self.extent {
            Extent::Polygon(polygon) => {
                (polygon.middle(), (4.0 * lift / self.area.sqrt()).min(0.01))
            }
            Extent::Disc(disc) => (disc.center, (2.0 * lift / disc.radius).min(0.01)),
            Extent::Sphere(sphere) => (sphere.center, 0.0),
        }
    }

    /// The share of samples that [`sample`](Self::sample) finds a point for.
    pub(super) fn sampled_share(&self) -> f64 {
        match &self.extent {
            Extent::Sphere(sphere) => sphere.area() / sphere.full_area(),
            Extent::Polygon(_) | Extent::Disc(_) => 1.0,
        }
    }
}

/// All facets of a scene.
pub struct Facets<'a> {
    scene: &'a Scene,
    list: Vec<Facet>,
    /// Front and back of each primitive.
    of_primitive: Vec<[u32; 2]>,
    /// How far rays start above each facet.
    lift: Vec<f64>,
    /// The polygons as closed forms want them.
    outlines: Vec<Option<Polygon>>,
    /// Facets of each shape, of one side.
    in_shape: Vec<u32>,
}

impl<'a> Facets<'a> {
    /// The facets of a scene. Grounds have no finite area and are none.
    ///
    /// # Errors
    /// If there is no facet.
    pub fn new(scene: &'a Scene, sides: Sides) -> Result<Self, ExchangeError> {
        let surfaces = scene.surfaces();
        let mut facets = Self {
            scene,
            list: Vec::new(),
            of_primitive: vec![
                [NO_FACET; 2];
                surfaces.triangles().len() + surfaces.quadrics().len()
            ],
            lift: Vec::new(),
            outlines: Vec::new(),
            in_shape: vec![0; surfaces.shapes().len()],
        };
        for index in 0..surfaces.shapes().len() {
            facets.add_shape(ShapeId(index as u32), sides);
        }
        if facets.list.is_empty() {
            return Err(ExchangeError::NoSurface);
        }
        Ok(facets)
    }

    /// These facets only; the others still stand in the way, and what reaches them counts as [`Rest::other`](super::Rest::other).
    ///
    /// # Errors
    /// If none is left.
    pub fn only(mut self, keep: impl Fn(usize) -> bool) -> Result<Self, ExchangeError> {
        let kept: Vec<usize> = (0..self.count()).filter(|&index| keep(index)).collect();
        if kept.is_empty() {
            return Err(ExchangeError::NoSurface);
        }
        let mut number = vec![NO_FACET; self.count()];
        for (new, &old) in kept.iter().enumerate() {
            number[old] = new as u32;
        }
        for facet in self.of_primitive.iter_mut().flatten() {
            *facet = number.get(*facet as usize).copied().unwrap_or(NO_FACET);
        }
        self.list = kept.iter().map(|&old| self.list[old].clone()).collect();
        self.lift = kept.iter().map(|&old| self.lift[old]).collect();
        self.outlines = kept.iter().map(|&old| self.outlines[old].clone()).collect();
        Ok(self)
    }

    /// The scene.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The surfaces of the scene.
    pub fn surfaces(&self) -> &'a Surfaces {
        self.scene.surfaces()
    }

    /// All facets, in the order of shapes and of faces within them; a back follows its front.
    pub fn list(&self) -> &[Facet] {
        &self.list
    }

    /// Number of facets.
    pub fn count(&self) -> usize {
        self.list.len()
    }

    /// The name of the shape, with the number of the facet if the shape has several, and `back` for a back.
    pub fn name(&self, index: usize) -> String {
        let facet = &self.list[index];
        let shape = self.scene.shape_name(facet.shape);
        let number = match self.in_shape[facet.shape.0 as usize] {
            1 => String::new(),
            _ => format!("/{}", facet.number),
        };
        let side = if facet.is_back { " back" } else { "" };
        format!("{shape}{number}{side}")
    }

    /// The facet of a side of a primitive, if there is one.
    pub(super) fn of_hit(&self, primitive: u32, from_back: bool) -> Option<usize> {
        let facet = self.of_primitive[primitive as usize][usize::from(from_back)];
        (facet != NO_FACET).then_some(facet as usize)
    }

    /// How far above a facet rays start.
    pub(super) fn lift(&self, index: usize) -> f64 {
        self.lift[index]
    }

    /// The polygon of a facet, if it is one.
    pub(super) fn outline(&self, index: usize) -> Option<&Polygon> {
        self.outlines[index].as_ref()
    }

    fn add_shape(&mut self, id: ShapeId, sides: Sides) {
        let surfaces = self.scene.surfaces();
        let placed = surfaces.shape(id);
        let first = match placed.form {
            Form::Plane { .. } => return,
            _ => surfaces.first_primitive(id),
        };
        match &placed.form {
            Form::Parallelogram(form) => {
                let polygon = ConvexPolygon::new(form.corners().to_vec());
                self.add_polygon(id, placed.parts[0], first..first + 2, polygon, sides);
            }
            Form::Mesh(mesh) => {
                let mut triangle = 0;
                while triangle < mesh.triangles.len() {
                    let (polygon, end) = fan(mesh, &placed.parts, triangle);
                    let primitives = first + triangle as u32..first + end as u32;
                    self.add_polygon(id, placed.parts[triangle], primitives, polygon, sides);
                    triangle = end;
                }
            }
            Form::Disc(disc) => {
                let back = Disc {
                    normal: -disc.normal,
                    ..disc.clone()
                };
                let extents = [disc.clone(), back].map(Extent::Disc);
                self.add(id, placed.parts[0], first..first + 1, extents, sides);
            }
            Form::Sphere(sphere) => {
                let back = Sphere {
                    inside: !sphere.inside,
                    ..sphere.clone()
                };
                let extents = [sphere.clone(), back].map(Extent::Sphere);
                self.add(id, placed.parts[0], first..first + 1, extents, sides);
            }
            Form::Plane { .. } => {}
        }
    }

    /// Triangles without area are no facets; rays do not meet them either.
    fn add_polygon(
        &mut self,
        shape: ShapeId,
        part: PartId,
        primitives: std::ops::Range<u32>,
        polygon: Option<ConvexPolygon>,
        sides: Sides,
    ) {
        if let Some(polygon) = polygon {
            let extents = [polygon.clone(), polygon.reversed()].map(Extent::Polygon);
            self.add(shape, part, primitives, extents, sides);
        }
    }

    fn add(
        &mut self,
        shape: ShapeId,
        part: PartId,
        primitives: std::ops::Range<u32>,
        extents: [Extent; 2],
        sides: Sides,
    ) {
        let number = self.in_shape[shape.0 as usize];
        self.in_shape[shape.0 as usize] += 1;
        for (is_back, extent) in [false, true].into_iter().zip(extents) {
            let wanted = if is_back { Sides::Front } else { Sides::Back };
            if sides == wanted {
                continue;
            }
            let index = self.list.len() as u32;
            for primitive in primitives.clone() {
                self.of_primitive[primitive as usize][usize::from(is_back)] = index;
            }
            let area = extent.area();
            self.lift.push(self.lift_of(&extent));
            self.outlines.push(extent.outline());
            self.list.push(Facet {
                shape,
                part,
                number,
                is_back,
                extent,
                area,
            });
        }
    }

    /// 16 · 2⁻²⁴ of the coordinates in the kernel, which is twice its bound on the rounding of a hit point, and of the size.
    fn lift_of(&self, extent: &Extent) -> f64 {
        let origin = self.surfaces().origin();
        let reach = |point: Point| (point - origin).max_component();
        let (farthest, size) = match extent {
            Extent::Polygon(polygon) => {
                let corners = polygon.corners().iter();
                let farthest = corners.fold(0.0_f64, |most, &corner| most.max(reach(corner)));
                (farthest, polygon.diameter())
            }
            Extent::Disc(disc) => (reach(disc.center), disc.radius),
            Extent::Sphere(sphere) => (reach(sphere.center), sphere.radius),
        };
        16.0 * f64::from(f32::EPSILON) * 0.5 * (farthest + size)
    }
}

impl Extent {
    fn outline(&self) -> Option<Polygon> {
        match self {
            Self::Polygon(polygon) => Polygon::new(polygon.corners().to_vec(), Vec::new()).ok(),
            Self::Disc(_) | Self::Sphere(_) => None,
        }
    }

    fn area(&self) -> f64 {
        match self {
            Self::Polygon(polygon) => polygon.area(),
            Self::Disc(disc) => disc.area(),
            Self::Sphere(sphere) => sphere.area(),
        }
    }
}

/// The polygon that starts with triangle `first`, and the number of the triangle after it. Readers of meshes cut convex polygons
/// into fans (a, b, c), (a, c, d) … or, turned inside out, (a, c, b), (a, d, c) …; as long as these stay convex, plane and of one
/// part, they are one polygon here.
fn fan(mesh: &TriangleMesh, parts: &[PartId], first: usize) -> (Option<ConvexPolygon>, usize) {
    let mut corners = mesh.triangles[first].to_vec();
    let points = |corners: &[u32]| corners.iter().map(|&c| mesh.vertices[c as usize]).collect();
    let mut polygon = ConvexPolygon::new(points(&corners));
    let mut end = first + 1;
    while end < mesh.triangles.len() && parts[end] == parts[first] && polygon.is_some() {
        let [a, b, c] = mesh.triangles[end];
        if a != corners[0] || corners.len() >= ConvexPolygon::MOST_CORNERS {
            break;
        }
        match (corners[1], corners.last()) {
            (_, Some(&last)) if last == b => corners.push(c),
            (second, _) if second == c => corners.insert(1, b),
            _ => break,
        }
        let Some(larger) = ConvexPolygon::new(points(&corners)) else {
            break;
        };
        polygon = Some(larger);
        end += 1;
    }
    (polygon, end)
}

/// The direction at a cosine-distributed angle from `normal`.
pub(super) fn cosine_direction(normal: Direction, u: [f64; 2]) -> Vector {
    let frame = crate::geometry::Frame::from_normal(normal);
    let radius = u[0].sqrt();
    let (sin, cos) = libm::sincos(TAU * u[1]);
    frame.vector_to_world(Vector::new(radius * cos, radius * sin, (1.0 - u[0]).sqrt()))
}
