//! Lamps of equal lumens: points, spots and surfaces of every shape.

use std::f64::consts::PI;

use steradian::geometry::Point;
use steradian::scene::description::{LightDescription, SceneDescription, ShapeDescription};
use steradian_tests::measuring::{measured, reading, rel_error};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_same};

const LUMENS: f64 = 1000.0;
/// Metres to the meters, four hundred times the size of the lamps.
const FAR: f64 = 20.0;
const SIZE: f64 = 0.05;

/// A lamp at the origin that shines downwards, and how much brighter than an even point it is below.
struct Lamp {
    name: &'static str,
    lights: Vec<LightDescription>,
    shapes: Vec<ShapeDescription>,
    gain: f64,
}

fn lamp(name: &'static str, light: LightDescription, gain: f64) -> Lamp {
    Lamp {
        name,
        lights: vec![light],
        shapes: vec![],
        gain,
    }
}

fn surface(name: &'static str, shape: ShapeDescription, gain: f64) -> Lamp {
    Lamp {
        name,
        lights: vec![],
        shapes: vec![shape],
        gain,
    }
}

/// The intensity below is Φ/4π from a point, a sphere and a beam of 180° half angle, Φ/2π from an even half space and from
/// a panel of two sides, Φ/π from a panel of one side and a cosine beam.
fn lamps() -> Vec<Lamp> {
    let origin = Point::ORIGIN;
    let power = luminous_flux(LUMENS);
    let emission = emitted_lumens(LUMENS);
    vec![
        lamp("point", point_light(origin, power), 1.0),
        lamp(
            "full spot",
            spot(origin, DOWN, even_beam(180.0), power),
            1.0,
        ),
        lamp("half spot", spot(origin, DOWN, even_beam(90.0), power), 2.0),
        lamp(
            "cosine spot",
            spot(origin, DOWN, cosine_beam(1.0), power),
            4.0,
        ),
        surface("sphere", ball(origin, SIZE).emitting(emission), 1.0),
        surface("disc", disc(origin, DOWN, SIZE).emitting(emission), 4.0),
        surface(
            "two-sided disc",
            disc(origin, DOWN, SIZE).emitting_twice(emission),
            2.0,
        ),
        surface(
            "rectangle",
            square_facing_down(SIZE, 0.0).emitting(emission),
            4.0,
        ),
        surface(
            "two-sided rectangle",
            square(SIZE, 0.0).emitting_twice(emission),
            2.0,
        ),
    ]
}

fn lit_by(lamp: Lamp) -> SceneDescription {
    let mut scene = SceneDescription {
        spectrum: visible(),
        ..scene([], lamp.shapes, lamp.lights)
    };
    let below = irradiance_at([(p(0.0, 0.0, -FAR), UP)]);
    let around = flux_through(hollow_sphere(Point::ORIGIN, FAR, &[]));
    scene.sensors = vec![sensor("below", below), sensor("around", around)];
    scene
}

/// A lamp of size s seen from d differs from a point by less than (s/d)², which a disc of that radius comes close to.
#[test]
fn equal_lumens_give_equal_illuminance_far_away() {
    let even = LUMENS / (4.0 * PI * FAR * FAR);
    for lamp in lamps() {
        let (name, expected) = (lamp.name, lamp.gain * even);
        let measured = measured(&lit_by(lamp), &rel_error(2e-3));
        let below = reading(&measured, "below");
        assert_eq!(below.unit, "lx");
        let allowance = (SIZE / FAR) * (SIZE / FAR) * expected;
        assert_agrees(name, &below.estimate, expected, allowance);
    }
}

/// Whatever their shape, all lamps send the same light through a sphere around them.
#[test]
fn equal_lumens_give_equal_mean_illuminance_around() {
    for lamp in lamps() {
        let name = lamp.name;
        let measured = measured(&lit_by(lamp), &rel_error(4e-3));
        assert_agrees(
            name,
            &reading(&measured, "around").estimate,
            LUMENS,
            1e-6 * LUMENS,
        );
    }
}

#[test]
fn a_sphere_light_is_the_point_light_in_its_centre() {
    let with = |lamp: usize| {
        let lamp = lamps().swap_remove(lamp);
        reading(&measured(&lit_by(lamp), &rel_error(1e-3)), "below").estimate
    };
    assert_same("sphere and point", &with(4), &with(0));
}
