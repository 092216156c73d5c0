//! A reflection model with what it is made from: lanes `L` and numbers `N`, in whatever form they are known so far.
//!
//! | lanes, numbers | where |
//! |---|---|
//! | [`Varying`](crate::scene::description::Varying), [`Scalar`](super::Scalar) | as an author states them |
//! | [`Tint`](super::Tint), [`Scalar`](super::Scalar) | in the lanes of a run |
//! | `[f64; 4]`, `f64` | at a point of a surface: [`brdf`](Recipe::brdf) |

mod model;
mod principled;
mod questions;
mod turn;

pub use principled::PrincipledRecipe;
pub use turn::{Role, Turn, Turned};

use crate::brdf::{Measured, Shadowing, Slopes};

/// A model and its parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Recipe<L, N> {
    /// ρ/π.
    Lambertian {
        /// Directional-hemispherical reflectance.
        reflectance: L,
    },
    /// A mirror of constant reflectance.
    Mirror {
        /// Specular reflectance.
        reflectance: L,
    },
    /// Rough diffuse reflection, single scattering.
    OrenNayar {
        /// Of the facets.
        reflectance: L,
        /// Standard deviation of the facets' slope angle in rad.
        sigma: N,
    },
    /// Rough diffuse reflection that keeps its energy.
    EnergyPreservingOrenNayar {
        /// Of the facets.
        reflectance: L,
        /// 0 to 1.
        roughness: N,
    },
    /// Diffuse reflection and a glossy lobe.
    Phong {
        /// Diffuse reflectance.
        diffuse: L,
        /// Reflectance of the lobe.
        glossy: L,
        /// Of the cosine.
        exponent: N,
    },
    /// Diffuse reflection and transmission.
    DiffuseTransmission {
        /// Diffuse reflectance.
        reflectance: L,
        /// Diffuse transmittance.
        transmittance: L,
    },
    /// Metal, polished or rough.
    Conductor {
        /// Real part of the index of refraction.
        eta: L,
        /// Imaginary part.
        kappa: L,
        /// None for a polished one.
        roughness: Option<Roughness>,
    },
    /// An interface of two dielectrics, smooth or rough.
    Dielectric {
        /// Index of refraction inside, where the normal does not point.
        ior: f64,
        /// Index of refraction outside.
        exterior_ior: f64,
        /// None for a smooth one.
        roughness: Option<Roughness>,
    },
    /// A thin pane of glass.
    Pane {
        /// Index of refraction of the glass.
        ior: f64,
        /// Internal transmittance along the normal.
        transmittance: L,
    },
    /// A measured surface.
    Measured(Measured),
    /// A coat over a diffuse base, smooth or rough.
    Plastic {
        /// Index of refraction of the coat.
        ior: f64,
        /// Reflectance of the base.
        diffuse: L,
        /// None for a smooth coat.
        roughness: Option<Roughness>,
    },
    /// Ward's gloss.
    Ward {
        /// Diffuse reflectance.
        diffuse: L,
        /// Reflectance of the lobe.
        specular: L,
        /// Widths along x and y.
        alpha: [f64; 2],
    },
    /// A material of Radiance.
    Radiance {
        /// Which.
        kind: RadianceKind,
        /// Of the base, and of a metal's highlights.
        color: L,
        /// What is reflected in the lobe.
        specularity: N,
        /// Width of the lobe.
        roughness: N,
    },
    /// glTF's material.
    Principled(Box<PrincipledRecipe<L, N>>),
    /// Several models side by side.
    Mixture {
        /// The models.
        parts: Vec<Self>,
        /// Their shares of the area.
        weights: Vec<f64>,
    },
}

/// Radiance's materials.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum RadianceKind {
    /// Highlights without colour.
    Plastic,
    /// Highlights of the base's colour.
    Metal,
    /// A plastic that lets light through.
    Trans {
        /// What gets into the surface and leaves on the other side.
        transmissivity: f64,
        /// The share of that which goes straight on.
        transmitted_specularity: f64,
    },
}

/// How rough an interface is.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Roughness {
    /// How the facets' slopes are distributed.
    pub slopes: Slopes,
    /// Widths along x and y.
    pub alpha: [f64; 2],
    /// Whether facets that hide from one direction tend to hide from the other.
    pub shadowing: Shadowing,
    /// Whether the light that facets pass to one another counts.
    pub multiple_scattering: bool,
}
