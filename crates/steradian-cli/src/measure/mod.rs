//! `steradian measure`: what the sensors of a scene read.

mod balance;
mod relight;
mod result_file;
mod solve;
mod stream;

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use steradian::estimation::{Plan, Stopping};
use steradian::measurement::{Dimming, Measurements};
use steradian::quantity::Time;
use steradian::scene::description::{Receivers, SceneDescription, SensorDescription, SensorKind};
use steradian::scene::{Scene, energy_balance};
use steradian::time::Interval;
use steradian::transport::{MeasureOptions, measure};
use steradian_io::report::StreamFormat;

use crate::engine::Engine;
use crate::load::{self, Loaded};
use crate::part::{self, Kind};
use crate::progress::Watch;
use crate::result::{Format, Readings, VERSION};
use crate::status::{Failure, Outcome, remark};
use crate::{points, tolerance, values};

/// Half-width of the 95 % interval relative to the value, where no other rule is given.
const DEFAULT_REL_ERROR: f64 = 0.01;

/// Read the sensors of a scene: irradiance, flux, radiance, with error bars
///
/// Each reading is printed with the half-width of its 95 % confidence interval, or as exact where a closed form was used.
/// The run stops when every interval is narrow enough: by default ± 1 % of the value, where readings below 1 % of their
/// sensor's mean need not be known any better than one at that level.
///
/// Points are measured in blocks of at most 16384, and JSON, CSV and Parquet are written block by block, so that millions of points need no
/// more memory than one block. Of a sensor that is cut, the mean above is that of each block; --time is shared out in proportion to points.
/// Ctrl-C keeps what is finished and says what is missing.
///
/// Lights may have a schedule, factors in the course of time. Readings are those of factor 1, or with --at those of a time; with
/// --duration each is also added up over an interval, exactly and without tracing light again.
///
/// The JSON of an earlier run may stand in place of the scene: it is read and printed again, in any format, at any time of the
/// schedules, with light groups dimmed or solved for, and nothing is traced.
///
/// With --balance fluxes are read instead: of each light in closed form, absorbed by each side of each shape, and of what escapes. Each is
/// sampled by itself, so that emitted = absorbed + escaped is a test of the scene's physics; the exit status is 1 where it fails.
/// --rel-error is then also relative to all that is emitted: what nearly nothing absorbs need not be known any better.
///
/// Lights given in watts give readings in W/m2, W, W/(m2 sr); lights given in lumens or candela give lx, lm, cd/m2.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Scene file (TOML), a file of another program (glTF, OBJ, PLY, STL), or a result of `measure` (.json)
    #[arg(value_name = "SCENE|RESULT")]
    scene: PathBuf,
    /// Read this sensor only; may be given several times
    #[arg(long, value_name = "NAME")]
    sensor: Vec<String>,
    /// Read irradiance at the points of a CSV file instead of the scene's sensors: columns x,y,z in metres with z up, as in results, and nx,ny,nz
    #[arg(long, value_name = "FILE", conflicts_with = "sensor")]
    points: Option<PathBuf>,
    /// Read the energy balance instead: what each light emits, each side of each shape absorbs, and what escapes
    #[arg(long, conflicts_with_all = ["sensor", "points"])]
    balance: bool,
    /// How to print [default: by the ending of the output's name, else table]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    lights: Lights,
    #[command(flatten)]
    when: When,
    #[command(flatten)]
    stop: Stop,
    #[command(flatten)]
    engine: Engine,
}

const EXAMPLES: &str = "\
Examples:
  steradian measure scenes/point-light.toml
  steradian measure scenes/closed-room.toml --rel-error 0.2% --format json -o room.json
  steradian measure scenes/lamps-equal.toml --time 10s --format csv
  steradian measure scenes/cornell-box.toml --balance                  emitted = absorbed + escaped, within errors
  steradian measure room.json --format csv                             the same readings again, from the file
  steradian measure room.json -o room.parquet                          for pandas, polars, DuckDB
  steradian measure room.json --relight 'lamp=50%,window=off'          with lights dimmed, errors included
  steradian measure room.json --solve 'desk: mean = 500 lx' --vary lamp       what dimming gives that
  steradian measure scenes/working-day.toml --start 7h --duration 12h
  steradian measure scenes/furnace.toml --samples 65536 --shard 1/3 -o part1";

