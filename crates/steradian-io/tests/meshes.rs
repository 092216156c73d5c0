//! Mesh files that are scenes: the same mesh gives the same picture in every format.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use std::path::Path;

use serde_json::json;
use steradian::estimation::{Plan, Silent, Stopping};
use steradian::scene::Scene;
use steradian::transport::{Picture, RenderOptions, render};
use steradian_io::files::MemoryFiles;
use steradian_io::scene_file::{LoadedScene, read_scene};

/// A floor and a pyramid without base on it, z up. All numbers are exact in 32 bits and in decimals.
const VERTICES: [[f32; 3]; 9] = [
    [-2.0, -2.0, -0.5],
    [2.0, -2.0, -0.5],
    [2.0, 2.0, -0.5],
    [-2.0, 2.0, -0.5],
    [-1.0, -1.0, -0.25],
    [1.0, -1.0, -0.25],
    [1.0, 1.0, -0.25],
    [-1.0, 1.0, -0.25],
    [0.25, 0.125, 1.5],
];
const FACES: [&[usize]; 5] = [
    &[0, 1, 2, 3],
    &[4, 5, 8],
    &[5, 6, 8],
    &[6, 7, 8],
    &[7, 4, 8],
];

fn triangles() -> Vec<[usize; 3]> {
    let fan = |face: &&'static [usize]| {
        let face: &'static [usize] = face;
        (2..face.len()).map(move |last| [face[0], face[last - 1], face[last]])
    };
    FACES.iter().flat_map(fan).collect()
}

/// The vertex in a file whose y axis points up.
fn y_up([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, z, -y]
}

fn obj() -> Vec<u8> {
    let vertices = VERTICES.map(|vertex| format!("v {}\n", words(&y_up(vertex))));
    let faces = FACES.map(|face| {
        format!(
            "f {}\n",
            words(&face.iter().map(|i| i + 1).collect::<Vec<_>>())
        )
    });
    [vertices.concat(), faces.concat()].concat().into_bytes()
}

fn words<T: ToString>(numbers: &[T]) -> String {
    numbers
        .iter()
        .map(T::to_string)
        .collect::<Vec<_>>()
        .join(" ")
}

fn ply_header(format: &str) -> String {
    let axes = "property float x\nproperty float y\nproperty float z\n";
    format!(
        "ply\nformat {format} 1.0\nelement vertex {}\n{axes}element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        VERTICES.len(),
        FACES.len()
    )
}

fn ply_text() -> Vec<u8> {
    let vertices = VERTICES.map(|vertex| format!("{}\n", words(&vertex)));
    let faces = FACES.map(|face| format!("{} {}\n", face.len(), words(face)));
    [ply_header("ascii"), vertices.concat(), faces.concat()]
        .concat()
        .into_bytes()
}

fn ply_big_endian() -> Vec<u8> {
    let mut bytes = ply_header("binary_big_endian").into_bytes();
    bytes.extend(
        VERTICES
            .iter()
            .flatten()
            .flat_map(|number| number.to_be_bytes()),
    );
    for face in FACES {
        bytes.push(face.len() as u8);
        bytes.extend(
            face.iter()
                .flat_map(|corner| (*corner as u32).to_be_bytes()),
        );
    }
    bytes
}

fn stl() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles().len() as u32).to_le_bytes());
    for triangle in triangles() {
        bytes.extend([0; 12]);
        let corners = triangle.map(|corner| VERTICES[corner]);
        bytes.extend(
            corners
                .as_flattened()
                .iter()
                .flat_map(|number| number.to_le_bytes()),
        );
        bytes.extend([0; 2]);
    }
    bytes
}

