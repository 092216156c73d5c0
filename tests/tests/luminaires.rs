//! Luminaires as lights: against another program, closed forms, quadrature and their own flux.

use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

use steradian::geometry::{Direction, Point, Vector};
use steradian::light::{FarField, Opening, Planes};
use steradian::scene::description::{FluxOf, LightDescription, SceneDescription, SensorKind};
use steradian::transport::MeasureOptions;
use steradian_io::files::DiskFiles;
use steradian_io::import::photometry;
use steradian_kernel::InstructionSet;
use steradian_tests::luminaires::{folder, hanging, on_the_floor, scene_of, turned};
use steradian_tests::measuring::{measured, reading, rel_error, samples};
use steradian_tests::scenes::*;
use steradian_tests::{assert_agrees, assert_close};

fn values(scene: &SceneDescription, options: &MeasureOptions) -> Vec<f64> {
    let readings = measured(scene, options).readings();
    readings
        .iter()
        .map(|reading| reading.estimate.value)
        .collect()
}

/// Light that grows towards C0 and fades to the horizon, so that no axis can be mistaken for another.
fn fading() -> Arc<FarField> {
    let azimuths: Vec<f64> = (0..=24).map(|k| 15.0 * f64::from(k)).collect();
    let polars: Vec<f64> = (0..=36).map(|k| 5.0 * f64::from(k)).collect();
    let intensity = |c: f64, gamma: f64| {
        let (c, gamma) = (c.to_radians(), gamma.to_radians());
        let down = 1000.0 * libm::cos(gamma).max(0.0);
        let up = 300.0 * (-libm::cos(gamma)).max(0.0);
        (down + up) * (1.0 + 0.5 * libm::cos(c) + 0.2 * libm::sin(c))
    };
    let azimuth = |c: &f64| polars.iter().map(|gamma| intensity(*c, *gamma)).collect();
    let values: Vec<Vec<f64>> = azimuths.iter().map(azimuth).collect();
    let table = FarField::new(Planes::C, &azimuths, &polars, &values.concat());
    Arc::new(table.expect("a table of whole angles"))
}

const OPENINGS: [Opening; 8] = [
    Opening::Point,
    Opening::Box {
        width: 0.6,
        length: 1.2,
        height: 0.0,
    },
    Opening::Box {
        width: 0.2,
        length: 0.5,
        height: 0.1,
    },
    Opening::Upright {
        width: 0.4,
        length: 0.4,
        height: 0.0,
    },
    Opening::Upright {
        width: 0.3,
        length: 0.5,
        height: 0.0,
    },
    Opening::Upright {
        width: 0.3,
        length: 0.5,
        height: 0.2,
    },
    Opening::Lying {
        along_c0: false,
        length: 1.0,
        diameter: 0.05,
    },
    Opening::Ellipsoid {
        diameters: [0.3, 0.3, 0.3],
    },
];

