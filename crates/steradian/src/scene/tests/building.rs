use std::f64::consts::PI;

use super::*;
use crate::material::Model;
use crate::quantity::Time;
use crate::sensor::{Kind as Sensing, Receiver};
use crate::shape::Form;
use crate::time::Rule;

fn mesh_of(form: &Form) -> &crate::shape::TriangleMesh {
    match form {
        Form::Mesh(mesh) => mesh,
        other => panic!("{other:?}"),
    }
}

/// Name of the front's material, normal and area of each triangle of shape 0.
fn faces(scene: &Scene) -> Vec<(&str, Vector, f64)> {
    let placed = scene.surfaces().shape(ShapeId(0));
    let mesh = mesh_of(&placed.form);
    let face = |index: usize| {
        let [a, b, c] = mesh.corners(index);
        let area = (b - a).cross(c - a) * 0.5;
        let part = scene.parts()[placed.parts[index].0 as usize];
        assert_eq!(part.front, part.back);
        let name = scene.materials()[part.front.0 as usize].0.as_str();
        (name, area / area.length(), area.length())
    };
    (0..mesh.triangles.len()).map(face).collect()
}

fn area_of(faces: &[(&str, Vector, f64)], name: &str, normal: [f64; 3]) -> f64 {
    let alike = faces.iter().filter(|(found, facing, _)| {
        *found == name && (*facing - Vector::from(normal)).length() < 1e-12
    });
    alike.map(|face| face.2).sum()
}

/// A room of 1 m × 2 m × 3 m with a window of glass in x- and a hole in the ceiling.
fn room(inside: bool, transform: Transform) -> SceneDescription {
    let mut description = valid();
    let names = ["floor", "wall", "door", "glass", "rest"];
    description.materials = names.map(|name| lambertian(name, 0.5)).to_vec();
    let faces = [("walls", "wall"), ("y+", "door"), ("floor", "floor")];
    let window = Opening {
        face: "x-".into(),
        rect: [0.5, 1.0, 1.0, 0.5],
        material: Some("glass".into()),
    };
    let hole = Opening {
        face: "ceiling".into(),
        rect: [0.25, 0.5, 0.5, 1.0],
        material: None,
    };
    let geometry = GeometryDescription::Box {
        min: Point::ORIGIN,
        max: Point::new(1.0, 2.0, 3.0),
        inside,
        faces: faces
            .map(|(face, name)| (face.to_string(), name.to_string()))
            .to_vec(),
        openings: vec![window, hole],
    };
    description.shapes = vec![ShapeDescription {
        transform,
        ..shape(geometry, Some("rest"))
    }];
    description
}

#[test]
fn the_faces_and_openings_of_a_box_have_their_materials_and_orientation() {
    for (inside, out) in [(false, 1.0), (true, -1.0)] {
        let scene = scene(&room(inside, Transform::IDENTITY));
        let faces = faces(&scene);
        let expected = [
            ("wall", [-out, 0.0, 0.0], 6.0 - 0.5),
            ("glass", [-out, 0.0, 0.0], 0.5),
            ("wall", [out, 0.0, 0.0], 6.0),
            ("wall", [0.0, -out, 0.0], 3.0),
            ("door", [0.0, out, 0.0], 3.0),
            ("floor", [0.0, 0.0, -out], 2.0),
            ("rest", [0.0, 0.0, out], 2.0 - 0.5),
        ];
        for (name, normal, area) in expected {
            assert!(
                (area_of(&faces, name, normal) - area).abs() < 1e-12,
                "{name} {normal:?}"
            );
        }
        let total: f64 = faces.iter().map(|face| face.2).sum();
        assert!((total - 21.5).abs() < 1e-12);
    }
}