/// Of the default grey.
fn glb() -> Vec<u8> {
    let mut data: Vec<u8> = VERTICES
        .map(y_up)
        .as_flattened()
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    let positions = data.len();
    data.extend(
        triangles()
            .as_flattened()
            .iter()
            .flat_map(|corner| (*corner as u32).to_le_bytes()),
    );
    let colour = json!({ "baseColorFactor": [0.5, 0.5, 0.5, 1] });
    // Without gloss, as the other formats are.
    let material =
        json!({ "pbrMetallicRoughness": colour, "extensions": { "KHR_materials_unlit": {} } });
    let document = json!({
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": data.len() }],
        "bufferViews": [
            { "buffer": 0, "byteLength": positions },
            { "buffer": 0, "byteOffset": positions, "byteLength": data.len() - positions },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": VERTICES.len(), "type": "VEC3" },
            { "bufferView": 1, "componentType": 5125, "count": 3 * triangles().len(), "type": "SCALAR" },
        ],
        "materials": [material],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "nodes": [{ "mesh": 0 }],
    });
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let chunk = |kind: &[u8; 4], content: &[u8]| {
        [&(content.len() as u32).to_le_bytes(), &kind[..], content].concat()
    };
    let chunks = [chunk(b"JSON", &text), chunk(b"BIN\0", &data)].concat();
    let header = [
        &b"glTF"[..],
        &2_u32.to_le_bytes(),
        &(chunks.len() as u32 + 12).to_le_bytes(),
    ]
    .concat();
    [header, chunks].concat()
}

/// The mesh in a scene file that says what a mesh file by itself takes for granted.
const SCENE: &str = r#"
[scene]
spectrum = "rgb"
[materials.grey]
model = "lambertian"
reflectance = 0.5
[[shapes]]
kind = "mesh"
file = "a.obj"
unit = "m"
up = "y"
material = "grey"
[[lights]]
kind = "environment"
radiance = "159.15494309189535 cd/m2"
[[lights]]
kind = "directional"
direction = [0.5, 0.6, -1.2]
irradiance = "1000 lx"
[[sensors]]
kind = "camera"
name = "camera"
"#;

fn load(name: &str, files: &MemoryFiles) -> LoadedScene {
    read_scene(Path::new(name), files).unwrap()
}

fn picture(loaded: &LoadedScene) -> Picture {
    let scene = Scene::new(&loaded.description).unwrap();
    let plan = Plan {
        stop: Stopping::at_samples(16),
        replicates: 2,
        ..Plan::default()
    };
    let options = RenderOptions {
        plan,
        resolution: Some([40, 30]),
        ..RenderOptions::default()
    };
    render(&scene, 0, &options, &mut Silent).unwrap()
}

fn lanes(picture: &Picture) -> String {
    serde_json::to_string(&picture.exposure).unwrap()
}

#[test]
fn every_format_gives_the_same_picture_bit_for_bit() {
    // Coordinates are exact in every format, and a turn by 90° is exact, so that nothing is rounded differently.
    let files = MemoryFiles::default()
        .with("a.obj", obj())
        .with("a.ply", ply_text())
        .with("b.ply", ply_big_endian())
        .with("a.stl", stl())
        .with("a.glb", glb());
    let first = load("a.obj", &files);
    let expected = lanes(&picture(&first));
    for name in ["a.ply", "b.ply", "a.stl", "a.glb"] {
        assert!(lanes(&picture(&load(name, &files))) == expected, "{name}");
    }
    let camera = &first.description.sensors[0];
    let steradian::scene::description::SensorKind::Camera(camera) = &camera.kind else {
        panic!("{camera:?}")
    };
    let numbers = |[x, y, z]: [f64; 3]| format!("[{x:?}, {y:?}, {z:?}]");
    let keys = format!(
        "position = {}\nlook_at = {}\nfov = \"45 deg\"\nresolution = [960, 720]\n",
        numbers(camera.position.to_array()),
        numbers(camera.look_at.to_array())
    );
    for (file, up) in [
        ("a.obj", "up = \"y\""),
        ("a.ply", "up = \"z\""),
        ("a.glb", ""),
    ] {
        let text = format!("{SCENE}{keys}")
            .replace("a.obj", file)
            .replace("up = \"y\"", up);
        let scene = load("a.toml", &files.clone().with("a.toml", text));
        assert!(
            lanes(&picture(&scene)) == expected,
            "{file} in a scene file"
        );
    }
}
