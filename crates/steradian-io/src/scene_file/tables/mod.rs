//! The rows of the table of keys: every section, kind and key of a scene file.
//!
//! A key's row is all that the schema, the help text and the hints know of it; what it means is in the reader of
//! its section.

mod lights;
mod materials;
mod principled;
mod relief;
mod schedules;
mod sensors;
mod shapes;
mod textures;
mod spectra;

use steradian::quantity::LuminousEfficacy;
use steradian::scene::description::Response;

use super::keys::{Form, Key, Record, Section, Value};
use super::up::UpAxis;
use super::value::Read;

pub use lights::{FALLOFF, FALLOFF_NAMES, FALLOFF_VALUE, LIGHTS};
pub use materials::{ABSORPTION, MATERIALS};
pub use relief::{BUMP_MAP, NORMAL_MAP};
pub use schedules::{SCHEDULE, SCHEDULE_TABLE};
pub use sensors::{GRID, PROJECTION_NAMES, SENSORS};
pub use shapes::{
    EMISSION, FACE_NAMES, FACES, OPENING, PORT, REPEAT, SCALE, SHAPES, SURFACES, TRANSFORM_STEP,
};
pub use spectra::{
    BLACKBODY_RANGE, BLACKBODY_STEP, ILLUMINANT_NAMES, LIGHT_SHAPE, LIGHT_SPECTRUM, MODE, RESPONSE,
    RESPONSE_NAMES, SPECTRUM, SPECTRUM_NAMES, TABLE,
};

pub use textures::{
    CHECKERBOARD, EMISSION_CHECKERBOARD, EMISSION_PATTERN, EMISSION_TEXTURE, EMISSION_VERTEX_COLOR,
    NUMBER, NUMBER_TEXTURE, OPACITY, OPACITY_TEXTURE, TEXTURE, VARYING, VERTEX_COLOR,
};

const MATERIAL: Value = Value::Name("material");
const SHAPE: Value = Value::Name("shape");
const POINTS: Value = Value::List(&Value::Point);
const EDGES: Value = Value::Array(&Value::Displacement, 2);

/// Every section.
pub const SECTIONS: &[Section] = &[
    Section {
        name: "scene",
        doc: "The scene as a whole",
        form: Form::One(&SCENE),
    },
    Section {
        name: "materials",
        doc: "What surfaces are made of, by name",
        form: Form::Named(&MATERIALS),
    },
    Section {
        name: "shapes",
        doc: "Surfaces; one with an emission is an area light",
        form: Form::List(&SHAPES),
    },
    Section {
        name: "lights",
        doc: "Lights without a surface",
        form: Form::List(&LIGHTS),
    },
    Section {
        name: "sensors",
        doc: "What is measured",
        form: Form::List(&SENSORS),
    },
    Section {
        name: "site",
        doc: "",
        form: Form::NotYet,
    },
];

pub const SCENE: Record = Record {
    noun: "the scene",
    keys: &[
        Key::default("name", Value::Text, "\"\"", "A title for reports"),
        Key::default(
            "spectrum",
            SPECTRUM,
            "\"broadband\"",
            "What the numbers of a spectrum stand for",
        ),
        Key::default(
            "response",
            Response::VALUE,
            "\"auto\"",
            "What sensors report: watts, lumens, or what the lights are given in",
        ),
        Key::default(
            "up",
            UpAxis::VALUE,
            "\"z\"",
            "The axis that points up in this file; \"y\" is turned to z on reading: (x, y, z) becomes (x, -z, y)",
        ),
        Key::optional(
            "luminous_efficacy",
            LuminousEfficacy::VALUE,
            "Luminous efficacy K that links watts and lumens",
        ),
    ],
};
