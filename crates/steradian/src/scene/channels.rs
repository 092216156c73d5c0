//! What a run's lanes and channels are: in `spectral` the responses that the sensors ask for, each once.

use std::sync::Arc;

use super::description::{
    Bins, Response, SceneDescription, SensorDescription, SensorKind, SpectrumMode,
};
use super::{Part, Problem};
use crate::spectrum::{Action, Beyond, Channel, Curve, Lanes, Observer, RADIANT, rgb_curves};

/// Bins of a run.
const MOST_BINS: usize = 10_000;

pub(super) fn lanes(description: &SceneDescription, problems: &mut Vec<Problem>) -> Option<Lanes> {
    let lanes = match &description.spectrum {
        SpectrumMode::Rgb => Ok(Lanes::rgb()),
        SpectrumMode::Broadband { bands } => Lanes::broadband(bands),
        SpectrumMode::Spectral { range } => {
            Lanes::spectral(*range, channels(description, problems))
        }
    };
    lanes
        .map_err(|error| problems.push(Problem::at(Part::Scene, "spectrum", error.to_string())))
        .ok()
}

/// The channel that a bin is read from.
pub(super) fn bin_name([low, high]: [f64; 2]) -> String {
    format!("{low}-{high} nm")
}

/// The channel that a table is read from.
pub(super) fn table_name(name: &str) -> String {
    format!("response {name}")
}

/// Names of the channels of a camera: linear Rec.709 of what is seen, and all radiant power.
pub const CAMERA_CHANNELS: [&str; 4] = ["red", "green", "blue", RADIANT];

fn channels(description: &SceneDescription, problems: &mut Vec<Problem>) -> Vec<Channel> {
    let mut channels = vec![channel(RADIANT, Curve::constant(1.0))];
    channels.push(channel("photopic", Action::Photopic.weight().clone()));
    for (index, sensor) in description.sensors.iter().enumerate() {
        match of_sensor(sensor, description) {
            Ok(wanted) => wanted.into_iter().for_each(|one| add(&mut channels, one)),
            Err(message) => problems.push(Problem::at(Part::Sensor(index), "bins", message)),
        }
    }
    channels
}

fn channel(name: impl Into<String>, response: Curve) -> Channel {
    Channel {
        name: name.into(),
        response: Arc::new(response),
    }
}

fn add(channels: &mut Vec<Channel>, one: Channel) {
    if channels.iter().all(|known| known.name != one.name) {
        channels.push(one);
    }
}

fn of_sensor(
    sensor: &SensorDescription,
    description: &SceneDescription,
) -> Result<Vec<Channel>, String> {
    if matches!(sensor.kind, SensorKind::Camera(_)) {
        let named = CAMERA_CHANNELS
            .into_iter()
            .zip(rgb_curves(Observer::Cie1931));
        return Ok(named.map(|(name, curve)| channel(name, curve)).collect());
    }
    let response = sensor.response.as_ref().unwrap_or(&description.response);
    let mut all = match response {
        Response::Auto | Response::Radiant | Response::Photopic => vec![],
        Response::Scotopic => vec![of_action(Action::Scotopic)],
        Response::Par => vec![of_action(Action::Par)],
        Response::Melanopic => vec![of_action(Action::Melanopic)],
        Response::Xyz => xyz(),
        Response::Table { name, curve } => vec![channel(table_name(name), Curve::clone(curve))],
    };
    for bin in sensor
        .bins
        .iter()
        .map(intervals)
        .collect::<Result<Vec<_>, _>>()?
        .concat()
    {
        all.push(channel(bin_name(bin), window(bin)?));
    }
    Ok(all)
}

fn of_action(action: Action) -> Channel {
    channel(action.name(), action.weight().clone())
}

/// X, Y, Z scaled so that Y is photometric.
fn xyz() -> Vec<Channel> {
    let curves = Observer::Cie1931.curves().iter().zip(["X", "Y", "Z"]);
    curves
        .map(|(curve, name)| channel(name, curve.scaled(crate::spectrum::PHOTOPIC_EFFICACY)))
        .collect()
}

/// 1 within the interval.
fn window([low, high]: [f64; 2]) -> Result<Curve, String> {
    Curve::new(vec![(low, 1.0), (high, 1.0)], Beyond::Zero).map_err(|error| error.to_string())
}

/// First and last wavelength of each bin.
pub(super) fn intervals(bins: &Bins) -> Result<Vec<[f64; 2]>, String> {
    let Bins {
        range: [low, high],
        width,
        ..
    } = *bins;
    let count = ((high - low) / width).round();
    let whole = (count * width - (high - low)).abs() < 1e-6 * width;
    if !(whole && (1.0..=MOST_BINS as f64).contains(&count)) {
        return Err(format!(
            "bins divide their range evenly, into {MOST_BINS} at most: {low} to {high} nm by {width} nm"
        ));
    }
    let edge = |index: usize| low + (high - low) * index as f64 / count;
    Ok((0..count as usize)
        .map(|index| [edge(index), edge(index + 1)])
        .collect())
}
