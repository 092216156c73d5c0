//! Where results go.

use std::ffi::OsStr;
use std::io::{self, BufWriter, Write};
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
    let Some(path) = file else {
        let mut stdout = BufWriter::new(io::stdout().lock());
        encode(&mut stdout)?;
        return Ok(stdout.flush()?);
    };
    let mut file = AtomicFile::create(path)?;
    let mut buffer = BufWriter::new(file.sink());
    let written = encode(&mut buffer).and_then(|()| buffer.flush());
    drop(buffer);
    written.map_err(|source| ReportError::Write {
        path: path.to_owned(),
        source,
    })?;
    Ok(file.finish()?)
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
