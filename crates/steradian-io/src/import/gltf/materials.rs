//! Materials: reflection, opacity, relief and emission.
//!
//! Opacity is α where the alpha mode is to blend, and α against the cutoff for a mask. How surfaces reflect is in
//! [`reflection`](super::reflection).
//!
//! Emission is a luminance, L = strength × Y(r, g, b) in cd/m² with Y = 0.2126 r + 0.7152 g + 0.0722 b of the linear
//! emissive factor, and the factor's colour; the texture multiplies it. Surfaces emit to both sides if they are
//! double-sided, else to the front.

use std::collections::HashMap;

use steradian::quantity::{Amount, Luminance};
use steradian::scene::description::{
    EmissionAmount, EmissionDescription, LaneValues, MaterialDescription, Opacity, Pattern,
    Placement, Relief, Texture,
};

use super::document::{Document, part};
use super::error::GltfError;
use super::names::Names;
use super::notes::Notes;
use super::reflection::{Base, textures_of};
use super::schema::{Material, TextureInfo};
use super::textures::{Textures, coordinate_set};
use crate::import::image::Encoding;

/// Which attributes the vertices of a primitive have.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Attributes {
    pub coordinates: bool,
    pub colors: bool,
}

/// How a surface reflects and emits.
#[derive(Clone)]
pub(super) struct Finish {
    /// Name of its material.
    pub material: String,
    pub emission: Option<EmissionDescription>,
}

/// The materials of a file, read when first used.
pub(super) struct Materials<'d> {
    document: &'d Document<'d>,
    textures: Textures<'d>,
    names: Names,
    finishes: HashMap<(Option<usize>, Attributes), Finish>,
    plain: Material,
    pub described: Vec<MaterialDescription>,
}

impl<'d> Materials<'d> {
    pub fn new(document: &'d Document<'d>, textures: Textures<'d>) -> Self {
        Self {
            document,
            textures,
            names: Names::default(),
            finishes: HashMap::new(),
            plain: Material::default(),
            described: vec![],
        }
    }

    /// The set of texture coordinates that a material needs.
    pub fn coordinate_set(&self, index: Option<usize>) -> Option<usize> {
        let material = self.document.root.materials.get(index?)?;
        let mut infos = textures_of(material).into_iter();
        infos.next().map(coordinate_set)
    }

    /// A material on vertices with these attributes.
    pub fn finish(
        &mut self,
        index: Option<usize>,
        attributes: Attributes,
        place: &str,
        notes: &mut Notes,
    ) -> Result<Finish, GltfError> {
        if let Some(finish) = self.finishes.get(&(index, attributes)) {
            return Ok(finish.clone());
        }
        let finish = self.read(index, attributes, place, notes)?;
        self.finishes.insert((index, attributes), finish.clone());
        Ok(finish)
    }

    fn read(
        &mut self,
        index: Option<usize>,
        attributes: Attributes,
        place: &str,
        notes: &mut Notes,
    ) -> Result<Finish, GltfError> {
        let document = self.document;
        let plain = std::mem::take(&mut self.plain);
        let material = match index {
            Some(index) => part(&document.root.materials, index, "material", place)?,
            None => &plain,
        };
        let (place, name) = match index {
            Some(index) => (format!("materials[{index}]"), format!("material {index}")),
            None => ("the default material".into(), "default".into()),
        };
        note(material, &place, notes);
        let name = material.name.clone().unwrap_or(name);
        let mut reader = Reader {
            material,
            attributes,
            place,
            textures: &mut self.textures,
            notes,
        };
        let name = self.names.unique(&name);
        self.described.push(MaterialDescription {
            name: name.clone(),
            model: reader.model()?,
            opacity: reader.opacity()?,
            media: reader.media(),
            relief: reader.relief()?,
        });
        Ok(Finish {
            material: name,
            emission: reader.emission()?,
        })
    }
}

/// Says what is not read as it is meant.
fn note(material: &Material, place: &str, notes: &mut Notes) {
    let extensions = &material.extensions;
    if extensions.unlit.is_some() {
        let text = "colours without light (KHR_materials_unlit) are taken for diffuse reflectances";
        notes.count("materials", text, place);
    } else if extensions.specular_glossiness.is_some() {
        let text = "gloss of KHR_materials_pbrSpecularGlossiness is taken for diffuse reflection";
        notes.count("materials", text, place);
    }
    if !material.double_sided {
        let text = "surfaces that show their front only reflect on both sides";
        notes.count("materials", text, place);
    }
}

/// Reads one material.
pub(super) struct Reader<'r, 'd> {
    pub material: &'r Material,
    attributes: Attributes,
    pub place: String,
    pub textures: &'r mut Textures<'d>,
    pub notes: &'r mut Notes,
}

