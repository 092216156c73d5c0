use std::path::{Path, PathBuf};

use serde_json::Value;
use steradian::geometry::Direction;

use super::*;
use crate::diagnostic::render;
use crate::files::{DiskFiles, MemoryFiles};

fn data(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/photometry");
    folder.join(name)
}

fn lamp(name: &str) -> Photometry {
    let lamp = read(&data(name), &DiskFiles::default());
    lamp.unwrap_or_else(|problems| panic!("{}", render(&problems, false)))
}

fn json(name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(data(name)).unwrap()).unwrap()
}

fn problem_of(name: &str, text: &str) -> String {
    let files = MemoryFiles::default().with(name, text);
    render(&read(Path::new(name), &files).unwrap_err(), false)
}

/// I in cd towards γ and C in degrees.
fn towards(lamp: &Photometry, gamma: f64, c: f64) -> f64 {
    lamp.far_field.at_angles(c.to_radians(), gamma.to_radians())
}

/// Fluxes of an independent program that integrates the same interpolation; 1e-6 covers the rounding of both.
#[test]
fn fluxes_of_ies_files_are_those_of_the_reference() {
    let mut count = 0;
    for (name, expected) in json("reference_flux.json")["ies"].as_object().unwrap() {
        let keys = ["flux_bilinear", "flux_bilinear_type_b_cosH_dH_dV"];
        let Some(expected) = keys.iter().find_map(|key| expected[*key].as_f64()) else {
            continue;
        };
        let found = lamp(name).far_field.flux();
        let error = found / expected - 1.0;
        assert!(error.abs() < 1e-6, "{name}: {found}, expected {expected}");
        count += 1;
    }
    assert_eq!(count, 13);
}

#[test]
fn fluxes_of_eulumdat_files_are_those_of_the_reference() {
    let mut count = 0;
    for (name, expected) in json("reference_flux.json")["ldt"].as_object().unwrap() {
        let Some(name) = name.strip_prefix("ldt/") else {
            continue;
        };
        let lamp = lamp(name);
        let expected = &expected["luminaire_flux_bilinear_lm"];
        let error = lamp.far_field.flux() / expected.as_f64().unwrap() - 1.0;
        assert!(error.abs() < 1e-6, "{name}: {error}");
        count += 1;
    }
    assert_eq!(count, 8);
}

/// Tables of smooth models: linear interpolation over steps h is off by up to h²/8 · max|I″|/I, which for cos γ and steps of 2°
/// and 10° in C (with half the amplitude) is 2e-3.
#[test]
fn fluxes_of_synthetic_files_are_their_closed_forms() {
    let reference = json("synthetic_reference.json");
    let steps = [
        ("lambert_1000cd_1deg.ies", 4e-5),
        ("isotropic_100cd.ies", 1e-12),
        ("asymmetric_full360.ies", 2e-3),
        ("asymmetric_bilateral180.ies", 2e-3),
        ("quadrant_0_90.ies", 2e-3),
        ("uplight_only.ies", 4e-4),
        // cos⁸ and cos²⁰ by steps of 3°: h²/8 · 20 = 7e-3.
        ("headlamp_typeA.ies", 7e-3),
        ("floodlight_typeB_symmetric.ies", 7e-3),
    ];
    for (name, tolerance) in steps {
        let expected = reference["files"][name]["flux_exact_of_model"]
            .as_f64()
            .unwrap();
        let found = lamp(name).far_field.flux();
        assert!(
            (found / expected - 1.0).abs() < tolerance,
            "{name}: {found}, {expected}"
        );
    }
    let mirrored = lamp("asymmetric_bilateral_90_270.ies");
    let expected = 2_070.796_326_794_896_7;
    assert!((mirrored.far_field.flux() / expected - 1.0).abs() < 2e-3);
}

/// Exact at nodes; the file has 9 digits.
#[test]
fn intensities_stand_in_their_planes() {
    let reference = json("synthetic_reference.json");
    let expected = &reference["files"]["asymmetric_full360.ies"]["I_at"];
    for name in ["asymmetric_full360.ies", "asymmetric_bilateral180.ies"] {
        let lamp = lamp(name);
        for (key, c) in [
            ("gamma30_C0", 0.0),
            ("gamma30_C180", 180.0),
            ("gamma30_C90", 90.0),
        ] {
            let expected = expected[key].as_f64().unwrap();
            assert!(
                (towards(&lamp, 30.0, c) - expected).abs() < 1e-6,
                "{name} {key}"
            );
        }
    }
    let lamp = lamp("asymmetric_isym2.ldt");
    let expected = &reference["files"]["asymmetric_isym2.ldt"]["I_cd"];
    for (key, c) in [("g30_C0", 0.0), ("g30_C180", 180.0), ("g30_C270", 270.0)] {
        let expected = expected[key].as_f64().unwrap();
        // Four digits after the point in cd/klm, of 3 klm.
        assert!((towards(&lamp, 30.0, c) - expected).abs() < 3e-4, "{key}");
    }
}

#[test]
fn the_first_plane_lies_along_x() {
    let lamp = lamp("asymmetric_full360.ies");
    let slanted = |x: f64| Direction::new([x, 0.0, -1.0].into()).unwrap();
    let [forward, back] = [1.0, -1.0].map(|x| lamp.far_field.intensity(slanted(x)));
    assert!((forward / back - 3.0).abs() < 1e-3);
}

