//! Light samples and the model's own directions, at surfaces of any model, find the same light.

use std::f64::consts::PI;

use steradian::brdf::Brdf;
use steradian::estimation::Estimate;
use steradian::geometry::{Direction, Point, Vector};
use steradian::material::{ColorLanes, Recipe, Roughness, Scalar, Site};
use steradian::scene::description::{SceneDescription, Varying};
use steradian::spectrum::Wavelengths;
use steradian_tests::measuring::{measured, reading, rel_error, samples, validated};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_close, assert_same};

fn model(description: &SceneDescription) -> Brdf {
    let scene = validated(description);
    let (_, material) = &scene.materials()[1];
    let brdf = material.brdf(&Site::NOWHERE, &ColorLanes::Grey, &Wavelengths::default());
    brdf.expect("the material is not black").into_owned()
}

/// A panel over a metal floor, or under a glass one, against L = ∫ ρ L cosθ_i cosθ_l/r² dA by 1000² patches: 1e-3
/// where the lobe is a few patches wide, 1e-5 where it is broad.
#[test]
fn a_panel_in_rough_metal_is_counted_once() {
    for (alpha, allowance) in [([0.04, 0.04], 1e-3), ([0.1, 0.4], 1e-4), ([0.8, 0.8], 1e-4)] {
        let roughness = Roughness {
            alpha,
            ..rough(0.1, false)
        };
        let mut scene = scene(
            [modelled("metal", metal(Some(roughness)))],
            [
                square(4.0, 0.0).made_of("metal"),
                square_facing_down(1.0, 0.7).emitting(radiance(5.0)),
            ],
            [],
        );
        let viewer = Vector::new(-0.7, 0.2, 0.6);
        let ray = radiance_along(Point::ORIGIN + viewer, -viewer);
        scene.sensors.push(sensor("L", ray));
        let expected = panel_in(&model(&scene), viewer, 0.7);
        let mut options = rel_error(5e-3);
        options.max_depth = Some(2);
        let seen = reading(&measured(&scene, &options), "L").estimate;
        assert_agrees(&format!("{alpha:?}"), &seen, expected, allowance * expected);
    }
}

/// The same through rough glass: the panel lies on the other side.
#[test]
fn a_panel_behind_rough_glass_is_counted_once() {
    let mut scene = scene(
        [modelled("glass", dielectric(1.5, Some(rough(0.3, false))))],
        [
            square(4.0, 0.0).made_of("glass"),
            square(1.0, -0.7).emitting(radiance(5.0)),
        ],
        [],
    );
    let viewer = Vector::new(-0.7, 0.2, 0.6);
    let ray = radiance_along(Point::ORIGIN + viewer, -viewer);
    scene.sensors.push(sensor("L", ray));
    let expected = panel_in(&model(&scene), viewer, -0.7);
    let mut options = rel_error(5e-3);
    options.max_depth = Some(2);
    let seen = reading(&measured(&scene, &options), "L").estimate;
    assert_agrees("glass", &seen, expected, 1e-4 * expected);
}

/// What a surface at the origin shows of a panel of side 1 and radiance 5 at this height.
fn panel_in(brdf: &Brdf, viewer: Vector, height: f64) -> f64 {
    let wo = Direction::new(viewer).expect("a direction");
    let (n, mut sum) = (1000, 0.0);
    for i in 0..n {
        for j in 0..n {
            let at = |k: i32| (f64::from(k) + 0.5) / f64::from(n) - 0.5;
            let to = Vector::new(at(i), at(j), height);
            let wi = Direction::new(to).expect("a direction");
            let cosines = wi.z() * wi.z();
            let value = f64::from(brdf.evaluate(wo, wi).to_lanes()[0]);
            sum += 5.0 * value * cosines / to.dot(to);
        }
    }
    sum / f64::from(n * n)
}

