//! From the statements of a material library to a material.

use steradian::quantity::{Amount, Radiance};
use steradian::scene::description::{
    EmissionAmount, EmissionDescription, LaneValues, MaterialDescription, MaterialModel, Media,
    Opacity, Texture, Varying,
};

use super::maps::{Map, Pictures, Purpose};
use crate::import::mesh_file::MeshMaterial;

/// A material as the file states it.
pub(super) struct Entry {
    pub name: String,
    pub reflectance: [f64; 3],
    pub opacity: f64,
    pub emission: Option<[f64; 3]>,
    pub reflectance_map: Option<Map>,
    pub opacity_map: Option<Map>,
    pub emission_map: Option<Map>,
}

impl Entry {
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            reflectance: [0.8; 3],
            opacity: 1.0,
            emission: None,
            reflectance_map: None,
            opacity_map: None,
            emission_map: None,
        }
    }

    /// The material, with the textures that can be read.
    pub fn material(self, pictures: &mut Pictures<'_>) -> MeshMaterial {
        let mut textures = |map: Option<&Map>, purpose| -> Vec<Texture> {
            map.and_then(|map| pictures.texture(map, purpose))
                .into_iter()
                .collect()
        };
        let opacity = Opacity {
            factor: self.opacity,
            textures: textures(self.opacity_map.as_ref(), Purpose::Opacity),
            cutoff: None,
        };
        let reflectance = textures(self.reflectance_map.as_ref(), Purpose::Colour);
        let emission = textures(self.emission_map.as_ref(), Purpose::Colour);
        MeshMaterial {
            emission: self.emission(emission),
            material: MaterialDescription {
                model: MaterialModel::Lambertian {
                    reflectance: self.reflectance(reflectance),
                },
                name: self.name,
                opacity: (opacity.factor < 1.0 || !opacity.textures.is_empty()).then_some(opacity),
                media: Media::default(),
                relief: None,
            },
        }
    }

    /// Programs that write a texture beside a black `Kd` mean the texture.
    fn reflectance(&self, textures: Vec<Texture>) -> Varying {
        let is_black = self.reflectance == [0.0; 3] && !textures.is_empty();
        let factor = if is_black { [1.0; 3] } else { self.reflectance };
        Varying {
            factor: lanes(factor.map(|part| part.min(1.0))),
            textures,
        }
    }

    /// Light of the radiance `Ke`, or 1 beside a texture, with the colour as its spectrum; `None` for none.
    fn emission(&self, textures: Vec<Texture>) -> Option<EmissionDescription> {
        let unstated = if textures.is_empty() { 0.0 } else { 1.0 };
        let radiance = self.emission.unwrap_or([unstated; 3]);
        // Luminance weights of Rec.709: a spectrum of this colour and this amount has these very lanes.
        let [red, green, blue] = radiance;
        let weighted = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
        let is_grey = red == green && green == blue;
        let amount = if is_grey { red } else { weighted };
        let amount = Amount::Radiant(Radiance::from_watts_per_square_metre_steradian(amount));
        (weighted > 0.0).then(|| EmissionDescription {
            amount: EmissionAmount::Radiance(amount),
            spectrum: (!is_grey).then_some(LaneValues::Rgb(radiance)),
            textures,
            two_sided: false,
            group: None,
            schedule: None,
        })
    }
}

/// Grey means the same in every kind of spectrum.
fn lanes(rgb: [f64; 3]) -> LaneValues {
    if rgb == [rgb[0]; 3] {
        LaneValues::Uniform(rgb[0])
    } else {
        LaneValues::Rgb(rgb)
    }
}
