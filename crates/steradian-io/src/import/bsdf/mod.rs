//! Files of measured surfaces.
//!
//! | extension | format | becomes |
//! |---|---|---|
//! | `.xml` | BSDF XML of LBNL (WINDOW, Radiance): matrices of Klems patches, tensor trees | [`TwoSided`] |
//! | `.binary` | MERL's database | [`Merl`](steradian::brdf::measured::Merl) |
//! | `.bsdf` | tensor files of EPFL's RGL | [`Rgl`](steradian::brdf::measured::Rgl) |
//!
//! A file becomes a model for each band it has, what its header tells, and warnings about what was mended or passed over.

mod error;
pub mod merl;
pub mod reciprocity;
pub mod rgl;
pub mod summary;
pub mod xml;

use std::path::Path;

use steradian::brdf::Measured;
use steradian::brdf::measured::{Block, TwoSided};

use crate::files::{Files, reason};
pub use error::{BinaryFault, BsdfError, XmlFault};

/// Bands that a scene is shown in, the best first.
const SEEN: [&str; 1] = ["Visible"];

/// What a file of a measured surface holds.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredFile {
    /// What the format is called.
    pub format: &'static str,
    /// What the header tells: names and values as they stand there.
    pub header: Vec<(String, String)>,
    /// The models; one at least.
    pub bands: Vec<Band>,
    /// What was mended or passed over.
    pub warnings: Vec<String>,
}

/// A part of the spectrum with its own values.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// `Visible`, `Solar`, …
    pub name: String,
    /// The values.
    pub model: Measured,
}

impl MeasuredFile {
    /// The model that scenes use: of visible light, else the first.
    pub fn model(&self) -> Option<&Measured> {
        let named = |name: &str| self.bands.iter().find(|band| band.name == name);
        let seen = SEEN.into_iter().find_map(named);
        seen.or(self.bands.first()).map(|band| &band.model)
    }
}

/// Whether the extension of a file is one of those of measured surfaces.
pub fn is_measured(path: &Path) -> bool {
    reader(path).is_some()
}

type Reader = fn(&[u8]) -> Result<MeasuredFile, BsdfError>;

fn reader(path: &Path) -> Option<Reader> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "xml" => Some(xml::read),
        "binary" => Some(merl::read),
        "bsdf" => Some(rgl::read),
        _ => None,
    }
}

/// Reads the file of a measured surface; its extension tells the format.
///
/// # Errors
/// If the file cannot be read, its extension is unknown, or the first thing that is wrong with it.
pub fn read(path: &Path, files: &dyn Files) -> Result<MeasuredFile, BsdfError> {
    let unknown = || BsdfError::Format(path.display().to_string());
    let reader = reader(path).ok_or_else(unknown)?;
    let bytes = files.read(path);
    reader(&bytes.map_err(|error| BsdfError::Unreadable(reason(&error)))?)
}

/// How a block divides the directions, in words.
pub fn division(block: &Block) -> String {
    match block {
        Block::Matrix(matrix) => {
            let [from, to] = [matrix.incident(), matrix.scattered()]
                .map(|basis| format!("{} ({} patches)", basis.name(), basis.patches()));
            if from == to {
                from
            } else {
                format!("{from} to {to}")
            }
        }
        Block::Tree(tree) => {
            let axes = tree.rank().axes();
            let finest = (1.0 / tree.resolution()) as u64;
            format!(
                "tensor tree of rank {axes}, {} leaves, up to {finest} an axis",
                tree.leaves()
            )
        }
    }
}

/// The table of a file of LBNL.
pub fn two_sided(model: &Measured) -> Option<&TwoSided> {
    match model {
        Measured::TwoSided(table) => Some(table),
        _ => None,
    }
}
