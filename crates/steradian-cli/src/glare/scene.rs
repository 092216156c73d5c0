//! The view of an observer in a scene: as a picture, and by its lights.

use std::path::Path;

use clap::Args;
use steradian::estimation::film::Filter;
use steradian::estimation::{Estimate, Plan, Stopping};
use steradian::geometry::{Direction, Point};
use steradian::glare::{Gaze, SeenLights};
use steradian::quantity::Angle;
use steradian::scene::Scene;
use steradian::scene::description::{
    CameraDescription, Receivers, Response, SensorDescription, SensorKind,
};
use steradian::sensor::{Fisheye, Projection};
use steradian::transport::{MeasureOptions, Picture, RenderOptions, measure, render};
use steradian_io::import::luminance_map::LuminanceMap;

use crate::engine::Threads;
use crate::progress::Watch;
use crate::status::{Failure, remark};
use crate::{load, values};

/// Samples of a pixel where none are stated.
const SAMPLES: u64 = 64;
/// Names of the sensors that are put into the scene, in their order.
const SENSORS: [&str; 2] = ["observer's view", "observer's eye"];

/// Of the illuminance at the eye.
const REL_ERROR: f64 = 0.01;
const NO_LUMINANCE: &str = "the scene has no luminance: its bands say nothing of what is seen";
/// What the observer sees, and a little of what is behind, so that no pixel that counts lies on the rim.
const PROJECTION: Projection = Projection::Fisheye {
    mapping: Fisheye::Equisolid,
    fov: Angle::from_degrees(190.0),
};

/// What an observer sees.
pub struct View {
    /// As a picture.
    pub map: LuminanceMap,
    /// By its lights.
    pub lights: Lights,
}

/// The lights that an observer sees.
pub struct Lights {
    /// At the eye, in lx.
    pub illuminance: Estimate,
    /// UGR.
    pub rating: Option<Estimate>,
    /// The lights.
    pub seen: SeenLights,
    gaze: Gaze,
}

impl Lights {
    /// How far to the left and up a direction is, in degrees.
    pub fn angles(&self, direction: Direction) -> [f64; 2] {
        let (ahead, up) = (self.gaze.forward(), self.gaze.up());
        let left = up.cross(ahead);
        let aside = libm::atan2(direction.dot(left), direction.dot(ahead));
        [aside, libm::asin(direction.dot(up).clamp(-1.0, 1.0))].map(f64::to_degrees)
    }
}

/// A scene with a camera and a meter at the eye.
struct Looking {
    scene: Scene,
    eye: Point,
    gaze: Gaze,
}

/// Who looks in a scene.
#[derive(Args, Debug)]
#[command(next_help_heading = "Observer in a scene")]
pub struct Observer {
    /// Where the eye of the observer is, with z up as in results
    #[arg(long, value_name = "X,Y,Z", value_parser = values::point, allow_hyphen_values = true, requires = "look")]
    observer: Option<Point>,
    /// Where the observer looks: a direction, with z up
    #[arg(long, value_name = "DX,DY,DZ", value_parser = values::direction, allow_hyphen_values = true, requires = "observer")]
    look: Option<Direction>,
    /// What is up for the observer
    #[arg(long, value_name = "DX,DY,DZ", value_parser = values::direction, allow_hyphen_values = true, default_value = "0,0,1", requires = "observer")]
    up: Direction,
    /// Rate the lights only, by unified glare rating, and make no picture: quick, but bright surfaces and windows are no sources
    #[arg(long, requires = "observer", conflicts_with_all = ["resolution", "samples", "view", "threshold", "task", "reach", "peak", "low_light"])]
    lights: bool,
    /// Width and height in pixels of the view, an equisolid fisheye of 190°, of which what is in front counts
    #[arg(long, value_name = "WxH", value_parser = values::resolution, default_value = "512x512", requires = "observer")]
    resolution: [u32; 2],
    /// Samples of a pixel [default: 64]
    #[arg(long, value_name = "NUMBER", value_parser = values::count, requires = "observer")]
    samples: Option<u64>,
    /// Seed of all random numbers: the same seed gives the same bits
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    threads: Threads,
}

impl Observer {
    /// Whether one is named.
    pub fn is_there(&self) -> bool {
        self.observer.is_some()
    }

    /// Whether only lights are rated.
    pub fn rates_lights_only(&self) -> bool {
        self.lights
    }

    /// What is seen.
    pub fn view(&self, path: &Path) -> Result<View, Failure> {
        let looking = self.looking(path)?;
        let mut watch = Watch::new()?;
        let picture = render(&looking.scene, 0, &self.options(), &mut watch)?;
        let lights = self.measured(looking, watch)?;
        tell(&picture);
        Ok(View {
            map: luminances(&picture)?,
            lights,
        })
    }

