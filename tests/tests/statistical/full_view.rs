//! Lights in full view of a meter are known in closed form, others sampled: no error bar where there is no chance, and the same number from
//! both sides of the line.

use std::f64::consts::PI;

use steradian::geometry::{Direction, Point, Vector, configuration_factor, solid_angle};
use steradian::measurement::Reading;
use steradian::quantity::Length;
use steradian::scene::description::{MaterialDescription, Opacity, ShapeDescription};
use steradian_tests::measuring::{measured, reading, samples};
use steradian_tests::scenes::*;
use steradian_tests::{Certainty, assert_agrees, certainty};

const RADIANCE: f64 = 3.0;
const UP: Vector = Vector::new(0.0, 0.0, 1.0);

/// What a meter at the origin reads.
fn at_origin(shapes: Vec<ShapeDescription>, normal: Vector) -> Reading {
    let mut scene = scene([lambertian("grey", 0.5)], shapes, []);
    scene
        .sensors
        .push(sensor("meter", irradiance_at([(Point::ORIGIN, normal)])));
    reading(&measured(&scene, &samples(1 << 12)), "meter")
}

#[track_caller]
fn assert_exact(reading: &Reading, expected: f64) {
    let estimate = &reading.estimate;
    assert_eq!(
        (certainty(estimate), estimate.std_error),
        (Certainty::ClosedForm, 0.0)
    );
    let off = (estimate.value / expected - 1.0).abs();
    assert!(off < 1e-12, "{} for {expected}", estimate.value);
}

fn direction(v: Vector) -> Direction {
    Direction::new(v).expect("normals are not zero")
}

fn of_polygon(outline: &[Point], normal: Vector) -> f64 {
    let normal = direction(normal);
    PI * RADIANCE * configuration_factor::of_polygon(Point::ORIGIN, normal, outline)
}

fn of_sphere(center: Point, radius: f64, normal: Vector) -> f64 {
    let (normal, radius) = (direction(normal), Length::from_metres(radius));
    PI * RADIANCE * configuration_factor::of_sphere(Point::ORIGIN, normal, center, radius)
}

/// Ahead, leaning so that the horizon cuts the light, and turned away.
#[test]
fn polygons_in_full_view_are_exact() {
    let hook = [
        (-1.0, -1.0),
        (-1.0, 1.5),
        (-0.5, 1.5),
        (-0.5, 0.0),
        (1.0, 0.0),
        (1.0, -1.0),
    ];
    let hook: Vec<_> = hook.map(|(x, y)| p(x, y, 1.0)).to_vec();
    for normal in [UP, v(1.0, 0.2, 0.1), v(-0.3, 1.0, 0.0)] {
        let lamp = polygon(hook.clone()).emitting(radiance(RADIANCE));
        assert_exact(&at_origin(vec![lamp], normal), of_polygon(&hook, normal));
    }
    let away = polygon(hook.clone()).emitting(radiance(RADIANCE));
    assert_eq!(at_origin(vec![away], -UP).estimate.value, 0.0);
}

#[test]
fn spheres_in_full_view_are_exact() {
    let center = p(0.5, -1.0, 2.0);
    for (normal, radius) in [(UP, 0.5), (v(1.0, 0.0, 0.0), 0.9), (v(0.0, 1.0, 0.1), 1.5)] {
        let lamp = ball(center, radius).emitting(radiance(RADIANCE));
        assert_exact(
            &at_origin(vec![lamp], normal),
            of_sphere(center, radius, normal),
        );
    }
}

/// Overhead, and beside the meter so that its horizon cuts it.
#[test]
fn discs_in_full_view_are_exact() {
    for (center, axis, normal) in [
        (p(0.0, 0.0, 2.0), -UP, UP),
        (p(1.0, 0.5, 0.2), v(-1.0, 0.0, 0.3), UP),
        (p(1.0, 0.5, 2.0), v(-1.0, 0.0, -1.0), v(-1.0, 0.0, 1.0)),
    ] {
        let lamp = disc(center, axis, 0.6).emitting(radiance(RADIANCE));
        let [direction, facing] = [axis, normal].map(direction);
        let radius = Length::from_metres(0.6);
        let factor =
            configuration_factor::of_disc(Point::ORIGIN, facing, center, direction, radius);
        assert_exact(&at_origin(vec![lamp], normal), PI * RADIANCE * factor);
    }
}

/// A box is lit on all its faces, of which the meter sees the lowest and two sides: its silhouette.
#[test]
fn a_shining_box_is_exact() {
    let lamp = solid(p(1.0, 1.0, 1.0), p(2.0, 3.0, 2.0)).emitting(radiance(RADIANCE));
    let silhouette = [
        (1.0, 3.0, 1.0),
        (1.0, 3.0, 2.0),
        (1.0, 1.0, 2.0),
        (2.0, 1.0, 2.0),
        (2.0, 1.0, 1.0),
        (2.0, 3.0, 1.0),
    ];
    // The outline is not plane, but on the sphere of directions only the planes of its edges count.
    let edges = silhouette.map(|(x, y, z)| p(x, y, z));
    assert_exact(&at_origin(vec![lamp], UP), of_polygon(&edges, UP));
}

/// A lamp that hangs from a ceiling, over a desk: what the light and the meter touch does not count.
#[test]
fn what_only_touches_does_not_count() {
    let outline = [
        p(-0.5, -0.5, 2.0),
        p(-0.5, 0.5, 2.0),
        p(0.5, 0.5, 2.0),
        p(0.5, -0.5, 2.0),
    ];
    let lamp = square_facing_down(1.0, 2.0).emitting(radiance(RADIANCE));
    let black = vec![lamp, square(4.0, 2.0), square(4.0, 0.0)];
    assert_exact(&at_origin(black, UP), of_polygon(&outline, UP));
}

