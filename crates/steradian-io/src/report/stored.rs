//! Results in again: the JSON of [`super::json`] holds, as `stored`, all that it was written from.
//!
//! ```
//! use std::path::Path;
//! use steradian_io::files::MemoryFiles;
//! use steradian_io::report::stored;
//!
//! let files = MemoryFiles::default().with("room.json", "{ \"schema\": \"steradian.result/9\" }");
//! let error = stored::read(Path::new("room.json"), &files).unwrap_err();
//! assert_eq!(
//!     error.to_string(),
//!     "room.json: this version reads steradian.result/1, not steradian.result/9"
//! );
//! ```

use std::path::{Path, PathBuf};

use serde::Deserialize;
use steradian::measurement::{Contradiction, Measurements};

use super::json::SCHEMA;
use super::run::Run;
use crate::files::{Files, reason};

/// A result that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredRun {
    /// What was found.
    pub measurements: Measurements,
    /// Hash of the scene's content.
    pub scene_hash: String,
    /// Version of Steradian that measured.
    pub version: String,
}

impl StoredRun {
    /// What reports take.
    pub fn as_run(&self) -> Run<'_> {
        Run {
            measurements: &self.measurements,
            scene_hash: &self.scene_hash,
            version: &self.version,
        }
    }
}

/// Why a result could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StoredError {
    /// The file cannot be read.
    #[error("{}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// Not JSON, or not what a result holds.
    #[error("{}:{line}:{column}: {message}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// JSON of something else.
    #[error("{}: not a result of `steradian measure --format json`: it has no \"schema\"", path.display())]
    NoResult {
        /// The file.
        path: PathBuf,
    },
    /// A format of another version, or another kind of report.
    #[error("{}: this version reads {SCHEMA}, not {found}", path.display())]
    Schema {
        /// The file.
        path: PathBuf,
        /// What it says it is.
        found: String,
    },
    /// Parts that do not agree.
    #[error("{}: {contradiction}", path.display())]
    Contradiction {
        /// The file.
        path: PathBuf,
        /// What does not agree.
        contradiction: Contradiction,
    },
}

#[derive(Deserialize)]
struct Envelope {
    schema: Option<String>,
}

#[derive(Deserialize)]
struct Content {
    version: String,
    scene_hash: String,
    stored: Measurements,
}

/// Reads the JSON that [`super::json::encode`] wrote, bit for bit.
///
/// # Errors
/// If the file is not such a result, of another version of the format, or was cut short.
pub fn read(path: &Path, files: &dyn Files) -> Result<StoredRun, StoredError> {
    let bytes = files.read(path).map_err(|error| StoredError::Read {
        path: path.to_owned(),
        reason: reason(&error),
    })?;
    let envelope: Envelope = parse(path, &bytes)?;
    match envelope.schema {
        Some(schema) if schema == SCHEMA => {}
        Some(found) => {
            let path = path.to_owned();
            return Err(StoredError::Schema { path, found });
        }
        None => return Err(StoredError::NoResult { path: path.into() }),
    }
    let content: Content = parse(path, &bytes)?;
    let checked = content.stored.check();
    checked.map_err(|contradiction| StoredError::Contradiction {
        path: path.to_owned(),
        contradiction,
    })?;
    Ok(StoredRun {
        measurements: content.stored,
        scene_hash: content.scene_hash,
        version: content.version,
    })
}

