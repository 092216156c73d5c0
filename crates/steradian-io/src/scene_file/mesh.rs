//! The triangles of a mesh, from a file or inline, and the materials that the file gives them.

use std::cell::OnceCell;
use std::path::Path;
use std::sync::Arc;

use steradian::geometry::Point;
use steradian::quantity::Length;
use steradian::scene::description::{EmissionDescription, GeometryDescription, MeshData};

use crate::import::{self, MeshFile};

use super::fields::Fields;
use super::up::UpAxis;

/// A part of a shape, with what its file says of it.
pub(super) struct Surface {
    pub geometry: GeometryDescription,
    /// What tells it from the other parts, if there are any.
    part: Option<String>,
    pub material: Option<String>,
    pub emission: Option<EmissionDescription>,
}

impl Surface {
    /// A surface of which no file says more.
    pub fn plain(geometry: GeometryDescription) -> Self {
        Self {
            geometry,
            part: None,
            material: None,
            emission: None,
        }
    }

    /// Its name, as a part of the shape called `shape`.
    pub fn named(&self, shape: Option<&str>) -> Option<String> {
        match (shape, &self.part) {
            (Some(shape), Some(part)) => Some(format!("{shape}/{part}")),
            (name, part) => name.map(str::to_owned).or(part.clone()),
        }
    }
}

/// A mesh file in metres and the scene's axes.
#[derive(Debug)]
pub(super) struct LoadedMesh {
    file: MeshFile,
    merged: OnceCell<Option<Arc<MeshData>>>,
}

/// Reads the surfaces of a mesh: one a material where the shape itself names none. Shapes that name the same file alike
/// share their triangles.
pub(super) fn read(fields: &Fields<'_>) -> Option<Vec<Surface>> {
    if fields.has("vertices") {
        let (vertices, triangles) = (fields.get("vertices"), fields.get("triangles"));
        let mesh = MeshData {
            vertices: vertices?,
            triangles: triangles?,
            ..MeshData::default()
        };
        return Some(vec![Surface::plain(GeometryDescription::Mesh(Arc::new(
            mesh,
        )))]);
    }
    let name = fields.get::<String>("file");
    let mesh = loaded(fields, name.as_deref())?;
    if fields.has("material") {
        let merged = mesh.merged.get_or_init(|| mesh.file.merged());
        if merged.is_none() {
            fields.context().error(
                fields.span_of("file"),
                "a mesh of more vertices than can be numbered",
                None,
            );
        }
        let mesh = merged.as_ref().map(Arc::clone)?;
        return Some(vec![Surface::plain(GeometryDescription::Mesh(mesh))]);
    }
    Some(by_material(fields, &name?, &mesh.file))
}

fn by_material(fields: &Fields<'_>, name: &str, file: &MeshFile) -> Vec<Surface> {
    let has_many = file.parts.len() > 1;
    let surface = |part: &import::MeshPart| {
        let material = part.material.map(|index| &file.materials[index]);
        let known = material.map(|material| {
            let mut material = material.material.clone();
            material.name = format!("{name}: {}", material.name);
            fields
                .context()
                .add_material(material, fields.span_of("file"))
        });
        Surface {
            geometry: GeometryDescription::Mesh(Arc::clone(&part.mesh)),
            part: material
                .filter(|_| has_many)
                .map(|material| material.material.name.clone()),
            material: known,
            emission: material.and_then(|material| material.emission.clone()),
        }
    };
    file.parts.iter().map(surface).collect()
}

fn loaded(fields: &Fields<'_>, name: Option<&str>) -> Option<Arc<LoadedMesh>> {
    let unit = unit(fields);
    let scene_up = fields.context().up.get();
    let up: Option<UpAxis> = if fields.has("up") {
        fields.get("up")
    } else {
        Some(scene_up)
    };
    let name = name?;
    let key = format!("{name}\n{unit:?}\n{up:?}");
    fields.context().mesh(key, || {
        let mut file = from_file(fields, name)?;
        let (unit, up) = (unit?, if file.is_oriented { UpAxis::Z } else { up? });
        for part in &mut file.parts {
            let mesh = Arc::make_mut(&mut part.mesh);
            for vertex in &mut mesh.vertices {
                *vertex = up.point_in(scene_up, scaled(*vertex, unit));
            }
            for normal in &mut mesh.normals {
                let turned = up.point_in(scene_up, Point::from(normal.map(f64::from)));
                *normal = turned.to_array().map(|part| part as f32);
            }
        }
        tell(fields, name, &file);
        Some(LoadedMesh {
            file,
            merged: OnceCell::new(),
        })
    })
}

/// Adds what was assumed and approximated to the warnings.
fn tell(fields: &Fields<'_>, name: &str, file: &MeshFile) {
    if file.is_oriented && fields.has("up") {
        let message = format!("{name} says itself which axis is up");
        fields.context().error(fields.span_of("up"), message, None);
    }
    if !(file.is_oriented || fields.has("unit")) {
        let warning = format!(
            "{name} has no unit: its numbers are read as metres; `unit` sets another, `up` its axis"
        );
        fields.context().warn(warning);
    }
    for warning in &file.warnings {
        fields.context().warn(format!("{name}: {warning}"));
    }
}

fn scaled(point: Point, unit: f64) -> Point {
    Point::new(point.x * unit, point.y * unit, point.z * unit)
}

/// The size of the file's unit in metres.
fn unit(fields: &Fields<'_>) -> Option<f64> {
    let name: String = fields.get("unit")?;
    let unit = format!("1 {name}")
        .parse::<Length>()
        .map(Length::to_metres)
        .ok()
        .filter(|_| !name.trim().is_empty());
    if unit.is_none() {
        let message = format!("expected a unit of length such as \"mm\", found {name:?}");
        fields
            .context()
            .error(fields.span_of("unit"), message, None);
    }
    unit
}

fn from_file(fields: &Fields<'_>, name: &str) -> Option<MeshFile> {
    let span = fields.span_of("file");
    if import::MeshFormat::of(Path::new(name)).is_none() {
        let message =
            format!("expected a mesh file (.obj, .ply, .stl, .gltf or .glb), found {name:?}");
        fields.context().error(span, message, None);
        return None;
    }
    let bytes = fields.context().read_file(name, span.clone())?;
    let (path, files) = (fields.context().path_of(name), fields.context().files());
    match import::mesh(&path, &bytes, files) {
        Ok(file) => Some(file),
        Err(error) => {
            fields
                .context()
                .error(span, format!("{name}: {error}"), None);
            None
        }
    }
}
