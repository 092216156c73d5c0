//! Scenes in the formats of other programs.

use std::cell::RefCell;
use std::io;
use std::path::Path;
use std::sync::Arc;

use crate::diagnostic::SourceFile;
use crate::files::Files;
use crate::import::gltf::{self, GltfError};

use super::LoadedScene;
use super::source_map::SourceMap;

/// Whether the file is named as glTF files are.
pub(super) fn is_gltf(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    ["gltf", "glb"]
        .iter()
        .any(|known| extension.eq_ignore_ascii_case(known))
}

/// Reads a glTF file as a scene.
pub(super) fn read_gltf(path: &Path, files: &dyn Files) -> Result<LoadedScene, GltfError> {
    let files = HashedFiles {
        files,
        hasher: RefCell::default(),
    };
    let imported = gltf::read(path, &files)?;
    Ok(LoadedScene {
        description: imported.description,
        hash: files.hasher.into_inner().finalize().to_hex().to_string(),
        source: Arc::new(SourceFile {
            name: path.display().to_string(),
            text: String::new(),
        }),
        map: SourceMap::default(),
    })
}

/// Files whose bytes are hashed as they are read.
struct HashedFiles<'f> {
    files: &'f dyn Files,
    hasher: RefCell<blake3::Hasher>,
}

impl Files for HashedFiles<'_> {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let bytes = self.files.read(path)?;
        let mut hasher = self.hasher.borrow_mut();
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(&bytes);
        Ok(bytes)
    }
}
