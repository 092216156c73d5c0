//! `steradian help`: a subcommand's long help, or the keys of a scene file.

use clap::{Args, CommandFactory};
use steradian_io::scene_file::{key_help, schema};

use crate::output;
use crate::status::{Failure, Outcome};

/// Explain a subcommand, or `scene`: the keys of a scene file
#[derive(Args, Debug)]
pub struct Arguments {
    /// A subcommand, or `scene`
    topic: Option<String>,
    /// With `scene`: print the JSON Schema that editors use to check and complete scene files
    #[arg(long, requires = "topic")]
    schema: bool,
}

/// Prints the help.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let text = match (arguments.topic.as_deref(), arguments.schema) {
        (Some("scene"), true) => format!("{:#}\n", schema()),
        (Some("scene"), false) => key_help(),
        (Some(_), true) => return Err(Failure::message("--schema goes with the topic `scene`")),
        (topic, false) => command_help(topic)?,
        (None, true) => return Err(Failure::message("--schema goes with the topic `scene`")),
    };
    output::print(&text)?;
    Ok(Outcome::Fine)
}

fn command_help(topic: Option<&str>) -> Result<String, Failure> {
    let mut command = crate::args::Arguments::command();
    command.build();
    let Some(topic) = topic else {
        return Ok(command.render_long_help().to_string());
    };
    let topics: Vec<String> = command
        .get_subcommands()
        .map(|sub| sub.get_name().to_owned())
        .collect();
    match command.find_subcommand_mut(topic) {
        Some(subcommand) => Ok(subcommand.render_long_help().to_string()),
        None => Err(Failure::message(format!(
            "no help on `{topic}`; topics are scene, {}",
            topics.join(", ")
        ))),
    }
}
