//! Shapes: from their description to forms in world coordinates, one for each copy of a repeat.

use super::box_form::{BoxMesh, box_mesh, faces_of};
use super::description::{GeometryDescription, MeshData, Opening, Port, Repeat, ShapeDescription};
use super::materials::Materials;
use super::{Part, PartProperties, Problem};
use crate::geometry::{Direction, Point, Polygon, Transform, Vector};
use crate::material::MaterialId;
use crate::shape::{
    Disc, Form, Parallelogram, PartId, Placed, ShapeId, Sphere, SpherePort, TriangleMesh,
};

/// Copies a repeat may make.
const MAX_COPIES: u64 = 10_000_000;

/// All forms of a scene.
#[derive(Default)]
pub(super) struct Forms {
    pub placed: Vec<Placed>,
    pub names: Vec<String>,
    pub parts: Vec<PartProperties>,
    /// The forms of each described shape.
    pub of_description: Vec<std::ops::Range<usize>>,
}

impl Forms {
    /// The forms of the shapes that have this name.
    pub fn named(&self, descriptions: &[ShapeDescription], name: &str) -> Vec<ShapeId> {
        let wanted = descriptions
            .iter()
            .zip(&self.of_description)
            .filter(|(shape, _)| shape.name.as_deref() == Some(name));
        wanted
            .flat_map(|(_, range)| range.clone().map(|index| ShapeId(index as u32)))
            .collect()
    }

    fn part(&mut self, sides: [MaterialId; 2]) -> PartId {
        self.parts.push(PartProperties {
            front: sides[0],
            back: sides[1],
            light: None,
        });
        PartId(self.parts.len() as u32 - 1)
    }
}

/// A form with the part (counted from 0) of each triangle.
struct Shaped {
    form: Form,
    faces: Vec<usize>,
}

impl From<Form> for Shaped {
    fn from(form: Form) -> Self {
        let count = if let Form::Mesh(mesh) = &form {
            mesh.triangles.len()
        } else {
            1
        };
        Self {
            form,
            faces: vec![0; count],
        }
    }
}

pub(super) fn prepare(
    shapes: &[ShapeDescription],
    materials: &Materials,
    problems: &mut Vec<Problem>,
) -> Forms {
    let mut forms = Forms::default();
    for (index, shape) in shapes.iter().enumerate() {
        let first = forms.placed.len();
        let part = Part::Shape(index);
        let sides = part_materials(shape, materials, part, problems);
        for (copy, step) in copies(shape.repeat.as_ref(), part, problems)
            .into_iter()
            .enumerate()
        {
            let transform = shape.transform.then(Transform::translate(step));
            match form(&shape.geometry, &transform) {
                Ok(shaped) => add(&mut forms, shape, index, copy, shaped, &sides),
                Err(message) => {
                    problems.push(Problem::of(part, message));
                    break;
                }
            }
        }
        forms.of_description.push(first..forms.placed.len());
    }
    forms
}

fn add(
    forms: &mut Forms,
    shape: &ShapeDescription,
    index: usize,
    copy: usize,
    shaped: Shaped,
    sides: &[[MaterialId; 2]],
) {
    let parts: Vec<_> = sides.iter().map(|sides| forms.part(*sides)).collect();
    let parts = shaped.faces.iter().map(|face| parts[*face]).collect();
    let base = shape
        .name
        .clone()
        .unwrap_or_else(|| format!("{} {index}", shaped.form.kind()));
    forms.names.push(if shape.repeat.is_some() {
        format!("{base}[{copy}]")
    } else {
        base
    });
    forms.placed.push(Placed {
        form: shaped.form,
        parts,
    });
}

/// Materials of each part: one, or six faces and the openings of a box.
fn part_materials(
    shape: &ShapeDescription,
    materials: &Materials,
    part: Part,
    problems: &mut Vec<Problem>,
) -> Vec<[MaterialId; 2]> {
    let mut lookup = |name: &str, key: &'static str| {
        materials.sides(name).unwrap_or_else(|| {
            problems.push(Problem::at(part, key, materials.unknown(name)));
            [MaterialId::BLACK; 2]
        })
    };
    let own = shape
        .material
        .as_deref()
        .map_or([MaterialId::BLACK; 2], |name| lookup(name, "material"));
    let GeometryDescription::Box {
        faces, openings, ..
    } = &shape.geometry
    else {
        return vec![own];
    };
    let mut sides = vec![own; 6 + openings.len()];
    for (face, material) in faces {
        for index in faces_of(face).unwrap_or_default() {
            sides[*index] = lookup(material, "faces");
        }
    }
    for (index, opening) in openings.iter().enumerate() {
        if let Some(material) = &opening.material {
            sides[6 + index] = lookup(material, "openings");
        }
    }
    sides
}

