//! `steradian plot`: pictures of a result.

use std::ffi::OsStr;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use steradian::measurement::Measurements;
use steradian_io::files::DiskFiles;
use steradian_io::report::figure::{self, Choice, ChoiceError, Need, Subject};
use steradian_io::report::stored;
use steradian_io::report::svg::Svg;

use crate::output;
use crate::status::{Failure, Outcome};

/// Draw what a run found: plans with numbers, isolux lines with their error bands, shares of light groups
///
/// RESULT is the JSON that `steradian measure SCENE -o RESULT.json` writes. Nothing is traced again.
///
/// A plan shows the points of a sensor from above at true scale, those of an upright grid from its front, in colours with a number
/// in each cell. Isolux lines join places of equal values; around each line is shaded where it may lie, for that is where the
/// error bar of the value holds the line's level.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Result of `steradian measure`, as JSON
    #[arg(value_name = "RESULT.json")]
    result: PathBuf,
    /// What is drawn
    #[arg(long, value_enum, default_value_t)]
    kind: Kind,
    /// Sensor that is drawn [default: the first that suits; for shares and matrix all]
    #[arg(long, value_name = "NAME")]
    sensor: Option<String>,
    /// Quantity that is drawn, where a sensor reports several: illuminance, irradiance … [default: the first]
    #[arg(long, value_name = "NAME")]
    quantity: Option<String>,
    /// With `plan`: write the half-width of the interval below each number
    #[arg(long)]
    errors: bool,
    /// With `isolux`: the values that have lines, in the unit of the readings: 100,200,300 [default: round ones]
    #[arg(
        long,
        value_name = "VALUES",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    levels: Vec<f64>,
    /// The picture, by its ending
    #[arg(short, long, value_name = "FILE.svg|FILE.png")]
    output: PathBuf,
}

/// What is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Values where they are, in colours with numbers
    #[default]
    Plan,
    /// Lines of equal values, with the bands in which they may lie; of a grid
    #[value(alias = "isolines")]
    Isolux,
    /// How much of each value each light group gives, as bars: of all sensors, or of the points of --sensor
    Shares,
    /// What each light group gives to each sensor, or to each point of --sensor, in colours
    Matrix,
}

const EXAMPLES: &str = "\
Examples:
  steradian measure room.toml -o room.json
  steradian plot room.json -o plan.svg
  steradian plot room.json --errors -o plan.png
  steradian plot room.json --kind isolux --levels 100,200,300,500 -o isolux.svg
  steradian plot room.json --kind shares -o shares.svg
  steradian plot room.json --kind shares --sensor desk -o desk.svg

Form factors are drawn by `steradian form-factor SCENE --matrix --plot FILE`.";

/// Writes the picture.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let is_png = match arguments.output.extension().and_then(OsStr::to_str) {
        Some("svg") => false,
        Some("png") => true,
        _ => return Err(Failure::message("expected -o FILE.svg or -o FILE.png")),
    };
    refuse_what_has_no_use(arguments)?;
    let run = stored::read(&arguments.result, &DiskFiles::default())?;
    let choice = Choice {
        sensor: arguments.sensor.as_deref(),
        quantity: arguments.quantity.as_deref(),
    };
    let drawing = drawing(&run.measurements, choice, arguments)?;
    let bytes = match is_png {
        true => drawing.to_png()?,
        false => drawing.finish().into_bytes(),
    };
    output::write(&bytes, Some(&arguments.output))?;
    Ok(Outcome::Fine)
}

fn drawing(
    measurements: &Measurements,
    choice: Choice<'_>,
    arguments: &Arguments,
) -> Result<Svg, Failure> {
    let subjects = Subject::all(measurements);
    let one = |need| choice.one(&subjects, need).map_err(failed);
    let several = || choice.matching(&subjects).map_err(failed);
    let drawing = match arguments.kind {
        Kind::Plan => figure::plan(measurements, one(Need::Places)?, arguments.errors),
        Kind::Isolux => figure::isolines(measurements, one(Need::Grid)?, &arguments.levels),
        Kind::Shares => figure::shares(measurements, &several()?),
        Kind::Matrix => figure::matrix(measurements, &several()?),
    };
    drawing.map_err(|error| Failure::Other(error.into()))
}

fn failed(error: ChoiceError) -> Failure {
    Failure::Other(error.into())
}

fn refuse_what_has_no_use(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.errors && arguments.kind != Kind::Plan {
        return Err(Failure::message("--errors goes with --kind plan"));
    }
    if !arguments.levels.is_empty() && arguments.kind != Kind::Isolux {
        return Err(Failure::message("--levels goes with --kind isolux"));
    }
    if let Some(level) = arguments.levels.iter().find(|level| !level.is_finite()) {
        return Err(Failure::message(format!("--levels: {level} is no value")));
    }
    Ok(())
}
