//! What the batched loops do at a surface, against the [`Brdf`] of its material.

use super::super::columns::Flight;
use super::*;
use glam::Vec3;

use crate::brdf::{Brdf, Scatter};
use crate::geometry::{Direction, Frame, Point, Transform, Vector};
use crate::light::Kind;
use crate::material::{ColorLanes, Site};
use crate::quantity::{Amount, Intensity};
use crate::sampling::testing::assert_mean;
use crate::scene::Scene;
use crate::scene::description::*;
use crate::spectrum::Wavelengths;

const COUNT: usize = 512;
const REFLECTANCE: [f64; 3] = [0.125, 0.5, 0.8];

fn floor(material: MaterialModel) -> Scene {
    let v = Vector::new;
    let shape = ShapeDescription {
        name: None,
        geometry: GeometryDescription::Rectangle {
            origin: Point::new(-2.0, -2.0, 0.0),
            edges: [v(4.0, 0.0, 0.0), v(0.0, 4.0, 0.0)],
        },
        material: Some("floor".into()),
        transform: Transform::IDENTITY,
        repeat: None,
        emission: None,
    };
    let intensity = Amount::Radiant(Intensity::from_watts_per_steradian(1.0));
    let lamp = LightDescription {
        name: None,
        group: None,
        spectrum: None,
        schedule: None,
        repeat: None,
        kind: LightKind::Point {
            position: Point::new(0.0, 0.0, 2.0),
            power: PointPower::Intensity(intensity),
        },
    };
    let meter = SensorDescription {
        name: "meter".into(),
        response: None,
        bins: None,
        kind: SensorKind::ScalarIrradiance {
            points: vec![Point::new(0.0, 0.0, 1.0)],
        },
    };
    let description = SceneDescription {
        spectrum: SpectrumMode::Rgb,
        materials: vec![MaterialDescription::new("floor", material)],
        shapes: vec![shape],
        lights: vec![lamp],
        sensors: vec![meter],
        ..SceneDescription::default()
    };
    let scene = Scene::new(&description).unwrap();
    assert!(matches!(scene.lights()[0].kind, Kind::Point(_)));
    scene
}

fn matt() -> Scene {
    let reflectance = LaneValues::Rgb(REFLECTANCE).into();
    floor(MaterialModel::Lambertian { reflectance })
}

fn brdf(scene: &Scene) -> Brdf {
    let material = scene.material(scene.parts()[0].front);
    let found = material.brdf(&Site::NOWHERE, &ColorLanes::Rgb, &Wavelengths::default());
    found.unwrap().into_owned()
}

/// Slanting rays that meet the floor, with a throughput of one.
fn arrived(tracer: &Tracer<'_>, workspace: &mut Workspace) -> Vec<Direction> {
    tracer.begin(workspace, COUNT);
    let mut viewers = Vec::new();
    for i in 0..COUNT {
        let slant = i as f32 / COUNT as f32;
        let direction = Vec3::new(slant, 0.3 * slant, -1.0).normalize();
        workspace.flights.push(Flight {
            origin: [0.0, 0.0, 1.0],
            direction: direction.into(),
            throughput: [1.0; 4],
            pdf: f32::INFINITY,
            identity: (i as u32, 17, i as u32),
            light: [0.5; 2],
        });
        viewers.push(Direction::new(Vector::from((-direction).as_dvec3().to_array())).unwrap());
    }
    let surfaces = tracer.tables.scene.surfaces();
    surfaces.closest(&workspace.flights.rays, &mut workspace.hits, tracer.set);
    tracer.arrive(workspace, tracer.tables.for_surfaces());
    viewers
}

fn tracer<'a>(tables: &'a Tables<'a>) -> Tracer<'a> {
    Tracer {
        tables,
        set: InstructionSet::detect(),
        max_depth: u32::MAX,
        merge_groups: false,
    }
}

fn directions(flights: &Flights) -> Vec<Direction> {
    let rays = &flights.rays;
    let at = |i: usize| {
        let d = [
            rays.direction_x[i],
            rays.direction_y[i],
            rays.direction_z[i],
        ];
        Direction::new(Vector::from(d.map(f64::from))).unwrap()
    };
    (0..flights.len()).map(at).collect()
}

