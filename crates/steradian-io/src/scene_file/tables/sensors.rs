//! Keys of sensors.

use steradian::quantity::{Angle, Length};
use steradian::scene::description::{FluxOf, GridCount, Response, Side};

use super::{EDGES, POINTS, SHAPE, SURFACES};
use crate::scene_file::keys::{Family, Key, Kind, Record, Value};
use crate::scene_file::value::Read;

const RECEIVERS: &[Key] = &[
    Key::one_of(
        "place",
        "points",
        Value::List(&Value::PointAndDirection),
        "[x, y, z, nx, ny, nz] of each, n the normal",
    ),
    Key::one_of(
        "place",
        "grid",
        Value::Table(&GRID),
        "The cell centres of a grid",
    ),
    Key::one_of("place", "shape", SHAPE, "Points spread over a shape"),
    Key::default("side", Side::VALUE, "\"front\"", "The side of the shape").beside("shape"),
    Key::default("count", Value::Count, "16", "How many points").beside("shape"),
    Key::default(
        "offset",
        Length::VALUE,
        "0",
        "Their distance from the surface",
    )
    .beside("shape"),
];
const CYLINDER_POINTS: Key = Key::one_of("place", "points", POINTS, "[x, y, z] of each");
const CYLINDER_GRID: Key = Key::one_of(
    "place",
    "grid",
    Value::Table(&GRID),
    "The cell centres of a grid, whose normal does not matter",
);
const AXIS: Key = Key::optional(
    "axis",
    Value::Direction,
    "Axis of the cylinders; up in the scene unless given",
);
const CYLINDER: &[Key] = &[CYLINDER_POINTS, CYLINDER_GRID, AXIS];
const HALF_CYLINDER: &[Key] = &[
    CYLINDER_POINTS,
    CYLINDER_GRID,
    AXIS,
    Key::required("facing", Value::Direction, "What the half faces"),
];
const FLUX_SENSOR: &[Key] = &[
    Key::one_of("surface", "shape", SHAPE, "A shape of the scene"),
    Key::one_of(
        "surface",
        "surface",
        Value::Kinds(&SURFACES),
        "A surface of its own that does not block light, counted on its front",
    ),
    Key::default("side", Side::VALUE, "\"front\"", "The side of the shape").beside("shape"),
    Key::default("of", FluxOf::VALUE, "\"incident\"", "Which flux is counted"),
];
const RAYS: &[Key] = &[Key::required(
    "rays",
    Value::List(&Value::PointAndDirection),
    "[x, y, z, dx, dy, dz] of each, d the way the sensor looks",
)];

/// The names of projections.
pub const PROJECTION_NAMES: &[&str] = &[
    "perspective",
    "thin-lens",
    "orthographic",
    "panorama",
    "fisheye-equidistant",
    "fisheye-equisolid",
    "fisheye-hemispherical",
];
const PROJECTION: Value = Value::Choice(PROJECTION_NAMES);
const THIN_LENS: &[&str] = &["thin-lens"];
const WITH_FOV: &[&str] = &[
    "perspective",
    "thin-lens",
    "fisheye-equidistant",
    "fisheye-equisolid",
    "fisheye-hemispherical",
];

pub const SENSORS: Family = Family {
    noun: "sensor",
    tag: "kind",
    untagged: None,
    kinds: &[
        Kind::new("irradiance", "Flux per area arriving at points", RECEIVERS),
        Kind::new(
            "illuminance",
            "Luminous flux per area arriving at points",
            RECEIVERS,
        ),
        Kind::new("flux", "Flux through or from a surface", FLUX_SENSOR),
        Kind::new(
            "luminous-flux",
            "Luminous flux through or from a surface",
            FLUX_SENSOR,
        ),
        Kind::new("radiance", "Radiance arriving along rays", RAYS),
        Kind::new("luminance", "Luminance arriving along rays", RAYS),
        Kind::new(
            "scalar-irradiance",
            "Radiance arriving at points, integrated over all directions",
            &[Key::required("points", POINTS, "[x, y, z] of each")],
        ),
        Kind::new(
            "cylindrical-irradiance",
            "Mean irradiance of the side of a small cylinder",
            CYLINDER,
        ),
        Kind::new(
            "cylindrical-illuminance",
            "Mean illuminance of the side of a small cylinder",
            CYLINDER,
        ),
        Kind::new(
            "semicylindrical-irradiance",
            "Mean irradiance of the half of a small cylinder that faces a direction",
            HALF_CYLINDER,
        ),
        Kind::new(
            "semicylindrical-illuminance",
            "Mean illuminance of the half of a small cylinder that faces a direction",
            HALF_CYLINDER,
        ),
        Kind::new(
            "camera",
            "A picture of radiance",
            &[
                Key::required("position", Value::Point, "Where it is"),
                Key::required(
                    "look_at",
                    Value::Point,
                    "The point in the middle of the picture",
                ),
                Key::optional(
                    "up",
                    Value::Direction,
                    "Up in the picture; up in the scene unless given",
                ),
                Key::default(
                    "projection",
                    PROJECTION,
                    "\"perspective\"",
                    "How directions become places in the picture",
                ),
                Key::required(
                    "fov",
                    Angle::VALUE,
                    "Full angle of view: across the width, or across the circle of a fisheye",
                )
                .with("projection", WITH_FOV),
                Key::required("aperture_radius", Length::VALUE, "Radius of the lens")
                    .with("projection", THIN_LENS),
                Key::required(
                    "focus_distance",
                    Length::VALUE,
                    "Distance of the plane that is sharp, along the axis",
                )
                .with("projection", THIN_LENS),
                Key::required("width", Length::VALUE, "Width of the picture in the scene")
                    .with("projection", &["orthographic"]),
                Key::required(
                    "resolution",
                    Value::Array(&Value::Count, 2),
                    "Width and height in pixels",
                ),
            ],
        ),
        Kind::not_yet("intensity"),
    ],
    common: &[
        Key::required("name", Value::Text, "What reports call it; no two alike"),
        Key::optional(
            "response",
            Response::VALUE,
            "What it reports, if not what the scene says",
        ),
        Key::optional(
            "bins",
            Value::Intervals,
            "Intervals of wavelength that are read one by one",
        ),
        Key::default(
            "per_nm",
            Value::Flag,
            "false",
            "Mean per nm in each interval, instead of the total",
        )
        .beside("bins"),
    ],
};

pub const GRID: Record = Record {
    noun: "a grid",
    keys: &[
        Key::required("origin", Value::Point, "A corner"),
        Key::required("edges", EDGES, "Its two sides"),
        Key::one_of(
            "number",
            "count",
            Value::Array(&Value::Count, 2),
            "Cells along each side",
        ),
        Key::one_of(
            "number",
            "spacing",
            GridCount::VALUE,
            "As many cells as EN 12464-1 wants for an area of this size",
        ),
        Key::default(
            "border",
            Length::VALUE,
            "0",
            "Width of the strip along each side that is left out",
        ),
        Key::optional(
            "normal",
            Value::Direction,
            "The first × the second edge unless given",
        ),
    ],
};