/// What is asked about light groups; nothing is traced for it.
#[derive(Args, Debug)]
#[command(next_help_heading = "Light groups (dimmed or solved for without tracing again)")]
struct Lights {
    /// Multiply the light of groups: desk=50%,window=off,ceiling=1.2
    #[arg(long, value_name = "GROUP=FACTOR,…", value_parser = relight::levels, conflicts_with = "shard")]
    relight: Option<relight::Levels>,
    #[command(flatten)]
    question: solve::Question,
}

/// What schedules are asked.
#[derive(Args, Debug)]
#[command(next_help_heading = "Time (schedules of lights)")]
struct When {
    /// Add readings up over so much time as well: radiant exposure (J/m2, Wh/m2), energy (J, Wh), luminous exposure (lx h) …
    #[arg(long, value_name = "TIME")]
    duration: Option<Time>,
    /// When that begins
    #[arg(
        long,
        value_name = "TIME",
        requires = "duration",
        default_value = "0 h",
        allow_hyphen_values = true
    )]
    start: Time,
    /// Take the readings themselves at this time [default: with all lights at factor 1]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    at: Option<Time>,
}

impl When {
    /// How much light each group gives, where it is asked for; else as it was.
    fn dimming(&self, mut dimming: Dimming, groups: &[String]) -> Result<Dimming, Failure> {
        if let Some(time) = self.at {
            dimming = dimming.at(time, groups)?;
        }
        if let Some(duration) = self.duration {
            let interval = Interval::lasting(duration, self.start)?;
            dimming = dimming.over(interval, groups)?;
        }
        Ok(dimming)
    }
}

/// When to stop.
#[derive(Args, Debug)]
#[command(next_help_heading = "Stopping")]
struct Stop {
    /// Stop when each 95 % interval is within this part of the value [default: 1%]
    #[arg(long, value_name = "RATIO", value_parser = values::ratio)]
    rel_error: Option<f64>,
    /// Stop when each 95 % interval is within this quantity, in the readings' unit: 5lx, 0.1W/m2 …
    #[arg(long, value_name = "QUANTITY")]
    abs_error: Option<String>,
    /// Stop when the 95 % intervals of a sensor are within this part of the values in the root mean square: points that vary more get more
    /// samples; beyond 16 384 points each block of as many by itself
    #[arg(long, value_name = "RATIO", value_parser = values::ratio, conflicts_with_all = ["rel_error", "abs_error", "shard", "balance"])]
    rms_error: Option<f64>,
    /// Stop after this time: 30s, 5min …
    #[arg(long, value_name = "TIME", value_parser = values::duration)]
    time: Option<Duration>,
    /// Take this many samples a reading, whatever the error: up to four paths each, where a pilot finds that best
    #[arg(long, value_name = "NUMBER", value_parser = values::count, conflicts_with_all = ["rel_error", "abs_error", "rms_error", "time"])]
    samples: Option<u64>,
}

/// Measures or reads a result, and writes it, or the part of it that a shard is.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let (file, lights) = (arguments.output.as_deref(), &arguments.lights);
    let format = Format::of(arguments.format, file)?;
    lights.question.refuse(format)?;
    let readings = if result_file::is_one(&arguments.scene) {
        let mut readings = result_file::read(arguments)?;
        lights.dim(&mut readings.measurements)?;
        readings
    } else {
        let job = Job::new(arguments)?;
        if let Some(format) = arguments.streamed(format) {
            return stream::write(&job, format, file);
        }
        job.readings()?
    };
    if lights.question.is_asked() {
        return lights.question.answer(&readings, format, file);
    }
    match arguments.engine.shard {
        Some(_) => part::write(
            Kind::Readings,
            &readings.measurements,
            &readings.scene_hash,
            file,
        ),
        None => readings.write(format, file),
    }
}

