//! `--solve` and `--vary`: which dimming of light groups gives wanted readings.

use std::path::Path;

use clap::Args;
use steradian::measurement::Measurements;
use steradian::measurement::solve::{Relation, SolveError, Target, TargetOf, Vary};
use steradian_io::report::{Run, solution};

use super::relight::{unknown, unknown_group};
use crate::output;
use crate::result::{Format, Readings};
use crate::status::{Failure, Outcome};
use crate::tolerance;

const SOLVE: &str = "Find factors for the groups of --vary that give this reading: 'desk: mean = 500 lx', 'room: min >= 300 lx', \
    'desk[12] <= 800 lx'; may be given several times";

/// Which readings are wanted, and what may change for them.
#[derive(Args, Debug)]
pub struct Question {
    /// Readings that are wanted.
    #[arg(help = SOLVE, long, value_name = "TARGET", requires = "vary", conflicts_with = "shard", value_parser = wanted)]
    solve: Vec<Wanted>,
    /// Light groups to find factors for, each from 0 to 1 unless told otherwise: ceiling,window=0..2
    #[arg(long, value_name = "GROUPS", requires = "solve", value_delimiter = ',', value_parser = vary)]
    vary: Vec<Vary>,
}

/// A target whose sensor and unit are not known yet.
#[derive(Clone, Debug, PartialEq)]
struct Wanted {
    sensor: String,
    of: TargetOf,
    relation: Relation,
    value: String,
}

const TARGETS: &str = "expected a target such as 'desk: mean = 500 lx', 'room: min >= 300 lx', 'room: max <= 2000 lx' or 'desk[12] = 500 lx'";

fn wanted(text: &str) -> Result<Wanted, String> {
    const SIGNS: [(&str, Relation); 5] = [
        (">=", Relation::AtLeast),
        ("<=", Relation::AtMost),
        ("≥", Relation::AtLeast),
        ("≤", Relation::AtMost),
        ("=", Relation::Equal),
    ];
    let mut split = SIGNS.iter().filter_map(|(sign, relation)| {
        let (reading, value) = text.split_once(sign)?;
        Some((reading.trim(), *relation, value.trim().to_owned()))
    });
    let (reading, relation, value) = split.next().ok_or(TARGETS)?;
    let (sensor, of) = reading_of(reading).ok_or(TARGETS)?;
    Ok(Wanted {
        sensor,
        of,
        relation,
        value,
    })
}

/// `desk: mean`, `desk[12]`.
fn reading_of(text: &str) -> Option<(String, TargetOf)> {
    let (sensor, of) = match text.strip_suffix(']') {
        Some(text) => {
            let (sensor, index) = text.rsplit_once('[')?;
            (sensor, TargetOf::Point(index.trim().parse().ok()?))
        }
        None => {
            let (sensor, word) = text.rsplit_once(':')?;
            let of = match word.trim() {
                "mean" => TargetOf::Mean,
                "min" => TargetOf::Min,
                "max" => TargetOf::Max,
                _ => return None,
            };
            (sensor, of)
        }
    };
    let sensor = sensor.trim().to_owned();
    (!sensor.is_empty()).then_some((sensor, of))
}

fn vary(text: &str) -> Result<Vary, String> {
    let expected =
        || format!("expected a light group such as ceiling or ceiling=0..2; found `{text}`");
    let (group, bounds) = match text.split_once('=') {
        None => (text.trim(), [0.0, 1.0]),
        Some((group, range)) => {
            let (low, high) = range.split_once("..").ok_or_else(expected)?;
            let number = |text: &str| text.trim().parse().map_err(|_| expected());
            (group.trim(), [number(low)?, number(high)?])
        }
    };
    let group = group.to_owned();
    let found = (!group.is_empty()).then_some(Vary { group, bounds });
    found.ok_or_else(expected)
}

impl Question {
    /// Whether anything is asked.
    pub fn is_asked(&self) -> bool {
        !self.solve.is_empty()
    }

    /// Tells formats that have no place for an answer.
    pub fn refuse(&self, format: Format) -> Result<(), Failure> {
        if self.is_asked() && matches!(format, Format::Csv | Format::Parquet) {
            let message = "--solve is answered as a table or as JSON, not as CSV or Parquet";
            return Err(Failure::message(message));
        }
        Ok(())
    }

