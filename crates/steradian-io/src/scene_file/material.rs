//! `[materials.NAME]`: what surfaces are made of.

use steradian::scene::description::{MaterialDescription, MaterialModel, Media};

use super::fields::Fields;
use super::node::Node;
use super::tables::MATERIALS;

/// Reads the material called `name`.
pub(super) fn read(name: &str, node: Node<'_>) -> Option<MaterialDescription> {
    let (kind, fields) = node.kind(&MATERIALS)?;
    let (model, opacity) = (model(kind, &fields), fields.get("opacity"));
    Some(MaterialDescription {
        name: name.to_owned(),
        model: model?,
        opacity,
        media: Media::default(),
    })
}

fn model(kind: &str, fields: &Fields<'_>) -> Option<MaterialModel> {
    match kind {
        "lambertian" => Some(MaterialModel::Lambertian {
            reflectance: fields.get("reflectance")?,
        }),
        "mirror" => Some(MaterialModel::Mirror {
            reflectance: fields.get("reflectance")?,
        }),
        _ => {
            let (front, back) = (fields.get("front"), fields.get("back"));
            Some(MaterialModel::TwoSided {
                front: front?,
                back: back?,
            })
        }
    }
}
