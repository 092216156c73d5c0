//! glTF's material, with what it is made from.

use super::turn::Turn;
use super::{Recipe, Role, Turned};
use crate::brdf::{Brdf, ModelError, Principled, PrincipledParameters};
use crate::quantity::Spectrum;

/// Parameters of glTF's metallic-roughness material and its extensions.
#[derive(Clone, Debug, PartialEq)]
pub struct PrincipledRecipe<L, N> {
    /// Reflectance of dielectrics below their gloss, highlights of metals, tint of transmission.
    pub base_color: L,
    /// Share of metal, 0 to 1.
    pub metallic: N,
    /// Square root of the facets' width, 0 to 1.
    pub roughness: N,
    /// Index of refraction.
    pub ior: f64,
    /// Strength of a dielectric's highlights, 0 to 1.
    pub specular: N,
    /// Their colour along the normal.
    pub specular_color: L,
    /// Share of the dielectric that lets light through; none for an opaque surface.
    pub transmission: Option<N>,
    /// Whether it is a sheet without inside.
    pub thin: bool,
    /// Strength of the coat, 0 to 1.
    pub clearcoat: N,
    /// Its roughness, 0 to 1.
    pub clearcoat_roughness: N,
    /// Colour of the sheen.
    pub sheen_color: L,
    /// Its roughness, 0 to 1.
    pub sheen_roughness: N,
    /// How much wider the facets are along the tangent, 0 to 1.
    pub anisotropy: N,
    /// From the first tangent to that one in rad.
    pub anisotropy_rotation: N,
}

impl<L, N> PrincipledRecipe<L, N> {
    /// A sheet of this base colour without extensions; black and white are those of the lanes.
    pub fn new(base_color: L, [black, white]: [L; 2]) -> Self
    where
        N: From<f64>,
    {
        let number = |number: f64| N::from(number);
        Self {
            base_color,
            metallic: number(0.0),
            roughness: number(1.0),
            ior: 1.5,
            specular: number(1.0),
            specular_color: white,
            transmission: None,
            thin: true,
            clearcoat: number(0.0),
            clearcoat_roughness: number(0.0),
            sheen_color: black,
            sheen_roughness: number(0.0),
            anisotropy: number(0.0),
            anisotropy_rotation: number(0.0),
        }
    }

    pub(super) fn turn<'a, T: Turn<'a, L, N>>(&'a self, with: &mut T) -> Turned<'a, T, L, N> {
        let transmission = self.transmission.as_ref();
        Ok(Recipe::Principled(Box::new(PrincipledRecipe {
            base_color: with.lanes("base_color", Role::Share, &self.base_color)?,
            metallic: with.number("metallic", &self.metallic)?,
            roughness: with.number("roughness", &self.roughness)?,
            ior: self.ior,
            specular: with.number("specular", &self.specular)?,
            specular_color: with.lanes(
                "specular_color",
                Role::Coefficient,
                &self.specular_color,
            )?,
            transmission: transmission
                .map(|number| with.number("transmission", number))
                .transpose()?,
            thin: self.thin,
            clearcoat: with.number("clearcoat", &self.clearcoat)?,
            clearcoat_roughness: with.number("clearcoat_roughness", &self.clearcoat_roughness)?,
            sheen_color: with.lanes("sheen_color", Role::Share, &self.sheen_color)?,
            sheen_roughness: with.number("sheen_roughness", &self.sheen_roughness)?,
            anisotropy: with.number("anisotropy", &self.anisotropy)?,
            anisotropy_rotation: with.number("anisotropy_rotation", &self.anisotropy_rotation)?,
        })))
    }
}

impl PrincipledRecipe<[f64; 4], f64> {
    pub(super) fn brdf(&self) -> Result<Brdf, ModelError> {
        let color = |lanes: [f64; 4]| Spectrum::from_lanes(lanes.map(|lane| lane as f32));
        Principled::new(&PrincipledParameters {
            base_color: color(self.base_color),
            metallic: self.metallic,
            roughness: self.roughness,
            ior: self.ior,
            specular: self.specular,
            specular_color: color(self.specular_color),
            transmission: self.transmission.unwrap_or(0.0),
            thin: self.thin,
            clearcoat: self.clearcoat,
            clearcoat_roughness: self.clearcoat_roughness,
            sheen_color: color(self.sheen_color),
            sheen_roughness: self.sheen_roughness,
            anisotropy: self.anisotropy,
            anisotropy_rotation: self.anisotropy_rotation,
        })
        .map(|model| Brdf::Principled(Box::new(model)))
    }
}
