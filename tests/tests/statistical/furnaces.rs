//! Constant radiance from everywhere: what a surface shows then is its albedo, and what it lets through.

use steradian::brdf::Brdf;
use steradian::geometry::{Direction, Point, Vector};
use steradian::material::{ColorLanes, Recipe, Scalar, Site};
use steradian::measurement::Measurements;
use steradian::scene::Scene;
use steradian::scene::description::{
    FluxOf, FluxSurface, LaneValues, Media, SceneDescription, SensorKind, Side, Varying,
};
use steradian::spectrum::Wavelengths;
use steradian_tests::measuring::{measured, reading, samples, validated};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_close};

fn models() -> Vec<(&'static str, Recipe<Varying, Scalar>)> {
    let anisotropic = |alpha| steradian::material::Roughness {
        alpha,
        ..rough(0.1, true)
    };
    vec![
        (
            "Oren-Nayar",
            Recipe::OrenNayar {
                reflectance: even(0.8),
                sigma: Scalar::from(0.5),
            },
        ),
        (
            "energy-preserving Oren-Nayar",
            Recipe::EnergyPreservingOrenNayar {
                reflectance: even(0.8),
                roughness: Scalar::from(0.7),
            },
        ),
        (
            "Phong",
            Recipe::Phong {
                diffuse: even(0.3),
                glossy: even(0.4),
                exponent: Scalar::from(20.0),
            },
        ),
        (
            "diffuser",
            Recipe::DiffuseTransmission {
                reflectance: even(0.4),
                transmittance: even(0.35),
            },
        ),
        ("polished metal", metal(None)),
        ("rough metal", metal(Some(rough(0.3, false)))),
        ("brushed metal", metal(Some(anisotropic([0.05, 0.4])))),
        ("polished glass", dielectric(1.5, None)),
        ("rough glass", dielectric(1.5, Some(rough(0.3, false)))),
        ("pane", pane(0.8)),
    ]
}

/// The model of the only material.
fn model(scene: &Scene) -> Brdf {
    let (_, material) = &scene.materials()[1];
    let brdf = material.brdf(&Site::NOWHERE, &ColorLanes::Grey, &Wavelengths::default());
    brdf.expect("the material is not black").into_owned()
}

/// A plate under radiance 1 on both sides shows albedo + transmittance (n_e/n_i)². The albedo of rough models is off by
/// as much as their tables: 1e-3.
#[test]
fn a_plate_of_any_model_shows_what_its_albedo_says() {
    for (name, recipe) in models() {
        for (z, from) in [(1.0, "above"), (-1.0, "below")] {
            let mut scene = scene(
                [modelled("plate", recipe.clone())],
                [square(2000.0, 0.0).made_of("plate")],
                [environment(1.0)],
            );
            let towards = Vector::new(0.5, 0.3, -z);
            scene
                .sensors
                .push(sensor("L", radiance_along(p(0.0, 0.0, z), towards)));
            let validated = validated(&scene);
            let brdf = model(&validated);
            let transmits = validated.materials()[1].1.transmits();
            let viewer = Vector::new(-0.5, -0.3, if transmits { z } else { 1.0 });
            let wo = Direction::new(viewer).expect("a direction");
            let through = brdf.transmittance(wo) * brdf.radiance_scale(wo, -wo);
            let expected = f64::from((brdf.albedo(wo) + through).to_lanes()[0]);
            let seen = reading(&measured(&scene, &samples(1 << 14)), "L").estimate;
            assert_agrees(&format!("{name} from {from}"), &seen, expected, 1e-3);
        }
    }
}

/// No light is made or lost in glass: through a ball of it everything looks as bright as everything else. Rays that
/// enter and leave scale by 1/n² and n²; those that are reflected inside for long must not.
#[test]
fn a_glass_ball_is_not_seen_in_a_furnace() {
    for (name, roughness, allowance) in [
        ("polished", None, 1e-5),
        ("rough", Some(rough(0.25, true)), 2e-3),
    ] {
        let mut scene = scene(
            [modelled("glass", dielectric(1.5, roughness))],
            [ball(Point::ORIGIN, 1.0).made_of("glass")],
            [environment(1.0)],
        );
        for (k, offset) in [0.0, 0.5, 0.9, 0.99].into_iter().enumerate() {
            let ray = radiance_along(p(offset, 0.0, 3.0), DOWN);
            scene.sensors.push(sensor(&format!("{k}"), ray));
        }
        let measured = measured(&scene, &samples(1 << 14));
        for k in 0..4 {
            let seen = reading(&measured, &format!("{k}")).estimate;
            assert_agrees(&format!("{name} {k}"), &seen, 1.0, allowance);
        }
    }
}

/// Two parallel interfaces with an absorbing medium between: with the reflectance r of one and τ = exp(−a d/cosθ_t) the
/// bounces sum to T = (1 − r)² τ/(1 − r²τ²) and R = r(1 + τT). A path that is scattered once only tells the law of the
/// medium from that of the surfaces.
#[test]
fn a_slab_absorbs_along_every_bounce() {
    let (absorption, thickness, eta) = (3.0, 0.25, 1.5);
    let mut scene = slab(absorption, thickness, eta);
    let direction = Vector::new(0.8, 0.0, -0.6);
    scene
        .sensors
        .push(sensor("L", radiance_along(p(0.0, 0.0, 1.0), direction)));
    let (sin, cos) = (0.8 / eta, 0.6);
    let cos_inside = f64::sqrt(1.0 - sin * sin);
    let s = (cos - eta * cos_inside) / (cos + eta * cos_inside);
    let p = (eta * cos - cos_inside) / (eta * cos + cos_inside);
    let r = 0.5 * (s * s + p * p);
    let tau = libm::exp(-absorption * thickness / cos_inside);
    let transmitted = (1.0 - r) * (1.0 - r) * tau / (1.0 - r * r * tau * tau);
    let expected = r * (1.0 + tau * transmitted) + transmitted;
    let seen = reading(&measured(&scene, &samples(1 << 16)), "L").estimate;
    // Rays start 2e-5 m off their surface.
    assert_agrees("slab", &seen, expected, 2e-4 * expected);
}

