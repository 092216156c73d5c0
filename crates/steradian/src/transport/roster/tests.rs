//! What a roster says of a lamp against rays to points of it.

use steradian_kernel::{InstructionSet, RayBatch};

use super::super::aim::{Aim, Scratch};
use super::super::columns::Place;
use super::super::towards::towards;
use super::*;
use crate::geometry::{Direction, Point, Transform, Vector};
use crate::quantity::{Amount, Radiance};
use crate::sampling::testing::independent;
use crate::scene::Scene;
use crate::scene::description::*;

const SCENES: u64 = 300;
const LAMPS: usize = 12;
const POINTS: usize = 4;
const RAYS: usize = 64;

/// Uniform numbers, one after the other.
struct Numbers(std::vec::IntoIter<[f64; 2]>);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0.next().expect("there are enough")[0]
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn vector(&mut self, size: f64) -> Vector {
        let mut part = || self.between(-size, size);
        Vector::new(part(), part(), part())
    }
}

fn shape(geometry: GeometryDescription, is_lamp: bool) -> ShapeDescription {
    let radiance = Amount::Radiant(Radiance::from_watts_per_square_metre_steradian(3.0));
    let emission = EmissionDescription {
        amount: EmissionAmount::Radiance(radiance),
        spectrum: None,
        textures: vec![],
        two_sided: false,
        group: None,
        schedule: None,
    };
    ShapeDescription {
        name: None,
        geometry,
        material: None,
        transform: Transform::IDENTITY,
        repeat: None,
        emission: is_lamp.then_some(emission),
    }
}

/// Half of the lamps in a plane, the others anywhere; obstacles of all sizes and forms.
fn random_scene(numbers: &mut Numbers) -> Scene {
    let mut shapes = vec![];
    for k in 0..LAMPS {
        let at = Point::new(numbers.between(-3.0, 3.0), numbers.between(-3.0, 3.0), 2.0);
        let lifted = at + numbers.vector(1.0);
        shapes.push(shape(
            match k % 6 {
                0 => GeometryDescription::Disc {
                    center: lifted,
                    normal: numbers.vector(1.0),
                    radius: 0.3,
                    inner_radius: 0.1,
                },
                1 => GeometryDescription::Sphere {
                    center: lifted,
                    radius: 0.2,
                    inside: false,
                    ports: vec![],
                },
                2 => GeometryDescription::Rectangle {
                    origin: lifted,
                    edges: [numbers.vector(0.5), numbers.vector(0.5)],
                },
                _ => GeometryDescription::Rectangle {
                    origin: at,
                    edges: [Vector::new(0.0, 0.3, 0.0), Vector::new(0.2, 0.0, 0.0)],
                },
            },
            true,
        ));
    }
    for k in 0..3 {
        let at = Point::ORIGIN + numbers.vector(1.5) + Vector::new(0.0, 0.0, 0.5);
        shapes.push(shape(
            match k % 3 {
                0 => GeometryDescription::Rectangle {
                    origin: at,
                    edges: [numbers.vector(4.0), numbers.vector(4.0)],
                },
                1 => GeometryDescription::Box {
                    min: at,
                    max: at
                        + Vector::new(numbers.between(0.1, 3.0), numbers.between(0.1, 3.0), 0.3),
                    inside: false,
                    faces: Default::default(),
                    openings: vec![],
                },
                _ => GeometryDescription::Sphere {
                    center: at,
                    radius: numbers.between(0.1, 0.5),
                    inside: false,
                    ports: vec![],
                },
            },
            false,
        ));
    }
    let description = SceneDescription {
        shapes,
        sensors: vec![SensorDescription {
            name: "any".into(),
            response: None,
            bins: None,
            kind: SensorKind::ScalarIrradiance {
                points: vec![Point::new(0.0, 0.0, -20.0)],
            },
        }],
        ..SceneDescription::default()
    };
    Scene::new(&description).unwrap_or_else(|problems| panic!("{problems:?}"))
}

