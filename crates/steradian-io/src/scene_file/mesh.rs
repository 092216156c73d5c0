//! The triangles of a mesh, from a file or inline.

use std::sync::Arc;

use steradian::geometry::Point;
use steradian::quantity::Length;
use steradian::scene::description::MeshData;

use crate::import::obj;

use super::fields::Fields;
use super::up::UpAxis;

/// Reads the mesh of a shape. Shapes that name the same file alike share their triangles.
pub(super) fn read(fields: &Fields<'_>) -> Option<Arc<MeshData>> {
    if fields.has("vertices") {
        let (vertices, triangles) = (fields.get("vertices"), fields.get("triangles"));
        return Some(Arc::new(MeshData {
            vertices: vertices?,
            triangles: triangles?,
            ..MeshData::default()
        }));
    }
    let (file, unit) = (fields.get::<String>("file"), unit(fields));
    let scene_up = fields.context().up.get();
    let up: Option<UpAxis> = if fields.has("up") {
        fields.get("up")
    } else {
        Some(scene_up)
    };
    let file = file?;
    let key = format!("{file}\n{unit:?}\n{up:?}");
    fields.context().mesh(key, || {
        let mut mesh = from_file(fields, &file)?;
        let (unit, up) = (unit?, up?);
        for vertex in &mut mesh.vertices {
            *vertex = up.point_in(scene_up, scaled(*vertex, unit));
        }
        Some(mesh)
    })
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

fn from_file(fields: &Fields<'_>, file: &str) -> Option<MeshData> {
    let span = fields.span_of("file");
    let is_obj = file
        .rsplit('.')
        .next()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("obj"));
    if !is_obj {
        let message = format!(
            "expected an OBJ file (.obj), found {file:?}; other mesh formats are not supported yet"
        );
        fields.context().error(span, message, None);
        return None;
    }
    let bytes = fields.context().read_file(file, span.clone())?;
    match obj::read(&bytes) {
        Ok(mesh) => Some(mesh),
        Err(error) => {
            fields
                .context()
                .error(span, format!("{file}: {error}"), None);
            None
        }
    }
}
