//! A reflection model with what it is made from: lanes `L` and numbers `N`, in whatever form they are known so far.
//!
//! | lanes, numbers | where |
//! |---|---|
//! | [`Varying`](crate::scene::description::Varying), [`Scalar`](super::Scalar) | as an author states them |
//! | [`Tint`](super::Tint), [`Scalar`](super::Scalar) | in the lanes of a run |
//! | `[f64; 4]`, `f64` | at a point of a surface: [`brdf`](Recipe::brdf) |

use std::convert::Infallible;

use crate::brdf::{
    Brdf, ComplexIndex, DiffuseTransmission, EnergyPreservingOrenNayar, Facets, Lambertian,
    Measured, Mirror, ModelError, OrenNayar, Pane, Phong, RoughConductor, RoughDielectric, Slopes,
    SmoothConductor, SmoothDielectric,
};
use crate::quantity::Spectrum;

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
}

/// How rough an interface is.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Roughness {
    /// How the facets' slopes are distributed.
    pub slopes: Slopes,
    /// Widths along x and y.
    pub alpha: [f64; 2],
    /// Whether the light that facets pass to one another counts.
    pub multiple_scattering: bool,
}

impl Roughness {
    fn facets(&self) -> Result<Facets, ModelError> {
        Facets::anisotropic(self.slopes, self.alpha)
    }
}

/// What a number in lanes stands for.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Role {
    /// A part of the light, 0 to 1.
    Share,
    /// The real or imaginary part of an index of refraction.
    Index,
}

impl Role {
    /// The nearest possible value: curves and colours are off by their rounding.
    pub fn limited(self, value: f64) -> f64 {
        match self {
            Self::Share => value.clamp(0.0, 1.0),
            Self::Index => value.max(0.0),
        }
    }
}

/// What a recipe is turned with: of each key of the scene file.
pub trait Turn<'a, L, N> {
    /// What lanes become.
    type Lanes;
    /// What numbers become.
    type Number;
    /// Why they cannot.
    type Error;

    /// Turns lanes.
    fn lanes(
        &mut self,
        key: &'static str,
        role: Role,
        lanes: &'a L,
    ) -> Result<Self::Lanes, Self::Error>;

    /// Turns a number.
    fn number(&mut self, key: &'static str, number: &'a N) -> Result<Self::Number, Self::Error>;
}

/// Collects everything.
struct Gather<'a, L, N> {
    lanes: Vec<&'a L>,
    numbers: Vec<&'a N>,
}

impl<'a, L, N> Turn<'a, L, N> for Gather<'a, L, N> {
    type Lanes = ();
    type Number = ();
    type Error = Infallible;

    fn lanes(&mut self, _: &'static str, _: Role, lanes: &'a L) -> Result<(), Infallible> {
        self.lanes.push(lanes);
        Ok(())
    }

    fn number(&mut self, _: &'static str, number: &'a N) -> Result<(), Infallible> {
        self.numbers.push(number);
        Ok(())
    }
}

/// What a turn gives.
pub type Turned<'a, T, L, N> = Result<
    Recipe<<T as Turn<'a, L, N>>::Lanes, <T as Turn<'a, L, N>>::Number>,
    <T as Turn<'a, L, N>>::Error,
>;

impl<L, N> Recipe<L, N> {
    /// The same model with everything turned.
    ///
    /// # Errors
    /// The first that something cannot be turned for.
    pub fn turn<'a, T: Turn<'a, L, N>>(&'a self, with: &mut T) -> Turned<'a, T, L, N> {
        use Role::{Index, Share};
        Ok(match self {
            Self::Lambertian { reflectance } => Recipe::Lambertian {
                reflectance: with.lanes("reflectance", Share, reflectance)?,
            },
            Self::Mirror { reflectance } => Recipe::Mirror {
                reflectance: with.lanes("reflectance", Share, reflectance)?,
            },
            Self::OrenNayar { reflectance, sigma } => Recipe::OrenNayar {
                reflectance: with.lanes("reflectance", Share, reflectance)?,
                sigma: with.number("sigma", sigma)?,
            },
            Self::EnergyPreservingOrenNayar {
                reflectance,
                roughness,
            } => Recipe::EnergyPreservingOrenNayar {
                reflectance: with.lanes("reflectance", Share, reflectance)?,
                roughness: with.number("roughness", roughness)?,
            },
            Self::Phong {
                diffuse,
                glossy,
                exponent,
            } => Recipe::Phong {
                diffuse: with.lanes("diffuse", Share, diffuse)?,
                glossy: with.lanes("glossy", Share, glossy)?,
                exponent: with.number("exponent", exponent)?,
            },
            Self::DiffuseTransmission {
                reflectance,
                transmittance,
            } => Recipe::DiffuseTransmission {
                reflectance: with.lanes("reflectance", Share, reflectance)?,
                transmittance: with.lanes("transmittance", Share, transmittance)?,
            },
            Self::Conductor {
                eta,
                kappa,
                roughness,
            } => Recipe::Conductor {
                eta: with.lanes("eta", Index, eta)?,
                kappa: with.lanes("k", Index, kappa)?,
                roughness: *roughness,
            },
            &Self::Dielectric {
                ior,
                exterior_ior,
                roughness,
            } => Recipe::Dielectric {
                ior,
                exterior_ior,
                roughness,
            },
            Self::Pane { ior, transmittance } => Recipe::Pane {
                ior: *ior,
                transmittance: with.lanes("transmittance", Share, transmittance)?,
            },
            Self::Measured(table) => Recipe::Measured(table.clone()),
        })
    }

    /// All lanes, in the order of the keys.
    pub fn all_lanes(&self) -> Vec<&L> {
        self.gathered().lanes
    }

    /// All numbers, in the order of the keys.
    pub fn all_numbers(&self) -> Vec<&N> {
        self.gathered().numbers
    }

    fn gathered(&self) -> Gather<'_, L, N> {
        let mut gathered = Gather {
            lanes: vec![],
            numbers: vec![],
        };
        let Ok(_) = self.turn(&mut gathered);
        gathered
    }

