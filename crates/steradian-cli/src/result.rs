//! Readings on their way out.

use std::io::{IsTerminal, stdout};
use std::path::Path;

use clap::ValueEnum;
use steradian::measurement::{Balance, Measurements};
use steradian_io::report::{Run, StreamFormat, csv, json, table};

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
    /// For data frames and databases: the columns of CSV, and one for each channel and light group
    Parquet,
}

impl Format {
    /// The same where it can be written block by block.
    pub fn streamed(self) -> Option<StreamFormat> {
        match self {
            Self::Table => None,
            Self::Json => Some(StreamFormat::Json),
            Self::Csv => Some(StreamFormat::Csv),
            #[cfg(feature = "parquet")]
            Self::Parquet => Some(StreamFormat::Parquet),
            #[cfg(not(feature = "parquet"))]
            Self::Parquet => None,
        }
    }

    /// What was asked for, or what the ending of the name says, or a table. What cannot be written is told here, before light is traced.
    pub fn of(asked: Option<Self>, file: Option<&Path>) -> Result<Self, Failure> {
        let ending = file
            .and_then(Path::extension)
            .and_then(|ending| ending.to_str());
        let format = asked.unwrap_or(match ending {
            Some("json") => Self::Json,
            Some("csv") => Self::Csv,
            Some("parquet") => Self::Parquet,
            _ => Self::Table,
        });
        match format {
            Self::Parquet if cfg!(not(feature = "parquet")) => Err(without_parquet()),
            Self::Parquet if file.is_none() && stdout().is_terminal() => Err(Failure::message(
                "Parquet is not for a terminal; name a file: -o FILE.parquet",
            )),
            _ => Ok(format),
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
    pub fn write(&self, format: Format, file: Option<&Path>) -> Result<Outcome, Failure> {
        let run = self.as_run();
        match format {
            Format::Table => output::write(table::encode(&run).as_bytes(), file)?,
            Format::Json => output::stream(file, |out| json::write(&run, out))?,
            Format::Csv => output::stream(file, |out| csv::write(&run, out))?,
            Format::Parquet => write_parquet(&run, file)?,
        }
        Ok(Outcome::fine_if(self.is_good()))
    }

    /// Nothing was left out, every tolerance was met, and every energy balance holds.
    fn is_good(&self) -> bool {
        let balances = self.measurements.balances();
        let found = &self.measurements;
        found.complete() && found.converged() && balances.iter().all(Balance::holds)
    }
}

#[cfg(feature = "parquet")]
fn write_parquet(run: &Run<'_>, file: Option<&Path>) -> Result<(), Failure> {
    let mut sink = output::Sink::open(file)?;
    steradian_io::report::parquet::encode(run, &mut sink)?;
    sink.finish()
}

#[cfg(not(feature = "parquet"))]
fn write_parquet(_: &Run<'_>, _: Option<&Path>) -> Result<(), Failure> {
    Err(without_parquet())
}

fn without_parquet() -> Failure {
    Failure::message(
        "this program was built without Parquet; \
         `cargo install --path crates/steradian-cli --features parquet` builds one that writes it",
    )
}
