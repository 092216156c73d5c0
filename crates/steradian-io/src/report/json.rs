//! Readings as one JSON object, `"schema": "steradian.result/1"`.
//!
//! What is unknown is `null`. Beside the readings it holds, as `stored` on one line, what they were derived from, and
//! [`stored::read`](super::stored::read) reads that back bit for bit: of each point the sums of every independent replicate
//! by column (light group by light group, lane by lane in each), the samples of the replicates, and the exact part of each
//! column, in the radiant unit of the sensor's quantity. With them lamps can be dimmed or switched afterwards: weigh and add
//! the means of each replicate, and the spread of the sums gives their error, covariances included.
//!
//! `statistics` has mean (also by light group), extremes, `uniformity` (U₀ = min/mean) and `diversity` (min/max) of each sensor with several points; those that noise
//! biases say so. `relit` has the factors of light groups that are not 1; all readings are with them.
//!
//! `balance` has the sums of an energy balance, what is missing, and how probably chance alone makes as much missing; its accounts are
//! readings.
//!
//! A run that was asked for an interval states it as `over`, and in each reading as `exposure` what the reading adds up to, by
//! seconds and, `in_hours`, by hours. `at` is the time that readings belong to; `null` means that all lights give all they can.

use std::io::{self, Write};

use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};
use steradian::estimation::{Estimate, Method};
use steradian::measurement::{
    Exposure, Extreme, Gathered, Measurements, Reading, SensorRecord, Statistics,
};
use steradian::quantity::Time;
use steradian::sensor::SitsOn;

use super::balance;
use super::error::ReportError;
use super::run::{Run, SAMPLING_ERROR_ONLY};

/// Name and version of the format.
pub const SCHEMA: &str = "steradian.result/1";

/// The object: on indented lines what people look at, on the last one what programs do.
///
/// # Errors
/// If a number of the measurements cannot be written.
pub fn encode(run: &Run<'_>) -> Result<String, ReportError> {
    let mut bytes = Vec::new();
    write(run, &mut bytes).map_err(|error| ReportError::Encoding(error.to_string()))?;
    String::from_utf8(bytes).map_err(|error| ReportError::Encoding(error.to_string()))
}

/// Writes the same reading by reading: it is never held as a whole.
///
/// # Errors
/// If a number of the measurements cannot be written, or `out` refuses.
pub fn write(run: &Run<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut whole = run.measurements;
    let gathered = Gathered::of(whole);
    write_blocks(run, &gathered, &mut whole, out)
}

/// Measurements that come block by block, as often as they are asked for.
pub(super) trait Blocks {
    /// Shows each block in turn.
    fn each(&mut self, show: &mut dyn FnMut(&Measurements) -> io::Result<()>) -> io::Result<()>;
}

impl Blocks for &Measurements {
    fn each(&mut self, show: &mut dyn FnMut(&Measurements) -> io::Result<()>) -> io::Result<()> {
        show(self)
    }
}

/// Writes the readings of all blocks; the measurements of `run` may be without their points.
pub(super) fn write_blocks(
    run: &Run<'_>,
    gathered: &Gathered,
    blocks: &mut dyn Blocks,
    out: &mut dyn Write,
) -> io::Result<()> {
    let found = run.measurements;
    write!(out, "{{")?;
    for (key, fact) in facts_if(run, gathered.missed() == 0) {
        write!(out, "\n  \"{key}\": {},", indented(&fact, "  "))?;
    }
    let mut readings = List::begin(out, "readings")?;
    blocks.each(&mut |block| {
        let mut own = block.iter_readings();
        own.try_for_each(|one| readings.push(&ReadingObject::new(&one)))
    })?;
    readings.end()?;
    write_list(out, "balance", found.balances().iter().map(balance::object))?;
    write_list(out, "grids", found.sensors.iter().filter_map(grid))?;
    write_list(
        out,
        "statistics",
        gathered.statistics().iter().map(statistics),
    )?;
    write!(out, "\n  \"stored\": ")?;
    write_stored(found, blocks, out)?;
    writeln!(out, "\n}}")
}

