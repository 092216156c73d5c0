//! Readings as CSV (RFC 4180) with fixed columns; what a reading does not have is empty.
//!
//! Where an interval was asked for, each reading is followed by a row of what it adds up to: quantity and unit say so
//! (`radiant exposure`, `J/m2`).

use steradian::estimation::Estimate;
use steradian::measurement::{Exposure, Reading};

use super::error::ReportError;
use super::run::Run;

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

/// The readings, a heading first. Numbers read back to the same bits.
pub fn encode(run: &Run<'_>) -> Result<String, ReportError> {
    let failed = |error: csv::Error| ReportError::Encoding(error.to_string());
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS).map_err(failed)?;
    for reading in run.measurements.readings() {
        writer.write_record(record(&reading)).map_err(failed)?;
        if let Some(exposure) = &reading.exposure {
            let row = exposure_record(&reading, exposure);
            writer.write_record(row).map_err(failed)?;
        }
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| ReportError::Encoding(error.to_string()))?;
    String::from_utf8(bytes).map_err(|error| ReportError::Encoding(error.to_string()))
}

fn record(reading: &Reading) -> [String; COLUMNS.len()] {
    row(reading, &reading.quantity, &reading.unit, &reading.estimate)
}

fn exposure_record(reading: &Reading, exposure: &Exposure) -> [String; COLUMNS.len()] {
    row(
        reading,
        &exposure.quantity,
        &exposure.unit,
        &exposure.estimate,
    )
}

fn row(
    reading: &Reading,
    quantity: &str,
    unit: &str,
    estimate: &Estimate,
) -> [String; COLUMNS.len()] {
    let [x, y, z] = vector(reading.position);
    let [nx, ny, nz] = vector(reading.normal);
    let end = |side: usize| {
        estimate
            .interval
            .map_or_else(String::new, |interval| number(interval[side]))
    };
    [
        reading.sensor.clone(),
        reading.index.to_string(),
        x,
        y,
        z,
        nx,
        ny,
        nz,
        quantity.to_owned(),
        unit.to_owned(),
        number(estimate.value),
        number(estimate.std_error),
        end(0),
        end(1),
        estimate.converged.to_string(),
    ]
}

fn vector(vector: Option<[f64; 3]>) -> [String; 3] {
    vector.map_or_else(Default::default, |vector| vector.map(number))
}

fn number(value: f64) -> String {
    if value.is_finite() {
        format!("{value:?}")
    } else {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::super::run::tests::{measurements, run};
    use super::*;

    #[test]
    fn readings_read_back_with_their_columns() {
        let measurements = measurements();
        let text = encode(&run(&measurements)).unwrap();
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        assert_eq!(
            reader.headers().unwrap().iter().collect::<Vec<_>>(),
            COLUMNS
        );
        let rows: Vec<csv::StringRecord> = reader.records().collect::<Result<_, _>>().unwrap();
        assert_eq!((rows.len(), &rows[0][0], &rows[0][9]), (2, "a, b", "W/m2"));
        let number = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
        assert_eq!(
            (number(0, 10), number(0, 11), number(0, 12)),
            (100.0, 0.0, 100.0)
        );
        assert_eq!(number(1, 11), measurements.readings()[1].estimate.std_error);
    }

    #[test]
    fn what_is_unknown_is_empty() {
        assert_eq!(number(f64::INFINITY), "");
        assert_eq!(vector(None), ["", "", ""]);
    }
}
