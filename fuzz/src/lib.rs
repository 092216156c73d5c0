//! Readers fed with any bytes: each must end soon, in little memory, with a result or an error, and keep its promises.
//!
//! One function a target. `crates/steradian-io/tests/fuzz_inputs.rs` runs them too, on the seeds and on everything that
//! once made one of them fail.

use std::path::Path;

use steradian::brdf::Scatter;
use steradian::geometry::{Direction, Vector};
use steradian::measurement::Measurements;
use steradian::scene::description::{GeometryDescription, MeshData, SceneDescription};
use steradian::spectrum::Beyond;
use steradian::transport::Picture;
use steradian_io::diagnostic::render;
use steradian_io::files::MemoryFiles;
use steradian_io::import::boundaries::{BoundaryLine, read_boundaries};
use steradian_io::import::image::Encoding;
use steradian_io::import::{
    MeshFile, bsdf, gltf, image, luminance_map as maps, obj, photometry, ply, points, series,
    spectrum, stl,
};
use steradian_io::report::{Shard, csv, html, json, stored, table};
use steradian_io::scene_file::read_scene_str;

/// A target and what it does with bytes.
pub type Target = (&'static str, fn(&[u8]));

/// Every target.
pub const TARGETS: [Target; 21] = [
    ("scene_file", scene_file),
    ("obj", obj),
    ("mtl", mtl),
    ("ply", ply),
    ("stl", stl),
    ("gltf", gltf),
    ("glb", glb),
    ("image", image),
    ("spectrum_csv", spectrum_csv),
    ("bsdf_xml", bsdf_xml),
    ("merl", merl),
    ("rgl", rgl),
    ("ies", ies),
    ("ldt", ldt),
    ("tm33", tm33),
    ("luminance_map", luminance_map),
    ("points", points),
    ("series", series),
    ("boundaries", boundaries),
    ("shard", shard),
    ("stored", stored),
];

/// A picture of one texel.
const PICTURE: &[u8] = b"#?RADIANCE\n\n-Y 1 +X 1\n\x80\x80\x80\x81";

/// Scene files: read, or every problem shown.
pub fn scene_file(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else {
        return;
    };
    let files = MemoryFiles::default()
        .with(
            "a.obj",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n",
        )
        .with("a.hdr", PICTURE);
    match read_scene_str("scene.toml", text, &files) {
        Ok(scene) => assert_meshes_are_sound(&scene.description),
        Err(problems) => assert!(!render(&problems, false).is_empty()),
    }
}

/// OBJ files.
pub fn obj(bytes: &[u8]) {
    let files = MemoryFiles::default().with("a.mtl", "newmtl a\nKd 1 0 0\nKe 1 2 3\n");
    if let Ok(file) = obj::read(bytes, Path::new(""), &files) {
        assert_is_sound(&file);
    }
}

/// Material libraries of OBJ files.
pub fn mtl(bytes: &[u8]) {
    let files = MemoryFiles::default().with("a.hdr", PICTURE);
    let _ = obj::mtl::read(bytes, Path::new(""), &files);
}

/// PLY files.
pub fn ply(bytes: &[u8]) {
    if let Ok(file) = ply::read(bytes) {
        assert_is_sound(&file);
    }
}

/// STL files.
pub fn stl(bytes: &[u8]) {
    if let Ok(file) = stl::read(bytes) {
        assert_is_sound(&file);
    }
}

/// glTF scenes in text.
pub fn gltf(bytes: &[u8]) {
    read_gltf("a.gltf", bytes);
}

/// glTF scenes in binary.
pub fn glb(bytes: &[u8]) {
    read_gltf("a.glb", bytes);
}

fn read_gltf(name: &str, bytes: &[u8]) {
    let files = MemoryFiles::default().with(name, bytes);
    if let Ok(scene) = gltf::read(Path::new(name), &files) {
        assert_meshes_are_sound(&scene.description);
    }
}

/// Pictures of every format.
pub fn image(bytes: &[u8]) {
    for encoding in [Encoding::Srgb, Encoding::Linear] {
        if let Ok(picture) = image::read(bytes, encoding) {
            assert!(
                picture
                    .at([0.3, 0.7])
                    .iter()
                    .all(|channel| channel.is_finite())
            );
        }
    }
}

/// Spectra in CSV files.
pub fn spectrum_csv(bytes: &[u8]) {
    for column in [None, Some("white")] {
        if let Ok(curve) = spectrum::read(bytes, column, Beyond::Held) {
            assert!(curve.at(550.0).is_finite());
        }
    }
}

/// BSDF XML of LBNL.
pub fn bsdf_xml(bytes: &[u8]) {
    match bsdf::xml::read(bytes) {
        Ok(file) => assert_scatters(&file),
        Err(error) => assert!(error.to_string().starts_with("line ")),
    }
}

/// IES LM-63.
pub fn ies(bytes: &[u8]) {
    luminaire("a.ies", bytes);
}

/// EULUMDAT.
pub fn ldt(bytes: &[u8]) {
    luminaire("a.ldt", bytes);
}

/// IES TM-33.
pub fn tm33(bytes: &[u8]) {
    luminaire("a.xml", bytes);
}

/// Luminaires: a table that can be integrated and looked at, or a message.
fn luminaire(name: &str, bytes: &[u8]) {
    let files = MemoryFiles::default()
        .with(name, bytes)
        .with("a.tlt", "1\n2\n0 90\n1 .5\n");
    match photometry::read(Path::new(name), &files) {
        Ok(lamp) => {
            // Sums of the greatest numbers overflow.
            let flux = lamp.far_field.flux();
            assert!(flux >= 0.0 || flux.is_nan());
            for direction in [Direction::X, -Direction::Y, -Direction::Z] {
                assert!(lamp.far_field.intensity(direction) >= 0.0);
                assert!(lamp.projected_area(direction).to_square_metres() >= 0.0);
            }
        }
        Err(problems) => assert!(!render(&problems, false).is_empty()),
    }
}

/// Pictures of luminance: the first byte tells the format.
pub fn luminance_map(bytes: &[u8]) {
    let Some((format, bytes)) = bytes.split_first() else {
        return;
    };
    let name = ["a.pfm", "a.hdr", "a.exr"][usize::from(format % 3)];
    let files = MemoryFiles::default().with(name, bytes);
    if let Ok(map) = maps::read(Path::new(name), &files) {
        assert_eq!(
            map.luminances.len(),
            map.size[0] as usize * map.size[1] as usize
        );
    }
}

/// Tables of MERL; a whole one has 35 MB, so that headers are read, not values.
pub fn merl(bytes: &[u8]) {
    match bsdf::merl::read(bytes) {
        Ok(file) => assert_scatters(&file),
        Err(error) => assert!(error.to_string().starts_with("byte ")),
    }
}

/// Tensor files of RGL.
pub fn rgl(bytes: &[u8]) {
    match bsdf::rgl::read(bytes) {
        Ok(file) => assert_scatters(&file),
        Err(error) => assert!(error.to_string().starts_with("byte ")),
    }
}

/// Values and densities are not negative, and samples tell their own.
fn assert_scatters(file: &bsdf::MeasuredFile) {
    let upwards = Direction::new(Vector::new(0.3, -0.4, 0.8)).unwrap_or(Direction::Z);
    for band in &file.bands {
        for wo in [upwards, -upwards] {
            assert!(
                band.model
                    .evaluate(wo, upwards)
                    .to_lanes()
                    .iter()
                    .all(|value| *value >= 0.0)
            );
            if let Some(scatter) = band.model.sample(wo, [0.3, 0.7]) {
                let density = band.model.pdf(wo, scatter.wi());
                assert!(
                    density > 0.0
                        && matches!(scatter, Scatter::Finite { pdf, .. } if pdf == density)
                );
            }
        }
    }
}

/// Tables of points with normals.
pub fn points(bytes: &[u8]) {
    let files = MemoryFiles::default().with("a.csv", bytes);
    match points::read_points(Path::new("a.csv"), &files) {
        Ok(points) => assert!(!points.is_empty()),
        Err(problems) => assert!(!render(&problems, false).is_empty()),
    }
}

/// Records in time.
pub fn series(bytes: &[u8]) {
    let files = MemoryFiles::default().with("a.csv", bytes);
    match series::read_series(Path::new("a.csv"), &series::RATES, &files) {
        Ok(record) => {
            let times = record.times.len();
            assert!(times >= 2 && !record.columns.is_empty());
            assert!(
                record
                    .columns
                    .iter()
                    .all(|column| column.values.len() == times)
            );
        }
        Err(problems) => assert!(!render(&problems, false).is_empty()),
    }
}

/// Lists of what is known of surfaces that exchange heat.
pub fn boundaries(bytes: &[u8]) {
    let files = MemoryFiles::default().with("a.csv", bytes);
    match read_boundaries(Path::new("a.csv"), &files) {
        Ok(lines) => {
            let is_sound = |line: &BoundaryLine| {
                !line.surface.is_empty() && line.emissivity.is_none_or(f64::is_finite)
            };
            assert!(lines.iter().all(is_sound));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Parts of runs: as they are, and with a right checksum, so that what it protects is read too.
pub fn shard(bytes: &[u8]) {
    read_shard(bytes);
    for header in [&b""[..], b"\x02\0\0\0\0\0\0\0{}"] {
        let mut sealed = [b"STERADIAN SHARD 1\n", header, bytes].concat();
        let hash = blake3::hash(&sealed);
        sealed.extend(hash.as_bytes());
        read_shard(&sealed);
    }
}

fn read_shard(bytes: &[u8]) {
    if let Ok(shard) = Shard::decode(bytes) {
        let _ = shard.content::<Measurements>();
        let _ = shard.content::<Picture>();
    }
}

/// Results of `measure`: what was read is written in every format, and reads back as it was.
pub fn stored(bytes: &[u8]) {
    let files = MemoryFiles::default().with("a.json", bytes);
    let read = match stored::read(Path::new("a.json"), &files) {
        Ok(read) => read,
        Err(error) => return assert!(error.to_string().starts_with("a.json")),
    };
    let run = read.as_run();
    assert!(!table::encode(&run).is_empty() && csv::encode(&run).is_ok());
    let _ = html::encode(&run);
    let again = json::encode(&run).unwrap_or_default();
    let files = MemoryFiles::default().with("a.json", &again[..]);
    let again = stored::read(Path::new("a.json"), &files);
    assert!(again.is_ok_and(|again| again == read));
}

fn assert_is_sound(file: &MeshFile) {
    for part in &file.parts {
        assert_mesh_is_sound(&part.mesh);
        assert!(
            part.material
                .is_none_or(|material| material < file.materials.len())
        );
    }
}

fn assert_meshes_are_sound(description: &SceneDescription) {
    for shape in &description.shapes {
        match &shape.geometry {
            // What a scene file states itself is for the scene to check.
            GeometryDescription::Mesh(mesh) if !mesh.texture_coordinates.is_empty() => {
                assert_mesh_is_sound(mesh)
            }
            _ => (),
        }
    }
}

/// All numbers are finite, and all indices in range.
fn assert_mesh_is_sound(mesh: &MeshData) {
    let count = mesh.vertices.len();
    let mut corners = mesh.triangles.iter().flatten();
    assert!(corners.all(|corner| (*corner as usize) < count));
    assert!(mesh.vertices.iter().all(|vertex| vertex.is_finite()));
    for attributes in [mesh.texture_coordinates.len(), mesh.colors.len()] {
        assert!(attributes == 0 || attributes == count);
    }
}
