//! `steradian brdf plot`: lobes, albedos and maps of models.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use steradian::geometry::{Direction, Spherical};
use steradian::quantity::Angle;
use steradian_io::report::numbers::significant;
use steradian_io::report::plot::{
    Axis, HemisphereMap, HemispherePanel, LinePlot, PlotError, PolarCurve, PolarPlot, Series, Zero,
};

use super::direction::Incident;
use super::model::{self, Model, Settings};
use super::number;
use crate::output;
use crate::status::{Failure, Outcome};

/// Rings and sectors of a map.
const RINGS: u32 = 45;
const SECTORS: u32 = 90;
/// Quarters of a degree between points of a lobe.
const FINE: i32 = 4;

/// Draw models: lobes in the plane of incidence, albedo against angle, or ρ over the hemisphere
///
/// Several models are drawn over one another; a model with settings of its own is one word in quotes: "rough-conductor metal=gold
/// alpha=0.1". `--set` holds for all of them. Values are luminance-weighted means of the colours unless --wavelength is given.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Models, each perhaps with settings: "oren-nayar sigma=20deg"
    #[arg(value_name = "MODEL|FILE", required = true)]
    models: Vec<String>,
    #[command(flatten)]
    settings: Settings,
    /// What is drawn
    #[arg(long, value_enum, default_value_t)]
    kind: Kind,
    #[command(flatten)]
    incident: Incident,
    /// Show ρ over four decades instead of linearly
    #[arg(long)]
    log: bool,
    /// The picture, by its ending
    #[arg(short, long, value_name = "FILE.svg|FILE.png")]
    output: PathBuf,
}

/// What is drawn.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum Kind {
    /// ρ in 1/sr by the viewer's angle in the plane of incidence, for light from --theta-i
    #[default]
    Lobes,
    /// Reflectance against the angle of incidence; dashed: transmittance
    Albedo,
    /// ρ in 1/sr over the viewer's hemisphere, for light from --theta-i
    Map,
}

const EXAMPLES: &str = "\
Examples:
  steradian brdf plot \"rough-conductor alpha=0.1\" \"rough-conductor alpha=0.3\" --set metal=gold --theta-i 45deg -o lobes.svg
  steradian brdf plot \"dielectric ior=1.5\" \"pane ior=1.5 transmittance=1\" --kind albedo -o glass.svg
  steradian brdf plot \"oren-nayar reflectance=0.8 sigma=20deg\" --kind map --theta-i 60deg -o map.png";

/// A picture of one kind.
enum Drawing {
    Lobes(PolarPlot),
    Albedo(LinePlot),
    Map(HemisphereMap),
}

impl Drawing {
    fn bytes(&self, is_png: bool) -> Result<Vec<u8>, PlotError> {
        match (self, is_png) {
            (Self::Lobes(plot), false) => plot.to_svg().map(String::into_bytes),
            (Self::Albedo(plot), false) => plot.to_svg().map(String::into_bytes),
            (Self::Map(plot), false) => plot.to_svg().map(String::into_bytes),
            (Self::Lobes(plot), true) => plot.to_png(),
            (Self::Albedo(plot), true) => plot.to_png(),
            (Self::Map(plot), true) => plot.to_png(),
        }
    }
}

/// Writes the picture.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let models = models(arguments)?;
    let drawing = match arguments.kind {
        Kind::Lobes => Drawing::Lobes(lobes(&models, arguments)),
        Kind::Albedo => Drawing::Albedo(albedos(&models, arguments.incident.phi_i)),
        Kind::Map => Drawing::Map(maps(&models, arguments)),
    };
    let is_png = output::is_png(&arguments.output)?;
    let bytes = drawing
        .bytes(is_png)
        .map_err(|error| Failure::Other(error.into()))?;
    output::write(&bytes, Some(&arguments.output))?;
    Ok(Outcome::Fine)
}

fn models(arguments: &Arguments) -> Result<Vec<Model>, Failure> {
    let one = |words: &String| {
        let (name, own) = split(words);
        let mut model = model::read(&name, &with(&arguments.settings, own))?;
        model.title = words.split_whitespace().collect::<Vec<_>>().join(" ");
        Ok(model)
    };
    arguments.models.iter().map(one).collect()
}

/// The name, and settings; a word without `=` belongs to the value before it.
fn split(words: &str) -> (String, Vec<String>) {
    let mut name = String::new();
    let mut settings: Vec<String> = Vec::new();
    for word in words.split_whitespace() {
        match settings.last_mut() {
            _ if word.contains('=') => settings.push(word.to_owned()),
            Some(last) => *last = format!("{last} {word}"),
            None if name.is_empty() => word.clone_into(&mut name),
            None => name = format!("{name} {word}"),
        }
    }
    (name, settings)
}

