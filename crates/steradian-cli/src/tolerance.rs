//! An absolute tolerance: a quantity in the unit of the readings it is about.

use steradian::quantity::{
    Exitance, Flux, Illuminance, Irradiance, Luminance, LuminousExitance, LuminousFlux, Quantity,
    Radiance, UnitTable,
};
use steradian::scene::Scene;
use steradian::sensor::{Kind, Sensor};

use crate::status::Failure;

/// The value of `5 lx` in the unit of the first quantity of the chosen sensors, which must be the same for all.
pub fn parse(text: &str, scene: &Scene, chosen: Option<&[String]>) -> Result<f64, Failure> {
    let is_chosen = |sensor: &&Sensor| chosen.is_none_or(|names| names.contains(&sensor.name));
    let meters = scene
        .sensors()
        .iter()
        .filter(|sensor| !matches!(sensor.kind, Kind::Camera(_)));
    let units: Vec<&str> = meters
        .filter(is_chosen)
        .filter_map(|sensor| sensor.readouts.first())
        .map(|readout| readout.unit.as_str())
        .collect();
    let Some(unit) = units.first() else {
        return Ok(0.0);
    };
    if let Some(other) = units.iter().find(|other| *other != unit) {
        let message = format!(
            "--abs-error is one quantity, but the sensors read in {unit} and {other}; choose with --sensor"
        );
        return Err(Failure::message(message));
    }
    let table = table(unit)
        .ok_or_else(|| Failure::message(format!("--abs-error: no unit table for {unit}")))?;
    table
        .parse(text)
        .map_err(|error| Failure::message(format!("--abs-error: {error}")))
}

/// The units of the quantity whose SI unit this is.
pub fn table(unit: &str) -> Option<&'static UnitTable> {
    const TABLES: [&UnitTable; 8] = [
        Irradiance::<f64>::TABLE,
        Illuminance::TABLE,
        Flux::<f64>::TABLE,
        LuminousFlux::TABLE,
        Radiance::<f64>::TABLE,
        Luminance::TABLE,
        Exitance::<f64>::TABLE,
        LuminousExitance::TABLE,
    ];
    TABLES.into_iter().find(|table| table.si == unit)
}
