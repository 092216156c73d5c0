//! `steradian solid-angle`: how much of the view an object fills, in closed form where there is one.

mod drawing;
mod element;
mod mesh;
mod object;
mod object_arguments;
mod outline;
mod projection;
mod sweep;

use std::f64::consts::PI;
use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};
use steradian::estimation::{Estimate, Method, Plan, Stopping};
use steradian::geometry::{Direction, Point};
use steradian::quantity::{Angle, SolidAngle};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{estimate, exact, significant};

use crate::engine::Threads;
use crate::progress::Watch;
use crate::status::{Failure, Outcome};
use crate::{
    output::{self, Format},
    values,
};
use element::Element;
use mesh::Sampling;
use object::Object;
use object_arguments::ObjectArguments;
use sweep::Sweep;

/// Solid angle of an object seen from a point: the area of its projection on the unit sphere
///
/// ω = ∫ cosθ dA / r², in steradians; all directions are 4π sr. All values are closed forms, but for meshes that are open or not convex: these
/// are estimated with rays, with a 95 % interval. Both sides of flat objects count. An
/// observer in the plane of a flat object sees it edge-on, as nothing; one on the surface of a solid has the half of all
/// directions that leads inside.
///
/// Coordinates and lengths are metres; angles need their unit.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Where the observer is
    #[arg(long, value_name = "X,Y,Z", value_parser = values::point, default_value = "0,0,0", allow_hyphen_values = true)]
    from: Point,
    #[command(flatten)]
    object: ObjectArguments,
    /// A small patch of a surface at X,Y,Z with the normal NX,NY,NZ and the area DA in m²: its dA cosθ/r² beside the solid angle of a disc of that area, as the patch grows
    #[arg(long, value_name = "X,Y,Z,NX,NY,NZ,DA", value_parser = Element::parse, allow_hyphen_values = true, group = "what")]
    element: Option<Element>,
    /// Also the projected solid angle Ω = ∫ cosθ dω for a surface element of this normal at the observer; what is below its horizon does not count
    #[arg(long, value_name = "NX,NY,NZ", value_parser = values::direction, allow_hyphen_values = true)]
    projected: Option<Direction>,
    /// A table of the object turned to face the observer and then tilted, from one angle to another: `--sweep tilt 0:90deg`
    #[arg(long, num_args = 2, value_names = ["tilt", "FROM:TO"], conflicts_with_all = ["projected", "element"])]
    sweep: Option<Vec<String>>,
    /// Draw the object's projection on the unit sphere, or the curve of a sweep
    #[arg(long, value_name = "FILE.svg", conflicts_with = "element")]
    plot: Option<PathBuf>,
    /// Where rays are needed: stop when the 95 % interval is within this part of the value
    #[arg(long, value_name = "RATIO", value_parser = values::ratio, default_value = "0.1%")]
    rel_error: f64,
    /// Seed of the rays: the same seed gives the same bits
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    threads: Threads,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian solid-angle --sphere 0,0,2,1
  steradian solid-angle --from 0,0,1 --disc 2,0,0,0,0,1,1 --projected 0,0,-1
  steradian solid-angle --rectangle \"-1,-1,1 1,-1,1 1,1,1 -1,1,1\" --plot window.svg
  steradian solid-angle --patch 0:30deg,0:90deg
  steradian solid-angle --mesh bunny.ply --from 0,0,5 --rel-error 0.01%
  steradian solid-angle --element 0,0,2,0,0,-1,0.01
  steradian solid-angle --disc 0,0,2,0,0,1,0.5 --sweep tilt 0:90deg --plot tilt.svg";

/// Prints the solid angle, or the table asked for.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if let Some(element) = &arguments.element {
        let rows = element.growing(arguments.from)?;
        output::print(&match arguments.format {
            Format::Table => element::table(&rows),
            Format::Json => element::json(&rows),
        })?;
        return Ok(Outcome::Fine);
    }
    let object = arguments.object.read()?;
    match &arguments.sweep {
        Some(words) => swept(&Sweep::parse(words)?, &object, arguments),
        None => measured(&object, arguments),
    }
}

