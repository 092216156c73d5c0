//! `steradian brdf reflect`: the reflection integral three times over.

use std::path::Path;

use clap::Args;
use serde_json::{Value, json};
use steradian::brdf::Scatter;
use steradian::geometry::Direction;
use steradian::quantity::{Angle, Radiance};
use steradian::transport::reflection::{by_monte_carlo, by_quadrature, by_sum};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{significant, with_half_width};

use super::direction::Viewer;
use super::incoming::{FarLight, Incoming, Lanes};
use super::model::{Model, ModelArguments};
use super::number;
use crate::output::{self, Format};
use crate::status::{Failure, Outcome, remark};
use crate::values;

const REPLICATES: u32 = 16;
const UNIT: &str = "W/(m2 sr)";

/// The radiance that a surface reflects: the reflection integral by a sum, by quadrature and by Monte Carlo side by side
///
/// L(d_e) = ∫ ρ(d_e, d_i) L(p, −d_i) |cosθ_i| dω_i over the whole sphere; from below comes what the surface transmits.
///
///   sum          Σ ρ E_n cosθ over lights without extent: exact for `lights`; else over patches of equal solid angle
///   quadrature   the midpoint rule over cells in θ and φ
///   monte carlo  the mean of ρ L cosθ/pdf over directions drawn from the model, with its standard error
///
/// The error of the sum and of the quadrature is the change from half as many cells along each axis. Under constant radiance the exact answer is albedo · L
/// (for interfaces + transmittance (n_e/n_i)² L). Quadrature and Monte Carlo need lights of some extent: caps of --half-angle.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    viewer: Viewer,
    /// What arrives: `constant`, `lights`, or a picture by latitude and longitude (.exr, .hdr) in W/(m² sr), the normal up
    #[arg(long, value_name = "constant|lights|FILE", default_value = "constant")]
    incoming: String,
    /// Of `constant`
    #[arg(long, value_name = "RADIANCE", default_value = "1 W/(m2 sr)")]
    radiance: Radiance,
    /// One of `lights`: its angles and the irradiance on a plane that faces it. Repeat for more
    #[arg(long = "light", value_name = "THETA,PHI,IRRADIANCE", value_parser = FarLight::parse)]
    lights: Vec<FarLight>,
    /// Of the caps that lights are for quadrature and Monte Carlo
    #[arg(long, value_name = "ANGLE", default_value = "5 deg")]
    half_angle: Angle,
    /// Cells of the quadrature from the normal to the horizon
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(2..=2000), default_value_t = 180)]
    cells: u32,
    /// Samples of Monte Carlo
    #[arg(long, value_name = "NUMBER", value_parser = values::count, default_value = "65536")]
    samples: u64,
    /// Seed of Monte Carlo
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    seed: u64,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian brdf reflect lambertian --set reflectance=0.5 --radiance \"2 W/(m2 sr)\"
  steradian brdf reflect rough-conductor --set metal=gold --set alpha=0.3 --theta-o 60deg
  steradian brdf reflect oren-nayar --set reflectance=0.8 --set sigma=20deg --incoming lights --light \"45deg,0deg,100 W/m2\"";

/// An estimate of the integral, with what it may be off by.
struct Row {
    name: &'static str,
    value: Lanes,
    error: Option<Lanes>,
}

/// Prints the estimates.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let model = arguments.model.read()?;
    let incoming = incoming(arguments)?;
    let wo = arguments.viewer.direction();
    if matches!(
        model.brdf.sample(wo, [0.5, 0.5]),
        Some(Scatter::Specular { .. })
    ) {
        remark(
            "this surface couples single directions too, which only Monte Carlo and the exact answer see",
        );
    }
    let rows = rows(&model, &incoming, wo, arguments)?;
    output::print(&match arguments.format {
        Format::Table => table(&model, &rows),
        Format::Json => json(&model, &rows),
    })?;
    Ok(Outcome::Fine)
}

fn incoming(arguments: &Arguments) -> Result<Incoming, Failure> {
    match arguments.incoming.as_str() {
        "constant" => Ok(Incoming::Constant(
            arguments.radiance.to_watts_per_square_metre_steradian(),
        )),
        "lights" if arguments.lights.is_empty() => Err(Failure::message(
            "--incoming lights needs lights: --light \"45deg,0deg,100 W/m2\"",
        )),
        "lights" => Ok(Incoming::Lights(
            arguments.lights.clone(),
            arguments.half_angle,
        )),
        file => Incoming::picture(Path::new(file)),
    }
}