/// A sheet of paper lit from behind by a lamp has the radiance τE/π; from the lamp's side ρE/π.
#[test]
fn paper_shows_a_lamp_behind_it() {
    let paper = Recipe::DiffuseTransmission {
        reflectance: even(0.5),
        transmittance: even(0.3),
    };
    let lamp = point_light(p(0.0, 0.5, 1.0), intensity(2.0));
    let sheet = square(2.0, 0.0).made_of("paper");
    let mut scene = scene([modelled("paper", paper)], [sheet], [lamp]);
    scene.sensors = vec![
        sensor(
            "behind",
            radiance_along(p(0.5, 0.0, -0.5), v(-0.5, 0.0, 0.5)),
        ),
        sensor(
            "before",
            radiance_along(p(0.5, 0.0, 0.5), v(-0.5, 0.0, -0.5)),
        ),
    ];
    let measured = measured(&scene, &samples(1024));
    assert!(measured.complete(), "{:?}", measured.unsampled);
    let irradiance = 2.0 / libm::pow(1.25, 1.5);
    for (name, share) in [("behind", 0.3), ("before", 0.5)] {
        let seen = reading(&measured, name).estimate;
        let expected = share / PI * irradiance;
        assert_close(name, seen.value, expected, 1e-6 * expected);
    }
}

/// Light takes its way back: with lamp and meter exchanged the scalar irradiance is the same, past rough metal and
/// through rough glass.
#[test]
fn lamp_and_meter_may_change_places() {
    let places = [p(1.2, 0.3, 0.8), p(-0.9, -0.4, 1.1)];
    let between = |lamp: Point, meter: Point| {
        let materials = [
            modelled("metal", metal(Some(rough(0.4, false)))),
            modelled("glass", dielectric(1.5, Some(rough(0.5, false)))),
        ];
        let shapes = [
            square(3.0, 0.0).made_of("metal"),
            ball(p(0.1, 0.0, 0.9), 0.4).made_of("glass"),
        ];
        let mut scene = scene(materials, shapes, [point_light(lamp, intensity(10.0))]);
        scene
            .sensors
            .push(sensor("E0", scalar_irradiance_at(meter)));
        reading(&measured(&scene, &rel_error(1e-2)), "E0").estimate
    };
    assert_same(
        "exchanged",
        &between(places[0], places[1]),
        &between(places[1], places[0]),
    );
}

/// Rough metals are shaded side by side, mixtures one by one: a mixture of nothing but a metal looks like that metal, under lamps that are
/// chosen among, seen once and twice, smooth and rough, brushed and on a ball.
#[test]
fn metals_side_by_side_look_as_they_do_one_by_one() {
    let metals = [[0.02, 0.02], [0.1, 0.4], [0.7, 0.7]].map(|alpha| {
        metal(Some(Roughness {
            alpha,
            ..rough(0.1, false)
        }))
    });
    let alone = |metal: &Recipe<_, _>| Recipe::Mixture {
        parts: vec![metal.clone()],
        weights: vec![1.0],
    };
    let one_by_one = metals.each_ref().map(alone);
    let [first, second] = [metals, one_by_one].map(between_metals);
    for name in ["L", "mirrored", "E"] {
        assert_same(name, &first(name), &second(name));
    }
}

/// Readings in a cleft between two metals with a ball of a third in it, to 1 %.
fn between_metals(
    [polished, brushed, dull]: [Recipe<Varying, Scalar>; 3],
) -> impl Fn(&str) -> Estimate {
    let materials = [
        modelled("polished", polished),
        modelled("brushed", brushed),
        modelled("dull", dull),
    ];
    let wall = [v(0.0, 3.0, 0.0), v(0.0, 0.0, 2.0)];
    let shapes = [
        square(3.0, 0.0).made_of("brushed"),
        rectangle(p(-1.5, -1.5, 0.0), wall).made_of("polished"),
        ball(p(0.4, 0.2, 0.3), 0.3).made_of("dull"),
        ball(p(-0.3, 0.6, 1.2), 0.05).emitting(radiance(400.0)),
        ball(p(0.8, -0.9, 1.5), 0.3).emitting(radiance(20.0)),
        square_facing_down(0.5, 2.0).emitting(radiance(30.0)),
    ];
    let lamp = point_light(p(0.0, -0.5, 1.8), intensity(3.0));
    let mut scene = scene(materials, shapes, [lamp, environment(0.1)]);
    scene.sensors = vec![
        sensor("L", radiance_along(p(0.9, 0.3, 0.9), v(-0.5, 0.1, -0.9))),
        sensor(
            "mirrored",
            radiance_along(p(0.9, 0.1, 0.4), v(-1.0, 0.1, 0.1)),
        ),
        sensor("E", irradiance_at([(p(0.5, -0.6, 0.2), v(-1.0, 0.2, 0.3))])),
    ];
    let measured = measured(&scene, &rel_error(1e-2));
    move |name| reading(&measured, name).estimate
}
