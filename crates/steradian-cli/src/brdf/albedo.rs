//! `steradian brdf albedo`: shares of the light that are reflected and transmitted.

use clap::Args;
use serde_json::{Value, json};
use steradian::brdf::check::{albedo_error, hemispherical};
use steradian::geometry::{Direction, Spherical};
use steradian::quantity::{Angle, Spectrum};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::significant;

use super::direction::Incident;
use super::model::{Model, ModelArguments};
use super::number::{self, Source};
use crate::output::{self, Format};
use crate::status::{Failure, Outcome};
use crate::values;

/// Steps of a sweep unless asked for.
const STEPS: u32 = 18;

/// Shares of the light that are reflected and transmitted, at an angle, over angles, or of light from everywhere
///
/// The reflectance is the directional-hemispherical one, the albedo ∫ ρ cosθ dω; the transmittance is a share of power too. What is
/// missing to 1 is absorbed (or lost, by a model of single scattering). Closed forms are rounded to single precision; rough surfaces
/// need a quadrature, whose error is stated.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    incident: Incident,
    /// A table over the angle of incidence
    #[arg(long, value_name = "FROM:TO", value_parser = values::angles, conflicts_with_all = ["theta_i", "hemispherical"])]
    sweep: Option<[Angle; 2]>,
    /// Of light that comes evenly from all of one side (bihemispherical): the outside, or the inside if theta-i is beyond 90deg
    #[arg(long)]
    hemispherical: bool,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian brdf albedo rough-conductor --set metal=gold --set alpha=0.3 --theta-i 60deg
  steradian brdf albedo dielectric --set ior=1.5 --sweep 0:90deg
  steradian brdf albedo pane --set ior=1.52 --set transmittance=0.95 --theta-i 45deg --format json
  steradian brdf albedo dielectric --set ior=1.5 --hemispherical";

/// Shares of the light along one direction.
struct Row {
    angle: Option<Angle>,
    reflected: Spectrum,
    transmitted: Spectrum,
}

/// Prints the shares.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let model = arguments.model.read()?;
    let rows = rows(&model, arguments);
    output::print(&match arguments.format {
        Format::Table => table(&model, &rows),
        Format::Json => json(&model, &rows, arguments.sweep.is_some()),
    })?;
    Ok(Outcome::Fine)
}

fn rows(model: &Model, arguments: &Arguments) -> Vec<Row> {
    let brdf = &model.brdf;
    if arguments.hemispherical {
        let below = arguments.incident.direction().z() < 0.0;
        let [reflected, transmitted] = hemispherical(brdf, below);
        return vec![Row {
            angle: None,
            reflected,
            transmitted,
        }];
    }
    let row = |angle: Angle, wi: Direction| Row {
        angle: Some(angle),
        reflected: brdf.albedo(wi),
        transmitted: brdf.transmittance(wi),
    };
    let Some([from, to]) = arguments.sweep else {
        return vec![row(
            arguments.incident.theta_i,
            arguments.incident.direction(),
        )];
    };
    let angle = |step: u32| from + (to - from) * (f64::from(step) / f64::from(STEPS));
    (0..=STEPS)
        .map(angle)
        .map(|angle| {
            row(
                angle,
                Spherical::new(angle, arguments.incident.phi_i).to_direction(),
            )
        })
        .collect()
}

fn source(model: &Model) -> Source {
    albedo_error(&model.brdf).map_or(Source::ClosedForm, Source::Quadrature)
}

fn table(model: &Model, rows: &[Row]) -> String {
    let angle = |row: &Row| match row.angle {
        Some(angle) => significant(angle.to_degrees(), 6),
        None => "all".to_owned(),
    };
    let transmits = rows.iter().any(|row| !row.transmitted.is_zero());
    let mut headings = vec!["θ_i (deg)".to_owned()];
    headings.extend(number::headings(model, "reflectance"));
    if transmits {
        headings.extend(number::headings(model, "transmittance"));
    }
    let mut columns = Columns::new(headings);
    for row in rows {
        let mut cells = vec![angle(row)];
        cells.extend(number::cells(model, row.reflected));
        if transmits {
            cells.extend(number::cells(model, row.transmitted));
        }
        columns.row(cells);
    }
    match source(model) {
        Source::ClosedForm => columns.to_string(),
        Source::Quadrature(error) => {
            format!(
                "{columns}\nBy quadrature: off by at most {}.\n",
                significant(error, 2)
            )
        }
    }
}

fn json(model: &Model, rows: &[Row], is_sweep: bool) -> String {
    let row = |row: &Row| -> Value {
        let mut object = number::json_value(model, row.reflected, "1", source(model));
        object["quantity"] = json!("reflectance");
        object["transmittance"] = number::json_value(model, row.transmitted, "1", source(model));
        object["theta_i"] = match row.angle {
            Some(angle) => json!({ "value": angle.to_radians(), "unit": "rad" }),
            None => json!("hemispherical"),
        };
        object["model"] = json!(model.title);
        object
    };
    let object = match rows {
        [one] if !is_sweep => row(one),
        rows => json!({ "rows": rows.iter().map(row).collect::<Vec<_>>() }),
    };
    format!("{object:#}\n")
}
