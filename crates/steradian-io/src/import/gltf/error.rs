//! Why a glTF file cannot be read.

use std::path::PathBuf;

use thiserror::Error;

use crate::import::image::ImageError;

/// What is wrong with a glTF file, and where. Places are written as in `meshes[2].primitives[0]`.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum GltfError {
    /// A file that cannot be read.
    #[error("cannot read {}: {reason}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// Neither a whole GLB container nor text.
    #[error("not a glTF file: {0}")]
    Container(String),
    /// Not the JSON of a glTF file.
    #[error("not valid glTF: {0}")]
    Json(String),
    /// Another version of the format.
    #[error("expected glTF 2.0, found version \"{0}\"")]
    Version(String),
    /// An extension without which the file cannot be read.
    #[error("the file needs the extension {0}, which is not supported")]
    Extension(String),
    /// A part of the file that says what cannot be.
    #[error("{place}: {fault}")]
    Invalid {
        /// The part.
        place: String,
        /// What is wrong with it.
        fault: String,
    },
    /// A picture that cannot be read.
    #[error("{place}: {source}")]
    Image {
        /// The part that holds or names it.
        place: String,
        /// What is wrong with it.
        source: ImageError,
    },
    /// More than can be held, or than so small a file can mean.
    #[error("more than {limit} {what}")]
    TooLarge {
        /// Of what.
        what: &'static str,
        /// The most there may be.
        limit: usize,
    },
    /// A scene without a surface.
    #[error("the scene of this file has no surface")]
    Empty,
}

impl GltfError {
    /// A fault of the part at `place`.
    pub(super) fn at(place: impl ToString, fault: impl Into<String>) -> Self {
        Self::Invalid {
            place: place.to_string(),
            fault: fault.into(),
        }
    }
}
