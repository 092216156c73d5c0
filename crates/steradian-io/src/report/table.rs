//! Readings for people: one line a reading, then what has to be known about them.

use std::fmt::Write;

use steradian::estimation::Estimate;
use steradian::measurement::{Measurements, Reading, SensorRecord, Statistics};

use steradian::quantity::Time;
use steradian::time::Interval;

use super::balance;
use super::columns::Columns;
use super::numbers::{estimate, exact, significant};
use super::run::{Run, SAMPLING_ERROR_ONLY};

/// The table with its notes.
pub fn encode(run: &Run<'_>) -> String {
    let readings = run.measurements.readings();
    let mut text = String::new();
    if !run.measurements.scene_name.is_empty() {
        text.push_str(&run.measurements.scene_name);
        text.push_str("\n\n");
    }
    let balances = run.measurements.balances();
    for balance in &balances {
        text.push_str(&balance::table(balance, run.measurements.confidence));
        text.push('\n');
    }
    if balances.is_empty() {
        text.push_str(&columns(run.measurements, &readings).to_string());
        text.push('\n');
    }
    let mut statistics = run.measurements.statistics();
    statistics.retain(|found| is_grid(run.measurements, &found.sensor));
    if !statistics.is_empty() {
        text.push_str(&summary(&statistics).to_string());
        text.push('\n');
    }
    if let Some(interval) = run.measurements.dimming.interval() {
        text.push_str(&exposures(&readings, interval).to_string());
        text.push('\n');
    }
    for note in notes(run, &readings) {
        text.push_str(&note);
        text.push('\n');
    }
    text
}

fn columns(measurements: &Measurements, readings: &[Reading]) -> Columns {
    let percent = exact(100.0 * measurements.confidence);
    let parts = Parts {
        channels: readings.iter().any(|reading| reading.channels.len() > 1),
        groups: measurements.group_names().len() > 1,
    };
    let mut headings = ["sensor", "#", "at (m)", "quantity"]
        .map(str::to_owned)
        .to_vec();
    headings.push(format!("value ({percent} %)"));
    headings.extend(
        measurements
            .lanes
            .iter()
            .filter(|_| parts.channels)
            .map(|lane| lane.name.clone()),
    );
    let names = measurements.group_names().into_iter();
    headings.extend(names.filter(|_| parts.groups).cloned());
    let mut columns = Columns::new(headings).right_aligned(1);
    for reading in readings {
        columns.row(cells(measurements, reading, parts));
    }
    columns
}

/// Which parts of a reading have columns: those of which there are several.
#[derive(Clone, Copy)]
struct Parts {
    channels: bool,
    groups: bool,
}

fn cells(measurements: &Measurements, reading: &Reading, shown: Parts) -> Vec<String> {
    let mark = if reading.estimate.converged {
        ""
    } else {
        " (not converged)"
    };
    let value = with_unit(&reading.estimate, &reading.unit);
    let mut cells = vec![
        reading.sensor.clone(),
        reading.index.to_string(),
        reading.position.map_or_else(|| "surface".to_owned(), place),
        reading.quantity.clone(),
        format!("{value}{mark}"),
    ];
    let lanes = measurements.lanes.iter().filter(|_| shown.channels);
    cells.extend(lanes.map(|lane| {
        let mut channels = reading.channels.iter();
        let channel = channels.find(|(name, _)| *name == lane.name);
        channel.map_or_else(String::new, |(_, part)| estimate(part))
    }));
    let groups = reading.groups.iter().filter(|_| shown.groups);
    cells.extend(groups.map(|(_, part)| estimate(part)));
    cells
}

/// Whether the points of a sensor stand for an area: of points listed one by one a mean says little.
fn is_grid(measurements: &Measurements, sensor: &str) -> bool {
    let mut sensors = measurements.sensors.iter();
    sensors.any(|record| record.name == sensor && record.layout.is_some())
}

/// What the points of each grid have in common.
fn summary(statistics: &[Statistics]) -> Columns {
    let headings = [
        "sensor", "quantity", "mean", "min", "at #", "max", "at #", "min/mean", "min/max",
    ];
    let mut columns = Columns::new(headings).right_aligned(4).right_aligned(6);
    for found in statistics {
        let ratio = |ratio: &Option<Estimate>| ratio.as_ref().map_or_else(String::new, estimate);
        columns.row([
            found.sensor.clone(),
            found.quantity.clone(),
            with_unit(&found.mean, &found.unit),
            with_unit(&found.min.estimate, &found.unit),
            found.min.index.to_string(),
            with_unit(&found.max.estimate, &found.unit),
            found.max.index.to_string(),
            ratio(&found.uniformity),
            ratio(&found.diversity),
        ]);
    }
    columns
}

/// What the readings add up to over an interval.
fn exposures(readings: &[Reading], interval: Interval) -> Columns {
    let hours = |time: Time| exact(time.to_hours());
    let heading = format!("{} h to {} h", hours(interval.from()), hours(interval.to()));
    let headings = ["sensor", "#", "over time", &heading, "in hours"];
    let mut columns = Columns::new(headings).right_aligned(1);
    for reading in readings {
        let Some(exposure) = &reading.exposure else {
            continue;
        };
        let in_hours = exposure.in_hours.as_ref();
        columns.row([
            reading.sensor.clone(),
            reading.index.to_string(),
            exposure.quantity.clone(),
            with_unit(&exposure.estimate, &exposure.unit),
            in_hours.map_or_else(String::new, |(unit, value)| with_unit(value, unit)),
        ]);
    }
    columns
}

