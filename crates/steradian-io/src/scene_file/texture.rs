//! What varies over a surface: textures of reflectance, emission and opacity.

use std::sync::Arc;

use steradian::scene::description::{
    Bitmap, Interpolation, LaneValues, Opacity, Pattern, Picture, Placement, Scalar, Texture,
    Varying, Wrap,
};

use crate::import::as_opacity;
use crate::import::image::{self, Encoding};

use super::fields::Fields;
use super::keys::{Record, Value};
use super::node::Node;
use super::tables::{
    CHECKERBOARD, EMISSION_CHECKERBOARD, EMISSION_PATTERN, EMISSION_TEXTURE, EMISSION_VERTEX_COLOR,
    NUMBER, NUMBER_TEXTURE, OPACITY, OPACITY_TEXTURE, TEXTURE, VARYING, VERTEX_COLOR,
};
use super::value::{Read, choices};

choices! { Encoding, "srgb" => Self::Srgb, "linear" => Self::Linear }
choices! { Wrap, "repeat" => Self::Repeat, "mirror" => Self::Mirror, "clamp" => Self::Clamp }
choices! { Interpolation, "bilinear" => Self::Bilinear, "nearest" => Self::Nearest }

impl Read for Varying {
    const VALUE: Value = VARYING;

    fn read(node: Node<'_>) -> Option<Self> {
        let has = |key: &str| {
            node.toml
                .as_table()
                .is_some_and(|table| table.contains_key(key))
        };
        let [picture, checkerboard, of_vertices] =
            ["texture", "checkerboard", "vertex_color"].map(has);
        if !(picture || checkerboard || of_vertices) {
            return LaneValues::read(node).map(Self::from);
        }
        let fields = node.record(pattern_record(
            node,
            [&TEXTURE, &CHECKERBOARD, &VERTEX_COLOR],
        ))?;
        let (texture, factor) = (texture(&fields), fields.get("factor"));
        Some(Self {
            factor: factor?,
            textures: vec![texture?],
        })
    }
}

/// What a surface's emission is multiplied by.
pub(super) struct EmissionPattern(pub Texture);

impl Read for EmissionPattern {
    const VALUE: Value = EMISSION_PATTERN;

    fn read(node: Node<'_>) -> Option<Self> {
        let records = [
            &EMISSION_TEXTURE,
            &EMISSION_CHECKERBOARD,
            &EMISSION_VERTEX_COLOR,
        ];
        let fields = node.record(pattern_record(node, records))?;
        texture(&fields).map(Self)
    }
}

/// The record whose own key is there: that of a picture, of a checkerboard or of vertex colours.
fn pattern_record(node: Node<'_>, records: [&'static Record; 3]) -> &'static Record {
    let table = node.toml.as_table();
    let own = |record: &&&'static Record| {
        let first = record.keys.first().map(|key| key.name);
        first.is_some_and(|key| table.is_some_and(|table| table.contains_key(key)))
    };
    records.iter().find(own).unwrap_or(&records[0])
}

fn texture(fields: &Fields<'_>) -> Option<Texture> {
    if fields.has("vertex_color") {
        return of_vertices(fields);
    }
    let placement = placement(fields);
    let pattern = if fields.has("checkerboard") {
        fields.get("checkerboard").map(Pattern::Checkerboard)
    } else {
        picture(fields, fields.get("encoding"), Ok).map(Pattern::Bitmap)
    };
    Some(Texture {
        pattern: pattern?,
        placement: placement?,
    })
}

fn of_vertices(fields: &Fields<'_>) -> Option<Texture> {
    if !fields.get::<bool>("vertex_color")? {
        let message = "expected true; leave the key out for a surface of one colour";
        fields
            .context()
            .error(fields.span_of("vertex_color"), message, None);
        return None;
    }
    Some(Texture {
        pattern: Pattern::VertexColor,
        placement: Placement::default(),
    })
}

