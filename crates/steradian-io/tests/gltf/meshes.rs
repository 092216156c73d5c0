use serde_json::json;
use steradian::geometry::Point;

use crate::building::{Buffer, close, mesh, refusal, scene, vector_area};

const CORNERS: [[f32; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [2.0, 0.0, 0.0],
    [2.0, 3.0, 0.0],
    [0.0, 3.0, 0.0],
];

#[test]
fn triangles_strips_and_fans_cover_the_same_rectangle() {
    for (mode, order) in [
        (4, &[0, 1, 2, 0, 2, 3][..]),
        (5, &[0, 1, 3, 2]),
        (6, &[0, 1, 2, 3]),
    ] {
        let mut buffer = Buffer::default();
        let positions = buffer.floats(&CORNERS);
        let indices = buffer.indices(order);
        let primitive =
            json!({ "attributes": { "POSITION": positions }, "indices": indices, "mode": mode });
        let entries =
            json!({ "meshes": [{ "primitives": [primitive] }], "nodes": [{ "mesh": 0 }] });
        let scene = scene(entries, &buffer);
        // z towards the viewer becomes −y.
        let area = vector_area(&scene.shapes[0]);
        assert!(close(area, [0.0, -6.0, 0.0]), "mode {mode}: {area:?}");
    }
}

#[test]
fn without_indices_corners_follow_one_another() {
    let mut buffer = Buffer::default();
    let positions = buffer.floats(&CORNERS[..3]);
    let primitive = json!({ "attributes": { "POSITION": positions } });
    let entries = json!({ "meshes": [{ "primitives": [primitive] }], "nodes": [{ "mesh": 0 }] });
    let scene = scene(entries, &buffer);
    assert_eq!(mesh(&scene.shapes[0]).triangles, [[0, 1, 2]]);
}

#[test]
fn sparse_elements_replace_others() {
    let mut buffer = Buffer::default();
    let positions = buffer.floats(&CORNERS);
    let numbers = buffer.view(&[1_u16, 2].map(u16::to_le_bytes).concat());
    let values = [[5.0_f32, 0.0, 0.0], [5.0, 3.0, 0.0]];
    let values = buffer.view(
        &values
            .as_flattened()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect::<Vec<_>>(),
    );
    buffer.accessors[positions]["sparse"] = json!({
        "count": 2,
        "indices": { "bufferView": numbers, "componentType": 5123 },
        "values": { "bufferView": values },
    });
    let indices = buffer.indices(&[0, 1, 2, 0, 2, 3]);
    let primitive = json!({ "attributes": { "POSITION": positions }, "indices": indices });
    let entries = json!({ "meshes": [{ "primitives": [primitive] }], "nodes": [{ "mesh": 0 }] });
    assert!(close(
        vector_area(&scene(entries, &buffer).shapes[0]),
        [0.0, -15.0, 0.0]
    ));
}

#[test]
fn quantised_and_interleaved_attributes_are_read() {
    let mut buffer = Buffer::default();
    // Three vertices of x, y, z in i16 (normalised), two bytes apart, then r, g, b in u8.
    let vertices: [([i16; 3], [u8; 3]); 3] = [
        ([0, 0, 0], [255, 0, 0]),
        ([32_767, 0, 0], [0, 51, 0]),
        ([0, -32_768, 0], [0, 0, 255]),
    ];
    let bytes: Vec<u8> = vertices
        .iter()
        .flat_map(|(position, color)| {
            let position = position.iter().flat_map(|x| x.to_le_bytes());
            position
                .chain([0, 0])
                .chain(*color)
                .chain([0])
                .collect::<Vec<_>>()
        })
        .collect();
    let positions = buffer.accessor("VEC3", 5122, 3, &bytes);
    buffer.views[0]["byteStride"] = json!(12);
    buffer.accessors[positions]["normalized"] = json!(true);
    buffer.accessors.push(json!({
        "bufferView": 0, "byteOffset": 8, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC3",
    }));
    let primitive = json!({ "attributes": { "POSITION": positions, "COLOR_0": 1 } });
    let entries = json!({
        "extensionsRequired": ["KHR_mesh_quantization"],
        "meshes": [{ "primitives": [primitive] }], "nodes": [{ "mesh": 0 }],
    });
    let scene = scene(entries, &buffer);
    let mesh = mesh(&scene.shapes[0]);
    assert_eq!(
        mesh.vertices[1..],
        [Point::new(1.0, 0.0, 0.0), Point::new(0.0, -1.0, 0.0)]
    );
    assert_eq!(mesh.colors[1], [0.0, 0.2, 0.0, 1.0]);
}

#[test]
fn points_and_lines_are_left_out_and_said_to_be() {
    let mut buffer = Buffer::default();
    let square = buffer.square();
    let lines = json!({ "attributes": { "POSITION": 0 }, "mode": 1 });
    let entries =
        json!({ "meshes": [{ "primitives": [lines, square] }], "nodes": [{ "mesh": 0 }] });
    let scene = scene(entries, &buffer);
    assert_eq!(scene.shapes.len(), 1);
    let told = "glTF: points, lines and empty primitives are left out (primitives: 1)";
    assert!(scene.warnings.iter().any(|warning| warning == told));
}

#[test]
fn what_reaches_beyond_is_refused_with_its_place() {
    let square = |change: fn(&mut Buffer)| {
        let mut buffer = Buffer::default();
        let square = buffer.square();
        change(&mut buffer);
        let entries = json!({ "meshes": [{ "primitives": [square] }], "nodes": [{ "mesh": 0 }] });
        refusal(entries, &buffer)
    };
    for (change, says) in [
        (
            (|buffer| buffer.accessors[0]["count"] = json!(5)) as fn(&mut Buffer),
            "accessors[0]: its 5 elements reach beyond the 48 bytes of buffer view 0",
        ),
        (
            |buffer| buffer.accessors[0]["count"] = json!(u64::MAX),
            "accessors[0]: its 18446744073709551615 elements reach beyond",
        ),
        (
            |buffer| buffer.accessors[0]["count"] = json!(2),
            "accessors[2]: element 2 is vertex 2, but meshes[0].primitives[0] has 2 vertices",
        ),
        (
            |buffer| buffer.accessors[0]["bufferView"] = json!(9),
            "accessors[0]: there is no buffer view 9; there are 3",
        ),
        (
            |buffer| buffer.views[0]["byteLength"] = json!(4000),
            "bufferViews[0]: 4000 bytes from byte 0 reach beyond the 92 bytes of buffer 0",
        ),
        (
            |buffer| buffer.bytes[..4].copy_from_slice(&f32::NAN.to_le_bytes()),
            "accessors[0]: element 0 is not finite",
        ),
        (
            |buffer| buffer.accessors[2]["componentType"] = json!(5122),
            "accessors[2]: vertices are numbered by unsigned integers",
        ),
        (
            |buffer| buffer.accessors[0]["componentType"] = json!(7),
            "accessors[0]: there is no component type 7",
        ),
        (
            |buffer| buffer.views[0]["byteStride"] = json!(8),
            "accessors[0]: its elements of 12 bytes overlap at a stride of 8",
        ),
        (
            |buffer| buffer.accessors[0]["type"] = json!("MAT4"),
            "accessors[0]: expected VEC3, found \"MAT4\"",
        ),
    ] {
        let found = square(change);
        assert!(found.contains(says), "{found}");
    }
}

#[test]
fn counts_without_bytes_are_bounded() {
    let buffer = Buffer::default();
    let primitive = json!({ "attributes": { "POSITION": 0 } });
    let entries = json!({
        "accessors": [{ "componentType": 5126, "count": 4_000_000_000_u32, "type": "VEC3" }],
        "meshes": [{ "primitives": [primitive] }], "nodes": [{ "mesh": 0 }],
    });
    let says = "more than 1048576 elements in a file of this size";
    assert_eq!(refusal(entries, &buffer), says);
}

#[test]
fn elements_named_again_and_again_are_bounded() {
    let mut buffer = Buffer::default();
    let corners: Vec<[f32; 3]> = (0..999)
        .map(|i| [(i % 3) as f32, (i % 2) as f32, 0.0])
        .collect();
    let positions = buffer.floats(&corners);
    let primitives: Vec<_> = (0..2000)
        .map(|_| json!({ "attributes": { "POSITION": positions } }))
        .collect();
    let entries = json!({ "meshes": [{ "primitives": primitives }], "nodes": [{ "mesh": 0 }] });
    // 2²⁰ + 4 · 999 · 12.
    assert_eq!(
        refusal(entries, &buffer),
        "more than 1096528 elements in a file of this size"
    );
}

#[test]
fn normals_of_all_vertices_are_kept() {
    let with = |last: [f32; 3]| {
        let mut buffer = Buffer::default();
        let mut square = buffer.square();
        let up = [0.0, 0.0, 2.0];
        square["attributes"]["NORMAL"] = json!(buffer.floats(&[up, up, up, last]));
        let entries = json!({ "meshes": [{ "primitives": [square] }], "nodes": [{ "mesh": 0 }] });
        scene(entries, &buffer)
    };
    let found = with([0.0, 3.0, 4.0]);
    let normals = &mesh(&found.shapes[0]).normals;
    assert_eq!(normals[2..], [[0.0, 0.0, 1.0], [0.0, 0.6, 0.8]]);
    let told = "glTF: normals of vertices are left out: some are missing, of no length or not finite (primitives: 1)";
    assert!(!found.warnings.iter().any(|warning| warning == told));
    for last in [[0.0; 3], [0.0, f32::NAN, 1.0]] {
        let found = with(last);
        assert!(mesh(&found.shapes[0]).normals.is_empty());
        assert!(found.warnings.iter().any(|warning| warning == told));
    }
}
