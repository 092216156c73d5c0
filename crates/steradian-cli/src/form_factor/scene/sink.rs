//! Rows on their way out: streamed where the format allows it.

use std::io::{Write, stdout};
use std::path::Path;

use clap::ValueEnum;
use steradian::exchange::{MatrixSummary, Row};
use steradian_io::report::AtomicFile;
use steradian_io::report::form_factors::FactorReport;

use crate::output;
use crate::status::Failure;

/// More surfaces than this are no table.
const MOST_IN_TABLE: usize = 16;

/// How to print.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people: the matrix, if it is small, and a summary
    Table,
    /// For programs: one object
    Json,
    /// One line for each factor
    Csv,
    /// Arrays for NumPy, a sparse matrix for SciPy; needs -o
    Npz,
}

impl Format {
    /// What was asked for, or what the ending of the name says, or a table.
    pub fn of(asked: Option<Self>, file: Option<&Path>) -> Result<Self, Failure> {
        let ending = file
            .and_then(Path::extension)
            .and_then(|ending| ending.to_str());
        let format = asked.unwrap_or(match ending {
            Some("json") => Self::Json,
            Some("csv") => Self::Csv,
            Some("npz") => Self::Npz,
            _ => Self::Table,
        });
        if format == Self::Npz && file.is_none() {
            return Err(Failure::message("--format npz needs a file: -o FILE.npz"));
        }
        Ok(format)
    }
}

/// Takes the rows as they come.
pub struct Sink<'a> {
    format: Format,
    report: &'a FactorReport,
    file: Option<&'a Path>,
    stream: Stream,
    /// For formats that need all rows at once.
    rows: Vec<Row>,
    first: bool,
    silent: bool,
    failure: Option<Failure>,
}

/// Where text goes at once.
enum Stream {
    Standard,
    File(AtomicFile),
    /// All at the end.
    None,
}

impl<'a> Sink<'a> {
    /// Opens the file and writes what comes before the rows; a silent sink writes nothing at all.
    pub fn new(
        format: Format,
        report: &'a FactorReport,
        file: Option<&'a Path>,
        silent: bool,
    ) -> Result<Self, Failure> {
        let stream = match (format, file) {
            (Format::Table | Format::Npz, _) => Stream::None,
            _ if silent => Stream::None,
            (_, None) => Stream::Standard,
            (_, Some(path)) => Stream::File(AtomicFile::create(path)?),
        };
        let mut sink = Self {
            format,
            report,
            file,
            stream,
            rows: Vec::new(),
            first: true,
            silent,
            failure: None,
        };
        match format {
            Format::Csv => sink.write(FactorReport::CSV_HEAD)?,
            Format::Json => sink.write(&report.json_head())?,
            Format::Table | Format::Npz => {}
        }
        Ok(sink)
    }

    /// Takes a row; what goes wrong is told by [`finish`](Self::finish).
    pub fn take(&mut self, row: Row) {
        let written = match self.format {
            Format::Csv => self.write(&self.report.csv_row(&row)),
            Format::Json => self.write(&self.report.json_row(&row, self.first)),
            Format::Table if self.silent || self.report.names.len() > MOST_IN_TABLE => Ok(()),
            Format::Table | Format::Npz => {
                self.rows.push(row);
                Ok(())
            }
        };
        self.first = false;
        if let Err(failure) = written {
            self.failure.get_or_insert(failure);
        }
    }

    fn write(&mut self, text: &str) -> Result<(), Failure> {
        match &mut self.stream {
            Stream::Standard => Ok(stdout().lock().write_all(text.as_bytes())?),
            Stream::File(file) => Ok(file.append(text.as_bytes())?),
            Stream::None => Ok(()),
        }
    }

    /// Writes what comes after the rows and closes the file.
    pub fn finish(mut self, summary: &MatrixSummary) -> Result<(), Failure> {
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        match self.format {
            Format::Json => self.write(&self.report.json_foot(summary))?,
            Format::Npz => output::write(&self.report.npz(&self.rows)?, self.file)?,
            Format::Table if !self.rows.is_empty() => {
                output::write(self.report.table(&self.rows).as_bytes(), self.file)?;
            }
            Format::Table | Format::Csv => {}
        }
        match self.stream {
            Stream::File(file) => Ok(file.finish()?),
            Stream::Standard => Ok(stdout().flush()?),
            Stream::None => Ok(()),
        }
    }
}
