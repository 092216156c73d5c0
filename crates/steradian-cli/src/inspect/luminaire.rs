//! What a luminaire's file holds: header, flux by exact integration, beams, the CIE flux code, and UGR table, what is wrong.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use serde_json::{Value, json};
use steradian::light::Planes;
use steradian_io::diagnostic::render;
use steradian_io::files::DiskFiles;
use steradian_io::import::photometry::{IntensityUnit, Opening, Photometry, read};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::significant;

use super::{polar, ugr};
use crate::output::{self, Format};
use crate::status::{Failure, Outcome};

/// Name and version of the format.
const SCHEMA: &str = "steradian.inspect-luminaire/1";
/// Digits of what is printed.
const DIGITS: i32 = 5;
/// Parts of the greatest intensity at the edges of a beam and a field.
const SPREADS: [(&str, f64); 2] = [("beam", 0.5), ("field", 0.1)];

/// Prints the figures, and draws the diagram if it is asked for.
pub fn run(
    path: &Path,
    format: Format,
    strict: bool,
    plot: Option<&Path>,
) -> Result<Outcome, Failure> {
    let lamp = read(path, &DiskFiles::default()).map_err(Failure::Input)?;
    if let Some(file) = plot {
        polar::draw(&lamp, path, file)?;
    }
    output::print(&match format {
        Format::Table => table(path, &lamp),
        Format::Json => format!("{:#}\n", as_json(path, &lamp)),
    })?;
    Ok(Outcome::fine_if(lamp.warnings.is_empty() || !strict))
}

/// Names of the units of flux and intensity.
fn units(lamp: &Photometry) -> [&'static str; 2] {
    match lamp.unit {
        IntensityUnit::Candela => ["lm", "cd"],
        IntensityUnit::MilliwattPerSteradian => ["mW", "mW/sr"],
    }
}

fn table(path: &Path, lamp: &Photometry) -> String {
    let mut heading = Columns::new([path.display().to_string(), lamp.format.clone()]);
    for (key, text) in &lamp.keywords {
        heading.row([key, text]);
    }
    let mut figures = Columns::new(["figure", "value"]);
    for (name, value) in figures_of(lamp) {
        figures.row([name, value]);
    }
    let warnings = match lamp.warnings.is_empty() {
        true => String::new(),
        false => render(&lamp.warnings, false),
    };
    let ratings = ugr::table(&ugr::of(lamp));
    let mut sections = vec![heading.to_string(), figures.to_string(), ratings, warnings];
    sections.retain(|section| !section.is_empty());
    sections.join("\n")
}

fn figures_of(lamp: &Photometry) -> Vec<(String, String)> {
    let [flux_unit, unit] = units(lamp);
    let number = |value: f64| significant(value, DIGITS);
    let flux = lamp.far_field.flux();
    let mut figures = vec![("flux".to_owned(), format!("{} {flux_unit}", number(flux)))];
    let mut add = |name: &str, value: String| figures.push((name.to_owned(), value));
    if let Some(rated) = lamp.lamp_flux {
        add(
            "rated flux of the lamps",
            format!("{} {flux_unit}", number(rated)),
        );
        add(
            "light output ratio",
            format!("{} %", number(100.0 * flux / rated)),
        );
    } else {
        add("photometry", "absolute".to_owned());
    }
    if lamp.watts > 0.0 {
        add("power", format!("{} W", number(lamp.watts)));
        let efficacy = flux / lamp.watts;
        add("efficacy", format!("{} {flux_unit}/W", number(efficacy)));
    }
    let [azimuth, polar, peak] = lamp.far_field.peak();
    let [across, down] = names_of_angles(lamp.far_field.planes());
    let place = [azimuth, polar].map(|angle| number(angle.to_degrees()));
    let [azimuth, polar] = place;
    let peak = format!(
        "{} {unit} at {across} {azimuth}°, {down} {polar}°",
        number(peak)
    );
    add("greatest intensity", peak);
    for (name, azimuth) in [("C0-C180", 0.0), ("C90-C270", FRAC_PI_2)] {
        for (what, angle) in spreads(lamp, azimuth) {
            add(
                &format!("{what} angle in {name}"),
                format!("{}°", number(angle.to_degrees())),
            );
        }
    }
    if let Some(code) = flux_code(lamp) {
        let code = code.iter().map(|part| format!("{:.0}", 100.0 * part));
        let code: Vec<_> = code.collect();
        add("CIE flux code", code.join(" "));
    }
    add("opening", opening(&lamp.opening));
    add("symmetry", lamp.symmetry.to_owned());
    if let Some(tilt) = &lamp.tilt {
        let count = tilt.factors.len();
        add(
            "factors of tilt",
            format!("{count}, lamp position {}", tilt.geometry),
        );
    }
    for set in &lamp.other_sets {
        let text = format!(
            "{} {flux_unit}, {} W {}",
            number(set.flux),
            number(set.watts),
            set.kind
        );
        add("other lamps", text);
    }
    figures
}

