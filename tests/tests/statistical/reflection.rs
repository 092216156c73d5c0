//! The reflection integral: its three estimators against each other and against whole scenes.

use std::f64::consts::PI;

use steradian::brdf::{Brdf, Lambertian};
use steradian::estimation::{Estimate, Method};
use steradian::geometry::{Direction, Point, Vector};
use steradian::light::LightSample;
use steradian::quantity::Spectrum;
use steradian::scene::description::{LightDescription, SceneDescription, ShapeDescription};
use steradian::transport::reflection::{by_monte_carlo, by_quadrature, by_sum};
use steradian_tests::measuring::{measured, reading, rel_error, samples, validated};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_close};

const REFLECTANCE: f64 = 0.6;

fn paper() -> Brdf {
    Brdf::Lambertian(Lambertian {
        reflectance: Spectrum::splat(REFLECTANCE as f32),
    })
}

fn lit_sheet(sheet: ShapeDescription, lights: Vec<LightDescription>) -> SceneDescription {
    let mut scene = scene(
        [lambertian("paper", REFLECTANCE)],
        [sheet.made_of("paper")],
        lights,
    );
    let ray = radiance_along(p(0.013, 0.1, 1.0), DOWN);
    scene.sensors.push(sensor("radiance", ray));
    scene
}

/// The samples of all lights at a point of the plane z = 0: world directions are local ones.
fn light_samples(scene: &SceneDescription, point: Point) -> Vec<LightSample> {
    let scene = validated(scene);
    let lights = scene.lights().iter();
    lights
        .filter_map(|light| {
            light.sample(point, Direction::Z, [0.0; 2], |_| {
                panic!("a light without extent has no form")
            })
        })
        .collect()
}

#[test]
fn the_sum_over_lights_is_the_radiance_of_a_surface_under_them() {
    let lights = vec![
        point_light(p(0.0, 0.0, 2.0), intensity(100.0)),
        point_light(p(1.0, -2.0, 0.5), intensity(30.0)),
        spot(
            p(-1.0, 1.0, 3.0),
            v(0.4, -0.3, -1.0),
            cosine_beam(3.0),
            intensity(200.0),
        ),
        directional(v(1.0, 1.0, -1.0), 10.0),
    ];
    let scene = lit_sheet(square(4.0, 0.0), lights);
    let expected = by_sum(
        &paper(),
        Direction::Z,
        &light_samples(&scene, p(0.013, 0.1, 0.0)),
    )[0];
    let measured = measured(&scene, &rel_error(1e-3));
    let radiance = reading(&measured, "radiance").estimate;
    assert_agrees("radiance", &radiance, expected, 1e-6 * expected);
}

/// A plane surface has nothing to reflect light to, itself least of all: its radiance is ρE/π in every sample.
#[test]
fn a_flat_surface_does_not_light_itself() {
    let corners = vec![
        p(-2.0, -2.0, 0.0),
        p(2.0, -2.0, 0.0),
        p(2.0, 2.0, 0.0),
        p(-2.0, 2.0, 0.0),
    ];
    let sheets = [
        square(4.0, 0.0),
        square(4.0, 0.9),
        square(1000.0, 0.0),
        polygon(corners),
        disc(Point::ORIGIN, UP, 2.0),
        ground(0.0),
        tilted_square(),
    ];
    for (number, sheet) in sheets.into_iter().enumerate() {
        let scene = lit_sheet(sheet, vec![directional(DOWN, 100.0)]);
        let cos = if number == 6 { 0.8 } else { 1.0 };
        let expected = REFLECTANCE * 100.0 * cos / PI;
        let radiance = reading(&measured(&scene, &samples(1 << 14)), "radiance").estimate;
        assert_close(
            &format!("sheet {number}"),
            radiance.value,
            expected,
            1e-6 * expected,
        );
    }
}

/// A square whose normal is (.6, 0, .8).
fn tilted_square() -> ShapeDescription {
    let edges = [Vector::new(4.0, 0.0, -3.0), Vector::new(0.0, 5.0, 0.0)];
    rectangle(p(-2.0, -2.5, 1.5), edges)
}

/// L(d) = 1 + z + 2x² over the hemisphere of a Lambertian surface: ρ(1 + 2/3 + 1/2).
#[test]
fn quadrature_and_monte_carlo_agree_under_uneven_light() {
    let incoming = |d: Direction| [1.0 + d.z() + 2.0 * d.x() * d.x(); 4];
    let exact = REFLECTANCE * (1.0 + 2.0 / 3.0 + 0.5);
    let quadrature = by_quadrature(&paper(), Direction::Z, incoming, 400)[0];
    // The midpoint rule errs by h²/24 times a second derivative below 40, with h = π/800; ρ/π is kept in f32.
    assert_close("quadrature", quadrature, exact, 3e-5 + 1e-7);
    let (mean, error) = by_monte_carlo(&paper(), Direction::Z, incoming, 7, 64, 1024);
    let estimate = Estimate {
        std_error: error[0],
        method: Method::Estimate,
        ..Estimate::closed_form(mean[0])
    };
    assert_agrees("Monte Carlo", &estimate, exact, 1e-6);
    assert!(error[0] < 1e-3 * exact, "{} is too uncertain", error[0]);
}

/// The same integral through a scene: a panel over a surface, read as radiance and as irradiance, L = ρE/π.
#[test]
fn radiance_over_irradiance_is_the_brdf() {
    let panel = square_facing_down(0.5, 1.5).emitting(radiance(50.0));
    let mut scene = scene(
        [lambertian("paper", REFLECTANCE)],
        [square(4.0, 0.0).made_of("paper"), panel],
        [],
    );
    let place = p(0.4, 0.1, 0.0);
    scene
        .sensors
        .push(sensor("H", irradiance_at([(place, UP)])));
    let ray = radiance_along(place + v(0.5, 0.0, 0.5), v(-1.0, 0.0, -1.0));
    scene.sensors.push(sensor("L", ray));
    let measured = measured(&scene, &rel_error(2e-3));
    let (h, l) = (
        reading(&measured, "H").estimate,
        reading(&measured, "L").estimate,
    );
    steradian_tests::assert_same("L and ρH/π", &l, &h.scaled(REFLECTANCE / PI));
}
