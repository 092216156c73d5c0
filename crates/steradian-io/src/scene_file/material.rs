//! `[materials.NAME]`: what surfaces are made of.

use steradian::quantity::{Absorption, Angle, Quantity};
use steradian::scene::description::{
    LaneValues, MaterialDescription, MaterialModel, Media, Recipe, Roughness, Scalar, Slopes,
    Varying,
};
use toml::de::DeValue;

use crate::import::bsdf;

use super::fields::Fields;
use super::keys::Value;
use super::node::Node;
use super::tables::{ABSORPTION, MATERIALS};
use super::value::{Read, choices, quantity};

choices! { Slopes, "ggx" => Self::Ggx, "beckmann" => Self::Beckmann }

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
        _ => recipe(kind, fields).map(MaterialModel::Recipe),
    }
}

/// Models of tints and numbers.
fn recipe(kind: &str, fields: &Fields<'_>) -> Option<Recipe<Varying, Scalar>> {
    match kind {
        "oren-nayar" => {
            let (reflectance, sigma) = (fields.get("reflectance"), fields.get::<Angle>("sigma"));
            Some(Recipe::OrenNayar {
                reflectance: reflectance?,
                sigma: sigma?.to_radians().into(),
            })
        }
        "eon" => {
            let (reflectance, roughness) = (fields.get("reflectance"), number(fields, "roughness"));
            Some(Recipe::EnergyPreservingOrenNayar {
                reflectance: reflectance?,
                roughness: roughness?,
            })
        }
        "phong" => {
            let (diffuse, glossy) = (fields.get("diffuse"), fields.get("glossy"));
            let exponent = number(fields, "exponent");
            Some(Recipe::Phong {
                diffuse: diffuse?,
                glossy: glossy?,
                exponent: exponent?,
            })
        }
        "diffuse-transmission" => {
            let [reflectance, transmittance] =
                ["reflectance", "transmittance"].map(|key| fields.get(key));
            Some(Recipe::DiffuseTransmission {
                reflectance: reflectance?,
                transmittance: transmittance?,
            })
        }
        "measured" => measured(fields),
        _ => interface(kind, fields),
    }
}

fn measured(fields: &Fields<'_>) -> Option<Recipe<Varying, Scalar>> {
    let name: String = fields.get("file")?;
    let context = fields.context();
    let refuse = |message: String| context.error(fields.span_of("file"), message, None);
    let file = bsdf::read(&context.path_of(&name), context.files())
        .map_err(|error| refuse(format!("{name}: {error}")))
        .ok()?;
    for warning in &file.warnings {
        context.warn(format!("{name}: {warning}"));
    }
    file.model().cloned().map(Recipe::Measured)
}

/// Models of what light meets where two media touch.
fn interface(kind: &str, fields: &Fields<'_>) -> Option<Recipe<Varying, Scalar>> {
    let roughness = match kind {
        "rough-conductor" | "rough-dielectric" => roughness(fields).map(Some),
        _ => Some(None),
    };
    match kind {
        "conductor" | "rough-conductor" => {
            let [eta, kappa] = ["eta", "k"].map(|key| fields.get::<LaneValues>(key));
            Some(Recipe::Conductor {
                eta: eta?.into(),
                kappa: kappa?.into(),
                roughness: roughness?,
            })
        }
        "dielectric" | "rough-dielectric" => {
            let [ior, exterior_ior] = ["ior", "exterior_ior"].map(|key| positive(fields, key));
            Some(Recipe::Dielectric {
                ior: ior?,
                exterior_ior: exterior_ior?,
                roughness: roughness?,
            })
        }
        _ => {
            let (ior, transmittance) = (fields.get("ior"), fields.get("transmittance"));
            Some(Recipe::Pane {
                ior: ior?,
                transmittance: transmittance?,
            })
        }
    }
}

fn roughness(fields: &Fields<'_>) -> Option<Roughness> {
    let [both, along_x, along_y] = ["alpha", "alpha_x", "alpha_y"].map(|key| fields.get(key));
    let (slopes, multiple_scattering) = (
        fields.get("distribution"),
        fields.get("multiple_scattering"),
    );
    Some(Roughness {
        slopes: slopes?,
        alpha: [along_x.or(both)?, along_y.or(both)?],
        multiple_scattering: multiple_scattering?,
    })
}

fn number(fields: &Fields<'_>, key: &str) -> Option<Scalar> {
    fields.get::<f64>(key).map(Scalar::from)
}

/// A number above 0.
fn positive(fields: &Fields<'_>, key: &str) -> Option<f64> {
    let found: f64 = fields.get(key)?;
    if found <= 0.0 {
        let message = format!("expected a number above 0, found {found}");
        fields.context().error(fields.span_of(key), message, None);
        return None;
    }
    Some(found)
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
