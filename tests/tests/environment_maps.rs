//! Pictures of all directions as lights, against closed forms.

use std::f64::consts::PI;
use std::sync::Arc;

use steradian::geometry::{Point, Vector};
use steradian::light::EnvironmentMap;
use steradian::material::{Bitmap, Texels};
use steradian::quantity::{Amount, Irradiance, Radiance};
use steradian::scene::description::{
    EnvironmentAmount, EnvironmentDescription, FluxOf, LightDescription, LightKind,
    SceneDescription, SensorKind, SpectrumMode,
};
use steradian::transport::MeasureOptions;
use steradian_kernel::InstructionSet;
use steradian_tests::measuring::{measured, reading, rel_error, samples};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_close};

const NORTH: Vector = Vector::new(0.0, 1.0, 0.0);

fn picture([width, height]: [usize; 2], grey: impl Fn(usize, usize) -> f32) -> Arc<Bitmap> {
    let texel = |index: usize| {
        let grey = grey(index % width, index / width);
        [grey, grey, grey, 1.0]
    };
    let texels = Texels::Float((0..width * height).map(texel).collect());
    let picture = Bitmap::new(width as u32, height as u32, texels);
    Arc::new(picture.expect("a picture"))
}

fn sky(picture: &Arc<Bitmap>, amount: EnvironmentAmount) -> LightDescription {
    light(LightKind::EnvironmentMap(EnvironmentDescription {
        picture: Arc::clone(picture),
        middle: NORTH,
        amount,
    }))
}

/// Radiance where the picture is 1.
fn unit(watts: f64) -> EnvironmentAmount {
    let radiance = Radiance::from_watts_per_square_metre_steradian(watts);
    EnvironmentAmount::Unit(Amount::Radiant(radiance))
}

/// A sun of 1 texel in 64 × 32, 5.6° wide, over a grey sky and dark ground.
fn sunny() -> Arc<Bitmap> {
    picture([64, 32], |column, row| match (column, row) {
        (40, 9) => 500.0,
        (_, row) if row < 16 => 1.0 + 0.05 * (column % 7) as f32,
        _ => 0.2,
    })
}

fn under(light: LightDescription, kind: SensorKind) -> SceneDescription {
    let mut scene = scene([], [], [light]);
    scene.sensors = vec![sensor("it", kind)];
    scene
}

#[test]
fn a_constant_picture_is_a_constant_environment() {
    let white = picture([5, 3], |_, _| 2.0);
    for normal in [UP, v(0.3, -0.5, 0.2)] {
        let scene = under(
            sky(&white, unit(1.5)),
            irradiance_at([(Point::ORIGIN, normal)]),
        );
        let found = reading(&measured(&scene, &samples(1 << 16)), "it").estimate;
        assert_agrees("E = πL", &found, 3.0 * PI, 0.0);
        assert!((found.value / (3.0 * PI) - 1.0).abs() < 2e-3);
    }
    let scene = under(sky(&white, unit(1.5)), scalar_irradiance_at(Point::ORIGIN));
    let found = reading(&measured(&scene, &samples(1 << 16)), "it").estimate;
    assert_agrees("E₀ = 4πL", &found, 12.0 * PI, 0.0);
}

/// One texel of 8 × 6 gives Δα (sin²λ₁ − sin²λ₀)/2 on the floor, and on a wall that faces α the integral of cosλ cos(α − α₀).
#[test]
fn one_bright_texel_is_its_closed_form() {
    for (column, row) in [(4, 1), (1, 0), (7, 2)] {
        let one = picture(
            [8, 6],
            |i, j| if (i, j) == (column, row) { 100.0 } else { 0.0 },
        );
        let [low, high] = [row + 1, row].map(|row| PI / 2.0 - PI * row as f64 / 6.0);
        let width = PI / 4.0;
        let sine = |angle: f64| libm::sin(angle);
        let floor = 100.0 * width * 0.5 * (sine(high) * sine(high) - sine(low) * sine(low));
        // A wall that faces the middle of the texel: ∫cos²λ dλ · 2 sin(Δα/2).
        let squares = 0.5 * (high - low) + 0.25 * (sine(2.0 * high) - sine(2.0 * low));
        let wall = 100.0 * squares * 2.0 * sine(0.5 * width);
        let azimuth = width * (column as f64 + 0.5) - PI;
        let facing = v(sine(azimuth), libm::cos(azimuth), 0.0);
        for (normal, expected) in [(UP, floor), (facing, wall)] {
            let points = irradiance_at([(Point::ORIGIN, normal)]);
            let scene = under(sky(&one, unit(1.0)), points);
            let found = reading(&measured(&scene, &samples(1 << 15)), "it").estimate;
            assert_agrees("one texel", &found, expected, 0.0);
            assert!(
                (found.value / expected - 1.0).abs() < 2e-3,
                "{found:?} {expected}"
            );
        }
    }
}

