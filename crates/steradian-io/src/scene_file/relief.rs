//! `normal_map` and `bump_map` of a material: pictures that turn its normals.

use steradian::quantity::Length;
use steradian::scene::description::Relief;

use super::fields::Fields;
use super::keys::Value;
use super::node::Node;
use super::tables::{BUMP_MAP, NORMAL_MAP};
use super::texture;
use super::value::Read;

/// What turns the normals of a material, if anything does.
pub(super) fn read(fields: &Fields<'_>) -> Option<Relief> {
    if fields.has("normal_map") && fields.has("bump_map") {
        let message = "keys `normal_map` and `bump_map` of a material exclude each other";
        let hint = Some("keep one of them".to_owned());
        let span = fields.span_of("bump_map");
        fields.context().error(span, message, hint);
        return None;
    }
    let normals = fields.get("normal_map").map(|NormalMap(relief)| relief);
    normals.or_else(|| fields.get("bump_map").map(|BumpMap(relief)| relief))
}

struct NormalMap(Relief);

impl Read for NormalMap {
    const VALUE: Value = Value::Table(&NORMAL_MAP);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&NORMAL_MAP)?;
        let (picture, scale) = (texture::of_numbers(&fields), fields.get("strength"));
        Some(Self(Relief::Normals {
            picture: picture?,
            scale: scale?,
        }))
    }
}

struct BumpMap(Relief);

impl Read for BumpMap {
    const VALUE: Value = Value::Table(&BUMP_MAP);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&BUMP_MAP)?;
        let (picture, height) = (texture::of_numbers(&fields), fields.get::<Length>("height"));
        Some(Self(Relief::Height {
            picture: picture?,
            scale: height?,
        }))
    }
}
