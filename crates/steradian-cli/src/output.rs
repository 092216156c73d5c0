//! Where results go.

use std::ffi::OsStr;
use std::io::{self, BufWriter, Stdout, Write};
use std::path::Path;

use clap::ValueEnum;
use steradian_io::report::{AtomicFile, ReportError, write_atomically};

use crate::status::Failure;

/// Text, or one JSON object.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum Format {
    /// For people
    #[default]
    Table,
    /// For programs
    Json,
}

/// Writes to the file, whole or not at all, or to standard output if there is none.
pub fn write(bytes: &[u8], file: Option<&Path>) -> Result<(), Failure> {
    let Some(path) = file else {
        let mut stdout = io::stdout().lock();
        stdout.write_all(bytes)?;
        return Ok(stdout.flush()?);
    };
    Ok(write_atomically(path, bytes)?)
}

/// Lets `encode` write to the file, whole or not at all, or to standard output if there is none, piece by piece.
pub fn stream(
    file: Option<&Path>,
    encode: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let mut sink = Sink::open(file)?;
    encode(&mut sink).map_err(|error| refused(error, file))?;
    sink.finish()
}

/// Standard output, or a file that is there when it is finished.
pub enum Sink {
    Standard(BufWriter<Stdout>),
    File(BufWriter<AtomicFile>),
}

impl Sink {
    /// Begins the file, or standard output if there is none.
    pub fn open(file: Option<&Path>) -> Result<Self, Failure> {
        Ok(match file {
            Some(path) => Self::File(BufWriter::new(AtomicFile::create(path)?)),
            None => Self::Standard(BufWriter::new(io::stdout())),
        })
    }

    /// All is written.
    pub fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Standard(mut stdout) => Ok(stdout.flush()?),
            Self::File(buffer) => {
                let file = buffer.into_inner();
                let file = file.map_err(|error| ReportError::Output(error.into_error()))?;
                Ok(file.finish()?)
            }
        }
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Standard(stdout) => stdout.write(bytes),
            Self::File(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Standard(stdout) => stdout.flush(),
            Self::File(file) => file.flush(),
        }
    }
}

/// What to say when a report could not be written.
pub fn refused(error: io::Error, file: Option<&Path>) -> Failure {
    match (error.downcast::<ReportError>(), file) {
        (Ok(report), _) => report.into(),
        (Err(source), Some(path)) => {
            let path = path.to_owned();
            ReportError::Write { path, source }.into()
        }
        (Err(error), None) => error.into(),
    }
}

/// Prints to standard output.
pub fn print(text: &str) -> Result<(), Failure> {
    write(text.as_bytes(), None)
}

/// Whether a drawing goes to a PNG rather than an SVG, by its name.
pub fn is_png(file: &Path) -> Result<bool, Failure> {
    match file.extension().and_then(OsStr::to_str) {
        Some("svg") => Ok(false),
        Some("png") => Ok(true),
        _ => Err(Failure::message(format!(
            "{}: a drawing is an .svg or .png file",
            file.display()
        ))),
    }
}
