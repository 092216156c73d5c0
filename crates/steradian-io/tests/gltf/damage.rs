//! Damaged files are refused or read, never the end of the program.

use std::path::Path;

use proptest::prelude::*;
use serde_json::json;
use steradian::scene::Scene;
use steradian_io::files::MemoryFiles;
use steradian_io::scene_file::read_scene;

use crate::building::{Buffer, glb, read};

/// A file with something of everything.
fn rich() -> Vec<u8> {
    let mut buffer = Buffer::default();
    let mut square = buffer.square();
    square["material"] = json!(0);
    square["attributes"]["COLOR_0"] = json!(buffer.floats(&[[0.5, 0.5, 0.5, 1.0]; 4]));
    let numbers = buffer.view(&[1, 3]);
    let values = [1.0_f32, 0.0, 0.0, 0.0, 1.0, 0.0]
        .map(f32::to_le_bytes)
        .concat();
    let values = buffer.view(&values);
    buffer.accessors[0]["sparse"] = json!({
        "count": 2,
        "indices": { "bufferView": numbers, "componentType": 5121 },
        "values": { "bufferView": values },
    });
    let translation = buffer.floats(&[[0.0, 1.0, 0.0], [0.0, 2.0, 0.0]]);
    let picture = buffer.view(b"#?RADIANCE\n\n-Y 1 +X 1\n\x80\x80\x80\x80");
    let texture = json!({
        "index": 0,
        "extensions": { "KHR_texture_transform": { "offset": [0.1, 0.2], "rotation": 0.3, "scale": [1, 2] } },
    });
    let entries = json!({
        "scene": 0,
        "scenes": [{ "nodes": [0, 3] }],
        "nodes": [
            { "children": [1, 2], "translation": [0, 1, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 2] },
            { "mesh": 0 },
            { "camera": 0, "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "mesh": 0, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": translation } } } },
        ],
        "meshes": [{ "primitives": [square] }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.7, "aspectRatio": 1.5, "znear": 0.1 } }],
        "materials": [{
            "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.5, 0.5, 1], "baseColorTexture": texture },
            "emissiveFactor": [1, 1, 1], "alphaMode": "MASK", "alphaCutoff": 0.5,
        }],
        "images": [{ "bufferView": picture }],
        "textures": [{ "source": 0 }],
        "extensions": { "KHR_lights_punctual": { "lights": [
            { "type": "spot", "intensity": 5, "spot": { "innerConeAngle": 0.1, "outerConeAngle": 0.2 } },
        ] } },
    });
    glb(entries, &buffer)
}

#[test]
fn the_rich_file_is_whole() {
    let scene = read(rich()).unwrap();
    assert_eq!(
        (scene.shapes.len(), scene.lights.len(), scene.sensors.len()),
        (3, 1, 1)
    );
    let problems = Scene::new(&scene).err().unwrap_or_default();
    assert!(problems.is_empty(), "{problems:?}");
}

#[test]
fn a_file_cut_short_is_refused_wherever_it_ends() {
    let bytes = rich();
    for end in 0..bytes.len() {
        assert!(read(bytes[..end].to_vec()).is_err(), "{end}");
    }
}

#[test]
fn every_file_that_is_read_changes_the_hash() {
    let text = br#"{
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": 36, "uri": "a%20b.bin" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "nodes": [{ "mesh": 0 }]
    }"#;
    let hash = |x: f32| {
        let positions = [[0.0, 0.0, 0.0], [x, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let bytes = positions
            .as_flattened()
            .iter()
            .flat_map(|x| x.to_le_bytes());
        let files = MemoryFiles::default()
            .with("room/scene.gltf", &text[..])
            .with("room/a b.bin", bytes.collect::<Vec<_>>());
        let loaded = read_scene(Path::new("room/scene.gltf"), &files);
        loaded.unwrap_or_else(|found| panic!("{found:?}")).hash
    };
    assert_eq!(hash(1.0), hash(1.0));
    assert_ne!(hash(1.0), hash(2.0));
}

/// Numbers that counts, sizes and indices may be by mistake.
const NUMBERS: [&str; 9] = [
    "0",
    "1",
    "-1",
    "7",
    "1e300",
    "4294967295",
    "18446744073709551615",
    "0.5",
    "[]",
];

/// The file with the `which`-th number of its JSON replaced.
fn with_number(bytes: &[u8], which: usize, number: &str) -> Vec<u8> {
    let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
    let text = str::from_utf8(&bytes[20..20 + length]).expect("JSON");
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let starts: Vec<usize> = text
        .match_indices(|c: char| c.is_ascii_digit())
        .map(|(at, _)| at)
        .filter(|at| text[..*at].ends_with([':', ',', '[']))
        .collect();
    let start = starts[which % starts.len()];
    let end = start + text[start..].find(|c| !is_part(c)).unwrap_or(0);
    let mut text = [&text[..start], number, &text[end..]].concat().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let binary = &bytes[20 + length..];
    let word = |number: usize| (number as u32).to_le_bytes();
    let total = 20 + text.len() + binary.len();
    [
        &bytes[..8],
        &word(total),
        &word(text.len()),
        b"JSON",
        &text,
        binary,
    ]
    .concat()
}

/// Reads, and validates what could be read.
fn survives(bytes: Vec<u8>) {
    if let Ok(scene) = read(bytes) {
        let _validated = Scene::new(&scene).map_err(|problems| problems.len());
    }
}

proptest! {
    #[test]
    fn any_number_may_be_wrong(which in 0_usize..1000, number in prop::sample::select(&NUMBERS[..])) {
        survives(with_number(&rich(), which, number));
    }

    #[test]
    fn any_bytes_may_be_wrong(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = rich();
        for (index, byte) in changes {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        survives(bytes);
    }

    #[test]
    fn bytes_without_meaning_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..64)) {
        prop_assert!(read(bytes.clone()).is_err());
        prop_assert!(read([b"glTF\x02\0\0\0".as_slice(), &bytes].concat()).is_err());
    }
}
