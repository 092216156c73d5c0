//! What holds for the whole result: its name, whether it is what was asked for, and what a repetition needs.

use super::markup::Markup;
use crate::report::numbers::exact;
use crate::report::run::{Run, SAMPLING_ERROR_ONLY};
use crate::report::table;

/// The name of the scene.
pub(super) fn title(run: &Run<'_>) -> String {
    match run.measurements.scene_name.as_str() {
        "" => "Light in a scene without a name".to_owned(),
        name => name.to_owned(),
    }
}

pub(super) fn made_by(run: &Run<'_>) -> String {
    format!(
        "Made by Steradian {} from a result of `steradian measure`.",
        run.version
    )
}

/// The title, and whether the run is what was asked for.
pub(super) fn header(header: &mut Markup, run: &Run<'_>) {
    let measurements = run.measurements;
    header.leaf("h1", &title(run));
    header.element("p", &[("class", "subtitle")], |p| {
        p.words("Light in numbers, each with its error bar");
    });
    let readings = measurements.readings();
    let missed = readings
        .iter()
        .filter(|reading| !reading.estimate.converged)
        .count();
    let converged = match missed {
        0 => format!("Converged: all {} readings", readings.len()),
        _ => format!("Not converged: {missed} of {} readings", readings.len()),
    };
    verdict(header, missed == 0, &converged);
    let complete = match measurements.complete() {
        true => "Complete: no kind of light path was left out",
        false => "Not complete: values are too low by what is listed below",
    };
    verdict(header, measurements.complete(), complete);
    if let Some((part, of)) = measurements.shard {
        verdict(header, false, &format!("Part {part} of {of} of a run"));
    }
}

fn verdict(header: &mut Markup, is_good: bool, words: &str) {
    let class = if is_good {
        "verdict good"
    } else {
        "verdict bad"
    };
    header.element("span", &[("class", class)], |span| span.words(words));
}

/// What error bars leave out, warnings, and light that was not sampled.
pub(super) fn statements(main: &mut Markup, run: &Run<'_>) {
    let measurements = run.measurements;
    main.element("p", &[("class", "statement")], |p| {
        p.words(SAMPLING_ERROR_ONLY)
    });
    let left_out = "Not sampled, so that values are too low by what it carries:";
    notices(main, left_out, &measurements.unsampled);
    notices(
        main,
        "Dimmed after the run:",
        &table::relit(measurements).into_iter().collect::<Vec<_>>(),
    );
    notices(main, "Warnings:", &measurements.warnings);
}

fn notices(main: &mut Markup, heading: &str, notices: &[String]) {
    if notices.is_empty() {
        return;
    }
    main.element("div", &[("class", "warnings")], |block| {
        block.leaf("p", heading);
        block.element("ul", &[], |list| {
            notices.iter().for_each(|notice| list.leaf("li", notice));
        });
    });
}

/// What a repetition needs.
pub(super) fn facts(main: &mut Markup, run: &Run<'_>) {
    main.leaf("h2", "The run");
    main.element("table", &[("class", "facts")], |table| {
        table.element("tbody", &[], |body| {
            for (name, value) in rows(run) {
                body.element("tr", &[], |row| {
                    row.element("th", &[("scope", "row")], |head| head.words(name));
                    row.element("td", &[], |cell| match name {
                        "scene hash" => cell.leaf("code", &value),
                        _ => cell.words(&value),
                    });
                });
            }
        });
    });
}

fn rows(run: &Run<'_>) -> Vec<(&'static str, String)> {
    let measurements = run.measurements;
    let points = measurements
        .sensors
        .iter()
        .flat_map(|sensor| &sensor.points);
    let samples: u64 = points
        .filter_map(|point| point.replicates.as_ref())
        .map(|replicates| replicates.total_samples())
        .sum();
    let mut rows = vec![
        ("scene hash", run.scene_hash.to_owned()),
        ("program", format!("Steradian {}", run.version)),
        ("seed", measurements.seed.to_string()),
        ("samples", format!("{samples} paths in all")),
        (
            "confidence",
            format!(
                "{} % for each interval by itself",
                exact(100.0 * measurements.confidence)
            ),
        ),
        ("luminous efficacy K", efficacy(run)),
        (
            "light groups",
            measurements
                .group_names()
                .into_iter()
                .cloned()
                .collect::<Vec<_>>()
                .join(", "),
        ),
    ];
    if let Some(depth) = measurements.max_depth {
        rows.push((
            "longest path",
            format!("{depth} segments; longer ones are left out"),
        ));
    }
    let dimming = &measurements.dimming;
    match dimming.moment() {
        Some(time) => rows.push(("time", format!("{} h", exact(time.to_hours())))),
        None if dimming.has_schedules() => {
            rows.push((
                "time",
                "all lights at factor 1 of their schedules".to_owned(),
            ));
        }
        None => {}
    }
    rows
}

fn efficacy(run: &Run<'_>) -> String {
    let measurements = run.measurements;
    let mut quantities = measurements
        .sensors
        .iter()
        .flat_map(|sensor| &sensor.quantities);
    match measurements.luminous_efficacy {
        None => "not used: by wavelength, watts and lumens are linked by V(λ)".to_owned(),
        Some(k) if quantities.any(|quantity| quantity.photometric) => format!(
            "{} lm/W links watts and lumens; it cancels where lights and readings are both photometric",
            exact(k)
        ),
        Some(k) => format!("{} lm/W, which no reading here needs", exact(k)),
    }
}
