//! What can go wrong between a result and a file.

use std::path::PathBuf;

/// Why a report could not be written or a shard not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The operating system refused to write.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The output refused.
    #[error("cannot write: {0}")]
    Output(std::io::Error),
    /// The operating system refused to read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file's name does not tell a format that can be written.
    #[error("cannot tell the format of {}: expected a name that ends in {expected}", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// The endings that are known.
        expected: &'static str,
    },
    /// The format cannot hold these lanes.
    #[error("{format} holds one lane or red, green and blue, not {lanes}; write EXR instead")]
    Lanes {
        /// The format.
        format: &'static str,
        /// The names of the picture's lanes.
        lanes: String,
    },
    /// The encoder of a format failed.
    #[error("cannot encode: {0}")]
    Encoding(String),
    /// A shard file is not what it should be.
    #[error("not a whole shard: {0}")]
    Shard(String),
}
