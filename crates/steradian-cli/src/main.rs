//! The `steradian` command: reads a scene, asks the library, and writes what it says.

mod area;
mod args;
mod brdf;
mod direction;
mod energy;
mod engine;
mod form_factor;
mod glare;
mod help;
mod inspect;
mod interrupt;
mod learn;
mod load;
mod measure;
mod merge;
mod output;
mod part;
mod picture;
mod plot;
mod points;
mod progress;
mod render;
mod report;
mod result;
mod solid_angle;
mod status;
mod tolerance;
mod values;
mod verify;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};
use status::{Failure, Outcome};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    status::exit_code(run(arguments.command))
}

fn run(command: Command) -> Result<Outcome, Failure> {
    match command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Measure(arguments) => measure::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Glare(arguments) => glare::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Area(arguments) => area::run(&arguments),
        Command::FormFactor(arguments) => form_factor::run(&arguments),
        Command::SolidAngle(arguments) => solid_angle::run(&arguments),
        Command::Brdf(arguments) => brdf::run(&arguments),
        Command::Direction(arguments) => direction::run(&arguments),
        Command::Energy(arguments) => energy::run(&arguments),
        Command::Learn(arguments) => learn::run(&arguments),
        Command::Help(arguments) => help::run(&arguments),
    }
}
