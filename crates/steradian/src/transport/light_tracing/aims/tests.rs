//! Each light at each shape by itself, or each at all shapes at once: the same flux.

use std::f64::consts::TAU;

use steradian_kernel::{HitBatch, InstructionSet, MISS, RayBatch};

use super::*;
use crate::geometry::{Point, Transform};
use crate::quantity::{Amount, Intensity};
use crate::sampling::block;
use crate::sampling::testing::assert_mean;
use crate::scene::Scene;
use crate::scene::description::*;

const BALLS: [(Point, f64); 2] = [
    (Point::new(1.0, 0.0, 0.0), 0.3),
    (Point::new(-1.0, 0.5, 0.2), 0.5),
];
const LAMPS: [(Point, f64); 2] = [
    (Point::new(0.0, 0.0, 2.0), 1.0),
    (Point::new(0.5, -1.0, 1.5), 3.0),
];

fn ball((center, radius): (Point, f64)) -> ShapeDescription {
    ShapeDescription {
        name: None,
        geometry: GeometryDescription::Sphere {
            center,
            radius,
            inside: false,
            ports: vec![],
        },
        material: Some("mirror".into()),
        transform: Transform::IDENTITY,
        repeat: None,
        emission: None,
    }
}

fn lamp((position, watts): (Point, f64)) -> LightDescription {
    let intensity = Amount::Radiant(Intensity::from_watts_per_steradian(watts));
    LightDescription {
        name: None,
        group: None,
        spectrum: None,
        schedule: None,
        repeat: None,
        kind: LightKind::Point {
            position,
            power: PointPower::Intensity(intensity),
        },
    }
}

fn balls_and_lamps() -> Scene {
    let reflectance = LaneValues::Uniform(1.0);
    let mirror = MaterialModel::Mirror { reflectance };
    let meter = SensorDescription {
        name: "meter".into(),
        response: None,
        bins: None,
        kind: SensorKind::ScalarIrradiance {
            points: vec![Point::ORIGIN],
        },
    };
    let description = SceneDescription {
        spectrum: SpectrumMode::Rgb,
        materials: vec![MaterialDescription::new("mirror", mirror)],
        shapes: BALLS.map(ball).to_vec(),
        lights: LAMPS.map(lamp).to_vec(),
        sensors: vec![meter],
        ..SceneDescription::default()
    };
    Scene::new(&description).unwrap()
}

/// Σ I 2π(1 − cosα) with sinα = r/d: from both lamps both balls are in full view.
fn expected() -> f64 {
    let of_pair = |(position, watts): (Point, f64), (center, radius): (Point, f64)| {
        let sine = radius / (center - position).length();
        watts * TAU * (1.0 - (1.0 - sine * sine).sqrt())
    };
    let pairs = LAMPS
        .iter()
        .flat_map(|lamp| BALLS.map(|ball| (*lamp, ball)));
    pairs.map(|(lamp, ball)| of_pair(lamp, ball)).sum()
}

/// What paths bring to what they are sent to.
fn brought(scene: &Scene, aims: &Aims, tables: &Tables<'_>, count: u32) -> Vec<f64> {
    let surfaces = scene.surfaces();
    let (mut rays, mut hits) = (RayBatch::default(), HitBatch::default());
    let mut sent = vec![];
    for index in 0..count {
        let numbers = block::sample(7, index, 0);
        let start = aims.sample(tables, numbers, None, &Wavelengths::default());
        let start = start.expect("points shine everywhere");
        rays.push(start.origin, start.direction, f32::INFINITY);
        sent.push(start);
    }
    surfaces.closest(&rays, &mut hits, InstructionSet::detect());
    let brings = |(start, primitive): (&Start, &u32)| match *primitive {
        MISS => 0.0,
        met => {
            let shape = surfaces.shape_of(met);
            let counts = start.target.is_none_or(|target| target == shape);
            f64::from(start.flux[0]) * f64::from(u8::from(counts))
        }
    };
    sent.iter().zip(&hits.primitive).map(brings).collect()
}

/// More pairs than are told apart send every light to all shapes at once.
#[test]
fn lights_sent_to_all_shapes_at_once_bring_the_same() {
    let scene = balls_and_lamps();
    let tables = Tables::new(&scene);
    for (pairs, targets) in [(4, 2), (3, 1)] {
        let aims = Aims::up_to(pairs, &tables).expect("lamps and mirrors");
        assert_eq!(aims.aims.len(), 2 * targets);
        let all = brought(&scene, &aims, &tables, 1 << 14);
        assert_mean(&all, expected(), 1e-5 * expected());
    }
}
