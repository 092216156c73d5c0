//! Readers of other programs' files.

mod alpha;
pub mod boundaries;
pub mod bsdf;
mod defaults;
pub mod gltf;
mod gltf_mesh;
pub mod image;
pub mod luminance_map;
mod mesh_file;
mod normals;
pub mod obj;
pub mod photometry;
pub mod ply;
pub mod points;
pub mod polygon;
mod scene;
pub mod series;
pub mod spectrum;
pub mod stl;

use std::path::Path;

use thiserror::Error;

use crate::files::Files;
pub use alpha::as_opacity;
pub use mesh_file::{MeshFile, MeshMaterial, MeshPart};
pub use scene::{ImportError, is_scene, scene};

/// What is wrong with a mesh file.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MeshError {
    /// An extension that no reader knows.
    #[error("expected a mesh file (.obj, .ply, .stl, .gltf or .glb), found {0:?}")]
    Format(String),
    /// In an OBJ file or one of its material libraries.
    #[error(transparent)]
    Obj(#[from] obj::ObjError),
    /// In a PLY file.
    #[error(transparent)]
    Ply(#[from] ply::PlyError),
    /// In an STL file.
    #[error(transparent)]
    Stl(#[from] stl::StlError),
    /// In a glTF file.
    #[error(transparent)]
    Gltf(#[from] gltf::GltfError),
}

/// The formats of meshes, by extension.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// The Stanford polygon format.
    Ply,
    /// Triangles of stereolithography.
    Stl,
    /// glTF, in text or binary.
    Gltf,
}

impl MeshFormat {
    /// The format of a file with this name.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Gltf => "glTF",
        }
    }
}

/// Reads the mesh file whose bytes these are. The extension of `path` tells the format; material libraries and textures
/// that the file names are read from `files`, relative to its directory.
///
/// # Errors
/// If the extension is unknown, or the first thing that is wrong with the file.
pub fn mesh(path: &Path, bytes: &[u8], files: &dyn Files) -> Result<MeshFile, MeshError> {
    let directory = path.parent().unwrap_or(Path::new(""));
    let mut file = match MeshFormat::of(path) {
        Some(MeshFormat::Obj) => obj::read(bytes, directory, files)?,
        Some(MeshFormat::Ply) => ply::read(bytes)?,
        Some(MeshFormat::Stl) => stl::read(bytes)?,
        Some(MeshFormat::Gltf) => gltf_mesh::read(path, bytes, files)?,
        None => return Err(MeshError::Format(path.display().to_string())),
    };
    let (flat, all) = (file.triangles_without_area(), file.triangles());
    if flat > 0 {
        file.warnings
            .push(format!("{flat} of {all} triangles have no area"));
    }
    Ok(file)
}
