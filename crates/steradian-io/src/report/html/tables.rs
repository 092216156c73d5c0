//! Tables of a page.

use steradian::estimation::Estimate;
use steradian::measurement::{Extreme, Reading};

use super::markup::Markup;
use super::sensor::anchor;
use crate::report::figure::Subject;
use crate::report::numbers::{estimate, exact, significant};
use crate::report::run::Run;
use crate::report::table::with_unit;

/// Longer tables of readings are folded.
const MOST_ROWS: usize = 50;
/// What stands for no value.
const NONE: &str = "–";
const NUMBER: [(&str, &str); 1] = [("class", "number")];

/// A table with its caption and headings; columns from `numbers` on are flush right.
fn table(
    parent: &mut Markup,
    caption: &str,
    headings: &[String],
    numbers: usize,
    rows: impl FnOnce(&mut Markup),
) {
    parent.element("div", &[("class", "scroll")], |scroll| {
        scroll.element("table", &[], |table| {
            table.leaf("caption", caption);
            table.element("thead", &[], |head| {
                head.element("tr", &[], |row| {
                    for (column, heading) in headings.iter().enumerate() {
                        let class = if column < numbers { "" } else { "number" };
                        let attributes = [("scope", "col"), ("class", class)];
                        row.element("th", &attributes, |cell| cell.words(heading));
                    }
                });
            });
            table.element("tbody", &[], rows);
        });
    });
}

/// A row whose first cell is its heading.
fn row(body: &mut Markup, heading: impl FnOnce(&mut Markup), cells: &[String], numbers: usize) {
    body.element("tr", &[], |row| {
        row.element("th", &[("scope", "row")], heading);
        for (column, cell) in (1..).zip(cells) {
            let attributes: &[_] = if column < numbers { &[] } else { &NUMBER };
            row.element("td", attributes, |td| td.words(cell));
        }
    });
}

fn words(headings: &[&str]) -> Vec<String> {
    headings
        .iter()
        .map(|heading| (*heading).to_owned())
        .collect()
}

/// All sensors with links to their sections.
pub(super) fn overview(main: &mut Markup, run: &Run<'_>, subjects: &[Subject]) {
    main.leaf("h2", "Results");
    let headings = words(&[
        "sensor",
        "quantity",
        "points",
        "mean",
        "min",
        "max",
        "U₀ = min/mean",
        "U_d = min/max",
    ]);
    let caption = format!(
        "Mean, least and greatest reading of each sensor; ± {}",
        half_widths(run)
    );
    table(main, &caption, &headings, 2, |body| {
        for (number, subject) in subjects.iter().enumerate() {
            let link = format!("#{}", anchor(number));
            let heading = |cell: &mut Markup| {
                cell.element("a", &[("href", &link)], |a| a.words(&subject.sensor));
            };
            row(body, heading, &overview_cells(subject), 2);
        }
    });
}

fn overview_cells(subject: &Subject) -> Vec<String> {
    let count = subject.readings.len().to_string();
    let with_unit = |value: &Estimate| with_unit(value, &subject.unit);
    let first = [subject.quantity.clone(), count];
    let others = match &subject.statistics {
        None => {
            let single = with_unit(&subject.readings[0].estimate);
            [single, NONE.into(), NONE.into(), NONE.into(), NONE.into()]
        }
        Some(found) => {
            let ratio =
                |ratio: &Option<Estimate>| ratio.as_ref().map_or_else(|| NONE.to_owned(), estimate);
            [
                with_unit(&found.mean),
                with_unit(&found.min.estimate),
                with_unit(&found.max.estimate),
                ratio(&found.uniformity),
                ratio(&found.diversity),
            ]
        }
    };
    first.into_iter().chain(others).collect()
}

