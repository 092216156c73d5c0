//! Mesh files that are scenes by themselves.

use std::path::Path;
use std::sync::Arc;

use steradian::geometry::{Direction, Transform, Vector};
use steradian::scene::description::{
    GeometryDescription, SceneDescription, ShapeDescription, SpectrumMode,
};

use thiserror::Error;

use super::gltf::{self, GltfError};
use super::{MeshError, MeshFile, MeshFormat, defaults, mesh};
use crate::files::{Files, reason};

/// Why a file is no scene.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file cannot be read at all.
    #[error("cannot read {path}: {reason}")]
    File {
        /// The file.
        path: String,
        /// Why.
        reason: String,
    },
    /// A mesh file that is wrong.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A glTF file that is wrong.
    #[error(transparent)]
    Gltf(#[from] GltfError),
}

/// Whether a file of this name is read by [`scene`].
pub fn is_scene(path: &Path) -> bool {
    MeshFormat::of(path).is_some()
}

/// The scene that a file of another program is, seen by a default camera under default light where it has none.
///
/// The unit of mesh files is the metre. Where the y axis points up in a format, it is turned to z up.
///
/// # Errors
/// The first thing that is wrong with the file.
pub fn scene(path: &Path, files: &dyn Files) -> Result<SceneDescription, ImportError> {
    if MeshFormat::of(path) == Some(MeshFormat::Gltf) {
        return Ok(gltf::read(path, files)?.description);
    }
    let bytes = files.read(path).map_err(|error| ImportError::File {
        path: path.display().to_string(),
        reason: reason(&error),
    })?;
    let file = mesh(path, &bytes, files)?;
    let name = path
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let mut description = described(file, &name, MeshFormat::of(path));
    defaults::complete(&mut description);
    Ok(description)
}

fn described(file: MeshFile, name: &str, format: Option<MeshFormat>) -> SceneDescription {
    let is_y_up = format == Some(MeshFormat::Obj);
    let mut description = SceneDescription {
        name: name.to_owned(),
        spectrum: SpectrumMode::Rgb,
        warnings: format
            .map(|format| units(format, is_y_up))
            .into_iter()
            .chain(file.warnings)
            .collect(),
        ..SceneDescription::default()
    };
    for part in &file.parts {
        let material = part.material.map(|index| &file.materials[index]);
        description.shapes.push(ShapeDescription {
            name: Some(
                material
                    .map_or(name, |material| &material.material.name)
                    .to_owned(),
            ),
            geometry: GeometryDescription::Mesh(Arc::clone(&part.mesh)),
            material: material.map(|material| material.material.name.clone()),
            transform: if is_y_up {
                y_to_z_up()
            } else {
                Transform::IDENTITY
            },
            repeat: None,
            emission: material.and_then(|material| material.emission.clone()),
        });
    }
    let materials = file.materials.into_iter();
    description.materials = materials.map(|material| material.material).collect();
    description
}

fn units(format: MeshFormat, is_y_up: bool) -> String {
    let axis = if is_y_up {
        "y up, and turned to z up"
    } else {
        "z up"
    };
    format!(
        "{} has no unit: its numbers are read as metres, {axis}; a scene file with kind = \"mesh\" can set `unit` and `up`",
        format.name()
    )
}

/// The turn that makes the y axis point up: (x, y, z) becomes (x, −z, y).
pub(super) fn y_to_z_up() -> Transform {
    Transform::from_axes([Direction::X, Direction::Z, -Direction::Y].map(Vector::from))
}
