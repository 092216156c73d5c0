//! What light groups give: of each sensor, or of each point of one.

use steradian::estimation::Estimate;
use steradian::measurement::{Measurements, Reading};

use super::choice::Subject;
use crate::report::plot::{Bar, HeatMap, PlotError, ShareBars};
use crate::report::svg::Svg;
use crate::report::table::with_unit;

/// A sensor with more points than this is shown by their mean.
const MOST_POINTS: usize = 40;

/// A value, and what the groups give of it.
struct Row {
    name: String,
    parts: Vec<f64>,
    sum: String,
}

/// The share of each light group as bars: of one sensor by its points, of several by their means.
///
/// Of several sensors those with a negative part, such as a net flux, are left out.
///
/// # Errors
/// If there is nothing to show, or a part is negative or not finite.
pub fn shares(measurements: &Measurements, subjects: &[&Subject]) -> Result<Svg, PlotError> {
    let mut rows = rows(subjects);
    if subjects.len() > 1 {
        rows.retain(|row| row.parts.iter().all(|part| *part >= 0.0));
    }
    let bar = |row: Row| Bar {
        name: row.name,
        parts: row.parts,
        sum: row.sum,
    };
    let bars = ShareBars {
        title: title("Shares of light groups", measurements, subjects),
        parts: groups(measurements),
        bars: rows.into_iter().map(bar).collect(),
    };
    bars.drawing()
}

/// What each light group gives, in the unit of the value, by colour: to one sensor by its points, to several by their means, as
/// far as they have the quantity of the first.
///
/// # Errors
/// If there is nothing to show, or a part is not finite.
pub fn matrix(measurements: &Measurements, subjects: &[&Subject]) -> Result<Svg, PlotError> {
    let first = subjects.first().ok_or(PlotError::Empty)?;
    let alike =
        |subject: &&&Subject| subject.quantity == first.quantity && subject.unit == first.unit;
    let subjects: Vec<&Subject> = subjects.iter().filter(alike).copied().collect();
    let rows = rows(&subjects);
    let words = format!("Light groups: {}", first.quantity);
    let map = HeatMap {
        title: title(&words, measurements, &subjects),
        legend: first.unit.clone(),
        rows: rows.iter().map(|row| row.name.clone()).collect(),
        columns: groups(measurements),
        values: rows.into_iter().map(|row| row.parts).collect(),
        with_numbers: true,
    };
    map.drawing()
}

fn title(words: &str, measurements: &Measurements, subjects: &[&Subject]) -> String {
    let scene = measurements.scene_name.as_str();
    let sensor = match subjects {
        [single] => single.sensor.as_str(),
        _ => "",
    };
    let place: Vec<&str> = [scene, sensor]
        .into_iter()
        .filter(|part| !part.is_empty())
        .collect();
    match place.is_empty() {
        true => words.to_owned(),
        false => format!("{words} ({})", place.join(", ")),
    }
}

fn groups(measurements: &Measurements) -> Vec<String> {
    measurements.group_names().into_iter().cloned().collect()
}

fn rows(subjects: &[&Subject]) -> Vec<Row> {
    match subjects {
        [single] if (2..=MOST_POINTS).contains(&single.readings.len()) => of_points(single),
        _ => subjects.iter().map(|subject| mean(subject)).collect(),
    }
}

fn of_points(subject: &Subject) -> Vec<Row> {
    let row = |reading: &Reading| Row {
        name: format!("point {}", reading.index),
        parts: values(&reading.groups),
        sum: with_unit(&reading.estimate, &reading.unit),
    };
    subject.readings.iter().map(row).collect()
}

fn mean(subject: &Subject) -> Row {
    let sum = subject.mean().map(|mean| with_unit(mean, &subject.unit));
    Row {
        name: match subject.readings.len() {
            1 => subject.sensor.clone(),
            count => format!("{} (mean of {count})", subject.sensor),
        },
        parts: values(subject.groups()),
        sum: sum.unwrap_or_default(),
    }
}

fn values(groups: &[(String, Estimate)]) -> Vec<f64> {
    groups.iter().map(|(_, part)| part.value).collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::run::tests::measurements;
    use super::*;

    /// Points of 100 W/m2 and 2.5 W/m2, all of it from the lamp.
    fn drawn(copies: usize) -> String {
        let measurements = measurements();
        let subjects = Subject::all(&measurements);
        let shown = vec![&subjects[0]; copies];
        shares(&measurements, &shown).unwrap().finish()
    }

    #[test]
    fn sensors_have_the_mean_of_their_points() {
        let svg = drawn(2);
        for part in [
            ">a, b (mean of 2)<",
            ">51.2 ± 1.0 W/m2<",
            ">100 %<",
            ">lamp<",
            ">window<",
        ] {
            assert!(svg.contains(part), "{part} is not in {svg}");
        }
    }

    #[test]
    fn points_of_a_sensor_have_bars_of_their_own() {
        let svg = drawn(1);
        for part in [
            ">point 0<",
            ">100 W/m2 (exact)<",
            ">point 1<",
            ">2.5 ± 2.1 W/m2<",
        ] {
            assert!(svg.contains(part), "{part} is not in {svg}");
        }
    }

    #[test]
    fn a_matrix_has_groups_as_columns() {
        let measurements = measurements();
        let subjects = Subject::all(&measurements);
        let svg = matrix(&measurements, &[&subjects[0]]).unwrap().finish();
        for part in ["Light groups: irradiance", ">lamp<", ">window<", ">W/m2<"] {
            assert!(svg.contains(part), "{part} is not in {svg}");
        }
        assert_eq!(matrix(&measurements, &[]), Err(PlotError::Empty));
    }
}
