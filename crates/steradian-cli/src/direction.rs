//! `steradian direction`: spherical coordinates to a unit vector and back.

use clap::Args;
use serde_json::json;
use steradian::geometry::{Direction, Spherical, Vector};
use steradian::quantity::Angle;
use steradian_io::report::numbers::exact;

use crate::output::{self, Format};
use crate::status::{Failure, Outcome};
use crate::values;

/// Convert a direction between angles and a vector
///
/// θ is the angle from the Z axis and φ the azimuth, from X towards Y:
/// d = (sinθ cosφ, sinθ sinφ, cosθ). At the poles φ is undefined and printed as 0.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Angle θ from the Z axis, with its unit (deg, rad …)
    #[arg(
        long,
        value_name = "ANGLE",
        required_unless_present = "vector",
        conflicts_with = "vector",
        allow_hyphen_values = true
    )]
    theta: Option<Angle>,
    /// Azimuth φ from X towards Y, with its unit (deg, rad …)
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 deg",
        conflicts_with = "vector",
        allow_hyphen_values = true
    )]
    phi: Angle,
    /// A vector of any length
    #[arg(long, value_name = "X,Y,Z", value_parser = values::vector, allow_hyphen_values = true)]
    vector: Option<[f64; 3]>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian direction --theta 30deg --phi 45deg
  steradian direction --vector 1,1,0
  steradian direction --vector 0,0,-2 --format json";

/// Prints both forms of the direction.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let direction = match (arguments.vector, arguments.theta) {
        (Some([x, y, z]), _) => {
            Direction::new(Vector::new(x, y, z)).map_err(|error| Failure::Other(error.into()))?
        }
        (None, Some(theta)) => Spherical::new(theta, arguments.phi).to_direction(),
        (None, None) => return Err(Failure::message("give --theta and --phi, or --vector")),
    };
    output::print(&match arguments.format {
        Format::Table => table(direction),
        Format::Json => json(direction),
    })?;
    Ok(Outcome::Fine)
}

fn table(direction: Direction) -> String {
    let Spherical { theta, phi } = Spherical::from_direction(direction);
    let line = |name: &str, angle: Angle| {
        format!(
            "{name}  {} deg = {} rad\n",
            exact(angle.to_degrees()),
            exact(angle.to_radians())
        )
    };
    let vector = direction.to_array().map(exact).join(", ");
    format!("{}{}d  ({vector})\n", line("θ", theta), line("φ", phi))
}

fn json(direction: Direction) -> String {
    let Spherical { theta, phi } = Spherical::from_direction(direction);
    let object = json!({
        "theta": { "value": theta.to_radians(), "unit": "rad" },
        "phi": { "value": phi.to_radians(), "unit": "rad" },
        "vector": direction.to_array(),
    });
    format!("{object:#}\n")
}
