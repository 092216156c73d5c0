//! Sides of parts: what they reflect, emit and let pass.
//!
//! Materials and lights get their tints once, by number, however many sides have them.

use super::super::media::Beside;
use super::{Model, NO_EMITTER, NO_TINT, OPAQUE, Side, Tinted};
use crate::brdf::{Brdf, Later, Metal};
use crate::light::{Kind, Light, LightId};
use crate::material::{self, Hue, Material, MaterialId, Opacity, Texture, Tint};
use crate::scene::Scene;

/// Collects what varies.
#[derive(Default)]
pub(super) struct Tints {
    pub tints: Vec<Tint>,
    pub opacities: Vec<Opacity>,
    pub media: Vec<Hue>,
}

impl Tints {
    fn add(&mut self, tint: Tint) -> Tinted {
        let lanes = tint.hue.lanes;
        if tint.is_constant() {
            return Tinted {
                lanes,
                tint: NO_TINT,
            };
        }
        self.tints.push(tint);
        Tinted {
            lanes,
            tint: self.tints.len() as u32 - 1,
        }
    }

    /// Intensity, irradiance or radiance of a light, by kind.
    pub fn of_light(&mut self, light: &Light) -> Tinted {
        let textures = match &light.kind {
            Kind::Area(area) => area.textures.clone(),
            Kind::EnvironmentMap { map, .. } => vec![Texture::whole(map.picture())],
            _ => vec![],
        };
        self.add(Tint {
            hue: Hue {
                lanes: light.power().map(|lane| lane as f32),
                curve: light.spectrum,
            },
            textures,
        })
    }

    /// A side of a material that does not emit.
    pub fn of_material(&mut self, id: MaterialId, material: &Material) -> Side {
        let reflectance = material.reflectance().cloned();
        Side {
            reflectance: reflectance.map_or(Tinted::BLACK, |tint| self.add(tint)),
            radiance: Tinted::BLACK,
            opacity: self.opacity(material.opacity.as_ref()),
            material: id,
            transmits: material.transmits(),
            is_specular: material.is_specular(),
            media: Beside::number(&material.media, &mut self.media),
            model: model(material),
            emitter: NO_EMITTER,
            group: 0,
            emits: false,
        }
    }

    fn opacity(&mut self, opacity: Option<&Opacity>) -> u32 {
        opacity.map_or(OPAQUE, |opacity| {
            self.opacities.push(opacity.clone());
            self.opacities.len() as u32 - 1
        })
    }
}

fn model(material: &Material) -> Model {
    let is_black = |tint: &Tint| tint.hue.lanes == [0.0; 4];
    match material.model {
        _ if material.reflectance().is_some_and(is_black) => Model::Black,
        material::Model::Black => Model::Black,
        _ if material.relief.is_some() && !material.is_pane() => Model::Any,
        material::Model::Lambertian { .. } => Model::Lambertian,
        material::Model::Mirror { .. } => Model::Mirror,
        material::Model::Recipe(_) if material.is_pane() => Model::Pane,
        material::Model::Recipe(_) => Model::Any,
    }
}

/// A rough metal that is the same everywhere and at every wavelength, if loops can deal with it.
pub(super) fn metal(material: &Material) -> Option<(Metal, Option<Later>)> {
    let material::Model::Recipe(recipe) = &material.model else {
        return None;
    };
    match (recipe.constant(), &material.relief) {
        (Some(Brdf::RoughConductor(metal)), None) => metal.in_columns(),
        _ => None,
    }
}

/// The same side where a light emits from it; `front` tells which side it is.
pub(super) fn emitting(
    side: Side,
    scene: &Scene,
    (id, radiance, emitter): (LightId, Tinted, u32),
    front: bool,
) -> Side {
    let light = &scene.lights()[id.0 as usize];
    match light.surface() {
        Some((_, two_sided)) if front || two_sided => Side {
            radiance,
            emitter,
            group: light.group,
            emits: true,
            ..side
        },
        _ => side,
    }
}
