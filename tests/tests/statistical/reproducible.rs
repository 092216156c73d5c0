//! The same bits for any number of threads, any instruction set and any number of shards.

use steradian::estimation::{Plan, Replicates, Stopping, merge_shards};
use steradian::measurement::Measurements;
use steradian::scene::description::{LaneValues, SceneDescription};
use steradian::transport::MeasureOptions;
use steradian_kernel::InstructionSet;
use steradian_tests::measuring::measured;
use steradian_tests::scenes::*;

/// A room with everything in it: point, panel, ball, mirror, sky through an opening, two groups, all kinds of meters.
fn everything() -> SceneDescription {
    let mut lamp = point_light(p(0.5, 0.5, 2.0), intensity(20.0));
    lamp.group = Some("lamp".into());
    let shapes = [
        square(6.0, 0.0).named("floor").made_of("paper"),
        solid(p(-1.0, -1.0, 0.0), p(-0.5, -0.5, 0.7)).made_of("paper"),
        ball(p(1.0, -0.5, 0.4), 0.4).made_of("mirror"),
        square_facing_down(0.6, 2.5).emitting(radiance(30.0)),
        ball(p(-1.5, 1.0, 1.0), 0.2).emitting(radiance(80.0)),
    ];
    let materials = [lambertian("paper", 0.7), mirror("mirror", 0.9)];
    let mut scene = scene(materials, shapes, [lamp, environment(0.2)]);
    let places = [
        (p(0.2, 0.3, 0.0), UP),
        (p(0.0, 1.0, 1.0), v(1.0, -1.0, 0.2)),
    ];
    scene.sensors = vec![
        sensor("E", irradiance_at(places)),
        sensor("L", radiance_along(p(0.2, -2.0, 1.5), v(0.0, 1.0, -0.6))),
        sensor("E0", scalar_irradiance_at(p(0.3, 0.3, 1.1))),
        sensor(
            "F",
            flux_of("floor", steradian::scene::description::FluxOf::Net),
        ),
    ];
    scene
}

/// The same room with metal, glass, a pane and light that is absorbed on its way.
fn shiny() -> SceneDescription {
    let mut scene = everything();
    let mut ice = modelled("ice", dielectric(1.31, Some(rough(0.2, false))));
    ice.media.inside = Some(LaneValues::Uniform(0.7));
    scene.materials.extend([
        modelled("glass", dielectric(1.5, None)),
        modelled("metal", metal(Some(rough(0.3, false)))),
        ice,
        modelled("pane", pane(0.9)),
    ]);
    let edges = [v(2.0, 0.0, 0.0), v(0.0, 0.0, 2.0)];
    scene.shapes.extend([
        ball(p(0.2, 1.2, 0.4), 0.4).made_of("glass"),
        ball(p(1.2, 1.0, 0.3), 0.3).named("metal").made_of("metal"),
        solid(p(-0.4, -1.6, 0.0), p(0.2, -1.2, 0.5)).made_of("ice"),
        rectangle(p(-1.0, -1.9, 0.0), edges).made_of("pane"),
    ]);
    let absorbed = steradian::scene::description::FluxOf::Absorbed;
    scene
        .sensors
        .push(sensor("metal", flux_of("metal", absorbed)));
    scene
}

fn options(stop: Stopping) -> MeasureOptions {
    MeasureOptions {
        plan: Plan {
            stop,
            seed: 42,
            threads: 1,
            ..Plan::default()
        },
        ..MeasureOptions::default()
    }
}

fn stops() -> [Stopping; 2] {
    [Stopping::at_samples(10_000), Stopping::at_rel_error(0.03)]
}

#[test]
fn threads_change_no_bit() {
    for stop in stops() {
        let alone = measured(&everything(), &options(stop));
        for threads in [2, 7] {
            let mut many = options(stop);
            many.plan.threads = threads;
            assert_eq!(alone, measured(&everything(), &many), "{threads} threads");
        }
    }
}

#[test]
fn instruction_sets_change_no_bit() {
    let best = measured(&everything(), &options(stops()[0]));
    for instruction_set in InstructionSet::available() {
        let other = MeasureOptions {
            instruction_set,
            ..options(stops()[0])
        };
        assert_eq!(best, measured(&everything(), &other), "{instruction_set:?}");
    }
}

