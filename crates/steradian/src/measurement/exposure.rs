//! What a reading adds up to: its name and unit.
//!
//! | reading | its integral | by seconds | by hours |
//! |---|---|---|---|
//! | irradiance | radiant exposure | J/m2 | Wh/m2 |
//! | illuminance | luminous exposure | lx s | lx h |
//! | flux, luminous flux | energy, luminous energy | J, lm s | Wh, lm h |
//! | photon irradiance, photon flux | photon exposure, number of photons | umol/m2, umol | — |
//! | radiance, luminance, exitance | time-integrated radiance … | J/(m2 sr), cd s/m2 … | Wh/(m2 sr), cd h/m2 … |

use serde::Serialize;

use crate::estimation::Estimate;

const SECONDS_IN_AN_HOUR: f64 = 3600.0;

/// A reading added up over an interval.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Exposure {
    /// What the reading's quantity adds up to, e.g. `radiant exposure`.
    pub quantity: String,
    /// Its unit by seconds, e.g. `J/m2`.
    pub unit: String,
    /// The value with its error.
    pub estimate: Estimate,
    /// Unit and value by hours, e.g. `Wh/m2`, where such a unit is in use.
    pub in_hours: Option<(String, Estimate)>,
}

impl Exposure {
    pub(super) fn new(quantity: &str, unit: &str, estimate: Estimate) -> Self {
        let in_hours =
            over_hours(unit).map(|unit| (unit, estimate.scaled(1.0 / SECONDS_IN_AN_HOUR)));
        Self {
            quantity: integrated(quantity),
            unit: over_seconds(unit),
            estimate,
            in_hours,
        }
    }
}

/// The name of a quantity's integral over time.
fn integrated(quantity: &str) -> String {
    const NAMES: [(&str, &str); 6] = [
        ("photon irradiance", "photon exposure"),
        ("photon flux", "number of photons"),
        ("luminous flux", "luminous energy"),
        ("irradiance", "radiant exposure"),
        ("illuminance", "luminous exposure"),
        ("flux", "energy"),
    ];
    let known = NAMES.iter().find(|(rate, _)| quantity.contains(rate));
    known.map_or_else(
        || format!("time-integrated {quantity}"),
        |(rate, total)| quantity.replacen(rate, total, 1),
    )
}

/// W → J, lx → lx s, umol/(m2 s) → umol/m2.
fn over_seconds(unit: &str) -> String {
    match (unit.strip_prefix('W'), unit.strip_prefix("umol/")) {
        (Some(per), _) => format!("J{per}"),
        (_, Some("s")) => "umol".to_owned(),
        (_, Some(per)) => {
            let per = per.trim_matches(['(', ')']).trim_end_matches(" s");
            let group = per.contains(' ');
            if group {
                format!("umol/({per})")
            } else {
                format!("umol/{per}")
            }
        }
        _ => with_time(unit, " s"),
    }
}

/// W → Wh, lx → lx h; none for photons, which nobody counts by the hour.
fn over_hours(unit: &str) -> Option<String> {
    match unit.strip_prefix('W') {
        Some(per) => Some(format!("Wh{per}")),
        None => (!unit.starts_with("umol")).then(|| with_time(unit, " h")),
    }
}

/// lm/m2 → lm s/m2.
fn with_time(unit: &str, time: &str) -> String {
    match unit.split_once('/') {
        Some((above, below)) => format!("{above}{time}/{below}"),
        None => format!("{unit}{time}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{
        Energy, LuminousEnergy, LuminousExposure, Quantity, RadiantExposure, UnitTable,
    };

    #[test]
    fn integrals_have_the_names_and_units_of_the_field() {
        for (quantity, unit, integral, seconds, hours) in [
            ("irradiance", "W/m2", "radiant exposure", "J/m2", "Wh/m2"),
            (
                "mean illuminance",
                "lx",
                "mean luminous exposure",
                "lx s",
                "lx h",
            ),
            ("flux (360-830 nm)", "W", "energy (360-830 nm)", "J", "Wh"),
            ("luminous flux", "lm", "luminous energy", "lm s", "lm h"),
            (
                "luminance",
                "cd/m2",
                "time-integrated luminance",
                "cd s/m2",
                "cd h/m2",
            ),
            (
                "radiance",
                "W/(m2 sr)",
                "time-integrated radiance",
                "J/(m2 sr)",
                "Wh/(m2 sr)",
            ),
        ] {
            let exposure = Exposure::new(quantity, unit, Estimate::closed_form(7200.0));
            assert_eq!(
                (exposure.quantity.as_str(), exposure.unit.as_str()),
                (integral, seconds)
            );
            let in_hours = exposure.in_hours.unwrap();
            assert_eq!((in_hours.0.as_str(), in_hours.1.value), (hours, 2.0));
        }
    }

    #[test]
    fn photons_are_counted() {
        for (unit, total) in [
            ("umol/s", "umol"),
            ("umol/(m2 s)", "umol/m2"),
            ("umol/(m2 sr s)", "umol/(m2 sr)"),
        ] {
            let exposure = Exposure::new(
                "photosynthetic photon flux",
                unit,
                Estimate::closed_form(1.0),
            );
            assert_eq!((exposure.unit.as_str(), exposure.in_hours), (total, None));
        }
    }

    /// Both units of an integral are units of the quantity, one 3600 times the other.
    #[test]
    fn units_are_those_of_the_quantities() {
        let tables: [(&str, &UnitTable); 4] = [
            ("W", Energy::TABLE),
            ("W/m2", RadiantExposure::TABLE),
            ("lm", LuminousEnergy::TABLE),
            ("lx", LuminousExposure::TABLE),
        ];
        for (unit, table) in tables {
            let size = |unit: &str| table.find(unit).unwrap().to_si(1.0);
            assert_eq!(size(&over_seconds(unit)), 1.0);
            assert_eq!(size(&over_hours(unit).unwrap()), 3600.0);
        }
    }
}
