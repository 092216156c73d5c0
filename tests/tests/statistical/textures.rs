//! Surfaces that vary from point to point: reflectance, emission and opacity.

use std::f64::consts::PI;
use std::sync::Arc;

use steradian::estimation::Method;
use steradian::geometry::Point;
use steradian::scene::description::{
    Bitmap, FluxOf, GeometryDescription, Interpolation, LaneValues, MaterialDescription,
    MaterialModel, MeshData, Opacity, Pattern, Placement, SceneDescription, ShapeDescription,
    SpectrumMode, Texels, Texture, Varying,
};
use steradian::spectrum::VISIBLE;
use steradian_tests::measuring::{measured, reading, samples};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_same};

fn texture(pattern: Pattern) -> Texture {
    Texture {
        pattern,
        placement: Placement::default(),
    }
}

/// A picture of two columns, sharp between them.
fn halves(left: [f32; 4], right: [f32; 4]) -> Texture {
    let mut bitmap = Bitmap::new(2, 1, Texels::Float(vec![left, right])).expect("two texels");
    bitmap.interpolation = Interpolation::Nearest;
    texture(Pattern::Bitmap(Arc::new(bitmap)))
}

fn squares(a: f64, b: f64, count: f64) -> Texture {
    let colours = [a, b].map(LaneValues::Uniform);
    Texture {
        pattern: Pattern::Checkerboard(colours),
        placement: Placement([[count, 0.0, 0.0], [0.0, count, 0.0]]),
    }
}

fn textured(name: &str, factor: f64, textures: Vec<Texture>) -> MaterialDescription {
    let reflectance = Varying {
        factor: LaneValues::Uniform(factor),
        textures,
    };
    MaterialDescription::new(name, MaterialModel::Lambertian { reflectance })
}

fn rgb(mut scene: SceneDescription) -> SceneDescription {
    scene.spectrum = SpectrumMode::Rgb;
    scene
}

/// Parallel light on a square of two halves: L = ρ(u)·E/π at every point, and the flux that leaves is the mean's.
#[test]
fn a_picture_reflects_point_by_point() {
    let picture = halves([0.2, 0.4, 0.6, 1.0], [0.8, 0.8, 0.8, 1.0]);
    let floor = square(2.0, 0.0).made_of("picture").named("floor");
    let mut scene = rgb(scene(
        [textured("picture", 0.5, vec![picture])],
        [floor],
        [directional(DOWN, 100.0)],
    ));
    let along = |x: f64| radiance_along(p(x, 0.3, 1.0), DOWN);
    scene.sensors = vec![
        sensor("left", along(-0.5)),
        sensor("right", along(0.5)),
        sensor("leaving", flux_of("floor", FluxOf::Leaving)),
        sensor("absorbed", flux_of("floor", FluxOf::Absorbed)),
    ];
    let found = measured(&scene, &samples(1 << 14));
    let luminous = |rgb: [f64; 3]| 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    let left = 0.5 * luminous([0.2, 0.4, 0.6].map(|x| f64::from(x as f32)));
    let radiance = |rho: f64| rho * 100.0 / PI;
    let check = |name: &str, expected: f64| {
        assert_agrees(
            name,
            &reading(&found, name).estimate,
            expected,
            1e-6 * expected,
        );
    };
    check("left", radiance(left));
    check("right", radiance(0.4));
    check("leaving", 400.0 * (left + 0.4) / 2.0);
    check("absorbed", 400.0 * (1.0 - (left + 0.4) / 2.0));
}

/// A floor of fine squares in a room is, for the walls, a floor of their mean; and squares agree with a picture of them.
#[test]
fn checkerboards_have_the_mean_of_their_squares_from_afar() {
    let light = |textures, factor| {
        let floor = square(2.0, 0.0).made_of("floor");
        let mut scene = rgb(scene(
            [textured("floor", factor, textures)],
            [floor],
            [directional(DOWN, 100.0)],
        ));
        let above = irradiance_at([(p(0.0, 0.0, 1.0), DOWN)]);
        scene.sensors = vec![sensor("above", above)];
        reading(&measured(&scene, &samples(1 << 18)), "above").estimate
    };
    let mean = light(vec![], 0.5);
    let texels = [[0.2_f32; 4], [0.8; 4], [0.8; 4], [0.2; 4]].map(|[r, g, b, _]| [r, g, b, 1.0]);
    let mut picture = Bitmap::new(2, 2, Texels::Float(texels.to_vec())).unwrap();
    picture.interpolation = Interpolation::Nearest;
    let repeated = Texture {
        pattern: Pattern::Bitmap(Arc::new(picture)),
        placement: Placement([[32.0, 0.0, 0.0], [0.0, 32.0, 0.0]]),
    };
    assert_same("squares", &light(vec![squares(0.2, 0.8, 64.0)], 1.0), &mean);
    assert_same("picture", &light(vec![repeated], 1.0), &mean);
}

