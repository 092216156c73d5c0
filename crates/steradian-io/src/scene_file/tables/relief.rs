//! Keys of the pictures that turn normals.

use steradian::quantity::Length;

use super::textures::{INTERPOLATION, OFFSET, SCALE, WRAP};
use crate::scene_file::keys::{Key, Record, Value};
use crate::scene_file::value::Read;

pub const NORMAL_MAP_KEY: Key = Key::optional(
    "normal_map",
    Value::Table(&NORMAL_MAP),
    "Normals that stand for those of the surface; not of two-sided materials",
);
pub const BUMP_MAP_KEY: Key = Key::optional(
    "bump_map",
    Value::Table(&BUMP_MAP),
    "Heights that turn the normals of the surface, instead of `normal_map`; not of two-sided materials",
);

/// A picture of normals.
pub const NORMAL_MAP: Record = Record {
    noun: "a map of normals",
    keys: &[
        Key::required(
            "texture",
            Value::File,
            "A picture of linear numbers: red, green and blue are 0.5 + 0.5 (x, y, z), with x along u, y along v and z out of the front",
        ),
        SCALE,
        OFFSET,
        WRAP,
        INTERPOLATION,
        Key::default(
            "strength",
            Value::Number,
            "1",
            "What x and y are multiplied by",
        ),
    ],
};

/// A picture of heights.
pub const BUMP_MAP: Record = Record {
    noun: "a map of heights",
    keys: &[
        Key::required(
            "texture",
            Value::File,
            "A picture of linear numbers: the mean of red, green and blue is the height over the front, in parts of `height`",
        ),
        SCALE,
        OFFSET,
        WRAP,
        INTERPOLATION,
        Key::required("height", Length::VALUE, "How high white is over black"),
    ],
};
