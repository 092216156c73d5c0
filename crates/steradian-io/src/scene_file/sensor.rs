//! `[[sensors]]`: what is measured.

use std::sync::Arc;

use steradian::geometry::{Point, Transform, Vector};
use steradian::quantity::Length;
use steradian::scene::description::{
    Bins, CameraDescription, Fisheye, FluxOf, FluxSurface, GridCount, Projection, Receivers,
    Response, SensorDescription, SensorKind, Side,
};
use steradian::spectrum::Beyond;

use super::fields::Fields;
use super::keys::Value;
use super::node::Node;
use super::spectrum::{self, Intervals};
use super::tables::{GRID, PROJECTION_NAMES, RESPONSE, RESPONSE_NAMES, SENSORS, SURFACES, TABLE};
use super::value::{Read, Towards, choice, choices};
use super::{placement, shape};

choices! { GridCount, "en12464" => Self::En12464 }
choices! { Side, "front" => Self::Front, "back" => Self::Back }
choices! {
    FluxOf,
    "incident" => Self::Incident,
    "leaving" => Self::Leaving,
    "absorbed" => Self::Absorbed,
    "net" => Self::Net,
}

/// Reads one sensor. The photometric kinds are the radiometric ones with the photopic response.
pub(super) fn read(node: Node<'_>) -> Option<SensorDescription> {
    let (name, fields) = node.kind(&SENSORS)?;
    let kind = match name {
        "irradiance" | "illuminance" => receivers(&fields).map(SensorKind::Irradiance),
        "flux" | "luminous-flux" => flux(&fields),
        "radiance" | "luminance" => rays(&fields, "rays").map(|rays| SensorKind::Radiance { rays }),
        "scalar-irradiance" => {
            positions(&fields).map(|points| SensorKind::ScalarIrradiance { points })
        }
        "cylindrical-irradiance"
        | "cylindrical-illuminance"
        | "semicylindrical-irradiance"
        | "semicylindrical-illuminance" => cylindrical(&fields),
        _ => camera(&fields).map(SensorKind::Camera),
    };
    let (response, bins) = (response(name, &fields), bins(&fields));
    let name = fields.get("name");
    Some(SensorDescription {
        name: name?,
        response,
        bins,
        kind: kind?,
    })
}

fn bins(fields: &Fields<'_>) -> Option<Bins> {
    let (intervals, per_nm) = (fields.get("bins"), fields.get("per_nm"));
    let Intervals([low, high, width]) = intervals?;
    Some(Bins {
        range: [low, high],
        width,
        per_nm: per_nm?,
    })
}

impl Read for Response {
    const VALUE: Value = RESPONSE;

    fn read(node: Node<'_>) -> Option<Self> {
        if node.toml.is_table() {
            return weights(&node.record(&TABLE)?);
        }
        Some(match choice(node, RESPONSE_NAMES)? {
            "radiant" => Self::Radiant,
            "photopic" => Self::Photopic,
            "scotopic" => Self::Scotopic,
            "xyz" => Self::Xyz,
            "par" => Self::Par,
            "melanopic" => Self::Melanopic,
            _ => Self::Auto,
        })
    }
}

/// The response in a file, called after it.
fn weights(fields: &Fields<'_>) -> Option<Response> {
    let curve = spectrum::from_file(fields, Beyond::Zero)?;
    let (file, column): (String, Option<String>) = (fields.get("file")?, fields.get("column"));
    Some(Response::Table {
        name: [Some(file), column]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join(" "),
        curve: Arc::new(curve),
    })
}

fn response(kind: &str, fields: &Fields<'_>) -> Option<Response> {
    let given = fields.get("response");
    if !kind.ends_with("illuminance") && !matches!(kind, "luminance" | "luminous-flux") {
        return given;
    }
    if given.is_some_and(|given| given != Response::Photopic) {
        let message = format!("the response of a sensor of kind {kind:?} is \"photopic\"");
        fields
            .context()
            .error(fields.span_of("response"), message, None);
    }
    Some(Response::Photopic)
}

fn receivers(fields: &Fields<'_>) -> Option<Receivers> {
    if fields.has("points") {
        return rays(fields, "points").map(Receivers::Points);
    }
    if fields.has("grid") {
        return fields.get("grid").map(|Grid(receivers)| receivers);
    }
    let (side, count, offset) = (
        fields.get("side"),
        fields.get("count"),
        fields.get::<Length>("offset"),
    );
    Some(Receivers::Shape {
        shape: fields.get("shape")?,
        side: side?,
        count: count?,
        offset: offset?.to_metres(),
    })
}

fn rays(fields: &Fields<'_>, key: &str) -> Option<Vec<(Point, Vector)>> {
    let up = fields.context().up.get();
    let rays: Vec<(Point, Towards)> = fields.get(key)?;
    Some(
        rays.into_iter()
            .map(|(point, towards)| (up.point(point), up.direction(towards)))
            .collect(),
    )
}

