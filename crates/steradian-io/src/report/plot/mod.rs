//! Diagrams as SVG: lines over two axes, curves around a point, matrices and hemispheres in colour.
//!
//! An axis states what it shows and in which unit. Numbers that no diagram can show (NaN, infinite, not positive on a
//! logarithmic axis) are refused, not left out. Texts name fonts and carry none, so the files are small; the same
//! diagram gives the same bytes.
//!
//! The crate kuva 0.6 was tried and not taken: it would save the ticks in `scale.rs` and the legend, and its output differed between calls.

mod axis;
mod cut;
mod frame;
mod heat_map;
mod heat_pixels;
mod hemisphere_map;
mod line_plot;
mod polar_plot;
mod scale;

pub use axis::Axis;
pub use heat_map::HeatMap;
pub use hemisphere_map::{HemisphereMap, HemispherePanel};
pub use line_plot::{LinePlot, Series};
pub use polar_plot::{PolarCurve, PolarPlot, Zero};

use super::error::ReportError;

/// Why numbers make no diagram.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// The drawing cannot be written as pixels.
    #[error("cannot write the drawing: {0}")]
    Encoding(String),
    /// There is nothing to draw.
    #[error("there are no numbers to plot")]
    Empty,
    /// A number is infinite or NaN.
    #[error("{place} holds {value}, which no diagram can show")]
    NotFinite {
        /// The series, row or axis.
        place: String,
        /// The number.
        value: f64,
    },
    /// A logarithmic axis has no place for this number.
    #[error("{place} holds {value}, which a logarithmic axis cannot show")]
    NotPositive {
        /// The series or axis.
        place: String,
        /// The number.
        value: f64,
    },
    /// The ends asked for an axis do not rise.
    #[error("the axis \"{label}\" cannot go from {from} to {to}")]
    Range {
        /// What the axis shows.
        label: String,
        /// Its first end.
        from: f64,
        /// Its last end.
        to: f64,
    },
    /// Rows of a matrix are of different length, or there are more or fewer labels than rows or columns.
    #[error("a matrix of {rows} x {columns} was expected, but {place} has {found}")]
    Shape {
        /// How many rows are labelled.
        rows: usize,
        /// How many columns are labelled.
        columns: usize,
        /// What differs.
        place: String,
        /// How many it has.
        found: usize,
    },
}

impl From<ReportError> for PlotError {
    fn from(error: ReportError) -> Self {
        Self::Encoding(error.to_string())
    }
}
