//! `steradian glare`: how much a view dazzles, from a picture of its luminances or for an observer in a scene.

mod report;
mod scene;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use steradian::geometry::{Direction, Point, Vector};
use steradian::glare::{Assessment, Detection, FieldOfView, Threshold, low_light_factor};
use steradian::quantity::{Angle, Illuminance, Luminance};
use steradian::sensor::{Camera, Fisheye, Projection};
use steradian_io::files::DiskFiles;
use steradian_io::import::luminance_map::{self, LuminanceMap};

use crate::output::{self, Format};
use crate::status::{Failure, Outcome};

/// Assess the glare of a view: daylight glare probability, unified glare rating, the sources and what each of them is
///
/// A picture is one of luminance: Radiance's HDR, EXR or PFM, whose view looks where the observer looks. Fisheyes of 180° show all that
/// an observer sees; less than that leaves out light at the eye. Pictures of Radiance state their view; others need --view. Of a scene, the view of
/// --observer is rendered first; beside it, the unified glare rating of the scene's lights is found from their luminances, how much of them is seen, and
/// the illuminance at the eye, measured within 1 %. With --lights that is all, in seconds; the picture takes longer, the more so the more pixels and samples
/// it has.
///
/// What is brighter than the threshold is a source of glare; what is brighter than the peak is a source of its own. Errors come from the picture's own
/// errors (EXR of `steradian render`, NAME.error.pfm beside NAME.pfm) and include nothing else.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Picture of luminance (.hdr, .pic, .exr or .pfm), or a scene
    #[arg(value_name = "PICTURE|SCENE")]
    input: PathBuf,
    /// How the picture maps directions, if it does not say so itself
    #[arg(long, value_enum)]
    view: Option<View>,
    /// Full angle of view: across the circle of a fisheye, across the width in perspective
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "180deg",
        requires = "view"
    )]
    angle: Angle,
    /// What is a source: brighter than a luminance, or than a multiple of the mean luminance such as 5x
    #[arg(long, value_name = "LUMINANCE|TIMES", default_value = "2000cd/m2", value_parser = threshold)]
    threshold: Threshold,
    /// The mean luminance that the multiple refers to is that of a task: X,Y of its middle in pixels from the top left, and the angle that it fills
    #[arg(long, value_name = "X,Y,ANGLE", value_parser = task)]
    task: Option<Task>,
    /// Bright places at most this far apart are one source
    #[arg(long, value_name = "ANGLE", default_value = "0.1rad")]
    reach: Angle,
    /// What is at least as bright is a source of its own; "none" keeps sources whole
    #[arg(long, value_name = "LUMINANCE", default_value = "50000cd/m2", value_parser = peak)]
    peak: Peak,
    /// Reduce the daylight glare probability below 1000 lx
    #[arg(long)]
    low_light: bool,
    #[command(flatten)]
    observer: scene::Observer,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian glare office.hdr
  steradian glare office.exr --view fisheye-equidistant
  steradian glare office.hdr --threshold 5x --task 400,520,30deg --format json
  steradian glare room.toml --observer 2,0.5,1.2 --look 0,1,0 --lights
  steradian glare room.toml --observer 2,0.5,1.2 --look 0,1,0 --resolution 800x800";

/// Projections by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum View {
    /// Radius in proportion to the angle (Radiance: -vta)
    FisheyeEquidistant,
    /// Equal areas are equal solid angles
    FisheyeEquisolid,
    /// Radius in proportion to the sine of the angle (Radiance: -vth)
    FisheyeHemispherical,
    /// As a pinhole camera (Radiance: -vtv)
    Perspective,
}

/// Where the observer works.
#[derive(Clone, Copy, Debug)]
struct Task {
    film: [f64; 2],
    angle: Angle,
}

/// The least luminance of sources of their own.
#[derive(Clone, Copy, Debug)]
struct Peak(Option<Luminance>);

fn threshold(text: &str) -> Result<Threshold, String> {
    match text.strip_suffix(['x', '×']) {
        Some(number) => match number.trim().parse::<f64>() {
            Ok(factor) if factor > 0.0 && factor.is_finite() => Ok(Threshold::TimesMean(factor)),
            _ => Err("expected a luminance such as 2000cd/m2, or a multiple such as 5x".into()),
        },
        None => text
            .parse()
            .map(Threshold::Luminance)
            .map_err(|error| format!("{error}")),
    }
}

fn peak(text: &str) -> Result<Peak, String> {
    match text {
        "none" => Ok(Peak(None)),
        text => text
            .parse()
            .map(|peak| Peak(Some(peak)))
            .map_err(|error| format!("{error}")),
    }
}

fn task(text: &str) -> Result<Task, String> {
    let parts: Vec<&str> = text.splitn(3, ',').map(str::trim).collect();
    let expected = "expected a pixel and an angle such as 400,520,30deg";
    let [x, y, angle] = parts[..] else {
        return Err(expected.into());
    };
    let pixel = |text: &str| text.parse::<f64>().map_err(|_| expected.to_owned());
    Ok(Task {
        film: [pixel(x)?, pixel(y)?],
        angle: angle.parse().map_err(|error| format!("{error}"))?,
    })
}