    /// Finds the factors and writes them; not as asked when a target is not met.
    pub fn answer(
        &self,
        readings: &Readings,
        format: Format,
        file: Option<&Path>,
    ) -> Result<Outcome, Failure> {
        let measurements = &readings.measurements;
        let target = |wanted: &Wanted| wanted.target(measurements);
        let targets: Vec<Target> = self.solve.iter().map(target).collect::<Result<_, _>>()?;
        let solved = measurements.solve(&targets, &self.vary);
        let solved = solved.map_err(|error| match error {
            SolveError::UnknownGroup(name) => unknown_group(&name, measurements),
            error => Failure::message(format!("--solve: {error}")),
        })?;
        let run: Run<'_> = readings.as_run();
        let text = match format {
            Format::Json => solution::json(&run, &solved),
            _ => solution::table(&run, &solved),
        };
        output::write(text.as_bytes(), file)?;
        let met = solved.targets.iter().all(|achieved| achieved.met);
        Ok(Outcome::fine_if(met && measurements.complete()))
    }
}

impl Wanted {
    /// The target in the unit of the quantity of the sensor that the text has a unit of.
    fn target(&self, measurements: &Measurements) -> Result<Target, Failure> {
        let mut sensors = measurements.sensors.iter();
        let names = sensors.clone().map(|sensor| sensor.name.as_str());
        let sensor = sensors
            .find(|sensor| sensor.name == self.sensor)
            .ok_or_else(|| Failure::message(unknown("sensor", &self.sensor, names)))?;
        let value =
            |unit: &str| tolerance::table(unit).and_then(|table| table.parse(&self.value).ok());
        let mut quantities = sensor.quantities.iter().enumerate();
        let found = quantities.find_map(|(number, readout)| Some((number, value(&readout.unit)?)));
        let (quantity, value) = found.ok_or_else(|| {
            let units = sensor
                .quantities
                .iter()
                .map(|readout| readout.unit.as_str());
            let units = units.collect::<Vec<_>>().join(" and ");
            let (name, value) = (&self.sensor, &self.value);
            Failure::message(format!(
                "--solve: sensor `{name}` reads in {units}; `{value}` is no such quantity"
            ))
        })?;
        Ok(Target {
            sensor: self.sensor.clone(),
            quantity,
            of: self.of,
            relation: self.relation,
            value,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_are_read() {
        for (text, sensor, of, relation, value) in [
            (
                "desk: mean = 500 lx",
                "desk",
                TargetOf::Mean,
                Relation::Equal,
                "500 lx",
            ),
            (
                "room: min>=300lx",
                "room",
                TargetOf::Min,
                Relation::AtLeast,
                "300lx",
            ),
            (
                "a: b: max ≤ 2 klx",
                "a: b",
                TargetOf::Max,
                Relation::AtMost,
                "2 klx",
            ),
            (
                "desk [12] = 1 W/m2",
                "desk",
                TargetOf::Point(12),
                Relation::Equal,
                "1 W/m2",
            ),
        ] {
            let found = wanted(text).unwrap();
            assert_eq!((found.sensor.as_str(), found.of), (sensor, of));
            assert_eq!((found.relation, found.value.as_str()), (relation, value));
        }
    }

    #[test]
    fn other_targets_are_told() {
        for bad in [
            "",
            "desk",
            "desk = 500 lx",
            "desk: median = 3 lx",
            ": mean = 3 lx",
            "desk[a] = 3 lx",
        ] {
            assert!(
                wanted(bad).unwrap_err().contains("'desk: mean = 500 lx'"),
                "{bad}"
            );
        }
    }

    #[test]
    fn groups_have_bounds() {
        assert_eq!(vary("ceiling").unwrap().bounds, [0.0, 1.0]);
        assert_eq!(vary("ceiling = 0.5 .. 2").unwrap().bounds, [0.5, 2.0]);
        for bad in ["", "=0..1", "ceiling=2", "ceiling=a..b"] {
            assert!(vary(bad).unwrap_err().contains("ceiling=0..2"), "{bad}");
        }
    }
}
