//! Small glTF files.

use std::path::Path;

use serde_json::{Value, json};
use steradian::geometry::Point;
use steradian::scene::description::{
    GeometryDescription, MeshData, SceneDescription, ShapeDescription,
};
use steradian_io::files::MemoryFiles;
use steradian_io::import::gltf::{self, GltfError};

/// The one buffer of a file, with its views and accessors.
#[derive(Default)]
pub struct Buffer {
    pub bytes: Vec<u8>,
    pub views: Vec<Value>,
    pub accessors: Vec<Value>,
}

impl Buffer {
    /// A view of these bytes.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        self.views.push(view);
        self.bytes.extend(bytes);
        self.views.len() - 1
    }

    /// An accessor of elements of this type.
    pub fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.accessors.push(json!({
            "bufferView": view, "componentType": component, "count": count, "type": kind,
        }));
        self.accessors.len() - 1
    }

    /// An accessor of vectors of floats.
    pub fn floats<const N: usize>(&mut self, vectors: &[[f32; N]]) -> usize {
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        let bytes: Vec<u8> = vectors
            .as_flattened()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect();
        self.accessor(kind, 5126, vectors.len(), &bytes)
    }

    /// An accessor of vertex numbers.
    pub fn indices(&mut self, numbers: &[u16]) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor("SCALAR", 5123, numbers.len(), &bytes)
    }

    /// The unit square of the plane z = 0, its front towards +z, with its own coordinates as (u, v) of glTF.
    pub fn square(&mut self) -> Value {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let positions = self.floats(&corners.map(|[x, y]| [x, y, 0.0]));
        let coordinates = self.floats(&corners);
        let indices = self.indices(&[0, 1, 2, 0, 2, 3]);
        json!({
            "attributes": { "POSITION": positions, "TEXCOORD_0": coordinates },
            "indices": indices,
        })
    }
}

/// A GLB of these entries and this buffer.
pub fn glb(mut entries: Value, buffer: &Buffer) -> Vec<u8> {
    let given = [
        ("asset", json!({ "version": "2.0" })),
        ("buffers", json!([{ "byteLength": buffer.bytes.len() }])),
        ("bufferViews", json!(buffer.views)),
        ("accessors", json!(buffer.accessors)),
    ];
    for (key, value) in given {
        if entries.get(key).is_none() {
            entries[key] = value;
        }
    }
    let mut text = entries.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut binary = buffer.bytes.clone();
    binary.resize(binary.len().next_multiple_of(4), 0);
    container(&text, &binary)
}

fn container(text: &[u8], binary: &[u8]) -> Vec<u8> {
    let word = |number: usize| (number as u32).to_le_bytes();
    let length = 28 + text.len() + binary.len();
    let mut bytes = [b"glTF".as_slice(), &word(2), &word(length)].concat();
    bytes.extend([&word(text.len()), b"JSON".as_slice(), text].concat());
    bytes.extend([&word(binary.len()), b"BIN\0".as_slice(), binary].concat());
    bytes
}

/// What is read from a file of these bytes.
pub fn read(bytes: Vec<u8>) -> Result<SceneDescription, GltfError> {
    let files = MemoryFiles::default().with("scene.glb", bytes);
    gltf::read(Path::new("scene.glb"), &files).map(|imported| imported.description)
}

/// The scene of these entries, which must be readable.
pub fn scene(entries: Value, buffer: &Buffer) -> SceneDescription {
    read(glb(entries, buffer)).unwrap_or_else(|error| panic!("{error}"))
}

/// Why these entries cannot be read.
pub fn refusal(entries: Value, buffer: &Buffer) -> String {
    let refused = read(glb(entries, buffer)).expect_err("a readable file");
    refused.to_string()
}

/// The mesh of a shape.
pub fn mesh(shape: &ShapeDescription) -> &MeshData {
    match &shape.geometry {
        GeometryDescription::Mesh(mesh) => mesh,
        other => panic!("{}", other.kind()),
    }
}

/// The corners of a shape's triangles in the scene, counter-clockwise from the front of each.
pub fn triangles(shape: &ShapeDescription) -> Vec<[Point; 3]> {
    let mesh = mesh(shape);
    let corner = |index: u32| shape.transform.point(mesh.vertices[index as usize]);
    let placed = mesh.triangles.iter().map(|triangle| triangle.map(corner));
    if shape.transform.is_mirroring() {
        placed.map(|[a, b, c]| [a, c, b]).collect()
    } else {
        placed.collect()
    }
}

/// ½ Σ (b − a) × (c − a), the vector area.
pub fn vector_area(shape: &ShapeDescription) -> [f64; 3] {
    let areas = triangles(shape)
        .into_iter()
        .map(|[a, b, c]| (b - a).cross(c - a) * 0.5);
    areas
        .fold(steradian::geometry::Vector::ZERO, |sum, area| sum + area)
        .to_array()
}

/// Whether two triples are equal but for rounding of f32.
pub fn close(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}