fn write_stored(
    run: &Measurements,
    blocks: &mut dyn Blocks,
    out: &mut dyn Write,
) -> io::Result<()> {
    let frame = serde_json::to_string(&run.without_points())?;
    let mut stored = Stored::new(&frame, out);
    blocks.each(&mut |block| {
        let mut sensors = block.sensors.iter();
        sensors.try_for_each(|sensor| stored.push(sensor))
    })?;
    stored.end()
}

/// Puts the points of sensors into the text of measurements that have none.
///
/// Quotes within texts are escaped, so that `NO_POINTS` stands there once a sensor and nowhere else.
struct Stored<'o> {
    between: std::str::Split<'o, &'static str>,
    out: &'o mut dyn Write,
    /// The sensor whose points are being written.
    sensor: Option<String>,
    is_empty: bool,
    buffer: Vec<u8>,
}

const NO_POINTS: &str = "\"points\":[]";

impl<'o> Stored<'o> {
    fn new(frame: &'o str, out: &'o mut dyn Write) -> Self {
        Self {
            between: frame.split(NO_POINTS),
            out,
            sensor: None,
            is_empty: true,
            buffer: Vec::new(),
        }
    }

    fn push(&mut self, sensor: &SensorRecord) -> io::Result<()> {
        if !(sensor.goes_on() && self.sensor.as_ref() == Some(&sensor.name)) {
            self.write_between()?;
            write!(self.out, "\"points\":[")?;
            self.sensor = Some(sensor.name.clone());
            self.is_empty = true;
        }
        for point in &sensor.points {
            self.buffer.clear();
            if !self.is_empty {
                self.buffer.push(b',');
            }
            self.is_empty = false;
            serde_json::to_writer(&mut self.buffer, point)?;
            self.out.write_all(&self.buffer)?;
        }
        Ok(())
    }

    fn write_between(&mut self) -> io::Result<()> {
        let close = if self.sensor.is_some() { "]" } else { "" };
        write!(
            self.out,
            "{close}{}",
            self.between.next().unwrap_or_default()
        )
    }

    fn end(mut self) -> io::Result<()> {
        self.write_between()
    }
}

/// Objects on indented lines under a key.
struct List<'o> {
    out: &'o mut dyn Write,
    is_empty: bool,
    buffer: Vec<u8>,
}

impl<'o> List<'o> {
    fn begin(out: &'o mut dyn Write, key: &str) -> io::Result<Self> {
        write!(out, "\n  \"{key}\": [")?;
        Ok(Self {
            out,
            is_empty: true,
            buffer: Vec::new(),
        })
    }

    /// Line breaks within texts are escaped, so that each there is begins a line of the object.
    fn push(&mut self, value: &impl Serialize) -> io::Result<()> {
        let before: &[u8] = if self.is_empty { b"" } else { b"," };
        self.is_empty = false;
        self.out.write_all(before)?;
        self.buffer.clear();
        serde_json::to_writer_pretty(&mut self.buffer, value)?;
        for line in self.buffer.split(|byte| *byte == b'\n') {
            self.out.write_all(b"\n    ")?;
            self.out.write_all(line)?;
        }
        Ok(())
    }

    fn end(self) -> io::Result<()> {
        let after = if self.is_empty { "" } else { "\n  " };
        write!(self.out, "{after}],")
    }
}

fn write_list(
    out: &mut dyn Write,
    key: &str,
    mut values: impl Iterator<Item = Value>,
) -> io::Result<()> {
    let mut list = List::begin(out, key)?;
    values.try_for_each(|value| list.push(&value))?;
    list.end()
}

/// On lines of which all but the first are moved to the right.
fn indented(value: &Value, by: &str) -> String {
    format!("{value:#}").replace('\n', &format!("\n{by}"))
}

/// What belongs to the run as a whole.
pub fn facts(run: &Run<'_>) -> Map<String, Value> {
    facts_if(run, run.measurements.converged())
}