/// Displacements of the copies.
pub(super) fn copies(
    repeat: Option<&Repeat>,
    part: Part,
    problems: &mut Vec<Problem>,
) -> Vec<Vector> {
    let Some(repeat) = repeat else {
        return vec![Vector::ZERO];
    };
    let count: u64 = repeat.count.iter().map(|count| u64::from(*count)).product();
    if repeat.count.len() != repeat.step.len() || count == 0 || count > MAX_COPIES {
        let message =
            format!("repeat needs a step for each count and 1 to {MAX_COPIES} copies in all");
        problems.push(Problem::at(part, "repeat", message));
        return vec![];
    }
    let mut steps = vec![Vector::ZERO];
    for (count, step) in repeat.count.iter().zip(&repeat.step) {
        steps = steps
            .iter()
            .flat_map(|base| (0..*count).map(move |i| *base + *step * f64::from(i)))
            .collect();
    }
    steps
}

impl GeometryDescription {
    /// The form of this geometry by itself.
    ///
    /// # Errors
    /// If there is no such form: a polygon that is not plane, a radius that is not positive …
    pub fn form(&self, transform: &Transform) -> Result<Form, Problem> {
        let shaped = form(self, transform).map_err(|message| Problem::of(Part::Scene, message))?;
        Ok(shaped.form)
    }
}

/// The form of a geometry, also for sensors' surfaces.
pub(super) fn virtual_form(
    geometry: &GeometryDescription,
    transform: &Transform,
) -> Result<Form, String> {
    match geometry {
        GeometryDescription::Ground { .. } => Err("a flux surface has a finite area".into()),
        _ => form(geometry, transform).map(|shaped| shaped.form),
    }
}

fn form(geometry: &GeometryDescription, transform: &Transform) -> Result<Shaped, String> {
    match geometry {
        GeometryDescription::Rectangle { origin, edges } => parallelogram(
            transform.point(*origin),
            edges.map(|edge| transform.vector(edge)),
        ),
        GeometryDescription::Polygon { vertices, holes } => polygon(vertices, holes, transform),
        GeometryDescription::Disc {
            center,
            normal,
            radius,
            inner_radius,
        } => disc(*center, *normal, [*inner_radius, *radius], transform),
        GeometryDescription::Sphere {
            center,
            radius,
            inside,
            ports,
        } => sphere(*center, *radius, *inside, ports, transform),
        GeometryDescription::Box {
            min,
            max,
            inside,
            openings,
            ..
        } => boxed(*min, *max, *inside, openings, transform),
        GeometryDescription::Mesh(data) => mesh(data, transform),
        GeometryDescription::Ground { height } => ground(*height, transform),
    }
}

fn parallelogram(origin: Point, edges: [Vector; 2]) -> Result<Shaped, String> {
    finite("origin", origin.is_finite())?;
    let form = Parallelogram::new(origin, edges)
        .ok_or("the edges of a rectangle span an area: they are neither zero nor parallel")?;
    Ok(Form::Parallelogram(form).into())
}

fn polygon(
    vertices: &[Point],
    holes: &[Vec<Point>],
    transform: &Transform,
) -> Result<Shaped, String> {
    let moved = |points: &[Point]| {
        points
            .iter()
            .map(|point| transform.point(*point))
            .collect::<Vec<_>>()
    };
    let polygon = Polygon::new(
        moved(vertices),
        holes.iter().map(|hole| moved(hole)).collect(),
    )
    .map_err(|error| error.to_string())?;
    let mesh = TriangleMesh::new(polygon.vertices().to_vec(), polygon.triangles().to_vec());
    Ok(Form::Mesh(mesh).into())
}

fn similarity(transform: &Transform, what: &str) -> Result<f64, String> {
    transform
        .similarity_scale()
        .ok_or_else(|| format!("a {what} can be scaled by the same factor in all directions only"))
}

fn disc(
    center: Point,
    normal: Vector,
    radii: [f64; 2],
    transform: &Transform,
) -> Result<Shaped, String> {
    let scale = similarity(transform, "disc")?;
    let [inner_radius, radius] = radii.map(|radius| radius * scale);
    if !(radius > 0.0 && radius.is_finite() && inner_radius >= 0.0 && inner_radius < radius) {
        return Err(format!(
            "a disc's radius is positive and its inner_radius between 0 and it, not {radius} and {inner_radius}"
        ));
    }
    let normal = Direction::new(normal).map_err(|_| "a disc's normal is not zero")?;
    let normal = transform
        .normal(normal)
        .map_err(|_| "a disc's normal vanishes under this transform")?;
    let center = transform.point(center);
    finite("center", center.is_finite())?;
    Ok(Form::Disc(Disc {
        center,
        normal,
        radius,
        inner_radius,
    })
    .into())
}

