//! Scene files: TOML in, a [`SceneDescription`] out, or everything that is wrong with it.
//!
//! Quantities are strings with a unit (`"100 W/sr"`); bare numbers are metres or ratios. One table of keys drives
//! reading, [`schema`], [`key_help`] and the hints in messages.
//!
//! A file with `up = "y"` is turned to z up on reading: the point (x, y, z) of the file is the point (x, −z, y) of
//! the description and of every report.
//!
//! ```
//! use steradian_io::files::MemoryFiles;
//! use steradian_io::scene_file::read_scene_str;
//!
//! let text = r#"
//! [[lights]]
//! kind = "point"
//! position = [0, 0, 1]
//! intensity = "100 W/sr"
//! "#;
//! let loaded = read_scene_str("lamp.toml", text, &MemoryFiles::default()).unwrap();
//! assert_eq!(loaded.description.lights.len(), 1);
//!
//! let problems = read_scene_str("lamp.toml", &text.replace("W/sr", "kg"), &MemoryFiles::default()).unwrap_err();
//! assert!(problems[0].message.contains("found \"100 kg\", which is a mass"));
//! ```

mod context;
mod fields;
mod help;
mod imported;
mod keys;
mod lanes;
mod light;
mod luminaire;
mod material;
mod mesh;
mod models;
mod node;
mod placement;
mod relief;
mod schedule;
mod schema;
mod sections;
mod sensor;
mod settings;
mod shape;
mod source_map;
mod spectrum;
mod tables;
mod texture;
mod up;
mod value;

use std::path::Path;
use std::sync::Arc;

use steradian::scene::Problem;
use steradian::scene::description::SceneDescription;
use toml::de::DeTable;

use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::{Files, reason};
use crate::import;

use context::Context;
use source_map::SourceMap;

pub use help::key_help;
pub use models::{KeyHelp, ModelHelp, models};
pub use schema::schema;
pub use settings::material_from_settings;

/// A scene file that could be read.
#[derive(Clone, Debug)]
pub struct LoadedScene {
    /// What it says.
    pub description: SceneDescription,
    /// BLAKE3 of the file and of every file it names, in hexadecimal.
    pub hash: String,
    source: Arc<SourceFile>,
    map: SourceMap,
}

impl LoadedScene {
    /// Shows a problem that was found in the description at its place in the file.
    pub fn diagnostic(&self, problem: &Problem) -> Diagnostic {
        if self.source.text.is_empty() {
            let diagnostic = Diagnostic::error(problem.to_string()).about(&self.source);
            return problem.hint.iter().fold(diagnostic, Diagnostic::hint);
        }
        let diagnostic = Diagnostic::error(problem.message.as_str());
        let diagnostic = match self.map.span(problem.place) {
            Some(span) => diagnostic.at(&self.source, span),
            None => diagnostic.about(&self.source),
        };
        problem.hint.iter().fold(diagnostic, Diagnostic::hint)
    }
}

/// Reads the scene file at `path`: TOML, or glTF if its name ends in `.gltf` or `.glb`.
///
/// # Errors
/// Everything that is wrong with it, in the order of the file.
pub fn read_scene(path: &Path, files: &dyn Files) -> Result<LoadedScene, Vec<Diagnostic>> {
    let name = path.display().to_string();
    let empty = Arc::new(SourceFile {
        name: name.clone(),
        text: String::new(),
    });
    let refuse = |message: String| vec![Diagnostic::error(message).about(&empty)];
    if let Some(reason) = not_a_scene(path) {
        return Err(refuse(reason));
    }
    if import::is_scene(path) {
        return imported::read(path, files).map_err(|error| refuse(error.to_string()));
    }
    let bytes = files
        .read(path)
        .map_err(|error| refuse(format!("cannot read the scene file: {}", reason(&error))))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        refuse(format!(
            "the scene file is not UTF-8 text: {}",
            error.utf8_error()
        ))
    })?;
    read_scene_str(&name, &text, files)
}

/// Why a file of this extension is not read as a scene.
fn not_a_scene(path: &Path) -> Option<String> {
    let extension = path.extension()?.to_str()?.to_lowercase();
    match extension.as_str() {
        "rad" | "xml" => Some(format!(
            "scenes from .{extension} files are not supported yet"
        )),
        _ => None,
    }
}

/// Reads a scene file from its text. Files that it names are relative to the directory of `name`.
///
/// # Errors
/// Everything that is wrong with it, in the order of the file.
pub fn read_scene_str(
    name: &str,
    text: &str,
    files: &dyn Files,
) -> Result<LoadedScene, Vec<Diagnostic>> {
    let source = Arc::new(SourceFile {
        name: name.to_owned(),
        text: text.to_owned(),
    });
    let (root, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        return Err(errors
            .iter()
            .map(|error| syntax_error(error, &source))
            .collect());
    }
    let directory = Path::new(name).parent().unwrap_or(Path::new(""));
    let context = Context::new(Arc::clone(&source), directory, files);
    let sections = sections::read(root.get_ref(), &context);
    let map = SourceMap::new(root.get_ref(), &sections);
    let hash = context.finish()?;
    Ok(LoadedScene {
        description: sections.description,
        hash,
        source,
        map,
    })
}

fn syntax_error(error: &toml::de::Error, source: &Arc<SourceFile>) -> Diagnostic {
    let diagnostic = Diagnostic::error(format!("not valid TOML: {}", error.message()));
    match error.span() {
        Some(span) => diagnostic.at(source, span),
        None => diagnostic.about(source),
    }
}