/// A mirror image has its front where the image of the front is.
#[test]
fn mirrored_shapes_keep_their_front() {
    let mirror = Transform::scale_axes([-1.0, 1.0, 1.0]);
    let scene_of_room = scene(&room(true, mirror));
    let total: f64 = faces(&scene_of_room).iter().map(|face| face.2).sum();
    assert!((area_of(&faces(&scene_of_room), "glass", [-1.0, 0.0, 0.0]) - 0.5).abs() < 1e-12);
    assert!((total - 21.5).abs() < 1e-12);
    let disc = GeometryDescription::Disc {
        center: Point::ORIGIN,
        normal: Vector::new(0.0, 0.0, 1.0),
        radius: 1.0,
        inner_radius: 0.0,
    };
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for geometry in [
        square(1.0),
        polygon(&corners),
        disc,
        mesh(&corners, &[[0, 1, 2]]),
    ] {
        let mut description = valid();
        description.shapes = vec![ShapeDescription {
            transform: mirror,
            ..shape(geometry, None)
        }];
        let scene = scene(&description);
        let normal = scene.surfaces().normal_at(0, Point::ORIGIN);
        assert_eq!(normal, Vector::new(0.0, 0.0, 1.0));
        let sample = scene
            .surfaces()
            .shape(ShapeId(0))
            .form
            .sample_area([0.3, 0.4]);
        assert!(sample.is_some_and(|s| s.normal.z() == 1.0));
    }
}

#[test]
fn copies_of_a_repeat_are_shapes_of_their_own() {
    let mut description = valid();
    description.shapes[0].name = Some("panel".into());
    description.shapes[0].repeat = Some(Repeat {
        count: vec![2, 3],
        step: vec![Vector::new(10.0, 0.0, 0.0), Vector::new(0.0, 0.0, 5.0)],
    });
    description.sensors.push(sensor(
        "all",
        SensorKind::Flux {
            surface: FluxSurface::Shape {
                name: "panel".into(),
                side: Side::Back,
            },
            of: FluxOf::Incident,
        },
    ));
    let scene = scene(&description);
    let origins = scene
        .surfaces()
        .shapes()
        .iter()
        .map(|placed| match &placed.form {
            Form::Parallelogram(form) => form.origin.to_array(),
            other => panic!("{other:?}"),
        });
    let places: Vec<_> = origins.collect();
    let expected = [
        [0.0, 0.0],
        [0.0, 5.0],
        [0.0, 10.0],
        [10.0, 0.0],
        [10.0, 5.0],
        [10.0, 10.0],
    ];
    assert_eq!(places, expected.map(|[x, z]| [x, 0.0, z]));
    assert_eq!(scene.shape_name(ShapeId(4)), "panel[4]");
    assert!(matches!(
        scene.sensors()[1].kind,
        Sensing::Flux { area: 6.0, .. }
    ));
}

#[test]
fn copies_of_lights_are_lights_of_their_own() {
    let mut description = valid();
    description.lights[0].repeat = Some(Repeat {
        count: vec![3],
        step: vec![Vector::new(2.0, 0.0, 0.0)],
    });
    description.lights[0].group = Some("row".into());
    let scene = scene(&description);
    let place = |light: &Light| match &light.kind {
        Kind::Point(point) => point.position.x,
        other => panic!("{other:?}"),
    };
    assert_eq!(
        scene.lights().iter().map(place).collect::<Vec<_>>(),
        [0.5, 2.5, 4.5]
    );
    assert_eq!(scene.lights()[2].name, "light 0[2]");
    assert_eq!(
        (scene.groups(), scene.columns()),
        (&["row".to_string()][..], 1)
    );
}

#[test]
fn lights_of_a_group_with_other_schedules_are_kept_apart() {
    let schedule = |factor: f64| {
        let points = [(Time::ZERO, factor), (Time::from_hours(8.0), factor)];
        Schedule::new(points, Rule::Linear, None).ok()
    };
    let mut description = valid();
    let lamp = description.lights[0].clone();
    let schedules = [None, schedule(0.5), schedule(0.25), schedule(0.5)];
    description.lights = schedules
        .clone()
        .map(|schedule| LightDescription {
            schedule,
            ..lamp.clone()
        })
        .to_vec();
    let scene = scene(&description);
    let groups: Vec<u32> = scene.lights().iter().map(|light| light.group).collect();
    assert_eq!(groups, [0, 1, 2, 1]);
    assert_eq!(scene.groups(), ["default"; 3]);
    assert_eq!(scene.schedules(), &schedules[..3]);
}

