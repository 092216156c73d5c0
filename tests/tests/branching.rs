//! Paths of meters that branch, as many as a pilot finds best.

use std::time::Duration;

use steradian::estimation::Stopping;
use steradian::measurement::{Measurements, Reading};
use steradian::scene::description::SceneDescription;
use steradian::transport::{Branching, MeasureOptions};
use steradian_tests::assert_same;
use steradian_tests::measuring::{measured, samples};
use steradian_tests::scenes::*;

const SAMPLES: u64 = 1 << 13;

/// A white room under a ceiling that shines: it is so even that what varies is where paths go after their first reflection.
fn white_room() -> SceneDescription {
    let lamp = rectangle(p(0.2, 0.2, 2.9), [v(0.0, 2.6, 0.0), v(2.6, 0.0, 0.0)]);
    let shapes = [
        room(p(3.0, 3.0, 3.0)).made_of("wall"),
        lamp.emitting(radiance(10.0)),
    ];
    let mut scene = scene([lambertian("wall", 0.8)], shapes, []);
    let place = |i: u8| {
        let (column, row) = (f64::from(i % 8), f64::from(i / 8));
        (p(0.4 + 0.3 * column, 0.4 + 0.6 * row, 0.0), UP)
    };
    let places: Vec<_> = (0..32).map(place).collect();
    scene.sensors = vec![sensor("floor", irradiance_at(places))];
    scene
}

fn errors(measured: &Measurements) -> Vec<f64> {
    let readings = measured.readings().into_iter();
    readings.map(|reading| reading.estimate.std_error).collect()
}

/// Two branches would divide the errors by up to 1.41, four by up to 2. With 64 replicates a ratio is known to 13 %, the mean of 32 to 2.3 %: 1.2 is eight of these away from 1.
#[test]
fn paths_branch_where_that_is_what_varies() {
    let scene = white_room();
    let [never, suited] = [Branching::Never, Branching::Suited].map(|branching| {
        let options = MeasureOptions {
            branching,
            ..samples(SAMPLES)
        };
        measured(&scene, &options)
    });
    for (never, suited) in never.readings().iter().zip(suited.readings()) {
        assert_same("floor", &never.estimate, &suited.estimate);
    }
    let ratios = errors(&never).into_iter().zip(errors(&suited));
    let gain = ratios.map(|(never, suited)| never / suited).sum::<f64>() / 32.0;
    assert!(gain > 1.2, "{gain}");
}

/// How many branches there are must not depend on how the run ends, or how long it is.
#[test]
fn a_timed_run_is_repeated_by_its_number_of_samples() {
    let scene = white_room();
    let mut options = samples(SAMPLES);
    options.plan.stop = Stopping::at_time(Duration::from_millis(20));
    let timed = measured(&scene, &options).readings();
    let taken = timed[0].samples;
    assert_eq!(timed, measured(&scene, &samples(taken)).readings());
}

#[test]
fn a_pilot_finds_the_same_in_blocks_and_on_threads() {
    let scene = white_room();
    let by = |points_of_a_block: usize, threads: usize| {
        let mut options = MeasureOptions {
            points_of_a_block,
            ..samples(SAMPLES)
        };
        options.plan.threads = threads;
        measured(&scene, &options).readings()
    };
    let whole: Vec<Reading> = by(1 << 14, 1);
    assert_eq!(whole, by(1 << 14, 3));
    let values = |readings: Vec<Reading>| -> Vec<_> {
        let readings = readings.into_iter();
        readings.map(|reading| reading.estimate).collect()
    };
    assert_eq!(values(whole), values(by(2, 2)));
}