/// The lamps as points to the digits of the list, and with their openings, which Radiance spreads light over, too, as it does.
/// Radiance's own numbers are up to .33 % off the far field where the opening is a box. An opening blunts a cusp of the table: that of the
/// flood of LM-63's own example, 1.3 to 2 per rad steep at γ = 0, by .5 % at 20 m, with points 63 mm off its centre in the mean. Another file is
/// .66 % off there for what [`an_opening_shows_the_mean_of_what_a_file_says_at_its_pole`] explains.
#[test]
fn illuminances_are_those_of_radiance() {
    let text = std::fs::read_to_string(folder().join("radiance_direct_lux.json")).unwrap();
    let cases: serde_json::Value = serde_json::from_str(&text).unwrap();
    let cases = cases["files"].as_object().unwrap();
    assert_eq!(cases.len(), 7);
    for (file, case) in cases {
        let points: Vec<[f64; 2]> = serde_json::from_value(case["points"].clone()).unwrap();
        let (kind, unit) = match case["units"].as_str() {
            Some("lux") => ("illuminance", 1.0),
            _ => ("irradiance", 1e-3),
        };
        let told = |key: &str| -> Vec<f64> { serde_json::from_value(case[key].clone()).unwrap() };
        let floor = on_the_floor(kind, &points);
        let found = |emit: &str, options: &MeasureOptions| {
            let lamp = format!("file = {file:?}\nposition = [0, 0, 20]\n{emit}");
            let scene = scene_of(&format!(
                "[[lights]]\nkind = \"luminaire\"\n{lamp}\n{floor}"
            ));
            values(&scene, options)
        };
        let exact = found("emit = \"point\"", &samples(1));
        let opening = found("", &rel_error(1e-3));
        for (k, place) in points.iter().enumerate() {
            let [far, radiance] = ["far_field", "radiance_lux"].map(|key| unit * told(key)[k]);
            // The list is rounded at the sixth decimal.
            assert_close(file, exact[k], far, 1e-6 * unit + 1e-5 * far);
            for (value, most) in [(exact[k], 5e-3), (opening[k], 1e-2)] {
                let off = (value / radiance - 1.0).abs();
                assert!(off < most, "{file} {place:?}: {value} {radiance}");
            }
        }
    }
}

/// At γ = 0 this file has an intensity for each half plane, 124.0 to 126.6 mW/sr. A point shows that of C0; an opening, however small, shows each point of the floor
/// all of them, E = ∫ I(d) cosθ/(A r²) dA: .66 % less in the nadir. Of an opening of a tenth of the size it is .65 %. The sum over 64 × 64 cells is right to
/// 10⁻⁵, and five standard errors fail once in 10⁴ seeds; the seed is fixed.
#[test]
fn an_opening_shows_the_mean_of_what_a_file_says_at_its_pole() {
    let file = "uv_sterilray.ies";
    let path = folder().join(file);
    let far_field = photometry::read(&path, &DiskFiles::default())
        .unwrap()
        .far_field;
    let [along_c0, along_c90] = [0.05, 0.3];
    let centre = |k: i32| (f64::from(k) + 0.5) / 64.0 - 0.5;
    let from = |k: i32| {
        let [x, y] = [along_c0 * centre(k % 64), along_c90 * centre(k / 64)];
        let distance = (x * x + y * y + 400.0).sqrt();
        let towards = Direction::new(Vector::new(-x, -y, -20.0)).expect("a length above 20");
        far_field.intensity(towards) * 20.0 / (distance * distance * distance)
    };
    let expected = 1e-3 * (0..64 * 64).map(from).sum::<f64>() / 4096.0;
    let lamp = format!("kind = \"luminaire\"\nfile = {file:?}\nposition = [0, 0, 20]");
    let scene = format!(
        "[[lights]]\n{lamp}\n{}",
        on_the_floor("irradiance", &[[0.0; 2]])
    );
    let found = measured(&scene_of(&scene), &rel_error(5e-4)).readings()[0].estimate;
    let off = (found.value - expected).abs();
    assert!(
        off < 5.0 * found.std_error + 1e-5 * expected,
        "{found:?} {expected}"
    );
    let at_c0 = 1e-3 * far_field.at_angles(0.0, 0.0) / 400.0;
    assert_close("of the point", expected / at_c0 - 1.0, -0.0066, 1e-4);
}

/// E at the centre of a wall or floor that faces the lamp, from 10 m, where the ray has the cosine `cos`: I cos³/100.
fn faced(file: &str, keys: &str, [x, y]: [f64; 2]) -> f64 {
    let lamp =
        format!("kind = \"luminaire\"\nemit = \"point\"\nfile = {file:?}\nposition = [0, 0, 10]");
    let text = format!(
        "[[lights]]\n{lamp}\n{keys}\n{}",
        on_the_floor("illuminance", &[[x, y]])
    );
    values(&scene_of(&text), &samples(1))[0] * (100.0 + x * x + y * y)
        / libm::cos(libm::atan(libm::hypot(x, y) / 10.0))
}

