//! What is said about a matrix as a whole.

use steradian::exchange::smoothing::Smoothed;
use steradian::exchange::{MatrixSummary, Residual};
use steradian_io::report::form_factors::FactorReport;
use steradian_io::report::numbers::significant;

/// The lines under the table.
pub fn text(summary: &MatrixSummary, report: &FactorReport, facets: usize, closed: bool) -> String {
    let groups = report.names.len();
    let mut lines = vec![match groups == facets {
        true => format!("{facets} surfaces"),
        false => format!("{groups} groups of {facets} surfaces"),
    }];
    if !summary.complete {
        lines.push(format!(
            "interrupted: {} of {groups} rows are there",
            summary.rows
        ));
    }
    lines.push(format!(
        "factors: {} in closed form, {} by {} samples ({} of these unseen), the others are 0",
        summary.closed_forms, summary.estimates, summary.samples, summary.unseen
    ));
    if let Some(worst) = &summary.closure {
        let place = &report.names[worst.surfaces[0]];
        let what = format!("sum of a row - 1: {} in row {place}", residual(worst));
        lines.push(match closed {
            true => format!("{what}; {}", verdict(worst, summary.rows)),
            false => format!("{what}; the scene is open"),
        });
    }
    if let Some(worst) = &summary.reciprocity {
        let [from, to] = worst.surfaces.map(|index| &report.names[index]);
        let count = summary.rows * summary.rows;
        let found = (residual(worst), verdict(worst, count));
        lines.push(format!(
            "A1 F12 - A2 F21: {} m2 between {from} and {to}; {}",
            found.0, found.1
        ));
    }
    if summary.missed > 0 {
        lines.push(format!("{} rows missed the tolerance", summary.missed));
    }
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// What smoothing changed.
pub fn of_smoothing(smoothed: &Smoothed) -> String {
    format!(
        "smoothed: {} sampled factors changed by {} standard errors (rms), at most {}; by at most {} each; {} set to 0; sums are 1 within {}",
        smoothed.factors,
        significant(smoothed.rms_deviation, 2),
        significant(smoothed.greatest_deviation, 2),
        significant(smoothed.greatest_change, 2),
        smoothed.zeroed,
        significant(smoothed.residual, 1)
    )
}

fn residual(residual: &Residual) -> String {
    let value = significant(residual.difference.value, 2);
    match residual.difference.std_error {
        0.0 => format!("{value} (exact)"),
        error => format!(
            "{value}, standard error {}, {} of them",
            significant(error, 2),
            significant(residual.deviation, 2)
        ),
    }
}

fn verdict(residual: &Residual, count: usize) -> &'static str {
    if residual.is_explained(count) {
        "explained by its error"
    } else {
        "NOT explained by its error"
    }
}