/// A triangle whose corners are black, grey and white.
fn shaded_triangle() -> ShapeDescription {
    let mesh = MeshData {
        vertices: [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]]
            .map(Point::from)
            .to_vec(),
        triangles: vec![[0, 1, 2]],
        texture_coordinates: vec![],
        colors: vec![
            [0.0, 0.0, 0.0, 1.0],
            [0.3, 0.3, 0.3, 1.0],
            [0.9, 0.9, 0.9, 1.0],
        ],
        ..MeshData::default()
    };
    let mut shape = square(1.0, 0.0).made_of("painted");
    shape.geometry = GeometryDescription::Mesh(Arc::new(mesh));
    shape
}

#[test]
fn colours_of_vertices_are_interpolated() {
    let mut scene = rgb(scene(
        [textured(
            "painted",
            1.0,
            vec![texture(Pattern::VertexColor)],
        )],
        [shaded_triangle()],
        [directional(DOWN, 100.0)],
    ));
    scene.sensors = vec![sensor("ray", radiance_along(p(1.0, 0.5, 1.0), DOWN))];
    let found = reading(&measured(&scene, &samples(1 << 10)), "ray").estimate;
    // Weights 1/3 and 1/6 of the second and third corner.
    let expected = (0.3 / 3.0 + 0.9 / 6.0) * 100.0 / PI;
    assert_agrees("ray", &found, expected, 1e-6 * expected);
}

/// Grey pictures are the same in all modes.
#[test]
fn grey_pictures_agree_in_all_modes() {
    let modes = [
        SpectrumMode::Rgb,
        visible(),
        SpectrumMode::Spectral { range: VISIBLE },
    ];
    let [rgb, band, spectral] = modes.map(|mode| {
        let picture = halves([0.2, 0.2, 0.2, 1.0], [0.8, 0.8, 0.8, 1.0]);
        let mut scene = scene(
            [textured("picture", 1.0, vec![picture])],
            [square(2.0, 0.0).made_of("picture")],
            [directional_lux(DOWN, 1000.0)],
        );
        scene.spectrum = mode;
        let above = irradiance_at([(p(0.2, 0.0, 0.7), DOWN)]);
        scene.sensors = vec![sensor("above", above)];
        reading(&measured(&scene, &samples(1 << 16)), "above").estimate
    });
    assert_same("band", &rgb, &band);
    assert_same("spectral", &rgb, &spectral);
}

/// A panel whose left half glows: its rays, its flux, and the light of it, that of a panel of half the size.
#[test]
fn an_emission_may_vary_over_its_surface() {
    let glow = |textures: Vec<Texture>, mut panel: ShapeDescription| {
        panel.emission.as_mut().unwrap().textures = textures;
        let mut scene = rgb(scene(
            [lambertian("wall", 0.6)],
            [panel.named("panel"), square(6.0, 0.0).made_of("wall")],
            [],
        ));
        scene.sensors = vec![
            sensor("below", irradiance_at([(p(0.3, 0.1, 0.0), UP)])),
            sensor("bright", radiance_along(p(-0.5, 0.0, 0.0), UP)),
            sensor("leaving", flux_of("panel", FluxOf::Leaving)),
        ];
        measured(&scene, &samples(1 << 17))
    };
    // Edges are (0, 2, 0) and (2, 0, 0) on the side that faces down, so that v runs along x.
    let edges = [v(0.0, 2.0, 0.0), v(2.0, 0.0, 0.0)];
    let whole = rectangle(p(-1.0, -1.0, 1.0), edges).emitting(radiance(10.0));
    let half = rectangle(p(-1.0, -1.0, 1.0), [edges[0], v(1.0, 0.0, 0.0)]).emitting(radiance(10.0));
    let stripes = vec![Texture {
        placement: Placement([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]),
        ..halves([1.0; 4], [0.0, 0.0, 0.0, 1.0])
    }];
    let (textured, plain) = (glow(stripes, whole), glow(vec![], half));
    for name in ["below", "bright", "leaving"] {
        assert_same(
            name,
            &reading(&textured, name).estimate,
            &reading(&plain, name).estimate,
        );
    }
}

fn screen(opacity: Opacity) -> MaterialDescription {
    MaterialDescription {
        opacity: Some(opacity),
        ..lambertian("screen", 0.0)
    }
}

fn half_open() -> Opacity {
    Opacity {
        factor: 0.25,
        textures: vec![],
        cutoff: None,
    }
}