/// Rays show the texel that they look at: the middle is north, east is a quarter to the right of it.
#[test]
fn rays_see_their_texels() {
    let counted = picture([4, 2], |column, row| (1 + column + 4 * row) as f32);
    let rays = [
        (v(0.1, 1.0, 0.1), 3.0),
        (v(-0.1, 1.0, 0.1), 2.0),
        (v(0.1, -1.0, 0.1), 4.0),
        (v(-0.1, -1.0, 0.1), 1.0),
        (v(0.1, 1.0, -0.1), 7.0),
        (v(-0.1, -1.0, -0.1), 5.0),
    ];
    for (direction, expected) in rays {
        let scene = under(
            sky(&counted, unit(1.0)),
            radiance_along(Point::ORIGIN, direction),
        );
        let found = reading(&measured(&scene, &samples(256)), "it")
            .estimate
            .value;
        assert_close("texel", found, expected, 1e-5);
    }
}

/// On a disc, from all sides on a ball, and at a point: sampled and integrated agree.
#[test]
fn sampled_light_is_the_integral() {
    let sunny = sunny();
    let Ok(map) = EnvironmentMap::new(&sunny, NORTH) else {
        panic!("a map")
    };
    let scene = under(
        sky(&sunny, unit(2.0)),
        flux_through(disc(Point::ORIGIN, UP, 0.5)),
    );
    let agrees = |scene: &SceneDescription, expected: f64| {
        let found = reading(&measured(scene, &samples(1 << 19)), "it").estimate;
        assert_agrees("flux", &found, expected, 0.0);
        assert!(
            (found.value / expected - 1.0).abs() < 2e-3,
            "{found:?} {expected}"
        );
    };
    agrees(&scene, 2.0 * map.horizontal() * PI * 0.25);
    // A ball has the cross-section πr² from everywhere.
    let mut around = scene;
    around.shapes = vec![ball(Point::ORIGIN, 0.5).named("ball")];
    around.sensors = vec![sensor("it", flux_of("ball", FluxOf::Incident))];
    agrees(&around, 2.0 * map.integral() * PI * 0.25);
    let scalar = under(sky(&sunny, unit(2.0)), scalar_irradiance_at(Point::ORIGIN));
    let found = reading(&measured(&scalar, &samples(1 << 15)), "it").estimate;
    assert_agrees("E₀", &found, 2.0 * map.integral(), 0.0);
}

#[test]
fn a_picture_is_scaled_to_a_stated_irradiance() {
    let stated = Amount::Radiant(Irradiance::from_watts_per_square_metre(800.0));
    let light = sky(&sunny(), EnvironmentAmount::Irradiance(stated));
    let scene = under(light, irradiance_at([(Point::ORIGIN, UP)]));
    let found = reading(&measured(&scene, &rel_error(2e-3)), "it").estimate;
    assert_agrees("E", &found, 800.0, 0.0);
}

