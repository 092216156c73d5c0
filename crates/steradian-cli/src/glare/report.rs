//! What is printed of a view.

use std::path::Path;

use serde_json::{Value, json};
use steradian::estimation::Estimate;
use steradian::geometry::Direction;
use steradian::glare::{Figure, FoundSource};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::significant;

use super::Found;
use super::scene::Lights;

/// Name and version of the format.
const SCHEMA: &str = "steradian.glare/1";
const DIGITS: i32 = 4;
/// What DGP is called, from its upper end on. Source: J. Wienold, *Dynamic daylight glare evaluation* (2009).
const CLASSES: [(f64, &str); 3] = [
    (0.35, "imperceptible"),
    (0.40, "perceptible"),
    (0.45, "disturbing"),
];

impl Found {
    /// DGP, reduced if that was asked for.
    fn probability(&self) -> Figure {
        let figure = self.assessment.daylight_glare_probability;
        let factor = self.low_light.unwrap_or(1.0);
        Figure {
            value: factor * figure.value,
            std_error: factor * figure.std_error,
        }
    }
}

fn class(probability: f64) -> &'static str {
    let found = CLASSES.iter().find(|(end, _)| probability < *end);
    found.map_or("intolerable", |(_, name)| name)
}

/// For people.
pub fn table(path: &Path, found: &Found) -> String {
    let all = &found.assessment;
    let [width, height] = found.camera.resolution;
    let mut heading = Columns::new([
        path.display().to_string(),
        format!("{width} x {height}, {}", found.camera.projection().name()),
    ]);
    let number = |value: f64| significant(value, DIGITS);
    let with_error = |figure: Figure, unit: &str| {
        let error = match found.has_errors {
            true => format!(" ± {}", significant(figure.std_error, 2)),
            false => String::new(),
        };
        format!("{}{error} {unit}", number(figure.value))
            .trim_end()
            .to_owned()
    };
    let mut row = |name: &str, value: String| heading.row([name, &value]);
    row("illuminance at the eye", with_error(all.illuminance, "lx"));
    row("mean luminance", with_error(all.mean_luminance, "cd/m2"));
    row("background", with_error(all.background, "cd/m2"));
    let probability = found.probability();
    let text = with_error(probability, "");
    row(
        "daylight glare probability",
        format!("{text} ({})", class(probability.value)),
    );
    let none = || "none: no source, or no background".to_owned();
    let rating = all
        .unified_glare_rating
        .map(|rating| with_error(rating, ""));
    row("unified glare rating", rating.unwrap_or_else(none));
    let index = all.daylight_glare_index.map(number);
    row("daylight glare index", index.unwrap_or_else(none));
    row(
        "sources are brighter than",
        format!("{} cd/m2", number(all.threshold)),
    );
    let errors = match found.has_errors {
        true => "± is one standard error: sampling error of the picture only\n",
        false => "no error layer: nothing is known of the picture's errors\n",
    };
    let lights = found.lights.as_ref().map(lights).unwrap_or_default();
    format!("{heading}\n{}{lights}{errors}", sources(&all.sources))
}

/// For people: what is known without a picture.
pub fn lights_table(found: &Lights) -> String {
    lights(found).trim_end().to_owned() + "\n"
}

/// For programs: what is known without a picture.
pub fn lights_json(path: &Path, found: &Lights) -> Value {
    json!({
        "schema": SCHEMA,
        "version": env!("CARGO_PKG_VERSION"),
        "scene": path.display().to_string(),
        "lights": of_lights(found),
    })
}

/// UGR of the lights of a scene, and which they are.
fn lights(lights: &Lights) -> String {
    let with_error = |estimate: &Estimate| {
        let interval = estimate
            .interval
            .map(|ends| ends.map(|end| significant(end, DIGITS)));
        let interval = interval.map_or(String::new(), |[low, high]| {
            format!(" (95 %: {low} to {high})")
        });
        format!("{}{interval}", significant(estimate.value, DIGITS))
    };
    let rating = lights.rating.as_ref().map(with_error);
    let mut text = format!(
        "unified glare rating of the lights: {}, illuminance at the eye {} lx\n",
        rating.unwrap_or_else(|| "none".to_owned()),
        with_error(&lights.illuminance)
    );
    let mut columns = Columns::new([
        "light",
        "left (deg)",
        "up (deg)",
        "luminance (cd/m2)",
        "solid angle (sr)",
        "position index",
        "illuminance (lx)",
    ]);
    for column in 1..7 {
        columns = columns.right_aligned(column);
    }
    for light in &lights.seen.lights {
        let [left, up] = lights.angles(light.direction);
        let number = |value: f64| significant(value, DIGITS);
        let source = light.source.map_or(["-"; 3].map(str::to_owned), |source| {
            [
                source.luminance.to_candelas_per_square_metre(),
                source.solid_angle.to_steradians(),
                source.position_index,
            ]
            .map(number)
        });
        let illuminance = number(light.illuminance.to_lux());
        let angles = [left, up].map(number);
        columns.row(
            std::iter::once(light.name.clone())
                .chain(angles)
                .chain(source)
                .chain([illuminance]),
        );
    }
    if !lights.seen.lights.is_empty() {
        text.push_str(&columns.to_string());
    }
    for name in &lights.seen.without_extent {
        text.push_str(&format!(
            "not rated, for a point has no luminance: {name}\n"
        ));
    }
    text.push('\n');
    text
}

