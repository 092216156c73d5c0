use serde_json::{Value, json};
use steradian::geometry::{Point, Vector};
use steradian::quantity::Length;
use steradian::scene::description::{Projection, SensorKind};

use crate::building::{Buffer, close, mesh, refusal, scene, triangles, vector_area};

/// A scene of squares at these nodes.
fn squares(nodes: Value) -> (Value, Buffer) {
    let mut buffer = Buffer::default();
    let square = buffer.square();
    let entries = json!({ "meshes": [{ "primitives": [square] }], "nodes": nodes });
    (entries, buffer)
}

#[test]
fn a_child_is_placed_by_its_own_transform_and_then_its_parents() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let (entries, buffer) = squares(json!([
        { "translation": [10, 0, 0], "rotation": [0, 0, half, half], "children": [1] },
        { "matrix": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  1, 0, 0, 1], "children": [2] },
        { "scale": [2, 3, 1], "mesh": 0 },
    ]));
    let scene = scene(entries, &buffer);
    let corner = triangles(&scene.shapes[0])[0][1].to_array();
    // (1, 0, 0) is stretched to (2, 0, 0), moved to (3, 0, 0), turned to (0, 3, 0), moved to (10, 3, 0): up is z here.
    assert!(close(corner, [10.0, 0.0, 3.0]), "{corner:?}");
    assert!(close(vector_area(&scene.shapes[0]), [0.0, -6.0, 0.0]));
}

#[test]
fn mirrored_surfaces_keep_their_front() {
    let (entries, buffer) = squares(json!([{ "mesh": 0, "scale": [-1, 1, 1] }]));
    let area = vector_area(&scene(entries, &buffer).shapes[0]);
    assert!(close(area, [0.0, -1.0, 0.0]), "{area:?}");
}

#[test]
fn copies_share_their_triangles() {
    let (entries, buffer) =
        squares(json!([{ "mesh": 0 }, { "mesh": 0, "translation": [2, 0, 0] }]));
    let scene = scene(entries, &buffer);
    assert_eq!(scene.shapes.len(), 2);
    assert!(std::ptr::eq(mesh(&scene.shapes[0]), mesh(&scene.shapes[1])));
    assert_eq!(scene.materials.len(), 1);
}

#[test]
fn instances_are_placed_within_their_node() {
    let (mut entries, mut buffer) = squares(json!([]));
    let translation = buffer.floats(&[[0.0, 1.0, 0.0], [0.0, 2.0, 0.0]]);
    let scale = buffer.floats(&[[1.0; 3], [3.0, 1.0, 1.0]]);
    entries["nodes"] = json!([{
        "mesh": 0, "scale": [10, 10, 10],
        "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": translation, "SCALE": scale } } },
    }]);
    let scene = scene(entries, &buffer);
    let corners = scene
        .shapes
        .iter()
        .map(|shape| triangles(shape)[0][1].to_array());
    assert_eq!(
        corners.collect::<Vec<_>>(),
        [[10.0, 0.0, 10.0], [30.0, 0.0, 20.0]]
    );
}

#[test]
fn only_the_chosen_scene_is_read() {
    let (mut entries, buffer) = squares(json!([{ "mesh": 0 }, { "mesh": 0 }, { "mesh": 0 }]));
    entries["scenes"] = json!([{ "nodes": [0] }, { "nodes": [1, 2] }]);
    assert_eq!(scene(entries.clone(), &buffer).shapes.len(), 1);
    entries["scene"] = json!(1);
    assert_eq!(scene(entries, &buffer).shapes.len(), 2);
}

