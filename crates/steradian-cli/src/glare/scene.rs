//! The view of an observer in a scene, as a picture.

use std::path::Path;

use clap::Args;
use steradian::estimation::film::Filter;
use steradian::estimation::{Plan, Stopping};
use steradian::geometry::{Direction, Point};
use steradian::quantity::Angle;
use steradian::scene::description::{CameraDescription, Response, SensorDescription, SensorKind};
use steradian::sensor::{Fisheye, Projection};
use steradian::transport::{Picture, RenderOptions, render};
use steradian_io::import::luminance_map::LuminanceMap;

use crate::engine::Threads;
use crate::progress::Watch;
use crate::status::{Failure, remark};
use crate::{load, values};

/// Samples of a pixel where none are stated.
const SAMPLES: u64 = 64;
/// Name of the camera that is put into the scene.
const OBSERVER: &str = "observer of glare";

/// Who looks in a scene.
#[derive(Args, Debug)]
#[command(next_help_heading = "Observer in a scene")]
pub struct Observer {
    /// Where the eye of the observer is
    #[arg(long, value_name = "X,Y,Z", value_parser = values::point, allow_hyphen_values = true, requires = "look")]
    observer: Option<Point>,
    /// Where the observer looks
    #[arg(long, value_name = "DX,DY,DZ", value_parser = values::direction, allow_hyphen_values = true, requires = "observer")]
    look: Option<Direction>,
    /// What is up for the observer
    #[arg(long, value_name = "DX,DY,DZ", value_parser = values::direction, allow_hyphen_values = true, default_value = "0,0,1", requires = "observer")]
    up: Direction,
    /// Width and height in pixels of the view, an equisolid fisheye of 180°
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

    /// What is seen, and what has to be said about it.
    pub fn picture(&self, path: &Path) -> Result<LuminanceMap, Failure> {
        let (Some(position), Some(look)) = (self.observer, self.look) else {
            return Err(Failure::message(
                "the glare in a scene is that for an observer: give --observer X,Y,Z and --look DX,DY,DZ",
            ));
        };
        let camera = self.camera(position, look);
        let projection = camera.projection;
        let loaded = load::scene_with(path, |description| {
            description.sensors = vec![SensorDescription {
                name: OBSERVER.into(),
                response: Some(Response::Photopic),
                bins: None,
                kind: SensorKind::Camera(camera),
            }];
            Ok(())
        })?;
        let mut watch = Watch::new()?;
        let picture = render(&loaded.scene, 0, &self.options(), &mut watch)?;
        if watch.finish() {
            remark("stopped by Ctrl-C: this is the view so far");
        }
        for warning in &picture.warnings {
            remark(&format!("warning: {warning}"));
        }
        for class in &picture.unsampled {
            remark(&format!("not sampled, so the view is too dark: {class}"));
        }
        luminances(&picture, projection)
    }

    fn camera(&self, position: Point, look: Direction) -> CameraDescription {
        CameraDescription {
            position,
            look_at: position + look.to_vector(),
            up: self.up.to_vector(),
            projection: Projection::Fisheye {
                mapping: Fisheye::Equisolid,
                fov: Angle::from_degrees(180.0),
            },
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

/// The luminance of every pixel; errors of lanes are added, for they are of the same paths.
fn luminances(picture: &Picture, projection: Projection) -> Result<LuminanceMap, Failure> {
    let readout = picture.readouts.last();
    let weights = readout
        .filter(|readout| readout.unit == "cd/m2")
        .map(|readout| &readout.weights);
    let weights = weights.ok_or_else(|| {
        Failure::message("the scene has no luminance: its bands say nothing of what is seen")
    })?;
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
        projection: Some(projection),
    })
}
