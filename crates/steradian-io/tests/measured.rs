//! Files of measured surfaces against sums over their matrices and against Radiance.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use steradian::brdf::Measured;
use steradian::brdf::measured::{Block, Merl, PatchMatrix, Side, TwoSided};
use steradian::geometry::{Direction, Vector};
use steradian_io::files::MemoryFiles;
use steradian_io::import::bsdf::{MeasuredFile, merl, read, reciprocity, two_sided};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/bsdf")
        .join(name)
}

fn json(name: &str) -> Value {
    serde_json::from_slice(&fs::read(data(name)).unwrap()).unwrap()
}

/// A packed file: ten bytes of a gzip header without name, then the deflated data.
fn unpacked(name: &str) -> Vec<u8> {
    let packed = fs::read(data(&format!("{name}.gz"))).unwrap();
    miniz_oxide::inflate::decompress_to_vec(&packed[10..packed.len() - 8]).unwrap()
}

fn parsed(name: &str, bytes: Vec<u8>) -> MeasuredFile {
    let files = MemoryFiles::default().with(name, bytes);
    read(Path::new(name), &files).unwrap()
}

fn table<'a>(file: &'a MeasuredFile, band: &str) -> &'a TwoSided {
    let band = file.bands.iter().find(|known| known.name == band).unwrap();
    two_sided(&band.model).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap()
}

fn block<'a>(table: &'a TwoSided, direction: &str) -> &'a Block {
    let from = if direction.ends_with("Back") {
        Side::Above
    } else {
        Side::Below
    };
    let found = match direction.starts_with("Transmission") {
        true => table.transmission(from),
        false => table.reflection(from),
    };
    found.unwrap()
}

fn matrix<'a>(file: &'a MeasuredFile, reference: &Value) -> &'a PatchMatrix {
    let name = |key| reference[key].as_str().unwrap();
    match block(table(file, name("wavelength")), name("direction")) {
        Block::Matrix(matrix) => matrix,
        Block::Tree(_) => panic!("a tree"),
    }
}

/// The reference sums in double precision what the file says; values are single precision: 145 terms of relative error 2⁻²⁴.
const SUMS: f64 = 2e-7;

fn assert_sums(file: &MeasuredFile, reference: &Value) {
    let blocks = reference["blocks"].as_array().unwrap().iter();
    for expected in blocks.filter(|block| block["kind"] == "matrix") {
        let matrix = matrix(file, expected);
        let totals: Vec<_> = (0..145).map(|patch| matrix.hemispherical(patch)).collect();
        let close = |found: f64, expected: f64, what: &str| {
            assert!(
                (found - expected).abs() <= SUMS,
                "{what}: {found} {expected}"
            );
        };
        close(
            totals[0],
            number(expected, "direct_hemispherical_normal"),
            "normal",
        );
        let largest = totals.iter().copied().fold(0.0, f64::max);
        close(
            largest,
            number(expected, "max_direct_hemispherical"),
            "largest",
        );
        let means = expected["direct_hemispherical_ring_means"]
            .as_array()
            .unwrap();
        for (ring, mean) in matrix.incident().rings().zip(means) {
            let sum: f64 = totals[ring.clone()].iter().sum();
            close(sum / ring.len() as f64, mean.as_f64().unwrap(), "ring");
        }
        let angle = |patch| matrix.incident().projected_solid_angle(patch);
        let both: f64 = (0..145).map(|patch| totals[patch] * angle(patch)).sum();
        close(
            both / std::f64::consts::PI,
            number(expected, "hemispherical_hemispherical"),
            "both",
        );
    }
}

fn direction(theta: f64, phi: f64) -> Direction {
    let [theta, phi] = [theta, phi].map(f64::to_radians);
    let (sin, cos) = (libm::sin(theta), libm::cos(theta));
    Direction::new(Vector::new(sin * libm::cos(phi), sin * libm::sin(phi), cos)).unwrap()
}

