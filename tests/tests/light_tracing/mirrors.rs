//! Mirrors: what they throw is what the image of the lamp would.

use std::sync::Arc;

use steradian::geometry::Point;
use steradian::light::{FarField, Opening, Planes};
use steradian::quantity::{Angle, Length};
use steradian::scene::description::{
    Fisheye, LaneValues, LightDescription, Opacity, Projection, SpectrumMode,
};
use steradian_tests::assert_same;
use steradian_tests::luminaires::hanging;
use steradian_tests::scenes::*;

use super::*;

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

/// Rotationally symmetric, 100 cd cosγ downwards.
fn luminaire(position: Point, candelas: f64) -> LightDescription {
    let polars: Vec<_> = (0..=18).map(|k| 5.0 * f64::from(k)).collect();
    let cosines = polars
        .iter()
        .map(|gamma: &f64| candelas * libm::cos(gamma.to_radians()));
    let values: Vec<_> = cosines.collect();
    let azimuths = [0.0, 360.0];
    let table = FarField::new(
        Planes::C,
        &azimuths,
        &polars,
        &[values.clone(), values].concat(),
    );
    hanging(position, &Arc::new(table.expect("a table")), Opening::Point)
}

/// Beams, narrow enough to miss a part of the mirror, and tables count by the direction in which they send.
#[test]
fn beams_and_tables_are_mirrored() {
    let (lamp, image) = (p(0.0, 0.3, 0.9), p(-2.0, 0.3, 0.9));
    let beam = |position, x, watts| {
        spot(
            position,
            v(x, 0.0, -0.3),
            cosine_beam(8.0),
            intensity(watts),
        )
    };
    let seen = beside_a_mirror(beam(lamp, -1.0, 5.0), above_the_floor());
    assert_image("spot", seen, beam(image, 1.0, 5.0 * MIRROR));
    let seen = beside_a_mirror(luminaire(lamp, 100.0), above_the_floor());
    assert_image("luminaire", seen, luminaire(image, 100.0 * MIRROR));
}

/// Paths of four wavelengths, in the channels of the camera.
#[test]
fn wavelengths_are_mirrored() {
    let lamp = |position, watts| point_light(position, intensity(watts));
    let mut seen = beside_a_mirror(lamp(p(0.0, 0.3, 0.9), 5.0), above_the_floor());
    seen.spectrum = SpectrumMode::Spectral {
        range: [360.0, 830.0],
    };
    let paper = LaneValues::Rgb([0.6, 0.4, 0.1]);
    seen.materials[0] = coloured("paper", paper);
    assert_image("spectral", seen, lamp(p(-2.0, 0.3, 0.9), 5.0 * MIRROR));
}

/// A pane between floor and camera takes what it takes of other light, and so does a sheet that is half open before the mirror.
#[test]
fn what_lets_light_pass_is_no_meeting() {
    let lamp = |position, watts| point_light(position, intensity(watts));
    let mut seen = beside_a_mirror(lamp(p(0.0, 0.3, 0.9), 5.0), above_the_floor());
    seen.materials.push(modelled("pane", pane(0.9)));
    let mut half = lambertian("half", 0.0);
    half.opacity = Some(Opacity {
        factor: 0.5,
        textures: vec![],
        cutoff: None,
    });
    seen.materials.push(half);
    let sheet = rectangle(p(-0.9, -2.0, 0.0), [v(0.0, 4.0, 0.0), v(0.0, 0.0, 2.5)]);
    let cover = rectangle(p(0.2, -0.3, 0.8), [v(0.6, 0.0, 0.0), v(0.0, 0.6, 0.0)]);
    let mut truth = seen.clone();
    truth.shapes.truncate(1);
    seen.shapes.push(sheet.made_of("half"));
    for scene in [&mut seen, &mut truth] {
        scene.shapes.push(cover.clone().made_of("pane"));
    }
    // Once towards the mirror and once back.
    truth
        .lights
        .push(lamp(p(-2.0, 0.3, 0.9), 5.0 * MIRROR * 0.25));
    let [seen, truth] = [seen, truth].map(|scene| mean(&picture(&scene, &options(128, Some(3)))));
    assert_same("floor", &seen, &truth);
    assert!(seen.std_error < 0.02 * seen.value, "{seen:?}");
}