fn placement(fields: &Fields<'_>) -> Option<Placement> {
    let (scale, offset) = (
        fields.get::<[f64; 2]>("scale"),
        fields.get::<[f64; 2]>("offset"),
    );
    let ([su, sv], [ou, ov]) = (scale?, offset?);
    Some(Placement([[su, 0.0, ou], [0.0, sv, ov]]))
}

/// The picture of the key `texture`, of linear numbers, as it is laid.
pub(super) fn of_numbers(fields: &Fields<'_>) -> Option<Texture> {
    let placement = placement(fields);
    let picture = picture(fields, Some(Encoding::Linear), Ok)?;
    Some(Texture {
        pattern: Pattern::Bitmap(picture),
        placement: placement?,
    })
}

/// The picture of all directions in the key `file`: floating-point numbers are light, codes of integers are sRGB.
pub(super) fn of_directions(fields: &Fields<'_>) -> Option<Arc<Bitmap>> {
    let name = fields.get::<String>("file")?;
    let span = fields.span_of("file");
    let bytes = fields.context().read_file(&name, span.clone())?;
    match image::read(&bytes, Encoding::Srgb) {
        Ok(mut picture) => {
            picture.interpolation = Interpolation::Nearest;
            Some(Arc::new(picture))
        }
        Err(error) => {
            let message = format!("{name}: {error}");
            fields.context().error(span, message, None);
            None
        }
    }
}

/// The picture of the key `texture`.
fn picture(
    fields: &Fields<'_>,
    encoding: Option<Encoding>,
    prepare: impl Fn(Bitmap) -> Result<Bitmap, steradian::material::BitmapError>,
) -> Option<Arc<Bitmap>> {
    let (wrap, interpolation) = (fields.get("wrap"), fields.get("interpolation"));
    let name = fields.get::<String>("texture")?;
    let (encoding, wrap, interpolation): (_, Wrap, Interpolation) =
        (encoding?, wrap?, interpolation?);
    let span = fields.span_of("texture");
    let bytes = fields.context().read_file(&name, span.clone())?;
    let picture = image::read(&bytes, encoding).and_then(|picture| Ok(prepare(picture)?));
    match picture {
        Ok(mut picture) => {
            picture.wrap = [wrap; 2];
            picture.interpolation = interpolation;
            Some(Arc::new(picture))
        }
        Err(error) => {
            fields
                .context()
                .error(span, format!("{name}: {error}"), None);
            None
        }
    }
}

/// The place of a channel among red, green, blue and alpha.
struct Channel(usize);

choices! { Channel, "red" => Self(0), "green" => Self(1), "blue" => Self(2), "alpha" => Self(3) }

impl Read for Scalar {
    const VALUE: Value = NUMBER;

    fn read(node: Node<'_>) -> Option<Self> {
        if !node.toml.is_table() {
            return f64::read(node).map(Self::from);
        }
        let fields = node.record(&NUMBER_TEXTURE)?;
        let (placement, factor) = (placement(&fields), fields.get("factor"));
        let channel: Option<Channel> = fields.get("channel");
        let bitmap = picture(&fields, Some(Encoding::Linear), Ok)?;
        let picture = Picture {
            bitmap,
            placement: placement?.0,
            channel: channel?.0,
        };
        Some(Self {
            factor: factor?,
            picture: Some(picture),
        })
    }
}

impl Read for Opacity {
    const VALUE: Value = OPACITY;

    fn read(node: Node<'_>) -> Option<Self> {
        if !node.toml.is_table() {
            let factor = f64::read(node)?;
            return Some(Self {
                factor,
                textures: vec![],
                cutoff: None,
            });
        }
        let fields = node.record(&OPACITY_TEXTURE)?;
        let (placement, factor) = (placement(&fields), fields.get("factor"));
        let cutoff = fields.get("cutoff");
        let picture = picture(&fields, Some(Encoding::Linear), as_opacity)?;
        let texture = Texture {
            pattern: Pattern::Bitmap(picture),
            placement: placement?,
        };
        Some(Self {
            factor: factor?,
            textures: vec![texture],
            cutoff,
        })
    }
}
