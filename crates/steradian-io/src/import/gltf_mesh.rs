//! glTF scenes as one mesh: the triangles of all nodes where they are, by material.

use std::path::Path;
use std::sync::Arc;

use steradian::geometry::{Transform, Vector};
use steradian::scene::description::{
    GeometryDescription, MeshData, SceneDescription, ShapeDescription,
};

use super::gltf::{self, GltfError};
use super::mesh_file::{MeshFile, MeshMaterial, MeshPart};
use crate::files::Files;

/// Reads the surfaces of a glTF file; its lights and cameras are left out. Metres, z up.
pub(super) fn read(path: &Path, bytes: &[u8], files: &dyn Files) -> Result<MeshFile, GltfError> {
    let scene = gltf::read_bytes(path, bytes, files)?;
    let mut file = MeshFile {
        is_oriented: true,
        warnings: scene.warnings.clone(),
        ..MeshFile::default()
    };
    if !(scene.lights.is_empty() && scene.sensors.is_empty()) {
        file.warnings.push("lights and cameras are left out".into());
    }
    for shape in &scene.shapes {
        if let GeometryDescription::Mesh(mesh) = &shape.geometry {
            let material = index_of(&mut file, &scene, shape);
            let part = part_for(&mut file, mesh, material);
            append(part, mesh, &shape.transform).ok_or(GltfError::Empty)?;
        }
    }
    Ok(file)
}

/// The part for a mesh: of the same material, and with texture coordinates and colours if and only if the mesh has them.
fn part_for<'f>(
    file: &'f mut MeshFile,
    mesh: &MeshData,
    material: Option<usize>,
) -> &'f mut MeshData {
    let is_alike = |part: &MeshPart| {
        part.material == material
            && part.mesh.texture_coordinates.is_empty() == mesh.texture_coordinates.is_empty()
            && part.mesh.colors.is_empty() == mesh.colors.is_empty()
    };
    let index = file.parts.iter().position(is_alike).unwrap_or_else(|| {
        let mesh = Arc::default();
        file.parts.push(MeshPart { mesh, material });
        file.parts.len() - 1
    });
    Arc::make_mut(&mut file.parts[index].mesh)
}

/// The number of a shape's material, with what the shape emits.
fn index_of(
    file: &mut MeshFile,
    scene: &SceneDescription,
    shape: &ShapeDescription,
) -> Option<usize> {
    let name = shape.material.as_ref()?;
    let material = scene.materials.iter().find(|known| known.name == *name)?;
    Some(file.index_of(MeshMaterial {
        material: material.clone(),
        emission: shape.emission.clone(),
    }))
}

/// Adds a mesh where its transform puts it; `None` if there are more vertices than can be numbered.
fn append(all: &mut MeshData, mesh: &MeshData, transform: &Transform) -> Option<()> {
    let first = u32::try_from(all.vertices.len()).ok()?;
    first.checked_add(u32::try_from(mesh.vertices.len()).ok()?)?;
    let mirrors = mirrors(transform);
    let moved = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|corner| corner + first);
        if mirrors { [a, c, b] } else { [a, b, c] }
    });
    all.triangles.extend(moved);
    let vertices = mesh.vertices.iter().map(|vertex| transform.point(*vertex));
    all.vertices.extend(vertices);
    all.texture_coordinates
        .extend_from_slice(&mesh.texture_coordinates);
    all.colors.extend_from_slice(&mesh.colors);
    Some(())
}

/// Whether a transform turns counter-clockwise into clockwise; fronts are kept nevertheless.
fn mirrors(transform: &Transform) -> bool {
    let axis = |x, y, z| transform.vector(Vector::new(x, y, z));
    axis(1.0, 0.0, 0.0)
        .cross(axis(0.0, 1.0, 0.0))
        .dot(axis(0.0, 0.0, 1.0))
        < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::MemoryFiles;

    /// A triangle of three nodes: as it is, mirrored and with another material.
    const SCENE: &str = r#"{
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
        "materials": [{ "name": "a" }, { "name": "b", "emissiveFactor": [1, 1, 1] }],
        "meshes": [
            { "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] },
            { "primitives": [{ "attributes": { "POSITION": 0 }, "material": 1 }] }
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.1 } }],
        "nodes": [{ "mesh": 0 }, { "mesh": 0, "scale": [-1, 1, 1] }, { "mesh": 1 }, { "camera": 0 }]
    }"#;

    #[test]
    fn nodes_are_put_together_by_material_with_their_fronts() {
        let path = Path::new("a.gltf");
        let files = MemoryFiles::default();
        let file = read(path, SCENE.as_bytes(), &files).unwrap();
        let names: Vec<_> = file
            .materials
            .iter()
            .map(|material| material.material.name.as_str())
            .collect();
        assert_eq!(names, ["a", "b"]);
        assert!(file.materials[0].emission.is_none() && file.materials[1].emission.is_some());
        let mesh = &file.parts[0].mesh;
        assert_eq!(mesh.triangles, [[0, 1, 2], [3, 5, 4]]);
        // Towards the viewer in glTF is towards −y here.
        for [a, b, c] in &mesh.triangles {
            let [a, b, c] = [a, b, c].map(|corner| mesh.vertices[*corner as usize]);
            assert_eq!((b - a).cross(c - a), Vector::new(0.0, -1.0, 0.0));
        }
        assert!(
            file.warnings
                .iter()
                .any(|warning| warning == "lights and cameras are left out")
        );
    }
}
