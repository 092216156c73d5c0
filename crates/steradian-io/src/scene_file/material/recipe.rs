//! Models of tints and numbers.

use steradian::quantity::Angle;
use steradian::scene::description::{
    Glass, LaneValues, RadianceKind, Recipe, Roughness, Scalar, Shadowing, Slopes, Varying,
};

use super::{Named, principled};
use crate::import::bsdf;
use crate::scene_file::fields::Fields;
use crate::scene_file::value::choices;

choices! { Slopes, "ggx" => Self::Ggx, "beckmann" => Self::Beckmann }
choices! { Shadowing, "height-correlated" => Self::HeightCorrelated, "separable" => Self::Separable }

/// The model of this kind.
pub(super) fn read(kind: &str, fields: &Fields<'_>) -> Option<Recipe<Varying, Scalar>> {
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
        "plastic" | "rough-plastic" | "ward" => coated(kind, fields),
        "radiance-plastic" | "radiance-metal" | "radiance-trans" => radiance(kind, fields),
        "measured" => measured(fields),
        "principled" => principled::read(fields),
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
    let roughness = roughness_of(kind, fields);
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
            let named = |Named(glass): Named<Glass>| glass.index();
            let ior = match fields.has("glass") {
                true => fields.get("glass").map(named),
                false => positive(fields, "ior"),
            };
            let exterior_ior = positive(fields, "exterior_ior");
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

/// Diffuse reflection beneath gloss.
fn coated(kind: &str, fields: &Fields<'_>) -> Option<Recipe<Varying, Scalar>> {
    let diffuse = fields.get("diffuse");
    if kind == "ward" {
        let (specular, alpha) = (fields.get("specular"), alpha(fields));
        return Some(Recipe::Ward {
            diffuse: diffuse?,
            specular: specular?,
            alpha: alpha?,
        });
    }
    let ior = fields.get("ior");
    let roughness = roughness_of(kind, fields);
    Some(Recipe::Plastic {
        ior: ior?,
        diffuse: diffuse?,
        roughness: roughness?,
    })
}

fn radiance(kind: &str, fields: &Fields<'_>) -> Option<Recipe<Varying, Scalar>> {
    let (color, specularity) = (fields.get("color"), number(fields, "specularity"));
    let roughness = number(fields, "roughness");
    let kind = match kind {
        "radiance-plastic" => Some(RadianceKind::Plastic),
        "radiance-metal" => Some(RadianceKind::Metal),
        _ => {
            let [through, straight] =
                ["transmissivity", "transmitted_specularity"].map(|key| fields.get(key));
            through
                .zip(straight)
                .map(
                    |(transmissivity, transmitted_specularity)| RadianceKind::Trans {
                        transmissivity,
                        transmitted_specularity,
                    },
                )
        }
    };
    Some(Recipe::Radiance {
        kind: kind?,
        color: color?,
        specularity: specularity?,
        roughness: roughness?,
    })
}

fn alpha(fields: &Fields<'_>) -> Option<[f64; 2]> {
    let [both, along_x, along_y] = ["alpha", "alpha_x", "alpha_y"].map(|key| fields.get(key));
    Some([along_x.or(both)?, along_y.or(both)?])
}

/// That of a kind which is rough, or that of a smooth one.
pub(super) fn roughness_of(kind: &str, fields: &Fields<'_>) -> Option<Option<Roughness>> {
    match kind.starts_with("rough-") {
        true => roughness(fields).map(Some),
        false => Some(None),
    }
}

fn roughness(fields: &Fields<'_>) -> Option<Roughness> {
    let (alpha, slopes) = (alpha(fields), fields.get("distribution"));
    let shadowing = fields.get("shadowing");
    let multiple_scattering = fields.get("multiple_scattering");
    Some(Roughness {
        slopes: slopes?,
        alpha: alpha?,
        shadowing: shadowing?,
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
