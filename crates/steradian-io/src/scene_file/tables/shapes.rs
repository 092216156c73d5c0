//! Keys of shapes, and of the surfaces that sensors have of their own.

use steradian::quantity::{
    Amount, Angle, Exitance, Flux, Length, Luminance, LuminousExitance, LuminousFlux, Radiance,
};

use super::schedules::SCHEDULE_KEY;
use super::{EDGES, EMISSION_PATTERN, LIGHT_SPECTRUM, MATERIAL, POINTS};
use crate::scene_file::keys::{Family, Key, Kind, Record, Value};
use crate::scene_file::up::UpAxis;
use crate::scene_file::value::Read;

const LENGTH: Value = Length::VALUE;
pub const FACE_NAMES: &[&str] = &["floor", "ceiling", "x-", "x+", "y-", "y+", "z-", "z+"];
pub const SCALE: Value = Value::Either(&[Value::Number, Value::Direction]);

const RECTANGLE: &[Key] = &[
    Key::required("origin", Value::Point, "A corner"),
    Key::required(
        "edges",
        EDGES,
        "The two edges that leave it; the normal is the first × the second",
    ),
];
const POLYGON: &[Key] = &[
    Key::required(
        "vertices",
        POINTS,
        "The boundary, counter-clockwise as seen from the front",
    ),
    Key::default("holes", Value::List(&POINTS), "[]", "Boundaries of holes"),
];
const DISC: &[Key] = &[
    Key::required("center", Value::Point, "The centre"),
    Key::required("normal", Value::Direction, "The front's normal"),
    Key::required("radius", LENGTH, "Outer radius"),
    Key::default(
        "inner_radius",
        LENGTH,
        "0",
        "Radius of a hole in the middle",
    ),
];
const SPHERE: &[Key] = &[
    Key::required("center", Value::Point, "The centre"),
    Key::required("radius", LENGTH, "The radius"),
    Key::default(
        "inside",
        Value::Flag,
        "false",
        "Whether the front is the inside",
    ),
    Key::default(
        "ports",
        Value::List(&Value::Table(&PORT)),
        "[]",
        "Circular openings",
    ),
];
const BOX: &[Key] = &[
    Key::required("min", Value::Point, "The least corner"),
    Key::required("max", Value::Point, "The greatest corner"),
    Key::default(
        "inside",
        Value::Flag,
        "false",
        "Whether the fronts face inwards, as in a room",
    ),
    Key::optional(
        "faces",
        Value::Table(&FACES),
        "Materials by face; a later entry wins",
    ),
    Key::default(
        "openings",
        Value::List(&Value::Table(&OPENING)),
        "[]",
        "Rectangular openings in faces",
    ),
];
const MESH: &[Key] = &[
    Key::one_of(
        "triangles",
        "file",
        Value::File,
        "An OBJ, PLY, STL or glTF file, relative to the scene file; its materials are used where `material` is absent",
    ),
    Key::one_of(
        "triangles",
        "vertices",
        POINTS,
        "Vertices of an inline mesh",
    ),
    Key::required(
        "triangles",
        Value::List(&Value::Array(&Value::Count, 3)),
        "Triples of vertex numbers from 0, counter-clockwise from the front",
    )
    .beside("vertices"),
    Key::default(
        "unit",
        Value::LengthUnit,
        "\"m\"",
        "Unit of the numbers in the file",
    )
    .beside("file"),
    Key::optional(
        "up",
        UpAxis::VALUE,
        "The axis that points up in the mesh file; that of the scene unless given, or unless the format says it",
    )
    .beside("file"),
];
const GROUND: &[Key] = &[Key::default("height", LENGTH, "0", "Its height")];

const RECTANGLE_KIND: Kind = Kind::new("rectangle", "A rectangle or parallelogram", RECTANGLE);
const POLYGON_KIND: Kind = Kind::new("polygon", "A plane polygon", POLYGON);
const DISC_KIND: Kind = Kind::new("disc", "A disc or annulus", DISC);
const SPHERE_KIND: Kind = Kind::new("sphere", "A sphere", SPHERE);

pub const SHAPES: Family = Family {
    noun: "shape",
    tag: "kind",
    untagged: None,
    kinds: &[
        RECTANGLE_KIND,
        POLYGON_KIND,
        DISC_KIND,
        SPHERE_KIND,
        Kind::new("box", "A box along the axes", BOX),
        Kind::new("mesh", "Triangles from a file or inline", MESH),
        Kind::new("ground", "The infinite level plane, front up", GROUND),
        Kind::not_yet("cylinder"),
        Kind::not_yet("cone"),
    ],
    common: &[
        Key::optional("name", Value::Text, "What sensors call it"),
        Key::optional(
            "material",
            MATERIAL,
            "Its material; that of the mesh file if absent, and black where there is none",
        ),
        TRANSFORM_KEY,
        REPEAT_KEY,
        Key::optional(
            "emission",
            Value::Table(&EMISSION),
            "What it emits, evenly in all directions of each side",
        ),
    ],
};

