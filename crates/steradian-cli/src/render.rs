//! `steradian render`: a picture by a camera of the scene.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};
use steradian::estimation::film::Filter;
use steradian::estimation::{Plan, Stopping};
use steradian::scene::Scene;
use steradian::sensor::{Kind as SensorKind, Sensor};
use steradian::transport::{RenderOptions, render};
use steradian_io::report::PictureFormat;

use crate::engine::Engine;
use crate::part::{self, Kind};
use crate::picture::{Finished, LookArguments};
use crate::progress::Watch;
use crate::status::{Failure, Outcome, remark};
use crate::{load, values};

/// Samples a pixel where no other rule is given.
const DEFAULT_SAMPLES: u64 = 64;

/// Make a picture: the radiance that a camera of the scene receives
///
/// EXR holds every lane in W/(m2 sr) as 32-bit floats, and the standard error of each pixel in the layer `std_error`. PFM
/// holds the same in two files. HDR has no room for errors. PNG is for looking: tone-mapped, or in false colours with a
/// legend.
///
/// Every pixel is estimated in independent passes of equal effort, whose spread gives its standard error.
///
/// What mirrors, smooth glass and polish throw from point lamps, spots and directional lights on other surfaces is traced from the light,
/// as many paths as pixels have samples. What they show of it to the camera is told as not sampled.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Scene file (TOML), or a file of another program (glTF, OBJ, PLY, STL)
    scene: PathBuf,
    /// Where the picture goes; .exr, .hdr, .png or .pfm tells the format
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The camera to use; needed where the scene has several
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// Width and height in pixels instead of the camera's
    #[arg(long, value_name = "WxH", value_parser = values::resolution)]
    resolution: Option<[u32; 2]>,
    /// How samples are spread over pixels
    #[arg(long, value_enum, default_value_t)]
    filter: FilterName,
    #[command(flatten)]
    look: LookArguments,
    #[command(flatten)]
    stop: Stop,
    #[command(flatten)]
    engine: Engine,
}

const EXAMPLES: &str = "\
Examples:
  steradian render scenes/cornell-box.toml -o cornell.png
  steradian render scenes/cornell-box.toml -o cornell.exr --rel-error 5%
  steradian render scenes/cornell-box.toml -o cornell.png --false-colour --resolution 512x512 --time 30s";

/// When to stop.
#[derive(Args, Debug)]
#[command(next_help_heading = "Stopping")]
struct Stop {
    /// Take this many samples a pixel, all passes together: camera rays, each with up to four paths from what it meets first (by wavelength:
    /// one) [default: 64]
    #[arg(long, value_name = "NUMBER", value_parser = values::count, conflicts_with_all = ["rel_error", "time"])]
    samples: Option<u64>,
    /// Stop each tile when the 95 % intervals of its pixels are on average within this part of the value
    #[arg(long, value_name = "RATIO", value_parser = values::ratio)]
    rel_error: Option<f64>,
    /// Stop after this time: 30s, 5min …
    #[arg(long, value_name = "TIME", value_parser = values::duration)]
    time: Option<Duration>,
    /// Independent passes, from whose spread the error comes
    #[arg(long, value_name = "NUMBER", default_value_t = 4, value_parser = clap::value_parser!(u32).range(2..))]
    passes: u32,
}

/// Filters by name.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum FilterName {
    /// A bell of half a pixel's standard deviation
    #[default]
    Gaussian,
    /// Each sample counts for its own pixel only
    Box,
    /// The four-term window of Blackman and Harris, over two pixels each way
    BlackmanHarris,
}

/// Renders and writes the picture, or the part of it that a shard is.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if arguments.engine.shard.is_none() {
        PictureFormat::of(&arguments.output)?;
    }
    let loaded = load::scene(&arguments.scene)?;
    let camera = camera(&loaded.scene, arguments.camera.as_deref())?;
    let options = options(arguments)?;
    let mut watch = Watch::new()?;
    let picture = render(&loaded.scene, camera, &options, &mut watch)?;
    if watch.finish() {
        remark("stopped by Ctrl-C: this is the picture so far");
    }
    let finished = Finished {
        picture,
        scene_hash: loaded.hash,
    };
    match arguments.engine.shard {
        Some(_) => part::write(
            Kind::Picture,
            &finished.picture,
            &finished.scene_hash,
            Some(&arguments.output),
        ),
        None => finished.write(arguments.look.look(), &arguments.output),
    }
}

fn options(arguments: &Arguments) -> Result<RenderOptions, Failure> {
    let engine = &arguments.engine;
    let Stop {
        samples,
        rel_error,
        time,
        passes,
    } = arguments.stop;
    let unstated = samples.is_none() && rel_error.is_none() && time.is_none();
    let samples = samples.or(unstated.then_some(DEFAULT_SAMPLES));
    let plan = Plan {
        seed: engine.seed,
        stop: Stopping {
            samples,
            rel_error,
            time,
            ..Stopping::default()
        },
        replicates: passes,
        threads: engine.threads.count(),
        shard: engine.shard,
        ..Plan::default()
    };
    Ok(RenderOptions {
        plan,
        filter: match arguments.filter {
            FilterName::Gaussian => Filter::Gaussian,
            FilterName::Box => Filter::Box,
            FilterName::BlackmanHarris => Filter::BlackmanHarris,
        },
        max_depth: engine.max_depth,
        instruction_set: engine.instruction_set()?,
        resolution: arguments.resolution,
        ..RenderOptions::default()
    })
}

/// Number of the camera among the sensors.
fn camera(scene: &Scene, name: Option<&str>) -> Result<usize, Failure> {
    let is_camera = |sensor: &Sensor| matches!(sensor.kind, SensorKind::Camera(_));
    let cameras = scene
        .sensors()
        .iter()
        .enumerate()
        .filter(|(_, sensor)| is_camera(sensor));
    let named: Vec<(usize, &str)> = cameras
        .map(|(number, sensor)| (number, sensor.name.as_str()))
        .collect();
    let names = named
        .iter()
        .map(|(_, name)| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ");
    match (name, named.as_slice()) {
        (_, []) => Err(Failure::message(
            "the scene has no camera: add a sensor of kind = \"camera\"",
        )),
        (None, [(only, _)]) => Ok(*only),
        (None, _) => Err(Failure::message(format!(
            "the scene has several cameras; choose one with --camera: {names}"
        ))),
        (Some(wanted), _) => {
            let found = named.iter().find(|(_, name)| *name == wanted);
            found.map(|(number, _)| *number).ok_or_else(|| {
                Failure::message(format!(
                    "there is no camera `{wanted}`; the scene has {names}"
                ))
            })
        }
    }
}
