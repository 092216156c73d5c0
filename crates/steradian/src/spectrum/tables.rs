//! The tables of the standards, as `data/spectra/SOURCES.md` lists them.

use super::{Beyond, Curve};

pub(super) const CIE_1931: &str = include_str!("../../data/spectra/cie_1931.csv");
pub(super) const CIE_1964: &str = include_str!("../../data/spectra/cie_1964.csv");
pub(super) const CIE_1951_SCOTOPIC: &str = include_str!("../../data/spectra/cie_1951_scotopic.csv");
pub(super) const CIE_S026_MELANOPIC: &str =
    include_str!("../../data/spectra/cie_s026_melanopic.csv");
pub(super) const DAYLIGHT: &str = include_str!("../../data/spectra/daylight_components.csv");
pub(super) const INDICES: &str = include_str!("../../data/spectra/indices.csv");
pub(super) const LAMPS: &str = include_str!("../../data/spectra/lamps.csv");

/// A column of one of these tables against its first, which holds nm; the first line names the columns.
pub(super) fn column(table: &str, column: usize) -> Curve {
    let samples = table.lines().skip(1).filter_map(|line| {
        let number = |index| line.split(',').nth(index)?.parse().ok();
        Some((number(0)?, number(column)?))
    });
    Curve::new(samples.collect(), Beyond::Zero).expect("tables of this file are in order")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_of_every_table_is_read() {
        for (table, columns, rows, range) in [
            (CIE_1931, 3, 471, [360.0, 830.0]),
            (CIE_1964, 3, 471, [360.0, 830.0]),
            (CIE_1951_SCOTOPIC, 1, 401, [380.0, 780.0]),
            (CIE_S026_MELANOPIC, 1, 401, [380.0, 780.0]),
            (DAYLIGHT, 3, 54, [300.0, 830.0]),
            (INDICES, 16, 81, [380.0, 780.0]),
            (LAMPS, 5, 81, [380.0, 780.0]),
        ] {
            for index in 1..=columns {
                let curve = column(table, index);
                assert_eq!((curve.values().len(), curve.range()), (rows, range));
            }
            assert_eq!(
                table.lines().next().unwrap().split(',').count(),
                columns + 1
            );
            assert_eq!(table.lines().count(), rows + 1);
        }
    }
}
