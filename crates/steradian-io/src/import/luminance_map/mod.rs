//! Pictures of luminance, as glare is assessed from: Radiance HDR, OpenEXR and PFM.
//!
//! | format | cd/m² of a pixel | view | errors |
//! |---|---|---|---|
//! | HDR of Radiance | 179 (0.265 R + 0.670 G + 0.065 B) | `VIEW=` of the header: -vta, -vth, -vtv | – |
//! | HDR of Steradian | 179 (0.2126 R + 0.7152 G + 0.0722 B) | – | – |
//! | OpenEXR of Steradian | the quantity in its attribute `steradian` | – | layer `std_error` |
//! | other OpenEXR | `whiteLuminance`, or else 179, times (0.2126 R + 0.7152 G + 0.0722 B) | – | – |
//! | PFM | 179 (0.2126 R + 0.7152 G + 0.0722 B), 179 of one lane | – | `NAME.error.pfm` beside it |
//!
//! Standard errors of lanes are added, for lanes are of the same paths. Source: G. Ward Larson & R. Shakespeare, *Rendering with Radiance* (1998), for
//! views and for 179 lm/W.

mod openexr;
mod pfm;
mod radiance;

use std::path::Path;

use steradian::sensor::Projection;
use thiserror::Error;

use super::image::ImageError;
use crate::files::{Files, reason};

/// Luminous efficacy where a picture states none, in lm/W: Radiance's.
const EFFICACY: f64 = 179.0;

/// A picture of luminance.
#[derive(Clone, Debug, PartialEq)]
pub struct LuminanceMap {
    /// Columns and rows.
    pub size: [u32; 2],
    /// In cd/m², row by row from the top left.
    pub luminances: Vec<f64>,
    /// Their standard errors.
    pub std_errors: Option<Vec<f64>>,
    /// The projection, if the file states it.
    pub projection: Option<Projection>,
}

/// Why a file is no picture of luminance.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum LuminanceMapError {
    /// Not to be had.
    #[error("cannot read the picture: {0}")]
    File(String),
    /// Not a format with light in it.
    #[error("expected a picture of light: .hdr, .pic, .exr or .pfm")]
    Format,
    /// Not a picture.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// A picture, but its numbers mean no luminance.
    #[error("{0}")]
    Meaning(String),
}

/// Whether a file of this name is such a picture.
pub fn is_luminance_map(path: &Path) -> bool {
    format(path).is_some()
}

/// Reads one of these formats; `NAME.error.pfm` is looked for in the same place.
type Reader = fn(&Path, &[u8], &dyn Files) -> Result<LuminanceMap, LuminanceMapError>;

fn format(path: &Path) -> Option<Reader> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "hdr" | "pic" => Some(|_, bytes, _| radiance::read(bytes)),
        "exr" => Some(|_, bytes, _| openexr::read(bytes)),
        "pfm" => Some(pfm::read),
        _ => None,
    }
}

/// Reads a picture of luminance.
///
/// # Errors
/// If it is no whole picture of a known format, or its numbers have no luminance.
pub fn read(path: &Path, files: &dyn Files) -> Result<LuminanceMap, LuminanceMapError> {
    let reader = format(path).ok_or(LuminanceMapError::Format)?;
    let bytes = files.read(path);
    let bytes = bytes.map_err(|error| LuminanceMapError::File(reason(&error).to_string()))?;
    reader(path, &bytes, files)
}

/// Σ weight · lane.
fn weighted(lanes: [f32; 3], weights: [f64; 3]) -> f64 {
    (0..3)
        .map(|lane| weights[lane] * f64::from(lanes[lane]))
        .sum()
}
