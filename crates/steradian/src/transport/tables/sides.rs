//! Sides of parts: what they reflect, emit and let pass, and the tints of what varies.

use super::{Lanes4, Model, NO_EMITTER, NO_TINT, OPAQUE, Side};
use crate::light::{Kind, Light, LightId};
use crate::material::{self, Hue, MaterialId, Opacity, Texture, Tint};
use crate::scene::Scene;

/// Collects what varies.
#[derive(Default)]
pub(super) struct Tints {
    pub tints: Vec<Tint>,
    pub opacities: Vec<Opacity>,
}

impl Tints {
    /// Number of a tint, and its lanes where it has none.
    fn add(&mut self, tint: Tint) -> (Lanes4, u32) {
        if tint.is_constant() {
            return (tint.hue.lanes, NO_TINT);
        }
        let known = self.tints.iter().position(|known| *known == tint);
        let number = known.unwrap_or_else(|| {
            self.tints.push(tint.clone());
            self.tints.len() - 1
        });
        (tint.hue.lanes, number as u32)
    }

    pub fn of_light(&mut self, light: &Light, textures: &[Texture]) -> (Lanes4, u32) {
        self.add(Tint {
            hue: Hue {
                lanes: light.power().map(|lane| lane as f32),
                curve: light.spectrum,
            },
            textures: textures.to_vec(),
        })
    }

    fn opacity(&mut self, opacity: Option<&Opacity>) -> u32 {
        let Some(opacity) = opacity else {
            return OPAQUE;
        };
        let known = self.opacities.iter().position(|known| known == opacity);
        known.unwrap_or_else(|| {
            self.opacities.push(opacity.clone());
            self.opacities.len() - 1
        }) as u32
    }
}

pub(super) fn side(
    scene: &Scene,
    material: MaterialId,
    light: Option<(LightId, u32)>,
    front: bool,
    tints: &mut Tints,
) -> Side {
    let material = scene.material(material);
    let is_black = |tint: &Tint| tint.hue.lanes == [0.0; 4];
    let model = match material.model {
        _ if material.reflectance().is_none_or(is_black) => Model::Black,
        material::Model::Black => Model::Black,
        material::Model::Lambertian { .. } => Model::Lambertian,
        material::Model::Mirror { .. } => Model::Mirror,
    };
    let black = ([0.0; 4], NO_TINT);
    let tint = material.reflectance().cloned();
    let (reflectance, reflectance_tint) = tint.map_or(black, |tint| tints.add(tint));
    let mut side = Side {
        reflectance,
        reflectance_tint,
        radiance: [0.0; 4],
        radiance_tint: NO_TINT,
        opacity: tints.opacity(material.opacity.as_ref()),
        model,
        emitter: NO_EMITTER,
        group: 0,
        emits: false,
    };
    if let Some((id, emitter)) = light {
        let light = &scene.lights()[id.0 as usize];
        if let Kind::Area(area) = &light.kind
            && (front || area.two_sided)
        {
            (side.radiance, side.radiance_tint) = tints.of_light(light, &area.textures);
            (side.emitter, side.group, side.emits) = (emitter, light.group, true);
        }
    }
    side
}