/// A picture with what was found in it.
struct Found {
    camera: Camera,
    assessment: Assessment,
    has_errors: bool,
    /// What the probability is multiplied with.
    low_light: Option<f64>,
    /// The lights of a scene.
    lights: Option<scene::Lights>,
}

/// Prints the figures.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if arguments.observer.rates_lights_only() {
        return rate_lights(arguments);
    }
    let (map, lights) = seen(arguments)?;
    let camera = camera(&map, arguments)?;
    let errors = map.std_errors.as_deref();
    let view = FieldOfView::new(&camera, &map.luminances, errors).map_err(failed)?;
    let assessment = view.assess(&detection(arguments, &camera)?);
    let eye = Illuminance::from_lux(assessment.illuminance.value);
    let found = Found {
        camera,
        assessment,
        has_errors: errors.is_some(),
        low_light: arguments.low_light.then(|| low_light_factor(eye)),
        lights,
    };
    output::print(&match arguments.format {
        Format::Table => report::table(&arguments.input, &found),
        Format::Json => format!("{:#}\n", report::json(&arguments.input, &found)),
    })?;
    let converged = |lights: &scene::Lights| lights.illuminance.converged;
    Ok(Outcome::fine_if(
        found.lights.as_ref().is_none_or(converged),
    ))
}

/// Prints the rating of a scene's lights.
fn rate_lights(arguments: &Arguments) -> Result<Outcome, Failure> {
    refuse_picture(&arguments.input)?;
    let lights = arguments.observer.lights(&arguments.input)?;
    output::print(&match arguments.format {
        Format::Table => report::lights_table(&lights),
        Format::Json => format!("{:#}\n", report::lights_json(&arguments.input, &lights)),
    })?;
    Ok(Outcome::fine_if(lights.illuminance.converged))
}

fn refuse_picture(path: &Path) -> Result<(), Failure> {
    match luminance_map::is_luminance_map(path) {
        true => Err(Failure::message(
            "--observer looks at a scene, not at a picture",
        )),
        false => Ok(()),
    }
}

/// The picture, and the lights of a scene.
fn seen(arguments: &Arguments) -> Result<(LuminanceMap, Option<scene::Lights>), Failure> {
    let path = &arguments.input;
    if !luminance_map::is_luminance_map(path) {
        let view = arguments.observer.view(path)?;
        return Ok((view.map, Some(view.lights)));
    }
    if arguments.observer.is_there() {
        refuse_picture(path)?;
    }
    let map = luminance_map::read(path, &DiskFiles::default()).map_err(failed)?;
    Ok((map, None))
}

fn failed(error: impl ToString) -> Failure {
    Failure::message(error.to_string())
}

/// Looking along x, with y to the left and z up.
fn camera(map: &LuminanceMap, arguments: &Arguments) -> Result<Camera, Failure> {
    let stated = arguments
        .view
        .map(|view| projection(view, arguments.angle))
        .transpose()?;
    let projection = stated.or(map.projection).ok_or_else(|| {
        Failure::message("the picture does not say how it maps directions: give --view, and --angle if it is not 180deg")
    })?;
    let ahead = Point::new(1.0, 0.0, 0.0);
    let up = Vector::new(0.0, 0.0, 1.0);
    Camera::new(Point::ORIGIN, ahead, up, projection, map.size)
        .ok_or_else(|| Failure::message("the view has no direction"))
}

fn projection(view: View, fov: Angle) -> Result<Projection, Failure> {
    let mapping = match view {
        View::FisheyeEquidistant => Fisheye::Equidistant,
        View::FisheyeEquisolid => Fisheye::Equisolid,
        View::FisheyeHemispherical => Fisheye::Hemispherical,
        View::Perspective if fov.to_degrees() > 0.0 && fov.to_degrees() < 180.0 => {
            return Ok(Projection::Perspective { fov });
        }
        View::Perspective => {
            return Err(Failure::message(
                "--angle of a perspective view is between 0 and 180deg",
            ));
        }
    };
    let most = match mapping {
        Fisheye::Hemispherical => 180.0,
        _ => 360.0,
    };
    match fov.to_degrees() > 0.0 && fov.to_degrees() <= most {
        true => Ok(Projection::Fisheye { mapping, fov }),
        false => Err(Failure::message(format!(
            "--angle of this view is above 0 and at most {most}deg"
        ))),
    }
}

fn detection(arguments: &Arguments, camera: &Camera) -> Result<Detection, Failure> {
    let threshold = match (arguments.threshold, arguments.task) {
        (Threshold::TimesMean(factor), Some(task)) => Threshold::TimesTask {
            factor,
            towards: looking(camera, task.film)?,
            angle: task.angle,
        },
        (_, Some(_)) => {
            return Err(Failure::message(
                "--task goes with a multiple such as --threshold 5x",
            ));
        }
        (threshold, None) => threshold,
    };
    Ok(Detection {
        threshold,
        reach: arguments.reach,
        peak: arguments.peak.0,
    })
}

fn looking(camera: &Camera, film: [f64; 2]) -> Result<Direction, Failure> {
    let ray = camera.ray(film, [0.0; 2]);
    ray.map(|(_, direction)| direction)
        .ok_or_else(|| Failure::message("--task lies outside of the picture's circle"))
}