/// What the azimuth and the polar angle are called.
fn names_of_angles(planes: Planes) -> [&'static str; 2] {
    match planes {
        Planes::C => ["C", "γ"],
        Planes::B => ["V", "from H 90°"],
        Planes::A => ["X", "from Y 90°"],
    }
}

/// Beam and field angle of a plane; none of floodlights, whose planes do not hold the nadir's.
fn spreads(lamp: &Photometry, azimuth: f64) -> Vec<(&'static str, f64)> {
    if lamp.far_field.planes() != Planes::C {
        return vec![];
    }
    let angle = |(name, part)| Some((name, lamp.far_field.spread(azimuth, part)?));
    SPREADS.into_iter().filter_map(angle).collect()
}

/// N₁ … N₄, and N₅ where lamps are rated.
fn flux_code(lamp: &Photometry) -> Option<Vec<f64>> {
    if lamp.far_field.planes() != Planes::C {
        return None;
    }
    let code = lamp.far_field.flux_code()?;
    let output = lamp.lamp_flux.map(|rated| lamp.far_field.flux() / rated);
    Some(code.into_iter().chain(output).collect())
}

fn opening(opening: &Opening) -> String {
    let millimetres = |metres: f64| significant(1000.0 * metres, 4);
    let three = |a: f64, b: f64, c: f64| [a, b, c].map(millimetres).join(" × ");
    match *opening {
        Opening::Point => "point".into(),
        Opening::Box {
            width,
            length,
            height,
        } => format!(
            "box, {} mm along C90, C0 and up",
            three(width, length, height)
        ),
        Opening::Upright {
            width,
            length,
            height,
        } => format!(
            "round, {} mm along C90, C0 and up",
            three(width, length, height)
        ),
        Opening::Lying {
            along_c0,
            length,
            diameter,
        } => {
            let axis = if along_c0 { "C0" } else { "C90" };
            let [length, diameter] = [length, diameter].map(millimetres);
            format!("cylinder along {axis}, {length} mm long, {diameter} mm thick")
        }
        Opening::Ellipsoid {
            diameters: [width, length, height],
        } => format!(
            "ellipsoid, {} mm along C90, C0 and up",
            three(width, length, height)
        ),
    }
}

fn as_json(path: &Path, lamp: &Photometry) -> Value {
    let [flux_unit, unit] = units(lamp);
    let keywords = lamp.keywords.iter();
    let keywords = keywords.map(|(key, text)| json!({ "name": key, "value": text }));
    let degrees = |azimuth: f64| -> Value {
        let angles = spreads(lamp, azimuth).into_iter();
        angles
            .map(|(name, angle)| (name.to_owned(), exact(angle.to_degrees(), "deg")))
            .collect()
    };
    let warnings = lamp.warnings.iter().map(|warning| &warning.message);
    json!({
        "schema": SCHEMA,
        "version": env!("CARGO_PKG_VERSION"),
        "file": path.display().to_string(),
        "format": lamp.format,
        "header": keywords.collect::<Vec<_>>(),
        "flux": exact(lamp.far_field.flux(), flux_unit),
        "rated_flux": lamp.lamp_flux.map(|rated| json!({ "value": rated, "unit": flux_unit })),
        "power": { "value": lamp.watts, "unit": "W" },
        "greatest_intensity": exact(lamp.far_field.peak()[2], unit),
        "angles": { "C0-C180": degrees(0.0), "C90-C270": degrees(FRAC_PI_2) },
        "flux_code": flux_code(lamp),
        "opening": opening(&lamp.opening),
        "symmetry": lamp.symmetry,
        "ugr": ugr::as_json(&ugr::of(lamp)),
        "warnings": warnings.collect::<Vec<_>>(),
    })
}

/// A number that nothing was sampled for.
fn exact(value: f64, unit: &str) -> Value {
    json!({ "value": value, "unit": unit, "std_error": 0, "method": "closed-form" })
}