/// A direction, and those 1e-9° aside: some of the reference lie on bounds of patches, where rounding decides.
fn directions(theta: f64, phi: f64) -> Vec<Direction> {
    let steps = [0.0, -1e-9, 1e-9];
    let around = |d: f64| steps.map(|e| direction(theta + d, phi + e));
    steps.into_iter().flat_map(around).collect()
}

/// Radiance sums in single precision what it keeps as single: 1e-6. Its values at directions it perturbs on purpose, by up to
/// 3e-4 of them for matrices and 2e-4 for trees, to hide the patches.
fn assert_as_radiance(file: &MeasuredFile, reference: &Value) {
    let table = table(file, "Visible");
    for expected in reference["direct_hemi"].as_array().unwrap() {
        let known = ["reflection", "transmission"].map(|key| number(expected, key));
        let arriving = directions(number(expected, "theta"), number(expected, "phi"));
        let found: Vec<_> = arriving
            .into_iter()
            .map(|wi| table.hemispherical(wi))
            .collect();
        let agrees = |found: &[f64; 2]| (0..2).all(|k| (found[k] - known[k]).abs() < 1e-6);
        assert!(found.iter().any(agrees), "{expected}: {found:?}");
    }
    for expected in reference["query"].as_array().unwrap() {
        let known = expected["bsdf"][1].as_f64().unwrap();
        let arriving = directions(number(expected, "theta_in"), number(expected, "phi_in"));
        let leaving = directions(number(expected, "theta_out"), number(expected, "phi_out"));
        let pairs = arriving
            .iter()
            .flat_map(|wi| leaving.iter().map(move |wo| (*wo, *wi)));
        let found: Vec<_> = pairs.map(|(wo, wi)| table.value(wo, wi)).collect();
        let agrees = |found: &f64| (found - known).abs() <= 3e-4 * known + 1e-6;
        assert!(found.iter().any(agrees), "{expected}: {found:?}");
    }
}

#[test]
fn clear_glass_has_the_sums_of_its_matrices_and_radiances_values() {
    let file = parsed("a.xml", unpacked("klems_clear.xml"));
    assert!(file.warnings.is_empty(), "{:?}", file.warnings);
    assert_eq!(file.bands.len(), 2);
    assert_sums(
        &file,
        &json("klems_reference.json")["files"]["klems_clear.xml"],
    );
    assert_as_radiance(
        &file,
        &json("radiance_bsdf_queries.json")["files"]["klems_clear.xml"],
    );
}

#[test]
fn the_sawtooth_has_radiances_values_and_deviation() {
    let file = parsed("a.xml", unpacked("radiance_sawtooth.xml"));
    assert_sums(
        &file,
        &json("klems_reference.json")["files"]["radiance_sawtooth.xml"],
    );
    assert_as_radiance(
        &file,
        &json("radiance_bsdf_queries.json")["files"]["radiance_sawtooth.xml"],
    );
    // checkBSDF: 0.0 5.6 99.4 %.
    let found = reciprocity::deviation(table(&file, "Visible"), Side::Above, Side::Above).unwrap();
    assert_eq!(percent(found), [0.0, 5.6, 99.4]);
}

fn percent(deviation: reciprocity::Deviation) -> [f64; 3] {
    [deviation.least, deviation.mean, deviation.largest].map(|x| (x * 1000.0).round() / 10.0)
}

#[test]
fn a_tensor_tree_has_radiances_values() {
    let file = parsed("a.xml", unpacked("tensor3_blinds.xml"));
    assert_eq!(file.warnings.len(), 1, "{:?}", file.warnings);
    assert_as_radiance(
        &file,
        &json("radiance_bsdf_queries.json")["files"]["tensor3_blinds.xml"],
    );
}