/// The same where it is known whether every tolerance was met.
pub(super) fn facts_if(run: &Run<'_>, converged: bool) -> Map<String, Value> {
    let measurements = run.measurements;
    let over = measurements.dimming.interval().map(|interval| {
        json!({
            "from": seconds(interval.from()),
            "to": seconds(interval.to()),
        })
    });
    let facts = [
        ("schema", json!(SCHEMA)),
        ("version", json!(run.version)),
        ("scene", json!(measurements.scene_name)),
        ("scene_hash", json!(run.scene_hash)),
        ("seed", json!(measurements.seed)),
        ("confidence", json!(measurements.confidence)),
        ("luminous_efficacy", json!(measurements.luminous_efficacy)),
        ("max_depth", json!(measurements.max_depth)),
        ("complete", json!(measurements.complete())),
        ("converged", json!(converged)),
        ("unsampled", json!(measurements.unsampled)),
        ("warnings", json!(measurements.warnings)),
        ("at", json!(measurements.dimming.moment().map(seconds))),
        ("over", json!(over)),
        ("relit", relit(measurements)),
        ("note", json!(SAMPLING_ERROR_ONLY)),
    ];
    let facts = facts.into_iter();
    facts.map(|(key, fact)| (key.to_owned(), fact)).collect()
}

#[derive(Serialize)]
struct ReadingObject<'a> {
    sensor: &'a str,
    index: usize,
    position: Option<[f64; 3]>,
    normal: Option<[f64; 3]>,
    sits_on: &'a Option<SitsOn>,
    quantity: &'a str,
    unit: &'a str,
    #[serde(flatten)]
    estimate: EstimateObject,
    samples: u64,
    channels: PartsObject<'a>,
    groups: PartsObject<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exposure: Option<Value>,
}

impl<'a> ReadingObject<'a> {
    fn new(reading: &'a Reading) -> Self {
        Self {
            sensor: &reading.sensor,
            index: reading.index,
            position: reading.position,
            normal: reading.normal,
            sits_on: &reading.sits_on,
            quantity: &reading.quantity,
            unit: &reading.unit,
            estimate: EstimateObject::new(&reading.estimate),
            samples: reading.samples,
            channels: PartsObject(&reading.channels),
            groups: PartsObject(&reading.groups),
            exposure: reading.exposure.as_ref().map(exposure),
        }
    }
}

/// How far the points of a grid are apart along its edges, and how far EN 12464-1 lets them be.
fn grid(sensor: &SensorRecord) -> Option<Value> {
    let layout = sensor.layout?;
    Some(json!({
        "sensor": sensor.name,
        "count": layout.count,
        "spacing": { "value": layout.spacing(), "unit": "m" },
        "greatest_spacing": { "value": layout.greatest_spacing(), "unit": "m" },
    }))
}

/// The factors on light groups that are not 1.
pub fn relit(measurements: &Measurements) -> Value {
    let levels = measurements.dimming.levels(&measurements.groups);
    let level = |(name, level): (&str, f64)| (name.to_owned(), json!(level));
    Value::Object(levels.into_iter().map(level).collect())
}

fn statistics(found: &Statistics) -> Value {
    let of_unit = |value: &Estimate, unit: &str| {
        let mut object = estimate(value);
        object.insert("unit".to_owned(), json!(unit));
        object
    };
    let extreme = |extreme: &Extreme| {
        let mut object = of_unit(&extreme.estimate, &found.unit);
        object.insert("index".to_owned(), json!(extreme.index));
        object.insert("position".to_owned(), json!(extreme.position));
        object.insert("biased".to_owned(), json!(is_sampled(&extreme.estimate)));
        object
    };
    let ratio = |ratio: &Estimate| {
        let mut object = of_unit(ratio, "1");
        object.insert("biased".to_owned(), json!(is_sampled(ratio)));
        object
    };
    json!({
        "sensor": found.sensor,
        "quantity": found.quantity,
        "points": found.points,
        "mean": of_unit(&found.mean, &found.unit),
        "min": extreme(&found.min),
        "max": extreme(&found.max),
        "uniformity": found.uniformity.as_ref().map(ratio),
        "diversity": found.diversity.as_ref().map(ratio),
        "groups": PartsObject(&found.groups),
    })
}

fn is_sampled(estimate: &Estimate) -> bool {
    estimate.method == Method::Estimate
}

