//! Readings of what polished surfaces throw: at points that see none of them, and of fluxes, which lack nothing.

use std::f64::consts::PI;

use steradian::brdf::Pane;
use steradian::estimation::{Plan, Stopping};
use steradian::measurement::Measurements;
use steradian::scene::description::{FluxSurface, LightKind, Receivers, Side};
use steradian::sensor::FluxOf;
use steradian::transport::MeasureOptions;
use steradian_kernel::InstructionSet;
use steradian_tests::measuring::{measured, reading, rel_error, samples};
use steradian_tests::{assert_agrees, assert_same};

use super::glass::{SLAB, lamp_in_glass, slab};
use super::*;

const LAMP: f64 = 5.0;

fn lamp() -> LightDescription {
    point_light(p(0.0, 0.0, 2.0), intensity(LAMP))
}

fn image() -> LightDescription {
    point_light(p(-2.0, 0.0, 2.0), intensity(LAMP * MIRROR))
}

/// A wide floor before a mirror at x = −1, and a black wall at x = ½ that is 1.2 m high.
fn before_a_mirror(floor: f64, width: f64, height: f64) -> SceneDescription {
    let upright = |x: f64, width: f64, height: f64| {
        let edges = [v(0.0, width, 0.0), v(0.0, 0.0, height)];
        rectangle(p(x, -0.5 * width, 0.0), edges)
    };
    let shapes = [
        square(60.0, 0.0).made_of("floor"),
        upright(0.5, 60.0, 1.2),
        upright(-1.0, width, height).made_of("mirror"),
    ];
    let materials = [lambertian("floor", floor), mirror("mirror", MIRROR)];
    scene(materials, shapes, [lamp()])
}

/// With the lamp's image as a lamp instead of the mirror.
fn imagined(mut scene: SceneDescription) -> SceneDescription {
    let is_mirror = |shape: &_| matches!(shape, Some(name) if name == "mirror");
    scene.shapes.retain(|shape| !is_mirror(&shape.material));
    scene.lights.push(image());
    scene
}

fn within(max_depth: u32, count: u64) -> MeasureOptions {
    MeasureOptions {
        max_depth: Some(max_depth),
        ..samples(count)
    }
}

fn assert_like_the_image(scene: &SceneDescription, options: &MeasureOptions) {
    let seen = measured(scene, options);
    let truth = measured(&imagined(scene.clone()), options);
    for sensor in &scene.sensors {
        let [seen, truth] = [&seen, &truth].map(|all| reading(all, &sensor.name).estimate);
        assert_same(&sensor.name, &seen, &truth);
        assert!(
            truth.value != 0.0 && seen.std_error < 0.05 * seen.value.abs(),
            "{seen:?}"
        );
    }
}

/// Behind the wall, from where no part of the mirror is seen, which is 15 m high, the floor is what lights, and the mirror lights much of it.
fn behind_the_wall() -> SceneDescription {
    let at = p(0.6, 0.0, 0.1);
    let cylinder = |facing| SensorKind::Cylindrical {
        receivers: Receivers::Points(vec![(at, UP)]),
        facing,
    };
    let mut scene = before_a_mirror(0.5, 60.0, 15.0);
    scene.sensors = vec![
        sensor("plane", irradiance_at([(at, v(1.0, 0.0, 0.0))])),
        sensor("tilted", irradiance_at([(at, v(1.0, 1.0, -1.0))])),
        sensor("sphere", scalar_irradiance_at(at)),
        sensor("cylinder", cylinder(None)),
        sensor("half", cylinder(Some(v(1.0, 0.0, 0.0)))),
    ];
    scene
}

/// Three segments: light that comes back from the floor by way of the mirror has more.
#[test]
fn points_have_what_a_mirror_throws_on_other_surfaces() {
    assert_like_the_image(&behind_the_wall(), &within(3, 1 << 17));
}

