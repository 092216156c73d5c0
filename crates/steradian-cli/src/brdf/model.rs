//! A model from its name and settings, in the lanes of colours or at one wavelength.

use std::ops::RangeInclusive;
use std::path::Path;

use clap::Args;
use steradian::brdf::Brdf;
use steradian::quantity::Length;
use steradian::spectrum::Lanes;
use steradian_io::files::DiskFiles;
use steradian_io::report::numbers::significant;
use steradian_io::scene_file::material_from_settings;

use crate::status::Failure;

/// What the eye sees, in nm: colours have spectra there.
const VISIBLE: [f64; 2] = [360.0, 830.0];
/// What spectra are known for, in nm.
const RANGE: RangeInclusive<f64> = 280.0..=4000.0;

/// Which model.
#[derive(Args, Clone, Debug)]
pub struct ModelArguments {
    /// A model such as lambertian or rough-conductor (`steradian brdf list`), or a file of measured data
    #[arg(value_name = "MODEL|FILE")]
    pub model: String,
    #[command(flatten)]
    pub settings: Settings,
}

/// How the model is set.
#[derive(Args, Clone, Debug, Default)]
pub struct Settings {
    /// A parameter, as in a scene file: alpha=0.3, metal=gold, reflectance=[0.8,0.5,0.2], sigma=20deg. Repeat for more
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// At one wavelength, such as 550nm, instead of in the colours red, green and blue
    #[arg(long, value_name = "LENGTH")]
    pub wavelength: Option<Length>,
}

/// A model and what its lanes are.
pub struct Model {
    /// The name with the settings, for titles.
    pub title: String,
    /// The model.
    pub brdf: Brdf,
    /// Names of the lanes that count.
    pub lanes: Vec<String>,
    /// What each counts in one number: luminance in colours.
    pub weights: Vec<f64>,
}

impl ModelArguments {
    /// The model.
    pub fn read(&self) -> Result<Model, Failure> {
        read(&self.model, &self.settings)
    }
}

impl Model {
    /// The lanes as one number: the luminance-weighted mean of colours.
    pub fn total(&self, lanes: [f64; 4]) -> f64 {
        let parts = self.weights.iter().zip(lanes);
        parts.map(|(weight, lane)| weight * lane).sum()
    }
}

/// Reads a model as a scene file's material is read.
pub fn read(model: &str, settings: &Settings) -> Result<Model, Failure> {
    let nanometres = settings.wavelength.map(|length| length.to_metres() * 1e9);
    let lanes = lanes(nanometres)?;
    let (name, pairs) = pairs(model, settings)?;
    let pairs: Vec<(&str, &str)> = pairs
        .iter()
        .map(|(key, value)| (key.as_str(), value.as_str()))
        .collect();
    let material = material_from_settings(&name, &pairs, &lanes, &DiskFiles::default());
    let material = material.map_err(Failure::Input)?;
    let title = title(model, settings);
    let brdf = material.brdf([nanometres.unwrap_or_default(); 4]);
    let Some(brdf) = brdf else {
        return Err(Failure::message(format!("{title} is black at every angle")));
    };
    let (names, weights) = match settings.wavelength {
        Some(wavelength) => (vec![told(wavelength)], vec![1.0]),
        None => (lanes.names().to_vec(), lanes.radiant_weights()),
    };
    Ok(Model {
        title,
        brdf: brdf.into_owned(),
        lanes: names,
        weights,
    })
}

/// Colours, or wavelengths around the one that is asked for.
fn lanes(nanometres: Option<f64>) -> Result<Lanes, Failure> {
    let Some(wavelength) = nanometres else {
        return Ok(Lanes::rgb());
    };
    if !RANGE.contains(&wavelength) {
        return Err(Failure::message(format!(
            "expected a --wavelength between {} and {} nm, found {wavelength} nm",
            RANGE.start(),
            RANGE.end()
        )));
    }
    let range = [VISIBLE[0].min(wavelength), VISIBLE[1].max(wavelength)];
    Lanes::spectral(range, Vec::new()).map_err(|error| Failure::Other(error.into()))
}

fn told(wavelength: Length) -> String {
    let number = significant(wavelength.to_metres() * 1e9, 6);
    format!("{number} nm")
}

fn title(model: &str, settings: &Settings) -> String {
    let mut words = vec![model.to_owned()];
    words.extend(settings.set.iter().cloned());
    words.extend(settings.wavelength.map(told));
    words.join(" ")
}

/// The model's name, and its keys with their values; a file is a model of measured data.
fn pairs(model: &str, settings: &Settings) -> Result<(String, Vec<(String, String)>), Failure> {
    let set = settings.set.iter().map(|setting| pair(setting));
    let mut pairs = set.collect::<Result<Vec<_>, _>>()?;
    if Path::new(model).extension().is_none() {
        return Ok((model.to_owned(), pairs));
    }
    pairs.push(("file".to_owned(), format!("{model:?}")));
    Ok(("measured".to_owned(), pairs))
}

/// `KEY=VALUE`.
fn pair(setting: &str) -> Result<(String, String), Failure> {
    let is_key = |text: &str| {
        !text.is_empty()
            && text
                .chars()
                .all(|c| c.is_ascii_alphanumeric() || "_-".contains(c))
    };
    setting
        .split_once('=')
        .map(|(key, value)| (key.trim(), value.trim()))
        .filter(|(key, value)| is_key(key) && !value.is_empty())
        .map(|(key, value)| (key.to_owned(), number(value)))
        .ok_or_else(|| {
            Failure::message(format!(
                "expected --set KEY=VALUE such as --set alpha=0.3, found `{setting}`"
            ))
        })
}

/// A number as TOML writes it, with digits on both sides of its point; anything else as it is.
fn number(text: &str) -> String {
    if text.parse::<f64>().is_err() {
        return text.to_owned();
    }
    match text.strip_prefix('.') {
        Some(rest) => format!("0.{rest}"),
        None => text
            .strip_suffix('.')
            .map_or_else(|| text.to_owned(), |whole| format!("{whole}.0")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_become_keys_and_values() {
        for (text, key, value) in [
            ("alpha=.5", "alpha", "0.5"),
            ("alpha = 2.", "alpha", "2.0"),
            ("metal=gold", "metal", "gold"),
            ("sigma=20 deg", "sigma", "20 deg"),
            ("eta=[1, 2, 3]", "eta", "[1, 2, 3]"),
        ] {
            let found = pair(text).ok();
            assert_eq!(found, Some((key.to_owned(), value.to_owned())));
        }
        for text in ["alpha", "=1", "alpha=", "a b=1"] {
            assert!(pair(text).is_err(), "{text}");
        }
    }

    #[test]
    fn wavelengths_out_of_range_are_refused() {
        assert!(lanes(Some(550.0)).is_ok() && lanes(Some(1064.0)).is_ok());
        assert!(lanes(Some(50.0)).is_err() && lanes(Some(f64::NAN)).is_err());
    }
}
