//! Luminances and UGR tables of files that Relux and DIALux were given.

use std::path::{Path, PathBuf};

use serde_json::Value;
use steradian::glare::UgrTable;

use super::{Photometry, read};
use crate::files::DiskFiles;

fn data(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/photometry");
    folder.join(name)
}

fn lamp(name: &str) -> Photometry {
    read(&data(name), &DiskFiles::default()).unwrap()
}

/// Relux rounds to 1 cd/m², and the files' intensities have three digits or more.
#[test]
fn luminances_are_those_of_relux() {
    let text = std::fs::read(data("lum_relux_reference.json")).unwrap();
    let reference: Value = serde_json::from_slice(&text).unwrap();
    let mut count = 0;
    for (name, sample) in reference["samples"].as_object().unwrap() {
        let path = format!("lum_{name}.ldt");
        if !data(&path).exists() {
            continue;
        }
        let lamp = lamp(&path);
        for (gamma, row) in sample["table"].as_object().unwrap() {
            let gamma: f64 = gamma.parse().unwrap();
            for (step, expected) in row.as_array().unwrap().iter().enumerate() {
                let expected = expected.as_f64().unwrap();
                let c = (15.0 * step as f64).to_radians();
                let intensity = lamp.far_field.at_angles(c, gamma.to_radians());
                let direction = lamp.far_field.direction(c, gamma.to_radians());
                let found = intensity / lamp.projected_area(direction).to_square_metres();
                let tolerance = 1.0 + 2e-3 * expected;
                assert!(
                    (found - expected).abs() < tolerance,
                    "{name} C {} γ {gamma}: {found}, {expected}",
                    15 * step
                );
                count += 1;
            }
        }
    }
    assert_eq!(count, 7 * 24 * 5);
}

fn expected(sample: &str, program: &str) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(data(&format!("ugr_table_{sample}_{program}.csv"))).unwrap();
    let numbers = |line: &str| {
        line.split(',')
            .map(|word| word.trim().parse().unwrap())
            .collect()
    };
    text.lines().map(numbers).collect()
}

/// The two programs differ from one another by up to .9. Each entry is to be within .3 of one of them: a tenth of what UGR classes differ by.
#[test]
fn ugr_tables_are_those_of_dialux_or_relux() {
    for sample in ["01", "02", "03", "08", "09", "10"] {
        let lamp = lamp(&format!("ugr_sample_{sample}.ldt"));
        let table = UgrTable::new(&lamp.far_field, |direction| lamp.projected_area(direction));
        let table = table.unwrap();
        let [dialux, relux] = ["Dialux", "Relux"].map(|program| expected(sample, program));
        let (mut worst, mut from_relux) = (0.0_f64, 0.0_f64);
        for (index, row) in table.rows.iter().enumerate() {
            let values = row.crosswise.iter().chain(&row.endwise);
            for (column, value) in values.enumerate() {
                let value = value.unwrap();
                let off = [&dialux, &relux].map(|table| (value - table[index][column]).abs());
                worst = worst.max(off[0].min(off[1]));
                from_relux = from_relux.max(off[1]);
            }
        }
        assert!(worst < 0.3, "{sample}: {worst}");
        assert!(from_relux < 0.45, "{sample}: {from_relux}");
    }
}
