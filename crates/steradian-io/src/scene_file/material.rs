//! `[materials.NAME]`: what surfaces are made of.

mod principled;
mod recipe;

use steradian::quantity::{Absorption, Quantity};
use steradian::scene::description::{
    Glass, LaneValues, MaterialDescription, MaterialModel, Media, Metal,
};
use toml::de::DeValue;

use super::fields::Fields;
use super::keys::Value;
use super::node::Node;
use super::relief;
use super::tables::{ABSORPTION, MATERIALS};
use super::value::{Read, choices, quantity};

/// Reads the material called `name`.
pub(super) fn read(name: &str, node: Node<'_>) -> Option<MaterialDescription> {
    let (kind, fields) = node.kind(&MATERIALS)?;
    let (model, opacity, media) = (model(kind, &fields), fields.get("opacity"), media(&fields));
    let relief = relief::read(&fields);
    Some(MaterialDescription {
        name: name.to_owned(),
        model: model?,
        opacity,
        media,
        relief,
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
        "conductor" | "rough-conductor" if fields.has("metal") => {
            let metal = fields.get("metal");
            let roughness = recipe::roughness_of(kind, fields);
            let Named(metal) = metal?;
            Some(MaterialModel::Metal {
                metal,
                roughness: roughness?,
            })
        }
        _ => recipe::read(kind, fields).map(MaterialModel::Recipe),
    }
}

fn media(fields: &Fields<'_>) -> Media<LaneValues> {
    let side = |key| fields.get(key).map(|AbsorbedPerMetre(lanes)| lanes);
    let of_glass = || {
        let Named(glass) = fields.get::<Named<Glass>>("glass")?;
        let absorption = glass.absorption();
        (absorption.max() > 0.0).then(|| LaneValues::table(absorption))
    };
    let attenuated = || principled::absorption(fields);
    Media {
        inside: side("absorption").or_else(of_glass).or_else(attenuated),
        outside: side("exterior_absorption"),
    }
}

/// What the file calls by a name.
struct Named<T>(T);

choices! {
    Named<Metal>,
    "silver" => Self(Metal::Silver),
    "aluminium" => Self(Metal::Aluminium),
    "gold" => Self(Metal::Gold),
    "chromium" => Self(Metal::Chromium),
    "copper" => Self(Metal::Copper),
    "iron" => Self(Metal::Iron),
}

choices! {
    Named<Glass>,
    "water" => Self(Glass::Water),
    "fused-silica" => Self(Glass::FusedSilica),
    "n-bk7" => Self(Glass::NBk7),
    "n-sf11" => Self(Glass::NSf11),
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