/// Nodes of tables that were written with nine digits.
#[test]
fn intensities_of_each_system_are_found_where_they_belong() {
    let tan = |degrees: f64| 10.0 * libm::tan(degrees.to_radians());
    let cos = |degrees: f64| libm::cos(degrees.to_radians());
    let cosine = |degrees: f64, c: f64| 500.0 * cos(degrees) * (1.0 + 0.5 * cos(c));
    for (c, [x, y]) in [
        (0.0, [1.0, 0.0]),
        (90.0, [0.0, 1.0]),
        (180.0, [-1.0, 0.0]),
        (270.0, [0.0, -1.0]),
    ] {
        for file in ["asymmetric_full360.ies", "asymmetric_bilateral180.ies"] {
            let found = faced(file, "", [x * tan(30.0), y * tan(30.0)]);
            assert_close(file, found, cosine(30.0, c), 1e-5);
        }
    }
    // Type A: X to the side of C0, Y towards C90.
    let (x, y) = (tan(12.0), 10.0 * libm::tan(9_f64.to_radians()) / cos(12.0));
    let expected = 1e4 * libm::pow(cos(12.0), 20.0) * libm::pow(cos(9.0), 8.0);
    for [x, y] in [[x, y], [-x, y], [x, -y]] {
        assert_close(
            "type A",
            faced("headlamp_typeA.ies", "", [x, y]),
            expected,
            1e-4,
        );
    }
    // Type B: H to the side of C0, V towards C90.
    let (x, y) = (10.0 * libm::tan(9_f64.to_radians()) / cos(12.0), tan(12.0));
    let expected = 1e4 * libm::pow(cos(9.0), 20.0) * libm::pow(cos(12.0), 8.0);
    for [x, y] in [[x, y], [-x, y], [x, -y]] {
        assert_close(
            "type B",
            faced("floodlight_typeB_symmetric.ies", "", [x, y]),
            expected,
            1e-4,
        );
    }
}

/// I = 500 cosγ (1 + ½ cos C): stronger towards C0. With C0 towards +y the floor at γ = 30° in +y has 1.5 times the light.
#[test]
fn a_luminaire_turns_with_its_aim_and_c0() {
    let reach = 10.0 * libm::tan(PI / 6.0);
    let cos = libm::cos(PI / 6.0);
    let found = faced("asymmetric_full360.ies", "c0 = [0, 1, 0]", [0.0, reach]);
    assert_close("C0 to +y", found, 750.0 * cos, 1e-5);
    // Tilted by 30° towards +x: straight below is γ = 30° in C180.
    let tilted = "aim = [0.5, 0, -0.8660254037844386]";
    let found = faced("asymmetric_full360.ies", tilted, [0.0, 0.0]);
    assert_close("tilted", found, 250.0 * cos, 1e-5);
}

/// Dimming, maintenance and a stated flux multiply: 3000 lm of a lamp of 500π lm, 6/π of its intensities; half of it, and .8 of that.
#[test]
fn what_a_luminaire_gives_is_scaled() {
    let plain = faced("lambert_1000cd_1deg.ies", "", [0.0, 0.0]);
    assert_close("plain", plain, 1000.0, 1e-9);
    let dimmed = faced(
        "lambert_1000cd_1deg.ies",
        "dimming = 0.5\nmaintenance_factor = 0.8",
        [0.0, 0.0],
    );
    assert_close("dimmed", dimmed, 400.0, 1e-9);
    // The table's own flux is 3e-5 off 1000π.
    let flux = faced(
        "lambert_1000cd_1deg.ies",
        "flux = \"3141.592653589793 lm\"\ndimming = 0.5",
        [0.0, 0.0],
    );
    assert_close("flux", flux, 500.0, 0.02);
}

fn sphere_around(
    lights: Vec<LightDescription>,
    shapes: Vec<steradian::scene::description::ShapeDescription>,
) -> SceneDescription {
    let mut scene = scene([], shapes, lights);
    scene.spectrum = visible();
    scene
        .shapes
        .push(hollow_sphere(Point::ORIGIN, 2.0, &[]).named("wall"));
    scene.sensors = vec![sensor("flux", flux_of("wall", FluxOf::Incident))];
    scene
}

