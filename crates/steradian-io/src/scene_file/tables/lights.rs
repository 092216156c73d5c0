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

const EMIT_NAMES: &[&str] = &["opening", "point"];
const FILE_UNIT_NAMES: &[&str] = &["cd", "mW/sr"];

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
            "Radiance from everywhere: the same, or that of a picture of all directions",
            &[
                Key::one_of(
                    "environment",
                    "radiance",
                    Amount::<Radiance, Luminance>::VALUE,
                    "The same radiance from everywhere",
                ),
                Key::one_of(
                    "environment",
                    "file",
                    Value::File,
                    "A picture (HDR or EXR; PNG and JPEG as sRGB) of all directions: azimuth along its width, from overhead down along its height",
                ),
                Key::optional(
                    "middle",
                    Value::Direction,
                    "Horizontal direction in which the middle of the picture is seen; +y unless given",
                )
                .beside("file"),
                Key::default(
                    "unit",
                    Amount::<Radiance, Luminance>::VALUE,
                    "\"1 W/(m2 sr)\"",
                    "What a 1 of the picture stands for",
                )
                .beside("file"),
                Key::optional(
                    "irradiance",
                    Amount::<Irradiance, Illuminance>::VALUE,
                    "Instead of `unit`: on a horizontal plane that faces up, by all of the picture above the horizon",
                )
                .beside("file"),
            ],
        ),
        Kind::new(
            "luminaire",
            "A luminaire as an IES (LM-63, TM-33) or EULUMDAT file tells it",
            &[
                Key::required("file", Value::File, "The file (.ies, .ldt or TM-33 .xml)"),
                Key::required(
                    "position",
                    Value::Point,
                    "The middle of its luminous opening",
                ),
                Key::optional(
                    "aim",
                    Value::Direction,
                    "The way its light goes: the direction γ = 0; straight down unless given",
                ),
                Key::default(
                    "c0",
                    Value::Direction,
                    "[1, 0, 0]",
                    "Towards its half plane C0, as far as this is across the aim",
                ),
                Key::optional(
                    "emit",
                    Value::Choice(EMIT_NAMES),
                    "Where its light leaves: the luminous opening of the file, which can be seen, or a point; the opening unless the file has none",
                ),
                Key::optional(
                    "flux",
                    Amount::<Flux, LuminousFlux>::VALUE,
                    "Flux of the luminaire, lamps and losses included, to which the file's intensities are scaled; what the file says unless given",
                ),
                Key::default(
                    "dimming",
                    Value::Number,
                    "1",
                    "Share of its flux that it gives, 0 to 1",
                ),
                Key::default(
                    "maintenance_factor",
                    Value::Number,
                    "1",
                    "Share of its flux that is left as it ages, above 0 and up to 1",
                ),
                Key::optional(
                    "file_unit",
                    Value::Choice(FILE_UNIT_NAMES),
                    "Unit of the file's intensities; what the file says unless given, and cd where it does not",
                ),
                REPEAT_KEY,
            ],
        ),
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
