//! Energy: what is emitted is absorbed, roulette loses nothing, and light that is not there is not reported as known.

use std::f64::consts::PI;

use steradian::estimation::Estimate;
use steradian::geometry::Point;
use steradian::scene::description::{FluxOf, SceneDescription, ShapeDescription};
use steradian_tests::measuring::{measured, reading, rel_error, samples};
use steradian_tests::scenes::*;
use steradian_tests::{Certainty, assert_agrees, assert_close, certainty};

const SIZE: Point = Point::new(2.0, 3.0, 2.5);
const AREA: f64 = 2.0 * (2.0 * 3.0 + 2.0 * 2.5 + 3.0 * 2.5);

fn with_fluxes(mut scene: SceneDescription) -> SceneDescription {
    let kinds = [
        ("incident", FluxOf::Incident),
        ("leaving", FluxOf::Leaving),
        ("absorbed", FluxOf::Absorbed),
        ("net", FluxOf::Net),
    ];
    for (name, of) in kinds {
        scene.sensors.push(sensor(name, flux_of("room", of)));
    }
    scene
}

/// With Φ from a lamp and one reflectance: incident Φ/(1 − ρ), leaving ρ of that, absorbed and net Φ.
#[test]
fn a_closed_room_absorbs_what_a_lamp_emits() {
    let (power, reflectance) = (100.0, 0.6);
    let scene = with_fluxes(scene(
        [lambertian("wall", reflectance)],
        [room(SIZE).named("room").made_of("wall")],
        [point_light(p(0.6, 1.0, 1.7), flux(power))],
    ));
    let incident = power / (1.0 - reflectance);
    let measured = measured(&scene, &rel_error(4e-3));
    for (name, expected) in [
        ("incident", incident),
        ("leaving", reflectance * incident),
        ("absorbed", power),
        ("net", power),
    ] {
        assert_agrees(name, &reading(&measured, name).estimate, expected, 0.0);
    }
}

/// Walls that emit M everywhere absorb as much: the net flux is zero.
#[test]
fn a_furnace_absorbs_what_it_emits() {
    let (emitted, reflectance) = (10.0 * AREA, 0.6);
    let walls = room(SIZE)
        .named("room")
        .made_of("wall")
        .emitting(exitance(10.0));
    let scene = with_fluxes(scene([lambertian("wall", reflectance)], [walls], []));
    let measured = measured(&scene, &samples(1 << 17));
    let through = emitted / (1.0 - reflectance);
    for (name, expected) in [
        ("incident", through),
        ("leaving", through),
        ("absorbed", emitted),
        ("net", 0.0),
    ] {
        assert_agrees(name, &reading(&measured, name).estimate, expected, 0.0);
    }
}

/// Two faces of different reflectance: Σ absorbed = Φ.
#[test]
fn faces_of_a_room_share_what_is_emitted() {
    let reflectances = [0.2, 0.7, 0.5, 0.9, 0.0, 0.4];
    let name = |i: usize| format!("face {i}");
    let materials: Vec<_> = (0..6)
        .map(|i| lambertian(&name(i), reflectances[i]))
        .collect();
    let faces = room_faces(Point::ORIGIN, SIZE).into_iter().enumerate();
    let faces: Vec<_> = faces
        .map(|(i, face)| face.named(&name(i)).made_of(&name(i)))
        .collect();
    let mut scene = scene(
        materials,
        faces,
        [point_light(p(0.6, 1.0, 1.7), flux(100.0))],
    );
    scene.sensors = (0..6)
        .map(|i| sensor(&name(i), flux_of(&name(i), FluxOf::Absorbed)))
        .collect();
    let measured = measured(&scene, &rel_error(1e-2));
    let parts: Vec<_> = (0..6)
        .map(|i| reading(&measured, &name(i)).estimate)
        .collect();
    let sum: f64 = parts.iter().map(|part| part.value).sum();
    let variance: f64 = parts
        .iter()
        .map(|part| part.std_error * part.std_error)
        .sum();
    assert_close("sum of the faces", sum, 100.0, 4.0 * variance.sqrt());
}

/// L = L_e/(1 − ρ) after some 50 and 100 bounces: a roulette that is capped, or a depth limit, loses light here.
#[test]
fn roulette_loses_nothing() {
    for reflectance in [0.98, 0.99] {
        let walls = room(SIZE)
            .made_of("wall")
            .emitting(radiance(1.0 - reflectance));
        let mut scene = scene([lambertian("wall", reflectance)], [walls], []);
        scene.sensors = vec![
            sensor("L", radiance_along(p(0.6, 1.0, 1.7), v(0.2, 0.3, -1.0))),
            sensor("E", irradiance_at([(p(0.6, 1.0, 0.0), UP)])),
        ];
        let measured = measured(&scene, &samples(1 << 16));
        assert_agrees("L", &reading(&measured, "L").estimate, 1.0, 0.0);
        assert_agrees("E", &reading(&measured, "E").estimate, PI, 0.0);
    }
}

fn constant(samples_of_a_reading: u64) {
    let shapes = [
        solid(p(-2.0, -2.0, -1.0), p(2.0, 2.0, 0.0)).made_of("white"),
        ball(p(0.0, 0.0, 1.0), 1.0).made_of("white"),
    ];
    let mut scene = scene([lambertian("white", 1.0)], shapes, [environment(0.3)]);
    scene.sensors = vec![
        sensor("L", radiance_along(p(3.0, 0.0, 1.0), v(-2.0, 0.0, -0.8))),
        sensor("E", irradiance_at([(p(1.5, 0.0, 0.0), UP)])),
    ];
    let measured = measured(&scene, &samples(samples_of_a_reading));
    let (l, e) = (
        reading(&measured, "L").estimate,
        reading(&measured, "E").estimate,
    );
    assert_close("L", l.value, 0.3, 0.3e-6);
    assert_close("E", e.value / PI, 0.3, 0.3e-6);
}

/// Under constant radiance white surfaces, however they light each other, are invisible.
#[test]
fn constant_radiance_stays_constant() {
    constant(1_000_000);
}

/// Sums of a hundred million samples drift no more than those of a million.
#[test]
#[ignore = "a hundred million paths: minutes; run in release with --ignored"]
fn constant_radiance_stays_constant_over_a_hundred_million_samples() {
    constant(100_000_000);
}

/// A meter below a panel and what hides it.
fn hidden_by(screen: ShapeDescription) -> Estimate {
    let panel = square_facing_down(1.0, 1.0).emitting(radiance(1.0));
    let mut scene = scene([], [screen, panel], []);
    scene
        .sensors
        .push(sensor("hidden", irradiance_at([(p(0.1, 0.2, 0.0), UP)])));
    reading(&measured(&scene, &rel_error(0.01)), "hidden").estimate
}

/// A meter that the light cannot reach, which nobody has proven of a disc: no interval, no convergence, no claim.
#[test]
fn darkness_is_never_converged() {
    let hidden = hidden_by(disc(p(0.0, 0.0, 0.5), UP, 50.0));
    assert_eq!(
        (hidden.value, hidden.interval, hidden.converged),
        (0.0, None, false)
    );
}

#[test]
fn darkness_behind_a_rectangle_is_proven() {
    let hidden = hidden_by(square(50.0, 0.5));
    assert_eq!((hidden.value, hidden.converged), (0.0, true));
    assert_eq!(certainty(&hidden), Certainty::ClosedForm);
}
