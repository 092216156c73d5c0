//! `steradian brdf eval`: ρ for two directions.

use clap::Args;
use serde_json::json;
use steradian::brdf::Scatter;
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::significant;

use super::direction::{Incident, Viewer};
use super::model::{Model, ModelArguments};
use super::number::{self, Source};
use crate::output::{self, Format};
use crate::status::{Failure, Outcome, remark};

/// ρ(d_e, d_i) in 1/sr for two directions, and the density of its sampling
///
/// The value holds no cosine: radiance towards the viewer is ρ times the irradiance that the light gives on the surface. Of colours,
/// `value` is the luminance-weighted mean of red, green and blue (.2126, .7152, .0722). `density` is how likely d_i is to be drawn for
/// d_e, in 1/sr. A smooth mirror, glass or pane sends light in single directions and has the value 0: see `brdf albedo`.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    incident: Incident,
    #[command(flatten)]
    viewer: Viewer,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian brdf eval lambertian --set reflectance=0.5 --theta-i 30deg
  steradian brdf eval rough-conductor --set metal=gold --set alpha=0.2 --theta-i 45deg --theta-o 45deg
  steradian brdf eval oren-nayar --set reflectance=0.8 --set sigma=20deg --theta-i 60deg --phi-o 0deg
  steradian brdf eval rough-dielectric --set ior=1.5 --set alpha=0.1 --theta-o 150deg --wavelength 550nm --format json";

/// Prints the value.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let model = arguments.model.read()?;
    let (wo, wi) = (arguments.viewer.direction(), arguments.incident.direction());
    let value = model.brdf.evaluate(wo, wi);
    let density = model.brdf.pdf(wo, wi);
    if is_smooth(&model, arguments) {
        remark(
            "this surface is smooth: it couples single directions and has no value in 1/sr; `steradian brdf albedo` gives its shares",
        );
    }
    let unit = "1/sr";
    output::print(&match arguments.format {
        Format::Json => {
            let mut object = number::json_value(&model, value, unit, Source::ClosedForm);
            object["density"] = json!({ "value": density, "unit": unit });
            object["model"] = json!(model.title);
            format!("{object:#}\n")
        }
        Format::Table => {
            let mut headings = number::headings(&model, "ρ (1/sr)");
            headings.push("density (1/sr)".to_owned());
            let mut columns = Columns::new(headings);
            let mut cells = number::cells(&model, value);
            cells.push(significant(density, 7));
            columns.row(cells);
            columns.to_string()
        }
    })?;
    Ok(Outcome::Fine)
}

fn is_smooth(model: &Model, arguments: &Arguments) -> bool {
    let sampled = model.brdf.sample(arguments.viewer.direction(), [0.5, 0.5]);
    matches!(sampled, Some(Scatter::Specular { .. }))
}
