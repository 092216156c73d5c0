//! What a surface is made of: picks the [`Brdf`] at a point, and says how much of the light is stopped there.

mod bitmap;
mod texture;

pub use bitmap::{Bitmap, BitmapError, Interpolation, Texels, Wrap, linear_from_srgb};
pub use texture::{ColorLanes, Hue, Pattern, Site, Texture, Tint};

use crate::brdf::{Brdf, Lambertian, Mirror};
use crate::quantity::Spectrum;

/// A material, by number.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub u32);

impl MaterialId {
    /// The material of a shape that names none: absorbs everything.
    pub const BLACK: Self = Self(0);
}

/// A prepared material of one side of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// How it reflects.
    pub model: Model,
    /// The part of the light that it stops; `None` is all of it.
    pub opacity: Option<Opacity>,
}

/// How a material reflects.
#[derive(Clone, Debug, PartialEq)]
pub enum Model {
    /// Absorbs everything.
    Black,
    /// Lambertian reflection.
    Lambertian {
        /// Directional-hemispherical reflectance.
        reflectance: Tint,
    },
    /// A smooth mirror.
    Mirror {
        /// Specular reflectance.
        reflectance: Tint,
    },
}

/// The part of the light that a surface stops; the rest passes straight through.
#[derive(Clone, Debug, PartialEq)]
pub struct Opacity {
    /// Where all textures have alpha 1.
    pub factor: f32,
    /// Their alphas are multiplied.
    pub textures: Vec<Texture>,
    /// Opaque from this alpha on and absent below, instead of partly so.
    pub cutoff: Option<f32>,
}

impl Opacity {
    /// Opacity at a point, 0 to 1.
    pub fn at(&self, site: &Site) -> f32 {
        let alphas = self.textures.iter().map(|texture| texture.alpha(site));
        let alpha = self.factor * alphas.product::<f32>();
        match self.cutoff {
            Some(cutoff) => f32::from(u8::from(alpha >= cutoff)),
            None => alpha.clamp(0.0, 1.0),
        }
    }
}

impl Material {
    /// An opaque material that absorbs everything.
    pub const BLACK: Self = Self {
        model: Model::Black,
        opacity: None,
    };

    /// The reflection at a point where the tint has these lanes; `None` when nothing is reflected.
    pub fn brdf_at(&self, reflectance: Spectrum) -> Option<Brdf> {
        match self.model {
            Model::Black => None,
            Model::Lambertian { .. } => Some(Brdf::Lambertian(Lambertian { reflectance })),
            Model::Mirror { .. } => Some(Brdf::Mirror(Mirror { reflectance })),
        }
    }

    /// Hemispherical reflectance (the same at every angle of incidence for the models so far); `None` if nothing is reflected.
    pub fn reflectance(&self) -> Option<&Tint> {
        match &self.model {
            Model::Black => None,
            Model::Lambertian { reflectance } | Model::Mirror { reflectance } => Some(reflectance),
        }
    }

    /// All textures of reflectance and opacity.
    pub fn textures(&self) -> impl Iterator<Item = &Texture> {
        let reflectance = self.reflectance().map(|tint| &tint.textures);
        let opacity = self.opacity.as_ref().map(|opacity| &opacity.textures);
        reflectance.into_iter().chain(opacity).flatten()
    }

    /// Whether reflection couples single directions, which next-event estimation cannot find.
    pub fn is_specular(&self) -> bool {
        matches!(self.model, Model::Mirror { .. })
    }
}
