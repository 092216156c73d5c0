//! MTL: the material libraries of OBJ files.
//!
//! | statement | what becomes of it |
//! |---|---|
//! | `Kd r g b` | reflectance, linear |
//! | `map_Kd FILE` | a texture in sRGB that `Kd` multiplies |
//! | `d`, `Tr` | opacity d = 1 − Tr |
//! | `map_d FILE` | opacity by its alpha, or by its mean of red, green and blue where it has none |
//! | `Ke r g b`, `map_Ke FILE` | emission of the front, as radiance in W/(m² sr) |
//!
//! Options of maps: `-s`, `-o` and `-clamp`; others are passed over. Gloss and refraction (`Ks`, `Ns`, `Ni`, `illum` 3 and more) are
//! left out, and the warnings say of which materials. A reflectance above 1 is taken as 1, and said too.

use std::collections::BTreeMap;
use std::path::Path;

use super::entry::Entry;
use super::lines::{logical_lines, numbers, statement};
use super::maps::{Map, Pictures};
use super::{ObjError, ObjFault};
use crate::files::{Files, reason};
use crate::import::mesh_file::MeshMaterial;

/// The materials of all libraries of a file.
#[derive(Clone, Debug, Default)]
pub struct Library {
    /// In order of definition.
    pub materials: Vec<MeshMaterial>,
    /// What was left out or could not be read.
    pub warnings: Vec<String>,
}

impl Library {
    /// The material of this name.
    pub fn material(&self, name: &str) -> Option<MeshMaterial> {
        self.materials
            .iter()
            .find(|material| material.material.name == name)
            .cloned()
    }
}

/// Reads libraries, of which the first definition of each name counts.
pub(super) fn read_all(
    names: &[String],
    directory: &Path,
    files: &dyn Files,
) -> Result<Library, ObjError> {
    let mut all = Library::default();
    let mut seen: Vec<&String> = Vec::new();
    for name in names {
        if seen.contains(&name) {
            continue;
        }
        seen.push(name);
        let path = directory.join(name.replace('\\', "/"));
        match files.read(&path) {
            Ok(bytes) => {
                let directory = path.parent().unwrap_or(directory);
                let library = read(&bytes, directory, files).map_err(|error| ObjError {
                    library: Some(name.clone()),
                    ..error
                })?;
                all.materials.extend(library.materials);
                all.warnings.extend(library.warnings);
            }
            Err(error) => all.warnings.push(format!(
                "cannot read the material library {name}: {}",
                reason(&error)
            )),
        }
    }
    Ok(all)
}

/// Reads a material library, whose textures are relative to `directory`. One that cannot be read is told in the warnings.
///
/// # Errors
/// The first line that cannot be read.
pub fn read(bytes: &[u8], directory: &Path, files: &dyn Files) -> Result<Library, ObjError> {
    let mut reader = Reader::default();
    for (line, text) in logical_lines(bytes) {
        reader.line(&text).map_err(|fault| ObjError {
            library: None,
            line,
            fault,
        })?;
    }
    Ok(reader.finish(Pictures::new(directory, files)))
}

#[derive(Default)]
struct Reader {
    entries: Vec<Entry>,
    /// Names of materials by what was left out of them.
    left_out: BTreeMap<&'static str, Vec<String>>,
}

const COLOUR: &str = "a colour of one or three numbers, 0 or more";
const RATIO: &str = "a number from 0 to 1";
const FILE: &str = "options and the name of a picture";

impl Reader {
    fn line(&mut self, text: &str) -> Result<(), ObjFault> {
        let (word, rest) = statement(text);
        if word == "newmtl" {
            self.entries.push(Entry::new(rest));
            return Ok(());
        }
        if !KNOWN.contains(&word) {
            return Ok(());
        }
        let Some(entry) = self.entries.last_mut() else {
            return Err(ObjFault::NoMaterial(word.to_owned()));
        };
        let wrong = |expected| ObjFault::Material {
            expected,
            found: text.chars().take(60).collect(),
        };
        let colour = || colour(rest).ok_or_else(|| wrong(COLOUR));
        let ratio = |text| ratio(text).ok_or_else(|| wrong(RATIO));
        let map = || Map::parse(rest).ok_or_else(|| wrong(FILE));
        match word {
            "Kd" => entry.reflectance = colour()?,
            "Ke" => entry.emission = Some(colour()?),
            "d" => entry.opacity = ratio(rest.trim_start_matches("-halo"))?,
            "Tr" => entry.opacity = 1.0 - ratio(rest)?,
            "map_Kd" => entry.reflectance_map = Some(map()?),
            "map_d" => entry.opacity_map = Some(map()?),
            "map_Ke" => entry.emission_map = Some(map()?),
            "Ks" if colour()? != [0.0; 3] => self.leave_out(GLOSS),
            "illum" if numbers(rest).is_some_and(|numbers| numbers.first() >= Some(&3.0)) => {
                self.leave_out(REFLECTION)
            }
            _ => (),
        }
        Ok(())
    }

    /// Remembers that the present material has something that is left out.
    fn leave_out(&mut self, what: &'static str) {
        let Some(entry) = self.entries.last() else {
            return;
        };
        let names = self.left_out.entry(what).or_default();
        if names.last() != Some(&entry.name) {
            names.push(entry.name.clone());
        }
    }

    fn finish(mut self, mut pictures: Pictures<'_>) -> Library {
        let mut materials = Vec::new();
        for entry in self.entries {
            if entry.reflectance.iter().any(|part| *part > 1.0) {
                self.left_out
                    .entry(ABOVE_ONE)
                    .or_default()
                    .push(entry.name.clone());
            }
            materials.push(entry.material(&mut pictures));
        }
        let mut warnings: Vec<String> = self
            .left_out
            .iter()
            .map(|(what, names)| format!("{what}: {}", listed(names)))
            .collect();
        warnings.append(&mut pictures.warnings);
        Library {
            materials,
            warnings,
        }
    }
}

/// Statements that are read, or that change how a material looks.
const KNOWN: [&str; 9] = [
    "Kd", "Ke", "d", "Tr", "Ks", "illum", "map_Kd", "map_d", "map_Ke",
];
const GLOSS: &str = "gloss (Ks) is left out, the reflection is diffuse";
const REFLECTION: &str = "mirror reflection and refraction (illum 3 and more) are left out";
const ABOVE_ONE: &str = "a reflectance (Kd) above 1 is taken as 1";

fn colour(text: &str) -> Option<[f64; 3]> {
    let colour = match numbers(text)?[..] {
        [grey] => [grey; 3],
        [red, green, blue] => [red, green, blue],
        _ => return None,
    };
    colour.iter().all(|part| *part >= 0.0).then_some(colour)
}

fn ratio(text: &str) -> Option<f64> {
    let [number] = numbers(text)?[..] else {
        return None;
    };
    (0.0..=1.0).contains(&number).then_some(number)
}

/// Names beyond this many are counted.
const MOST_LISTED: usize = 5;

fn listed(names: &[String]) -> String {
    let mut text = names
        .iter()
        .take(MOST_LISTED)
        .map(String::as_str)
        .collect::<Vec<_>>()
        .join(", ");
    if names.len() > MOST_LISTED {
        text += &format!(" and {} more", names.len() - MOST_LISTED);
    }
    text
}
