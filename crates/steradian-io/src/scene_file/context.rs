//! What all readers of one scene file share: its text, the problems found so far, and the files it names.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use steradian::scene::description::MaterialDescription;

use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::{Files, HashedFiles, reason};

use super::luminaire::LoadedLuminaire;
use super::mesh::LoadedMesh;
use super::up::UpAxis;

/// The state of one reading.
pub(super) struct Context<'f> {
    pub source: Arc<SourceFile>,
    /// The up axis of the file, known once `[scene]` has been read.
    pub up: Cell<UpAxis>,
    directory: PathBuf,
    files: HashedFiles<'f>,
    problems: RefCell<Vec<Diagnostic>>,
    meshes: RefCell<HashMap<String, Option<Arc<LoadedMesh>>>>,
    luminaires: RefCell<HashMap<String, Option<Arc<LoadedLuminaire>>>>,
    materials: RefCell<Vec<(MaterialDescription, Range<usize>)>>,
    warnings: RefCell<Vec<String>>,
}

impl<'f> Context<'f> {
    /// A reading of `source`, whose files are relative to `directory`.
    pub fn new(source: Arc<SourceFile>, directory: &Path, files: &'f dyn Files) -> Self {
        let context = Self {
            source,
            up: Cell::new(UpAxis::Z),
            directory: directory.to_owned(),
            files: HashedFiles::new(files),
            problems: RefCell::default(),
            meshes: RefCell::default(),
            luminaires: RefCell::default(),
            materials: RefCell::default(),
            warnings: RefCell::default(),
        };
        context.files.add(context.source.text.as_bytes());
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
        let path = self.path_of(name);
        match self.files.read(&path) {
            Ok(bytes) => Some(bytes),
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

    /// Where a file is that the scene names.
    pub fn path_of(&self, name: &str) -> PathBuf {
        self.directory.join(name)
    }

    /// Where files come from; what is read of them counts for the hash.
    pub fn files(&self) -> &dyn Files {
        &self.files
    }

    /// The mesh file that was read for `key` before, or else the one that `read` gives.
    pub fn mesh(
        &self,
        key: String,
        read: impl FnOnce() -> Option<LoadedMesh>,
    ) -> Option<Arc<LoadedMesh>> {
        if let Some(known) = self.meshes.borrow().get(&key) {
            return known.clone();
        }
        let mesh = read().map(Arc::new);
        self.meshes.borrow_mut().insert(key, mesh.clone());
        mesh
    }

    /// The luminaire of this file that was read before, or else the one that `read` gives.
    pub fn luminaire(
        &self,
        name: &str,
        read: impl FnOnce() -> Option<LoadedLuminaire>,
    ) -> Option<Arc<LoadedLuminaire>> {
        if let Some(known) = self.luminaires.borrow().get(name) {
            return known.clone();
        }
        let luminaire = read().map(Arc::new);
        let mut luminaires = self.luminaires.borrow_mut();
        luminaires.insert(name.to_owned(), luminaire.clone());
        luminaire
    }

    /// Adds a material of a file that the scene names at `span`, unless there is one of its name, and gives the name.
    pub fn add_material(&self, material: MaterialDescription, span: Range<usize>) -> String {
        let name = material.name.clone();
        let mut materials = self.materials.borrow_mut();
        if materials.iter().all(|(known, _)| known.name != name) {
            materials.push((material, span));
        }
        name
    }

    /// The materials of files, each with the place where the scene names its file.
    pub fn take_materials(&self) -> (Vec<MaterialDescription>, Vec<Range<usize>>) {
        self.materials.take().into_iter().unzip()
    }

    /// Records what was approximated.
    pub fn warn(&self, warning: String) {
        self.warnings.borrow_mut().push(warning);
    }

    /// What was approximated so far.
    pub fn take_warnings(&self) -> Vec<String> {
        self.warnings.take()
    }

    /// All problems in the order of the file, or the hash of everything that was read.
    pub fn finish(self) -> Result<String, Vec<Diagnostic>> {
        let mut problems = self.problems.into_inner();
        if problems.is_empty() {
            return Ok(self.files.hash());
        }
        problems.sort_by_key(|problem| problem.span.as_ref().map(|span| span.start));
        Err(problems)
    }
}
