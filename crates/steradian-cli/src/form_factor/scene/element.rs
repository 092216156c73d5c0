//! What a surface element sees of a scene.

use serde_json::{Value, json};
use steradian::estimation::{Method, Plan};
use steradian::exchange::{Element, Entry, Facets, Groups, Row, Uncertain, factors_of_element};
use steradian_io::report::columns::Columns;
use steradian_io::report::form_factors::method;
use steradian_io::report::numbers::{exact, with_half_width};

use super::{Format, SceneArguments};
use crate::output;
use crate::status::{Failure, Outcome};

/// Finds and writes the factors from the element to all surfaces that it sees.
pub fn run(
    facets: &Facets,
    groups: &Groups,
    element: Element,
    plan: &Plan,
    arguments: &SceneArguments,
    format: Option<Format>,
) -> Result<Outcome, Failure> {
    if arguments.exchange.is_some() || arguments.smooth || arguments.plot.is_some() {
        let message =
            "--exchange, --smooth and --plot are about whole matrices, not about an --element";
        return Err(Failure::message(message));
    }
    let row = factors_of_element(facets, groups, element, plan)?;
    let lines = lines(&row, groups);
    let text = match Format::of(format, arguments.output.as_deref())? {
        Format::Table => table(&lines, plan),
        Format::Json => json_text(&lines, &row),
        Format::Csv => csv(&lines),
        Format::Npz => {
            return Err(Failure::message(
                "npz is a format of matrices; use table, json or csv",
            ));
        }
    };
    output::write(text.as_bytes(), arguments.output.as_deref())?;
    Ok(Outcome::fine_if(row.converged))
}

/// A factor with the name of where it leads.
struct Line {
    to: String,
    factor: Uncertain,
    method: Method,
}

/// The surfaces, then what goes elsewhere, as far as anything does.
fn lines(row: &Row, groups: &Groups) -> Vec<Line> {
    let surface = |entry: &Entry| Line {
        to: groups.names()[entry.to as usize].clone(),
        factor: entry.factor(),
        method: entry.method,
    };
    let elsewhere = row.rest.iter().flat_map(|rest| {
        [
            ("(sky)", rest.sky),
            ("(below the horizon)", rest.below),
            ("(other sides)", rest.other),
        ]
    });
    let elsewhere = elsewhere.filter(|(_, factor)| factor.value > 0.0);
    let elsewhere = elsewhere.map(|(name, factor)| Line {
        to: name.to_owned(),
        factor,
        method: Method::Estimate,
    });
    row.entries.iter().map(surface).chain(elsewhere).collect()
}

fn table(lines: &[Line], plan: &Plan) -> String {
    let mut columns = Columns::new(["to", "factor", "method"]);
    for line in lines {
        let number = match line.method {
            Method::ClosedForm => exact(line.factor.value),
            _ => with_half_width(line.factor.value, line.factor.half_width(plan.confidence)),
        };
        columns.row([line.to.clone(), number, method(line.method).to_owned()]);
    }
    columns.to_string()
}

fn json_text(lines: &[Line], row: &Row) -> String {
    let factor = |line: &Line| -> Value {
        json!({
            "to": line.to,
            "value": line.factor.value,
            "unit": "1",
            "std_error": line.factor.std_error,
            "method": method(line.method),
        })
    };
    let object = json!({
        "schema": "steradian.element-factors/1",
        "factors": lines.iter().map(factor).collect::<Vec<_>>(),
        "samples": row.samples,
        "converged": row.converged,
    });
    format!("{object:#}\n")
}

fn csv(lines: &[Line]) -> String {
    let line = |line: &Line| {
        let name = line.to.replace('"', "\"\"");
        format!(
            "\"{name}\",{},{},{}\n",
            line.factor.value,
            line.factor.std_error,
            method(line.method)
        )
    };
    let lines: String = lines.iter().map(line).collect();
    format!("to,value,std_error,method\n{lines}")
}