/// A closed black sphere catches the flux of every kind of light: those of area are told by their description, those of points are
/// integrals. Of 2¹⁸ quasi-random samples the mean is .17 % off at most, for bodies of facets that are seen at different angles.
#[test]
fn the_flux_of_every_light_arrives() {
    let at = p(0.3, -0.2, 0.4);
    let table = fading();
    let lumens = |scene: &SceneDescription| {
        let reading = reading(&measured(scene, &samples(1 << 18)), "flux");
        reading.estimate.value
    };
    let mut cases = vec![
        (
            "point",
            sphere_around(vec![point_light(at, luminous_flux(1000.0))], vec![]),
            1000.0,
        ),
        (
            "spot",
            sphere_around(
                vec![spot(
                    at,
                    v(0.2, 0.3, -1.0),
                    cosine_beam(3.0),
                    luminous_flux(1000.0),
                )],
                vec![],
            ),
            1000.0,
        ),
        (
            "even spot",
            sphere_around(
                vec![spot(
                    at,
                    v(0.2, 0.3, -1.0),
                    even_beam(40.0),
                    luminous_flux(1000.0),
                )],
                vec![],
            ),
            1000.0,
        ),
        (
            "area",
            sphere_around(
                vec![],
                vec![square(0.5, 0.3).emitting(emitted_lumens(1000.0))],
            ),
            1000.0,
        ),
        (
            "ball",
            sphere_around(vec![], vec![ball(at, 0.2).emitting(emitted_lumens(1000.0))]),
            1000.0,
        ),
    ];
    for opening in &OPENINGS {
        let axes = [v(0.3, 0.1, -1.0), v(0.0, 1.0, 0.0)];
        let lamp = turned(at, &table, *opening, axes);
        cases.push(("luminaire", sphere_around(vec![lamp], vec![]), table.flux()));
    }
    for (what, scene, expected) in cases {
        let found = lumens(&scene);
        let kind = scene.lights.first().map(|light| &light.kind);
        assert!(
            (found / expected - 1.0).abs() < 2e-3,
            "{what} {kind:?}: {found} {expected}"
        );
    }
}

/// Twelve tubes in a ring, of which a place chooses single facets, light the floor as one after the other does, of which it does not.
#[test]
fn many_openings_light_as_each_does() {
    let (table, tube) = (fading(), OPENINGS[6]);
    let lamp = |k: i32| {
        let (sin, cos) = libm::sincos(PI / 6.0 * f64::from(k));
        hanging(p(2.0 * cos, 2.0 * sin, 1.5), &table, tube)
    };
    let under = |lamps: Vec<LightDescription>| {
        let floor = square(8.0, 0.0).made_of("grey");
        let mut scene = scene([lambertian("grey", 0.5)], [floor], lamps);
        scene.spectrum = visible();
        let places = [p(0.0, 0.0, 0.0), p(1.3, 0.4, 0.0)];
        let rays = places.map(|place| (place + v(0.05, 0.0, 0.2), v(-0.05, 0.0, -0.2)));
        let points = places.map(|place| (place, UP));
        scene.sensors = vec![
            sensor("direct", irradiance_at(points)),
            sensor(
                "seen",
                SensorKind::Radiance {
                    rays: rays.to_vec(),
                },
            ),
        ];
        measured(&scene, &samples(1 << 16)).readings()
    };
    let single: Vec<_> = (0..12).map(|k| under(vec![lamp(k)])).collect();
    for (k, all) in under((0..12).map(lamp).collect()).iter().enumerate() {
        let sum: f64 = single.iter().map(|found| found[k].estimate.value).sum();
        let squares = single.iter().map(|found| found[k].estimate.std_error);
        let error: f64 = squares.map(|error| error * error).sum::<f64>().sqrt();
        assert!(all.estimate.std_error < 5e-3 * sum, "{all:?}");
        assert_agrees("twelve lamps", &all.estimate, sum, 4.0 * error);
    }
}