/// Shadow rays to points of a lamp as meters sample them.
fn stopped(tables: &Tables<'_>, view: &View, emitter: usize, numbers: &mut Numbers) -> Vec<bool> {
    let normal = view.normal.unwrap_or(Direction::Z);
    let place = Place {
        point: tables.scene.surfaces().to_kernel(view.position),
        normal: normal.to_array().map(|x| x as f32),
        clearance: (view.start - view.position).length() as f32,
    };
    let is_spherical = view.normal.is_none();
    let start = if is_spherical {
        place.point
    } else {
        place.cleared()
    };
    let emitter = &tables.emitters[emitter];
    let mut aim = Aim::default();
    aim.turn(
        tables,
        emitter,
        (&place, is_spherical),
        &mut Scratch::default(),
    );
    let mut rays = RayBatch::default();
    for _ in 0..RAYS {
        let u = [numbers.next() as f32, numbers.next() as f32];
        let end = match is_aimed_at(tables, emitter, start) {
            true => aim.sample(&place, u),
            false => towards(tables, emitter, &place, u).map(|towards| towards.end),
        };
        let Some(end) = end else { continue };
        let span = end - glam::Vec3::from_array(start);
        let above = is_spherical || span.dot(glam::Vec3::from_array(place.normal)) > 0.0;
        if above {
            rays.push(start, span.into(), 1.0);
        }
    }
    let mut stopped = vec![];
    let surfaces = tables.scene.surfaces();
    surfaces.occluded(&rays, &mut stopped, InstructionSet::detect());
    stopped
}

/// Of lamps in full view no ray is stopped, of hidden ones every ray; both are found, and most lamps are one or the other.
#[test]
fn what_is_known_is_so() {
    let mut found = [0; 3];
    for scene_number in 0..SCENES {
        let mut numbers = Numbers(
            independent(scene_number, 40_000)
                .collect::<Vec<_>>()
                .into_iter(),
        );
        let scene = random_scene(&mut numbers);
        let tables = Tables::new(&scene);
        let groups = Groups::new(&tables);
        for _ in 0..POINTS {
            let at = Point::ORIGIN + numbers.vector(1.0) - Vector::new(0.0, 0.0, 2.0);
            let normal = Direction::new(numbers.vector(1.0) + Vector::new(0.0, 0.0, 0.7)).ok();
            let normal = normal.filter(|_| numbers.next() < 0.7);
            let view = View::new(at, normal, scene.surfaces().clearance());
            let search = Search::new(&tables, &groups, &view);
            for (emitter, pieces) in &groups.lamps {
                let [seen] = search.seen[pieces.clone()] else {
                    panic!("each lamp is one piece")
                };
                let stopped = stopped(&tables, &view, *emitter, &mut numbers);
                match seen {
                    Seen::Whole => assert!(!stopped.contains(&true), "{scene_number} {emitter}"),
                    Seen::Not => assert!(!stopped.contains(&false), "{scene_number} {emitter}"),
                    Seen::Perhaps => {}
                }
                let is_lit = !stopped.is_empty();
                found[seen as usize] += usize::from(is_lit);
            }
        }
    }
    let [whole, hidden, open] = found;
    assert!(whole > 1000 && hidden > 300, "{found:?}");
    assert!(open < whole + hidden, "{found:?}");
}

/// Shares are drawn as they are told, and add up to all samples.
#[test]
fn open_lamps_are_drawn_by_their_shares() {
    let sums = [1_u32, 1 << 20, (1 << 20) + 7, 1 << 30];
    let open = (3..).zip(sums).map(|(emitter, sum)| Open { emitter, sum });
    let roster = Roster {
        known: Box::default(),
        open: Some(open.collect()),
    };
    let mut before = 0.0;
    let total = f64::from(sums[3]);
    for (number, sum) in sums.into_iter().enumerate() {
        let end = f64::from(sum) / total;
        for u in [before, 0.5 * (before + end)] {
            let (sampled, rest) = roster.choose(u).expect("there are lamps");
            assert_eq!(sampled.number, number + 3);
            assert!((f64::from(sampled.rate) / (4.0 * (end - before)) - 1.0).abs() < 1e-6);
            assert!((f64::from(rest) - (u - before) / (end - before)).abs() < 1e-6);
        }
        before = end;
    }
    let none = Roster {
        known: Box::default(),
        open: Some(Box::default()),
    };
    assert!(none.knows_all() && none.choose(0.5).is_none());
    assert!(!Roster::default().knows_all() && !Roster::default().chooses());
}
