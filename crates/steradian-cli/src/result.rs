//! Readings on their way out.

use std::path::Path;

use clap::ValueEnum;
use steradian::measurement::Measurements;
use steradian_io::report::{Run, csv, json, table};

use crate::output;
use crate::status::{Failure, Outcome};

/// Version of the program, written into every result.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// How readings are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Aligned columns for people
    Table,
    /// One JSON object, "schema": "steradian.result/1"
    Json,
    /// One line a reading, fixed columns
    Csv,
}

impl Format {
    /// The format that the ending of a file's name tells, else a table.
    pub fn of(path: Option<&Path>) -> Self {
        match path
            .and_then(Path::extension)
            .and_then(|ending| ending.to_str())
        {
            Some("json") => Self::Json,
            Some("csv") => Self::Csv,
            _ => Self::Table,
        }
    }
}

/// Measurements of a scene.
pub struct Readings {
    /// What was found.
    pub measurements: Measurements,
    /// Hash of the scene.
    pub scene_hash: String,
    /// Version of the program that measured.
    pub version: String,
}

impl Readings {
    /// What reports take.
    pub fn as_run(&self) -> Run<'_> {
        Run {
            measurements: &self.measurements,
            scene_hash: &self.scene_hash,
            version: &self.version,
        }
    }

    /// Writes a report; not as asked when a tolerance was missed or light was left out.
    pub fn write(&self, format: Option<Format>, file: Option<&Path>) -> Result<Outcome, Failure> {
        let run = self.as_run();
        let text = match format.unwrap_or_else(|| Format::of(file)) {
            Format::Table => table::encode(&run),
            Format::Json => json::encode(&run)?,
            Format::Csv => csv::encode(&run)?,
        };
        output::write(text.as_bytes(), file)?;
        Ok(Outcome::fine_if(
            self.measurements.complete() && self.measurements.converged(),
        ))
    }
}