/// The floor is black; all that the mirror throws on the targets would come from the image of the lamp.
fn fluxes_before_a_mirror() -> SceneDescription {
    let target = || disc(p(3.0, 0.2, 0.4), v(-0.5, 0.1, 1.0), 0.4);
    let through = |of| match flux_through(target()) {
        SensorKind::Flux { surface, .. } => SensorKind::Flux { surface, of },
        other => other,
    };
    // In the plane of the floor, which stops what passes.
    let on_the_floor = flux_through(disc(p(4.6, 0.8, 0.0), UP, 0.4));
    let mut scene = before_a_mirror(0.0, 2.0, 2.5);
    let patch = rectangle(p(4.1, -1.4, 0.3), [v(0.8, 0.0, 0.0), v(0.0, 0.8, 0.0)]);
    scene.shapes.push(patch.named("patch").made_of("grey"));
    scene.materials.push(lambertian("grey", 0.3));
    scene.sensors = vec![
        sensor("through", through(FluxOf::Incident)),
        sensor("on the floor", on_the_floor),
        sensor("net through", through(FluxOf::Net)),
        sensor("incident", flux_of("patch", FluxOf::Incident)),
        sensor("absorbed", flux_of("patch", FluxOf::Absorbed)),
        sensor("leaving", flux_of("patch", FluxOf::Leaving)),
        sensor("net", flux_of("patch", FluxOf::Net)),
    ];
    scene
}

#[test]
fn fluxes_have_what_a_mirror_throws() {
    let scene = fluxes_before_a_mirror();
    assert_like_the_image(&scene, &within(2, 1 << 14));
    let all = measured(&scene, &within(2, 16));
    assert!(all.complete(), "{:?}", all.unsampled);
}

/// Each light group, of lamps at two places, and each of two bands has what its own image would bring.
#[test]
fn groups_and_bands_keep_their_light() {
    let of_group = |mut light: LightDescription, group: &str| {
        light.group = Some(group.into());
        light
    };
    let at = |x: f64| of_group(point_light(p(x, 0.4, 1.8), intensity(2.0 * LAMP)), "b");
    let mut scene = fluxes_before_a_mirror();
    scene.spectrum = visible();
    scene.sensors.truncate(1);
    scene.lights = vec![of_group(lamp(), "a"), at(0.0)];
    let mut truth = imagined(scene.clone());
    truth.lights.pop();
    let dimmer = |mut light: LightDescription, power| {
        if let LightKind::Point { power: own, .. } = &mut light.kind {
            *own = power;
        }
        light
    };
    truth.lights.push(of_group(image(), "a"));
    truth
        .lights
        .push(dimmer(at(-2.0), intensity(2.0 * LAMP * MIRROR)));
    let options = within(2, 1 << 14);
    let [seen, truth] =
        [&scene, &truth].map(|scene| reading(&measured(scene, &options), "through"));
    assert_eq!(seen.groups.len(), 2);
    for ((name, seen), (_, truth)) in seen.groups.iter().zip(&truth.groups) {
        assert_same(name, seen, truth);
        assert!(seen.std_error < 0.03 * seen.value, "{name}: {seen:?}");
    }
}

/// A run to a tolerance ends with an interval that is as narrow and holds the truth.
#[test]
fn fluxes_are_found_to_a_tolerance() {
    let mut scene = fluxes_before_a_mirror();
    scene.sensors.truncate(1);
    let options = MeasureOptions {
        max_depth: Some(2),
        ..rel_error(0.02)
    };
    let [seen, truth] = [scene.clone(), imagined(scene)]
        .map(|scene| reading(&measured(&scene, &options), "through").estimate);
    assert_same("through", &seen, &truth);
    let [low, high] = seen.interval.unwrap();
    assert!(seen.converged && high - low < 0.04 * seen.value, "{seen:?}");
}