/// What may be the virtual surface of a flux sensor.
pub const SURFACES: Family = Family {
    noun: "surface",
    tag: "kind",
    untagged: None,
    kinds: &[RECTANGLE_KIND, POLYGON_KIND, DISC_KIND, SPHERE_KIND],
    common: &[TRANSFORM_KEY],
};

const TRANSFORM_KEY: Key = Key::default(
    "transform",
    Value::List(&Value::Table(&TRANSFORM_STEP)),
    "[]",
    "Steps, applied in order",
);
pub const REPEAT_KEY: Key =
    Key::optional("repeat", Value::Table(&REPEAT), "Copies at a fixed step");

pub const PORT: Record = Record {
    noun: "a port",
    keys: &[
        Key::required(
            "direction",
            Value::Direction,
            "From the centre to the middle of the port",
        ),
        Key::required(
            "half_angle",
            Angle::VALUE,
            "Half the angle it subtends at the centre",
        ),
    ],
};

pub const FACES: Record = Record {
    noun: "the faces",
    keys: &[
        Key::optional("floor", MATERIAL, "The lower face"),
        Key::optional("ceiling", MATERIAL, "The upper face"),
        Key::optional("walls", MATERIAL, "The four upright faces"),
        Key::optional("x-", MATERIAL, "The face of least x"),
        Key::optional("x+", MATERIAL, "The face of greatest x"),
        Key::optional("y-", MATERIAL, "The face of least y"),
        Key::optional("y+", MATERIAL, "The face of greatest y"),
        Key::optional("z-", MATERIAL, "The face of least z"),
        Key::optional("z+", MATERIAL, "The face of greatest z"),
    ],
};

pub const OPENING: Record = Record {
    noun: "an opening",
    keys: &[
        Key::required("face", Value::Choice(FACE_NAMES), "The face it is in"),
        Key::required(
            "rect",
            Value::Array(&LENGTH, 4),
            "[u, v, width, height] from the face's least corner, u along its first axis",
        ),
        Key::optional("material", MATERIAL, "What fills it; nothing unless given"),
    ],
};

pub const TRANSFORM_STEP: Record = Record {
    noun: "a step of a transform",
    keys: &[
        Key::one_of(
            "step",
            "rotate",
            Angle::VALUE,
            "Turn by this angle, counter-clockwise as seen from the tip of the axis",
        ),
        Key::one_of("step", "translate", Value::Displacement, "Move"),
        Key::one_of(
            "step",
            "scale",
            SCALE,
            "Scale about the origin, by one number or one for each axis",
        ),
        Key::required("axis", Value::Direction, "The axis of rotation").beside("rotate"),
        Key::default(
            "about",
            Value::Point,
            "[0, 0, 0]",
            "A point on the axis of rotation",
        )
        .beside("rotate"),
    ],
};

pub const REPEAT: Record = Record {
    noun: "a repeat",
    keys: &[
        Key::required(
            "count",
            Value::OneOrMany(&Value::Count),
            "Copies, the original counted, along each axis of the array",
        ),
        Key::required(
            "step",
            Value::OneOrMany(&Value::Displacement),
            "From one copy to the next, for each axis of the array",
        ),
    ],
};

pub const EMISSION: Record = Record {
    noun: "an emission",
    keys: &[
        Key::one_of(
            "amount",
            "radiance",
            Amount::<Radiance, Luminance>::VALUE,
            "Of each emitting side, reflected light not counted",
        ),
        Key::one_of(
            "amount",
            "exitance",
            Amount::<Exitance, LuminousExitance>::VALUE,
            "Of each emitting side, reflected light not counted",
        ),
        Key::one_of(
            "amount",
            "flux",
            Amount::<Flux, LuminousFlux>::VALUE,
            "Of all emitting sides together",
        ),
        Key::optional(
            "spectrum",
            LIGHT_SPECTRUM,
            "Shape of the spectrum; white unless given",
        ),
        Key::optional(
            "texture",
            EMISSION_PATTERN,
            "How it varies over the surface: the amount is multiplied by it, or where it is a flux, by its ratio to its mean",
        ),
        Key::default("two_sided", Value::Flag, "false", "Whether both sides emit"),
        Key::optional(
            "group",
            Value::Text,
            "The light group whose share is reported apart",
        ),
        SCHEDULE_KEY,
    ],
};
