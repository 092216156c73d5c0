//! Glass: Fresnel's equations, all of the light, and lamps that cameras find.

use std::f64::consts::PI;

use steradian::brdf::fresnel;
use steradian::geometry::Point;
use steradian::material::Recipe;
use steradian::scene::description::LaneValues;
use steradian_tests::{assert_agrees, assert_same};

use super::*;

/// Parallel light of 1000 W/m² on two faces of smooth glass.
pub struct Slab {
    cosine: f64,
}

pub const SLAB: Slab = Slab {
    // 1/√1.25.
    cosine: 0.894_427_190_999_915_9,
};

impl Slab {
    /// Below it E cosθ (1 − R)² t/(1 − R² t²) with t = exp(−a d/cosθ_t), whatever n²: Fresnel's equations at both faces, and their series.
    pub fn irradiance(&self, absorption: f64, thickness: f64) -> f64 {
        let reflectance = fresnel::dielectric(self.cosine, 1.5).mean();
        let refracted = fresnel::refracted_cosine(self.cosine, 1.5).expect("into glass");
        let along = libm::exp(-absorption * thickness / refracted);
        let through = (1.0 - reflectance).powi(2) * along / (1.0 - (reflectance * along).powi(2));
        1000.0 * self.cosine * through
    }
}

/// Two faces of smooth glass with a medium that absorbs between them.
pub fn slab(absorption: f64) -> (SceneDescription, f64) {
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

/// What the paper sends back to the slab adds less than its reflectance, 1e-3.
#[test]
fn a_slab_of_glass_lets_through_what_fresnel_says() {
    for absorption in [0.0, 4.0] {
        let (scene, thickness) = slab(absorption);
        let expected = SLAB.irradiance(absorption, thickness) * 1e-3 / PI;
        let seen = mean(&picture(&scene, &options(64, None)));
        assert_agrees("slab", &seen, expected, 1e-3 * expected);
        assert!(seen.std_error < 0.02 * expected, "{seen:?}");
    }
}

/// ρ/π Φ/(4π R²)/(1 − ρ) with ρ = ½, Φ = 100 W, R = 2 m.
pub const IN_GLASS: f64 = 100.0 / (16.0 * PI * PI);

/// A hollow sphere around a lamp in the middle of a ball of glass, and a camera that sees the wall.
pub fn lamp_in_glass() -> SceneDescription {
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

/// Adds a lamp of 100 W: a ball, or a point.
fn add_lamp(scene: &mut SceneDescription, place: Point, radius: f64) {
    if radius > 0.0 {
        let emitted = radiance(100.0 / (4.0 * PI * PI * radius * radius));
        scene.shapes.push(ball(place, radius).emitting(emitted));
    } else {
        scene.lights.push(point_light(place, flux(100.0)));
    }
}

/// A ball of glass under a lamp, and a camera that sees a part of the floor, with the caustic, or of a wall, which has it by way of the
/// floor only.
pub fn glass_ball(lamp_radius: f64, target: [f64; 3]) -> SceneDescription {
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
    add_lamp(&mut scene, lamp, lamp_radius);
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
    add_lamp(&mut scene, lamp, lamp_radius);
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
