//! `steradian brdf fresnel`: Fresnel's equations for one smooth interface.

use clap::Args;
use serde_json::{Map, Value, json};
use steradian::brdf::fresnel::{
    conductor, conductor_average, dielectric, dielectric_amplitudes, dielectric_average,
    refracted_cosine, schlick,
};
use steradian::quantity::Angle;
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::exact;

use crate::output::{self, Format};
use crate::status::{Failure, Outcome};

/// Fresnel's equations for one smooth interface: both polarisations, angles of refraction, Brewster and total reflection
///
/// The index is that of the far side over that of the near side, where the light comes from: 1.5 into glass, .6667 out of it. With
/// --k the far side is a metal. Everything is a closed form in double precision; the hemispherical mean of a metal is a quadrature
/// good to ten digits.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Index of refraction of the far side over that of the near side
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true, value_parser = index, required_unless_present = "schlick")]
    ior: Option<f64>,
    /// Index of extinction of a metal
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true, value_parser = extinction)]
    k: Option<f64>,
    /// Instead of Fresnel's equations Schlick's approximation of them, from this reflectance at normal incidence
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true, value_parser = share, conflicts_with_all = ["ior", "k"])]
    schlick: Option<f64>,
    /// Angle to the normal on the near side, with its unit
    #[arg(long, value_name = "ANGLE", default_value = "0 deg", allow_negative_numbers = true, value_parser = incident)]
    theta_i: Angle,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian brdf fresnel --ior 1.5 --theta-i 56.31deg
  steradian brdf fresnel --ior 0.6667 --theta-i 60deg
  steradian brdf fresnel --ior 0.155 --k 3.6 --theta-i 70deg
  steradian brdf fresnel --schlick 0.04 --theta-i 85deg";

/// A name for tables, a key, a number and its unit.
struct Line {
    name: &'static str,
    key: &'static str,
    value: f64,
    unit: &'static str,
}

const fn line(name: &'static str, key: &'static str, value: f64, unit: &'static str) -> Line {
    Line {
        name,
        key,
        value,
        unit,
    }
}

/// Prints the numbers of the interface.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let cos = arguments.theta_i.cos().max(0.0);
    let lines = match (arguments.schlick, arguments.ior, arguments.k) {
        (Some(normal), ..) => vec![line("R (Schlick)", "value", schlick(cos, normal), "1")],
        (None, Some(ior), Some(k)) if k > 0.0 => of_metal(cos, ior, k),
        (None, Some(ior), _) => of_dielectric(cos, arguments.theta_i, ior),
        (None, None, _) => return Err(Failure::message("give --ior or --schlick")),
    };
    output::print(&match arguments.format {
        Format::Table => table(&lines),
        Format::Json => json(&lines),
    })?;
    Ok(Outcome::Fine)
}

fn of_metal(cos: f64, eta: f64, k: f64) -> Vec<Line> {
    let reflected = conductor(cos, eta, k);
    vec![
        line("R (unpolarised)", "value", reflected.mean(), "1"),
        line("R_s", "r_s", reflected.s, "1"),
        line("R_p", "r_p", reflected.p, "1"),
        line(
            "hemispherical R",
            "hemispherical",
            conductor_average(eta, k),
            "1",
        ),
    ]
}

fn of_dielectric(cos: f64, theta: Angle, eta: f64) -> Vec<Line> {
    let reflected = dielectric(cos, eta);
    let mut lines = vec![
        line("R (unpolarised)", "value", reflected.mean(), "1"),
        line(
            "T (unpolarised)",
            "transmittance",
            1.0 - reflected.mean(),
            "1",
        ),
        line("R_s", "r_s", reflected.s, "1"),
        line("R_p", "r_p", reflected.p, "1"),
    ];
    if let Some((s, p)) = dielectric_amplitudes(cos, eta) {
        lines.push(line("amplitude r_s", "amplitude_s", s, "1"));
        lines.push(line("amplitude r_p", "amplitude_p", p, "1"));
    }
    if refracted_cosine(cos, eta).is_some() {
        let refracted = libm::asin((theta.sin() / eta).clamp(-1.0, 1.0));
        lines.push(line(
            "angle of refraction",
            "theta_t",
            refracted.to_degrees(),
            "deg",
        ));
    }
    lines.push(line("L_t/(T L_i)", "radiance_scale", eta * eta, "1"));
    lines.push(line(
        "Brewster's angle",
        "brewster",
        libm::atan(eta).to_degrees(),
        "deg",
    ));
    let smaller = eta.min(1.0 / eta);
    lines.push(line(
        "critical angle in the denser side",
        "critical_angle",
        libm::asin(smaller).to_degrees(),
        "deg",
    ));
    lines.push(line(
        "hemispherical R",
        "hemispherical",
        dielectric_average(eta),
        "1",
    ));
    lines
}

fn table(lines: &[Line]) -> String {
    let mut columns = Columns::new(["quantity", "value", "unit"]);
    for line in lines {
        columns.row([
            line.name.to_owned(),
            exact(line.value),
            line.unit.to_owned(),
        ]);
    }
    columns.to_string()
}

fn json(lines: &[Line]) -> String {
    let number = |line: &Line| json!({ "value": line.value, "unit": line.unit, "std_error": 0.0, "method": "closed-form" });
    let mut object = Map::new();
    for line in lines {
        match (line.key, number(line)) {
            ("value", Value::Object(own)) => object.extend(own),
            (key, other) => {
                object.insert(key.to_owned(), other);
            }
        }
    }
    format!("{:#}\n", Value::Object(object))
}

fn number(text: &str, range: [f64; 2], expected: &str) -> Result<f64, String> {
    let found = text.parse::<f64>().ok();
    found
        .filter(|number| (range[0]..=range[1]).contains(number))
        .ok_or_else(|| format!("expected {expected}"))
}

fn index(text: &str) -> Result<f64, String> {
    number(
        text,
        [1e-3, 1e3],
        "an index of refraction between 0.001 and 1000",
    )
}

fn extinction(text: &str) -> Result<f64, String> {
    number(
        text,
        [0.0, 1e3],
        "an index of extinction between 0 and 1000",
    )
}

fn share(text: &str) -> Result<f64, String> {
    number(text, [0.0, 1.0], "a reflectance between 0 and 1")
}

fn incident(text: &str) -> Result<Angle, String> {
    let angle = text.parse::<Angle>().map_err(|error| error.to_string())?;
    let right = Angle::QUARTER_TURN.to_radians();
    if (0.0..=right).contains(&angle.to_radians()) {
        return Ok(angle);
    }
    Err("expected an angle between 0 and 90 deg".to_owned())
}
