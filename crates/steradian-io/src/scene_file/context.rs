//! What all readers of one scene file share: its text, the problems found so far, and the files it names.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use steradian::scene::description::MeshData;

use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::{Files, reason};

use super::up::UpAxis;

/// The state of one reading.
pub(super) struct Context<'f> {
    pub source: Arc<SourceFile>,
    /// The up axis of the file, known once `[scene]` has been read.
    pub up: Cell<UpAxis>,
    directory: PathBuf,
    files: &'f dyn Files,
    problems: RefCell<Vec<Diagnostic>>,
    hasher: RefCell<blake3::Hasher>,
    meshes: RefCell<HashMap<String, Option<Arc<MeshData>>>>,
}

impl<'f> Context<'f> {
    /// A reading of `source`, whose files are relative to `directory`.
    pub fn new(source: Arc<SourceFile>, directory: &Path, files: &'f dyn Files) -> Self {
        let context = Self {
            source,
            up: Cell::new(UpAxis::Z),
            directory: directory.to_owned(),
            files,
            problems: RefCell::default(),
            hasher: RefCell::default(),
            meshes: RefCell::default(),
        };
        context.hash(context.source.text.as_bytes());
        context
    }

    /// Records an error about these bytes of the scene file.
    pub fn error(&self, span: Range<usize>, message: impl Into<String>, hint: Option<String>) {
        let diagnostic = Diagnostic::error(message).at(&self.source, span);
        self.report(hint.into_iter().fold(diagnostic, Diagnostic::hint));
    }

    fn report(&self, diagnostic: Diagnostic) {
        self.problems.borrow_mut().push(diagnostic);
    }

    /// Whether anything was wrong so far.
    pub fn has_problems(&self) -> bool {
        !self.problems.borrow().is_empty()
    }

    /// The bytes of a file that the scene names at `span`.
    pub fn read_file(&self, name: &str, span: Range<usize>) -> Option<Vec<u8>> {
        let path = self.directory.join(name);
        match self.files.read(&path) {
            Ok(bytes) => {
                self.hash(&bytes);
                Some(bytes)
            }
            Err(error) => {
                self.error(
                    span,
                    format!("cannot read {}: {}", path.display(), reason(&error)),
                    None,
                );
                None
            }
        }
    }

    /// The mesh that was read for `key` before, or else the one that `read` gives.
    pub fn mesh(
        &self,
        key: String,
        read: impl FnOnce() -> Option<MeshData>,
    ) -> Option<Arc<MeshData>> {
        if let Some(known) = self.meshes.borrow().get(&key) {
            return known.clone();
        }
        let mesh = read().map(Arc::new);
        self.meshes.borrow_mut().insert(key, mesh.clone());
        mesh
    }

    /// All problems in the order of the file, or the hash of everything that was read.
    pub fn finish(self) -> Result<String, Vec<Diagnostic>> {
        let mut problems = self.problems.into_inner();
        if problems.is_empty() {
            return Ok(self.hasher.into_inner().finalize().to_hex().to_string());
        }
        problems.sort_by_key(|problem| problem.span.as_ref().map(|span| span.start));
        Err(problems)
    }

    fn hash(&self, bytes: &[u8]) {
        let mut hasher = self.hasher.borrow_mut();
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(bytes);
    }
}
