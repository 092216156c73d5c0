//! Maps of the points of a sensor.

use steradian::estimation::Estimate;
use steradian::measurement::Measurements;
use steradian::sensor::Layout;

use super::choice::Subject;
use super::view::View;
use crate::report::numbers::estimate;
use crate::report::plot::{Field, Isolines, Lattice, Plan, PlotError};
use crate::report::svg::Svg;
use crate::report::table::with_unit;

/// The points of a sensor where they are, with their values.
///
/// # Errors
/// If none of them lies anywhere, or a value is not finite.
pub fn plan(
    measurements: &Measurements,
    subject: &Subject,
    with_errors: bool,
) -> Result<Svg, PlotError> {
    let field = field(measurements, subject);
    let field = &field;
    Plan { field, with_errors }.drawing()
}

/// Lines of equal values over the points of a sensor that are a grid, at these levels or, if there are none, at round ones.
///
/// # Errors
/// If they are no grid of at least 2 by 2, or a value is not finite.
pub fn isolines(
    measurements: &Measurements,
    subject: &Subject,
    levels: &[f64],
) -> Result<Svg, PlotError> {
    let field = field(measurements, subject);
    let field = &field;
    Isolines { field, levels }.drawing()
}

fn field(measurements: &Measurements, subject: &Subject) -> Field {
    let normal = subject.readings.first().and_then(|reading| reading.normal);
    let layout = subject.layout.as_ref();
    let view = layout.map_or(View::ABOVE, |layout| View::of(layout, normal));
    let placed = subject.readings.iter().filter_map(|reading| {
        let place = view.place(reading.position?);
        Some((place, &reading.estimate))
    });
    let (places, estimates): (Vec<_>, Vec<&Estimate>) = placed.unzip();
    Field {
        title: title(&measurements.scene_name, subject),
        notes: notes(subject),
        axes: view.axes(),
        quantity: subject.quantity.clone(),
        unit: subject.unit.clone(),
        values: estimates.iter().map(|estimate| estimate.value).collect(),
        intervals: estimates.into_iter().map(interval).collect(),
        percent: 100.0 * measurements.confidence,
        lattice: layout.map(|layout| lattice(layout, &view)),
        places,
    }
}

fn title(scene: &str, subject: &Subject) -> String {
    match scene {
        "" => subject.sensor.clone(),
        scene => format!("{scene}: {}", subject.sensor),
    }
}

/// What is known of a value: its interval; what it is probably below where no sample had light; else the value alone.
fn interval(estimate: &Estimate) -> [f64; 2] {
    let value = estimate.value;
    let bounded = estimate.upper_bound.map(|bound| [value, bound.max(value)]);
    estimate.interval.or(bounded).unwrap_or([value; 2])
}

fn lattice(layout: &Layout, view: &View) -> Lattice {
    let origin = view.place(layout.origin);
    Lattice {
        origin,
        edges: layout.edges.map(|edge| view.place(edge)),
        count: layout.count.map(|count| count as usize),
    }
}

/// What the points have in common.
fn notes(subject: &Subject) -> Vec<String> {
    let Some(found) = &subject.statistics else {
        return Vec::new();
    };
    let unit = &found.unit;
    let [least, greatest] =
        [&found.min, &found.max].map(|extreme| with_unit(&extreme.estimate, unit));
    let mut notes = vec![format!(
        "mean {}, min {least}, max {greatest}",
        with_unit(&found.mean, unit)
    )];
    let ratio = |name: &str, of: &Estimate| format!("{name} {}", estimate(of));
    let uniformity = found.uniformity.iter().map(|of| ratio("U₀ = min/mean", of));
    let diversity = found.diversity.iter().map(|of| ratio("min/max", of));
    let ratios: Vec<String> = uniformity.chain(diversity).collect();
    if !ratios.is_empty() {
        notes.push(ratios.join(", "));
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::super::super::run::tests::measurements;
    use super::*;

    fn gridded() -> Measurements {
        let mut measurements = measurements();
        measurements.sensors[0].layout = Some(Layout {
            origin: [0.0; 3],
            edges: [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
            count: [1, 2],
        });
        measurements
    }

    #[test]
    fn a_plan_shows_the_readings_of_a_sensor() {
        let measurements = gridded();
        let subjects = Subject::all(&measurements);
        let drawing = plan(&measurements, &subjects[0], true).unwrap();
        let svg = drawing.finish();
        for part in [
            ">100<",
            ">2.50<",
            "a, b",
            "irradiance (W/m2)",
            "x (m)",
            "mean 51.2 ± 1.0 W/m2",
            "U₀ = min/mean",
        ] {
            assert!(svg.contains(part), "{part} is not in {svg}");
        }
        let lines = isolines(&measurements, &subjects[0], &[]);
        assert_eq!(lines, Err(PlotError::NoGrid));
    }

    /// Where no sample had light the interval ends at what the value is probably below.
    #[test]
    fn an_interval_is_all_that_is_known() {
        let nothing = Estimate {
            interval: None,
            upper_bound: Some(0.5),
            ..Estimate::closed_form(0.0)
        };
        assert_eq!(interval(&nothing), [0.0, 0.5]);
        assert_eq!(interval(&Estimate::closed_form(2.0)), [2.0, 2.0]);
    }
}