/// `503.2 ± 2.2 lx`, `100 W/m2 (exact)`: the unit stands before a remark.
pub(super) fn with_unit(value: &Estimate, unit: &str) -> String {
    let text = estimate(value);
    match text
        .split_once(" (")
        .filter(|(_, remark)| remark.ends_with(')'))
    {
        Some((number, remark)) => format!("{number} {unit} ({remark}"),
        None => format!("{text} {unit}"),
    }
}

fn place(position: [f64; 3]) -> String {
    position
        .map(|coordinate| significant(coordinate, 6))
        .join(" ")
}

fn notes(run: &Run<'_>, readings: &[Reading]) -> Vec<String> {
    let measurements = run.measurements;
    let mut notes = vec![SAMPLING_ERROR_ONLY.to_owned(), identity(run)];
    notes.extend(dimmed(measurements));
    notes.extend(relit(measurements));
    notes.extend(measurements.sensors.iter().filter_map(grid));
    let missed = measurements.missed();
    if missed > 0 {
        notes.push(format!(
            "Not converged: {missed} of {} readings.",
            readings.len()
        ));
    }
    let missing =
        |class: &String| format!("Not sampled, so values are too low by what it carries: {class}");
    notes.extend(measurements.unsampled.iter().map(missing));
    notes.extend(
        measurements
            .warnings
            .iter()
            .map(|warning| format!("Warning: {warning}")),
    );
    notes
}

/// What the readings assume of the lights' schedules.
fn dimmed(measurements: &Measurements) -> Option<String> {
    let dimming = &measurements.dimming;
    match dimming.moment() {
        Some(time) => Some(format!("Values at {} h.", exact(time.to_hours()))),
        None => dimming.has_schedules().then(|| {
            "Values with all lights at factor 1 of their schedules; --at gives those at a time."
                .to_owned()
        }),
    }
}

/// How far the points of a grid are apart, and how far they may be.
fn grid(sensor: &SensorRecord) -> Option<String> {
    let layout = sensor.layout?;
    let [columns, rows] = layout.count;
    let [first, second] = layout.spacing().map(|spacing| significant(spacing, 3));
    let most = significant(layout.greatest_spacing(), 3);
    let name = &sensor.name;
    Some(format!(
        "{name}: {columns} x {rows} points, {first} m x {second} m apart; EN 12464-1 asks for {most} m at most."
    ))
}

/// How light groups were dimmed after the run.
pub(super) fn relit(measurements: &Measurements) -> Option<String> {
    let levels = measurements.dimming.levels(&measurements.groups);
    let level = |(name, level): &(&str, f64)| match *level {
        0.0 => format!("{name} off"),
        level => format!("{name} at {} %", exact(100.0 * level)),
    };
    let levels: Vec<String> = levels.iter().map(level).collect();
    (!levels.is_empty()).then(|| {
        format!(
            "Relit from the result of a run: {}. Whether readings converged is told of that run.",
            levels.join(", ")
        )
    })
}

/// The numbers that a repetition needs.
pub(super) fn identity(run: &Run<'_>) -> String {
    let measurements = run.measurements;
    let mut text = String::new();
    if let Some(efficacy) = measurements.luminous_efficacy {
        let _ = write!(text, "K = {} lm/W. ", exact(efficacy));
    }
    if let Some(depth) = measurements.max_depth {
        let _ = write!(text, "Paths limited to {depth} segments. ");
    }
    if let Some((part, of)) = measurements.shard {
        let _ = write!(text, "Part {part} of {of}. ");
    }
    let hash = run.scene_hash.get(..16).unwrap_or(run.scene_hash);
    let _ = write!(
        text,
        "Seed {}. Scene {hash}. Steradian {}.",
        measurements.seed, run.version
    );
    text
}

#[cfg(test)]
mod tests {
    use super::super::run::tests::{measurements, run};
    use super::*;
    use steradian::estimation::Method;

    #[test]
    fn exact_and_sampled_readings_stand_in_columns() {
        let measurements = measurements();
        let text = encode(&run(&measurements));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "A, \"desk\"");
        for heading in ["sensor", "value (95 %)", "visible", "nir", "lamp", "window"] {
            assert!(lines[2].contains(heading), "{text}");
        }
        assert!(lines[3].contains("100 W/m2 (exact)  80 (exact)"), "{text}");
        // t(3) √(5/12) = 2.05, and no light was seen in the other lane and group.
        assert!(
            lines[4].contains("2.5 ± 2.1 W/m2") && lines[4].contains("(nothing seen)"),
            "{text}"
        );
    }

    #[test]
    fn the_notes_tell_what_a_reader_must_know() {
        let measurements = measurements();
        let text = encode(&run(&measurements));
        for note in [
            SAMPLING_ERROR_ONLY,
            "K = 179 lm/W. Seed 3. Scene 0123456789abcdef. Steradian 1.2.3.",
            "Not sampled, so values are too low by what it carries: point lights seen in mirrors",
            "Warning: a warning",
        ] {
            assert!(text.contains(note), "{note} is not in\n{text}");
        }
    }

    #[test]
    fn a_unit_stands_before_a_remark() {
        assert_eq!(with_unit(&Estimate::closed_form(2.0), "lx"), "2 lx (exact)");
        let tiny = Estimate {
            interval: Some([1e-9, 3e-9]),
            method: Method::Estimate,
            ..Estimate::closed_form(2e-9)
        };
        assert_eq!(with_unit(&tiny, "lx"), "(2.0 ± 1.0)e-9 lx");
    }
}
