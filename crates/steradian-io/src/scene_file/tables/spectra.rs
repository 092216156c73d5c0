//! Keys of spectra.

use steradian::quantity::{Quantity, Temperature};

use crate::scene_file::keys::{Key, Record, Value};

pub const SPECTRUM_NAMES: &[&str] = &["broadband", "rgb", "spectral"];
pub const SPECTRUM: Value = Value::Either(&[Value::Choice(SPECTRUM_NAMES), Value::Table(&MODE)]);

pub const RESPONSE_NAMES: &[&str] = &[
    "auto",
    "radiant",
    "photopic",
    "scotopic",
    "xyz",
    "par",
    "melanopic",
];
pub const RESPONSE: Value = Value::Either(&[Value::Choice(RESPONSE_NAMES), Value::Table(&TABLE)]);

pub const ILLUMINANT_NAMES: &[&str] = &[
    "A", "D50", "D55", "D65", "D75", "E", "FL2", "FL7", "FL11", "HP1", "LED-B3",
];
pub const LIGHT_SPECTRUM: Value = Value::Either(&[
    Value::Lanes,
    Value::Choice(ILLUMINANT_NAMES),
    Value::Table(&LIGHT_SHAPE),
]);

/// Wavelengths in nm at which a black body is tabulated, as far as a run may reach.
pub const BLACKBODY_RANGE: [f64; 2] = [280.0, 4000.0];
/// Straight lines between them are off by less than 4·10⁻⁵ of the radiance at 2700 K and 400 nm.
pub const BLACKBODY_STEP: f64 = 0.5;

pub const MODE: Record = Record {
    noun: "what a spectrum stands for",
    keys: &[
        Key::one_of(
            "lanes",
            "bands",
            Value::List(&Value::Text),
            "Names of one to four bands; `visible` is the one that lumens belong to",
        ),
        Key::one_of(
            "lanes",
            "range",
            Value::Wavelengths,
            "First and last wavelength, within 280 to 4000 nm; \"spectral\" is 360 to 830 nm",
        ),
    ],
};

pub const TABLE: Record = Record {
    noun: "a table by wavelength",
    keys: &[FILE, COLUMN],
};

const FILE: Key = Key::required(
    "file",
    Value::File,
    "A CSV file whose first column holds wavelengths in nm",
);
const COLUMN: Key = Key::optional(
    "column",
    Value::Text,
    "Name of its column; the second unless given",
);

pub const LIGHT_SHAPE: Record = Record {
    noun: "the spectrum of a light",
    keys: &[
        Key::one_of(
            "shape",
            "illuminant",
            Value::Choice(ILLUMINANT_NAMES),
            "An illuminant of the CIE",
        ),
        Key::one_of(
            "shape",
            "blackbody",
            Value::Quantity(&[Temperature::TABLE]),
            "Temperature of a black body",
        ),
        Key::one_of(
            "shape",
            "daylight",
            Value::Quantity(&[Temperature::TABLE]),
            "Correlated colour temperature of a phase of daylight, 4000 K to 25000 K",
        ),
        Key::one_of(
            "shape",
            "file",
            Value::File,
            "A CSV file whose first column holds wavelengths in nm",
        ),
        COLUMN.beside("file"),
    ],
};