/// E = (1/A) ∫ I(d) cosθ/r² dA by the midpoint rule of 400 × 200 cells, whose error is below 1e-5 from .3 m.
fn near_field(table: &FarField, height: f64, [x, y]: [f64; 2]) -> f64 {
    let (columns, rows) = (400, 200);
    let mut sum = 0.0;
    for i in 0..columns {
        for j in 0..rows {
            let a = 1.2 * ((f64::from(i) + 0.5) / f64::from(columns) - 0.5);
            let b = 0.6 * ((f64::from(j) + 0.5) / f64::from(rows) - 0.5);
            let away = Vector::new(x - a, y - b, -height);
            let squared = away.dot(away);
            let direction = Direction::new(away).expect("the desk is below");
            sum += table.intensity(direction) * (height / squared.sqrt()) / squared;
        }
    }
    sum / f64::from(columns * rows)
}

/// What a desk close below receives, and what a diffuse floor throws back of it, which paths find both by light samples and by chance.
#[test]
fn close_to_an_opening_illuminance_is_its_integral() {
    let table = fading();
    for height in [0.3, 1.0] {
        let lamp = hanging(p(0.0, 0.0, height), &table, OPENINGS[1]);
        let places = [[0.0, 0.0], [0.5, 0.2], [-0.9, 0.4]];
        let mut scene = scene(
            [lambertian("grey", 0.5)],
            [square(8.0, 0.0).made_of("grey")],
            [lamp],
        );
        scene.spectrum = visible();
        let points: Vec<_> = places.map(|[x, y]| (p(x, y, 0.0), UP)).to_vec();
        scene.sensors = vec![sensor("direct", irradiance_at(points))];
        // From aside, below the opening.
        let ray = |[x, y]: [f64; 2]| {
            let from = p(x + 0.2, y, 0.2);
            (from, p(x, y, 0.0) - from)
        };
        let rays = places.map(ray).to_vec();
        scene
            .sensors
            .push(sensor("seen", SensorKind::Radiance { rays }));
        let found = measured(&scene, &rel_error(2e-3)).readings();
        for (k, place) in places.into_iter().enumerate() {
            let lux = near_field(&table, height, place);
            for (value, expected) in [(&found[k], lux), (&found[3 + k], 0.5 / PI * lux)] {
                let what = format!("{height} m {place:?}");
                assert_agrees(&what, &value.estimate, expected, 1e-4 * expected);
            }
        }
    }
}

/// An opening in the plane of a ceiling is there for rays and for light: E on the floor is that of the free lamp, a ray from below sees
/// I/A_p, and so does one by a mirror, whose image is as far above the floor.
#[test]
fn a_recessed_luminaire_is_not_lost_in_the_ceiling() {
    let table = fading();
    let (height, ceiling) = (2.8, square_facing_down(6.0, 2.8).made_of("white"));
    let free = |opening, shapes: Vec<_>| {
        let lamp = hanging(p(0.0, 0.0, height), &table, opening);
        let mut scene = scene(
            [lambertian("white", 0.8), mirror("glass", 0.9)],
            shapes,
            [lamp],
        );
        scene.spectrum = visible();
        let points: Vec<_> = [[0.0, 0.0], [1.0, 0.5], [-2.0, 1.0]]
            .map(|[x, y]| (p(x, y, 0.0), UP))
            .to_vec();
        scene.sensors = vec![sensor("floor", irradiance_at(points))];
        scene
    };
    for opening in [OPENINGS[0], OPENINGS[1], OPENINGS[3], OPENINGS[4]] {
        let found = [vec![], vec![ceiling.clone()]].map(|shapes| {
            let scene = free(opening, shapes);
            measured(&scene, &rel_error(1e-3)).readings()
        });
        for (free, recessed) in found[0].iter().zip(&found[1]) {
            let (free, recessed) = (&free.estimate, &recessed.estimate);
            assert!(
                (recessed.value / free.value - 1.0).abs() < 3e-3,
                "{opening:?} {recessed:?} {free:?}"
            );
        }
    }
    let mut seen = free(
        OPENINGS[1],
        vec![ceiling, square(6.0, 0.0).made_of("glass")],
    );
    let aside = v(0.4, 0.1, 1.0);
    let below = p(-0.4 * 2.0, -0.1 * 2.0, 0.8);
    let by_mirror = p(-0.4 * 2.8, -0.1 * 2.8, 0.0) - v(0.4, 0.1, -1.0);
    seen.sensors = vec![
        sensor("direct", radiance_along(below, aside)),
        sensor("mirrored", radiance_along(by_mirror, v(0.4, 0.1, -1.0))),
    ];
    let found = measured(&seen, &samples(4096)).readings();
    let away = Direction::new(-aside).unwrap();
    let luminance = table.intensity(away) / (0.72 * -away.z());
    assert_close(
        "direct",
        found[0].estimate.value,
        luminance,
        1e-6 * luminance,
    );
    let mirrored = found[1].estimate.value;
    assert_close("mirrored", mirrored, 0.9 * luminance, 1e-5 * luminance);
}

