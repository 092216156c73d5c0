//! Of many lamps of extent a point adds those in full view, leaves out what is hidden, and samples the rest: the same light as lamp by lamp.

use std::f64::consts::PI;
use std::ops::Range;

use steradian::estimation::Estimate;
use steradian::geometry::{Direction, Point, Vector, configuration_factor};
use steradian::scene::description::{
    MaterialDescription, Opacity, SceneDescription, SensorKind, ShapeDescription,
};
use steradian_tests::measuring::{measured, samples};
use steradian_tests::scenes::*;
use steradian_tests::{Certainty, LARGEST_SCORE, ROUNDING_ERROR, assert_agrees, certainty};

/// Rows of lamps, and lamps of a row.
const ROWS: usize = 10;
const PANELS: usize = ROWS * ROWS;
const HEIGHT: f64 = 3.0;
const SIDE: f64 = 0.3;
const RADIANCE: f64 = 5.0;

/// The least corner of a lamp.
fn place(k: usize) -> [f64; 2] {
    [k % ROWS, k / ROWS].map(|number| number as f64 - 0.5 * ROWS as f64 + 0.35)
}

/// Of three brightnesses.
fn brightness(k: usize) -> f64 {
    RADIANCE * (1.0 + (k % 3) as f64)
}

/// Panels that shine down, and some discs and balls beyond their number.
fn lamp(k: usize) -> ShapeDescription {
    let beyond = p(0.7 * (k as f64 - PANELS as f64) - 3.0, 0.5, 2.0);
    match k {
        _ if k < PANELS => {
            let [x, y] = place(k);
            rectangle(p(x, y, HEIGHT), [v(0.0, SIDE, 0.0), v(SIDE, 0.0, 0.0)])
        }
        _ if k.is_multiple_of(2) => disc(beyond, DOWN, 0.2),
        _ => ball(beyond, 0.1),
    }
}

/// So many lamps, of which some are lit.
fn lamps(count: usize, lit: Range<usize>) -> Vec<ShapeDescription> {
    let lamp = |k: usize| match lit.contains(&k) {
        true => lamp(k).emitting(radiance(brightness(k))),
        false => lamp(k),
    };
    (0..count).map(lamp).collect()
}

/// What a panel in full view brings to a point that faces up.
fn expected(k: usize, at: Point) -> f64 {
    let ([x, y], z) = (place(k), HEIGHT);
    let corners = [
        p(x, y, z),
        p(x, y + SIDE, z),
        p(x + SIDE, y + SIDE, z),
        p(x + SIDE, y, z),
    ];
    let up = Direction::new(UP).expect("up is a direction");
    let factor = configuration_factor::of_polygon(at, up, &corners);
    PI * brightness(k) * factor
}

/// What all of them bring.
fn sum(at: Point) -> f64 {
    (0..PANELS).map(|k| expected(k, at)).sum()
}

/// A row of points below a screen that leans, and far beside it, where it hides all lamps, some, parts of some, and none.
fn places() -> Vec<(Point, Vector)> {
    let point = |k: usize| p(0.25 * k as f64 - 2.13, 0.11, 0.0);
    (0..24).map(|k| (point(k), UP)).collect()
}

fn screen() -> ShapeDescription {
    let edges = [v(1.5, 0.0, 0.5), v(0.0, 3.0, 0.1)];
    rectangle(p(-1.0, -1.4, 0.3), edges)
}

fn estimates(mut scene: SceneDescription, kind: SensorKind, name: &str, n: u64) -> Vec<Estimate> {
    scene.sensors = vec![sensor(name, kind)];
    let readings = measured(&scene, &samples(n)).readings();
    readings
        .into_iter()
        .map(|reading| reading.estimate)
        .collect()
}

