//! Normals that pictures turn: flux is reckoned with them as radiance is.

use std::f64::consts::PI;
use std::sync::Arc;

use steradian::brdf::fresnel;
use steradian::material::{Bitmap, Texels};
use steradian::scene::description::{MaterialDescription, Pattern, Placement, Relief, Texture};
use steradian_tests::{assert_agrees, assert_same};

use super::*;

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