fn close(found: f32, expected: f64, what: &str) {
    let off = (f64::from(found) / expected - 1.0).abs();
    assert!(
        off < 4.0 * f64::from(f32::EPSILON),
        "{what}: {found} for {expected}"
    );
}

#[test]
fn the_response_of_a_vertex_is_the_value_of_the_brdf() {
    let scene = matt();
    let tables = Tables::new(&scene);
    let mut workspace = Workspace::default();
    let viewers = arrived(&tracer(&tables), &mut workspace);
    assert_eq!(workspace.vertices.len(), COUNT);
    let wi = Direction::new(Vector::new(0.3, -0.2, 0.7)).unwrap();
    for (i, wo) in viewers.into_iter().enumerate() {
        let value = brdf(&scene).evaluate(wo, wi).to_lanes();
        for lane in 0..tables.lanes {
            close(
                workspace.vertices.response[lane][i],
                f64::from(value[lane]),
                "response",
            );
        }
    }
}

#[test]
fn scattered_paths_carry_value_times_cosine_over_density() {
    let scene = matt();
    let tables = Tables::new(&scene);
    let tracer = tracer(&tables);
    let mut workspace = Workspace::default();
    let viewers = arrived(&tracer, &mut workspace);
    scatter::fill(
        &tracer,
        &workspace.vertices.identity,
        1,
        &mut workspace.uniforms,
    );
    scatter::leave_diffusely(&tracer, &mut workspace, None);
    let frame = Frame::from_normal(Direction::Z);
    for (i, wi) in directions(&workspace.flights).into_iter().enumerate() {
        let local = Direction::new(frame.vector_to_local(wi.to_vector())).unwrap();
        let (value, pdf) = (
            brdf(&scene).evaluate(viewers[i], local),
            brdf(&scene).pdf(viewers[i], local),
        );
        let factor = local.z() / pdf;
        // cosθ is rounded where it is small, in the density and in the direction alike.
        assert!(
            (f64::from(workspace.flights.pdf[i]) - pdf).abs() < 1e-6,
            "{pdf}"
        );
        for lane in 0..tables.lanes {
            let expected = f64::from(value.to_lanes()[lane]) * factor;
            close(
                workspace.flights.throughput[lane][i],
                expected,
                "throughput",
            );
        }
    }
}

/// Roulette changes the weight of survivors so that the mean stays the albedo.
#[test]
fn roulette_keeps_the_mean_throughput() {
    let dark = LaneValues::Rgb([0.01, 0.05, 0.1]).into();
    for reflectance in [dark, LaneValues::Rgb(REFLECTANCE).into()] {
        let scene = floor(MaterialModel::Lambertian { reflectance });
        let albedo = brdf(&scene).albedo(Direction::Z).to_lanes();
        let tables = Tables::new(&scene);
        let tracer = tracer(&tables);
        let mut sums = vec![];
        for segment in 1..=64 {
            let mut workspace = Workspace::default();
            arrived(&tracer, &mut workspace);
            scatter::reflect(&tracer, &mut workspace, segment);
            sums.extend((0..COUNT).map(|i| f64::from(workspace.flights.throughput[2][i])));
        }
        assert_mean(&sums, f64::from(albedo[2]), 1e-7);
    }
}

#[test]
fn mirrors_reflect_by_their_reflectance() {
    let reflectance = LaneValues::Rgb(REFLECTANCE);
    let scene = floor(MaterialModel::Mirror { reflectance });
    let tables = Tables::new(&scene);
    let tracer = tracer(&tables);
    let mut workspace = Workspace::default();
    let viewers = arrived(&tracer, &mut workspace);
    scatter::reflect(&tracer, &mut workspace, 1);
    assert_eq!(workspace.flights.len(), COUNT);
    let found = directions(&workspace.flights);
    for (i, wo) in viewers.into_iter().enumerate() {
        let Some(Scatter::Specular { wi, reflectance }) = brdf(&scene).sample(wo, [0.5; 2]) else {
            panic!("a mirror has one direction")
        };
        assert!((found[i].to_vector() - wi.to_vector()).length() < 1e-6);
        for lane in 0..tables.lanes {
            let expected = f64::from(reflectance.to_lanes()[lane]);
            close(
                workspace.flights.throughput[lane][i],
                expected,
                "throughput",
            );
        }
    }
}