/// The statistics of a sensor with several points, and where its extremes are.
pub(super) fn statistics(section: &mut Markup, run: &Run<'_>, subject: &Subject) {
    let Some(found) = &subject.statistics else {
        return;
    };
    let caption = format!(
        "{} points; ± {}. Minimum and maximum of noisy readings are biased outwards.",
        found.points,
        half_widths(run)
    );
    let headings = words(&["", "value", "where (m)"]);
    let value = |value: &Estimate| with_unit(value, &found.unit);
    let at = |extreme: &Extreme| {
        let place = extreme.position.map_or_else(|| NONE.to_owned(), place);
        format!("point {} at {place}", extreme.index)
    };
    let mut rows = vec![
        ("mean", value(&found.mean), String::new()),
        ("min", value(&found.min.estimate), at(&found.min)),
        ("max", value(&found.max.estimate), at(&found.max)),
    ];
    let ratios = [
        ("U₀ = min/mean", &found.uniformity),
        ("U_d = min/max", &found.diversity),
    ];
    let ratios = ratios
        .into_iter()
        .filter_map(|(name, ratio)| Some((name, estimate(ratio.as_ref()?), String::new())));
    rows.extend(ratios);
    table(section, &caption, &headings, 3, |body| {
        for (name, value, place) in rows {
            row(body, |cell| cell.words(name), &[value, place], 3);
        }
    });
}

fn place(position: [f64; 3]) -> String {
    position.map(|x| significant(x, 6)).join(", ")
}

fn half_widths(run: &Run<'_>) -> String {
    let percent = exact(100.0 * run.measurements.confidence);
    format!("half-width of the {percent} % interval")
}

/// What each light group gives, in the mean over the points.
pub(super) fn groups(section: &mut Markup, run: &Run<'_>, subject: &Subject) {
    let (groups, Some(whole)) = (subject.groups(), subject.mean()) else {
        return;
    };
    if groups.len() < 2 {
        return;
    }
    section.leaf("h3", "Light groups");
    let of = match subject.readings.len() {
        1 => String::new(),
        count => format!(", mean of {count} points"),
    };
    let caption = format!("What each light group gives{of}; ± {}", half_widths(run));
    let value = format!("value ({})", subject.unit);
    let headings = [words(&["group"]), vec![value, "share".to_owned()]].concat();
    let share = |part: &Estimate| match whole.value == 0.0 {
        true => NONE.to_owned(),
        false => format!("{} %", significant(100.0 * part.value / whole.value, 3)),
    };
    table(section, &caption, &headings, 1, |body| {
        for (name, part) in groups {
            row(
                body,
                |cell| cell.words(name),
                &[estimate(part), share(part)],
                1,
            );
        }
        let cells = [estimate(whole), "100 %".to_owned()];
        row(body, |cell| cell.words("sum"), &cells, 1);
    });
}

/// Every reading, folded where there are many.
pub(super) fn readings(section: &mut Markup, run: &Run<'_>, subject: &Subject) {
    let count = subject.readings.len();
    section.leaf("h3", "Readings");
    if count <= MOST_ROWS {
        return reading_table(section, run, subject);
    }
    section.element("details", &[], |details| {
        details.leaf("summary", &format!("All {count} readings"));
        reading_table(details, run, subject);
    });
}

fn reading_table(parent: &mut Markup, run: &Run<'_>, subject: &Subject) {
    let names = run.measurements.group_names();
    let names: Vec<String> = match names.len() {
        1 => Vec::new(),
        _ => names.into_iter().cloned().collect(),
    };
    let value = format!("{} ({})", subject.quantity, subject.unit);
    let has_groups = !names.is_empty();
    let headings = [words(&["point", "x, y, z (m)"]), vec![value], names].concat();
    let caption = format!("{}, ± {}", subject.unit, half_widths(run));
    table(parent, &caption, &headings, 2, |body| {
        for reading in &subject.readings {
            let cells = reading_cells(reading, has_groups);
            let number = reading.index.to_string();
            row(body, |cell| cell.words(&number), &cells, 2);
        }
    });
}

fn reading_cells(reading: &Reading, has_groups: bool) -> Vec<String> {
    let sits_on = reading.sits_on.as_ref();
    let sits_on = sits_on.map(|on| format!(" on {} ({})", on.shape, on.side));
    let at = reading.position.map_or_else(|| "surface".to_owned(), place);
    let mark = match reading.estimate.converged {
        true => "",
        false => " (not converged)",
    };
    let groups = reading.groups.iter().filter(|_| has_groups);
    let mut cells = vec![
        at + &sits_on.unwrap_or_default(),
        format!("{}{mark}", estimate(&reading.estimate)),
    ];
    cells.extend(groups.map(|(_, part)| estimate(part)));
    cells
}
