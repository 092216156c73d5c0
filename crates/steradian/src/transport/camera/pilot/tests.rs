//! Pictures whose camera rays branch, and such where they had better not.

use steradian_kernel::InstructionSet;

use super::*;
use crate::estimation::film::{Exposure, Filter, expose};
use crate::estimation::{Plan, Silent, Stopping};
use crate::geometry::{Point, Transform, Vector};
use crate::quantity::{Amount, Angle, Radiance};
use crate::scene::Scene;
use crate::scene::description::*;
use crate::sensor::Camera;
use crate::transport::branching::BRANCHES;
use crate::transport::path::Tracer;
use crate::transport::tables::Tables;

const SIDE: u32 = 64;

fn grey(name: &str, reflectance: f64) -> MaterialDescription {
    let reflectance = LaneValues::Uniform(reflectance).into();
    MaterialDescription::new(name, MaterialModel::Lambertian { reflectance })
}

fn grey_shape(geometry: GeometryDescription) -> ShapeDescription {
    ShapeDescription {
        name: None,
        geometry,
        material: Some("grey".into()),
        transform: Transform::IDENTITY,
        repeat: None,
        emission: None,
    }
}

fn grey_box(min: Point, max: Point, inside: bool) -> ShapeDescription {
    grey_shape(GeometryDescription::Box {
        min,
        max,
        inside,
        faces: vec![],
        openings: vec![],
    })
}

fn lamp(origin: Point, edges: [Vector; 2], radiance: f64) -> ShapeDescription {
    let radiance = Radiance::from_watts_per_square_metre_steradian(radiance);
    let emission = EmissionDescription {
        amount: EmissionAmount::Radiance(Amount::Radiant(radiance)),
        spectrum: None,
        textures: vec![],
        two_sided: false,
        group: None,
        schedule: None,
    };
    let mut shape = grey_shape(GeometryDescription::Rectangle { origin, edges });
    shape.emission = Some(emission);
    shape
}

/// A room of 2 m that reflects so much, seen from one wall towards y.
fn room(reflectance: f64, things: Vec<ShapeDescription>) -> Scene {
    let walls = grey_box(Point::ORIGIN, Point::new(2.0, 2.0, 2.0), true);
    let eye = SensorKind::Camera(CameraDescription {
        position: Point::new(1.0, 0.1, 1.0),
        look_at: Point::new(1.0, 2.0, 1.0),
        up: Vector::new(0.0, 0.0, 1.0),
        projection: Projection::Perspective {
            fov: Angle::from_degrees(80.0),
        },
        resolution: [SIDE, SIDE],
    });
    let description = SceneDescription {
        materials: vec![grey("grey", reflectance)],
        shapes: [vec![walls], things].concat(),
        sensors: vec![SensorDescription {
            name: "eye".into(),
            response: None,
            bins: None,
            kind: eye,
        }],
        ..SceneDescription::default()
    };
    Scene::new(&description).unwrap()
}

/// A lamp at the ceiling, out of view, and a block on the floor.
fn lit_from_above() -> Scene {
    let edges = [Vector::new(0.0, 0.6, 0.0), Vector::new(0.6, 0.0, 0.0)];
    let lamp = lamp(Point::new(0.7, 0.5, 1.99), edges, 10.0);
    let block = grey_box(Point::new(0.4, 1.0, 0.0), Point::new(0.9, 1.5, 0.8), false);
    room(0.6, vec![lamp, block])
}

/// The opposite wall has 32 × 32 lamps on a 25th of its area, each a quarter as wide as what a pixel sees.
fn lit_by_a_pattern() -> Scene {
    let size = 0.2 * 2.0 / 32.0;
    let edges = [Vector::new(size, 0.0, 0.0), Vector::new(0.0, 0.0, size)];
    let place = |i: u32| f64::from(i) * 2.0 / 32.0 + 0.02;
    let number = |i: u32| Point::new(place(i % 32), 1.99, place(i / 32));
    let lamps = (0..32 * 32).map(|i| lamp(number(i), edges, 10.0));
    room(0.3, lamps.collect())
}

fn film() -> Film {
    Film {
        width: SIDE,
        height: SIDE,
        filter: Filter::Box,
        key: 9,
        weights: [1.0, 0.0, 0.0, 0.0],
    }
}

fn sampler<'a>(tables: &'a Tables<'a>) -> CameraSampler<'a> {
    let tracer = Tracer {
        tables,
        set: InstructionSet::detect(),
        max_depth: u32::MAX,
        merge_groups: true,
    };
    let crate::sensor::Kind::Camera(camera) = &tables.scene.sensors()[0].kind else {
        panic!("the sensor is a camera");
    };
    let camera: &Camera = camera;
    CameraSampler::new(tracer, camera, None)
}

fn suited_to(scene: &Scene) -> Branches {
    let tables = Tables::new(scene);
    let sampler = sampler(&tables).branching(Branching::Suited, &film(), 1);
    sampler.branches
}

/// In a room of diffuse surfaces next to all variance is that of the paths, each of which costs little more than what they share.
#[test]
fn paths_branch_where_light_is_diffuse() {
    assert_eq!(suited_to(&lit_from_above()), Branches::all(BRANCHES));
}

/// Whether a camera ray meets a lamp is what varies: the branches of one share it.
#[test]
fn paths_do_not_branch_where_the_camera_sees_a_fine_pattern() {
    assert_eq!(suited_to(&lit_by_a_pattern()), Branches::ONE);
}

const REPLICATES: u32 = 16;

fn picture(scene: &Scene, branches: Branches, seed: u64) -> Exposure {
    let tables = Tables::new(scene);
    let plan = Plan {
        stop: Stopping::at_samples(2 * u64::from(REPLICATES)),
        replicates: REPLICATES,
        threads: 1,
        seed,
        ..Plan::default()
    };
    let sampler = CameraSampler {
        branches,
        ..sampler(&tables)
    };
    expose(&sampler, &film(), &plan, &mut Silent).unwrap()
}

/// The four tiles of two pictures of two scenes: of 8 differences of means of 16 passes one is beyond 4.5 standard errors with a probability of at most 4e-3, that of
/// Student's t with 15 degrees of freedom; differences have up to 30.
#[test]
fn branches_change_no_mean() {
    for scene in [lit_from_above(), lit_by_a_pattern()] {
        let [one, four] = [Branches::ONE, Branches::all(BRANCHES)];
        let [one, four] =
            [(one, 1), (four, 2)].map(|(branches, seed)| picture(&scene, branches, seed));
        for (column, row) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let mean = |image: &Exposure| image.tile(column, row, &film().weights, 0.95);
            let (one, four) = (mean(&one), mean(&four));
            let error = libm::hypot(one.std_error, four.std_error);
            assert!(
                (one.value - four.value).abs() < 4.5 * error,
                "{one:?} {four:?}"
            );
            assert!(error < 0.08 * one.value, "{one:?} {four:?}");
        }
    }
}

/// Were all variance that of paths, four of them would have a quarter. The sums are over 4096 pixels, whose variances of 15 degrees of freedom are known to
/// 37 % each: 1 % for the sums.
#[test]
fn branches_take_variance_where_they_are_suited() {
    let variance = |branches: Branches| -> f64 {
        let image = picture(&lit_from_above(), branches, 1);
        image.std_errors().map(|error| error[0] * error[0]).sum()
    };
    let ratio = variance(Branches::all(BRANCHES)) / variance(Branches::ONE);
    assert!((0.2..0.4).contains(&ratio), "{ratio}");
}
