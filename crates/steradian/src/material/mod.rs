//! What a surface is made of: picks the [`Brdf`] at a point, and says how much of the light is stopped there.

mod bitmap;
mod media;
mod prepared;
mod recipe;
mod relief;
mod scalar;
mod texture;

pub use bitmap::{Bitmap, BitmapError, Interpolation, Texels, Wrap, linear_from_srgb};
pub use media::Media;
pub use prepared::PreparedRecipe;
pub use recipe::{PrincipledRecipe, RadianceKind, Recipe, Role, Roughness, Turn, Turned};
pub use relief::{Relief, ReliefKind};
pub use scalar::{Picture, Scalar};
pub use texture::{ColorLanes, Hue, Pattern, Site, Texture, Tint};

use std::borrow::Cow;
use std::sync::Arc;

use crate::brdf::{Brdf, Lambertian, Mirror};
use crate::quantity::Spectrum;
use crate::spectrum::Wavelengths;

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
    /// What absorbs on the sides of the surface, in 1/m.
    pub media: Media<Hue>,
    /// What turns the normal that the model reckons with.
    pub relief: Option<Relief>,
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
    /// Any other model.
    Recipe(Arc<PreparedRecipe>),
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
        media: Media {
            inside: None,
            outside: None,
        },
        relief: None,
    };

    /// The model at a point for a path of these wavelengths; `None` where the surface is black.
    pub fn brdf(
        &self,
        site: &Site,
        colors: &ColorLanes,
        wavelengths: &Wavelengths,
    ) -> Option<Cow<'_, Brdf>> {
        let lanes = |tint| Spectrum::from_lanes(colors.tint(tint, site, wavelengths));
        let made = match &self.model {
            Model::Black => return None,
            Model::Recipe(recipe) => return recipe.brdf(site, colors, wavelengths),
            Model::Lambertian { reflectance } => Brdf::Lambertian(Lambertian {
                reflectance: lanes(reflectance),
            }),
            Model::Mirror { reflectance } => Brdf::Mirror(Mirror {
                reflectance: lanes(reflectance),
            }),
        };
        Some(Cow::Owned(made))
    }

    /// The tint that is the reflectance at every angle of incidence; `None` for a model that has none such.
    pub fn reflectance(&self) -> Option<&Tint> {
        match &self.model {
            Model::Black | Model::Recipe(_) => None,
            Model::Lambertian { reflectance } | Model::Mirror { reflectance } => Some(reflectance),
        }
    }

    /// The tints of the model.
    pub fn tints(&self) -> Vec<&Tint> {
        match &self.model {
            Model::Black => vec![],
            Model::Lambertian { reflectance } | Model::Mirror { reflectance } => vec![reflectance],
            Model::Recipe(recipe) => recipe.recipe().all_lanes(),
        }
    }

    /// All textures of reflectance and opacity.
    pub fn textures(&self) -> impl Iterator<Item = &Texture> {
        let tints = self.tints().into_iter().map(|tint| &tint.textures);
        let opacity = self.opacity.as_ref().map(|opacity| &opacity.textures);
        tints.chain(opacity).flatten()
    }

    /// All pictures that are looked up where the material is met, but for its opacity, each once and with the way in which it is laid.
    pub fn pictures(&self) -> Vec<Picture> {
        let mut all: Vec<Picture> = vec![];
        let numbers = match &self.model {
            Model::Recipe(recipe) => recipe.recipe().all_numbers(),
            _ => vec![],
        };
        let tints = self.tints().into_iter();
        let textures = tints.flat_map(|tint| tint.textures.iter().filter_map(Texture::picture));
        let numbers = numbers.into_iter().filter_map(|it| it.picture.clone());
        let relief = self.relief.as_ref().map(Relief::picture);
        for picture in textures.chain(numbers).chain(relief) {
            if !all.iter().any(|known| known.is_laid_like(&picture)) {
                all.push(picture);
            }
        }
        all
    }

    /// Whether anything of it is laid by texture coordinates.
    pub fn needs_coordinates(&self) -> bool {
        let pictures = match &self.model {
            Model::Recipe(recipe) => recipe.recipe().all_numbers(),
            _ => vec![],
        };
        let laid = |texture: &Texture| texture.pattern != Pattern::VertexColor;
        self.relief.is_some()
            || self.textures().any(laid)
            || pictures.iter().any(|number| number.picture.is_some())
    }

    /// Whether single directions are all that it couples, which next-event estimation cannot find.
    pub fn is_specular(&self) -> bool {
        match &self.model {
            Model::Black | Model::Lambertian { .. } => false,
            Model::Mirror { .. } => true,
            Model::Recipe(recipe) => recipe.is_specular(),
        }
    }

    /// Whether the model lets light through, straight or scattered; an opacity apart.
    pub fn transmits(&self) -> bool {
        matches!(&self.model, Model::Recipe(recipe) if recipe.transmits())
    }

    /// Whether light passes straight through the model, so that next-event rays may: the part given by
    /// [`straight_share`](Self::straight_share); an opacity apart.
    pub fn is_pane(&self) -> bool {
        matches!(&self.model, Model::Recipe(recipe) if recipe.is_pane())
    }

    /// The part of the light that goes straight through the model at this cosine to the normal; an opacity apart.
    pub fn straight_share(
        &self,
        cos_incident: f64,
        site: &Site,
        colors: &ColorLanes,
        wavelengths: &Wavelengths,
    ) -> Spectrum {
        match self.brdf(site, colors, wavelengths).as_deref() {
            Some(Brdf::Pane(pane)) => {
                let passed = pane.shares(cos_incident.abs().min(1.0));
                Spectrum::from_lanes(passed.map(|(_, transmitted)| transmitted as f32))
            }
            _ => Spectrum::ZERO,
        }
    }
}
