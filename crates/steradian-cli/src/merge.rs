//! `steradian merge`: the parts of a run become the whole, bit for bit.

use std::path::PathBuf;

use clap::Args;
use steradian::measurement::Measurements;
use steradian::transport::Picture;

use crate::part::{Kind, Parts};
use crate::picture::{Finished, LookArguments};
use crate::result::{Format, Readings, VERSION};
use crate::status::{Failure, Outcome};

/// Put the parts of a run together that `--shard` computed
///
/// The result has the same bits as the run in one piece. All parts of one run are needed, in any order.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The parts' files
    #[arg(required = true, value_name = "SHARD")]
    parts: Vec<PathBuf>,
    /// Where the whole goes: .json, .csv, .parquet or a table for readings; .exr, .hdr, .png or .pfm for a picture
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// How to write readings [default: by the ending of the output's name, else table]
    #[arg(long, value_enum)]
    format: Option<Format>,
    #[command(flatten)]
    look: LookArguments,
}

const EXAMPLES: &str = "\
Examples:
  steradian measure scenes/furnace.toml --samples 65536 --shard 1/2 -o part1
  steradian measure scenes/furnace.toml --samples 65536 --shard 2/2 -o part2
  steradian merge part1 part2 -o furnace.json";

/// Reads, merges and writes.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let output = &arguments.output;
    let parts = Parts::read(&arguments.parts)?;
    let scene_hash = parts.scene_hash();
    match parts.kind()? {
        Kind::Readings => {
            let measurements = Measurements::merge(parts.contents()?)?;
            Readings {
                measurements,
                scene_hash,
                version: VERSION.to_owned(),
            }
            .write(Format::of(arguments.format, Some(output))?, Some(output))
        }
        Kind::Picture => {
            let picture = Picture::merge(parts.contents()?)?;
            Finished {
                picture,
                scene_hash,
            }
            .write(arguments.look.look(), output)
        }
    }
}
