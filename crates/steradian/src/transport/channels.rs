//! From the lanes of a path to the channels of a reading.
//!
//! In `rgb` and `broadband` they are the same. In `spectral` a channel is ¼ Σ_k R(λ_k) L_λk / p(λ_k) over the path's four
//! wavelengths, drawn from a density that follows what the sensor responds to and what the lights emit.

use super::columns::{BATCH, Workspace};
use super::tables::Tables;
use crate::scene::Scene;
use crate::sensor::{Kind, Sensor};
use crate::spectrum::{BakedCurve, Curve, MAX_LANES, WavelengthDensity, Wavelengths};

/// Channels of the groups, from what the path of a slot gathered.
pub(super) fn read(tables: &Tables<'_>, paths: &Workspace, slot: usize, columns: &mut [f64]) {
    let lanes = tables.lanes;
    let gathered = |group: usize, lane: usize| {
        f64::from(paths.gathered[(group * lanes + lane) * BATCH + slot])
    };
    if tables.responses.is_empty() {
        for (column, value) in columns.iter_mut().enumerate() {
            *value = gathered(column / lanes, column % lanes);
        }
        return;
    }
    let waves = &paths.wavelengths[slot];
    for (group, channels) in columns.chunks_mut(tables.responses.len()).enumerate() {
        for (channel, response) in channels.iter_mut().zip(&tables.responses) {
            let counts = counts(response, waves);
            let lane = |lane: usize| gathered(group, lane) * f64::from(counts[lane]);
            *channel = (lane(0) + lane(1)) + (lane(2) + lane(3));
        }
    }
}

/// R(λ_k) / 4p(λ_k): what each lane of a path counts in a channel.
pub(super) fn counts(response: &BakedCurve, waves: &Wavelengths) -> [f32; MAX_LANES] {
    std::array::from_fn(|lane| response.at(waves.places[lane]) * waves.weights[lane])
}

/// What the lanes of a path are in a channel of a film.
pub(super) fn counted(
    response: &BakedCurve,
    waves: &Wavelengths,
    lane: impl Fn(usize) -> f32,
) -> f32 {
    let counts = counts(response, waves);
    let part = |k: usize| lane(k) * counts[k];
    (part(0) + part(1)) + (part(2) + part(3))
}

/// From what a sensor's wavelengths are drawn; `None` unless the run is spectral.
pub(super) fn density(scene: &Scene, sensor: &Sensor) -> Option<WavelengthDensity> {
    let grid = scene.lanes().grid()?;
    let range = grid.range();
    let responses = responses(scene, sensor);
    let scale = |curve: &Curve| 1.0 / curve.integral(range).abs().max(f64::MIN_POSITIVE);
    let response = |nm: f64| -> f64 {
        let parts = responses
            .iter()
            .map(|curve| curve.at(nm).abs() * scale(curve));
        parts.sum()
    };
    let lights = scene
        .lights()
        .iter()
        .map(|light| light.spectrum.map(|id| scene.curve(id)));
    let spectra: Vec<_> = lights.collect();
    let emission = |nm: f64| -> f64 {
        let parts = spectra.iter().map(|curve| match curve {
            Some(curve) => curve.at(nm) * scale(curve),
            None => 1.0 / (range[1] - range[0]),
        });
        parts.sum()
    };
    Some(WavelengthDensity::new(grid, |nm| {
        response(nm) * emission(nm)
    }))
}

/// Responses of the channels that a sensor's readings are made of.
fn responses<'a>(scene: &'a Scene, sensor: &Sensor) -> Vec<&'a Curve> {
    let lanes = scene.lanes();
    let seen = |name: &str| ["red", "green", "blue"].contains(&name);
    let camera = matches!(sensor.kind, Kind::Camera(_));
    let used = |channel: usize| match camera {
        true => seen(&lanes.names()[channel]),
        false => {
            let mut readouts = sensor.readouts.iter();
            readouts.any(|readout| readout.weights[channel] != 0.0)
        }
    };
    let all = lanes.responses().iter().enumerate();
    all.filter(|(channel, _)| used(*channel))
        .map(|(_, curve)| &**curve)
        .collect()
}