/// A grey floor throws back ρE/π; light samples and paths share it by the power heuristic, and a mirror shows the sky.
#[test]
fn floors_and_mirrors_reflect_the_sky() {
    let sunny = sunny();
    let Ok(map) = EnvironmentMap::new(&sunny, NORTH) else {
        panic!("a map")
    };
    let looks = radiance_along(p(0.0, 0.0, 1.0), v(0.0, 0.3, -1.0));
    let mut scene = under(sky(&sunny, unit(1.0)), looks);
    scene.materials = vec![lambertian("floor", 0.4), mirror("glass", 0.9)];
    scene.shapes = vec![square(20.0, 0.0).made_of("floor")];
    let found = reading(&measured(&scene, &rel_error(5e-3)), "it").estimate;
    assert_agrees("floor", &found, 0.4 / PI * map.horizontal(), 0.0);
    scene.shapes = vec![square(20.0, 0.0).made_of("glass")];
    let found = reading(&measured(&scene, &samples(1024)), "it")
        .estimate
        .value;
    let Ok(direction) = steradian::geometry::Direction::new(v(0.0, 0.3, 1.0)) else {
        panic!("a direction")
    };
    let [column, row] = map.texel(direction);
    let texel = f64::from(sunny.texels().at(64 * row + column)[0]);
    assert_close("mirror", found, 0.9 * texel, 1e-5);
}

/// A floor under the sky and twelve lamps, one of which it chooses, throws back ρ/π (E + Σ I cosθ/r²).
#[test]
fn a_sky_shines_beside_many_lamps() {
    let sunny = sunny();
    let Ok(map) = EnvironmentMap::new(&sunny, NORTH) else {
        panic!("a map")
    };
    let looks = radiance_along(p(0.0, 0.0, 1.0), v(0.0, 0.0, -1.0));
    let mut scene = under(sky(&sunny, unit(1.0)), looks);
    scene.materials = vec![lambertian("floor", 0.4)];
    scene.shapes = vec![square(20.0, 0.0).made_of("floor")];
    let mut lamps = 0.0;
    for k in 0..12 {
        let at = v(0.5 * f64::from(k) - 2.0, 1.0, 2.0);
        scene
            .lights
            .push(point_light(Point::ORIGIN + at, intensity(1.0)));
        lamps += 2.0 * libm::pow(at.dot(at), -1.5);
    }
    let found = reading(&measured(&scene, &rel_error(5e-3)), "it").estimate;
    assert_agrees("floor", &found, 0.4 / PI * (map.horizontal() + lamps), 0.0);
}

/// Colours are lanes in `rgb`; a grey picture is grey at all wavelengths; bands know no colours.
#[test]
fn pictures_have_lanes_in_every_mode() {
    let coloured = Bitmap::new(1, 1, Texels::Float(vec![[1.0, 2.0, 3.0, 1.0]]));
    let coloured = Arc::new(coloured.expect("a picture"));
    let up = irradiance_at([(Point::ORIGIN, UP)]);
    let mut scene = under(sky(&coloured, unit(1.0)), up.clone());
    let refused = steradian::scene::Scene::new(&scene)
        .err()
        .unwrap_or_default();
    assert!(refused[0].message.contains("rgb"), "{refused:?}");
    scene.spectrum = SpectrumMode::Rgb;
    let found = reading(&measured(&scene, &samples(1 << 15)), "it");
    assert_agrees(
        "Y",
        &found.estimate,
        PI * (0.2126 + 2.0 * 0.7152 + 3.0 * 0.0722),
        0.0,
    );
    let mut grey = under(sky(&picture([4, 3], |_, _| 0.5), unit(2.0)), up);
    grey.spectrum = SpectrumMode::Spectral {
        range: [360.0, 830.0],
    };
    let found = reading(&measured(&grey, &samples(1 << 15)), "it").estimate;
    // The upsampled grey is off by less than 1e-3 of its luminance.
    assert_agrees("spectral", &found, PI, 1e-3 * PI);
}

#[test]
fn pictures_change_no_bit() {
    let mut scene = under(
        sky(&sunny(), unit(1.0)),
        irradiance_at([(p(0.1, 0.2, 0.0), UP)]),
    );
    scene.materials = vec![lambertian("grey", 0.5)];
    scene.shapes = vec![
        square(4.0, 0.0).made_of("grey"),
        ball(p(0.5, 0.5, 0.5), 0.4).made_of("grey"),
    ];
    let alone = measured(&scene, &samples(4_000));
    let mut many = samples(4_000);
    many.plan.threads = 5;
    assert_eq!(alone, measured(&scene, &many));
    for instruction_set in InstructionSet::available() {
        let other = MeasureOptions {
            instruction_set,
            ..samples(4_000)
        };
        assert_eq!(alone, measured(&scene, &other), "{instruction_set:?}");
    }
}