impl Arguments {
    /// The format, where nothing needs all readings at once.
    fn streamed(&self, format: Format) -> Option<StreamFormat> {
        let all_at_once =
            self.balance || self.engine.shard.is_some() || self.lights.question.is_asked();
        format.streamed().filter(|_| !all_at_once)
    }
}

impl Lights {
    fn dim(&self, measurements: &mut Measurements) -> Result<(), Failure> {
        let mut levels = self.relight.iter();
        levels.try_for_each(|levels| relight::apply(levels, measurements))
    }
}

/// What is to be traced.
struct Job<'a> {
    scene: Loaded,
    options: MeasureOptions,
    dimming: Dimming,
    lights: &'a Lights,
}

impl<'a> Job<'a> {
    fn new(arguments: &'a Arguments) -> Result<Self, Failure> {
        let loaded = load::scene_with(&arguments.scene, |description| {
            if arguments.balance {
                description.sensors = energy_balance();
            }
            add_points(arguments, description)
        })?;
        let scene = &loaded.scene;
        let mut options = options(arguments, scene)?;
        if arguments.balance {
            balance::relative_to_emitted(scene, &mut options)?;
        }
        let schedules = Dimming::new(scene.schedules().to_vec());
        Ok(Self {
            dimming: arguments.when.dimming(schedules, scene.groups())?,
            scene: loaded,
            options,
            lights: &arguments.lights,
        })
    }

    /// Readings at the time and with the lights that were asked for.
    fn dim(&self, measurements: &mut Measurements) -> Result<(), Failure> {
        measurements.dimming = self.dimming.clone();
        self.lights.dim(measurements)
    }

    /// All readings.
    fn readings(self) -> Result<Readings, Failure> {
        let mut watch = Watch::new()?;
        let mut measurements = measure(&self.scene.scene, &self.options, &mut watch)?;
        if watch.finish() {
            remark("stopped by Ctrl-C: these are the readings so far");
        }
        self.dim(&mut measurements)?;
        Ok(Readings {
            measurements,
            scene_hash: self.scene.hash,
            version: VERSION.to_owned(),
        })
    }
}

fn options(arguments: &Arguments, scene: &Scene) -> Result<MeasureOptions, Failure> {
    let engine = &arguments.engine;
    let plan = Plan {
        seed: engine.seed,
        stop: stopping(arguments, scene)?,
        threads: engine.threads.count(),
        shard: engine.shard,
        ..Plan::default()
    };
    Ok(MeasureOptions {
        plan,
        max_depth: engine.max_depth,
        instruction_set: engine.instruction_set()?,
        sensors: chosen(arguments),
        ..MeasureOptions::default()
    })
}

/// Names of the sensors to read; none is all.
fn chosen(arguments: &Arguments) -> Option<Vec<String>> {
    if arguments.points.is_some() {
        return Some(vec![points::SENSOR.to_owned()]);
    }
    (!arguments.sensor.is_empty()).then(|| arguments.sensor.clone())
}

fn stopping(arguments: &Arguments, scene: &Scene) -> Result<Stopping, Failure> {
    let Stop {
        rel_error,
        abs_error,
        rms_error,
        time,
        samples,
    } = &arguments.stop;
    let tolerance = rel_error.is_some() || abs_error.is_some() || rms_error.is_some();
    let unstated = !tolerance && time.is_none() && samples.is_none();
    let absolute = |text: &String| tolerance::parse(text, scene, chosen(arguments).as_deref());
    Ok(Stopping {
        rel_error: rel_error.or(unstated.then_some(DEFAULT_REL_ERROR)),
        abs_error: abs_error.as_ref().map(absolute).transpose()?,
        rms_error: *rms_error,
        time: *time,
        samples: *samples,
    })
}

/// Adds a sensor for `--points`.
fn add_points(arguments: &Arguments, description: &mut SceneDescription) -> Result<(), Failure> {
    let Some(path) = &arguments.points else {
        return Ok(());
    };
    let kind = SensorKind::Irradiance(Receivers::Points(points::read(path)?));
    description
        .sensors
        .retain(|sensor| sensor.name != points::SENSOR);
    description.sensors.push(SensorDescription {
        name: points::SENSOR.to_owned(),
        response: None,
        bins: None,
        kind,
    });
    Ok(())
}
