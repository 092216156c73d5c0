//! `steradian brdf list`: the models and their parameters.

use std::fmt::Write;

use clap::Args;
use serde_json::{Value, json};
use steradian_io::report::columns::Columns;
use steradian_io::scene_file::{KeyHelp, ModelHelp, models};

use crate::output::{self, Format};
use crate::status::{Failure, Outcome};

/// The models and their parameters
///
/// Without a name a line for each model; with one, its parameters: what `--set KEY=VALUE` takes, and `KEY = VALUE` of a material in
/// a scene file.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// One model
    #[arg(value_name = "MODEL")]
    model: Option<String>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian brdf list
  steradian brdf list rough-conductor";

/// Prints the list.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let all: Vec<ModelHelp> = models()
        .into_iter()
        .filter(|model| model.name != "two-sided")
        .collect();
    let wanted = |model: &&ModelHelp| {
        arguments
            .model
            .as_ref()
            .is_none_or(|name| name == model.name)
    };
    let shown: Vec<&ModelHelp> = all.iter().filter(wanted).collect();
    if shown.is_empty() {
        let names: Vec<&str> = all.iter().map(|model| model.name).collect();
        let name = arguments.model.clone().unwrap_or_default();
        return Err(Failure::message(format!(
            "no model `{name}`; there are {}",
            names.join(", ")
        )));
    }
    output::print(&match (arguments.format, arguments.model.is_some()) {
        (Format::Json, _) => format!(
            "{:#}\n",
            json!({ "models": shown.iter().map(|model| json_model(model)).collect::<Vec<_>>() })
        ),
        (Format::Table, true) => shown.iter().map(|model| described(model)).collect(),
        (Format::Table, false) => table(&shown),
    })?;
    Ok(Outcome::Fine)
}

fn table(models: &[&ModelHelp]) -> String {
    let mut columns = Columns::new(["model", "what it is", "parameters"]);
    for model in models {
        let keys: Vec<&str> = model.keys.iter().map(|key| key.name).collect();
        columns.row([model.name, model.doc, &keys.join(" ")]);
    }
    columns.to_string()
}

fn described(model: &ModelHelp) -> String {
    let mut text = format!("{}: {}.\n", model.name, model.doc);
    for key in &model.keys {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  {:<20} {}. {}.{}",
            key.name,
            key.doc,
            key.expects,
            need(key)
        );
    }
    text
}

fn need(key: &KeyHelp) -> String {
    match (key.default, key.one_of.as_slice()) {
        (Some(value), _) => format!(" Default: {value}."),
        (None, []) if key.required => " Required.".to_owned(),
        (None, []) => String::new(),
        (None, group) => format!(" One of {}.", group.join(", ")),
    }
}

fn json_model(model: &ModelHelp) -> Value {
    let key = |key: &KeyHelp| {
        json!({
            "key": key.name,
            "doc": key.doc,
            "expects": key.expects,
            "default": key.default,
            "required": key.required,
            "one_of": key.one_of,
        })
    };
    json!({
        "model": model.name,
        "doc": model.doc,
        "keys": model.keys.iter().map(key).collect::<Vec<_>>(),
    })
}