#[test]
fn materials_of_front_and_back() {
    let mut description = valid();
    description.materials.push(MaterialDescription::new(
        "silver",
        MaterialModel::Mirror {
            reflectance: LaneValues::Uniform(0.9),
        },
    ));
    description.materials.push(MaterialDescription::new(
        "sheet",
        MaterialModel::TwoSided {
            front: "silver".into(),
            back: "grey".into(),
        },
    ));
    description.shapes[0].material = Some("sheet".into());
    description
        .shapes
        .push(shape(sphere([5.0; 3], 1.0), Some("grey")));
    description.shapes.push(shape(sphere([8.0; 3], 1.0), None));
    let scene = scene(&description);
    let sides = |shape: u32| {
        let part = scene.surfaces().shape(ShapeId(shape)).parts[0];
        let part = scene.parts()[part.0 as usize];
        [part.front, part.back].map(|id| &scene.material(id).model)
    };
    assert!(matches!(
        sides(0),
        [Model::Mirror { .. }, Model::Lambertian { .. }]
    ));
    assert!(matches!(
        sides(1),
        [Model::Lambertian { .. }, Model::Lambertian { .. }]
    ));
    assert_eq!(sides(2), [&Model::Black; 2]);
}

fn receivers(scene: &Scene, sensor: usize) -> Vec<Receiver> {
    match &scene.sensors()[sensor].kind {
        Sensing::Irradiance(places) => scene.receivers(places, 0..places.len()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn receivers_know_what_they_sit_on() {
    let mut description = valid();
    description.shapes[0].name = Some("desk".into());
    let (up, down) = (Vector::new(0.0, 0.0, 1.0), Vector::new(0.0, 0.0, -2.0));
    let at = |z| Point::new(0.5, 0.25, z);
    let points = vec![(at(0.0), up), (at(0.0), down), (at(0.1), up)];
    description.sensors.push(sensor(
        "points",
        SensorKind::Irradiance(Receivers::Points(points)),
    ));
    let scene = scene(&description);
    let found = receivers(&scene, 1);
    let sides = found.iter().map(|receiver| {
        let on = receiver.sits_on.as_ref();
        on.map(|on| (on.shape.as_str(), on.side.as_str()))
    });
    assert_eq!(
        sides.collect::<Vec<_>>(),
        [Some(("desk", "front")), Some(("desk", "back")), None]
    );
    assert!(receivers(&scene, 1)[0].clearance > 0.0);
    assert_eq!(receivers(&scene, 1)[2].clearance, 0.0);
}

/// Single precision resolves the height of the only finite shape, a small lamp, to 2.4e-7 m: 17 times its clearance.
#[test]
fn receivers_on_the_ground_far_from_a_small_lamp_sit_on_it() {
    let mut description = valid();
    let lamp = GeometryDescription::Disc {
        center: Point::new(0.0, 0.0, 3.3),
        normal: Vector::new(0.0, 0.0, -1.0),
        radius: 1e-3,
        inner_radius: 0.0,
    };
    description.shapes = vec![
        shape(lamp, None),
        shape(GeometryDescription::Ground { height: 0.0 }, None),
    ];
    let points = (1..200).map(|i| {
        (
            Point::new(0.37 * f64::from(i), 0.0, 0.0),
            Vector::new(0.0, 0.0, 1.0),
        )
    });
    description.sensors = vec![sensor(
        "row",
        SensorKind::Irradiance(Receivers::Points(points.collect())),
    )];
    let scene = scene(&description);
    for receiver in receivers(&scene, 0) {
        assert_eq!(
            receiver.sits_on.as_ref().map(|on| on.shape.as_str()),
            Some("ground 1")
        );
        let start = scene
            .surfaces()
            .to_kernel(receiver.position + receiver.normal * receiver.clearance);
        let ground = scene.surfaces().to_kernel(receiver.position);
        assert!(start[2] > ground[2]);
    }
}

#[test]
fn a_grid_has_its_points_at_cell_centres_row_by_row() {
    let mut description = valid();
    description.sensors.push(sensor(
        "grid",
        SensorKind::Irradiance(Receivers::Grid {
            origin: Point::new(0.0, 0.0, 1.0),
            edges: [Vector::new(4.0, 0.0, 0.0), Vector::new(0.0, 3.0, 0.0)],
            count: GridCount::Given([2, 3]),
            border: 0.0,
            normal: None,
        }),
    ));
    let scene = scene(&description);
    let places: Vec<_> = receivers(&scene, 1)
        .iter()
        .map(|r| r.position.to_array())
        .collect();
    let expected = [
        [1.0, 0.5],
        [3.0, 0.5],
        [1.0, 1.5],
        [3.0, 1.5],
        [1.0, 2.5],
        [3.0, 2.5],
    ];
    assert_eq!(places, expected.map(|[x, y]| [x, y, 1.0]));
    assert!(receivers(&scene, 1).iter().all(|r| r.normal.z() == 1.0));
}

/// Two shapes of one name with areas 1 and 9: the number of 1000 points on the first is binomial, σ = 9.5.
#[test]
fn points_are_spread_over_shapes_by_area() {
    let mut description = valid();
    description.shapes = vec![shape(square(1.0), None), shape(square(3.0), None)];
    for shape in &mut description.shapes {
        shape.name = Some("floor".into());
    }
    description.shapes[1].transform = Transform::translate(Vector::new(0.0, 0.0, -2.0));
    description.sensors = vec![sensor(
        "spread",
        SensorKind::Irradiance(Receivers::Shape {
            shape: "floor".into(),
            side: Side::Back,
            count: 1000,
            offset: 0.5,
        }),
    )];
    let scene = scene(&description);
    let points = receivers(&scene, 0);
    assert!(points.iter().all(|receiver| receiver.normal.z() == -1.0));
    let high = points
        .iter()
        .filter(|receiver| receiver.position.z == -0.5)
        .count();
    let low = points
        .iter()
        .filter(|receiver| receiver.position.z == -2.5)
        .count();
    assert_eq!(high + low, 1000);
    assert!((high as f64 - 100.0).abs() < 6.0 * 9.5, "{high}");
}

#[test]
fn points_on_a_sphere_avoid_its_ports() {
    let mut description = valid();
    let geometry = GeometryDescription::Sphere {
        center: Point::new(0.0, 0.0, 5.0),
        radius: 2.0,
        inside: true,
        ports: vec![Port {
            direction: Vector::new(0.0, 0.0, 1.0),
            half_angle: Angle::from_degrees(120.0),
        }],
    };
    description.shapes = vec![ShapeDescription {
        name: Some("bowl".into()),
        ..shape(geometry, None)
    }];
    let wall = Receivers::Shape {
        shape: "bowl".into(),
        side: Side::Front,
        count: 100,
        offset: 0.0,
    };
    description.sensors = vec![sensor("wall", SensorKind::Irradiance(wall))];
    let scene = scene(&description);
    assert_eq!(receivers(&scene, 0).len(), 100);
    for receiver in receivers(&scene, 0) {
        assert!(receiver.position.z <= 4.0 + 1e-12);
        assert_eq!(
            receiver.sits_on.as_ref().map(|on| on.side.as_str()),
            Some("front")
        );
    }
}

#[test]
fn areas_of_shapes() {
    let area = |geometry, transform| {
        let mut description = valid();
        description.shapes = vec![ShapeDescription {
            transform,
            ..shape(geometry, None)
        }];
        description.sensors = vec![irradiance("far", [50.0, 50.0, 50.0])];
        scene(&description).surfaces().shape(ShapeId(0)).form.area()
    };
    let double = Transform::scale(2.0);
    let plane = area(GeometryDescription::Ground { height: 1.0 }, double);
    assert_eq!(plane, f64::INFINITY);
    let expected = [
        (square(3.0), 9.0),
        (polygon(&[[0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]]), 3.0),
        (sphere([0.0; 3], 1.5), 9.0 * PI),
        (block(false), 22.0),
    ];
    for (geometry, exact) in expected {
        assert!((area(geometry.clone(), Transform::IDENTITY) - exact).abs() < 1e-14 * exact);
        assert!((area(geometry, double) - 4.0 * exact).abs() < 1e-14 * 4.0 * exact);
    }
}