/// All five files of the references, from the folder `STERADIAN_BSDF_FILES`.
#[test]
#[ignore = "two of the files are too large for the repository"]
fn large_files_have_the_references_values() {
    let Some(folder) = std::env::var_os("STERADIAN_BSDF_FILES").map(PathBuf::from) else {
        panic!("STERADIAN_BSDF_FILES names no folder");
    };
    type Check = fn(&MeasuredFile, &Value);
    let checks: [(&str, Check); 2] = [
        ("klems_reference.json", assert_sums),
        ("radiance_bsdf_queries.json", assert_as_radiance),
    ];
    for (references, check) in checks {
        let reference = json(references);
        let files = reference["files"].as_object().unwrap().iter();
        for (name, reference) in files.filter(|(name, _)| !name.contains("small")) {
            check(
                &parsed(name, fs::read(folder.join(name)).unwrap()),
                reference,
            );
        }
    }
    // checkBSDF of the blinds: 0.0 1.8 16.3, 0.0 1.7 13.1, 0.0 1.7 84.5 %.
    let file = parsed("a.xml", fs::read(folder.join("klems_blinds.xml")).unwrap());
    let found = |from, to| reciprocity::deviation(table(&file, "Visible"), from, to).map(percent);
    assert_eq!(found(Side::Above, Side::Above), Some([0.0, 1.8, 16.3]));
    assert_eq!(found(Side::Below, Side::Below), Some([0.0, 1.7, 13.1]));
    assert_eq!(found(Side::Above, Side::Below), Some([0.0, 1.7, 84.5]));
}

fn error(name: &str) -> String {
    let files = MemoryFiles::default().with("a.xml", fs::read(data(name)).unwrap());
    read(Path::new("a.xml"), &files).unwrap_err().to_string()
}

#[test]
fn files_that_end_early_are_refused_with_their_place() {
    for name in ["klems_small_comma.xml", "klems_small_tab.xml"] {
        assert_eq!(
            error(name),
            "line 109, column 19: Transmission Front: 21025 values are needed, 4 were found"
        );
    }
}

/// A file of MERL with the values of a function of θ_h, θ_d and φ_d in 1/sr at the middles of the cells; below the horizon nothing
/// is measured.
fn merl(f: impl Fn([f64; 3]) -> f64) -> Vec<u8> {
    let [halves, differences, azimuths] = Merl::CELLS;
    let cells = (0..halves * differences * azimuths).map(|k| {
        let angles = Merl::middle([
            k / azimuths / differences,
            k / azimuths % differences,
            k % azimuths,
        ]);
        let [theta_h, theta_d, phi_d] = angles;
        let up = libm::cos(theta_h) * libm::cos(theta_d);
        let side = libm::sin(theta_h) * libm::sin(theta_d) * libm::cos(phi_d);
        (up > side.abs()).then(|| f(angles))
    });
    let cells: Vec<_> = cells.collect();
    let mut bytes: Vec<u8> = Merl::CELLS
        .iter()
        .flat_map(|n| (*n as u32).to_le_bytes())
        .collect();
    for scale in merl::SCALES {
        let raw = cells
            .iter()
            .map(|value| value.map_or(-1.0, |value| value / scale));
        bytes.extend(raw.flat_map(f64::to_le_bytes));
    }
    bytes
}

/// GGX of α = .3 with F = 1 and the height-correlated shadowing of Smith, of the angles of a cell.
fn ggx([theta_h, theta_d, phi_d]: [f64; 3]) -> f64 {
    let square = 0.3_f64 * 0.3;
    let up = libm::cos(theta_h) * libm::cos(theta_d);
    let side = libm::sin(theta_h) * libm::sin(theta_d) * libm::cos(phi_d);
    let [cos_i, cos_o] = [up - side, up + side];
    let cos_h = libm::cos(theta_h);
    let spread = cos_h * cos_h * (square - 1.0) + 1.0;
    let facets = square / (std::f64::consts::PI * spread * spread);
    let lambda = |cos: f64| 0.5 * ((1.0 + square * (1.0 / (cos * cos) - 1.0)).sqrt() - 1.0);
    facets / ((1.0 + lambda(cos_i) + lambda(cos_o)) * 4.0 * cos_i * cos_o)
}

fn merl_table(file: &MeasuredFile) -> &Merl {
    match file.model() {
        Some(Measured::Merl(table, _)) => table,
        other => panic!("{other:?}"),
    }
}

