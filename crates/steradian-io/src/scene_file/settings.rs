//! A material from its model's name and single settings, as a command line gives them.
//!
//! A setting is read as the value of the scene file's key; what is no TOML value is text, so that `sigma=20 deg` needs no
//! quotes.
//!
//! ```
//! use steradian_io::files::MemoryFiles;
//! use steradian_io::scene_file::material_from_settings;
//! use steradian::spectrum::Lanes;
//!
//! let settings = [("reflectance", "0.5"), ("sigma", "20 deg")];
//! let plaster = material_from_settings("oren-nayar", &settings, &Lanes::rgb(), &MemoryFiles::default()).unwrap();
//! assert!(plaster.brdf([0.0; 4]).is_some());
//!
//! let settings = [("reflectance", "0.5"), ("sigma", "1 m")];
//! let problems = material_from_settings("oren-nayar", &settings, &Lanes::rgb(), &MemoryFiles::default());
//! assert!(problems.err().unwrap()[0].message.contains("found \"1 m\", which is a length"));
//! ```

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use steradian::scene::LoneMaterial;
use steradian::scene::description::MaterialDescription;
use steradian::spectrum::Lanes;
use toml::de::{DeTable, DeValue};

use super::context::Context;
use super::material;
use super::node::Node;
use super::source_map::Entry;
use super::syntax_error;
use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::Files;

/// The name under which settings are the material of a file.
const NAME: &str = "settings";

/// A material of this model with these keys set, in the lanes of a run. Files are relative to the working directory.
///
/// # Errors
/// Everything that is wrong with the settings.
pub fn material_from_settings(
    model: &str,
    settings: &[(&str, &str)],
    lanes: &Lanes,
    files: &dyn Files,
) -> Result<LoneMaterial, Vec<Diagnostic>> {
    let text = as_table(model, settings);
    let source = Arc::new(SourceFile {
        name: format!("settings of {model}"),
        text: text.clone(),
    });
    let (root, errors) = DeTable::parse_recoverable(&text);
    if !errors.is_empty() {
        let errors = errors.iter().map(|error| syntax_error(error, &source));
        return Err(errors.collect());
    }
    let context = Context::new(Arc::clone(&source), Path::new(""), files);
    let description = described(root.get_ref(), &context);
    context.finish()?;
    let entry = root.get_ref().get(NAME).map(Entry::new);
    let description = description.ok_or_else(Vec::new)?;
    LoneMaterial::new(&description, lanes).map_err(|problem| {
        let diagnostic = Diagnostic::error(problem.message);
        let key = problem.place.key.zip(entry.as_ref());
        let diagnostic = match key.and_then(|(key, entry)| entry.value(key)) {
            Some(span) => diagnostic.at(&source, span),
            None => diagnostic,
        };
        vec![diagnostic]
    })
}

fn described(root: &DeTable<'_>, context: &Context<'_>) -> Option<MaterialDescription> {
    material::read(NAME, Node::new(root.get(NAME)?, context))
}

/// The settings as a table of a scene file, one a line.
fn as_table(model: &str, settings: &[(&str, &str)]) -> String {
    let mut text = format!("[{NAME}]\nmodel = {model:?}\n");
    for (key, value) in settings {
        let is_value = DeValue::parse(value).is_ok();
        // Writing to a string cannot fail.
        let _ = match is_value {
            true => writeln!(text, "{key} = {value}"),
            false => writeln!(text, "{key} = {value:?}"),
        };
    }
    text
}