/// Parallel light of 1000 W/m² falls straight on a pane of 4 m²: R goes back, T on, and the rest stays. With n = 1 nothing goes back.
#[test]
fn what_a_pane_does_with_a_sun_is_in_closed_form() {
    for ior in [1.0, 1.5] {
        let (reflected, passed) = Pane::new(ior, [0.7; 4]).unwrap().shares(1.0)[0];
        let panes = modelled("glass", pane_of(ior, 0.7));
        let shape = square(2.0, 0.0).named("pane").made_of("glass");
        let mut scene = scene([panes], [shape], [directional(DOWN, 1000.0)]);
        let expected = [
            (Side::Front, FluxOf::Leaving, reflected),
            (Side::Front, FluxOf::Net, 1.0 - reflected),
            (Side::Front, FluxOf::Absorbed, 1.0 - reflected - passed),
            (Side::Back, FluxOf::Leaving, passed),
            (Side::Back, FluxOf::Net, -passed),
        ];
        let meter = |(side, of, _): &(Side, FluxOf, f64)| {
            let surface = FluxSurface::Shape {
                name: "pane".into(),
                side: *side,
            };
            sensor(
                &format!("{side:?} {of:?}"),
                SensorKind::Flux { surface, of: *of },
            )
        };
        scene.sensors = expected.iter().map(meter).collect();
        let found = measured(&scene, &samples(1 << 12));
        assert!(found.complete(), "{:?}", found.unsampled);
        for (sensor, (_, _, part)) in scene.sensors.iter().zip(expected) {
            let seen = reading(&found, &sensor.name).estimate;
            assert_agrees(&sensor.name, &seen, 4000.0 * part, 0.1);
            assert!(part == 0.0 || seen.std_error < 100.0, "{seen:?}");
        }
    }
}

/// What a mirror throws is missing from paths of fewer segments: two to a surface, three to a point.
#[test]
fn the_longest_path_counts_from_the_light() {
    for (scene, depth) in [(fluxes_before_a_mirror(), 1), (behind_the_wall(), 2)] {
        let options = within(depth, 1 << 12);
        let direct = measured(&imagined_without(&scene), &options);
        let cut = measured(&scene, &options);
        for sensor in &scene.sensors {
            let [cut, direct] = [&cut, &direct].map(|all| reading(all, &sensor.name).estimate);
            assert_same(&sensor.name, &cut, &direct);
        }
    }
}

/// Without mirror and image.
fn imagined_without(scene: &SceneDescription) -> SceneDescription {
    let mut scene = imagined(scene.clone());
    scene.lights.truncate(1);
    scene
}

/// Below a slab of glass passes what Fresnel's equations say, counted on a surface that blocks nothing, and on the floor.
#[test]
fn fluxes_below_glass_are_in_closed_form() {
    let (mut scene, thickness) = slab(4.0);
    let radius: f64 = 0.5;
    let area = PI * radius * radius;
    scene.shapes[0] = square(30.0, 0.0);
    let target = disc(p(0.3, 0.0, 0.1), UP, radius).named("target");
    scene.sensors = vec![
        sensor("through", flux_through(disc(p(0.2, 0.1, 0.5), UP, radius))),
        sensor("target", flux_of("target", FluxOf::Incident)),
    ];
    scene.shapes.push(target);
    let expected = area * SLAB.irradiance(4.0, thickness);
    let found = measured(&scene, &samples(1 << 14));
    assert!(found.complete(), "{:?}", found.unsampled);
    for name in ["through", "target"] {
        let seen = reading(&found, name).estimate;
        assert_agrees(name, &seen, expected, 1e-6 * expected);
        assert!(seen.std_error < 0.03 * expected, "{name}: {seen:?}");
    }
}

/// Glass that keeps nothing lets all of a lamp's 100 W go, which a black sphere around it receives.
#[test]
fn glass_around_a_lamp_is_left_by_all_of_its_light() {
    let mut scene = lamp_in_glass();
    let black = hollow_sphere(p(0.0, 0.0, 0.0), 2.0, &[]).named("wall");
    scene.shapes[0] = black;
    scene.shapes[1].name = Some("glass".into());
    let around = flux_through(hollow_sphere(p(0.0, 0.1, 0.0), 1.0, &[]));
    scene.sensors = vec![
        sensor("leaving", flux_of("glass", FluxOf::Leaving)),
        sensor("net", flux_of("glass", FluxOf::Net)),
        sensor("wall", flux_of("wall", FluxOf::Absorbed)),
        sensor("around", around),
    ];
    let found = measured(&scene, &samples(1 << 12));
    for (name, expected) in [
        ("leaving", 100.0),
        ("net", -100.0),
        ("wall", 100.0),
        ("around", 100.0),
    ] {
        let seen = reading(&found, name).estimate;
        // Light turns back and forth in the glass until less than a millionth is left.
        assert_agrees(name, &seen, expected, 1e-4);
        assert!(seen.std_error < 2.0, "{name}: {seen:?}");
    }
}

