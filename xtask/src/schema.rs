//! The files generated from the scene file's table of keys, and the check that they are up to date.

use std::path::Path;

use crate::steps::{cargo, output};

/// Where each generated file lies, and the command line of `steradian` that prints it.
const GENERATED: [(&str, &[&str]); 2] = [
    (
        "scenes/steradian.schema.json",
        &["help", "scene", "--schema"],
    ),
    ("scenes/KEYS.txt", &["help", "scene"]),
];

/// Writes every generated file.
pub fn write(root: &Path) -> Result<(), String> {
    for (file, arguments) in GENERATED {
        let path = root.join(file);
        std::fs::write(&path, generate(root, arguments)?)
            .map_err(|error| format!("{}: {error}", path.display()))?;
        println!("wrote {file}");
    }
    Ok(())
}

/// An error that names the generated files which are out of date.
pub fn check(root: &Path) -> Result<(), String> {
    let mut stale = Vec::new();
    for (file, arguments) in GENERATED {
        let stored = std::fs::read_to_string(root.join(file)).unwrap_or_default();
        if stored != generate(root, arguments)? {
            stale.push(file);
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    Err(format!(
        "out of date: {}; run `cargo xtask schema`",
        stale.join(", ")
    ))
}

fn generate(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let run = ["run", "--quiet", "--package", "steradian-cli", "--"];
    output(cargo(root, &run).args(arguments))
}
