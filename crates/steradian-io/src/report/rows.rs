//! Readings as rows of a table with fixed columns, for CSV and Parquet.
//!
//! Where an interval was asked for, each reading is followed by a row of what it adds up to: quantity and unit say so
//! (`radiant exposure`, `J/m2`).

use steradian::estimation::Estimate;
use steradian::measurement::Reading;

/// The columns, which stay as they are.
pub const COLUMNS: [&str; 15] = [
    "sensor",
    "index",
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
    "quantity",
    "unit",
    "value",
    "std_error",
    "lo",
    "hi",
    "converged",
];

/// One row.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// What it belongs to.
    pub reading: &'a Reading,
    /// The quantity's name.
    pub quantity: &'a str,
    /// Its unit.
    pub unit: &'a str,
    /// The number.
    pub estimate: &'a Estimate,
    /// Whether the channels and groups of the reading are those of this number.
    pub has_parts: bool,
}

/// The reading, and what it adds up to.
pub fn rows(reading: &Reading) -> impl Iterator<Item = Row<'_>> {
    let row = Row {
        reading,
        quantity: &reading.quantity,
        unit: &reading.unit,
        estimate: &reading.estimate,
        has_parts: true,
    };
    let exposure = reading.exposure.as_ref().map(|exposure| Row {
        reading,
        quantity: &exposure.quantity,
        unit: &exposure.unit,
        estimate: &exposure.estimate,
        has_parts: false,
    });
    [Some(row), exposure].into_iter().flatten()
}

impl Row<'_> {
    /// From x to nz.
    pub fn vectors(&self) -> [Option<f64>; 6] {
        let [x, y, z] = components(self.reading.position);
        let [nx, ny, nz] = components(self.reading.normal);
        [x, y, z, nx, ny, nz]
    }

    /// From value to hi; what is unknown is none.
    pub fn numbers(&self) -> [Option<f64>; 4] {
        let Estimate {
            value,
            std_error,
            interval,
            ..
        } = *self.estimate;
        let [lo, hi] = components(interval);
        [finite(value), finite(std_error), lo, hi]
    }
}

fn components<const N: usize>(vector: Option<[f64; N]>) -> [Option<f64>; N] {
    vector.map_or([None; N], |vector| vector.map(finite))
}

/// None where it is infinite or no number.
pub fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_unknown_is_none() {
        assert_eq!(finite(f64::INFINITY), None);
        assert_eq!(components::<3>(None), [None; 3]);
        assert_eq!(components(Some([1.0, f64::NAN])), [Some(1.0), None]);
    }
}
