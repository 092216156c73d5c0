//! `steradian report`: a result as one page.

use std::path::PathBuf;

use clap::Args;
use steradian_io::files::DiskFiles;
use steradian_io::report::{html, stored};

use crate::output;
use crate::status::{Failure, Outcome};

/// Write what a run found as one HTML page: statistics, plans, isolux lines, shares of light groups, all readings
///
/// RESULT is the JSON that `steradian measure SCENE -o RESULT.json` writes. Nothing is traced again.
///
/// The page is one file, which needs no network and no other file. It states what a repetition needs (scene hash, seed, version),
/// what the error bars leave out, and what was not sampled.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Result of `steradian measure`, as JSON
    #[arg(value_name = "RESULT.json")]
    result: PathBuf,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  steradian measure room.toml -o room.json
  steradian report room.json -o room.html";

/// Writes the page.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let run = stored::read(&arguments.result, &DiskFiles::default())?;
    let page = html::encode(&run.as_run()).map_err(|error| Failure::Other(error.into()))?;
    output::write(page.as_bytes(), arguments.output.as_deref())?;
    Ok(Outcome::Fine)
}
