//! What polished surfaces throw from lights without extent, in pictures: against closed forms and against lamps that cameras find.
//!
//! An agreement within [`LARGEST_SCORE`](steradian_tests::LARGEST_SCORE) standard errors of 16 passes fails by chance with probability 1.2e-3;
//! seeds are fixed.

use std::f64::consts::PI;

use steradian::brdf::fresnel;
use steradian::estimation::film::merge_exposures;
use steradian::estimation::{Estimate, Plan, Silent, Stopping};
use steradian::quantity::{Angle, Length};
use steradian::scene::description::{
    CameraDescription, Fisheye, LightDescription, Projection, SceneDescription, SensorKind,
};
use steradian::transport::{Picture, RenderOptions, render};
use steradian_kernel::InstructionSet;
use steradian_tests::measuring::validated;
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_same};

const PASSES: u32 = 16;

/// From a point towards another, 32 × 32 pixels: one tile.
fn camera(from: [f64; 3], to: [f64; 3], projection: Projection) -> SensorKind {
    let point = |[x, y, z]: [f64; 3]| p(x, y, z);
    SensorKind::Camera(CameraDescription {
        position: point(from),
        look_at: point(to),
        up: v(0.0, 1.0, 0.1),
        projection,
        resolution: [32, 32],
    })
}

fn pinhole(degrees: f64) -> Projection {
    Projection::Perspective {
        fov: Angle::from_degrees(degrees),
    }
}

fn options(samples: u64, max_depth: Option<u32>) -> RenderOptions {
    RenderOptions {
        plan: Plan {
            stop: Stopping::at_samples(samples),
            replicates: PASSES,
            seed: 11,
            ..Plan::default()
        },
        max_depth,
        ..RenderOptions::default()
    }
}

fn picture(scene: &SceneDescription, options: &RenderOptions) -> Picture {
    render(&validated(scene), 0, options, &mut Silent).unwrap_or_else(|error| panic!("{error}"))
}

/// Mean of the first channel over the picture.
fn mean(picture: &Picture) -> Estimate {
    assert_eq!(picture.exposure.tile_counts(), [1, 1]);
    picture.exposure.tile(0, 0, &[1.0, 0.0, 0.0, 0.0], 0.95)
}

const MIRROR: f64 = 0.8;

/// A lamp between a floor and an upright mirror at x = −1, and what a camera sees of the floor from above.
fn beside_a_mirror(lamp: LightDescription, eye: SensorKind) -> SceneDescription {
    let mirror_plane = rectangle(p(-1.0, -2.0, 0.0), [v(0.0, 4.0, 0.0), v(0.0, 0.0, 2.5)]);
    let mut scene = scene(
        [lambertian("paper", 0.5), mirror("mirror", MIRROR)],
        [
            square(30.0, 0.0).made_of("paper"),
            mirror_plane.made_of("mirror"),
        ],
        [lamp],
    );
    scene.sensors = vec![sensor("eye", eye)];
    scene
}

/// The same floor with the lamp's image as a lamp instead of the mirror.
fn with_image(mut scene: SceneDescription, image: LightDescription) -> SceneDescription {
    scene.shapes.truncate(1);
    scene.lights.push(image);
    scene
}

fn projections() -> Vec<Projection> {
    let fov = Angle::from_degrees(40.0);
    let fisheye = |mapping| Projection::Fisheye { mapping, fov };
    vec![
        Projection::Perspective { fov },
        Projection::ThinLens {
            fov,
            aperture_radius: Length::from_metres(0.2),
            focus_distance: Length::from_metres(0.7),
        },
        Projection::Orthographic {
            width: Length::from_metres(0.6),
        },
        fisheye(Fisheye::Equidistant),
        fisheye(Fisheye::Equisolid),
        fisheye(Fisheye::Hemispherical),
    ]
}

