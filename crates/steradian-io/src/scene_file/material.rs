//! `[materials.NAME]`: what surfaces are made of.

mod recipe;

use steradian::quantity::{Absorption, Quantity};
use steradian::scene::description::{LaneValues, MaterialDescription, MaterialModel, Media};
use toml::de::DeValue;

use super::fields::Fields;
use super::keys::Value;
use super::node::Node;
use super::tables::{ABSORPTION, MATERIALS};
use super::value::{Read, quantity};

/// Reads the material called `name`.
pub(super) fn read(name: &str, node: Node<'_>) -> Option<MaterialDescription> {
    let (kind, fields) = node.kind(&MATERIALS)?;
    let (model, opacity, media) = (model(kind, &fields), fields.get("opacity"), media(&fields));
    Some(MaterialDescription {
        name: name.to_owned(),
        model: model?,
        opacity,
        media,
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
        "two-sided" => {
            let (front, back) = (fields.get("front"), fields.get("back"));
            Some(MaterialModel::TwoSided {
                front: front?,
                back: back?,
            })
        }
        "mixture" => {
            let (of, weights) = (fields.get("of"), fields.get("weights"));
            Some(MaterialModel::Mixture {
                of: of?,
                weights: weights?,
            })
        }
        _ => recipe::read(kind, fields).map(MaterialModel::Recipe),
    }
}

fn media(fields: &Fields<'_>) -> Media<LaneValues> {
    let side = |key| fields.get(key).map(|AbsorbedPerMetre(lanes)| lanes);
    Media {
        inside: side("absorption"),
        outside: side("exterior_absorption"),
    }
}

/// An absorption in 1/m.
struct AbsorbedPerMetre(LaneValues);

impl Read for AbsorbedPerMetre {
    const VALUE: Value = ABSORPTION;

    fn read(node: Node<'_>) -> Option<Self> {
        let by_lane = match node.toml {
            DeValue::String(text) => text.starts_with('#'),
            DeValue::Integer(_) | DeValue::Float(_) => false,
            _ => true,
        };
        if by_lane {
            return LaneValues::read(node).map(Self);
        }
        let found: Absorption = quantity(node, &Value::Quantity(&[Absorption::TABLE]))?;
        Some(Self(LaneValues::Uniform(found.to_per_metre())))
    }
}
