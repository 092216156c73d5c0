//! What an axis shows.

use super::PlotError;

/// A quantity along an edge of a diagram, with its unit.
///
/// ```
/// use steradian_io::report::plot::Axis;
/// let tilt = Axis::new("tilt", "°").from_to(0.0, 90.0).tick_every(15.0);
/// let error = Axis::new("relative error", "").logarithmic();
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub(super) label: String,
    pub(super) is_logarithmic: bool,
    pub(super) range: Option<[f64; 2]>,
    pub(super) step: Option<f64>,
}

impl Axis {
    /// A linear axis with round ends around the data. A number has the unit `""`.
    pub fn new(quantity: &str, unit: &str) -> Self {
        let label = if unit.is_empty() {
            quantity.to_owned()
        } else {
            format!("{quantity} ({unit})")
        };
        Self {
            label,
            is_logarithmic: false,
            range: None,
            step: None,
        }
    }

    /// The same with a logarithmic scale.
    pub fn logarithmic(mut self) -> Self {
        self.is_logarithmic = true;
        self
    }

    /// The same with these ends; what lies beyond them is not drawn.
    pub fn from_to(mut self, low: f64, high: f64) -> Self {
        self.range = Some([low, high]);
        self
    }

    /// The same with a tick at every multiple of `step`, which a logarithmic axis passes over, as it does a step that
    /// is not positive or gives more than a hundred ticks.
    pub fn tick_every(mut self, step: f64) -> Self {
        self.step = Some(step);
        self
    }

    /// Whether a number has a place on the axis.
    pub(super) fn check(&self, place: &str, value: f64) -> Result<(), PlotError> {
        let place = place.to_owned();
        if !value.is_finite() {
            return Err(PlotError::NotFinite { place, value });
        }
        if self.is_logarithmic && value <= 0.0 {
            return Err(PlotError::NotPositive { place, value });
        }
        Ok(())
    }

    /// Whether the ends asked for have places on the axis and rise.
    pub(super) fn check_range(&self) -> Result<(), PlotError> {
        let Some([from, to]) = self.range else {
            return Ok(());
        };
        self.check(&self.label, from)?;
        self.check(&self.label, to)?;
        if from < to {
            return Ok(());
        }
        Err(PlotError::Range {
            label: self.label.clone(),
            from,
            to,
        })
    }
}
