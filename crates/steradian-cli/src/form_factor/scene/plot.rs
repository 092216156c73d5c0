//! The matrix as a picture.

use std::path::Path;

use steradian::exchange::Row;
use steradian_io::report::form_factors::FactorReport;
use steradian_io::report::plot::{HeatMap, PlotError};

use crate::output;
use crate::status::Failure;

/// More rows than this are put together by neighbours.
const MOST_CELLS: usize = 240;
/// Decades below the greatest factor that colours show.
const DECADES: f64 = 5.0;

/// The drawing of log₁₀ F in the format that the file's name says.
pub fn drawing(rows: &[Row], report: &FactorReport, file: &Path) -> Result<Vec<u8>, Failure> {
    let map = map(rows, report);
    let failed = |error: PlotError| Failure::Other(error.into());
    match output::is_png(file)? {
        false => Ok(map.to_svg().map_err(failed)?.into_bytes()),
        true => map.to_png().map_err(failed),
    }
}

fn map(rows: &[Row], report: &FactorReport) -> HeatMap {
    let count = report.names.len();
    let step = count.div_ceil(MOST_CELLS).max(1);
    let values = blocks(rows, report, step);
    let greatest = values
        .iter()
        .flatten()
        .fold(0.0_f64, |most, &f| most.max(f));
    let lowest = libm::log10(greatest.max(f64::MIN_POSITIVE)) - DECADES;
    let logarithm = |f: f64| {
        if f > 0.0 {
            libm::log10(f).max(lowest)
        } else {
            lowest
        }
    };
    let names: Vec<String> = report.names.iter().step_by(step).cloned().collect();
    HeatMap {
        title: match step {
            1 => format!("Form factors from row to column (darkest: below 1e{lowest:.1} or 0)"),
            _ => format!(
                "Form factors, means of {step} x {step} (darkest: below 1e{lowest:.1} or 0)"
            ),
        },
        legend: "log10 F".to_owned(),
        rows: names.clone(),
        columns: names,
        values: values
            .into_iter()
            .map(|row| row.into_iter().map(logarithm).collect())
            .collect(),
        with_numbers: false,
    }
}

/// The mean factor from a surface of a block of rows to a surface of a block of columns.
fn blocks(rows: &[Row], report: &FactorReport, step: usize) -> Vec<Vec<f64>> {
    let count = report.names.len().div_ceil(step);
    let mut values = vec![vec![0.0; count]; count];
    for row in rows {
        for entry in &row.entries {
            values[row.from / step][entry.to as usize / step] += entry.value / (step * step) as f64;
        }
    }
    values
}