fn cylindrical(fields: &Fields<'_>) -> Option<SensorKind> {
    let axis = if fields.has("axis") {
        placement::direction(fields, "axis")
    } else {
        Some(Vector::new(0.0, 0.0, 1.0))
    };
    let facing = fields
        .has("facing")
        .then(|| placement::direction(fields, "facing"));
    let receivers = if fields.has("grid") {
        fields.get("grid").map(|Grid(receivers)| receivers)
    } else {
        let along = |points: Vec<Point>| {
            points
                .into_iter()
                .map(|point| (point, axis.unwrap_or(Vector::ZERO)))
        };
        positions(fields).map(|points| Receivers::Points(along(points).collect()))
    };
    let receivers = match receivers? {
        Receivers::Grid {
            origin,
            edges,
            count,
            border,
            ..
        } => Receivers::Grid {
            origin,
            edges,
            count,
            border,
            normal: Some(axis?),
        },
        others => others,
    };
    Some(SensorKind::Cylindrical {
        receivers,
        facing: match facing {
            None => None,
            Some(facing) => Some(facing?),
        },
    })
}

fn positions(fields: &Fields<'_>) -> Option<Vec<Point>> {
    let up = fields.context().up.get();
    let points: Vec<Point> = fields.get("points")?;
    Some(points.into_iter().map(|point| up.point(point)).collect())
}

fn flux(fields: &Fields<'_>) -> Option<SensorKind> {
    let surface = if fields.has("surface") {
        fields.get("surface").map(|Surface(surface)| surface)
    } else {
        let (name, side) = (fields.get("shape"), fields.get("side"));
        name.zip(side)
            .map(|(name, side)| FluxSurface::Shape { name, side })
    };
    let of = fields.get("of");
    Some(SensorKind::Flux {
        surface: surface?,
        of: of?,
    })
}

fn camera(fields: &Fields<'_>) -> Option<CameraDescription> {
    let (position, look_at) = (
        placement::point(fields, "position"),
        placement::point(fields, "look_at"),
    );
    let up = if fields.has("up") {
        placement::direction(fields, "up")
    } else {
        Some(Vector::new(0.0, 0.0, 1.0))
    };
    let (projection, resolution) = (projection(fields), fields.get("resolution"));
    Some(CameraDescription {
        position: position?,
        look_at: look_at?,
        up: up?,
        projection: projection?,
        resolution: resolution?,
    })
}

fn projection(fields: &Fields<'_>) -> Option<Projection> {
    let ProjectionName(name) = fields.get("projection")?;
    let fisheye = |mapping| {
        let fov = fields.get("fov")?;
        Some(Projection::Fisheye { mapping, fov })
    };
    match name {
        "thin-lens" => thin_lens(fields),
        "orthographic" => fields
            .get("width")
            .map(|width| Projection::Orthographic { width }),
        "panorama" => Some(Projection::Panorama),
        "fisheye-equidistant" => fisheye(Fisheye::Equidistant),
        "fisheye-equisolid" => fisheye(Fisheye::Equisolid),
        "fisheye-hemispherical" => fisheye(Fisheye::Hemispherical),
        _ => fields.get("fov").map(|fov| Projection::Perspective { fov }),
    }
}

fn thin_lens(fields: &Fields<'_>) -> Option<Projection> {
    let (fov, aperture_radius, focus_distance) = (
        fields.get("fov"),
        fields.get("aperture_radius"),
        fields.get("focus_distance"),
    );
    Some(Projection::ThinLens {
        fov: fov?,
        aperture_radius: aperture_radius?,
        focus_distance: focus_distance?,
    })
}

/// The name of a projection.
struct ProjectionName(&'static str);

impl Read for ProjectionName {
    const VALUE: Value = Value::Choice(PROJECTION_NAMES);

    fn read(node: Node<'_>) -> Option<Self> {
        choice(node, PROJECTION_NAMES).map(Self)
    }
}

/// The grid of an irradiance sensor.
struct Grid(Receivers);

impl Read for Grid {
    const VALUE: Value = Value::Table(&GRID);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&GRID)?;
        let (origin, edges) = (
            placement::point(&fields, "origin"),
            placement::edges(&fields, "edges"),
        );
        let count = if fields.has("spacing") {
            fields.get("spacing")
        } else {
            fields.get("count").map(GridCount::Given)
        };
        let (border, normal) = (
            fields.get::<Length>("border"),
            placement::direction(&fields, "normal"),
        );
        Some(Self(Receivers::Grid {
            origin: origin?,
            edges: edges?,
            count: count?,
            border: border?.to_metres(),
            normal,
        }))
    }
}

/// A surface of its own.
struct Surface(FluxSurface);

impl Read for Surface {
    const VALUE: Value = Value::Kinds(&SURFACES);

    fn read(node: Node<'_>) -> Option<Self> {
        let (kind, fields) = node.kind(&SURFACES)?;
        let (geometry, transform) = (
            shape::geometry(kind, &fields),
            placement::transform(&fields, Transform::IDENTITY),
        );
        Some(Self(FluxSurface::Virtual {
            geometry: geometry?,
            transform: transform?,
        }))
    }
}