    /// Whether light goes through the surface.
    pub const fn transmits(&self) -> bool {
        matches!(
            self,
            Self::DiffuseTransmission { .. }
                | Self::Dielectric { .. }
                | Self::Pane { .. }
                | Self::Measured(_)
        )
    }

    /// Whether single directions are all that it couples.
    pub const fn is_specular(&self) -> bool {
        match self {
            Self::Conductor { roughness, .. } | Self::Dielectric { roughness, .. } => {
                roughness.is_none()
            }
            Self::Mirror { .. } | Self::Pane { .. } => true,
            _ => false,
        }
    }

    /// The key, in a scene file, of a model's parameter for which this was found.
    pub fn key(&self, parameter: &'static str, found: f64) -> &'static str {
        match parameter {
            "alpha" => self.key_of_alpha(found),
            "eta" if !matches!(self, Self::Conductor { .. }) => "ior",
            "kappa" => "k",
            "eta + kappa" => "eta",
            "internal transmittance" => "transmittance",
            "diffuse reflectance" | "diffuse and glossy reflectance" => "diffuse",
            "glossy reflectance" => "glossy",
            "reflectance and transmittance" => "reflectance",
            known => known,
        }
    }

    fn key_of_alpha(&self, found: f64) -> &'static str {
        let roughness = match self {
            Self::Conductor { roughness, .. } | Self::Dielectric { roughness, .. } => roughness,
            _ => &None,
        };
        match roughness.map(|roughness| roughness.alpha) {
            Some([x, y]) if x != y && x == found => "alpha_x",
            Some([x, y]) if x != y => "alpha_y",
            _ => "alpha",
        }
    }
}

impl Recipe<[f64; 4], f64> {
    /// The model; one of the same kind and facets gives its tables, if `alike` is one.
    ///
    /// # Errors
    /// If a parameter lies outside its range.
    pub fn brdf(&self, alike: Option<&Brdf>) -> Result<Brdf, ModelError> {
        Ok(match *self {
            Self::Measured(ref table) => Brdf::Measured(table.clone()),
            Self::Lambertian { reflectance } => Brdf::Lambertian(Lambertian {
                reflectance: single(reflectance),
            }),
            Self::Mirror { reflectance } => Brdf::Mirror(Mirror {
                reflectance: single(reflectance),
            }),
            Self::OrenNayar { reflectance, sigma } => {
                Brdf::OrenNayar(OrenNayar::new(single(reflectance), sigma)?)
            }
            Self::EnergyPreservingOrenNayar {
                reflectance,
                roughness,
            } => Brdf::EnergyPreservingOrenNayar(EnergyPreservingOrenNayar::new(
                single(reflectance),
                roughness,
            )?),
            Self::Phong {
                diffuse,
                glossy,
                exponent,
            } => Brdf::Phong(Phong::new(single(diffuse), single(glossy), exponent)?),
            Self::DiffuseTransmission {
                reflectance,
                transmittance,
            } => Brdf::DiffuseTransmission(DiffuseTransmission::new(
                single(reflectance),
                single(transmittance),
            )?),
            Self::Conductor {
                eta,
                kappa,
                roughness,
            } => conductor(ComplexIndex::new(eta, kappa)?, roughness, alike)?,
            Self::Dielectric {
                ior,
                exterior_ior,
                roughness,
            } => dielectric(ior / exterior_ior, roughness)?,
            Self::Pane { ior, transmittance } => Brdf::Pane(Pane::new(ior, transmittance)?),
        })
    }
}

fn conductor(
    index: ComplexIndex,
    roughness: Option<Roughness>,
    alike: Option<&Brdf>,
) -> Result<Brdf, ModelError> {
    let Some(roughness) = roughness else {
        return Ok(Brdf::SmoothConductor(SmoothConductor::new(index)));
    };
    let facets = roughness.facets()?;
    Ok(Brdf::RoughConductor(match alike {
        Some(Brdf::RoughConductor(alike)) => alike.with_index(index),
        _ if roughness.multiple_scattering => RoughConductor::new(facets, index),
        _ => RoughConductor::single_scattering(facets, index),
    }))
}

fn dielectric(eta: f64, roughness: Option<Roughness>) -> Result<Brdf, ModelError> {
    let Some(roughness) = roughness else {
        return Ok(Brdf::SmoothDielectric(SmoothDielectric::new(eta)?));
    };
    let facets = roughness.facets()?;
    Ok(Brdf::RoughDielectric(if roughness.multiple_scattering {
        RoughDielectric::new(facets, eta)?
    } else {
        RoughDielectric::single_scattering(facets, eta)?
    }))
}

fn single(lanes: [f64; 4]) -> Spectrum {
    Spectrum::from_lanes(lanes.map(|lane| lane as f32))
}
