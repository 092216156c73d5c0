//! Keys of lights.

use steradian::quantity::{
    Amount, Angle, Flux, Illuminance, Intensity, Irradiance, Luminance, LuminousFlux,
    LuminousIntensity, Radiance,
};

use super::LIGHT_SPECTRUM;
use super::schedules::SCHEDULE_KEY;
use super::shapes::REPEAT_KEY;
use crate::scene_file::keys::{Family, Key, Kind, Record, Value};
use crate::scene_file::value::Read;

const INTENSITY: Value = Amount::<Intensity, LuminousIntensity>::VALUE;
pub const FALLOFF_NAMES: &[&str] = &["uniform"];
pub const FALLOFF_VALUE: Value =
    Value::Either(&[Value::Choice(FALLOFF_NAMES), Value::Table(&FALLOFF)]);

const POSITION: Key = Key::required("position", Value::Point, "Where it is");
const FLUX_KEY: Key = Key::one_of(
    "amount",
    "flux",
    Amount::<Flux, LuminousFlux>::VALUE,
    "Total flux",
);

pub const LIGHTS: Family = Family {
    noun: "light",
    tag: "kind",
    untagged: None,
    kinds: &[
        Kind::new(
            "point",
            "Radiates alike in all directions",
            &[
                POSITION,
                Key::one_of("amount", "intensity", INTENSITY, "In every direction"),
                FLUX_KEY,
                REPEAT_KEY,
            ],
        ),
        Kind::new(
            "spot",
            "Radiates into a cone",
            &[
                POSITION,
                Key::required("direction", Value::Direction, "The axis of the beam"),
                Key::one_of(
                    "beam",
                    "cutoff",
                    Angle::VALUE,
                    "Half angle beyond which it is dark",
                ),
                Key::one_of(
                    "beam",
                    "beam_angle",
                    Angle::VALUE,
                    "Full angle at which the intensity is half the peak; it falls off as a power of the cosine",
                ),
                Key::default(
                    "falloff",
                    FALLOFF_VALUE,
                    "\"uniform\"",
                    "How the intensity falls off towards the cutoff",
                )
                .beside("cutoff"),
                Key::one_of("amount", "intensity", INTENSITY, "Peak intensity"),
                FLUX_KEY,
                REPEAT_KEY,
            ],
        ),
        Kind::new(
            "directional",
            "Parallel light from infinitely far away",
            &[
                Key::required("direction", Value::Direction, "The way the light travels"),
                Key::required(
                    "irradiance",
                    Amount::<Irradiance, Illuminance>::VALUE,
                    "On a plane that faces it",
                ),
            ],
        ),
        Kind::new(
            "environment",
            "The same radiance from everywhere",
            &[
                Key::required(
                    "radiance",
                    Amount::<Radiance, Luminance>::VALUE,
                    "Its radiance",
                ),
                Key::not_yet("file"),
            ],
        ),
        Kind::not_yet("luminaire"),
        Kind::not_yet("sun"),
        Kind::not_yet("sky"),
    ],
    common: &[
        Key::optional("name", Value::Text, "What reports call it"),
        Key::optional(
            "group",
            Value::Text,
            "The light group whose share is reported apart",
        ),
        Key::optional(
            "spectrum",
            LIGHT_SPECTRUM,
            "Shape of the spectrum; white unless given",
        ),
        SCHEDULE_KEY,
    ],
};

pub const FALLOFF: Record = Record {
    noun: "a falloff",
    keys: &[
        Key::one_of(
            "falloff",
            "power",
            Value::Number,
            "The intensity goes with this power of the cosine",
        ),
        Key::one_of(
            "falloff",
            "inner",
            Angle::VALUE,
            "Constant out to this half angle, then smooth",
        ),
    ],
};