fn with(common: &Settings, own: Vec<String>) -> Settings {
    Settings {
        set: common.set.iter().cloned().chain(own).collect(),
        wavelength: common.wavelength,
    }
}

fn value_axis(is_logarithmic: bool) -> Axis {
    let axis = Axis::new("ρ", "1/sr");
    if is_logarithmic {
        axis.logarithmic()
    } else {
        axis
    }
}

fn degrees(angle: Angle) -> String {
    format!("{}°", significant(angle.to_degrees(), 4))
}

/// In the plane of incidence: the light comes from the left, angles to the right are of the mirrored side.
fn lobes(models: &[Model], arguments: &Arguments) -> PolarPlot {
    let incident = &arguments.incident;
    let wi = incident.direction();
    let curve = |model: &Model| {
        let point = |quarter: i32| {
            let angle = f64::from(quarter) / f64::from(FINE);
            let wo = Spherical::new(Angle::from_degrees(-angle), incident.phi_i).to_direction();
            [angle, number::total(model, model.brdf.evaluate(wo, wi))]
        };
        PolarCurve {
            name: model.title.clone(),
            points: (-180 * FINE..=180 * FINE).map(point).collect(),
            dashed: false,
        }
    };
    PolarPlot {
        title: format!(
            "ρ in the plane of incidence, θ_i = {}",
            degrees(incident.theta_i)
        ),
        value: value_axis(arguments.log),
        curves: models.iter().map(curve).collect(),
        arrows: vec![-incident.theta_i.to_degrees()],
        zero: Zero::Above,
    }
}

fn albedos(models: &[Model], phi: Angle) -> LinePlot {
    let angle = Axis::new("angle of incidence", "°")
        .from_to(0.0, 90.0)
        .tick_every(15.0);
    let share = Axis::new("share of the light", "")
        .from_to(0.0, 1.05)
        .tick_every(0.1);
    let mut plot = LinePlot::new("Reflectance; dashed: transmittance", angle, share);
    let points = |of: &dyn Fn(Direction) -> f64| -> Vec<[f64; 2]> {
        (0..=90)
            .map(|degrees| {
                // Just above the horizon, where many shares jump.
                let theta = Angle::from_degrees(f64::from(degrees).min(89.99));
                [
                    f64::from(degrees),
                    of(Spherical::new(theta, phi).to_direction()),
                ]
            })
            .collect()
    };
    for model in models {
        let reflected = points(&|wi| number::total(model, model.brdf.albedo(wi)));
        plot = plot.with(Series::new(&model.title, reflected));
    }
    for (index, model) in models.iter().enumerate() {
        let transmitted = points(&|wi| number::total(model, model.brdf.transmittance(wi)));
        if transmitted.iter().any(|point| point[1] > 0.0) {
            plot = plot.with(
                Series::new(&format!("{}, transmitted", model.title), transmitted)
                    .dashed()
                    .in_colour_of(index),
            );
        }
    }
    plot
}

fn maps(models: &[Model], arguments: &Arguments) -> HemisphereMap {
    let incident = &arguments.incident;
    let wi = incident.direction();
    let panel = |model: &Model| {
        let value = |ring: u32, sector: u32| {
            let theta = 90.0 * (f64::from(ring) + 0.5) / f64::from(RINGS);
            let phi = 360.0 * (f64::from(sector) + 0.5) / f64::from(SECTORS);
            let wo =
                Spherical::new(Angle::from_degrees(theta), Angle::from_degrees(phi)).to_direction();
            number::total(model, model.brdf.evaluate(wo, wi))
        };
        let ring = |ring: u32| (0..SECTORS).map(|sector| value(ring, sector)).collect();
        HemispherePanel {
            name: model.title.clone(),
            rings: (0..RINGS).map(ring).collect(),
            mark: Some([incident.theta_i.to_degrees(), incident.phi_i.to_degrees()]),
        }
    };
    HemisphereMap {
        title: format!(
            "ρ by the viewer's direction; the dot is the light, θ_i = {}",
            degrees(incident.theta_i)
        ),
        value: value_axis(arguments.log),
        panels: models.iter().map(panel).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_is_split_from_its_settings() {
        let (name, settings) = split("oren-nayar sigma=20 deg reflectance=0.5");
        assert_eq!((name.as_str(), settings.len()), ("oren-nayar", 2));
        assert_eq!(settings, ["sigma=20 deg", "reflectance=0.5"]);
        assert_eq!(split("data/a file.xml").0, "data/a file.xml");
    }
}
