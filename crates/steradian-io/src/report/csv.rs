//! Readings as CSV (RFC 4180) with [fixed columns](super::rows); what a reading does not have is empty.

use std::io::{self, Write};

use steradian::measurement::Measurements;

use super::error::ReportError;
pub use super::rows::COLUMNS;
use super::rows::{Row, rows};
use super::run::Run;

/// The readings, a heading first. Numbers read back to the same bits.
///
/// # Errors
/// If they cannot be text.
pub fn encode(run: &Run<'_>) -> Result<String, ReportError> {
    let mut bytes = Vec::new();
    write(run, &mut bytes).map_err(|error| ReportError::Encoding(error.to_string()))?;
    String::from_utf8(bytes).map_err(|error| ReportError::Encoding(error.to_string()))
}

/// Writes the same reading by reading: it is never held as a whole.
///
/// # Errors
/// If `out` refuses.
pub fn write(run: &Run<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = Writer::new(out)?;
    writer.block(run.measurements)?;
    writer.finish().map(drop)
}

/// Writes readings block by block.
pub struct Writer<W: Write>(csv::Writer<W>);

impl<W: Write> Writer<W> {
    /// Writes the heading.
    ///
    /// # Errors
    /// If `out` refuses.
    pub fn new(out: W) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(COLUMNS)?;
        Ok(Self(writer))
    }

    /// Writes the readings of the next block.
    ///
    /// # Errors
    /// If the output refuses.
    pub fn block(&mut self, block: &Measurements) -> io::Result<()> {
        for reading in block.iter_values() {
            for row in rows(&reading) {
                self.0.write_record(record(&row))?;
            }
        }
        self.0.flush()
    }

    /// What was written to.
    ///
    /// # Errors
    /// If it refuses the rest.
    pub fn finish(self) -> io::Result<W> {
        self.0.into_inner().map_err(|error| error.into_error())
    }
}

fn record(row: &Row<'_>) -> [String; COLUMNS.len()] {
    let [x, y, z, nx, ny, nz] = row.vectors().map(number);
    let [value, std_error, lo, hi] = row.numbers().map(number);
    [
        row.reading.sensor.clone(),
        row.reading.index.to_string(),
        x,
        y,
        z,
        nx,
        ny,
        nz,
        row.quantity.to_owned(),
        row.unit.to_owned(),
        value,
        std_error,
        lo,
        hi,
        row.estimate.converged.to_string(),
    ]
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:?}"))
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
        assert_eq!((number(None), number(Some(0.5))), ("".into(), "0.5".into()));
    }
}
