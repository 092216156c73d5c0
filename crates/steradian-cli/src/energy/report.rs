//! Integrals on their way out.

use serde_json::{Map, Value, json};
use steradian::quantity::{Energy, Quantity, Unit, UnitTable};
use steradian::spectrum::photon_energy;
use steradian::time::{Rate, Series, Summary};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::exact;

use super::Arguments;
use crate::status::Failure;

/// A number in a unit.
#[derive(Clone, Copy)]
struct Amount {
    value: f64,
    unit: &'static str,
}

/// What one record or formula adds up to.
pub struct Entry {
    name: String,
    /// What the integral is.
    quantity: &'static str,
    unit: &'static Unit,
    total: Amount,
    /// What is integrated.
    rate: &'static str,
    mean: Amount,
    least: Amount,
    greatest: Amount,
    from: f64,
    to: f64,
    photons: Option<f64>,
    /// What a decay gives until nothing is left.
    eventually: Option<Amount>,
    /// Beginning, end and mean rate between readings.
    steps: Vec<[f64; 3]>,
}

impl Entry {
    /// The integral in the unit asked for, or that of its SI unit.
    pub fn new<R: Rate>(
        name: &str,
        summary: &Summary<R>,
        arguments: &Arguments,
    ) -> Result<Self, Failure> {
        let unit = unit(R::Total::TABLE, arguments.unit.as_deref())?;
        let energy = summary.total.to_si();
        let rate = |rate: R| Amount {
            value: rate.to_si(),
            unit: spelled(R::TABLE),
        };
        let photons = arguments.wavelength.map(|wavelength| {
            if R::Total::NAME == Energy::NAME && wavelength.to_metres() > 0.0 {
                return Ok(Energy::from_joules(energy) / photon_energy(wavelength));
            }
            let total = R::Total::NAME;
            Err(Failure::message(format!(
                "--wavelength: the photons of an energy at a positive wavelength are counted, not those of {total}"
            )))
        });
        Ok(Self {
            name: name.to_owned(),
            quantity: R::Total::NAME,
            unit,
            total: in_unit(energy, unit),
            rate: R::NAME,
            mean: rate(summary.mean),
            least: rate(summary.least),
            greatest: rate(summary.greatest),
            from: summary.interval.from().to_seconds(),
            to: summary.interval.to().to_seconds(),
            photons: photons.transpose()?,
            eventually: None,
            steps: Vec::new(),
        })
    }

    /// The same with what comes after t = 0 in all.
    pub fn with_rest<Q: Quantity>(mut self, total: Q) -> Self {
        self.eventually = Some(in_unit(total.to_si(), self.unit));
        self
    }

    /// The same with the rates between readings, as far as they lie in the interval.
    pub fn with_steps<R: Rate>(mut self, rates: &Series<R>) -> Self {
        let points: Vec<(f64, f64)> = rates
            .points()
            .map(|(time, rate)| (time.to_seconds(), rate.to_si()))
            .collect();
        let steps = points
            .windows(2)
            .map(|pair| [pair[0].0.max(self.from), pair[1].0.min(self.to), pair[0].1]);
        self.steps = steps.filter(|[from, to, _]| from < to).collect();
        self
    }
}

fn in_unit(si: f64, unit: &'static Unit) -> Amount {
    Amount {
        value: unit.of_si(si),
        unit: unit.symbol,
    }
}

/// The SI unit as units are spelled: `W/m2`.
fn spelled(table: &'static UnitTable) -> &'static str {
    table.find(table.si).map_or(table.si, |unit| unit.symbol)
}

fn unit(table: &'static UnitTable, asked: Option<&str>) -> Result<&'static Unit, Failure> {
    let text = asked.unwrap_or(table.si);
    table.find(text).ok_or_else(|| {
        let known: Vec<&str> = table.units.iter().map(|unit| unit.symbol).collect();
        let (quantity, known) = (table.quantity, known.join(", "));
        Failure::message(format!(
            "\"{text}\" is no unit of {quantity}; expected one of {known}"
        ))
    })
}

/// One row an integral, then the rates between readings.
pub fn table(entries: &[Entry]) -> String {
    let mut columns = Columns::new([
        "name", "quantity", "integral", "from (s)", "to (s)", "mean", "least", "greatest",
    ]);
    for entry in entries {
        let rates = [entry.mean, entry.least, entry.greatest].map(text);
        let cells = [
            entry.name.clone(),
            entry.quantity.to_owned(),
            text(entry.total),
            exact(entry.from),
            exact(entry.to),
        ];
        columns.row(cells.into_iter().chain(rates));
    }
    let notes: String = entries.iter().map(notes).collect();
    let steps: String = entries.iter().map(steps).collect();
    format!("{columns}{notes}{steps}")
}

fn notes(entry: &Entry) -> String {
    let photons = entry
        .photons
        .map(|photons| format!("{}: {} photons\n", entry.name, exact(photons)));
    let rest = entry
        .eventually
        .map(|total| format!("{}: {} until nothing is left\n", entry.name, text(total)));
    [photons, rest].into_iter().flatten().collect()
}

fn steps(entry: &Entry) -> String {
    if entry.steps.is_empty() {
        return String::new();
    }
    let heading = format!("mean {} ({})", entry.rate, entry.mean.unit);
    let mut columns = Columns::new(["from (s)".to_owned(), "to (s)".to_owned(), heading]);
    for step in &entry.steps {
        columns.row(step.map(exact));
    }
    format!("\n{}, between its readings:\n{columns}", entry.name)
}

fn text(amount: Amount) -> String {
    format!("{} {}", exact(amount.value), amount.unit)
}

/// One JSON object, an entry of `integrals` for each record.
pub fn json(entries: &[Entry]) -> String {
    let all: Vec<Value> = entries.iter().map(object).collect();
    format!("{:#}\n", json!({ "integrals": all }))
}

fn object(entry: &Entry) -> Value {
    let seconds = |value: f64| json!({ "value": value, "unit": "s" });
    let mut object = Map::new();
    let mut insert = |key: &str, value: Value| object.insert(key.to_owned(), value);
    insert("name", json!(entry.name));
    insert("quantity", json!(entry.quantity));
    insert("value", json!(entry.total.value));
    insert("unit", json!(entry.total.unit));
    insert("std_error", json!(0.0));
    insert("method", json!("closed-form"));
    insert("from", seconds(entry.from));
    insert("to", seconds(entry.to));
    insert("duration", seconds(entry.to - entry.from));
    insert("mean", number(entry.mean));
    insert("least", number(entry.least));
    insert("greatest", number(entry.greatest));
    if let Some(photons) = entry.photons {
        insert("photons", json!({ "value": photons, "unit": "1" }));
    }
    if let Some(total) = entry.eventually {
        insert("eventually", number(total));
    }
    if !entry.steps.is_empty() {
        let step = |[from, to, rate]: &[f64; 3]| json!({ "from": from, "to": to, "value": rate, "unit": entry.mean.unit });
        insert("rates", entry.steps.iter().map(step).collect());
    }
    Value::Object(object)
}

fn number(amount: Amount) -> Value {
    json!({ "value": amount.value, "unit": amount.unit })
}
