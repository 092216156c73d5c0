//! glTF scenes as one mesh: the triangles of all nodes where they are, by material.

use std::path::Path;
use std::sync::Arc;

use steradian::geometry::{Direction, Transform};
use steradian::scene::description::{
    GeometryDescription, MeshData, SceneDescription, ShapeDescription,
};

use super::gltf::{self, GltfError};
use super::mesh_file::{MeshFile, MeshMaterial, MeshPart};
use super::normals::{LEFT_OUT, unit};
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
            let placed = placed(mesh, &shape.transform);
            if placed.normals.len() < mesh.normals.len() {
                file.warn(LEFT_OUT);
            }
            append(part_for(&mut file, &placed, material), placed).ok_or(GltfError::Empty)?;
        }
    }
    Ok(file)
}

/// The part for a mesh: of the same material, and with texture coordinates, colours and normals if and only if the mesh has them.
fn part_for<'f>(
    file: &'f mut MeshFile,
    mesh: &MeshData,
    material: Option<usize>,
) -> &'f mut MeshData {
    let is_alike = |part: &MeshPart| {
        part.material == material
            && part.mesh.texture_coordinates.is_empty() == mesh.texture_coordinates.is_empty()
            && part.mesh.colors.is_empty() == mesh.colors.is_empty()
            && part.mesh.normals.is_empty() == mesh.normals.is_empty()
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

/// A mesh where its transform puts it, without normals if one of them has no image.
fn placed(mesh: &MeshData, transform: &Transform) -> MeshData {
    let turned = |&[a, b, c]: &[u32; 3]| [a, c, b];
    let vertices = mesh.vertices.iter().map(|vertex| transform.point(*vertex));
    let normals = mesh.normals.iter().map(|normal| {
        let normal = Direction::try_from(normal.map(f64::from)).ok()?;
        unit(transform.normal(normal).ok()?.into())
    });
    MeshData {
        vertices: vertices.collect(),
        triangles: if transform.is_mirroring() {
            mesh.triangles.iter().map(turned).collect()
        } else {
            mesh.triangles.clone()
        },
        normals: normals.collect::<Option<_>>().unwrap_or_default(),
        texture_coordinates: mesh.texture_coordinates.clone(),
        colors: mesh.colors.clone(),
    }
}

/// Adds a mesh; `None` if there are more vertices than can be numbered.
fn append(all: &mut MeshData, mut mesh: MeshData) -> Option<()> {
    let first = u32::try_from(all.vertices.len()).ok()?;
    first.checked_add(u32::try_from(mesh.vertices.len()).ok()?)?;
    let numbered = mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|corner| corner + first));
    all.triangles.extend(numbered);
    all.vertices.append(&mut mesh.vertices);
    all.texture_coordinates
        .append(&mut mesh.texture_coordinates);
    all.colors.append(&mut mesh.colors);
    all.normals.append(&mut mesh.normals);
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::MemoryFiles;
    use steradian::geometry::{Point, Vector};

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
    fn normals_stay_normal_to_what_is_stretched_and_mirrored() {
        let slope = std::f32::consts::FRAC_1_SQRT_2;
        let mesh = MeshData {
            vertices: [[0.0; 3], [1.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
                .map(Point::from)
                .to_vec(),
            triangles: vec![[0, 1, 2]],
            normals: vec![[slope, 0.0, slope]; 3],
            ..MeshData::default()
        };
        let stretched = placed(&mesh, &Transform::scale_axes([-2.0, 1.0, 1.0]));
        // M⁻ᵀ (1, 0, 1) = (−½, 0, 1), of length √1.25; the front stays in front.
        let expected = [-0.447_213_6, 0.0, 0.894_427_2_f32];
        for (found, expected) in stretched.normals[1].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{stretched:?}");
        }
        assert_eq!(stretched.triangles, [[0, 2, 1]]);
        assert!(
            placed(&mesh, &Transform::scale_axes([1.0, 0.0, 0.0]))
                .normals
                .is_empty()
        );
    }

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