fn rows(
    model: &Model,
    incoming: &Incoming,
    wo: Direction,
    arguments: &Arguments,
) -> Result<Vec<Row>, Failure> {
    let brdf = &model.brdf;
    let n = arguments.cells;
    let sum = |n: u32| by_sum(brdf, wo, &incoming.samples(16 * n * n));
    let quadrature = |n: u32| by_quadrature(brdf, wo, |wi| incoming.radiance(wi), n);
    let each = u32::try_from(arguments.samples.div_ceil(u64::from(REPLICATES)))
        .map_err(|_| Failure::message("so many samples cannot be drawn"))?;
    let (mean, std_error) = by_monte_carlo(
        brdf,
        wo,
        |wi| incoming.radiance(wi),
        arguments.seed,
        REPLICATES,
        each,
    );
    let is_exact = matches!(incoming, Incoming::Lights(..));
    let summed = sum(n);
    let mut rows = vec![
        Row {
            name: "sum",
            value: summed,
            error: (!is_exact).then(|| change(summed, sum(n / 2))),
        },
        difference_row("quadrature", quadrature(n), quadrature(n / 2)),
        Row {
            name: "monte carlo",
            value: mean,
            error: Some(std_error),
        },
    ];
    if let Incoming::Constant(radiance) = incoming {
        rows.push(exact(model, wo, *radiance));
    }
    Ok(rows)
}

fn difference_row(name: &'static str, fine: Lanes, coarse: Lanes) -> Row {
    Row {
        name,
        value: fine,
        error: Some(change(fine, coarse)),
    }
}

fn change(fine: Lanes, coarse: Lanes) -> Lanes {
    std::array::from_fn(|lane| (fine[lane] - coarse[lane]).abs())
}

/// (albedo + transmittance (n_e/n_i)²) L.
fn exact(model: &Model, wo: Direction, radiance: f64) -> Row {
    let reflected = number::lanes(model.brdf.albedo(wo));
    let transmitted = number::lanes(model.brdf.transmittance(wo));
    let scale = model.brdf.radiance_scale(wo, -wo);
    Row {
        name: "exact",
        value: std::array::from_fn(|lane| (reflected[lane] + scale * transmitted[lane]) * radiance),
        error: None,
    }
}

/// The luminance-weighted mean; equal lanes are one number.
fn total(model: &Model, lanes: Lanes) -> f64 {
    let counted = &lanes[..model.lanes.len()];
    if counted.iter().all(|lane| *lane == counted[0]) {
        return counted[0];
    }
    model.total(lanes)
}

fn exact_total(model: &Model, rows: &[Row]) -> Option<f64> {
    let exact = rows.iter().find(|row| row.name == "exact");
    exact
        .map(|row| total(model, row.value))
        .filter(|value| *value > 0.0)
}

fn table(model: &Model, rows: &[Row]) -> String {
    let exact = exact_total(model, rows);
    let mut headings = vec!["by".to_owned(), format!("L ({UNIT})")];
    headings.extend(exact.map(|_| "off by".to_owned()));
    headings.extend(
        model
            .lanes
            .iter()
            .filter(|_| model.lanes.len() > 1)
            .cloned(),
    );
    let mut columns = Columns::new(headings);
    for row in rows {
        let number = |value: f64, error: Option<f64>| match error {
            Some(error) if error > 0.0 => with_half_width(value, error),
            _ => significant(value, 8),
        };
        let value = total(model, row.value);
        let mut cells = vec![
            row.name.to_owned(),
            number(value, row.error.map(|error| total(model, error))),
        ];
        cells.extend(exact.map(|exact| match row.name {
            "exact" => String::new(),
            _ => format!("{} %", significant(100.0 * (value / exact - 1.0), 2)),
        }));
        let lanes = (0..model.lanes.len()).filter(|_| model.lanes.len() > 1);
        cells.extend(lanes.map(|lane| number(row.value[lane], row.error.map(|error| error[lane]))));
        columns.row(cells);
    }
    format!(
        "{columns}\n± is the standard error of Monte Carlo, and elsewhere the change from half as many cells along each axis.\n"
    )
}

fn json(model: &Model, rows: &[Row]) -> String {
    let exact = exact_total(model, rows);
    let row = |row: &Row| -> Value {
        let value = total(model, row.value);
        let error = row.error.map(|error| total(model, error));
        let channels: serde_json::Map<String, Value> = model
            .lanes
            .iter()
            .zip(row.value)
            .map(|(name, value)| (name.clone(), json!(value)))
            .collect();
        let mut object = json!({
            "value": value,
            "unit": UNIT,
            "std_error": if row.name == "monte carlo" { error } else { Some(0.0) },
            "method": if row.error.is_some() { "estimate" } else { "closed-form" },
            "channels": channels,
        });
        if row.name != "monte carlo"
            && let Some(error) = error
        {
            object["change_from_half_the_cells"] = json!(error);
        }
        if let Some(exact) = exact {
            object["off_by"] = json!(value / exact - 1.0);
        }
        object
    };
    let mut object = serde_json::Map::new();
    object.insert("model".to_owned(), json!(model.title));
    for found in rows {
        object.insert(found.name.replace(' ', "_"), row(found));
    }
    format!("{:#}\n", Value::Object(object))
}
