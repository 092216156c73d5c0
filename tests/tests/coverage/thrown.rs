//! Points close to a wall that a mirror lights: how often 95 % intervals hold what image lamps give.

use steradian::estimation::{Plan, Stopping};
use steradian::measurement::Reading;
use steradian::scene::description::SceneDescription;
use steradian::transport::MeasureOptions;
use steradian_tests::binomial::usual_hits;
use steradian_tests::measuring::measured;
use steradian_tests::scenes::*;

const HEIGHT: f64 = 1.2;
const DISTANCES: [f64; 3] = [0.01, 0.03, 0.1];

/// A wall above a polished floor, with points on it at some distances from the wall.
fn wall_above_polish() -> SceneDescription {
    let wall = rectangle(p(0.0, -1.0, 0.0), [v(0.0, 2.0, 0.0), v(0.0, 0.0, 2.0)]).made_of("wall");
    let floor =
        rectangle(p(0.0, -1.0, 0.0), [v(2.0, 0.0, 0.0), v(0.0, 2.0, 0.0)]).made_of("polished");
    let mut scene = scene(
        [lambertian("wall", 0.5), mirror("polished", 0.8)],
        [wall, floor],
        [point_light(p(1.0, 0.3, HEIGHT), intensity(5.0))],
    );
    let points = DISTANCES.map(|distance| (p(distance, 0.0, 0.0), UP));
    scene.sensors = vec![sensor("points", irradiance_at(points))];
    scene
}

/// The same with an image of the lamp in place of the floor, where all of the floor that lights the wall is polished.
fn with_an_image() -> SceneDescription {
    let mut scene = wall_above_polish();
    scene.shapes.truncate(1);
    let image = point_light(p(1.0, 0.3, -HEIGHT), intensity(4.0));
    scene.lights.push(image);
    scene
}

fn run(scene: &SceneDescription, samples: u64, seed: u64) -> Vec<Reading> {
    let plan = Plan {
        stop: Stopping::at_samples(samples),
        seed,
        ..Plan::default()
    };
    let options = MeasureOptions {
        plan,
        max_depth: Some(3),
        ..MeasureOptions::default()
    };
    measured(scene, &options).readings()
}

/// Of 100 intervals of each point, which hold with probability .95, as many as is usual but for one case in 10⁵. The truth is known ten times better than what they say, which takes .1 % of them.
#[test]
fn intervals_close_to_a_wall_that_a_mirror_lights_hold() {
    let (thrown, imagined) = (wall_above_polish(), with_an_image());
    let truth = run(&imagined, 1 << 20, u64::MAX);
    let mut held = [0; DISTANCES.len()];
    for seed in 0..100 {
        let readings = run(&thrown, 1 << 12, seed);
        for ((held, reading), truth) in held.iter_mut().zip(&readings).zip(&truth) {
            let [low, high] = reading.estimate.interval.unwrap();
            *held += u32::from((low..=high).contains(&truth.estimate.value));
            assert!(truth.estimate.std_error < 0.1 * reading.estimate.std_error);
        }
    }
    let usual = usual_hits(100, 0.95, 1e-5);
    assert!(held.iter().all(|held| usual.contains(held)), "{held:?}");
}
