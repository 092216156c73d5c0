//! glTF 2.0 (`.gltf`, `.glb`): meshes, materials, lights and cameras of a scene.
//!
//! | glTF | read as |
//! |---|---|
//! | metres, y up | metres, z up: (x, y, z) becomes (x, −z, y) |
//! | nodes, `EXT_mesh_gpu_instancing` | one shape for each primitive of each copy; copies share their triangles |
//! | triangles, strips, fans; sparse and quantised accessors | meshes with their normals; tangents are passed over |
//! | normal textures | relief |
//! | base colour: factor, texture, vertex colour | Lambertian reflectance in linear Rec.709, for metals too |
//! | alpha: mask, blend; `KHR_materials_transmission` | opacity |
//! | emission, `KHR_materials_emissive_strength` | luminance in cd/m² |
//! | `KHR_lights_punctual` | point lights and spots in cd, directional lights in lx |
//! | cameras | sensors |
//!
//! A file without a camera gets one that shows everything, and one without light a sky of 500 lx
//! and parallel light of 1000 lx. Animations and skins are not read: what they move is where it is at rest. All that is
//! approximated, added or left out is told in the description's `warnings`.
//!
//! The JSON is read by our own types, for numbers in f64 and extensions alike; every index, size and number is checked,
//! so that a damaged file is refused with the place that is wrong.
//!
//! Specification: Khronos Group, *glTF 2.0*, ISO/IEC 12113:2022.
//!
//! ```
//! use std::path::Path;
//! use steradian_io::files::MemoryFiles;
//! use steradian_io::import::gltf;
//!
//! let triangle = r#"{
//!     "asset": { "version": "2.0" },
//!     "buffers": [{ "byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }],
//!     "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
//!     "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
//!     "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
//!     "nodes": [{ "mesh": 0 }]
//! }"#;
//! let files = MemoryFiles::default().with("triangle.gltf", triangle);
//! let description = gltf::read(Path::new("triangle.gltf"), &files)?.description;
//! assert_eq!(description.shapes.len(), 1);
//! assert!(description.warnings.iter().any(|warning| warning.contains("no light")));
//! # Ok::<(), gltf::GltfError>(())
//! ```

mod accessors;
mod cameras;
mod container;
mod document;
mod error;
mod extensions;
mod instances;
mod lights;
mod materials;
mod names;
mod nodes;
mod notes;
mod primitives;
mod reflection;
mod scene;
mod schema;
mod textures;
mod uri;

use std::path::Path;

use steradian::scene::description::SceneDescription;

use super::defaults;
use crate::files::{Files, reason};
use document::Document;
use uri::Resources;

pub use error::GltfError;

/// A scene that was read from a glTF file.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Imported {
    /// The scene.
    pub description: SceneDescription,
}

/// Reads the scene of the glTF file at `path`, with the buffers and pictures it names.
///
/// # Errors
/// The first thing in the file that cannot be read, and where it is.
pub fn read(path: &Path, files: &dyn Files) -> Result<Imported, GltfError> {
    let bytes = files.read(path).map_err(|error| GltfError::File {
        path: path.to_owned(),
        reason: reason(&error),
    })?;
    let mut description = read_bytes(path, &bytes, files)?;
    defaults::complete(&mut description);
    Ok(Imported { description })
}

/// What the file with these bytes says, with nothing added to be seen with.
pub(super) fn read_bytes(
    path: &Path,
    bytes: &[u8],
    files: &dyn Files,
) -> Result<SceneDescription, GltfError> {
    let container = container::open(bytes)?;
    let directory = path.parent().unwrap_or(Path::new("")).to_owned();
    let resources = Resources { directory, files };
    let document = Document::new(&container, &resources)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    scene::read(&document, &resources, &name)
}
