//! Synthetic tables of MERL.

use std::path::Path;

use steradian::brdf::Measured;
use steradian::brdf::measured::Merl;
use steradian::geometry::Direction;
use steradian_io::files::MemoryFiles;
use steradian_io::import::bsdf::{MeasuredFile, merl, read};

use super::{direction, json, number, parsed};

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