/// What the header of the scene derives.
#[test]
fn the_shipped_luminaire_gives_what_its_header_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/luminaire.toml");
    let loaded = steradian_io::scene_file::read_scene(&path, &DiskFiles::default());
    let Ok(loaded) = loaded else {
        panic!("{loaded:?}")
    };
    let found = measured(&loaded.description, &rel_error(1e-3)).readings();
    // The second by quadrature of the definition.
    for (reading, expected) in found.iter().zip([242.73, 158.44]) {
        assert_agrees("floor", &reading.estimate, expected, 2e-4 * expected);
    }
}

/// Threads and instruction sets change no bit.
#[test]
fn openings_change_no_bit() {
    let table = fading();
    let lamps = OPENINGS
        .iter()
        .enumerate()
        .map(|(k, opening)| hanging(p(0.7 * k as f64 + 0.5, 1.0, 2.0), &table, *opening));
    let mut scene = scene(
        [lambertian("grey", 0.5)],
        [room(p(7.0, 2.0, 2.5)).made_of("grey")],
        lamps.collect::<Vec<_>>(),
    );
    scene.spectrum = visible();
    scene.sensors = vec![sensor("floor", irradiance_at([(p(3.0, 1.0, 0.0), UP)]))];
    let alone = measured(&scene, &samples(2_000));
    let mut many = samples(2_000);
    many.plan.threads = 5;
    assert_eq!(alone, measured(&scene, &many));
    for instruction_set in InstructionSet::available() {
        let other = MeasureOptions {
            instruction_set,
            ..samples(2_000)
        };
        assert_eq!(alone, measured(&scene, &other), "{instruction_set:?}");
    }
}

/// In a closed white room all light that is given is absorbed: half of all that arrives at the walls, but for what the black opening takes.
#[test]
fn light_between_walls_keeps_its_energy() {
    let table = fading();
    let mut scene = scene(
        [lambertian("grey", 0.5)],
        [hollow_sphere(Point::ORIGIN, 2.0, &[])
            .made_of("grey")
            .named("wall")],
        [hanging(Point::ORIGIN, &table, OPENINGS[7])],
    );
    scene.spectrum = visible();
    scene.sensors = vec![sensor("absorbed", flux_of("wall", FluxOf::Absorbed))];
    let found = reading(&measured(&scene, &rel_error(2e-3)), "absorbed").estimate;
    // After the first reflection light is even: a share f = (r/R)² of what each wall throws meets the ball.
    let share = libm::pow(0.15 / 2.0, 2.0);
    let kept = 0.5 / (1.0 - 0.5 * (1.0 - share));
    assert!(
        (found.value / (table.flux() * kept) - 1.0).abs() < 4e-3,
        "{found:?}"
    );
}