/// All together against ten at a time, each of which is sampled; `around` is told whether the last are lit.
fn assert_all_is_the_sum_of_each_ten(
    count: usize,
    around: impl Fn(Vec<ShapeDescription>, bool) -> SceneDescription,
    kind: impl Fn() -> SensorKind,
) -> Vec<Estimate> {
    let lit_by = |lit: Range<usize>| {
        let (name, has_last) = (format!("lamps {lit:?}"), lit.end == count);
        let scene = around(lamps(count, lit), has_last);
        estimates(scene, kind(), &name, 1 << 10)
    };
    let together = lit_by(0..count);
    let tens = (0..count)
        .step_by(10)
        .map(|first| lit_by(first..first + 10));
    let tens: Vec<_> = tens.collect();
    for (number, one) in together.iter().enumerate() {
        let parts = || tens.iter().map(|ten| &ten[number]);
        let sum: f64 = parts().map(|part| part.value).sum();
        let square = |part: &Estimate| part.std_error * part.std_error;
        let variance: f64 = parts().map(square).sum::<f64>() + square(one);
        let off = (one.value - sum).abs();
        let most = LARGEST_SCORE * variance.sqrt() + ROUNDING_ERROR * sum;
        assert!(
            off <= most,
            "point {number}: {} is not {sum} by {off}",
            one.value
        );
    }
    together
}

/// In a room that reflects nothing: every point in closed form.
#[test]
fn all_lamps_in_full_view_are_exact() {
    let found = estimates(
        scene([], lamps(PANELS, 0..PANELS), []),
        irradiance_at(places()),
        "E",
        16,
    );
    for ((at, _), estimate) in places().iter().zip(&found) {
        assert_eq!(certainty(estimate), Certainty::ClosedForm);
        assert_agrees("all lamps", estimate, sum(*at), 0.0);
    }
}

#[test]
fn a_screen_takes_what_it_hides() {
    let around = |mut shapes: Vec<ShapeDescription>, _| {
        shapes.push(screen());
        scene([], shapes, [])
    };
    let found = assert_all_is_the_sum_of_each_ten(PANELS, around, || irradiance_at(places()));
    let sampled = |one: &&Estimate| certainty(one) == Certainty::Sampled;
    assert!(found.iter().filter(sampled).count() > 4);
    // Beside the screen little is open, whatever the number of samples.
    assert!(found.iter().all(|one| one.std_error < 0.004 * one.value));
}

/// Light that surfaces send on is sampled beside, at points of scalar irradiance, too.
#[test]
fn a_grey_floor_and_a_screen_add_what_they_reflect() {
    let around = |mut shapes: Vec<ShapeDescription>, _| {
        shapes.extend([screen().made_of("grey"), square(20.0, -0.5).made_of("grey")]);
        scene([lambertian("grey", 0.6)], shapes, [])
    };
    assert_all_is_the_sum_of_each_ten(PANELS, around, || irradiance_at(places()));
    for at in [p(0.3, 0.2, 0.1), p(1.1, 0.2, 0.2), p(-0.2, 0.0, 0.05)] {
        assert_all_is_the_sum_of_each_ten(PANELS, around, || scalar_irradiance_at(at));
    }
}

/// Right under a plate nothing comes from any lamp, and that is certain.
#[test]
fn what_is_wholly_hidden_is_dark_for_certain() {
    let mut shapes = lamps(PANELS, 0..PANELS);
    shapes.push(square(40.0, 1.0));
    let found = estimates(scene([], shapes, []), irradiance_at(places()), "E", 16);
    for estimate in &found {
        assert_eq!(
            (estimate.value, certainty(estimate)),
            (0.0, Certainty::ClosedForm)
        );
    }
}

/// Half of the light gets through, and none of it is known.
#[test]
fn a_sheet_that_lets_light_pass_hides_nothing() {
    let gauze = MaterialDescription {
        opacity: Some(Opacity {
            factor: 0.5,
            textures: vec![],
            cutoff: None,
        }),
        ..lambertian("gauze", 0.0)
    };
    let mut shapes = lamps(PANELS, 0..PANELS);
    shapes.push(square(40.0, 1.0).made_of("gauze"));
    let found = estimates(scene([gauze], shapes, []), irradiance_at(places()), "E", 64);
    for ((at, _), estimate) in places().iter().zip(&found) {
        assert_ne!(certainty(estimate), Certainty::ClosedForm);
        assert_agrees("through gauze", estimate, 0.5 * sum(*at), 0.0);
    }
}

/// Lamps that no point aims at, and light from everywhere: chosen down the tree, and what is known is left out there.
#[test]
fn lamps_of_all_kinds_go_together() {
    let around = |mut shapes: Vec<ShapeDescription>, has_last: bool| {
        shapes.push(screen());
        let everywhere = has_last.then(|| environment(2.0));
        scene([], shapes, everywhere.into_iter().collect::<Vec<_>>())
    };
    let count = PANELS + 10;
    assert_all_is_the_sum_of_each_ten(count, around, || irradiance_at(places()));
}