/// A file of symmetry 3 lists C270 first. Relux's luminances of sample 08, whose opening has equal projections towards C90 and
/// C270, are as 4617 to 6403 there at 65°; it rounds to 1 cd/m².
#[test]
fn planes_of_symmetry_3_begin_at_c270() {
    let lamp = lamp("lum_sample_08.ldt");
    let ours = towards(&lamp, 65.0, 90.0) / towards(&lamp, 65.0, 270.0);
    assert!((ours / (4617.0 / 6403.0) - 1.0).abs() < 3e-4);
    assert!((towards(&lamp, 65.0, 30.0) - towards(&lamp, 65.0, 150.0)).abs() < 1e-9);
}

#[test]
fn openings_are_read_by_their_signs() {
    assert_eq!(lamp("mdl_rimlight_iesna91.ies").opening, Opening::Point);
    let round = Opening::Upright {
        width: 0.1,
        length: 0.1,
        height: 0.0,
    };
    assert_eq!(lamp("bega_6339_lm63_1995.ies").opening, round);
    let Opening::Box {
        width,
        length,
        height,
    } = lamp("ledalite_examp1_iesna95.ies").opening
    else {
        panic!("a box was expected");
    };
    let feet = [width, length, height].map(|metres| metres / 0.3048);
    assert!((0..3).all(|k| (feet[k] - [0.85, 4.04, 0.292][k]).abs() < 1e-12));
    assert_eq!(
        lamp("lum_sample_02.ldt").opening,
        Opening::Box {
            width: 1.201,
            length: 0.038,
            height: 0.0
        }
    );
}

#[test]
fn milliwatts_are_read_from_their_keyword() {
    let lamp = lamp("uv_aerolamp.ies");
    assert_eq!(lamp.unit, IntensityUnit::MilliwattPerSteradian);
    assert_eq!(lamp.lamp_flux, None);
    let hinting = "IESNA91\n[OTHER] all values in mW/sr\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n1 1\n";
    let files = MemoryFiles::default().with("lamp.ies", hinting);
    let lamp = read(Path::new("lamp.ies"), &files).unwrap();
    assert_eq!(lamp.unit, IntensityUnit::Candela);
    assert!(lamp.warnings[0].message.contains("read as cd"));
}

#[test]
fn tilts_are_read_from_the_file_or_beside_it() {
    let tilt = lamp("tilt_include.ies").tilt.unwrap();
    assert_eq!(tilt.geometry, 1);
    assert_eq!(
        tilt.factors,
        [(0.0, 1.0), (30.0, 0.9), (60.0, 0.8), (90.0, 0.5)]
    );
    let text = "IESNA91\nTILT=lamp.tlt\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n1 1\n";
    let files = MemoryFiles::default().with("lamp.ies", text);
    let missing = render(&read(Path::new("lamp.ies"), &files).unwrap_err(), false);
    assert!(
        missing.contains("lamp.ies:2:1") && missing.contains("no such file"),
        "{missing}"
    );
    let files = files.with("lamp.tlt", "2\n2\n0 90\n1 .5\n");
    let tilt = read(Path::new("lamp.ies"), &files).unwrap().tilt.unwrap();
    assert_eq!(tilt.factors, [(0.0, 1.0), (90.0, 0.5)]);
}

#[test]
fn broken_files_are_refused_with_their_place() {
    let read_problem = |name: &str| {
        let problems = read(&data(name), &DiskFiles::default()).unwrap_err();
        render(&problems, false)
    };
    let malformed = read_problem("mdl_test_malformed.ies");
    assert!(
        malformed.contains(":3:1") && malformed.contains("found \"file\""),
        "{malformed}"
    );
    let few = read_problem("bad_too_few_values.ies");
    assert!(
        few.contains("an intensity (3 of 3), found the end"),
        "{few}"
    );
    let decreasing = read_problem("bad_decreasing_angles.ies");
    assert!(
        decreasing.contains("angles must increase: 45 follows 90"),
        "{decreasing}"
    );
    assert!(problem_of("a.ies", "IESNA91\n").contains("TILT=NONE"));
    assert!(
        problem_of("a.ies", "TILT=NONE\n1 1 1 2 1 4 2 0 0 0")
            .contains("1 (C), 2 (B) or 3 (A), found 4")
    );
    let laterals = "TILT=NONE\n1 1 1 2 2 1 2 0 0 0\n1 1 1\n0 90\n0 45\n1 1 1 1\n";
    assert!(problem_of("a.ies", laterals).contains("not from 0° to 45°"));
    let negative = "TILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n1 -1\n";
    assert!(problem_of("a.ies", negative).contains("finite and not negative"));
    assert!(problem_of("a.txt", "").contains(".ies, .ldt or TM-33 .xml"));
    assert!(problem_of("a.ldt", "maker\n1\n7\n").contains("Isym), 0 to 4, found 7"));
}

/// Every line cut off, every byte changed: an answer or a message, never a panic.
#[test]
fn no_cut_makes_a_reader_fail() {
    for name in ["isotropic_100cd.ies", "isotropic_1000lm.ldt"] {
        let text = std::fs::read_to_string(data(name)).unwrap();
        for length in 0..text.len() {
            let files = MemoryFiles::default().with(name, &text[..length]);
            if let Err(problems) = read(Path::new(name), &files) {
                assert!(!problems.is_empty());
            }
        }
    }
}