/// The floor before a mirror has the light of the lamp and of its image, ρ_m I cosθ/r² of the mirrored place, in every projection.
#[test]
fn a_mirror_shines_like_the_image_of_the_lamp() {
    for projection in projections() {
        let eye = camera([0.5, 0.0, 1.0], [0.5, 0.0, 0.0], projection);
        let seen = beside_a_mirror(point_light(p(0.0, 0.3, 0.9), intensity(5.0)), eye);
        let image = point_light(p(-2.0, 0.3, 0.9), intensity(5.0 * MIRROR));
        let truth = with_image(seen.clone(), image);
        // Three segments: light that comes back from the floor by way of the mirror has more.
        let [seen, truth] =
            [seen, truth].map(|scene| mean(&picture(&scene, &options(64, Some(3)))));
        assert_same(&format!("{projection:?}"), &seen, &truth);
        assert!(
            seen.std_error < 0.01 * seen.value,
            "{projection:?}: {seen:?}"
        );
    }
}

/// So it is with parallel light, whose image travels in the mirrored direction.
#[test]
fn a_mirror_throws_parallel_light_back() {
    let eye = camera([0.5, 0.0, 1.0], [0.5, 0.0, 0.0], pinhole(40.0));
    let seen = beside_a_mirror(directional(v(-1.0, 0.0, -1.0), 7.0), eye);
    let image = directional(v(1.0, 0.0, -1.0), 7.0 * MIRROR);
    let truth = with_image(seen.clone(), image);
    let [seen, truth] = [seen, truth].map(|scene| mean(&picture(&scene, &options(64, Some(3)))));
    assert_same("floor", &seen, &truth);
    assert!(seen.std_error < 0.01 * seen.value, "{seen:?}");
}

/// Two faces of smooth glass with a medium that absorbs between them.
fn slab(absorption: f64) -> (SceneDescription, f64) {
    let mut glass = modelled("glass", dielectric(1.5, None));
    glass.media.inside = Some(steradian::scene::description::LaneValues::Uniform(
        absorption,
    ));
    let thickness = 0.1;
    let shapes = [
        square(30.0, 0.0).made_of("paper"),
        square(3.0, 1.0 + thickness).made_of("glass"),
        square_facing_down(3.0, 1.0).made_of("glass"),
    ];
    let lamp = directional(v(0.5, 0.0, -1.0), 1000.0);
    let mut scene = scene([lambertian("paper", 1e-3), glass], shapes, [lamp]);
    let eye = camera([0.3, 0.0, 0.7], [0.3, 0.0, 0.0], pinhole(40.0));
    scene.sensors = vec![sensor("eye", eye)];
    (scene, thickness)
}

/// Below a slab the irradiance is E cosθ (1 − R)² t/(1 − R² t²) with t = exp(−a d/cosθ_t), whatever n²: Fresnel's equations at both
/// faces, and their series. What the paper sends back to the slab adds less than its reflectance, 1e-3.
#[test]
fn a_slab_of_glass_lets_through_what_fresnel_says() {
    for absorption in [0.0, 4.0] {
        let (scene, thickness) = slab(absorption);
        let cosine = 1.0 / 1.25_f64.sqrt();
        let reflectance = fresnel::dielectric(cosine, 1.5).mean();
        let refracted = fresnel::refracted_cosine(cosine, 1.5).unwrap();
        let along = libm::exp(-absorption * thickness / refracted);
        let through = (1.0 - reflectance).powi(2) * along / (1.0 - (reflectance * along).powi(2));
        let expected = 1000.0 * cosine * through * 1e-3 / PI;
        let seen = mean(&picture(&scene, &options(64, None)));
        assert_agrees("slab", &seen, expected, 1e-3 * expected);
        assert!(seen.std_error < 0.02 * expected, "{seen:?}");
    }
}

/// Around a lamp in the middle of a ball of glass that loses nothing, a hollow sphere is as bright everywhere as without the glass:
/// ρ/π Φ/(4π R²)/(1 − ρ). All of its light has gone through the glass, much of it more than once.
#[test]
fn glass_around_a_lamp_keeps_all_of_its_light() {
    let lamp = point_light(p(0.0, 0.0, 0.0), flux(100.0));
    let shapes = [
        hollow_sphere(p(0.0, 0.0, 0.0), 2.0, &[]).made_of("paper"),
        ball(p(0.0, 0.0, 0.0), 0.5).made_of("glass"),
    ];
    let materials = [
        lambertian("paper", 0.5),
        modelled("glass", dielectric(1.5, None)),
    ];
    let mut scene = scene(materials, shapes, [lamp]);
    let eye = camera([1.0, 0.0, 0.0], [2.0, 0.3, 0.0], pinhole(60.0));
    scene.sensors = vec![sensor("eye", eye)];
    let expected = 0.5 / PI * 100.0 / (16.0 * PI) / 0.5;
    let seen = mean(&picture(&scene, &options(256, None)));
    assert_agrees("wall", &seen, expected, 0.0);
    assert!(seen.std_error < 0.01 * expected, "{seen:?}");
}