fn sphere(
    center: Point,
    radius: f64,
    inside: bool,
    ports: &[Port],
    transform: &Transform,
) -> Result<Shaped, String> {
    let radius = radius * similarity(transform, "sphere")?;
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(format!("a sphere's radius is positive, not {radius}"));
    }
    let center = transform.point(center);
    finite("center", center.is_finite())?;
    let ports = ports
        .iter()
        .map(|port| sphere_port(port, transform))
        .collect::<Result<_, _>>()?;
    let sphere = Sphere {
        center,
        radius,
        inside,
        ports,
    };
    if sphere.ports_overlap() {
        return Err("the ports of a sphere do not overlap".into());
    }
    Ok(Form::Sphere(sphere).into())
}

fn sphere_port(port: &Port, transform: &Transform) -> Result<SpherePort, String> {
    let direction = Direction::new(transform.vector(port.direction))
        .map_err(|_| "a port's direction is not zero")?;
    let degrees = port.half_angle.to_degrees();
    if !(degrees > 0.0 && degrees < 180.0) {
        return Err(format!(
            "a port's half_angle lies between 0 and 180 deg, not {degrees} deg"
        ));
    }
    Ok(SpherePort {
        direction,
        cos_half_angle: port.half_angle.cos(),
    })
}

fn boxed(
    min: Point,
    max: Point,
    inside: bool,
    openings: &[Opening],
    transform: &Transform,
) -> Result<Shaped, String> {
    let (low, high) = (min.to_array(), max.to_array());
    if !(min.is_finite() && max.is_finite() && low.iter().zip(&high).all(|(low, high)| low < high))
    {
        return Err(format!(
            "each coordinate of a box's max is greater than that of min, not {low:?} and {high:?}"
        ));
    }
    if let Some(unknown) = openings
        .iter()
        .find(|opening| opening.face_index().is_none())
    {
        return Err(format!(
            "an opening's face is x-, x+, y-, y+, z- (floor) or z+ (ceiling), not `{}`",
            unknown.face
        ));
    }
    let BoxMesh {
        vertices,
        triangles,
        faces,
    } = box_mesh(min, max, inside, openings)?;
    let form = transformed(&vertices, &triangles, transform)?;
    Ok(Shaped { form, faces })
}

fn mesh(data: &MeshData, transform: &Transform) -> Result<Shaped, String> {
    let count = data.vertices.len();
    if let Some(index) = data.vertices.iter().position(|vertex| !vertex.is_finite()) {
        return Err(format!(
            "vertex {index} of the mesh is not finite: {:?}",
            data.vertices[index].to_array()
        ));
    }
    if let Some(index) = data
        .triangles
        .iter()
        .position(|triangle| triangle.iter().any(|&vertex| vertex as usize >= count))
    {
        return Err(format!(
            "triangle {index} of the mesh names a vertex beyond the last, {count}"
        ));
    }
    transformed(&data.vertices, &data.triangles, transform).map(Shaped::from)
}

fn transformed(
    vertices: &[Point],
    triangles: &[[u32; 3]],
    transform: &Transform,
) -> Result<Form, String> {
    let vertices: Vec<_> = vertices
        .iter()
        .map(|vertex| transform.point(*vertex))
        .collect();
    finite("vertices", vertices.iter().all(|vertex| vertex.is_finite()))?;
    let mirrored = transform.is_mirroring();
    let triangles = triangles
        .iter()
        .map(|&[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] })
        .collect();
    let mesh = TriangleMesh::new(vertices, triangles);
    if mesh.area() > 0.0 && mesh.area().is_finite() {
        Ok(Form::Mesh(mesh))
    } else {
        Err("the mesh has no area".into())
    }
}

fn ground(height: f64, transform: &Transform) -> Result<Shaped, String> {
    let point = transform.point(Point::new(0.0, 0.0, height));
    finite("height", point.is_finite())?;
    let normal = transform
        .normal(Direction::Z)
        .map_err(|_| "the ground's normal vanishes under this transform")?;
    Ok(Form::Plane { point, normal }.into())
}

fn finite(key: &str, holds: bool) -> Result<(), String> {
    if holds {
        Ok(())
    } else {
        Err(format!(
            "{key}: every coordinate is a finite number of metres"
        ))
    }
}