/// A sheet halfway to the light ends at x: at .25 it just touches the shaft. What it leaves of the light is 2x + .5 wide.
#[test]
fn a_sheet_just_outside_the_shaft_changes_nothing_and_one_inside_is_right() {
    let lamp = || square_facing_down(1.0, 1.0).emitting(radiance(RADIANCE));
    let sheet = |x: f64| rectangle(p(x, -1.0, 0.5), [v(1.0, 0.0, 0.0), v(0.0, 2.0, 0.0)]);
    let left = |x: f64| {
        let outline = [
            p(-0.5, -0.5, 1.0),
            p(x, -0.5, 1.0),
            p(x, 0.5, 1.0),
            p(-0.5, 0.5, 1.0),
        ];
        of_polygon(&outline, UP)
    };
    assert_exact(&at_origin(vec![lamp(), sheet(0.25 + 1e-6)], UP), left(0.5));
    for x in [0.25 - 1e-4, 0.2, 0.0, -0.2] {
        let found = at_origin(vec![lamp(), sheet(x)], UP).estimate;
        assert_ne!(certainty(&found), Certainty::ClosedForm);
        // One sample in 4096 and 64 replicates shifts the value by that part.
        assert_agrees("behind a sheet", &found, left(2.0 * x), left(0.5) / 4096.0);
    }
}

/// The cone of a sphere is .2582 m wide halfway; the pyramid around it .5 % more.
#[test]
fn a_sheet_beside_the_cone_of_a_sphere() {
    let center = p(0.0, 0.0, 2.0);
    let lamp = || ball(center, 0.5).emitting(radiance(RADIANCE));
    let sheet = |x: f64| rectangle(p(x, -1.0, 1.0), [v(1.0, 0.0, 0.0), v(0.0, 2.0, 0.0)]);
    assert_exact(
        &at_origin(vec![lamp(), sheet(0.26)], UP),
        of_sphere(center, 0.5, UP),
    );
    let half = at_origin(vec![lamp(), sheet(0.0)], UP).estimate;
    assert_agrees(
        "half a sphere",
        &half,
        0.5 * of_sphere(center, 0.5, UP),
        0.0,
    );
}

/// A pane blocks every shaft, yet each shadow ray brings the same: sampling in proportion to the cosine leaves rounding only.
#[test]
fn sampled_lights_in_full_view_have_no_variance() {
    let glass = MaterialDescription {
        opacity: Some(Opacity {
            factor: 0.25,
            textures: vec![],
            cutoff: None,
        }),
        ..lambertian("glass", 0.0)
    };
    let outline = [
        p(0.2, -0.5, 1.0),
        p(0.2, 0.5, 1.0),
        p(1.2, 0.5, 1.0),
        p(1.2, -0.5, 1.0),
    ];
    let lights = [
        (
            polygon(outline.to_vec()),
            of_polygon(&outline, UP),
            solid_angle::of_polygon(Point::ORIGIN, &outline),
        ),
        (
            ball(p(1.0, 0.0, 1.0), 0.4),
            of_sphere(p(1.0, 0.0, 1.0), 0.4, UP),
            solid_angle::of_sphere(Point::ORIGIN, p(1.0, 0.0, 1.0), Length::from_metres(0.4)),
        ),
        (
            ball(p(1.0, 0.0, 0.3), 0.4),
            of_sphere(p(1.0, 0.0, 0.3), 0.4, UP),
            solid_angle::of_sphere(Point::ORIGIN, p(1.0, 0.0, 0.3), Length::from_metres(0.4)),
        ),
    ];
    for (shape, irradiance, solid_angle) in lights {
        // Around the meter, so that light passes it once.
        let pane = hollow_sphere(Point::ORIGIN, 0.1, &[]).made_of("glass");
        let mut scene = scene(
            [glass.clone()],
            [shape.emitting(radiance(RADIANCE)), pane],
            [],
        );
        scene.sensors = vec![
            sensor("meter", irradiance_at([(Point::ORIGIN, UP)])),
            sensor("scalar", scalar_irradiance_at(Point::ORIGIN)),
        ];
        let measured = measured(&scene, &samples(1 << 10));
        for (name, expected) in [
            ("meter", irradiance),
            ("scalar", RADIANCE * solid_angle.to_steradians()),
        ] {
            let found = reading(&measured, name).estimate;
            assert_eq!(certainty(&found), Certainty::Constant, "{found:?}");
            assert_agrees(name, &found, 0.75 * expected, 0.0);
        }
    }
}

/// In a room whose walls emit and reflect, the direct part is known and must not be met again by paths.
#[test]
fn a_furnace_is_not_counted_twice() {
    let (emitted, reflectance) = (10.0, 0.5);
    let walls = room(p(2.0, 3.0, 2.5))
        .made_of("grey")
        .emitting(exitance(emitted));
    let mut scene = scene([lambertian("grey", reflectance)], [walls], []);
    let middle = p(0.7, 1.1, 1.3);
    scene.sensors = vec![
        sensor("meter", irradiance_at([(middle, v(0.3, -0.2, 1.0))])),
        sensor("scalar", scalar_irradiance_at(middle)),
    ];
    let measured = measured(&scene, &samples(1 << 14));
    let expected = emitted / (1.0 - reflectance);
    for (name, expected) in [("meter", expected), ("scalar", 4.0 * expected)] {
        assert_agrees(name, &reading(&measured, name).estimate, expected, 0.0);
    }
}