#[test]
fn shiny_surfaces_change_no_bit() {
    let stop = Stopping::at_samples(2_000);
    let alone = measured(&shiny(), &options(stop));
    let mut many = options(stop);
    many.plan.threads = 5;
    assert_eq!(alone, measured(&shiny(), &many), "5 threads");
    for instruction_set in InstructionSet::available() {
        let other = MeasureOptions {
            instruction_set,
            ..options(stop)
        };
        assert_eq!(alone, measured(&shiny(), &other), "{instruction_set:?}");
    }
}

/// The same with a row of seven points, which blocks of three cut.
fn with_a_row() -> SceneDescription {
    let mut scene = everything();
    let place = |i: u8| (p(f64::from(i) * 0.3 - 0.9, 0.3, 0.0), UP);
    let row: Vec<_> = (0..7).map(place).collect();
    scene.sensors.push(sensor("row", irradiance_at(row)));
    scene
}

/// A row of points below a hundred panels and two screens.
fn many_panels() -> SceneDescription {
    let edges = [v(0.0, 0.2, 0.0), v(0.2, 0.0, 0.0)];
    let panel = |k: usize| {
        let [x, y] = [k % 10, k / 10].map(|number| 0.4 * number as f64 - 2.0);
        rectangle(p(x, y, 2.5), edges).emitting(radiance(30.0))
    };
    let mut scene = with_a_row();
    scene.shapes.extend((0..100).map(panel));
    let screen = [v(0.6, 0.0, 0.1), v(0.0, 1.0, 0.0)];
    let screens = [p(-0.9, 0.0, 0.6), p(0.4, -0.2, 1.0)];
    scene.shapes.extend(screens.map(|at| rectangle(at, screen)));
    scene
}

#[test]
fn many_lamps_change_no_bit() {
    let by = |points_of_a_block, threads, instruction_set| {
        let mut options = MeasureOptions {
            points_of_a_block,
            instruction_set,
            ..options(stops()[0])
        };
        options.plan.threads = threads;
        measured(&many_panels(), &options)
    };
    let whole = by(100, 1, InstructionSet::detect());
    assert_eq!(whole, by(3, 4, InstructionSet::detect()));
    for set in InstructionSet::available() {
        assert_eq!(whole, by(100, 2, set), "{set:?}");
    }
}

fn in_blocks(points_of_a_block: usize, stop: Stopping) -> Measurements {
    let options = MeasureOptions {
        points_of_a_block,
        ..options(stop)
    };
    measured(&with_a_row(), &options)
}

/// Without a tolerance nothing depends on it how sensors are cut.
#[test]
fn blocks_change_no_bit() {
    let stop = Stopping::at_samples(1_000);
    let whole = in_blocks(100, stop);
    for points in [1, 3] {
        assert_eq!(whole, in_blocks(points, stop), "{points} points");
    }
}

/// A sensor that is not cut reaches its tolerance as if there were no blocks; one that is cut reaches its own, whatever the threads.
#[test]
fn a_tolerance_is_that_of_the_sensor_in_its_block() {
    let stop = Stopping::at_rel_error(0.03);
    let (mut whole, mut cut) = (in_blocks(100, stop), in_blocks(3, stop));
    assert!(whole.converged() && cut.converged());
    let mut many = options(stop);
    (many.plan.threads, many.points_of_a_block) = (3, 3);
    assert_eq!(cut, measured(&with_a_row(), &many));
    let row = [whole.sensors.pop(), cut.sensors.pop()].map(Option::unwrap);
    assert_eq!(row[0].points.len(), row[1].points.len());
    assert_eq!(whole, cut);
}

fn replicates(measurements: &Measurements) -> Vec<Replicates> {
    let points = measurements
        .sensors
        .iter()
        .flat_map(|sensor| &sensor.points);
    points
        .filter_map(|point| point.replicates.clone())
        .collect()
}

#[test]
fn three_shards_are_the_whole() {
    for stop in stops() {
        let whole = measured(&everything(), &options(stop));
        let shard = |part: u32| {
            let mut options = options(stop);
            options.plan.shard = Some((part, 3));
            measured(&everything(), &options)
        };
        let parts: Vec<_> = (1..=3).map(shard).collect();
        let merged = merge_shards(parts.iter().map(replicates).collect()).unwrap();
        assert_eq!(merged, replicates(&whole), "{stop:?}");
        assert_eq!(Measurements::merge(parts).unwrap(), whole, "{stop:?}");
    }
}

#[test]
fn another_seed_is_another_run() {
    let mut other = options(stops()[0]);
    other.plan.seed += 1;
    let (a, b) = (
        measured(&everything(), &options(stops()[0])),
        measured(&everything(), &other),
    );
    assert!(replicates(&a) != replicates(&b));
}
