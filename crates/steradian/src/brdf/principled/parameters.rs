//! glTF's numbers.

use crate::brdf::ModelError;
use crate::brdf::error::{in_range, share};
use crate::quantity::Spectrum;

/// The numbers of a [`Principled`](crate::brdf::Principled) material, by default those of glTF: white metal, fully rough.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Diffuse reflectance of dielectrics, highlights of metals, tint of transmission.
    pub base_color: Spectrum,
    /// Share of metal.
    pub metallic: f64,
    /// Square root of the facets' width α.
    pub roughness: f64,
    /// Index of refraction over that outside.
    pub ior: f64,
    /// Strength of a dielectric's highlights.
    pub specular: f64,
    /// Their colour along the normal; may exceed 1.
    pub specular_color: Spectrum,
    /// Share of the dielectric that lets light through instead of scattering it.
    pub transmission: f64,
    /// Whether it is a sheet without inside, as it is without KHR_materials_volume.
    pub thin: bool,
    /// Strength of the coat.
    pub clearcoat: f64,
    /// Its roughness.
    pub clearcoat_roughness: f64,
    /// Colour of the sheen; black for none.
    pub sheen_color: Spectrum,
    /// Its roughness.
    pub sheen_roughness: f64,
    /// How much wider the facets are along the tangent.
    pub anisotropy: f64,
    /// From the x axis to that tangent, counter-clockwise, in rad.
    pub anisotropy_rotation: f64,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            base_color: Spectrum::ONE,
            metallic: 0.0,
            roughness: 1.0,
            ior: 1.5,
            specular: 1.0,
            specular_color: Spectrum::ONE,
            transmission: 0.0,
            thin: true,
            clearcoat: 0.0,
            clearcoat_roughness: 0.0,
            sheen_color: Spectrum::ZERO,
            sheen_roughness: 0.0,
            anisotropy: 0.0,
            anisotropy_rotation: 0.0,
        }
    }
}

impl Parameters {
    /// Itself, if every number is in its range.
    pub(super) fn checked(&self) -> Result<&Self, ModelError> {
        for (name, number) in [
            ("metallic", self.metallic),
            ("roughness", self.roughness),
            ("specular", self.specular),
            ("transmission", self.transmission),
            ("clearcoat", self.clearcoat),
            ("clearcoat roughness", self.clearcoat_roughness),
            ("sheen roughness", self.sheen_roughness),
            ("anisotropy", self.anisotropy),
        ] {
            in_range(name, number, [0.0, 1.0])?;
        }
        in_range("ior", self.ior, [1.0, 10.0])?;
        in_range("anisotropy rotation", self.anisotropy_rotation, [-1e3, 1e3])?;
        share("base color", self.base_color)?;
        share("sheen color", self.sheen_color)?;
        for lane in self.specular_color.to_lanes() {
            in_range("specular color", f64::from(lane), [0.0, 1e3])?;
        }
        Ok(self)
    }
}