    /// The lights that are seen; no picture is made.
    pub fn lights(&self, path: &Path) -> Result<Lights, Failure> {
        self.measured(self.looking(path)?, Watch::new()?)
    }

    fn looking(&self, path: &Path) -> Result<Looking, Failure> {
        let (Some(eye), Some(look)) = (self.observer, self.look) else {
            return Err(Failure::message(
                "the glare in a scene is that for an observer: give --observer X,Y,Z and --look DX,DY,DZ",
            ));
        };
        let gaze = Gaze::new(look, self.up)
            .ok_or_else(|| Failure::message("--up is along --look: give another --up"))?;
        let kinds = [
            SensorKind::Camera(self.camera(eye, look)),
            SensorKind::Irradiance(Receivers::Points(vec![(eye, look.to_vector())])),
        ];
        let loaded = load::scene_with(path, |description| {
            let sensor = |(name, kind): (&str, SensorKind)| SensorDescription {
                name: name.to_owned(),
                response: Some(Response::Photopic),
                bins: None,
                kind,
            };
            description.sensors = SENSORS.into_iter().zip(kinds).map(sensor).collect();
            Ok(())
        })?;
        Ok(Looking {
            scene: loaded.scene,
            eye,
            gaze,
        })
    }

    /// The lights, and the illuminance at the eye.
    fn measured(&self, looking: Looking, mut watch: Watch) -> Result<Lights, Failure> {
        let Looking { scene, eye, gaze } = looking;
        let options = MeasureOptions {
            plan: Plan {
                seed: self.seed,
                stop: Stopping {
                    rel_error: Some(REL_ERROR),
                    ..Stopping::default()
                },
                threads: self.threads.count(),
                ..Plan::default()
            },
            sensors: Some(vec![SENSORS[1].to_owned()]),
            ..MeasureOptions::default()
        };
        let measured = measure(&scene, &options, &mut watch)?;
        if watch.finish() {
            remark("stopped by Ctrl-C: this is the view so far");
        }
        let readings = measured.readings();
        let reading = readings.iter().find(|reading| reading.unit == "lx");
        let readout = scene.sensors()[1]
            .readouts
            .iter()
            .find(|readout| readout.unit == "lx");
        let (Some(reading), Some(readout)) = (reading, readout) else {
            return Err(Failure::message(NO_LUMINANCE));
        };
        let seen = SeenLights::of(&scene, eye, gaze, readout, options.instruction_set);
        Ok(Lights {
            illuminance: reading.estimate,
            rating: seen.unified_glare_rating(&reading.estimate),
            seen,
            gaze,
        })
    }

    fn camera(&self, position: Point, look: Direction) -> CameraDescription {
        CameraDescription {
            position,
            look_at: position + look.to_vector(),
            up: self.up.to_vector(),
            projection: PROJECTION,
            resolution: self.resolution,
        }
    }

    fn options(&self) -> RenderOptions {
        let plan = Plan {
            seed: self.seed,
            stop: Stopping::at_samples(self.samples.unwrap_or(SAMPLES)),
            threads: self.threads.count(),
            ..RenderOptions::default().plan
        };
        RenderOptions {
            plan,
            filter: Filter::Box,
            ..RenderOptions::default()
        }
    }
}

/// What has to be known of a picture.
fn tell(picture: &Picture) {
    for warning in &picture.warnings {
        remark(&format!("warning: {warning}"));
    }
    for class in &picture.unsampled {
        remark(&format!("not sampled, so the view is too dark: {class}"));
    }
}

/// The luminance of every pixel; errors of lanes are added, for they are of the same paths.
fn luminances(picture: &Picture) -> Result<LuminanceMap, Failure> {
    let readout = picture.readouts.last();
    let weights = readout
        .filter(|readout| readout.unit == "cd/m2")
        .map(|readout| &readout.weights);
    let weights = weights.ok_or_else(|| Failure::message(NO_LUMINANCE))?;
    let sum = |lanes: &[f64]| {
        weights
            .iter()
            .zip(lanes)
            .map(|(weight, lane)| weight * lane)
            .sum::<f64>()
    };
    let exposure = &picture.exposure;
    Ok(LuminanceMap {
        size: exposure.size(),
        luminances: exposure
            .values()
            .iter()
            .map(|lanes| sum(&lanes[..]))
            .collect(),
        std_errors: Some(exposure.std_errors().map(|lanes| sum(&lanes[..])).collect()),
        projection: Some(PROJECTION),
    })
}
