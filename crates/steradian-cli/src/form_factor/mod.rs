//! `steradian form-factor`: how much of what one surface sends out reaches another.

mod known;
mod pair;
mod report;
mod surfaces;

use clap::{ArgGroup, Args, ValueEnum};
use steradian::geometry::form_factor::Surface;

use crate::output;
use crate::status::{Failure, Outcome};
use report::Factors;
use surfaces::Element;

/// Form factor from one surface to another, or configuration factor from an element to a surface
///
/// F12 is the fraction of the diffuse flux leaving surface 1 that reaches surface 2 when nothing stands between. Polygons are
/// listed counter-clockwise as seen from the front; fronts send and receive. Coordinates are metres.
///
/// Polygon to polygon, sphere to a flat surface, coaxial discs and all factors from an element are closed forms. Other pairs
/// are integrated numerically, and the error of that is printed.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
#[command(group = ArgGroup::new("from").required(true))]
#[command(group = ArgGroup::new("to").conflicts_with("known"))]
pub struct Arguments {
    /// From a surface element: its place and its normal
    #[arg(long, group = "from", value_name = "X,Y,Z,NX,NY,NZ", value_parser = surfaces::element, allow_hyphen_values = true)]
    element: Option<Element>,
    /// From a polygon, by its corners
    #[arg(long, group = "from", value_name = "X,Y,Z X,Y,Z …", value_parser = surfaces::polygon, allow_hyphen_values = true)]
    polygon1: Option<Surface>,
    /// From a disc: its centre, the normal of its front, its radius
    #[arg(long, group = "from", value_name = "CX,CY,CZ,NX,NY,NZ,R", value_parser = surfaces::disc, allow_hyphen_values = true)]
    disc1: Option<Surface>,
    /// From a sphere: its centre and radius
    #[arg(long, group = "from", value_name = "CX,CY,CZ,R", value_parser = surfaces::sphere, allow_hyphen_values = true)]
    sphere1: Option<Surface>,
    /// To a polygon
    #[arg(long, group = "to", value_name = "X,Y,Z X,Y,Z …", value_parser = surfaces::polygon, allow_hyphen_values = true)]
    polygon2: Option<Surface>,
    /// To a disc
    #[arg(long, group = "to", value_name = "CX,CY,CZ,NX,NY,NZ,R", value_parser = surfaces::disc, allow_hyphen_values = true)]
    disc2: Option<Surface>,
    /// To a sphere
    #[arg(long, group = "to", value_name = "CX,CY,CZ,R", value_parser = surfaces::sphere, allow_hyphen_values = true)]
    sphere2: Option<Surface>,
    /// Let both sides of a polygon or disc receive
    #[arg(long, requires = "to")]
    two_sided: bool,
    /// Relative error sought where there is no closed form
    #[arg(long, value_name = "RATIO", value_parser = crate::values::ratio, default_value = "1e-8")]
    rel_error: f64,
    /// A configuration of the catalogues by its name and sizes; `list` prints them all
    #[arg(long, group = "from", value_name = "NAME [KEY=VALUE]", num_args = 1.., conflicts_with_all = ["two_sided", "rel_error"])]
    known: Option<Vec<String>>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  Two unit squares face to face:
  steradian form-factor --polygon1 \"0,0,0 1,0,0 1,1,0 0,1,0\" --polygon2 \"0,0,1 0,1,1 1,1,1 1,0,1\"
  What an element on the ground sees of a sphere:
  steradian form-factor --element 0,0,0,0,0,1 --sphere2 0,0,2,1
  A disc and a tilted one, by quadrature:
  steradian form-factor --disc1 0,0,0,0,0,1,1 --disc2 0,0,2,0,1,-1,0.5
  steradian form-factor --known list
  steradian form-factor --known concentric-cylinders inner=1 outer=2 length=2 --format json";

/// Text, or one JSON object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people
    #[default]
    Table,
    /// For programs
    Json,
}

/// Prints the factors.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if arguments
        .known
        .as_deref()
        .is_some_and(|words| words == ["list"])
    {
        output::print(&known::list())?;
        return Ok(Outcome::Fine);
    }
    let factors = factors(arguments)?;
    output::print(&match arguments.format {
        Format::Table => factors.table(),
        Format::Json => factors.json(),
    })?;
    Ok(Outcome::Fine)
}

fn factors(arguments: &Arguments) -> Result<Factors, Failure> {
    if let Some(words) = &arguments.known {
        return known::factors(words);
    }
    let first = [&arguments.polygon1, &arguments.disc1, &arguments.sphere1];
    let second = [&arguments.polygon2, &arguments.disc2, &arguments.sphere2];
    let to = second.into_iter().flatten().next();
    let from = first.into_iter().flatten().next();
    match (arguments.element, from, to) {
        (Some(element), _, Some(to)) => Ok(pair::from_element(element, to, arguments.two_sided)),
        (None, Some(from), Some(to)) => {
            pair::between(from, to, arguments.two_sided, arguments.rel_error)
        }
        _ => Err(Failure::message(
            "to what surface? Give --polygon2, --disc2 or --sphere2",
        )),
    }
}
