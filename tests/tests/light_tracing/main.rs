//! What polished surfaces throw from lights without extent, in pictures and readings: against closed forms and against lamps that cameras find.
//!
//! An agreement within [`LARGEST_SCORE`](steradian_tests::LARGEST_SCORE) standard errors of 16 passes fails by chance with probability 1.2e-3;
//! seeds are fixed.

mod glass;
mod meters;
mod mirrors;
mod normals;
mod passing;
mod pictures;

use steradian::estimation::{Estimate, Plan, Silent, Stopping};
use steradian::quantity::Angle;
use steradian::scene::description::{
    CameraDescription, LightDescription, Projection, SceneDescription, SensorKind,
};
use steradian::transport::{Picture, RenderOptions, render};
use steradian_tests::assert_same;
use steradian_tests::measuring::validated;
use steradian_tests::scenes::*;

const PASSES: u32 = 16;

/// From a point towards another, 32 × 32 pixels: one tile.
fn camera(from: [f64; 3], to: [f64; 3], projection: Projection) -> SensorKind {
    let point = |[x, y, z]: [f64; 3]| p(x, y, z);
    SensorKind::Camera(CameraDescription {
        position: point(from),
        look_at: point(to),
        up: v(0.0, 1.0, 0.1),
        projection,
        resolution: [32, 32],
    })
}

fn pinhole(degrees: f64) -> Projection {
    Projection::Perspective {
        fov: Angle::from_degrees(degrees),
    }
}

fn options(samples: u64, max_depth: Option<u32>) -> RenderOptions {
    RenderOptions {
        plan: Plan {
            stop: Stopping::at_samples(samples),
            replicates: PASSES,
            seed: 11,
            ..Plan::default()
        },
        max_depth,
        ..RenderOptions::default()
    }
}

fn picture(scene: &SceneDescription, options: &RenderOptions) -> Picture {
    render(&validated(scene), 0, options, &mut Silent).unwrap_or_else(|error| panic!("{error}"))
}

/// Mean of the first channel over the picture.
fn mean(picture: &Picture) -> Estimate {
    assert_eq!(picture.exposure.tile_counts(), [1, 1]);
    picture.exposure.tile(0, 0, &[1.0, 0.0, 0.0, 0.0], 0.95)
}

const MIRROR: f64 = 0.8;

/// A lamp between a floor and an upright mirror at x = −1, and what a camera sees of the floor from above.
fn beside_a_mirror(lamp: LightDescription, eye: SensorKind) -> SceneDescription {
    let mirror_plane = rectangle(p(-1.0, -2.0, 0.0), [v(0.0, 4.0, 0.0), v(0.0, 0.0, 2.5)]);
    let mut scene = scene(
        [lambertian("paper", 0.5), mirror("mirror", MIRROR)],
        [
            square(30.0, 0.0).made_of("paper"),
            mirror_plane.made_of("mirror"),
        ],
        [lamp],
    );
    scene.sensors = vec![sensor("eye", eye)];
    scene
}

/// The same floor with the lamp's image as a lamp instead of the mirror.
fn with_image(mut scene: SceneDescription, image: LightDescription) -> SceneDescription {
    scene.shapes.truncate(1);
    scene.lights.push(image);
    scene
}

fn above_the_floor() -> SensorKind {
    camera([0.5, 0.0, 1.0], [0.5, 0.0, 0.0], pinhole(40.0))
}

/// Compares three segments with a mirror, and with the image of the lamp instead.
fn assert_image(what: &str, seen: SceneDescription, image: LightDescription) {
    let truth = with_image(seen.clone(), image);
    let [seen, truth] = [seen, truth].map(|scene| mean(&picture(&scene, &options(64, Some(3)))));
    assert_same(what, &seen, &truth);
    assert!(seen.std_error < 0.02 * seen.value, "{what}: {seen:?}");
}
