//! `steradian form-factor`: how much of what one surface sends out reaches another.

mod known;
mod pair;
mod report;
mod scene;
mod surfaces;

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use steradian::exchange::Element;
use steradian::geometry::form_factor::Surface;

use crate::output;
use crate::status::{Failure, Outcome};
use report::Factors;
use scene::Format;

/// Form factor from one surface to another, configuration factor from an element, or all form factors of a scene
///
/// F12 is the fraction of the diffuse flux leaving surface 1 that reaches surface 2 when nothing stands between. Polygons are
/// listed counter-clockwise as seen from the front; fronts send and receive. Coordinates are metres.
///
/// Polygon to polygon, sphere to a flat surface, coaxial discs and all factors from an element are closed forms. Other pairs
/// are integrated numerically, and the error of that is printed.
///
/// Of a SCENE the whole matrix is found, with what stands between: each factor in closed form where nothing does, else with rays and a
/// standard error. Fronts take part unless asked otherwise. Below the matrix stand the row whose sum is farthest from 1, as it is in an
/// enclosure, and how well A1 F12 = A2 F21 holds where the two were found separately.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
#[command(group = ArgGroup::new("from"))]
#[command(group = ArgGroup::new("to").conflicts_with("known"))]
pub struct Arguments {
    /// All surfaces of a scene file (TOML), or of a file of another program (glTF, OBJ, PLY, STL)
    #[arg(group = "from", value_name = "SCENE", conflicts_with = "to")]
    scene: Option<PathBuf>,
    /// From a surface element, its place and its normal, to a polygon, disc or sphere, or to all surfaces of a SCENE
    #[arg(long, conflicts_with_all = ["polygon1", "disc1", "sphere1", "known"], value_name = "X,Y,Z,NX,NY,NZ", value_parser = surfaces::element, allow_hyphen_values = true)]
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
    /// Relative error sought where there is no closed form [default: 1e-8]. Of a scene: stop when the 95 % interval of each factor is within
    /// this part of it, where factors below 1 % (or an even share, 1/n, if that is less) need not be known any better than one of
    /// that size [default: 1%, or 65536 rays a row if `auto` chooses rays]
    #[arg(long, value_name = "RATIO", value_parser = crate::values::ratio)]
    rel_error: Option<f64>,
    /// A configuration of the catalogues by its name and sizes; `list` prints them all
    #[arg(long, group = "from", value_name = "NAME [KEY=VALUE]", num_args = 1.., conflicts_with_all = ["two_sided", "rel_error"])]
    known: Option<Vec<String>>,
    /// How to print [default: by the ending of the output's name, else table]; csv and npz are for scenes
    #[arg(long, value_enum)]
    format: Option<Format>,
    #[command(flatten)]
    of_scene: scene::SceneArguments,
}

/// Relative error of quadratures, where no other is asked for.
const DEFAULT_REL_ERROR: f64 = 1e-8;

const EXAMPLES: &str = "\
Examples:
  Two unit squares face to face:
  steradian form-factor --polygon1 \"0,0,0 1,0,0 1,1,0 0,1,0\" --polygon2 \"0,0,1 0,1,1 1,1,1 1,0,1\"
  What an element on the ground sees of a sphere:
  steradian form-factor --element 0,0,0,0,0,1 --sphere2 0,0,2,1
  A disc and a tilted one, by quadrature:
  steradian form-factor --disc1 0,0,0,0,0,1,1 --disc2 0,0,2,0,1,-1,0.5
  steradian form-factor --known list
  steradian form-factor --known concentric-cylinders inner=1 outer=2 length=2 --format json
  All surfaces of a room, with what stands in it:
  steradian form-factor scenes/cornell-box.toml --by object
  steradian form-factor room.obj --rel-error 2% --format csv -o room.csv
  What a point of its floor sees, and the sky over a place in a city:
  steradian form-factor scenes/cornell-box.toml --element 0.3,0.3,0,0,0,1 --by object
  steradian form-factor city.stl --element 10,20,0,0,0,1 --by material
  steradian form-factor city.stl --sky --samples 1e5 --method rays -o city.npz   # for scipy.sparse.load_npz";

/// Prints the factors.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if let Some(path) = &arguments.scene {
        return scene::run(
            path,
            &arguments.of_scene,
            arguments.element,
            arguments.rel_error,
            arguments.format,
        );
    }
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
        None | Some(Format::Table) => factors.table(),
        Some(Format::Json) => factors.json(),
        Some(Format::Csv | Format::Npz) => {
            let message = "csv and npz are formats for the factors of a scene; use table or json";
            return Err(Failure::message(message));
        }
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
            let error = arguments.rel_error.unwrap_or(DEFAULT_REL_ERROR);
            pair::between(from, to, arguments.two_sided, error)
        }
        (None, None, _) => Err(Failure::message(
            "from what surface? Give a SCENE, --element, --polygon1, --disc1, --sphere1 or --known",
        )),
        _ => Err(Failure::message(
            "to what surface? Give --polygon2, --disc2 or --sphere2",
        )),
    }
}
