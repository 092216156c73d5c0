//! The matrix as a picture.

use steradian::exchange::Row;
use steradian_io::report::form_factors::FactorReport;
use steradian_io::report::plot::HeatMap;

use crate::status::Failure;

/// More rows than this are put together by neighbours.
const MOST_CELLS: usize = 240;
/// Decades below the greatest factor that colours show.
const DECADES: f64 = 5.0;

/// The drawing of log₁₀ F.
pub fn svg(rows: &[Row], report: &FactorReport) -> Result<String, Failure> {
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
    let map = HeatMap {
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
    };
    map.to_svg().map_err(|error| Failure::Other(error.into()))
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
