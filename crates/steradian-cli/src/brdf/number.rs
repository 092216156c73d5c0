//! Lanes as numbers of a report.

use serde_json::{Map, Value, json};
use steradian::quantity::Spectrum;
use steradian_io::report::numbers::significant;

use super::model::Model;

/// Digits of values that are known in single precision.
const DIGITS: i32 = 7;

/// What a number is known from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A formula, rounded to single precision.
    ClosedForm,
    /// A quadrature whose error stays below this.
    Quadrature(f64),
}

impl Source {
    fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed-form",
            Self::Quadrature(_) => "quadrature",
        }
    }
}

/// The shortest decimal number that is this one in single precision.
pub fn shortest(lane: f32) -> f64 {
    lane.to_string().parse().unwrap_or_else(|_| f64::from(lane))
}

/// All four lanes.
pub fn lanes(spectrum: Spectrum) -> [f64; 4] {
    spectrum.to_lanes().map(shortest)
}

/// `{"value", "unit", "std_error", "method", "channels"}`.
pub fn json_value(model: &Model, spectrum: Spectrum, unit: &str, source: Source) -> Value {
    let all = lanes(spectrum);
    let channels: Map<String, Value> = model
        .lanes
        .iter()
        .cloned()
        .zip(all.map(|lane| json!(lane)))
        .collect();
    let mut object = json!({
        "value": total(model, spectrum),
        "unit": unit,
        "std_error": 0.0,
        "method": source.name(),
    });
    if let Source::Quadrature(error) = source {
        object["error_bound"] = json!(error);
    }
    if channels.len() > 1 {
        object["channels"] = Value::Object(channels);
    }
    object
}

/// One number: that of grey lanes themselves, else their weighted sum.
pub fn total(model: &Model, spectrum: Spectrum) -> f64 {
    let all = lanes(spectrum);
    let counted = &all[..model.lanes.len().min(all.len())];
    if counted.iter().all(|lane| *lane == counted[0]) {
        return counted[0];
    }
    model.total(all)
}

/// Headings of the columns that [`cells`] fills.
pub fn headings(model: &Model, name: &str) -> Vec<String> {
    let lanes = model.lanes.iter().filter(|_| model.lanes.len() > 1);
    std::iter::once(name.to_owned())
        .chain(lanes.map(|lane| format!("{name}, {lane}")))
        .collect()
}

/// One number, then the lanes if there are several.
pub fn cells(model: &Model, spectrum: Spectrum) -> Vec<String> {
    let counted = lanes(spectrum).into_iter().take(model.lanes.len());
    let lanes = counted.filter(|_| model.lanes.len() > 1);
    std::iter::once(total(model, spectrum))
        .chain(lanes)
        .map(|number| significant(number, DIGITS))
        .collect()
}
