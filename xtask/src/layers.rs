//! Modules use only modules before them.
//!
//! The list of modules in `crates/steradian/src/lib.rs` is the order of the layers; a file of one module that names a
//! later one, by `crate::` or by `super::`, is an upward use. Crates have an order too: each may depend on those before
//! it in [`CRATES`]. Comments, and so links in documentation, may point anywhere.

mod tokens;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use tokens::paths;

/// The crates from the lowest up, and those that each may depend on.
const CRATES: [(&str, &[&str]); 4] = [
    ("steradian-kernel", &[]),
    ("steradian", &["steradian-kernel"]),
    ("steradian-io", &["steradian-kernel", "steradian"]),
    (
        "steradian-cli",
        &["steradian-kernel", "steradian", "steradian-io"],
    ),
];

/// An error that lists every upward use in the workspace at `root`.
pub fn check(root: &Path) -> Result<(), String> {
    let crates = root.join("crates");
    let source = crates.join("steradian/src");
    let order = module_order(&read(&source.join("lib.rs"))?);
    if order.is_empty() {
        return Err(format!(
            "{} lists no module",
            source.join("lib.rs").display()
        ));
    }
    let mut faults = Vec::new();
    for file in rust_files(&source)? {
        let relative = file.strip_prefix(&source).unwrap_or(&file);
        let found = upward_uses(relative, &read(&file)?, &order);
        faults.extend(
            found
                .into_iter()
                .map(|fault| format!("{}: {fault}", file.display())),
        );
    }
    for (name, below) in CRATES {
        let manifest = crates.join(name).join("Cargo.toml");
        let found = upward_dependencies(&read(&manifest)?, below);
        faults.extend(
            found
                .into_iter()
                .map(|fault| format!("{}: {fault}", manifest.display())),
        );
    }
    if faults.is_empty() {
        Ok(())
    } else {
        Err(faults.join("\n"))
    }
}

/// The modules of a crate root in the order they are listed.
fn module_order(root_file: &str) -> Vec<String> {
    let names = root_file.lines().filter_map(|line| {
        let declaration = line
            .trim()
            .trim_start_matches("pub(crate) ")
            .trim_start_matches("pub ");
        declaration.strip_prefix("mod ")?.strip_suffix(';')
    });
    names.map(str::to_owned).collect()
}

/// The uses of later modules in one file, whose path is relative to the crate's source folder.
fn upward_uses(file: &Path, text: &str, order: &[String]) -> Vec<String> {
    let Some(own) = file.iter().next().and_then(|part| part.to_str()) else {
        return Vec::new();
    };
    let own = own.trim_end_matches(".rs");
    let Some(level) = order.iter().position(|name| name == own) else {
        return Vec::new();
    };
    let later = |name: &String| {
        order
            .iter()
            .position(|other| other == name)
            .is_some_and(|other| other > level)
    };
    let used: BTreeSet<String> = paths(text)
        .into_iter()
        .filter_map(|path| top_module(&path, file))
        .collect();
    used.iter()
        .filter(|name| later(name))
        .map(|name| format!("`{own}` uses `{name}`, which is above it"))
        .collect()
}

/// The module of the crate that a path leads to, if it leads to the crate's root first.
fn top_module(path: &[String], file: &Path) -> Option<String> {
    let climbs = path.iter().take_while(|part| *part == "super").count();
    let name = path.get(climbs.max(1))?;
    let depth = file.iter().count() - usize::from(file.ends_with("mod.rs"));
    let from_root = path[0] == "crate" || climbs >= depth;
    from_root.then(|| name.clone())
}

/// The crates of the workspace that a manifest depends on and must not.
fn upward_dependencies(manifest: &str, below: &[&str]) -> Vec<String> {
    let mut section = "";
    let mut faults = Vec::new();
    for line in manifest.lines().map(str::trim) {
        if line.starts_with('[') {
            section = line;
        }
        let key = line.split(['.', '=', ' ']).next().unwrap_or_default();
        let ours = CRATES.iter().any(|(name, _)| *name == key);
        if section == "[dependencies]" && ours && !below.contains(&key) {
            faults.push(format!("depends on `{key}`, which is above it"));
        }
    }
    faults
}

fn rust_files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let fail = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(fail)? {
        let path = entry.map_err(fail)?.path();
        if path.is_dir() {
            files.extend(rust_files(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(file: &str, text: &str) -> Vec<String> {
        let order = module_order("//! x\npub mod quantity;\npub mod shape;\nmod light;\n");
        upward_uses(Path::new(file), text, &order)
    }

    #[test]
    fn the_order_is_that_of_the_list() {
        assert_eq!(
            module_order("pub mod b;\n\nmod a;\npub(crate) mod c;\nfn mod_x() {}\n"),
            ["b", "a", "c"]
        );
    }

    #[test]
    fn downward_and_own_uses_pass() {
        assert!(
            faults(
                "light/point.rs",
                "use crate::shape::Disc; use crate::{quantity::Flux, light};"
            )
            .is_empty()
        );
        assert!(faults("shape/mod.rs", "use self::light::X; mod light;").is_empty());
        assert!(faults("shape/disc.rs", "use super::light::Inner;").is_empty());
    }

    #[test]
    fn upward_uses_are_found_in_every_spelling() {
        for text in [
            "use crate::light::Point;",
            "use crate::{quantity::{Flux, Area}, light};",
            "fn f() { let x = crate :: light::new(); }",
            "use super::super::light::Point;",
        ] {
            assert_eq!(
                faults("shape/disc.rs", text),
                ["`shape` uses `light`, which is above it"],
                "{text}"
            );
        }
        assert_eq!(faults("shape.rs", "use super::light;").len(), 1);
        assert_eq!(faults("shape/mod.rs", "use super::light;").len(), 1);
        assert_eq!(
            faults("shape/mod.rs", "use super::{quantity, light};").len(),
            1
        );
    }

    #[test]
    fn comments_and_texts_may_name_anything() {
        let text = "//! See [crate::light].\n/* crate::light /* nested */ */ const A: &str = \"crate::light\"; // crate::light";
        assert!(faults("shape/disc.rs", text).is_empty());
    }

    #[test]
    fn a_crate_must_not_depend_on_one_above() {
        let manifest = "[package]\nname = \"steradian\"\n[dependencies]\nsteradian-io.workspace = true\nglam = \"1\"\n";
        assert_eq!(
            upward_dependencies(manifest, &["steradian-kernel"]).len(),
            1
        );
        assert!(upward_dependencies(manifest, &["steradian-io"]).is_empty());
    }

    #[test]
    fn this_workspace_passes() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        check(&root).unwrap();
    }
}