fn swept(sweep: &Sweep, object: &Object, arguments: &Arguments) -> Result<Outcome, Failure> {
    let rows = sweep.rows(object, arguments.from)?;
    if let Some(file) = &arguments.plot {
        let svg = sweep::plot(&rows).map_err(|error| Failure::Other(error.into()))?;
        output::write(svg.as_bytes(), Some(file))?;
    }
    output::print(&match arguments.format {
        Format::Table => sweep::table(&rows),
        Format::Json => sweep::json(&rows),
    })?;
    Ok(Outcome::Fine)
}

fn measured(object: &Object, arguments: &Arguments) -> Result<Outcome, Failure> {
    let observer = arguments.from;
    let plan = Plan {
        seed: arguments.seed,
        stop: Stopping::at_rel_error(arguments.rel_error),
        threads: arguments.threads.count(),
        ..Plan::default()
    };
    let mut sampling = Sampling {
        plan,
        watch: Watch::new()?,
    };
    let solid_angle = object.solid_angle(observer, &mut sampling)?;
    let projected = match arguments.projected {
        Some(normal) => Some(object.projected_solid_angle(observer, normal, &mut sampling)?),
        None => None,
    };
    if sampling.watch.finish() {
        return Err(Failure::message("stopped by Ctrl-C"));
    }
    if let Some(file) = &arguments.plot {
        let svg = drawing::draw(object, observer, in_view(&solid_angle))?;
        output::write(svg.as_bytes(), Some(file))?;
    }
    output::print(&match arguments.format {
        Format::Table => table(&solid_angle, projected.as_ref()),
        Format::Json => json(&solid_angle, projected.as_ref()),
    })?;
    let all = [Some(solid_angle), projected];
    Ok(Outcome::fine_if(
        all.iter().flatten().all(|found| found.converged),
    ))
}

fn table(solid_angle: &Estimate, projected: Option<&Estimate>) -> String {
    let mut columns = Columns::new([
        "solid angle".to_owned(),
        format!("{} sr", number(solid_angle)),
    ]);
    let value = in_view(solid_angle);
    columns.row([
        "of the sphere",
        &format!("{} %", significant(100.0 * fraction(value), 7)),
    ]);
    columns.row(["square degrees", &significant(square_degrees(value), 7)]);
    if let Some(projected) = projected {
        columns.row(["projected", &format!("{} sr", number(projected))]);
        let factor = projected.scaled(1.0 / PI);
        columns.row(["configuration factor", &number(&factor)]);
    }
    if solid_angle.method == Method::ClosedForm {
        return columns.to_string();
    }
    format!("{columns}\nEstimated with rays; ± is half the 95 % interval.\n")
}

/// Without its unit.
fn number(found: &Estimate) -> String {
    match found.method {
        Method::ClosedForm => exact(found.value),
        Method::Estimate => estimate(found),
    }
}

fn json(solid_angle: &Estimate, projected: Option<&Estimate>) -> String {
    let mut object = in_steradians(solid_angle);
    let value = in_view(solid_angle);
    object["fraction_of_sphere"] = json!(fraction(value));
    object["square_degrees"] = json!(square_degrees(value));
    if let Some(projected) = projected {
        object["projected"] = in_steradians(projected);
        object["configuration_factor"] = json!(projected.value / PI);
    }
    format!("{object:#}\n")
}

fn in_steradians(found: &Estimate) -> Value {
    let Estimate {
        value,
        std_error,
        method,
        ..
    } = found;
    let mut object =
        json!({ "value": value, "unit": "sr", "std_error": std_error, "method": method });
    if *method == Method::Estimate {
        object["interval"] = json!(found.interval);
        object["converged"] = json!(found.converged);
    }
    object
}

/// A value in sr that has no error.
fn closed_form(value: f64) -> Value {
    in_steradians(&Estimate::closed_form(value))
}

fn in_view(found: &Estimate) -> SolidAngle {
    SolidAngle::from_steradians(found.value)
}

fn fraction(solid_angle: SolidAngle) -> f64 {
    solid_angle / SolidAngle::SPHERE
}

fn square_degrees(solid_angle: SolidAngle) -> f64 {
    let degree = Angle::from_degrees(1.0).to_radians();
    solid_angle.to_steradians() / (degree * degree)
}