impl Reader<'_, '_> {
    /// Factors lie between 0 and 1.
    pub fn fractions<const N: usize>(&mut self, factor: [f64; N]) -> [f64; N] {
        if factor.iter().any(|lane| !(0.0..=1.0).contains(lane)) {
            let text = "colours beyond 0 to 1 are cut off";
            self.notes.count("materials", text, &self.place);
        }
        factor.map(|lane| lane.clamp(0.0, 1.0))
    }

    pub fn base_textures(&mut self, base: &Base<'_>) -> Result<Vec<Texture>, GltfError> {
        let mut textures = self.laid(base.texture)?;
        if self.attributes.colors {
            textures.push(Texture {
                pattern: Pattern::VertexColor,
                placement: Placement::default(),
            });
        }
        Ok(textures)
    }

    /// The texture, if there are coordinates to lay it by.
    pub fn laid(&mut self, info: Option<&TextureInfo>) -> Result<Vec<Texture>, GltfError> {
        match info.filter(|_| self.has_coordinates(info)) {
            Some(info) => {
                let texture = self.textures.texture(info, Encoding::Srgb, &self.place)?;
                Ok(vec![texture])
            }
            None => Ok(vec![]),
        }
    }

    /// Whether a texture can be laid; tells of those that cannot.
    pub fn has_coordinates(&mut self, texture: Option<&TextureInfo>) -> bool {
        if texture.is_some() && !self.attributes.coordinates {
            let text = "textures on surfaces without texture coordinates are left out";
            self.notes.count("materials", text, &self.place);
        }
        self.attributes.coordinates
    }

    fn opacity(&mut self) -> Result<Option<Opacity>, GltfError> {
        let base = Base::of(self.material);
        let [_, _, _, alpha] = base.factor.map(|lane| lane.clamp(0.0, 1.0));
        let mode = self.material.alpha_mode.as_deref().unwrap_or("OPAQUE");
        let (factor, cutoff) = match mode {
            "MASK" => (alpha, Some(self.material.alpha_cutoff.unwrap_or(0.5))),
            "BLEND" => (alpha, None),
            "OPAQUE" => return Ok(None),
            other => {
                let fault = format!("there is no alpha mode {other:?}");
                return Err(GltfError::at(&self.place, fault));
            }
        };
        let textures = self.base_textures(&base)?;
        Ok(Some(Opacity {
            factor,
            textures,
            cutoff,
        }))
    }

    fn relief(&mut self) -> Result<Option<Relief>, GltfError> {
        let info = self.material.normal_texture.as_ref();
        let Some(info) = info.filter(|_| self.has_coordinates(info)) else {
            return Ok(None);
        };
        let first = textures_of(self.material).into_iter().next();
        if first.map(coordinate_set) != Some(coordinate_set(info)) {
            let text = "normal textures are laid by the coordinates of the base colour's";
            self.notes.count("materials", text, &self.place);
        }
        let picture = self.textures.texture(info, Encoding::Linear, &self.place)?;
        let scale = info.scale.unwrap_or(1.0);
        Ok(Some(Relief::Normals { picture, scale }))
    }

    fn emission(&mut self) -> Result<Option<EmissionDescription>, GltfError> {
        let strength = self.material.extensions.emissive_strength.as_ref();
        let strength = strength.and_then(|strength| strength.emissive_strength);
        let color = self.material.emissive_factor;
        let luminance = luminance_of(color) * strength.unwrap_or(1.0);
        if color.iter().any(|lane| *lane < 0.0) || !(luminance >= 0.0 && luminance.is_finite()) {
            return Err(GltfError::at(
                &self.place,
                "its emission is negative or infinite",
            ));
        }
        if luminance == 0.0 {
            return Ok(None);
        }
        self.check_sets();
        let luminance = Luminance::from_candelas_per_square_metre(luminance);
        Ok(Some(EmissionDescription {
            amount: EmissionAmount::Radiance(Amount::Photometric(luminance)),
            spectrum: Some(LaneValues::Rgb(color)),
            textures: self.laid(self.material.emissive_texture.as_ref())?,
            two_sided: self.material.double_sided,
            group: None,
            schedule: None,
        }))
    }

    /// Meshes have one set of texture coordinates.
    fn check_sets(&mut self) {
        let base = Base::of(self.material).texture.map(coordinate_set);
        let emissive = self.material.emissive_texture.as_ref().map(coordinate_set);
        if base.is_some() && emissive.is_some() && base != emissive {
            let text = "emissive textures are laid by the coordinates of the base colour's";
            self.notes.count("materials", text, &self.place);
        }
    }
}

/// Y of linear Rec.709.
pub(super) fn luminance_of([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}
