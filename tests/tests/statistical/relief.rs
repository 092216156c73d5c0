//! Normals of vertices and pictures that turn normals: light is reckoned with them, and none leaks.

use std::f64::consts::PI;
use std::sync::Arc;

use steradian::estimation::Estimate;
use steradian::geometry::Point;
use steradian::material::{Bitmap, Recipe, Texels};
use steradian::quantity::Length;
use steradian::scene::description::{
    GeometryDescription, MaterialDescription, MeshData, Pattern, Placement, Relief,
    ShapeDescription, Texture,
};
use steradian_tests::assert_agrees;
use steradian_tests::measuring::{measured, reading, samples};
use steradian_tests::scenes::*;

const REFLECTANCE: f64 = 0.5;
const WATTS: f64 = 10.0;

/// A picture of one texel, or of a row of them.
fn picture(texels: &[[f32; 3]]) -> Texture {
    let texels: Vec<_> = texels.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
    let bitmap = Bitmap::new(texels.len() as u32, 1, Texels::Float(texels)).expect("a picture");
    Texture {
        pattern: Pattern::Bitmap(Arc::new(bitmap)),
        placement: Placement::default(),
    }
}

/// The normal (.6, 0, .8), x along u.
fn slanted() -> Relief {
    Relief::Normals {
        picture: picture(&[[0.8, 0.5, 0.9]]),
        scale: 1.0,
    }
}

/// What a meter above sees of a floor at the origin, lit by a lamp.
fn seen(floor: MaterialDescription, shape: ShapeDescription, lamp: Point) -> Estimate {
    let lamp = point_light(lamp, intensity(WATTS));
    let mut scene = scene([floor], [shape.made_of("floor")], [lamp]);
    let ray = radiance_along(p(0.0, 0.0, 3.0), v(0.0, 0.0, -1.0));
    scene.sensors.push(sensor("L", ray));
    let mut options = samples(1024);
    options.max_depth = Some(2);
    reading(&measured(&scene, &options), "L").estimate
}

/// ρ/π · I/r² · cosθ.
fn expected(squared: f64, cos_theta: f64) -> f64 {
    REFLECTANCE / PI * WATTS / squared * cos_theta
}

fn relieved(relief: Relief) -> MaterialDescription {
    MaterialDescription {
        relief: Some(relief),
        ..lambertian("floor", REFLECTANCE)
    }
}

/// Single precision of directions: some 1e-7.
#[test]
fn a_normal_map_turns_the_cosine() {
    let to_the_normal = seen(relieved(slanted()), square(4.0, 0.0), p(1.5, 0.0, 2.0));
    assert_agrees("towards", &to_the_normal, expected(6.25, 1.0), 2e-6);
    let away = seen(relieved(slanted()), square(4.0, 0.0), p(-1.5, 0.0, 2.0));
    assert_agrees("away", &away, expected(6.25, 0.28), 2e-6);
}

/// Grey values 0, ½, 1 at u = 1/6, ½, 5/6 of 4 m: h_u = 1.5 at ½; .375 over 1 m at a scale of 1 m: tan of the slope.
#[test]
fn a_bump_map_turns_the_normal_by_its_slope() {
    let relief = Relief::Height {
        picture: picture(&[[0.0; 3], [0.5; 3], [1.0; 3]]),
        scale: Length::from_metres(1.0),
    };
    let found = seen(relieved(relief), square(4.0, 0.0), p(0.0, 0.0, 2.0));
    let cos_theta = 1.0 / (1.0_f64 + 0.375 * 0.375).sqrt();
    assert_agrees("bump", &found, expected(4.0, cos_theta), 2e-6);
}

fn rounded() -> ShapeDescription {
    let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let mesh = MeshData {
        vertices: corners.map(|[x, y]| p(x, y, 0.0)).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: vec![[0.6, 0.0, 0.8]; 4],
        ..MeshData::default()
    };
    ShapeDescription {
        geometry: GeometryDescription::Mesh(Arc::new(mesh)),
        ..square(4.0, 0.0)
    }
}

/// Oren and Nayar's surface without roughness is Lambertian.
fn matt() -> MaterialDescription {
    let recipe = Recipe::OrenNayar {
        reflectance: even(REFLECTANCE),
        sigma: 0.0.into(),
    };
    modelled("floor", recipe)
}

#[test]
fn normals_of_vertices_turn_the_cosine() {
    let found = seen(matt(), rounded(), p(1.5, 0.0, 2.0));
    assert_agrees("rounded", &found, expected(6.25, 1.0), 2e-6);
    // A plain Lambertian surface keeps its true normal.
    let plain = seen(
        lambertian("floor", REFLECTANCE),
        rounded(),
        p(1.5, 0.0, 2.0),
    );
    assert_agrees("plain", &plain, expected(6.25, 0.8), 2e-6);
}

/// A lamp below the floor, but before its shading normal.
#[test]
fn no_light_comes_through_the_surface() {
    for (floor, shape) in [(relieved(slanted()), square(4.0, 0.0)), (matt(), rounded())] {
        let found = seen(floor, shape, p(5.0, 0.0, -1.0));
        assert_eq!(found.value, 0.0);
    }
}
