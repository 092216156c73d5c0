//! Diagrams as SVG: lines over two axes, curves around a point, matrices and hemispheres in colour, maps at true scale.
//!
//! An axis states what it shows and in which unit. Numbers that no diagram can show (NaN, infinite, not positive on a
//! logarithmic axis) are refused, not left out. Texts name fonts and carry none, so the files are small; the same
//! diagram gives the same bytes.
//!
//! The crate kuva 0.6 was tried and not taken: it would save the ticks in `scale.rs` and the legend, and its output differed between calls.

mod axis;
mod bars;
mod colour_bar;
mod contour;
mod cut;
mod field;
mod frame;
mod heat_map;
mod heat_pixels;
mod hemisphere_map;
mod isolines;
mod line_plot;
mod plan;
mod polar_plot;
mod scale;

pub use axis::Axis;
pub use bars::{Bar, ShareBars};
pub use field::{Field, Lattice};
pub use heat_map::HeatMap;
pub use hemisphere_map::{HemisphereMap, HemispherePanel};
pub use isolines::Isolines;
pub use line_plot::{LinePlot, Series};
pub use plan::Plan;
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
    /// A map whose lists do not belong together.
    #[error("a map of {count} places has {found} values, intervals or cells")]
    Places {
        /// Places of the map.
        count: usize,
        /// What there is of the others.
        found: usize,
    },
    /// A part of a sum that is negative or not a number.
    #[error("{place} has a part of {value}, which is no share of a sum")]
    NoShare {
        /// The sum.
        place: String,
        /// The part.
        value: f64,
    },
    /// Lines of equal values need neighbours.
    #[error("lines of equal values need a grid of at least 2 x 2 points")]
    NoGrid,
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