fn parse<'a, T: Deserialize<'a>>(path: &Path, bytes: &'a [u8]) -> Result<T, StoredError> {
    serde_json::from_slice(bytes).map_err(|error| {
        let place = format!(" at line {} column {}", error.line(), error.column());
        let text = error.to_string();
        let what = text.strip_suffix(&place).unwrap_or(&text);
        let is_cut = bytes.starts_with(b"{") && !bytes.trim_ascii_end().ends_with(b"}");
        let message = if error.is_eof() || is_cut {
            "the file ends too soon; it was cut short".to_owned()
        } else {
            format!("not a result of `steradian measure --format json`: {what}")
        };
        StoredError::Content {
            path: path.to_owned(),
            line: error.line(),
            column: error.column(),
            message,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::json::encode;
    use super::super::run::tests::{measurements, run};
    use super::*;
    use crate::files::MemoryFiles;

    fn read_text(text: &str) -> Result<StoredRun, StoredError> {
        read(
            Path::new("a.json"),
            &MemoryFiles::default().with("a.json", text),
        )
    }

    fn message(text: &str) -> String {
        read_text(text).unwrap_err().to_string()
    }

    #[test]
    fn what_was_written_is_read_and_writes_the_same_bytes() {
        let measurements = measurements();
        let text = encode(&run(&measurements)).unwrap();
        let read = read_text(&text).unwrap();
        assert_eq!(read.measurements, measurements);
        assert_eq!(encode(&read.as_run()).unwrap(), text);
    }

    #[test]
    fn every_truncation_is_told() {
        let text = encode(&run(&measurements())).unwrap();
        let text = text.trim_end();
        for length in 1..text.len() {
            let found = message(&text[..length]);
            assert!(found.ends_with("it was cut short"), "{length}: {found}");
        }
    }

    #[test]
    fn other_files_are_told() {
        for (text, expected) in [
            ("", "a.json:1:0: the file ends too soon"),
            (
                "[scene]\n",
                "a.json:1:2: not a result of `steradian measure",
            ),
            ("{}", "has no \"schema\""),
            (
                "{\"schema\": \"steradian.result/1\",\n \"version\": 3}",
                "a.json:2:13: not a result of `steradian measure --format json`: invalid type: integer `3`",
            ),
        ] {
            let found = message(text);
            assert!(found.contains(expected), "{found}");
        }
        let missing = read(Path::new("no.json"), &MemoryFiles::default());
        assert_eq!(missing.unwrap_err().to_string(), "no.json: no such file");
    }

    /// A run that was stopped may have points without samples: their readings are unknown, and so are statistics with them.
    #[test]
    fn points_without_samples_are_read() {
        let mut stored = serde_json::to_value(measurements()).unwrap();
        let replicates = &mut stored["sensors"][0]["points"][1]["replicates"];
        replicates["samples"] = vec![0; 4].into();
        replicates["sums"] = vec![0.0; 16].into();
        let stopped: Measurements = serde_json::from_value(stored).unwrap();
        let text = encode(&run(&stopped)).unwrap();
        let read = read_text(&text).unwrap().measurements;
        assert!(read.readings()[1].is_dark() && !read.converged());
        assert!(read.statistics()[0].mean.std_error.is_infinite());
    }

    /// Each would be an index out of bounds when readings are derived.
    #[test]
    fn lists_of_wrong_length_are_told() {
        let text = encode(&run(&measurements())).unwrap();
        for (part, other, expected) in [
            (
                "\"groups\":[\"lamp\",\"window\"]",
                "\"groups\":[\"lamp\"]",
                "point 0 of sensor `a, b`",
            ),
            (
                "\"weights\":[1.0,1.0],",
                "\"weights\":[1.0],",
                "the 2 lanes of the run",
            ),
            (
                "\"exact\":[80.0,20.0,0.0,0.0]",
                "\"exact\":[80.0]",
                "point 0",
            ),
            (
                "\"samples\":[10,10,10,10]",
                "\"samples\":[10,10,10]",
                "point 1",
            ),
            (
                "\"samples\":[10,10,10,10]",
                "\"samples\":[0,0,0,0]",
                "point 1",
            ),
            ("\"schedules\":[]", "\"schedules\":[null]", "2 light groups"),
            (
                "\"layout\":null",
                "\"layout\":{\"origin\":[0,0,0],\"edges\":[[1,0,0],[0,1,0]],\"count\":[3,1]}",
                "2 points on a grid of 3 cells",
            ),
        ] {
            let altered = text.replace(part, other);
            assert_ne!(altered, text, "{part}");
            let found = message(&altered);
            assert!(found.contains(expected), "{found}");
        }
    }
}