/// Light behind two black screens of opacity α arrives as (1 − α)²: of a lamp and the sun without error, of a panel and the
/// sky within theirs, along rays and in a picture's pixels alike.
#[test]
fn screens_let_a_part_pass_undeviated() {
    let lights = || {
        [
            point_light(p(0.2, 0.0, 2.0), intensity(10.0)),
            directional(v(0.3, 0.0, -1.0), 5.0),
            environment(3.0),
        ]
    };
    let scene_with = |material: MaterialDescription, screens: usize| {
        let mut shapes = vec![square_facing_down(1.0, 3.0).emitting(radiance(20.0))];
        for screen in 0..screens {
            shapes.push(square(400.0, 0.5 + 0.5 * screen as f64).made_of("screen"));
        }
        let mut scene = scene([material], shapes, lights());
        let at = irradiance_at([(p(0.1, 0.2, 0.0), UP)]);
        scene.sensors = vec![
            sensor("all", at),
            sensor("ray", radiance_along(p(0.0, 0.0, 0.0), UP)),
            sensor("sky", radiance_along(p(0.0, 0.0, 0.0), v(1.0, 0.0, 1.0))),
        ];
        measured(&scene, &samples(1 << 17))
    };
    let clear = scene_with(lambertian("screen", 0.0), 0);
    let dim = scene_with(screen(half_open()), 2);
    for name in ["all", "ray", "sky"] {
        let (mut clear, dim) = (reading(&clear, name).estimate, reading(&dim, name).estimate);
        clear.value *= 0.5625;
        clear.std_error *= 0.5625;
        // Screens of 400 m miss a sky of 4e-6 of the hemisphere.
        clear.std_error += 1e-5 * clear.value;
        assert_same(name, &dim, &clear);
    }
}

/// A mask with a hole: a lamp's light is there or not, and a closed form either way.
#[test]
fn a_mask_is_there_or_not() {
    let holes = halves([1.0, 1.0, 1.0, 0.4], [1.0, 1.0, 1.0, 0.6]);
    let mask = Opacity {
        factor: 1.0,
        textures: vec![holes],
        cutoff: Some(0.5),
    };
    let mut scene = scene(
        [screen(mask)],
        [square(2.0, 1.0).made_of("screen")],
        [directional(DOWN, 100.0)],
    );
    scene.sensors = vec![
        sensor("open", irradiance_at([(p(-0.5, 0.0, 0.0), UP)])),
        sensor("shut", irradiance_at([(p(0.5, 0.0, 0.0), UP)])),
    ];
    let found = measured(&scene, &samples(1 << 10));
    for (name, expected) in [("open", 100.0), ("shut", 0.0)] {
        let estimate = reading(&found, name).estimate;
        assert_eq!(
            (estimate.value, estimate.method),
            (expected, Method::ClosedForm),
            "{name}"
        );
    }
}

/// What a net counts on a surface that lets light pass is what arrives less what is reflected.
#[test]
fn a_half_open_surface_reflects_and_absorbs_in_part() {
    let half = MaterialDescription {
        opacity: Some(half_open()),
        ..lambertian("half", 0.6)
    };
    let mut scene = scene(
        [half],
        [square(2.0, 1.0).made_of("half").named("net")],
        [directional(DOWN, 100.0)],
    );
    let of = |of| flux_of("net", of);
    scene.sensors = vec![
        sensor("incident", of(FluxOf::Incident)),
        sensor("leaving", of(FluxOf::Leaving)),
        sensor("absorbed", of(FluxOf::Absorbed)),
        sensor("net", of(FluxOf::Net)),
    ];
    let found = measured(&scene, &samples(1 << 12));
    for (name, part) in [
        ("incident", 1.0),
        ("leaving", 0.25 * 0.6),
        ("absorbed", 0.25 * 0.4),
        ("net", 1.0 - 0.25 * 0.6),
    ] {
        let expected = 400.0 * part;
        let estimate = reading(&found, name).estimate;
        assert_agrees(name, &estimate, expected, 1e-6 * expected);
    }
}

/// Coloured pictures say nothing about bands and infrared, and nothing reflects more than it receives.
#[test]
fn pictures_that_cannot_be_told_are_refused() {
    let refused = |mode: SpectrumMode, texel: [f32; 4]| {
        let picture = halves(texel, [0.5, 0.5, 0.5, 1.0]);
        let mut scene = scene(
            [textured("picture", 1.0, vec![picture])],
            [square(2.0, 0.0).made_of("picture")],
            [directional(DOWN, 100.0)],
        );
        scene.spectrum = mode;
        scene.sensors = vec![sensor("above", irradiance_at([(p(0.0, 0.0, 1.0), DOWN)]))];
        let problems = steradian::scene::Scene::new(&scene).err();
        problems
            .map(|problems| problems[0].message.clone())
            .unwrap_or_default()
    };
    let (colour, grey) = ([0.9, 0.1, 0.1, 1.0], [0.2, 0.2, 0.2, 1.0]);
    assert!(refused(visible(), colour).contains("bands know grey only"));
    assert_eq!(refused(visible(), grey), "");
    let infrared = SpectrumMode::Spectral {
        range: [360.0, 1000.0],
    };
    assert!(refused(infrared, grey).contains("outside 360 to 830 nm"));
    assert!(refused(SpectrumMode::Rgb, [1.5, 1.0, 1.0, 1.0]).contains("texel 0 is [1.5"));
}