/// A ball of glass under a lamp, and a camera that sees a part of the floor, with the caustic, or of a wall, which has it by way of the
/// floor only.
fn glass_ball(lamp_radius: f64, target: [f64; 3]) -> SceneDescription {
    let lamp = p(0.2, 0.1, 1.8);
    let [floor, _, _, wall, ..] = room_faces(p(-1.0, -1.0, 0.0), p(1.0, 1.0, 1.0));
    let shapes = [
        floor.made_of("paper"),
        wall.made_of("paper"),
        ball(p(0.0, 0.0, 0.7), 0.4).made_of("glass"),
    ];
    let materials = [
        lambertian("paper", 0.5),
        modelled("glass", dielectric(1.5, None)),
    ];
    let mut scene = scene(materials, shapes, []);
    if lamp_radius > 0.0 {
        let emitted = radiance(100.0 / (4.0 * PI * PI * lamp_radius * lamp_radius));
        scene.shapes.push(ball(lamp, lamp_radius).emitting(emitted));
    } else {
        scene.lights.push(point_light(lamp, flux(100.0)));
    }
    let eye = camera([0.5, 0.6, 0.2], target, pinhole(40.0));
    scene.sensors = vec![sensor("eye", eye)];
    scene
}

/// What is thrown by a point through a ball of glass is what a small lamp throws, which paths from the camera find if they are many. The
/// size of the lamp blurs the picture, which changes its mean by less than the errors here.
#[test]
fn a_point_shines_through_glass_like_a_small_lamp() {
    for (what, target) in [("floor", [0.0, 0.0, 0.0]), ("wall", [1.0, 0.5, 0.4])] {
        let point = mean(&picture(&glass_ball(0.0, target), &options(64, None)));
        let lamp = mean(&picture(&glass_ball(0.05, target), &options(512, None)));
        assert_same(what, &point, &lamp);
        assert!(point.std_error < 0.01 * point.value, "{what}: {point:?}");
    }
}

/// Where no polished surface is in view, nothing is missing; where one is, its view of the lamp and of what the lamp is thrown on.
#[test]
fn what_is_missing_is_what_polished_surfaces_show() {
    let away = glass_ball(0.0, [0.5, 0.6, 0.0]);
    assert_eq!(
        picture(&away, &options(1, None)).unsampled,
        Vec::<String>::new()
    );
    let towards = picture(&glass_ball(0.0, [0.0, 0.0, 0.7]), &options(1, None));
    let [class] = &towards.unsampled[..] else {
        panic!("{:?}", towards.unsampled);
    };
    assert!(class.contains("as polished surfaces show it"), "{class}");
    let lamp = picture(&glass_ball(0.05, [0.0, 0.0, 0.7]), &options(1, None));
    assert_eq!(lamp.unsampled, Vec::<String>::new());
}

/// The same bits for any number of threads, any instruction set, and from shards.
#[test]
fn pictures_with_caustics_keep_their_bits() {
    let mut plan = options(32, None);
    plan.plan.replicates = 4;
    plan.plan.threads = 1;
    let scene = glass_ball(0.0, [0.0, 0.0, 0.7]);
    let alone = picture(&scene, &plan).exposure;
    for threads in [2, 5] {
        let mut many = plan.clone();
        many.plan.threads = threads;
        assert_eq!(alone, picture(&scene, &many).exposure, "{threads} threads");
    }
    for instruction_set in InstructionSet::available() {
        let other = RenderOptions {
            instruction_set,
            ..plan.clone()
        };
        assert_eq!(
            alone,
            picture(&scene, &other).exposure,
            "{instruction_set:?}"
        );
    }
    let shards = (1..=3).map(|part| {
        let mut options = plan.clone();
        options.plan.shard = Some((part, 3));
        picture(&scene, &options).exposure
    });
    assert_eq!(alone, merge_exposures(shards.collect()).unwrap());
}
