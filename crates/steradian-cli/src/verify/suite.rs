//! The scenes with their answers; each scene's file derives them.

use steradian::estimation::Estimate;
use steradian::measurement::Reading;

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI};

/// A scene that is part of the program.
pub struct Verified {
    /// Name of its file.
    pub file: &'static str,
    /// Its text.
    pub text: &'static str,
    /// What its sensors must read.
    pub answers: &'static [Answer],
}

/// What one reading must be.
pub struct Answer {
    /// Name of the sensor.
    pub sensor: &'static str,
    /// Number of the point.
    pub index: usize,
    /// The quantity, as a sensor may report several.
    pub quantity: &'static str,
    /// The part of this light group; none for all light.
    pub group: Option<&'static str>,
    /// The value in the SI unit.
    pub value: f64,
}

impl Answer {
    const fn new(sensor: &'static str, index: usize, quantity: &'static str, value: f64) -> Self {
        Self {
            sensor,
            index,
            quantity,
            group: None,
            value,
        }
    }

    const fn of_group(self, group: &'static str) -> Self {
        Self {
            group: Some(group),
            ..self
        }
    }

    /// The unit and the estimate among these readings.
    pub fn find(&self, readings: &[Reading]) -> Option<(String, Estimate)> {
        let is_ours = |reading: &&Reading| {
            reading.sensor == self.sensor
                && reading.index == self.index
                && reading.quantity == self.quantity
        };
        let reading = readings.iter().find(is_ours)?;
        let estimate = match self.group {
            None => reading.estimate,
            Some(group) => reading.groups.iter().find(|(name, _)| name == group)?.1,
        };
        Some((reading.unit.clone(), estimate))
    }
}

macro_rules! scene {
    ($file:literal, $answers:expr) => {
        Verified {
            file: $file,
            text: include_str!(concat!("../../../../scenes/", $file)),
            answers: $answers,
        }
    };
}

/// atan(1/√2), half the angle between two neighbouring edges' diagonals in a cube.
const ATAN_FRAC_1_SQRT_2: f64 = 0.615_479_708_670_387_3;

/// All of them.
pub const SUITE: &[Verified] = &[
    scene!(
        "point-light.toml",
        &[
            Answer::new("points", 0, "irradiance", 100.0),
            Answer::new("points", 1, "irradiance", 50.0 * FRAC_1_SQRT_2),
            Answer::new("square", 0, "flux", 4.0 * PI / 6.0 * 100.0),
        ]
    ),
    scene!(
        "directional.toml",
        &[
            Answer::new("level point", 0, "irradiance", 100.0),
            Answer::new("level square", 0, "flux", 400.0),
            Answer::new("leaning square", 0, "flux", 200.0),
        ]
    ),
    scene!(
        "sphere-light.toml",
        &[
            Answer::new("points", 0, "irradiance", 100.0),
            Answer::new("points", 1, "irradiance", 50.0 * FRAC_1_SQRT_2),
            Answer::new("square", 0, "flux", 4.0 * PI / 6.0 * 100.0),
        ]
    ),
    scene!(
        "emitting-square.toml",
        &[
            Answer::new(
                "level",
                0,
                "irradiance",
                4.0 * FRAC_1_SQRT_2 * ATAN_FRAC_1_SQRT_2
            ),
            Answer::new(
                "upright",
                0,
                "irradiance",
                FRAC_PI_4 - FRAC_1_SQRT_2 * ATAN_FRAC_1_SQRT_2
            ),
        ]
    ),
    scene!(
        "open-sky.toml",
        &[
            Answer::new("points", 0, "irradiance", PI),
            Answer::new("points", 1, "irradiance", 0.75 * PI),
            Answer::new("points", 2, "irradiance", 0.5 * PI),
            Answer::new("small sphere", 0, "scalar irradiance", 3.0 * PI),
        ]
    ),
    scene!(
        "furnace.toml",
        &[
            Answer::new("radiance", 0, "radiance", 50.0),
            Answer::new("radiance", 1, "radiance", 50.0),
            Answer::new("irradiance", 0, "irradiance", 50.0 * PI),
            Answer::new("irradiance", 1, "irradiance", 50.0 * PI),
            Answer::new("scalar irradiance", 0, "scalar irradiance", 200.0 * PI),
        ]
    ),
    scene!(
        "closed-room.toml",
        &[
            Answer::new("arriving", 0, "luminous flux", 200_000.0),
            Answer::new("absorbed", 0, "luminous flux", 10_000.0),
        ]
    ),
    scene!(
        "working-day.toml",
        &[Answer::new("desk", 0, "illuminance", 250.0)]
    ),
    scene!(
        "lamps-equal.toml",
        &[
            Answer::new("around all", 0, "luminous flux", 1000.0).of_group("point"),
            Answer::new("around all", 0, "luminous flux", 1000.0).of_group("spot"),
            Answer::new("under each", 2, "illuminance", 1000.0 / (4.0 * PI) / 400.0)
                .of_group("sphere"),
            Answer::new("under each", 3, "illuminance", 1000.0 / PI / 400.0025).of_group("disc"),
        ]
    ),
];