/// Of a point readings lack what polished surfaces throw there straight, and of a ray all; of a flux nothing.
#[test]
fn what_readings_lack_is_told_by_kind() {
    let classes = |kind: SensorKind| {
        let mut scene = before_a_mirror(0.5, 60.0, 15.0);
        scene.sensors = vec![sensor("meter", kind)];
        measured(&scene, &samples(16)).unsampled
    };
    let thrown = "light of `light 0` reflected by mirrors of material `mirror`";
    let at = p(3.0, 0.0, 0.5);
    let straight = format!("{thrown}, as polished surfaces show it to points of readings");
    for points in [irradiance_at([(at, UP)]), scalar_irradiance_at(at)] {
        assert_eq!(classes(points), [straight.as_str()]);
    }
    assert_eq!(classes(radiance_along(at, DOWN)), [thrown]);
    let flux = flux_through(disc(at, UP, 0.1));
    assert_eq!(classes(flux), Vec::<String>::new());
}

fn bits(found: &Measurements) -> Vec<u64> {
    let readings = found.readings().into_iter();
    let both = readings.flat_map(|reading| [reading.estimate.value, reading.estimate.std_error]);
    both.map(f64::to_bits).collect()
}

/// The same bits for any number of threads, any instruction set, blocks of any size, and from shards.
#[test]
fn readings_with_caustics_keep_their_bits() {
    let mut scene = behind_the_wall();
    scene
        .sensors
        .extend(fluxes_before_a_mirror().sensors.drain(..2));
    let with = |change: &dyn Fn(&mut MeasureOptions)| {
        let mut options = samples(256);
        options.plan.replicates = 16;
        options.plan.threads = 1;
        change(&mut options);
        measured(&scene, &options)
    };
    let alone = bits(&with(&|_| {}));
    for threads in [2, 5] {
        assert_eq!(
            alone,
            bits(&with(&|options| options.plan.threads = threads))
        );
    }
    for set in InstructionSet::available() {
        assert_eq!(
            alone,
            bits(&with(&|options| options.instruction_set = set)),
            "{set:?}"
        );
    }
    assert_eq!(alone, bits(&with(&|options| options.points_of_a_block = 2)));
    let shards = (1..=3).map(|part| with(&|options| options.plan.shard = Some((part, 3))));
    assert_eq!(alone, bits(&Measurements::merge(shards.collect()).unwrap()));
}

/// Of 200 intervals that hold with probability .95, fewer than 176 hold with probability 1e-4; the error of the truth is a twentieth of theirs.
#[test]
fn intervals_of_readings_hold() {
    for (mut scene, depth) in [(behind_the_wall(), 3), (fluxes_before_a_mirror(), 2)] {
        scene.sensors.truncate(1);
        let name = scene.sensors[0].name.clone();
        let truth = measured(&imagined(scene.clone()), &within(depth, 1 << 18));
        let truth = reading(&truth, &name).estimate;
        let holds = |seed: u64| {
            let plan = Plan {
                stop: Stopping::at_samples(1 << 10),
                replicates: 16,
                seed,
                ..Plan::default()
            };
            let options = MeasureOptions {
                plan,
                max_depth: Some(depth),
                ..MeasureOptions::default()
            };
            let seen = reading(&measured(&scene, &options), &name).estimate;
            let [low, high] = seen.interval.unwrap();
            assert!(truth.std_error < 0.1 * seen.std_error, "{truth:?} {seen:?}");
            usize::from((low..=high).contains(&truth.value))
        };
        let held: usize = (0..200).map(holds).sum();
        assert!(held >= 176, "{name}: {held} of 200");
    }
}
