//! Everything a recipe is made from, turned into another form or gathered.

use std::convert::Infallible;

use super::Recipe;
use crate::brdf::Measured;

/// What a number in lanes stands for.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Role {
    /// A part of the light, 0 to 1.
    Share,
    /// Part of an index of refraction, or a factor that may exceed 1.
    Coefficient,
}

impl Role {
    /// The nearest possible value: curves and colours are off by their rounding.
    pub fn limited(self, value: f64) -> f64 {
        match self {
            Self::Share => value.clamp(0.0, 1.0),
            Self::Coefficient => value.max(0.0),
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

    /// Turns a measured surface, which is the same unless lanes are turned into others.
    fn table(&mut self, table: &'a Measured) -> Result<Measured, Self::Error> {
        Ok(table.clone())
    }
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
        use Role::{Coefficient, Share};
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
                eta: with.lanes("eta", Coefficient, eta)?,
                kappa: with.lanes("k", Coefficient, kappa)?,
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
            Self::Measured(table) => Recipe::Measured(with.table(table)?),
            Self::Principled(recipe) => return recipe.turn(with),
            Self::Plastic {
                ior,
                diffuse,
                roughness,
            } => Recipe::Plastic {
                ior: *ior,
                diffuse: with.lanes("diffuse", Share, diffuse)?,
                roughness: *roughness,
            },
            Self::Ward {
                diffuse,
                specular,
                alpha,
            } => Recipe::Ward {
                diffuse: with.lanes("diffuse", Share, diffuse)?,
                specular: with.lanes("specular", Share, specular)?,
                alpha: *alpha,
            },
            Self::Radiance {
                kind,
                color,
                specularity,
                roughness,
            } => Recipe::Radiance {
                kind: *kind,
                color: with.lanes("color", Share, color)?,
                specularity: with.number("specularity", specularity)?,
                roughness: with.number("roughness", roughness)?,
            },
            Self::Mixture { parts, weights } => Recipe::Mixture {
                parts: parts
                    .iter()
                    .map(|part| part.turn(with))
                    .collect::<Result<_, _>>()?,
                weights: weights.clone(),
            },
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
}
