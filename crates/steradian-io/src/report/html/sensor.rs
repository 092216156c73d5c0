//! A quantity of a sensor: pictures, shares of light groups, and readings.

use super::markup::Markup;
use super::tables;
use crate::report::figure::{self, Subject};
use crate::report::plot::PlotError;
use crate::report::run::Run;
use crate::report::svg::Svg;

/// The section of one subject, which has a number for links.
pub(super) fn section(
    run: &Run<'_>,
    subject: &Subject,
    number: usize,
) -> Result<Markup, PlotError> {
    let measurements = run.measurements;
    let place = subject.has_places() && subject.readings.len() > 1;
    let plan = place
        .then(|| figure::plan(measurements, subject, false))
        .transpose()?;
    let lines = subject
        .is_grid()
        .then(|| figure::isolines(measurements, subject, &[]))
        .transpose()?;
    let shares = has_shares(run, subject).then(|| figure::shares(measurements, &[subject]));
    let shares = shares.transpose()?;
    let mut section = Markup::default();
    let id = anchor(number);
    section.element("section", &[("id", &id)], |section| {
        section.leaf("h2", &format!("{}: {}", subject.sensor, subject.quantity));
        tables::statistics(section, run, subject);
        if let Some(plan) = plan {
            picture(section, plan, "Plan", subject, "The values where they were found.");
        }
        if let Some(lines) = lines {
            let percent = 100.0 * measurements.confidence;
            let caption = format!(
                "Lines of equal values, interpolated between the points. Within a shaded band the {percent} % interval of the value \
                 holds the level of the line, so that the line lies somewhere in it."
            );
            picture(section, lines, "Lines of equal values", subject, &caption);
        }
        if let Some(shares) = shares {
            picture(section, shares, "Shares of light groups", subject, "What each light group gives, in parts of the sum.");
        }
        tables::groups(section, run, subject);
        tables::readings(section, run, subject);
    });
    Ok(section)
}

/// The name that links use.
pub(super) fn anchor(number: usize) -> String {
    format!("sensor-{number}")
}

/// Whether there are several groups, none of which takes light away.
fn has_shares(run: &Run<'_>, subject: &Subject) -> bool {
    let mut parts = subject.readings.iter().flat_map(|reading| &reading.groups);
    run.measurements.group_names().len() > 1 && parts.all(|(_, part)| part.value >= 0.0)
}

fn picture(section: &mut Markup, drawing: Svg, title: &str, subject: &Subject, caption: &str) {
    section.leaf("h3", title);
    let shows = format!("{title}: {} of {}", subject.quantity, subject.sensor);
    section.element("figure", &[], |figure| {
        figure.drawing(drawing, &shows);
        figure.leaf("figcaption", caption);
    });
}
