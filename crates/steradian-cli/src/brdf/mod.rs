//! `steradian brdf`: reflection models one at a time: their values, shares, pictures, and whether they keep their contract.

mod albedo;
mod check;
mod corners;
mod direction;
mod eval;
mod fresnel;
mod incoming;
mod list;
mod model;
mod number;
mod plot;
mod reflect;

use clap::{Args, Subcommand};

use crate::status::{Failure, Outcome};

/// Reflection models: values, shares of light, pictures, and checks of their physics
///
/// A model (BRDF, or BSDF if light goes through) says how light that comes along d_i leaves along d_e: ρ(d_e, d_i) = dL(d_e)/dH(d_i),
/// in 1/sr, without the cosine. Directions point away from the surface and have angles to its normal: i towards the light, o towards
/// the viewer; beyond 90° they are on the inside, where the normal does not point. Parameters are the keys of materials in scene files:
/// `steradian brdf list` shows them.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  steradian brdf list
  steradian brdf eval lambertian --set reflectance=0.5 --theta-i 30deg
  steradian brdf albedo rough-conductor --set metal=gold --set alpha=0.3 --sweep 0:85deg
  steradian brdf fresnel --ior 1.5 --theta-i 45deg
  steradian brdf check rough-dielectric --set ior=1.5 --set alpha=0.2

steradian brdf eval --help explains one of them.";

/// What to do with a model.
#[derive(Debug, Subcommand)]
enum Command {
    /// The models and their parameters
    List(list::Arguments),
    /// ρ(d_e, d_i) in 1/sr for two directions, and the density of its sampling
    Eval(eval::Arguments),
    /// Shares of the light that are reflected and transmitted, at an angle, over angles, or of light from everywhere
    Albedo(albedo::Arguments),
    /// Fresnel's equations for one smooth interface: both polarisations, angles of refraction, Brewster and total reflection
    Fresnel(fresnel::Arguments),
    /// The radiance that a surface reflects: the reflection integral by a sum, by quadrature and by Monte Carlo side by side
    Reflect(reflect::Arguments),
    /// Whether models keep reciprocity and energy, and whether their samples have the density they claim
    Check(check::Arguments),
    /// Draw models: lobes in the plane of incidence, albedo against angle, or ρ over the hemisphere
    Plot(plot::Arguments),
}

/// Runs what was asked for.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match &arguments.command {
        Command::List(arguments) => list::run(arguments),
        Command::Eval(arguments) => eval::run(arguments),
        Command::Albedo(arguments) => albedo::run(arguments),
        Command::Fresnel(arguments) => fresnel::run(arguments),
        Command::Reflect(arguments) => reflect::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Plot(arguments) => plot::run(arguments),
    }
}
