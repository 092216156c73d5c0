//! Geometry: from its description to a form in world coordinates.
//!
//! The front of an image under a transform is the image of the front, also if the transform mirrors: the edges of a
//! rectangle and the corners of triangles then change places.

use super::box_form::{BoxMesh, box_mesh};
use super::description::{GeometryDescription, MeshData, Opening, Port};
use super::{Fault, Part, Problem};
use crate::geometry::{Direction, Point, Polygon, PolygonError, Transform, Vector};
use crate::shape::{Attributes, Disc, Form, Parallelogram, Sphere, SpherePort, TriangleMesh};

/// A form with the part (counted from 0) of each triangle.
pub(super) struct Shaped {
    pub form: Form,
    pub faces: Vec<usize>,
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

/// The form of a sensor's surface.
pub(super) fn virtual_form(
    geometry: &GeometryDescription,
    transform: &Transform,
) -> Result<Form, String> {
    match geometry {
        GeometryDescription::Ground { .. } => Err("a flux surface has a finite area".into()),
        _ => form(geometry, transform)
            .map(|shaped| shaped.form)
            .map_err(|(_, message)| message),
    }
}

impl GeometryDescription {
    /// The form of this geometry by itself.
    ///
    /// # Errors
    /// If there is no such form: a polygon that is not plane, a radius that is not positive …
    pub fn form(&self, transform: &Transform) -> Result<Form, Problem> {
        form(self, transform)
            .map(|shaped| shaped.form)
            .map_err(|(key, message)| Problem::at(Part::Scene, key, message))
    }
}

/// The form of a shape; a fault names the key it is about.
pub(super) fn form(geometry: &GeometryDescription, transform: &Transform) -> Result<Shaped, Fault> {
    match geometry {
        GeometryDescription::Rectangle { origin, edges } => {
            parallelogram(*origin, *edges, transform)
        }
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

fn parallelogram(
    origin: Point,
    edges: [Vector; 2],
    transform: &Transform,
) -> Result<Shaped, Fault> {
    let origin = transform.point(origin);
    finite("origin", origin.is_finite())?;
    let [a, b] = edges.map(|edge| transform.vector(edge));
    let edges = if transform.is_mirroring() {
        [b, a]
    } else {
        [a, b]
    };
    let message = "the edges of a rectangle span an area: they are neither zero nor parallel";
    let form = Parallelogram::new(origin, edges).ok_or_else(|| ("edges", message.into()))?;
    Ok(Form::Parallelogram(form).into())
}

fn polygon(
    vertices: &[Point],
    holes: &[Vec<Point>],
    transform: &Transform,
) -> Result<Shaped, Fault> {
    let fault = |error: PolygonError| (polygon_key(&error), error.to_string());
    let polygon = Polygon::new(vertices.to_vec(), holes.to_vec()).map_err(fault)?;
    let polygon = polygon
        .transformed(transform)
        .map_err(|error| ("transform", error.to_string()))?;
    let mesh = TriangleMesh::new(polygon.vertices().to_vec(), polygon.triangles().to_vec());
    Ok(Form::Mesh(mesh).into())
}

fn polygon_key(error: &PolygonError) -> &'static str {
    match error {
        PolygonError::TooFewVertices { ring, .. }
        | PolygonError::NotFinite { ring, .. }
        | PolygonError::NotPlanar { ring, .. }
            if *ring > 0 =>
        {
            "holes"
        }
        _ => "vertices",
    }
}

fn similarity(transform: &Transform, what: &str) -> Result<f64, Fault> {
    let message = || {
        format!("a {what} can be scaled by the same factor in all directions only, and not by 0")
    };
    transform
        .similarity_scale()
        .ok_or_else(|| ("transform", message()))
}

fn disc(
    center: Point,
    normal: Vector,
    radii: [f64; 2],
    transform: &Transform,
) -> Result<Shaped, Fault> {
    let [inner, outer] = radii;
    if !(outer > 0.0 && outer.is_finite() && inner >= 0.0 && inner < outer) {
        let message = format!(
            "a disc's radius is positive and its inner_radius at least 0 and below it, not {outer} and {inner}"
        );
        return Err(("radius", message));
    }
    let scale = similarity(transform, "disc")?;
    let normal = Direction::new(normal)
        .and_then(|normal| transform.normal(normal))
        .map_err(|_| ("normal", "a disc's normal is finite and not zero".into()))?;
    let center = transform.point(center);
    finite("center", center.is_finite())?;
    Ok(Form::Disc(Disc {
        center,
        normal,
        radius: outer * scale,
        inner_radius: inner * scale,
    })
    .into())
}

fn sphere(
    center: Point,
    radius: f64,
    inside: bool,
    ports: &[Port],
    transform: &Transform,
) -> Result<Shaped, Fault> {
    if !(radius > 0.0 && radius.is_finite()) {
        let message = format!("a sphere's radius is positive and finite, not {radius}");
        return Err(("radius", message));
    }
    let center = transform.point(center);
    finite("center", center.is_finite())?;
    let sphere = Sphere {
        center,
        radius: radius * similarity(transform, "sphere")?,
        inside,
        ports: ports
            .iter()
            .map(|port| sphere_port(port, transform))
            .collect::<Result<_, _>>()?,
    };
    if sphere.ports_overlap() {
        return Err(("ports", "the ports of a sphere do not overlap".into()));
    }
    Ok(Form::Sphere(sphere).into())
}

fn sphere_port(port: &Port, transform: &Transform) -> Result<SpherePort, Fault> {
    let direction = Direction::new(transform.vector(port.direction)).map_err(|_| {
        let message = "a port's direction is finite and not zero";
        ("ports", message.to_string())
    })?;
    let degrees = port.half_angle.to_degrees();
    if !(degrees > 0.0 && degrees < 180.0) {
        let message = format!("a port's half_angle lies between 0 and 180 deg, not {degrees} deg");
        return Err(("ports", message));
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
) -> Result<Shaped, Fault> {
    let (low, high) = (min.to_array(), max.to_array());
    let ordered = low.iter().zip(&high).all(|(low, high)| low < high);
    if !(min.is_finite() && max.is_finite() && ordered) {
        let message = format!(
            "each coordinate of a box's max is greater than that of min, not {high:?} and {low:?}"
        );
        return Err(("max", message));
    }
    let BoxMesh {
        vertices,
        triangles,
        faces,
    } = box_mesh(min, max, inside, openings).map_err(|message| ("openings", message))?;
    let form = transformed(&vertices, &triangles, transform)?;
    Ok(Shaped { form, faces })
}

fn mesh(data: &MeshData, transform: &Transform) -> Result<Shaped, Fault> {
    let count = data.vertices.len();
    if let Some(index) = data.vertices.iter().position(|vertex| !vertex.is_finite()) {
        let vertex = data.vertices[index].to_array();
        let message = format!("vertex {index} of the mesh is not finite: {vertex:?}");
        return Err(("vertices", message));
    }
    let beyond = |triangle: &[u32; 3]| triangle.iter().any(|&vertex| vertex as usize >= count);
    if let Some(index) = data.triangles.iter().position(beyond) {
        let message =
            format!("triangle {index} of the mesh names a vertex beyond its {count} vertices");
        return Err(("triangles", message));
    }
    let attributes = Attributes {
        normals: normals(data, transform)?,
        ..attributes(data)?
    };
    let form = transformed(&data.vertices, &data.triangles, transform)?;
    Ok(match form {
        Form::Mesh(mesh) => Form::Mesh(mesh.with_attributes(attributes)),
        other => other,
    }
    .into())
}

/// Attributes, of which a mesh has none or one for each vertex.
fn attributes(data: &MeshData) -> Result<Attributes, Fault> {
    let count = data.vertices.len();
    let (coordinates, colors) = (&data.texture_coordinates, &data.colors);
    for (what, found) in [
        ("texture coordinates", coordinates.len()),
        ("colours", colors.len()),
    ] {
        if found != 0 && found != count {
            let message = format!("a mesh of {count} vertices has {found} {what}");
            return Err(("vertices", message));
        }
    }
    if let Some(vertex) = coordinates
        .iter()
        .position(|uv| uv.iter().any(|x| !x.is_finite()))
    {
        let message = format!("the texture coordinates of vertex {vertex} are not finite");
        return Err(("vertices", message));
    }
    let outside = |color: &[f32; 4]| color.iter().any(|x| !(0.0..=1.0).contains(x));
    if let Some(vertex) = colors.iter().position(outside) {
        let message = format!(
            "the colour of vertex {vertex} lies between 0 and 1, not {:?}",
            colors[vertex]
        );
        return Err(("vertices", message));
    }
    Ok(Attributes {
        coordinates: coordinates.clone(),
        colors: colors.clone(),
        normals: vec![],
    })
}

/// Normals of the vertices as the transform turns them.
fn normals(data: &MeshData, transform: &Transform) -> Result<Vec<[f32; 3]>, Fault> {
    let (count, found) = (data.vertices.len(), data.normals.len());
    if found != 0 && found != count {
        let message = format!("a mesh of {count} vertices has {found} normals");
        return Err(("vertices", message));
    }
    let turned = |(vertex, normal): (usize, &[f32; 3])| {
        let normal = Direction::new(Vector::from(normal.map(f64::from)));
        let turned = normal.and_then(|normal| transform.normal(normal));
        turned
            .map(|normal| normal.to_array().map(|x| x as f32))
            .map_err(|error| {
                (
                    "vertices",
                    format!("the normal of vertex {vertex}: {error}"),
                )
            })
    };
    data.normals.iter().enumerate().map(turned).collect()
}

fn transformed(
    vertices: &[Point],
    triangles: &[[u32; 3]],
    transform: &Transform,
) -> Result<Form, Fault> {
    let image = vertices.iter().map(|vertex| transform.point(*vertex));
    let vertices: Vec<_> = image.collect();
    finite(
        "transform",
        vertices.iter().all(|vertex| vertex.is_finite()),
    )?;
    let mirrored = transform.is_mirroring();
    let triangles = triangles
        .iter()
        .map(|&[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] })
        .collect();
    let mesh = TriangleMesh::new(vertices, triangles);
    if mesh.has_area() && mesh.area().is_finite() {
        Ok(Form::Mesh(mesh))
    } else {
        let message = "the mesh has no area: it needs a triangle whose corners are not on one line";
        Err(("triangles", message.into()))
    }
}

fn ground(height: f64, transform: &Transform) -> Result<Shaped, Fault> {
    let point = transform.point(Point::new(0.0, 0.0, height));
    finite("height", point.is_finite())?;
    let normal = transform.normal(Direction::Z).map_err(|_| {
        let message = "the ground's normal vanishes under this transform";
        ("transform", message.to_string())
    })?;
    Ok(Form::Plane { point, normal }.into())
}

fn finite(key: &'static str, holds: bool) -> Result<(), Fault> {
    let message = || format!("{key}: every coordinate is a finite number of metres");
    if holds { Ok(()) } else { Err((key, message())) }
}
