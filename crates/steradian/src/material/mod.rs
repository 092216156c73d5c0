//! What a surface is made of: picks the [`Brdf`] at a point.

mod bitmap;

pub use bitmap::{Bitmap, BitmapError, Interpolation, Texels, Wrap, linear_from_srgb};

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
pub enum Material {
    /// Absorbs everything.
    Black,
    /// Lambertian reflection.
    Lambertian {
        /// Reflectance of each lane.
        reflectance: Spectrum,
    },
    /// A smooth mirror.
    Mirror {
        /// Reflectance of each lane.
        reflectance: Spectrum,
    },
}

impl Material {
    /// The reflection at a point; `None` when nothing is reflected.
    pub fn brdf_at(&self) -> Option<Brdf> {
        match *self {
            Self::Black => None,
            Self::Lambertian { reflectance } => Some(Brdf::Lambertian(Lambertian { reflectance })),
            Self::Mirror { reflectance } => Some(Brdf::Mirror(Mirror { reflectance })),
        }
    }

    /// Hemispherical reflectance of each lane (the same at every angle of incidence for the models so far).
    pub fn reflectance(&self) -> Spectrum {
        match *self {
            Self::Black => Spectrum::ZERO,
            Self::Lambertian { reflectance } | Self::Mirror { reflectance } => reflectance,
        }
    }

    /// Whether reflection couples single directions, which next-event estimation cannot find.
    pub fn is_specular(&self) -> bool {
        matches!(self, Self::Mirror { .. })
    }
}
