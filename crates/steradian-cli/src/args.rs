//! The command line as a whole; each subcommand's own arguments are in its file.

use clap::{Parser, Subcommand};

use crate::{
    area, brdf, direction, energy, form_factor, glare, help, inspect, learn, measure, merge, plot,
    render, report, solid_angle, verify,
};

/// Light in SI units: radiance, irradiance and flux in a scene, each number with its unit and an error bar.
///
/// A scene is a TOML file that states shapes, materials, lights and sensors with their units. `measure` prints what the
/// sensors read, `render` makes a picture. Every number carries the error of its sampling, and a run stops when the error
/// is small enough.
#[derive(Debug, Parser)]
#[command(name = "steradian", version, max_term_width = 110, disable_help_subcommand = true, after_long_help = EXAMPLES)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "\
Examples:
  steradian measure scenes/point-light.toml
  steradian render scenes/cornell-box.toml -o cornell.png
  steradian help scene          every key of a scene file
  steradian help measure        the same as steradian measure --help

Results go to standard output, progress and messages to standard error.
Exit status: 0 fine; 1 it ran, but a tolerance was not met, a check failed or light was left out; 2 error.";

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make a picture: the radiance that a camera of the scene receives
    Render(render::Arguments),
    /// Read the sensors of a scene: irradiance, flux, radiance, with error bars
    Measure(measure::Arguments),
    /// Draw what a run found: plans with numbers, isolux lines with their error bands, shares of light groups
    Plot(plot::Arguments),
    /// Write what a run found as one HTML page: statistics, plans, isolux lines, shares of light groups, all readings
    Report(report::Arguments),
    /// List what a scene or mesh holds: areas, reflectances, fluxes, sensors; and what is wrong with it: leaks, doubled faces …
    Inspect(inspect::Arguments),
    /// Assess the glare of a view: in a picture of luminance, or for an observer in a scene
    Glare(Box<glare::Arguments>),
    /// Check this program on scenes with closed-form answers
    Verify(verify::Arguments),
    /// Put the parts of a run together that `--shard` computed
    Merge(merge::Arguments),
    /// Area of a shape, in closed form and by quadrature
    Area(area::Arguments),
    /// Form factors (view factors): between two surfaces, from an element, or of a whole scene with obstacles
    FormFactor(Box<form_factor::Arguments>),
    /// Solid angle of an object seen from a point
    SolidAngle(Box<solid_angle::Arguments>),
    /// Reflection models: values, shares of light, pictures, and checks of their physics
    Brdf(Box<brdf::Arguments>),
    /// Convert a direction between angles and a vector
    Direction(direction::Arguments),
    /// Integrate a flux over time, or turn the readings of an energy meter into fluxes
    Energy(energy::Arguments),
    /// Learn radiometry in twelve lessons, from area to the reflection integral
    Learn(learn::Arguments),
    /// Explain a subcommand, or `scene`: the keys of a scene file
    Help(help::Arguments),
}