/// Written and read again, a table gives the law that it was made of, to the width of its cells.
#[test]
fn a_synthetic_table_of_merl_gives_the_law_that_it_was_made_of() {
    let file = parsed("a.binary", merl(ggx));
    assert!(file.warnings.is_empty() && file.header[1].1 == "75.1863 % of the cells");
    let table = merl_table(&file);
    for (theta_i, theta_o, phi) in [(20.0, 20.0, 180.0), (40.0, 25.0, 170.0), (50.0, 10.0, 60.0)] {
        let (wi, wo) = (direction(theta_i, 0.0), direction(theta_o, phi));
        let h = Direction::new(wi.to_vector() + wo.to_vector()).unwrap();
        let square = 0.09;
        let spread = h.z() * h.z() * (square - 1.0) + 1.0;
        let facets = square / (std::f64::consts::PI * spread * spread);
        let lambda = |cos: f64| 0.5 * ((1.0 + square * (1.0 / (cos * cos) - 1.0)).sqrt() - 1.0);
        let shadowing = 1.0 + lambda(wi.z()) + lambda(wo.z());
        let expected = facets / (shadowing * 4.0 * wi.z() * wo.z());
        let [found, green, blue] = table.value(wo, wi);
        assert!((found / expected - 1.0).abs() < 0.04, "{found} {expected}");
        assert!((green / found - 1.0).abs() < 1e-6 && (blue / found - 1.0).abs() < 1e-6);
    }
}

/// The sample entries of an independent writer: 8 digits are left of their single precision.
#[test]
fn synthetic_tables_hold_the_entries_of_another_writer() {
    let reference = json("merl_synthetic_reference.json");
    let lambert = |_| 0.5 / std::f64::consts::PI;
    let files: [(&str, Vec<u8>); 2] = [("lambert 0.5", merl(lambert)), ("ggx 0.3", merl(ggx))];
    for (name, bytes) in files {
        let reference = &reference["files"][name];
        assert_eq!(bytes.len() as u64, reference["bytes"].as_u64().unwrap());
        for entry in reference["samples"].as_array().unwrap() {
            let index = |key: &str| entry[key].as_u64().unwrap() as usize;
            let cell = (index("theta_half_index") * 90 + index("theta_diff_index")) * 180
                + index("phi_diff_index");
            for (channel, key) in ["raw_R", "raw_G", "raw_B"].into_iter().enumerate() {
                let byte = 12 + (channel * 90 * 90 * 180 + cell) * 8;
                let raw = f64::from_le_bytes(bytes[byte..byte + 8].try_into().unwrap());
                assert!(
                    (raw / number(entry, key) - 1.0).abs() < 1e-12,
                    "{name} {entry} {raw}"
                );
            }
        }
    }
}

#[test]
fn broken_files_of_merl_are_refused_with_their_place() {
    let whole = merl(|_| 0.1);
    let message = |bytes: Vec<u8>| {
        let files = MemoryFiles::default().with("a.binary", bytes);
        read(Path::new("a.binary"), &files).unwrap_err().to_string()
    };
    assert_eq!(
        message(whole[..5].to_vec()),
        "byte 5: the file needs 12 bytes, but has 5"
    );
    let length = "byte 100: the file needs 34992012 bytes, but has 100";
    assert_eq!(message(whole[..100].to_vec()), length);
    let with = |byte: usize, new: &[u8]| {
        let mut bytes = whole.clone();
        bytes[byte..byte + new.len()].copy_from_slice(new);
        bytes
    };
    assert_eq!(
        message(with(4, &[91])),
        "byte 4: expected 90 cells, found 91"
    );
    assert_eq!(
        message(with(28, &f64::NAN.to_le_bytes())),
        "byte 28: NaN is no finite number"
    );
    let hole = parsed("a.binary", with(12, &(-1.0_f64).to_le_bytes()));
    assert_eq!(
        hole.warnings,
        [
            "1 cells that lack some colours; these are 0",
            "1 cells above the horizon that were not measured; these are 0"
        ]
    );
}
