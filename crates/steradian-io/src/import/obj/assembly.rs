//! From the statements of an OBJ file to meshes: one vertex for each position with its texture coordinates
//! and normal.

use std::collections::HashMap;
use std::sync::Arc;

use steradian::material::linear_from_srgb;
use steradian::scene::description::MeshData;

use super::mtl::Library;
use super::{Corner, ObjError, ObjFault, Reader, Run};
use crate::import::mesh_file::{MeshFile, MeshPart, vertex_colors};
use crate::import::normals::LEFT_OUT;

/// The meshes of all runs, with the materials that they use.
pub(super) fn assemble(mut reader: Reader, mut library: Library) -> Result<MeshFile, ObjError> {
    let mut file = MeshFile {
        warnings: std::mem::take(&mut library.warnings),
        ..MeshFile::default()
    };
    if reader.colors.len() < reader.vertices.len() {
        let some = !reader.colors.is_empty();
        file.warnings.extend(
            some.then(|| "vertex colours are passed over: not every vertex has one".into()),
        );
        reader.colors.clear();
    } else {
        file.warnings.push("vertex colours are read as sRGB".into());
    }
    let runs = std::mem::take(&mut reader.runs).into_iter();
    for run in runs.filter(|run| !run.triangles.is_empty()) {
        let material = run
            .material
            .as_deref()
            .and_then(|name| library.material(name));
        if let (Some(name), None) = (&run.material, &material) {
            file.warnings
                .push(format!("no material library defines `{name}`"));
        }
        let material = material.or_else(|| (!reader.colors.is_empty()).then(vertex_colors));
        let material = material.map(|material| file.index_of(material));
        let has_normals = run.corners().any(|corner| corner.normal.is_some());
        let mesh = mesh(&reader, &run).ok_or(TOO_MANY)?;
        if has_normals && mesh.normals.is_empty() {
            file.warn(LEFT_OUT);
        }
        file.parts.push(MeshPart {
            mesh: Arc::new(mesh),
            material,
        });
    }
    Ok(file)
}

const TOO_MANY: ObjError = ObjError {
    library: None,
    line: 1,
    fault: ObjFault::TooManyVertices,
};

/// The mesh of one run; `None` if it has more vertices than can be numbered.
fn mesh(reader: &Reader, run: &Run) -> Option<MeshData> {
    let is_placed = run.corners().all(|corner| corner.coordinates.is_some());
    let is_smooth = run.corners().all(|corner| reader.normal(corner).is_some());
    let mut number_of: HashMap<Corner, u32> = HashMap::new();
    let mut mesh = MeshData::default();
    for triangle in &run.triangles {
        let mut numbers = [0; 3];
        for (number, corner) in numbers.iter_mut().zip(triangle) {
            let key = Corner {
                vertex: corner.vertex,
                coordinates: corner.coordinates.filter(|_| is_placed),
                normal: corner.normal.filter(|_| is_smooth),
            };
            let next = u32::try_from(mesh.vertices.len()).ok()?;
            *number = *number_of.entry(key).or_insert(next);
            if *number == next {
                add(&mut mesh, reader, key);
            }
        }
        mesh.triangles.push(numbers);
    }
    Some(mesh)
}

fn add(mesh: &mut MeshData, reader: &Reader, corner: Corner) {
    let vertex = corner.vertex as usize;
    mesh.vertices.push(reader.vertices[vertex]);
    let coordinates = corner
        .coordinates
        .map(|index| reader.coordinates[index as usize]);
    mesh.texture_coordinates.extend(coordinates);
    mesh.normals.extend(reader.normal(&corner));
    let colour = reader.colors.get(vertex).map(|rgb| {
        let [red, green, blue] = rgb.map(|code| linear_from_srgb(code) as f32);
        [red, green, blue, 1.0]
    });
    mesh.colors.extend(colour);
}