fn exposure(exposure: &Exposure) -> Value {
    let mut object = Map::new();
    object.insert("quantity".to_owned(), json!(exposure.quantity));
    object.insert("unit".to_owned(), json!(exposure.unit));
    object.extend(estimate(&exposure.estimate));
    let in_hours = exposure.in_hours.as_ref().map(
        |(unit, value)| json!({ "unit": unit, "value": value.value, "std_error": value.std_error }),
    );
    object.insert("in_hours".to_owned(), json!(in_hours));
    Value::Object(object)
}

fn seconds(time: Time) -> Value {
    json!({ "value": time.to_seconds(), "unit": "s" })
}

/// The keys of an estimate; what is not finite is `null`.
#[derive(Serialize)]
struct EstimateObject {
    value: f64,
    std_error: f64,
    confidence_interval: Option<[f64; 2]>,
    upper_bound: Option<f64>,
    method: Method,
    converged: bool,
}

impl EstimateObject {
    fn new(estimate: &Estimate) -> Self {
        Self {
            value: estimate.value,
            std_error: estimate.std_error,
            confidence_interval: estimate.interval,
            upper_bound: estimate.upper_bound,
            method: estimate.method,
            converged: estimate.converged,
        }
    }
}

/// The keys of an estimate, for any report that has one.
pub fn estimate(estimate: &Estimate) -> Map<String, Value> {
    match json!(EstimateObject::new(estimate)) {
        Value::Object(object) => object,
        _ => Map::new(),
    }
}

/// Value and error by name.
struct PartsObject<'a>(&'a [(String, Estimate)]);

impl Serialize for PartsObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Part {
            value: f64,
            std_error: f64,
        }
        let part = |part: &Estimate| Part {
            value: part.value,
            std_error: part.std_error,
        };
        serializer.collect_map(self.0.iter().map(|(name, found)| (name, part(found))))
    }
}

#[cfg(test)]
mod tests {
    use super::super::run::tests::{measurements, run};
    use super::*;

    fn object() -> Value {
        serde_json::from_str(&encode(&run(&measurements())).unwrap()).unwrap()
    }

    /// Written piece by piece, it looks as if it had been written as a whole.
    #[test]
    fn pieces_lie_as_a_whole_would() {
        let text = encode(&run(&measurements())).unwrap();
        let mut whole: Value = serde_json::from_str(&text).unwrap();
        let stored = whole.as_object_mut().unwrap().remove("stored").unwrap();
        let open = format!("{whole:#}");
        let open = open.strip_suffix("\n}").unwrap();
        assert_eq!(text, format!("{open},\n  \"stored\": {stored}\n}}\n"));
    }

    /// Sensors without points, and names that look like what points are put in place of.
    #[test]
    fn what_is_stored_is_what_the_measurements_are() {
        let mut found = measurements();
        found.sensors.push(found.without_points().sensors.remove(0));
        found.sensors[1].name = format!("a {NO_POINTS} b");
        found.scene_name = NO_POINTS.to_owned();
        let text = encode(&run(&found)).unwrap();
        let stored = serde_json::to_string(&found).unwrap();
        assert!(text.ends_with(&format!("  \"stored\": {stored}\n}}\n")));
    }

    #[test]
    fn facts_of_the_run_stand_beside_the_readings() {
        let object = object();
        assert_eq!(object["schema"], SCHEMA);
        assert_eq!(
            (&object["complete"], &object["seed"]),
            (&json!(false), &json!(3))
        );
        assert_eq!(object["unsampled"][0], "point lights seen in mirrors");
        assert_eq!(
            (&object["luminous_efficacy"], &object["scene_hash"]),
            (&json!(179.0), &json!("0123456789abcdef0123"))
        );
    }

    #[test]
    fn a_reading_has_its_parts() {
        let readings = &object()["readings"];
        assert_eq!(
            (&readings[0]["method"], &readings[0]["value"]),
            (&json!("closed-form"), &json!(100.0))
        );
        assert_eq!(
            readings[0]["channels"]["nir"],
            json!({ "value": 20.0, "std_error": 0.0 })
        );
        assert_eq!(
            (&readings[1]["method"], &readings[1]["samples"]),
            (&json!("estimate"), &json!(40))
        );
        assert_eq!(
            readings[1]["groups"]["window"],
            json!({ "value": 0.0, "std_error": null })
        );
        assert_eq!(readings[1]["sits_on"]["shape"], "desk");
    }
}
