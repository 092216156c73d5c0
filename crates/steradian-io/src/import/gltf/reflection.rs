//! How surfaces reflect: the metallic-roughness model with its extensions, as `principled` materials.
//!
//! | extension | read | left out |
//! |---|---|---|
//! | core | base colour, metallic (blue), roughness (green), normals | occlusion |
//! | KHR_materials_ior, _specular | index; strength (alpha) and colour of highlights | an index of 0 |
//! | KHR_materials_transmission | its share (red) | |
//! | KHR_materials_volume | attenuation; a thickness makes the surface that of a solid | how thick it is |
//! | KHR_materials_clearcoat | strength (red), roughness (green) | its normals |
//! | KHR_materials_sheen | colour, roughness (alpha) | |
//! | KHR_materials_anisotropy | strength, rotation | its texture; all of it where roughness is a texture |
//!
//! Factors multiply textures. Unlit materials and those of specular-glossiness stay diffuse: the latter reflects
//! ρ = c_d (1 − max c_s) + c_s, with c_s left out where c_d is a texture. Source: Khronos, *glTF 2.0 Specification*
//! (2021), §3.9.2, and the texts of the extensions.

use steradian::scene::description::{
    LaneValues, MaterialModel, Media, PrincipledRecipe, Recipe, Scalar, Varying,
    absorption_of_attenuation,
};

use super::error::GltfError;
use super::materials::Reader;
use super::schema::{Material, TextureInfo};

/// Channels of a picture.
const RED: usize = 0;
const GREEN: usize = 1;
const BLUE: usize = 2;
const ALPHA: usize = 3;

/// The recipe of a surface.
type Principled = PrincipledRecipe<Varying, Scalar>;

/// Base colour and alpha.
pub(super) struct Base<'m> {
    pub factor: [f64; 4],
    pub texture: Option<&'m TextureInfo>,
}

impl<'m> Base<'m> {
    pub fn of(material: &'m Material) -> Self {
        if let Some(model) = &material.extensions.specular_glossiness {
            let [r, g, b, alpha] = model.diffuse_factor.unwrap_or([1.0; 4]);
            let specular = model.specular_factor.unwrap_or([1.0; 3]);
            let texture = model.diffuse_texture.as_ref();
            let rest = 1.0 - specular.into_iter().fold(0.0, f64::max);
            let added = specular.map(|lane| if texture.is_some() { 0.0 } else { lane });
            let [r, g, b] = [
                r * rest + added[0],
                g * rest + added[1],
                b * rest + added[2],
            ];
            let factor = [r, g, b, alpha];
            return Self { factor, texture };
        }
        let model = &material.pbr_metallic_roughness;
        Self {
            factor: model.base_color_factor.unwrap_or([1.0; 4]),
            texture: model.base_color_texture.as_ref(),
        }
    }
}

/// The textures that a material is laid with, that of the base colour first.
pub(super) fn textures_of(material: &Material) -> Vec<&TextureInfo> {
    let extensions = &material.extensions;
    let of_metal = &material.pbr_metallic_roughness.metallic_roughness_texture;
    let mut found = vec![
        Base::of(material).texture,
        material.emissive_texture.as_ref(),
        of_metal.as_ref(),
    ];
    let transmission = extensions.transmission.as_ref();
    found.push(transmission.and_then(|found| found.transmission_texture.as_ref()));
    if let Some(specular) = &extensions.specular {
        let textures = [&specular.specular_texture, &specular.specular_color_texture];
        found.extend(textures.map(Option::as_ref));
    }
    if let Some(coat) = &extensions.clearcoat {
        let textures = [&coat.clearcoat_texture, &coat.clearcoat_roughness_texture];
        found.extend(textures.map(Option::as_ref));
    }
    if let Some(sheen) = &extensions.sheen {
        let textures = [&sheen.sheen_color_texture, &sheen.sheen_roughness_texture];
        found.extend(textures.map(Option::as_ref));
    }
    found.push(material.normal_texture.as_ref());
    found.into_iter().flatten().collect()
}

impl Reader<'_, '_> {
    pub fn model(&mut self) -> Result<MaterialModel, GltfError> {
        let base = Base::of(self.material);
        let [r, g, b, _] = self.fractions(base.factor);
        let color = Varying {
            factor: LaneValues::Rgb([r, g, b]),
            textures: self.base_textures(&base)?,
        };
        let extensions = &self.material.extensions;
        if extensions.unlit.is_some() || extensions.specular_glossiness.is_some() {
            return Ok(MaterialModel::Lambertian { reflectance: color });
        }
        let mut recipe = Principled::new(
            color,
            [0.0, 1.0].map(|grey| LaneValues::Uniform(grey).into()),
        );
        self.add_metal(&mut recipe)?;
        self.add_highlights(&mut recipe)?;
        self.add_transmission(&mut recipe)?;
        self.add_clearcoat(&mut recipe)?;
        self.add_sheen(&mut recipe)?;
        self.add_anisotropy(&mut recipe);
        Ok(MaterialModel::Recipe(Recipe::Principled(Box::new(recipe))))
    }

    /// What the inside of a solid absorbs.
    pub fn media(&mut self) -> Media<LaneValues> {
        let inside = self.attenuation();
        Media {
            inside,
            outside: None,
        }
    }

