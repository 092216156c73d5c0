//! Scenes in the formats of other programs.

use std::path::Path;
use std::sync::Arc;

use super::LoadedScene;
use super::source_map::SourceMap;
use crate::diagnostic::SourceFile;
use crate::files::{Files, HashedFiles};
use crate::import::{self, ImportError};

/// Reads the file at `path`.
pub(super) fn read(path: &Path, files: &dyn Files) -> Result<LoadedScene, ImportError> {
    let files = HashedFiles::new(files);
    let description = import::scene(path, &files)?;
    Ok(LoadedScene {
        description,
        hash: files.hash(),
        source: Arc::new(SourceFile {
            name: path.display().to_string(),
            text: String::new(),
        }),
        map: SourceMap::default(),
    })
}
