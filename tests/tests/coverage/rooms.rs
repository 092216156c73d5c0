//! Readings of a room with branching paths and dark places: how often 95 % intervals hold what a long run finds.
//!
//! The truth is off by about a tenth of a standard error of the intervals, as is asserted, which takes .1 % of them.

use steradian::estimation::{Plan, Stopping};
use steradian::geometry::{Point, Vector};
use steradian::measurement::Reading;
use steradian::scene::description::SceneDescription;
use steradian::transport::MeasureOptions;
use steradian_tests::binomial::usual_hits;
use steradian_tests::measuring::measured;
use steradian_tests::scenes::*;

const FALSE_ALARM: f64 = 1e-5;

/// A closed room with a lamp below the ceiling, and a block whose shadow reaches to the nearer wall.
fn room_with_a_block(points: Vec<Point>) -> SceneDescription {
    let lamp = rectangle(p(1.2, 1.2, 2.95), [v(0.0, 0.6, 0.0), v(0.6, 0.0, 0.0)]);
    let [floor, ceiling, left, right, front, back] = room_faces(Point::ORIGIN, p(3.0, 3.0, 3.0));
    let block = solid(p(0.6, 0.3, 0.0), p(1.4, 2.7, 1.5));
    let white = [floor, ceiling, front, back, block].map(|shape| shape.made_of("white"));
    let dark = [left, right].map(|shape| shape.made_of("dark"));
    let mut shapes = [white.to_vec(), dark.to_vec()].concat();
    shapes.push(lamp.emitting(radiance(10.0)));
    let materials = [lambertian("white", 0.7), lambertian("dark", 0.2)];
    let mut scene = scene(materials, shapes, []);
    let facing_up: Vec<(Point, Vector)> = points.into_iter().map(|point| (point, UP)).collect();
    scene.sensors = vec![sensor("floor", irradiance_at(facing_up))];
    scene
}

fn run(scene: &SceneDescription, stop: Stopping, seed: u64) -> Vec<Reading> {
    let plan = Plan {
        stop,
        seed,
        ..Plan::default()
    };
    let options = MeasureOptions {
        plan,
        ..MeasureOptions::default()
    };
    measured(scene, &options).readings()
}

/// How many intervals of so many seeds hold a truth of so many samples, by point.
fn held(scene: &SceneDescription, stop: Stopping, seeds: u64, samples: u64) -> Vec<u32> {
    let truth = run(scene, Stopping::at_samples(samples), u64::MAX);
    let mut held = vec![0; truth.len()];
    let mut part = vec![0.0; truth.len()];
    for seed in 0..seeds {
        for (i, (reading, truth)) in run(scene, stop, seed).iter().zip(&truth).enumerate() {
            let [low, high] = reading.estimate.interval.expect("an interval");
            held[i] += u32::from((low..=high).contains(&truth.estimate.value));
            part[i] += truth.estimate.std_error / reading.estimate.std_error / seeds as f64;
        }
    }
    assert!(part.iter().all(|part| *part < 0.15), "{part:?}");
    held
}

/// In the corner and along the foot of the block.
#[test]
fn intervals_in_a_corner_hold_within_a_tolerance() {
    let points = vec![
        p(0.01, 0.01, 0.0),
        p(0.03, 2.97, 0.0),
        p(0.59, 1.5, 0.0),
        p(0.3, 1.5, 0.0),
    ];
    let scene = room_with_a_block(points);
    let seeds = 100;
    let held: u32 = held(&scene, Stopping::at_rel_error(0.05), seeds.into(), 1 << 18)
        .iter()
        .sum();
    let usual = usual_hits(4 * seeds, 0.95, FALSE_ALARM);
    assert!(usual.contains(&held), "{held} of {usual:?}");
}

#[test]
fn intervals_in_the_shadow_and_in_the_light_hold_within_a_root_mean_square() {
    let shadow = (0..10).map(|i| p(0.02 + 0.06 * f64::from(i), 0.5 + 0.2 * f64::from(i), 0.0));
    let light = (0..20).map(|i| p(1.6 + 0.12 * f64::from(i % 10), 0.5 + f64::from(i / 10), 0.0));
    let scene = room_with_a_block(shadow.chain(light).collect());
    let seeds = 60;
    let held = held(&scene, Stopping::at_rms_error(0.05), seeds.into(), 1 << 18);
    for held in [&held[..10], &held[10..]] {
        let usual = usual_hits(seeds * held.len() as u32, 0.95, FALSE_ALARM);
        let held = held.iter().sum();
        assert!(usual.contains(&held), "{held} of {usual:?}");
    }
}
