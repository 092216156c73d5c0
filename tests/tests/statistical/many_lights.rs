//! Beyond ten lamps, few are sampled at each place, chosen by what they may give there: all together they give what they give ten at a
//! time, each of which is sampled then. Beyond 16 384 lamps without extent points sample those too.

use std::f64::consts::TAU;
use std::sync::Arc;

use steradian::estimation::Estimate;
use steradian::geometry::{Point, Vector};
use steradian::light::{FarField, Opening, Planes};
use steradian::measurement::Reading;
use steradian::quantity::{Amount, Intensity};
use steradian::scene::description::{
    LightDescription, LightKind, LuminaireDescription, SceneDescription, SensorDescription,
    ShapeDescription,
};
use steradian::transport::MeasureOptions;
use steradian_tests::measuring::{measured, samples};
use steradian_tests::scenes::*;
use steradian_tests::{Certainty, LARGEST_SCORE, assert_same, certainty, score};

const SIZE: Point = Point::new(6.0, 5.0, 3.0);
const LAMPS: usize = 60;

/// Places that fill the upper half of the room evenly.
fn position(k: usize) -> Point {
    let along = |ratio: f64| (ratio * (k as f64 + 0.5)).fract();
    let [x, y, z] = [0.754_877_67, 0.569_840_29, 0.430_159_71].map(along);
    p(0.3 + 5.4 * x, 0.3 + 4.4 * y, 1.6 + 1.2 * z)
}

enum Lamp {
    Light(LightDescription),
    Shape(ShapeDescription),
}

/// A table that is brightest at 40° from its aim and ends at 90°, as a point.
fn luminaire(at: Point, aim: Vector) -> LightDescription {
    let values = [2.0, 5.0, 1.0, 0.0, 2.0, 3.0, 0.5, 0.0, 2.0, 5.0, 1.0, 0.0];
    let azimuths = [0.0, 180.0, 360.0];
    let table = FarField::new(Planes::C, &azimuths, &[0.0, 40.0, 70.0, 90.0], &values);
    light(LightKind::Luminaire(Box::new(LuminaireDescription {
        position: at,
        aim,
        c0: v(0.0, 1.0, 0.3),
        far_field: Arc::new(table.expect("the table is whole")),
        unit: Amount::Radiant(Intensity::from_watts_per_steradian(1.0)),
        opening: Opening::Point,
        flux: None,
        dimming: 1.0,
        maintenance_factor: 1.0,
    })))
}

/// Lamps of every kind by turns; a dark one of extent is still in the way.
fn lamp(k: usize, lit: bool) -> Option<Lamp> {
    let at = position(k);
    let slanted = Vector::new(0.3, (k as f64 * 0.1) - 3.0, -1.0);
    let shape = match k % 7 {
        0 => return lit.then(|| Lamp::Light(point_light(at, flux(20.0)))),
        1 => return lit.then(|| Lamp::Light(spot(at, slanted, cosine_beam(3.0), flux(20.0)))),
        2 => return lit.then(|| Lamp::Light(spot(at, DOWN, even_beam(50.0), flux(10.0)))),
        3 => rectangle(at, [v(0.0, 0.2, 0.0), v(0.3, 0.0, 0.05)]),
        4 => disc(at, slanted, 0.15),
        5 => ball(at, 0.06),
        _ => return lit.then(|| Lamp::Light(luminaire(at, slanted))),
    };
    Some(Lamp::Shape(match lit {
        true => shape.emitting(radiance(60.0)),
        false => shape,
    }))
}

/// A room with a block of steel, lit by the lamps that `is_lit` picks.
fn lit_by(is_lit: impl Fn(usize) -> bool) -> SceneDescription {
    let mut scene = scene(
        [
            lambertian("wall", 0.5),
            modelled("steel", metal(Some(rough(0.3, true)))),
        ],
        [
            room(SIZE).named("room").made_of("wall"),
            solid(p(2.0, 2.0, 0.0), p(3.0, 3.5, 1.2)).made_of("steel"),
        ],
        [],
    );
    for lamp in (0..LAMPS).filter_map(|k| lamp(k, is_lit(k))) {
        match lamp {
            Lamp::Light(light) => scene.lights.push(light),
            Lamp::Shape(shape) => scene.shapes.push(shape),
        }
    }
    scene
}

/// Sensors of every kind; `run` keeps the random numbers of runs apart.
fn sensors(run: usize) -> Vec<SensorDescription> {
    let named = |name: &str, kind| sensor(&format!("{name} {run}"), kind);
    vec![
        named(
            "floor beside the block",
            irradiance_at([(p(1.9, 2.5, 0.001), UP)]),
        ),
        named(
            "wall",
            irradiance_at([(p(0.001, 2.0, 1.5), v(1.0, 0.0, 0.0))]),
        ),
        named("air", scalar_irradiance_at(p(4.0, 4.0, 1.0))),
        named(
            "look at the floor",
            radiance_along(p(1.0, 1.0, 1.5), v(0.2, 0.1, -1.0)),
        ),
        named(
            "look at the block",
            radiance_along(p(1.0, 1.0, 2.0), v(1.5, 1.5, -0.9)),
        ),
        named("through the middle", flux_through(square(1.0, 1.4))),
    ]
}

