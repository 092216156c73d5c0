//! What polished surfaces throw from lights without extent, in pictures: against closed forms and against lamps that cameras find.
//!
//! An agreement within [`LARGEST_SCORE`](steradian_tests::LARGEST_SCORE) standard errors of 16 passes fails by chance with probability 1.2e-3;
//! seeds are fixed.

use std::f64::consts::PI;
use std::sync::Arc;

use steradian::brdf::fresnel;
use steradian::estimation::film::merge_exposures;
use steradian::estimation::{Estimate, Plan, Silent, Stopping};
use steradian::material::{Bitmap, Recipe, Texels};
use steradian::quantity::{Angle, Length};
use steradian::scene::description::{
    CameraDescription, Fisheye, LaneValues, LightDescription, MaterialDescription, Pattern,
    Placement, Projection, Relief, SceneDescription, SensorKind, Texture,
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

/// Normals (.6, 0, .8) in the axes of a rectangle, the first along its first edge.
fn slanted(material: MaterialDescription) -> MaterialDescription {
    let texel = vec![[0.8, 0.5, 0.9, 1.0]];
    let bitmap = Bitmap::new(1, 1, Texels::Float(texel)).expect("a picture");
    let picture = Texture {
        pattern: Pattern::Bitmap(Arc::new(bitmap)),
        placement: Placement::default(),
    };
    MaterialDescription {
        relief: Some(Relief::Normals {
            picture,
            scale: 1.0,
        }),
        ..material
    }
}

/// What is thrown on a floor whose normals are turned counts by their cosine, ρ/π I/r² cosθ′, as that of a lamp does.
#[test]
fn turned_normals_receive_as_they_do_from_lamps() {
    let eye = camera([0.5, 0.0, 1.0], [0.5, 0.0, 0.0], pinhole(40.0));
    let mut seen = beside_a_mirror(point_light(p(0.0, 0.3, 0.9), intensity(5.0)), eye);
    seen.materials[0] = slanted(lambertian("paper", 0.5));
    let image = point_light(p(-2.0, 0.3, 0.9), intensity(5.0 * MIRROR));
    let truth = with_image(seen.clone(), image);
    let [seen, truth] = [seen, truth].map(|scene| mean(&picture(&scene, &options(64, Some(3)))));
    assert_same("floor", &seen, &truth);
}

/// Behind an interface of index n the irradiance on a plane that faces the refracted light is E T cosθ_i′/cosθ_t′, with ′ for turned
/// normals: radiance grows by n², and solid angles shrink by cosθ_i′/(n² cosθ_t′).
#[test]
fn turned_normals_refract_what_goes_through() {
    let shapes = [
        square(30.0, 0.0).made_of("paper"),
        square(2.0, 1.0).made_of("glass"),
    ];
    let glass = slanted(modelled("glass", dielectric(1.5, None)));
    let materials = [lambertian("paper", 0.5), glass];
    let mut scene = scene(materials, shapes, [directional(DOWN, 10.0)]);
    let eye = camera([0.0, 0.0, 0.8], [0.0, 0.0, 0.0], pinhole(40.0));
    scene.sensors = vec![sensor("eye", eye)];
    let seen = mean(&picture(&scene, &options(64, Some(3))));
    let (incident, n) = (0.8, 1.5);
    let refracted = fresnel::refracted_cosine(incident, n).unwrap();
    let through = 1.0 - fresnel::dielectric(incident, n).mean();
    // d_t = d/n + (cosθ_i′/n − cosθ_t′) n′ with d = −z and n′_z = .8.
    let down = 1.0 / n - (incident / n - refracted) * 0.8;
    let expected = 0.5 / PI * 10.0 * through * incident / refracted * down;
    assert_agrees("floor", &seen, expected, 1e-5 * expected);
    assert!(seen.std_error < 0.02 * expected, "{seen:?}");
}

/// A mirror whose normals are turned by n′ throws parallel light along d − 2 (d·n′) n′ with the irradiance that it has.
#[test]
fn turned_normals_throw_parallel_light_elsewhere() {
    let d = v(-1.0, 0.0, -0.1);
    let eye = camera([-0.8, 0.0, 0.5], [-0.8, 0.0, 0.0], pinhole(20.0));
    let mut seen = beside_a_mirror(directional(d, 7.0), eye);
    let edges = [v(0.0, 0.0, -2.5), v(0.0, 4.0, 0.0)];
    seen.shapes[1] = rectangle(p(-1.0, -2.0, 2.5), edges).made_of("mirror");
    seen.materials[1] = slanted(mirror("mirror", MIRROR));
    let normal = v(0.8, 0.0, -0.6);
    let thrown = d - normal * (2.0 * d.dot(normal));
    let image = directional(thrown, 7.0 * MIRROR);
    let truth = with_image(seen.clone(), image);
    let [seen, truth] = [seen, truth].map(|scene| mean(&picture(&scene, &options(64, Some(3)))));
    assert_same("floor", &seen, &truth);
    assert!(seen.std_error < 0.03 * seen.value, "{seen:?}");
}

/// Two faces of smooth glass with a medium that absorbs between them.
fn slab(absorption: f64) -> (SceneDescription, f64) {
    let mut glass = modelled("glass", dielectric(1.5, None));
    glass.media.inside = Some(LaneValues::Uniform(absorption));
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

/// A panorama closes in itself: the sphere below is as bright at its borders and poles as elsewhere.
#[test]
fn a_panorama_has_no_seam() {
    let mut scene = lamp_in_glass();
    scene.sensors[0].kind = SensorKind::Camera(CameraDescription {
        position: p(1.0, 0.0, 0.0),
        look_at: p(0.0, 0.0, 0.0),
        up: UP,
        projection: Projection::Panorama,
        resolution: [128, 64],
    });
    let seen = picture(&scene, &options(64, None)).exposure;
    for (column, row) in [(0, 0), (0, 1), (3, 0), (3, 1)] {
        let tile = seen.tile(column, row, &[1.0, 0.0, 0.0, 0.0], 0.95);
        assert_agrees("tile", &tile, IN_GLASS, 0.0);
    }
    // Of the pixels at the borders themselves the filter takes what lies beyond.
    let edge = (0..64).map(|row| seen.values()[128 * row][0]).sum::<f64>() / 64.0;
    assert!((edge / IN_GLASS - 1.0).abs() < 0.1, "{edge}");
}

/// ρ/π Φ/(4π R²)/(1 − ρ) with ρ = ½, Φ = 100 W, R = 2 m.
const IN_GLASS: f64 = 100.0 / (16.0 * PI * PI);

/// A hollow sphere around a lamp in the middle of a ball of glass, and a camera that sees the wall.
fn lamp_in_glass() -> SceneDescription {
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
    scene
}

/// As the glass loses nothing, the wall is as bright everywhere as without it. All of its light has gone through the glass, much of it more
/// than once.
#[test]
fn glass_around_a_lamp_keeps_all_of_its_light() {
    let seen = mean(&picture(&lamp_in_glass(), &options(256, None)));
    assert_agrees("wall", &seen, IN_GLASS, 0.0);
    assert!(seen.std_error < 0.01 * IN_GLASS, "{seen:?}");
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

/// A lamp in a ball of glass that hardly refracts (and reflects 6e-4), so that all light begins with polished surfaces, in a corner of rough
/// plastic with balls of rough metal and rough glass.
fn glossy(lamp_radius: f64) -> SceneDescription {
    let lamp = p(0.2, 0.1, 0.8);
    let [floor, _, _, wall, ..] = room_faces(p(-1.0, -1.0, 0.0), p(1.0, 1.0, 1.0));
    let shapes = [
        floor.made_of("plastic"),
        wall.made_of("plastic"),
        ball(p(0.1, 0.5, 0.2), 0.2).made_of("metal"),
        ball(p(0.1, -0.4, 0.3), 0.3).made_of("ice"),
        ball(lamp, 0.25).made_of("glass"),
    ];
    let plastic = Recipe::Plastic {
        ior: 1.5,
        diffuse: even(0.5),
        roughness: Some(rough(0.3, false)),
    };
    let materials = [
        modelled("plastic", plastic),
        modelled("metal", metal(Some(rough(0.3, false)))),
        modelled("ice", dielectric(1.31, Some(rough(0.3, false)))),
        modelled("glass", dielectric(1.05, None)),
    ];
    let mut scene = scene(materials, shapes, []);
    if lamp_radius > 0.0 {
        let emitted = radiance(100.0 / (4.0 * PI * PI * lamp_radius * lamp_radius));
        scene.shapes.push(ball(lamp, lamp_radius).emitting(emitted));
    } else {
        scene.lights.push(point_light(lamp, flux(100.0)));
    }
    let eye = camera([-0.6, 0.2, 0.35], [0.4, 0.0, 0.0], pinhole(40.0));
    scene.sensors = vec![sensor("eye", eye)];
    scene
}

/// Light goes the same ways from a lamp as to it, also where surfaces scatter it by models that are not the same in all directions, and
/// through rough glass.
#[test]
fn models_scatter_flux_as_they_scatter_radiance() {
    let [point, lamp] = [0.0, 0.1].map(|radius| picture(&glossy(radius), &options(256, None)));
    assert_eq!(point.unsampled, Vec::<String>::new());
    let [point, lamp] = [mean(&point), mean(&lamp)];
    assert_same("picture", &point, &lamp);
    assert!(point.std_error < 0.01 * point.value, "{point:?}");
}

/// Of 60 intervals that hold with probability .95, fewer than 48 hold with probability 5e-6; none of 60 is the error of the truth, whose
/// 95 % interval is a twentieth of theirs.
#[test]
fn intervals_hold() {
    let eye = camera([0.5, 0.0, 1.0], [0.5, 0.0, 0.0], pinhole(40.0));
    let scene = beside_a_mirror(point_light(p(0.0, 0.3, 0.9), intensity(5.0)), eye);
    let image = point_light(p(-2.0, 0.3, 0.9), intensity(5.0 * MIRROR));
    let truth = mean(&picture(
        &with_image(scene.clone(), image),
        &options(256, Some(3)),
    ));
    let holds = |seed: u64| {
        let mut options = options(16, Some(3));
        options.plan.seed = seed;
        options.plan.replicates = 4;
        let [low, high] = mean(&picture(&scene, &options)).interval.unwrap();
        usize::from((low..=high).contains(&truth.value))
    };
    let held: usize = (0..60).map(holds).sum();
    assert!(held >= 48, "{held} of 60");
}