    fn attenuation(&mut self) -> Option<LaneValues> {
        let volume = self.material.extensions.volume.as_ref()?;
        let distance = volume.attenuation_distance?;
        let is_solid = volume.thickness_factor > 0.0 && distance.is_finite();
        let color = volume.attenuation_color.filter(|_| is_solid)?;
        // Black would need an infinite absorption: what 0.1 % of the light is left of stands for it.
        let color = LaneValues::Rgb(color.map(|lane| lane.clamp(1e-3, 1.0)));
        let absorption = absorption_of_attenuation(&color, distance);
        if absorption.is_none() {
            let text = "attenuation distances of 0 and less are left out";
            self.notes.count("materials", text, &self.place);
        }
        absorption
    }

    fn add_metal(&mut self, recipe: &mut Principled) -> Result<(), GltfError> {
        let model = &self.material.pbr_metallic_roughness;
        let texture = model.metallic_roughness_texture.as_ref();
        let metallic = model.metallic_factor.unwrap_or(1.0);
        let roughness = model.roughness_factor.unwrap_or(1.0);
        recipe.metallic = self.number(metallic, texture, BLUE)?;
        recipe.roughness = self.number(roughness, texture, GREEN)?;
        Ok(())
    }

    fn add_highlights(&mut self, recipe: &mut Principled) -> Result<(), GltfError> {
        let extensions = &self.material.extensions;
        let ior = extensions.ior.as_ref().and_then(|index| index.ior);
        if let Some(ior) = ior {
            recipe.ior = self.index(ior);
        }
        let Some(specular) = &extensions.specular else {
            return Ok(());
        };
        let strength = specular.specular_factor.unwrap_or(1.0);
        recipe.specular = self.number(strength, specular.specular_texture.as_ref(), ALPHA)?;
        let color = specular.specular_color_factor.unwrap_or([1.0; 3]);
        recipe.specular_color = Varying {
            factor: LaneValues::Rgb(color.map(|lane| lane.max(0.0))),
            textures: self.laid(specular.specular_color_texture.as_ref())?,
        };
        Ok(())
    }

    /// An index of refraction; 0 stands for one that reflects everything.
    fn index(&mut self, ior: f64) -> f64 {
        if !(1.0..=10.0).contains(&ior) {
            let text = "indices of refraction beyond 1 to 10 are cut off";
            self.notes.count("materials", text, &self.place);
        }
        match ior {
            0.0 => 10.0,
            ior => ior.clamp(1.0, 10.0),
        }
    }

    fn add_transmission(&mut self, recipe: &mut Principled) -> Result<(), GltfError> {
        let extensions = &self.material.extensions;
        if let Some(found) = &extensions.transmission
            && found.transmission_factor > 0.0
        {
            let texture = found.transmission_texture.as_ref();
            recipe.transmission = Some(self.number(found.transmission_factor, texture, RED)?);
        }
        let volume = extensions.volume.as_ref();
        recipe.thin = volume.is_none_or(|volume| volume.thickness_factor <= 0.0);
        Ok(())
    }

    fn add_clearcoat(&mut self, recipe: &mut Principled) -> Result<(), GltfError> {
        let Some(coat) = &self.material.extensions.clearcoat else {
            return Ok(());
        };
        let texture = coat.clearcoat_texture.as_ref();
        recipe.clearcoat = self.number(coat.clearcoat_factor, texture, RED)?;
        let texture = coat.clearcoat_roughness_texture.as_ref();
        recipe.clearcoat_roughness =
            self.number(coat.clearcoat_roughness_factor, texture, GREEN)?;
        Ok(())
    }

    fn add_sheen(&mut self, recipe: &mut Principled) -> Result<(), GltfError> {
        let Some(sheen) = &self.material.extensions.sheen else {
            return Ok(());
        };
        recipe.sheen_color = Varying {
            factor: LaneValues::Rgb(self.fractions(sheen.sheen_color_factor)),
            textures: self.laid(sheen.sheen_color_texture.as_ref())?,
        };
        let texture = sheen.sheen_roughness_texture.as_ref();
        recipe.sheen_roughness = self.number(sheen.sheen_roughness_factor, texture, ALPHA)?;
        Ok(())
    }

    fn add_anisotropy(&mut self, recipe: &mut Principled) {
        let Some(found) = &self.material.extensions.anisotropy else {
            return;
        };
        if found.anisotropy_texture.is_some() {
            let text = "textures of anisotropy are left out";
            self.notes.count("materials", text, &self.place);
        }
        // Facets of other widths along each tangent have tables of their own, too costly for every point.
        if recipe.roughness.picture.is_some() {
            let text = "anisotropy of surfaces whose roughness is a texture is left out";
            self.notes.count("materials", text, &self.place);
            return;
        }
        let [strength] = self.fractions([found.anisotropy_strength]);
        recipe.anisotropy = strength.into();
        recipe.anisotropy_rotation = found.anisotropy_rotation.into();
    }

    /// A factor of a channel of a texture, if there are coordinates to lay it by.
    fn number(
        &mut self,
        factor: f64,
        texture: Option<&TextureInfo>,
        channel: usize,
    ) -> Result<Scalar, GltfError> {
        let [factor] = self.fractions([factor]);
        let picture = match texture.filter(|_| self.has_coordinates(texture)) {
            Some(info) => Some(self.textures.channel(info, channel, &self.place)?),
            None => None,
        };
        Ok(Scalar { factor, picture })
    }
}
