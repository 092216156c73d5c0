//! Keys of textures: on reflectance, emission and opacity.

use crate::scene_file::keys::{Key, Record, Value};

pub const ENCODINGS: Value = Value::Choice(&["srgb", "linear"]);
const PAIR: Value = Value::Array(&Value::Number, 2);

const PICTURE: Key = Key::required(
    "texture",
    Value::File,
    "A picture (PNG, JPEG, EXR, HDR), relative to the scene file, laid from the texture coordinates (0, 0) at its lower left to (1, 1)",
);
const ENCODING: Key = Key::default(
    "encoding",
    ENCODINGS,
    "\"srgb\"",
    "What integers in the picture stand for; floats are linear",
);
pub const SCALE: Key = Key::default(
    "scale",
    PAIR,
    "[1, 1]",
    "How often it is repeated along each texture coordinate",
);
pub const OFFSET: Key = Key::default(
    "offset",
    PAIR,
    "[0, 0]",
    "Added to the texture coordinates after `scale`",
);
pub const WRAP: Key = Key::default(
    "wrap",
    Value::Choice(&["repeat", "mirror", "clamp"]),
    "\"repeat\"",
    "How the picture goes on beyond its edge",
);
const NUMBER_FACTOR: Key = Key::default(
    "factor",
    Value::Number,
    "1",
    "What the texture is multiplied by",
);
pub const INTERPOLATION: Key = Key::default(
    "interpolation",
    Value::Choice(&["bilinear", "nearest"]),
    "\"bilinear\"",
    "Between texels, in linear light, or that of the nearest one",
);
const SQUARES: Key = Key::required(
    "checkerboard",
    Value::Array(&Value::Lanes, 2),
    "Two values in turn, on squares that are 1 wide in texture coordinates after `scale`",
);
const OF_VERTICES: Key = Key::required(
    "vertex_color",
    Value::Flag,
    "true: the colours of the mesh's vertices",
);
const FACTOR: Key = Key::default(
    "factor",
    Value::Lanes,
    "1",
    "What the texture is multiplied by",
);

/// A picture as a reflectance.
pub const TEXTURE: Record = Record {
    noun: "a texture",
    keys: &[
        PICTURE,
        ENCODING,
        SCALE,
        OFFSET,
        WRAP,
        INTERPOLATION,
        FACTOR,
    ],
};

/// A checkerboard as a reflectance.
pub const CHECKERBOARD: Record = Record {
    noun: "a checkerboard",
    keys: &[SQUARES, SCALE, OFFSET, FACTOR],
};

/// The vertices' colours as a reflectance.
pub const VERTEX_COLOR: Record = Record {
    noun: "a vertex colour",
    keys: &[OF_VERTICES, FACTOR],
};

/// A picture of what a surface emits.
pub const EMISSION_TEXTURE: Record = Record {
    noun: "a texture of an emission",
    keys: &[PICTURE, ENCODING, SCALE, OFFSET, WRAP, INTERPOLATION],
};

/// A checkerboard of what a surface emits.
pub const EMISSION_CHECKERBOARD: Record = Record {
    noun: "a checkerboard of an emission",
    keys: &[SQUARES, SCALE, OFFSET],
};

/// The vertices' colours as an emission.
pub const EMISSION_VERTEX_COLOR: Record = Record {
    noun: "a vertex colour of an emission",
    keys: &[OF_VERTICES],
};

/// A picture of opacity.
pub const OPACITY_TEXTURE: Record = Record {
    noun: "a texture of an opacity",
    keys: &[
        Key::required(
            "texture",
            Value::File,
            "A picture whose alpha, or whose mean of red, green and blue where alpha is 1 throughout, is the opacity",
        ),
        SCALE,
        OFFSET,
        WRAP,
        INTERPOLATION,
        NUMBER_FACTOR,
        Key::optional(
            "cutoff",
            Value::Number,
            "Opaque from this opacity on and absent below it, instead of partly so",
        ),
    ],
};

/// One value everywhere, or a texture.
pub const VARYING: Value = Value::Either(&[
    Value::Lanes,
    Value::Table(&TEXTURE),
    Value::Table(&CHECKERBOARD),
    Value::Table(&VERTEX_COLOR),
]);

/// A picture of a number.
pub const NUMBER_TEXTURE: Record = Record {
    noun: "a texture of a number",
    keys: &[
        Key::required(
            "texture",
            Value::File,
            "A picture of linear numbers (PNG, JPEG, EXR, HDR)",
        ),
        Key::default(
            "channel",
            Value::Choice(&["red", "green", "blue", "alpha"]),
            "\"red\"",
            "The channel that holds the number",
        ),
        SCALE,
        OFFSET,
        WRAP,
        INTERPOLATION,
        NUMBER_FACTOR,
    ],
};

/// One number everywhere, or a texture.
pub const NUMBER: Value = Value::Either(&[Value::Number, Value::Table(&NUMBER_TEXTURE)]);

/// What varies over an emitting surface.
pub const EMISSION_PATTERN: Value = Value::Either(&[
    Value::Table(&EMISSION_TEXTURE),
    Value::Table(&EMISSION_CHECKERBOARD),
    Value::Table(&EMISSION_VERTEX_COLOR),
]);

/// One opacity everywhere, or a texture.
pub const OPACITY: Value = Value::Either(&[Value::Number, Value::Table(&OPACITY_TEXTURE)]);