fn sources(sources: &[FoundSource]) -> String {
    if sources.is_empty() {
        return String::new();
    }
    let headings = [
        "source",
        "left (deg)",
        "up (deg)",
        "luminance (cd/m2)",
        "greatest",
        "solid angle (sr)",
        "position index",
        "illuminance (lx)",
    ];
    let mut columns = Columns::new(headings);
    for column in 0..headings.len() {
        columns = columns.right_aligned(column);
    }
    for (index, found) in sources.iter().enumerate() {
        let [left, up] = angles(found.direction);
        let numbers = [
            left,
            up,
            found.source.luminance.to_candelas_per_square_metre(),
            found.greatest.to_candelas_per_square_metre(),
            found.source.solid_angle.to_steradians(),
            found.source.position_index,
            found.illuminance.to_lux(),
        ];
        let numbers = numbers.map(|value| significant(value, DIGITS));
        columns.row(std::iter::once((index + 1).to_string()).chain(numbers));
    }
    format!("{columns}\n")
}

/// To the left and up in degrees, in a frame that looks along x.
fn angles(direction: Direction) -> [f64; 2] {
    let [ahead, left, up] = direction.to_array();
    [libm::atan2(left, ahead), libm::asin(up)].map(f64::to_degrees)
}

/// For programs.
pub fn json(path: &Path, found: &Found) -> Value {
    let all = &found.assessment;
    let figure = |figure: Figure, unit: &str| {
        let std_error = found.has_errors.then_some(figure.std_error);
        json!({ "value": figure.value, "unit": unit, "std_error": std_error, "method": "estimate" })
    };
    let sources = all.sources.iter().map(source);
    let index = all.daylight_glare_index;
    json!({
        "schema": SCHEMA,
        "version": env!("CARGO_PKG_VERSION"),
        "picture": path.display().to_string(),
        "resolution": found.camera.resolution,
        "projection": found.camera.projection().name(),
        "error_layer": found.has_errors,
        "illuminance": figure(all.illuminance, "lx"),
        "mean_luminance": figure(all.mean_luminance, "cd/m2"),
        "background": figure(all.background, "cd/m2"),
        "daylight_glare_probability": figure(found.probability(), "1"),
        "low_light_factor": found.low_light,
        "unified_glare_rating": all.unified_glare_rating.map(|rating| figure(rating, "1")),
        "daylight_glare_index": index.map(|value| json!({ "value": value, "unit": "1" })),
        "threshold": { "value": all.threshold, "unit": "cd/m2" },
        "sources": sources.collect::<Vec<_>>(),
        "lights": found.lights.as_ref().map(of_lights),
    })
}

fn of_lights(lights: &Lights) -> Value {
    let estimate = |estimate: &Estimate, unit: &str| {
        json!({
            "value": estimate.value,
            "unit": unit,
            "std_error": estimate.std_error,
            "confidence_interval": estimate.interval,
            "method": estimate.method,
        })
    };
    let seen = lights.seen.lights.iter().map(|light| {
        let [left, up] = lights.angles(light.direction);
        let source = light.source;
        json!({
            "name": light.name,
            "left": { "value": left, "unit": "deg" },
            "up": { "value": up, "unit": "deg" },
            "luminance": source.map(|source| json!({ "value": source.luminance.to_candelas_per_square_metre(), "unit": "cd/m2" })),
            "solid_angle": source.map(|source| json!({ "value": source.solid_angle.to_steradians(), "unit": "sr" })),
            "position_index": source.map(|source| source.position_index),
            "illuminance": { "value": light.illuminance.to_lux(), "unit": "lx" },
        })
    });
    json!({
        "unified_glare_rating": lights.rating.as_ref().map(|rating| estimate(rating, "1")),
        "illuminance": estimate(&lights.illuminance, "lx"),
        "seen": seen.collect::<Vec<_>>(),
        "not_rated": lights.seen.without_extent,
    })
}

fn source(found: &FoundSource) -> Value {
    let quantity = |value: f64, unit: &str| json!({ "value": value, "unit": unit });
    let [left, up] = angles(found.direction);
    json!({
        "left": quantity(left, "deg"),
        "up": quantity(up, "deg"),
        "luminance": quantity(found.source.luminance.to_candelas_per_square_metre(), "cd/m2"),
        "greatest_luminance": quantity(found.greatest.to_candelas_per_square_metre(), "cd/m2"),
        "solid_angle": quantity(found.source.solid_angle.to_steradians(), "sr"),
        "position_index": quantity(found.source.position_index, "1"),
        "illuminance": quantity(found.illuminance.to_lux(), "lx"),
        "pixels": found.pixels.len(),
    })
}
