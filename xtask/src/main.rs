//! Project tasks, with no dependency but the toolchain: `cargo xtask test | bench | docs | schema | layers | licences`.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a command that talks to a developer"
)]

mod bench;
mod json;
mod layers;
mod licences;
mod schema;
mod steps;
mod suite;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "\
Usage: cargo xtask TASK

  test [--statistics]   everything a change must pass; --statistics runs the statistical tests at full count instead
  bench [PART …]        the benchmark suite beside other programs; bench --help names its parts
  bench stages [FILTER] the benchmarks of single functions, which need no other program
  docs                  the documentation of the public interface; runs the commands of the examples
  schema [--check]      write (or compare) the files generated from the scene file's table of keys
  layers                fail when a module uses one above it
  licences              fail when a dependency's licence is not a permissive one";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(words: &[&str]) -> Result<(), String> {
    let root = root();
    match words {
        ["test"] => suite::test(&root),
        ["test", "--statistics"] => suite::statistics(&root),
        ["bench", "stages", rest @ ..] => suite::stages(&root, rest),
        ["bench", rest @ ..] => bench::run(&root, rest),
        ["docs"] => suite::docs(&root),
        ["schema"] => schema::write(&root),
        ["schema", "--check"] => schema::check(&root),
        ["layers"] => layers::check(&root),
        ["licences"] => licences::check(&root),
        _ => Err(USAGE.to_owned()),
    }
}

fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}