fn slab(absorption: f64, thickness: f64, eta: f64) -> SceneDescription {
    let mut glass = modelled("glass", dielectric(eta, None));
    glass.media = Media {
        inside: Some(LaneValues::Uniform(absorption)),
        outside: None,
    };
    let shapes = [
        square(20.0, 0.0).made_of("glass"),
        square_facing_down(20.0, -thickness).made_of("glass"),
    ];
    scene([glass], shapes, [environment(1.0)])
}

/// A lamp inside a medium reaches a meter on the diffuse floor of the same medium attenuated: E exp(−a r), from the
/// second vertex of a path on; the meter's own ray begins in air.
#[test]
fn a_path_keeps_its_medium_until_the_next_interface() {
    let (absorption, depth) = (2.0, 0.5);
    let mut water = modelled("water", dielectric(1.0, None));
    water.media.inside = Some(LaneValues::Uniform(absorption));
    let shapes = [
        square(2.0, 0.0).made_of("water"),
        square(2.0, -depth).made_of("paper"),
    ];
    let lamp = point_light(p(0.3, 0.0, -0.1), intensity(1.0));
    let mut scene = scene([water, lambertian("paper", 0.5)], shapes, [lamp]);
    scene
        .sensors
        .push(sensor("L", radiance_along(p(0.0, 0.0, 1.0), DOWN)));
    let mut options = samples(1024);
    options.max_depth = Some(3);
    let seen = reading(&measured(&scene, &options), "L").estimate;
    let (height, across) = (0.4, 0.3);
    let way = libm::hypot(height, across);
    let irradiance = height / (way * way * way) * libm::exp(-absorption * way);
    let expected = 0.5 / std::f64::consts::PI * irradiance * libm::exp(-absorption * depth);
    assert_close("water", seen.value, expected, 1e-5 * expected);
}

/// In radiance 1 a plate of area A receives πA on each side; of that ρ + τ leaves again where light comes from both
/// sides alike, and 1 − ρ − τ stays. Under a lamp on one side ρΦ leaves to it and τΦ to the other.
#[test]
fn a_diffuser_divides_its_flux() {
    let (reflectance, transmittance) = (0.4, 0.35);
    let paper = || Recipe::DiffuseTransmission {
        reflectance: even(reflectance),
        transmittance: even(transmittance),
    };
    let sheet = || square(2.0, 0.0).named("sheet").made_of("paper");
    let fluxes = [
        ("incident", FluxOf::Incident),
        ("leaving", FluxOf::Leaving),
        ("absorbed", FluxOf::Absorbed),
        ("net", FluxOf::Net),
    ];
    let with = |light, facing| {
        let mut scene = scene([modelled("paper", paper())], [sheet()], [light]);
        for (name, of) in fluxes {
            let surface = FluxSurface::Shape {
                name: "sheet".into(),
                side: facing,
            };
            scene
                .sensors
                .push(sensor(name, SensorKind::Flux { surface, of }));
        }
        measured(&scene, &samples(1 << 16))
    };
    let check = |measured: &Measurements, expected: [f64; 4]| {
        for ((name, _), expected) in fluxes.iter().zip(expected) {
            let seen = reading(measured, name).estimate;
            assert_agrees(name, &seen, expected, 1e-6 * expected.abs());
        }
    };
    let all = 4.0 * std::f64::consts::PI;
    let stays = 1.0 - reflectance - transmittance;
    let expected = [all, all * (1.0 - stays), all * stays, all * stays];
    check(&with(environment(1.0), Side::Front), expected);
    let lamp = || directional(DOWN, 2.0);
    let power = 8.0;
    let bright = [
        power,
        power * reflectance,
        power * stays,
        power * (1.0 - reflectance),
    ];
    check(&with(lamp(), Side::Front), bright);
    let dark = [0.0, power * transmittance, 0.0, -power * transmittance];
    check(&with(lamp(), Side::Back), dark);
}

/// What a lamp gives to a closed room of any model is absorbed by its walls.
#[test]
fn walls_of_any_model_absorb_what_a_lamp_emits() {
    for recipe in [
        Recipe::EnergyPreservingOrenNayar {
            reflectance: even(0.6),
            roughness: Scalar::from(0.8),
        },
        metal(Some(rough(0.4, false))),
    ] {
        let mut scene = scene(
            [modelled("wall", recipe)],
            [room(p(2.0, 3.0, 2.5)).named("room").made_of("wall")],
            [point_light(p(0.6, 1.0, 1.7), flux(100.0))],
        );
        scene
            .sensors
            .push(sensor("absorbed", flux_of("room", FluxOf::Absorbed)));
        let seen = reading(&measured(&scene, &samples(1 << 13)), "absorbed").estimate;
        assert_agrees("absorbed", &seen, 100.0, 0.0);
    }
}
