//! Where results go.

use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::Path;

use clap::ValueEnum;
use steradian_io::report::write_atomically;

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
