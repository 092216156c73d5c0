//! Pictures of every projection against what is known of them.

use steradian::estimation::film::{Exposure, Filter};
use steradian::estimation::{Estimate, Plan, Silent, Stopping};
use steradian::quantity::{Angle, Length};
use steradian::scene::description::{
    CameraDescription, Fisheye, Projection, SceneDescription, SensorKind,
};
use steradian::transport::{RenderOptions, render};
use steradian_tests::assert_same;
use steradian_tests::measuring::{measured, reading, rel_error, validated};
use steradian_tests::scenes::*;

const SIDE: u32 = 48;

fn projections() -> Vec<Projection> {
    let fov = Angle::from_degrees(70.0);
    let fisheye = |mapping, fov| Projection::Fisheye {
        mapping,
        fov: Angle::from_degrees(fov),
    };
    vec![
        Projection::Perspective { fov },
        Projection::ThinLens {
            fov,
            aperture_radius: Length::from_metres(0.2),
            focus_distance: Length::from_metres(1.0),
        },
        Projection::Orthographic {
            width: Length::from_metres(2.0),
        },
        Projection::Panorama,
        fisheye(Fisheye::Equidistant, 360.0),
        fisheye(Fisheye::Equisolid, 200.0),
        fisheye(Fisheye::Hemispherical, 180.0),
    ]
}

/// At (1, 1, 1), looking along z.
fn eye(projection: Projection) -> SensorKind {
    SensorKind::Camera(CameraDescription {
        position: p(1.0, 1.0, 1.0),
        look_at: p(1.0, 1.0, 2.0),
        up: v(0.0, 1.0, 0.0),
        projection,
        resolution: [SIDE, SIDE],
    })
}

fn picture(
    mut scene: SceneDescription,
    projection: Projection,
    filter: Filter,
    (samples, passes): (u64, u32),
) -> Exposure {
    scene.sensors = vec![sensor("eye", eye(projection))];
    let plan = Plan {
        stop: Stopping::at_samples(samples),
        replicates: passes,
        seed: 7,
        ..Plan::default()
    };
    let options = RenderOptions {
        plan,
        filter,
        ..RenderOptions::default()
    };
    let made = render(&validated(&scene), 0, &options, &mut Silent);
    made.unwrap_or_else(|error| panic!("{error}")).exposure
}

/// Distance of a pixel's centre from that of the film.
fn from_middle(pixel: usize) -> f64 {
    let offset = |at: usize| at as f64 + 0.5 - 0.5 * f64::from(SIDE);
    libm::hypot(offset(pixel % SIDE as usize), offset(pixel / SIDE as usize))
}

/// Radiance is the same along all rays. The box shows it but for rounding; with the other filters the weights of samples from 5 × 5
/// pixels are sampled, 64 a pixel, which is 8e-4 off. Beyond the circle and the reach of the filter all is exactly 0.
#[test]
fn constant_radiance_is_constant_in_every_projection() {
    let scene = scene([], [], [environment(3.0)]);
    for projection in projections() {
        let is_circle = matches!(projection, Projection::Fisheye { .. });
        for filter in [Filter::Box, Filter::Gaussian, Filter::BlackmanHarris] {
            let (reach, tolerance) = match filter {
                Filter::Box => (0.5, 3e-6),
                _ => (2.0, 0.06),
            };
            let image = picture(scene.clone(), projection, filter, (64, 4));
            let rim = 0.5 * f64::from(SIDE);
            for (pixel, (value, error)) in image.values().iter().zip(image.std_errors()).enumerate()
            {
                let place = from_middle(pixel);
                if is_circle && place > rim + reach * 1.4143 {
                    assert_eq!(
                        (value[0], error[0]),
                        (0.0, 0.0),
                        "{projection:?} {filter:?}"
                    );
                } else if !is_circle || place < rim - reach * 1.4143 {
                    let found = value[0];
                    assert!(
                        (found - 3.0).abs() < tolerance,
                        "{projection:?} {filter:?}: {found}"
                    );
                }
            }
        }
    }
}

/// The sum over all pixels times `scale`, from means of tiles that share no samples.
fn sum(image: &Exposure, scale: f64) -> Estimate {
    let [columns, rows] = image.tile_counts();
    let (mut value, mut variance) = (0.0, 0.0);
    for (column, row) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))) {
        let side = |at: u32| f64::from(32.min(SIDE - 32 * at));
        let pixels = side(column) * side(row) * scale;
        let tile = image.tile(column, row, &[1.0, 0.0, 0.0, 0.0], 0.95);
        value += pixels * tile.value;
        variance += (pixels * tile.std_error).powi(2);
    }
    Estimate {
        value,
        std_error: variance.sqrt(),
        ..image.tile(0, 0, &[1.0, 0.0, 0.0, 0.0], 0.95)
    }
}

/// A room with a lamp, a ball and walls that reflect.
fn furnished() -> SceneDescription {
    let shapes = [
        room(p(3.0, 2.0, 2.5)).made_of("grey"),
        rectangle(p(1.0, 0.6, 2.4), [v(0.0, 0.8, 0.0), v(0.8, 0.0, 0.0)]).emitting(radiance(10.0)),
        ball(p(2.0, 1.2, 1.6), 0.3).made_of("grey"),
    ];
    scene([lambertian("grey", 0.5)], shapes, [])
}

/// E = ∫ L cosθ dω = Σ L / R² over the pixels of a hemispherical picture, E₀ = ∫ L dω = 4 Σ L / R² over an equal-area one of 360°, R
/// being the radius of the circle in pixels.
#[test]
fn a_fisheye_is_a_meter() {
    let square = 0.25 * f64::from(SIDE * SIDE);
    let fisheye = |mapping, degrees| Projection::Fisheye {
        mapping,
        fov: Angle::from_degrees(degrees),
    };
    let mut meters = furnished();
    let place = p(1.0, 1.0, 1.0);
    meters.sensors = vec![
        sensor("plane", irradiance_at([(place, UP)])),
        sensor("sphere", scalar_irradiance_at(place)),
    ];
    let read = measured(&meters, &rel_error(3e-3));
    let pictures = [
        (
            "plane",
            fisheye(Fisheye::Hemispherical, 180.0),
            1.0 / square,
        ),
        ("sphere", fisheye(Fisheye::Equisolid, 360.0), 4.0 / square),
    ];
    for (name, projection, scale) in pictures {
        let image = picture(furnished(), projection, Filter::Box, (256, 16));
        let seen = sum(&image, scale);
        assert!(seen.std_error < 1e-2 * seen.value, "{name}: {seen:?}");
        assert_same(name, &seen, &reading(&read, name).estimate);
    }
}

/// Behind a lens the numbers of the first light are drawn from a block of their own: a lens so small that it changes nothing shows the
/// same picture as a pinhole.
#[test]
fn a_small_lens_is_a_pinhole() {
    let fov = Angle::from_degrees(70.0);
    let lens = Projection::ThinLens {
        fov,
        aperture_radius: Length::from_metres(1e-5),
        focus_distance: Length::from_metres(1.0),
    };
    let seen = [Projection::Perspective { fov }, lens].map(|projection| {
        let image = picture(furnished(), projection, Filter::Box, (64, 16));
        sum(&image, 1.0)
    });
    assert_same("pinhole", &seen[0], &seen[1]);
}
