//! A recipe in the lanes of a run: the model at each point of a surface, made once if it is the same at all.

use std::borrow::Cow;
use std::convert::Infallible;
use std::f64::consts::TAU;

use super::{ColorLanes, Recipe, Role, Scalar, Site, Tint, Turn};
use crate::brdf::measured::Reading;
use crate::brdf::{Brdf, Measured};
use crate::geometry::{Direction, gauss};
use crate::quantity::Spectrum;
use crate::spectrum::Wavelengths;

/// Azimuths of a hemispherical mean.
const AZIMUTHS: u32 = 8;

/// A recipe whose parameters have been checked.
#[derive(Clone, Debug, PartialEq)]
pub struct PreparedRecipe {
    recipe: Recipe<Tint, Scalar>,
    /// The model itself where nothing varies, else one that shares its tables with those at points.
    base: Brdf,
    is_constant: bool,
}

impl PreparedRecipe {
    /// A recipe that at the factors of its tints and numbers is this model.
    pub fn new(recipe: Recipe<Tint, Scalar>, base: Brdf) -> Self {
        let lanes = recipe.all_lanes();
        let numbers = recipe.all_numbers();
        let is_constant = lanes.into_iter().all(Tint::is_constant)
            && numbers.iter().all(|number| number.picture.is_none())
            && !recipe.follows_wavelengths();
        Self {
            base,
            is_constant,
            recipe,
        }
    }

    /// The model at a point for a path of these wavelengths; `None` where a texture makes its parameters impossible.
    pub fn brdf(
        &self,
        site: &Site,
        colors: &ColorLanes,
        wavelengths: &Wavelengths,
    ) -> Option<Cow<'_, Brdf>> {
        if self.is_constant {
            return Some(Cow::Borrowed(&self.base));
        }
        let Ok(values) = self.recipe.turn(&mut AtPoint {
            site,
            colors,
            wavelengths,
        });
        values.brdf(Some(&self.base)).ok().map(Cow::Owned)
    }

    /// Of light that comes evenly from the whole hemisphere outside, the shares that are reflected and transmitted,
    /// where the factors stand for what varies: (1/π) ∫ (albedo, transmittance) cosθ dω, by Gauss's rule in cosθ at
    /// eight azimuths.
    pub fn hemispherical(&self) -> [Spectrum; 2] {
        let mut shares = [Spectrum::ZERO; 2];
        for &(node, weight) in gauss::rule(16) {
            let cos = 0.5 * (1.0 + node);
            let part = (weight * cos / f64::from(AZIMUTHS)) as f32;
            for k in 0..AZIMUTHS {
                let phi = TAU * (f64::from(k) + 0.5) / f64::from(AZIMUTHS);
                let wo = Direction::from_polar((1.0 - cos * cos).sqrt(), cos, phi);
                shares[0] += self.base.albedo(wo) * part;
                shares[1] += self.base.transmittance(wo) * part;
            }
        }
        shares
    }

    /// The model where nothing varies.
    pub fn constant(&self) -> Option<&Brdf> {
        self.is_constant.then_some(&self.base)
    }

    /// What it is made from.
    pub const fn recipe(&self) -> &Recipe<Tint, Scalar> {
        &self.recipe
    }

    /// Whether single directions are all that it couples.
    pub fn is_specular(&self) -> bool {
        self.recipe.is_specular()
    }

    /// Whether light goes through.
    pub fn transmits(&self) -> bool {
        self.recipe.transmits()
    }

    /// Whether light also goes straight through.
    pub const fn is_pane(&self) -> bool {
        matches!(self.recipe, Recipe::Pane { .. })
    }
}

/// Looks everything up at a point.
struct AtPoint<'a> {
    site: &'a Site,
    colors: &'a ColorLanes,
    wavelengths: &'a Wavelengths,
}

impl Turn<'_, Tint, Scalar> for AtPoint<'_> {
    type Lanes = [f64; 4];
    type Number = f64;
    type Error = Infallible;

    fn lanes(&mut self, _: &'static str, role: Role, tint: &Tint) -> Result<[f64; 4], Infallible> {
        let lanes = self.colors.tint(tint, self.site, self.wavelengths);
        Ok(lanes.map(|lane| role.limited(f64::from(lane))))
    }

    fn number(&mut self, _: &'static str, number: &Scalar) -> Result<f64, Infallible> {
        Ok(number.at(self.site))
    }

    fn table(&mut self, table: &Measured) -> Result<Measured, Infallible> {
        let ColorLanes::Spectral { grid, .. } = self.colors else {
            return Ok(table.clone());
        };
        let places = self.wavelengths.places.map(f64::from);
        let lanes = Reading::Wavelengths(places.map(|place| grid.wavelength(place)));
        Ok(table.in_lanes(lanes).unwrap_or_else(|| table.clone()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Hue;

    #[test]
    fn evenly_lit_glass_reflects_its_average() {
        let recipe = Recipe::Dielectric {
            ior: 1.5,
            exterior_ior: 1.0,
            roughness: None,
        };
        let values = Recipe::Dielectric {
            ior: 1.5,
            exterior_ior: 1.0,
            roughness: None,
        };
        let glass = PreparedRecipe::new(recipe, values.brdf(None).unwrap());
        let [reflected, transmitted] = glass.hemispherical().map(|share| share.mean());
        // Walsh's formula: .091777 for an index of 1.5.
        assert!((reflected - 0.091_777).abs() < 2e-5, "{reflected}");
        assert!((reflected + transmitted - 1.0).abs() < 1e-6);
    }

    #[test]
    fn evenly_lit_paper_reflects_its_reflectance() {
        let tint = |lane| Tint {
            hue: Hue {
                lanes: [lane; 4],
                curve: None,
            },
            textures: vec![],
        };
        let recipe = Recipe::DiffuseTransmission {
            reflectance: tint(0.5),
            transmittance: tint(0.25),
        };
        let values = Recipe::DiffuseTransmission {
            reflectance: [0.5; 4],
            transmittance: [0.25; 4],
        };
        let paper = PreparedRecipe::new(recipe, values.brdf(None).unwrap());
        let shares = paper.hemispherical().map(|share| share.mean());
        assert!((shares[0] - 0.5).abs() < 1e-6 && (shares[1] - 0.25).abs() < 1e-6);
        assert!(paper.constant().is_some());
    }
}
