//! `[[shapes]]`: surfaces and what they emit.
//!
//! The geometry stays in the coordinates of the file; for `up = "y"` the turn to z up is the last step of the
//! shape's transform.

use steradian::geometry::Transform;
use steradian::quantity::Length;
use steradian::scene::description::{
    EmissionAmount, EmissionDescription, GeometryDescription, Opening, Port, ShapeDescription,
};

use super::fields::Fields;
use super::keys::Value;
use super::mesh::{self, Surface};
use super::node::Node;
use super::placement;
use super::spectrum::LightSpectrum;
use super::tables::{EMISSION, FACE_NAMES, FACES, OPENING, PORT, SHAPES};
use super::texture::EmissionPattern;
use super::up::UpAxis;
use super::value::{Read, Towards, choice};

/// Reads one entry: one shape, or for a mesh file one a material.
pub(super) fn read(node: Node<'_>) -> Option<Vec<ShapeDescription>> {
    let (kind, fields) = node.kind(&SHAPES)?;
    // The ground is level in the description, whatever axis points up in the file.
    let first = if kind == "ground" {
        node.context.up.get().turn_back()
    } else {
        Transform::IDENTITY
    };
    let surfaces = match kind {
        "mesh" => mesh::read(&fields),
        _ => geometry(kind, &fields).map(|geometry| vec![Surface::plain(geometry)]),
    };
    let transform = placement::transform(&fields, first);
    let (material, emission) = (fields.get("material"), fields.get("emission"));
    let (name, repeat) = (fields.get::<String>("name"), placement::repeat(&fields));
    let (surfaces, transform) = (surfaces?, transform?);
    let shape = |surface: Surface| ShapeDescription {
        name: surface.named(name.as_deref()),
        geometry: surface.geometry,
        material: material.clone().or(surface.material),
        transform,
        repeat: repeat.clone(),
        emission: emission.clone().or(surface.emission),
    };
    Some(surfaces.into_iter().map(shape).collect())
}

/// Reads the geometry of a shape of this kind.
pub(super) fn geometry(kind: &str, fields: &Fields<'_>) -> Option<GeometryDescription> {
    match kind {
        "rectangle" => rectangle(fields),
        "polygon" => polygon(fields),
        "disc" => disc(fields),
        "sphere" => sphere(fields),
        "box" => cuboid(fields),
        _ => length(fields, "height").map(|height| GeometryDescription::Ground { height }),
    }
}

fn length(fields: &Fields<'_>, key: &str) -> Option<f64> {
    fields.get(key).map(Length::to_metres)
}

fn rectangle(fields: &Fields<'_>) -> Option<GeometryDescription> {
    let (origin, edges) = (fields.get("origin"), fields.get("edges"));
    Some(GeometryDescription::Rectangle {
        origin: origin?,
        edges: edges?,
    })
}

fn polygon(fields: &Fields<'_>) -> Option<GeometryDescription> {
    let (vertices, holes) = (fields.get("vertices"), fields.get("holes"));
    Some(GeometryDescription::Polygon {
        vertices: vertices?,
        holes: holes?,
    })
}

fn disc(fields: &Fields<'_>) -> Option<GeometryDescription> {
    let (center, normal) = (fields.get("center"), fields.get("normal"));
    let (radius, inner_radius) = (length(fields, "radius"), length(fields, "inner_radius"));
    let Towards(normal) = normal?;
    Some(GeometryDescription::Disc {
        center: center?,
        normal,
        radius: radius?,
        inner_radius: inner_radius?,
    })
}

fn sphere(fields: &Fields<'_>) -> Option<GeometryDescription> {
    let (center, radius) = (fields.get("center"), length(fields, "radius"));
    let (inside, ports) = (fields.get("inside"), fields.get("ports"));
    Some(GeometryDescription::Sphere {
        center: center?,
        radius: radius?,
        inside: inside?,
        ports: ports?,
    })
}

fn cuboid(fields: &Fields<'_>) -> Option<GeometryDescription> {
    let (min, max, inside) = (fields.get("min"), fields.get("max"), fields.get("inside"));
    let faces = fields
        .get("faces")
        .map_or_else(Vec::new, |Faces(faces)| faces);
    let openings: Option<Vec<Opening>> = fields.get("openings");
    Some(GeometryDescription::Box {
        min: min?,
        max: max?,
        inside: inside?,
        faces,
        openings: openings?,
    })
}

impl Read for Port {
    const VALUE: Value = Value::Table(&PORT);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&PORT)?;
        let (direction, half_angle) = (fields.get("direction"), fields.get("half_angle"));
        let Towards(direction) = direction?;
        Some(Self {
            direction,
            half_angle: half_angle?,
        })
    }
}

/// Materials by face, in the order of the file.
struct Faces(Vec<(String, String)>);

impl Read for Faces {
    const VALUE: Value = Value::Table(&FACES);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&FACES)?;
        let up = node.context.up.get();
        let named = fields
            .names()
            .into_iter()
            .filter_map(|face| Some((face, fields.get::<String>(face)?)));
        let faces = named.flat_map(|(face, material)| {
            sides(face, up)
                .into_iter()
                .map(move |side| (side.to_owned(), material.clone()))
        });
        Some(Self(faces.collect()))
    }
}

/// The faces that `face` means in a file with this up axis, as a box whose z axis is up calls them.
fn sides(face: &str, up: UpAxis) -> Vec<&str> {
    match (up, face) {
        (UpAxis::Y, "floor") => vec!["y-"],
        (UpAxis::Y, "ceiling") => vec!["y+"],
        (UpAxis::Y, "walls") => vec!["x-", "x+", "z-", "z+"],
        _ => vec![face],
    }
}

impl Read for Opening {
    const VALUE: Value = Value::Table(&OPENING);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&OPENING)?;
        let (face, rect) = (fields.get("face"), fields.get::<[Length; 4]>("rect"));
        let material = fields.get("material");
        let Face(face) = face?;
        Some(Self {
            face,
            rect: rect?.map(Length::to_metres),
            material,
        })
    }
}

/// A face, by the axis it is on.
struct Face(String);

impl Read for Face {
    const VALUE: Value = Value::Choice(FACE_NAMES);

    fn read(node: Node<'_>) -> Option<Self> {
        let name = choice(node, FACE_NAMES)?;
        let face = match (node.context.up.get(), name) {
            (UpAxis::Z, "floor") => "z-",
            (UpAxis::Z, "ceiling") => "z+",
            (up, name) => sides(name, up).first()?,
        };
        Some(Self(face.to_owned()))
    }
}

impl Read for EmissionDescription {
    const VALUE: Value = Value::Table(&EMISSION);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&EMISSION)?;
        let (amount, two_sided) = (amount(&fields), fields.get("two_sided"));
        let (spectrum, group) = (fields.get("spectrum"), fields.get("group"));
        let texture = fields.get::<EmissionPattern>("texture");
        let spectrum = spectrum.map(|LightSpectrum(spectrum)| spectrum);
        Some(Self {
            amount: amount?,
            spectrum,
            textures: texture.map(|pattern| pattern.0).into_iter().collect(),
            two_sided: two_sided?,
            group,
            schedule: fields.get("schedule"),
        })
    }
}

fn amount(fields: &Fields<'_>) -> Option<EmissionAmount> {
    let radiance = fields.get("radiance").map(EmissionAmount::Radiance);
    let exitance = fields.get("exitance").map(EmissionAmount::Exitance);
    radiance
        .or(exitance)
        .or(fields.get("flux").map(EmissionAmount::Flux))
}