fn readings(mut scene: SceneDescription, run: usize, options: &MeasureOptions) -> Vec<Reading> {
    scene.sensors = sensors(run);
    measured(&scene, options).readings()
}

#[test]
fn all_lamps_give_the_sum_of_each_ten() {
    let options = samples(1 << 12);
    let all = readings(lit_by(|_| true), 0, &options);
    let tens: Vec<_> = (1..=LAMPS / 10)
        .map(|ten| readings(lit_by(|k| k / 10 + 1 == ten), ten, &options))
        .collect();
    for (number, all) in all.iter().enumerate() {
        let parts = || tens.iter().map(|readings| &readings[number].estimate);
        let sum: f64 = parts().map(|part| part.value).sum();
        let variances = parts().map(|part| part.std_error * part.std_error);
        let variance = variances.sum::<f64>() + all.estimate.std_error * all.estimate.std_error;
        let off = (all.estimate.value - sum).abs() / variance.sqrt();
        assert!(
            off < LARGEST_SCORE,
            "{}: {} is not {sum} by {off}",
            all.sensor,
            all.estimate.value
        );
        assert!(variance.sqrt() < 0.05 * sum, "{} is uncertain", all.sensor);
    }
}

/// Corners of a polygon about half as wide as the room, near its back wall, with its front to the middle.
fn corner(k: usize) -> Point {
    let (sin, cos) = libm::sincos(k as f64 * TAU / CORNERS as f64);
    p(3.0 + 1.5 * cos, 4.7 - 0.2 * sin, 1.4 + 1.2 * sin)
}

const CORNERS: usize = 40;

/// A mesh of 38 triangles among eleven lamps gives what 38 lights of a triangle give.
#[test]
fn a_mesh_is_its_triangles() {
    let options = samples(1 << 12);
    let bright = |vertices| polygon(vertices).emitting(radiance(2.0));
    let few = || lit_by(|k| k < 11);
    let mut mesh = few();
    mesh.shapes.push(bright((0..CORNERS).map(corner).collect()));
    let mut parts = few();
    let triangle = |k: usize| bright(vec![corner(0), corner(k), corner(k + 1)]);
    parts.shapes.extend((1..CORNERS - 1).map(triangle));
    let [mesh, parts] =
        [(mesh, 20), (parts, 21)].map(|(scene, run)| readings(scene, run, &options));
    for (mesh, parts) in mesh.iter().zip(&parts) {
        assert!(mesh.estimate.std_error < 0.03 * mesh.estimate.value);
        assert_same(&mesh.sensor, &mesh.estimate, &parts.estimate);
    }
}

const POINTS: usize = 16_500;

/// So many lamps above a floor with a block on it, and a hundred meters below.
fn lamps_above_a_floor(range: std::ops::Range<usize>) -> SceneDescription {
    let lamp = |k: usize| match k % 2 {
        0 => point_light(position(k), flux(1.0)),
        _ => spot(position(k), DOWN, even_beam(60.0), flux(1.0)),
    };
    let block = solid(p(2.0, 2.0, 0.0), p(3.0, 3.5, 1.2));
    let mut scene = scene([], [block], range.map(lamp).collect::<Vec<_>>());
    let meter = |k: usize| {
        (
            p(
                0.3 + 0.59 * (k % 10) as f64,
                0.2 + 0.5 * (k / 10) as f64,
                -0.001,
            ),
            UP,
        )
    };
    scene.sensors = vec![
        sensor(
            "floor",
            irradiance_at((0..100).map(meter).collect::<Vec<_>>()),
        ),
        sensor("air", scalar_irradiance_at(p(1.0, 4.0, 1.0))),
    ];
    scene
}

/// A hundred points, but for those under the block, against the sums of 16 500 lamps: the scores are those of a normal variable. Below 87 %
/// within two standard errors is a chance of 1e-3, a mean beyond .4 one of 1e-4.
#[test]
fn sampled_sums_of_lamps_have_true_error_bars() {
    let options = samples(1 << 10);
    let sampled = measured(&lamps_above_a_floor(0..POINTS), &options).readings();
    let halves = [0..POINTS / 2, POINTS / 2..POINTS];
    let halves = halves.map(|half| measured(&lamps_above_a_floor(half), &options).readings());
    let scores = sampled.iter().enumerate().filter_map(|(number, reading)| {
        let parts = halves.each_ref().map(|half| &half[number].estimate);
        let is_exact = |part: &&Estimate| certainty(part) == Certainty::ClosedForm;
        assert!(parts.iter().all(is_exact));
        let sum = parts[0].value + parts[1].value;
        if sum == 0.0 {
            assert_eq!(reading.estimate.value, 0.0);
            return None;
        }
        assert_eq!(certainty(&reading.estimate), Certainty::Sampled);
        assert!(reading.estimate.std_error < 0.05 * sum);
        Some(score(&reading.estimate, sum))
    });
    let scores: Vec<f64> = scores.collect();
    let count = scores.len() as f64;
    let held = scores.iter().filter(|score| score.abs() < 2.0).count();
    let mean = scores.iter().sum::<f64>() / count;
    assert!(
        count > 80.0 && held as f64 >= 0.87 * count,
        "{held} of {count}"
    );
    assert!(mean.abs() < 0.4, "{mean}");
}
