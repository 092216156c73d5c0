//! Batched light sampling against the lights' own.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::super::columns::Place;
use super::super::towards::towards;
use super::*;
use crate::geometry::{Direction, Point, Transform, Vector};
use crate::light::{Density, Kind};
use crate::quantity::{Amount, Angle, Intensity, Irradiance, Radiance};
use crate::sampling::block;
use crate::scene::Scene;
use crate::scene::description::*;

const VERTEX: [f64; 3] = [0.3, -0.2, 0.1];

fn shape(geometry: GeometryDescription) -> ShapeDescription {
    let radiance = Amount::Radiant(Radiance::from_watts_per_square_metre_steradian(3.0));
    let amount = EmissionAmount::Radiance(radiance);
    let emission = EmissionDescription {
        amount,
        spectrum: None,
        textures: vec![],
        two_sided: false,
        group: None,
        schedule: None,
    };
    let transform = Transform::IDENTITY;
    ShapeDescription {
        name: None,
        geometry,
        material: None,
        transform,
        repeat: None,
        emission: Some(emission),
    }
}

fn light(kind: LightKind) -> LightDescription {
    LightDescription {
        name: None,
        group: None,
        spectrum: None,
        schedule: None,
        repeat: None,
        kind,
    }
}

/// One light of every kind, and a sensor, which a scene must have.
fn every_light() -> Scene {
    let v = Vector::new;
    let power = PointPower::Intensity(Amount::Radiant(Intensity::from_watts_per_steradian(7.0)));
    let position = Point::new(0.5, 1.0, 2.0);
    let beam = SpotBeam::CosinePower {
        exponent: 2.0,
        cutoff: Angle::from_degrees(80.0),
    };
    let irradiance = Amount::Radiant(Irradiance::from_watts_per_square_metre(5.0));
    let triangle = vec![
        Point::new(0.0, 0.0, 3.0),
        Point::new(0.0, 1.0, 3.0),
        Point::new(1.0, 0.0, 3.2),
    ];
    let sphere = |center, inside| GeometryDescription::Sphere {
        center,
        radius: 0.5,
        inside,
        ports: vec![],
    };
    let description = SceneDescription {
        shapes: vec![
            shape(GeometryDescription::Rectangle {
                origin: Point::new(-1.0, 1.0, 2.5),
                edges: [v(1.0, 0.0, 0.0), v(0.2, -1.0, 0.0)],
            }),
            shape(GeometryDescription::Polygon {
                vertices: triangle,
                holes: vec![],
            }),
            shape(GeometryDescription::Disc {
                center: Point::new(1.0, 1.0, 1.5),
                normal: v(0.0, -0.2, -1.0),
                radius: 0.4,
                inner_radius: 0.1,
            }),
            shape(sphere(Point::new(0.0, 1.0, 2.0), false)),
            shape(sphere(
                Point::new(VERTEX[0], VERTEX[1], VERTEX[2] + 0.1),
                true,
            )),
        ],
        lights: vec![
            light(LightKind::Point { position, power }),
            light(LightKind::Spot {
                position,
                direction: v(0.0, -0.5, -1.0),
                beam,
                power,
            }),
            light(LightKind::Directional {
                direction: v(0.3, 0.1, -1.0),
                irradiance,
            }),
        ],
        sensors: vec![SensorDescription {
            name: "any".into(),
            response: None,
            bins: None,
            kind: SensorKind::ScalarIrradiance {
                points: vec![Point::new(9.0, 9.0, 9.0)],
            },
        }],
        ..SceneDescription::default()
    };
    Scene::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

fn place(scene: &Scene) -> Place {
    let point = scene.surfaces().to_kernel(Point::from(VERTEX));
    Place {
        point,
        normal: [0.0, 0.0, 1.0],
        clearance: 0.0,
    }
}

/// The batched sampling of every kind of light gives what the light itself says in f64, to single precision:
/// coordinates of order 4 m lose 2⁻²⁴·4, distances are above .3 m, and r² doubles the relative error.
#[test]
fn batched_samples_are_those_of_the_lights() {
    let scene = every_light();
    let tables = Tables::new(&scene);
    let order = tables.emitters.iter().zip([0, 1, 2, 3, 4, 5, 6, 7]);
    let form = |shape| &scene.surfaces().shape(shape).form;
    let mut compared = 0;
    for (emitter, number) in order {
        let light = &scene.lights()[number];
        for index in 0..64 {
            let [a, b, ..] = block::sample(11, index, 0);
            let u = [f64::from(a), f64::from(b)];
            let exact = light.sample(Point::from(VERTEX), Direction::Z, u, form);
            let batched = towards(&tables, emitter, &place(&scene), [a, b]);
            let (Some(exact), Some(batched)) = (exact, batched) else {
                continue;
            };
            let expected = exact.normal_irradiance[0].to_watts_per_square_metre();
            let found = f64::from(batched.per_power * emitter.power.lanes[0]);
            assert!(
                (found - expected).abs() <= 2e-4 * expected.abs(),
                "light {number}: {found} {expected}"
            );
            let direction = Vector::from(<[f32; 3]>::from(batched.direction).map(f64::from));
            let apart = (exact.direction.to_vector() - direction).length();
            assert!(apart < 1e-5, "light {number}: {apart}");
            assert_eq!(
                matches!(exact.density, Density::Delta),
                batched.density.is_infinite()
            );
            compared += 1;
        }
    }
    assert!(compared > 64 * 5, "{compared}");
    assert!(
        scene
            .lights()
            .iter()
            .filter(|light| matches!(light.kind, Kind::Area(_)))
            .count()
            == 5
    );
}

/// The vectorised panel and the scalar sampling are the same estimator.
#[test]
fn a_panel_over_columns_is_a_panel() {
    let scene = every_light();
    let tables = Tables::new(&scene);
    let emitter = &tables.emitters[0];
    let EmitterShape::Parallelogram {
        origin,
        edges,
        normal,
        area,
    } = emitter.shape
    else {
        panic!("a rectangle")
    };
    let panel = Panel {
        origin,
        edges,
        normal,
        area,
        two_sided: false,
        is_portal: false,
    };
    for index in 0..64 {
        let [a, b, ..] = block::sample(12, index, 0);
        let place = place(&scene);
        let (end, weight) = panel.sample(place.point, place.normal, [a, b]);
        let towards =
            towards(&tables, emitter, &place, [a, b]).expect("the panel faces the vertex");
        let cos_theta = towards.direction.z;
        let ratio = cos_theta * FRAC_1_PI / towards.density;
        let expected = cos_theta * towards.per_power / (1.0 + ratio * ratio);
        assert!(
            (weight - expected).abs() <= 1e-5 * expected,
            "{weight} {expected}"
        );
        assert!((Vec3::from_array(end) - towards.end).length() < 1e-5);
    }
}