#[test]
fn nodes_form_trees() {
    for (nodes, scenes, says) in [
        (
            json!([{ "children": [1] }, { "children": [0] }]),
            json!([{ "nodes": [0] }]),
            "nodes[0]: it is reached twice",
        ),
        (
            json!([{ "children": [2] }, { "children": [2] }, { "mesh": 0 }]),
            json!([]),
            "nodes[2]: it is reached twice",
        ),
        (
            json!([{ "children": [7] }]),
            json!([]),
            "nodes[0]: there is no node 7; there are 1",
        ),
        (
            json!([{ "mesh": 3 }]),
            json!([]),
            "nodes[0]: there is no mesh 3; there are 1",
        ),
        (
            json!([{ "mesh": 0 }]),
            json!([{ "nodes": [4] }]),
            "scenes[0]: there is no node 4",
        ),
        (
            json!([{ "mesh": 0, "rotation": [0, 0, 0, 0] }]),
            json!([]),
            "nodes[0]: its rotation is no quaternion",
        ),
        (
            json!([{ "mesh": 0, "matrix": [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }]),
            json!([]),
            "not affine",
        ),
    ] {
        let (mut entries, buffer) = squares(nodes);
        entries["scenes"] = scenes;
        let found = refusal(entries, &buffer);
        assert!(found.contains(says), "{found}");
    }
}

#[test]
fn a_long_chain_of_nodes_is_followed() {
    let last = 50_000;
    let nodes = (0..=last).map(|node| match node {
        _ if node == last => json!({ "mesh": 0 }),
        _ => json!({ "children": [node + 1], "translation": [0.001, 0, 0] }),
    });
    let (entries, buffer) = squares(nodes.collect());
    let corner = triangles(&scene(entries, &buffer).shapes[0])[0][0].to_array();
    assert!(close(corner, [50.0, 0.0, 0.0]), "{corner:?}");
}

#[test]
fn a_camera_looks_along_its_nodes_negative_z() {
    let (mut entries, buffer) = squares(json!([
        { "mesh": 0 },
        { "name": "eye", "camera": 0, "translation": [0, 1, 5] },
        { "name": "eye", "camera": 0, "translation": [0, 1, 6] },
    ]));
    let yfov = 2.0 * libm::atan(0.5);
    entries["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": yfov, "aspectRatio": 2.0, "znear": 0.1 } }]);
    let scene = scene(entries, &buffer);
    let names: Vec<_> = scene
        .sensors
        .iter()
        .map(|sensor| sensor.name.as_str())
        .collect();
    assert_eq!(names, ["eye", "eye (2)"]);
    let SensorKind::Camera(camera) = &scene.sensors[0].kind else {
        panic!("{:?}", scene.sensors[0]);
    };
    assert_eq!(camera.position.to_array(), [0.0, -5.0, 1.0]);
    assert_eq!(
        (camera.look_at - camera.position).to_array(),
        [0.0, 1.0, 0.0]
    );
    assert_eq!(camera.up.to_array(), [0.0, 0.0, 1.0]);
    let Projection::Perspective { fov } = camera.projection else {
        panic!("{:?}", camera.projection);
    };
    // tan(fov/2) = 2 · ½.
    assert!((fov.to_degrees() - 90.0).abs() < 1e-12);
    assert_eq!(camera.resolution, [1440, 720]);
}

#[test]
fn an_orthographic_camera_shows_twice_its_magnification() {
    let (mut entries, buffer) = squares(json!([{ "mesh": 0 }, { "camera": 0 }]));
    let half_sides = json!({ "xmag": 3, "ymag": 1.5, "znear": 0, "zfar": 10 });
    entries["cameras"] = json!([{ "type": "orthographic", "orthographic": half_sides }]);
    let scene = scene(entries, &buffer);
    let SensorKind::Camera(camera) = &scene.sensors[0].kind else {
        panic!("{:?}", scene.sensors[0]);
    };
    let width = Length::from_metres(6.0);
    assert_eq!(camera.projection, Projection::Orthographic { width });
    assert_eq!(camera.resolution, [1440, 720]);
}

#[test]
fn the_camera_of_a_file_without_one_has_everything_in_its_picture() {
    for scale in [[1.0, 1.0, 1.0], [100.0, 0.01, 1.0], [0.001, 7.0, 1.0]] {
        let (entries, buffer) = squares(json!([{ "mesh": 0, "scale": scale }, { "mesh": 0 }]));
        let scene = scene(entries, &buffer);
        let SensorKind::Camera(camera) = &scene.sensors[0].kind else {
            panic!("{:?}", scene.sensors[0]);
        };
        let ahead = camera.look_at - camera.position;
        let right = ahead.cross(camera.up);
        let up = right.cross(ahead);
        let share = |point: Point, across: Vector| {
            let seen = point - camera.position;
            (seen.dot(across) / across.length()).abs() / (seen.dot(ahead) / ahead.length())
        };
        let corners = scene.shapes.iter().flat_map(triangles).flatten();
        let most = corners.fold([0.0, 0.0], |[x, y]: [f64; 2], corner| {
            [x.max(share(corner, right)), y.max(share(corner, up))]
        });
        // The tangents of half the angles of view, and none too small.
        let filled = (most[0] / 0.414_22).max(most[1] / 0.310_67);
        assert!(filled < 1.0 && filled > 0.8, "{scale:?}: {most:?}");
    }
}

#[test]
fn a_file_without_camera_and_light_is_shown_nevertheless() {
    let (entries, buffer) = squares(json!([{ "mesh": 0 }]));
    let scene = scene(entries, &buffer);
    assert_eq!((scene.sensors.len(), scene.lights.len()), (1, 2));
    let told = |text: &str| scene.warnings.iter().any(|warning| warning.contains(text));
    assert!(told("no camera") && told("sky of 500 lx") && told("z points up"));
}
