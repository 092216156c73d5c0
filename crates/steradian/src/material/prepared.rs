//! A recipe in the lanes of a run: the model at each point of a surface, made once if it is the same at all.

use std::borrow::Cow;
use std::convert::Infallible;

use super::{ColorLanes, Recipe, Role, Scalar, Site, Tint, Turn};
use crate::brdf::Brdf;
use crate::spectrum::Wavelengths;

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
            && numbers.iter().all(|number| number.picture.is_none());
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

    /// The model where nothing varies.
    pub fn constant(&self) -> Option<&Brdf> {
        self.is_constant.then_some(&self.base)
    }

    /// What it is made from.
    pub const fn recipe(&self) -> &Recipe<Tint, Scalar> {
        &self.recipe
    }

    /// Whether single directions are all that it couples.
    pub const fn is_specular(&self) -> bool {
        self.recipe.is_specular()
    }

    /// Whether light goes through.
    pub const fn transmits(&self) -> bool {
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
}
