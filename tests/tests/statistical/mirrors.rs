//! Plane mirrors: what is seen in them is the image of the scene, and what cannot be sampled is told.

use steradian::geometry::Point;
use steradian::scene::description::{SceneDescription, ShapeDescription};
use steradian_tests::measuring::{measured, reading, rel_error, samples};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_same};

const REFLECTANCE: f64 = 0.9;

/// A mirror in the plane z = 0 that is wide enough for all rays of these tests.
fn plane_mirror() -> ShapeDescription {
    square(2000.0, 0.0).made_of("mirror")
}

fn with_meter(mut scene: SceneDescription, point: Point, down: bool) -> SceneDescription {
    let normal = if down { DOWN } else { v(1.0, 0.0, 0.0) };
    scene
        .sensors
        .push(sensor("meter", irradiance_at([(point, normal)])));
    scene
}

fn mirrored(shape: ShapeDescription) -> SceneDescription {
    scene([mirror("mirror", REFLECTANCE)], [plane_mirror(), shape], [])
}

/// A meter that looks down at the mirror sees the panel above as a panel below.
#[test]
fn a_meter_sees_the_image_of_a_panel() {
    let panel = square_facing_down(1.0, 1.0).emitting(radiance(40.0));
    let image = square(1.0, -1.0).emitting(radiance(40.0));
    let point = p(0.9, 0.3, 0.5);
    let seen = with_meter(mirrored(panel), point, true);
    let truth = with_meter(scene([], [image], []), point, true);
    let options = rel_error(4e-3);
    let [seen, truth] =
        [seen, truth].map(|scene| reading(&measured(&scene, &options), "meter").estimate);
    assert_same("image", &seen, &truth.scaled(REFLECTANCE));
}

/// Beside a mirror a ball gives its own light and that of its image.
#[test]
fn a_mirror_adds_a_second_light() {
    let bright = || ball(p(3.0, 0.0, 1.0), 0.5).emitting(radiance(10.0));
    let image = ball(p(3.0, 0.0, -1.0), 0.5).emitting(radiance(10.0 * REFLECTANCE));
    let point = p(0.0, 0.0, 0.5);
    let seen = with_meter(mirrored(bright()), point, false);
    let truth = with_meter(scene([], [bright(), image], []), point, false);
    let options = rel_error(4e-3);
    let [seen, truth] =
        [seen, truth].map(|scene| reading(&measured(&scene, &options), "meter").estimate);
    assert_same("both", &seen, &truth);
}

#[test]
fn the_radiance_in_a_mirror_is_that_of_the_light_times_the_reflectance() {
    let mut scene = mirrored(square_facing_down(1.0, 1.0).emitting(radiance(40.0)));
    let ray = radiance_along(p(2.0, 0.0, 1.0), v(-1.0, 0.0, -1.0));
    scene.sensors.push(sensor("mirrored", ray));
    let measured = measured(&scene, &samples(1024));
    assert!(measured.complete(), "{:?}", measured.unsampled);
    let seen = reading(&measured, "mirrored").estimate;
    assert_agrees("mirrored", &seen, 40.0 * REFLECTANCE, 0.0);
}

/// No estimator here finds the light that a mirror throws from a point: it is told, by name.
#[test]
fn what_cannot_be_sampled_is_told() {
    let lamp = || point_light(p(0.0, 0.0, 1.0), intensity(1.0));
    let scene_of = |shape: ShapeDescription| {
        let materials = [mirror("mirror", REFLECTANCE), lambertian("paper", 0.5)];
        with_meter(scene(materials, [shape], [lamp()]), p(0.0, 0.0, 0.5), true)
    };
    let shiny = measured(&scene_of(plane_mirror()), &samples(1024));
    assert!(!shiny.complete());
    assert!(
        shiny.unsampled[0].contains("mirror"),
        "{:?}",
        shiny.unsampled
    );
    let matt = measured(&scene_of(square(2.0, 0.0).made_of("paper")), &samples(1024));
    assert!(matt.complete(), "{:?}", matt.unsampled);
}

/// Polished glass both reflects and refracts a lamp; ground glass is found by light samples.
#[test]
fn glass_is_told_by_what_it_does() {
    let classes = |roughness| {
        let lamp = point_light(p(0.0, 0.0, 1.0), intensity(1.0));
        let glass = modelled("glass", dielectric(1.5, roughness));
        let shape = ball(p(0.0, 0.0, 3.0), 0.5).made_of("glass");
        let scene = with_meter(scene([glass], [shape], [lamp]), p(0.0, 0.0, 0.5), false);
        measured(&scene, &samples(1024)).unsampled
    };
    let polished = classes(None);
    assert!(
        matches!(&polished[..], [one] if one.contains("reflected and refracted")),
        "{polished:?}"
    );
    assert_eq!(classes(Some(rough(0.2, false))), Vec::<String>::new());
}
