//! The model that values give.

use super::{RadianceKind, Recipe, Roughness};
use crate::brdf::{
    Brdf, ComplexIndex, DiffuseTransmission, EnergyPreservingOrenNayar, Facets, Lambertian, Mirror,
    Mixture, ModelError, OrenNayar, Pane, Phong, Plastic, RoughConductor, RoughDielectric,
    RoughPlastic, SmoothConductor, SmoothDielectric, Ward,
};
use crate::quantity::Spectrum;

impl Roughness {
    fn facets(&self) -> Result<Facets, ModelError> {
        let facets = Facets::anisotropic(self.slopes, self.alpha)?;
        Ok(facets.with_shadowing(self.shadowing))
    }
}

impl Recipe<[f64; 4], f64> {
    /// The model; one of the same kind and facets gives its tables, if `alike` is one.
    ///
    /// # Errors
    /// If a parameter lies outside its range.
    pub fn brdf(&self, alike: Option<&Brdf>) -> Result<Brdf, ModelError> {
        Ok(match *self {
            Self::Principled(ref recipe) => recipe.brdf()?,
            Self::Measured(ref table) => Brdf::Measured(table.clone()),
            Self::Mixture {
                ref parts,
                ref weights,
            } => Brdf::Mixture(mixture(parts, weights, alike)?),
            Self::Plastic {
                ior,
                diffuse,
                roughness,
            } => plastic(ior, single(diffuse), roughness)?,
            Self::Ward {
                diffuse,
                specular,
                alpha,
            } => Brdf::Ward(Ward::new(single(diffuse), single(specular), alpha)?),
            Self::Radiance {
                kind,
                color,
                specularity,
                roughness,
            } => Brdf::Ward(radiance(kind, single(color), specularity, roughness)?),
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

fn plastic(ior: f64, diffuse: Spectrum, roughness: Option<Roughness>) -> Result<Brdf, ModelError> {
    let Some(roughness) = roughness else {
        return Ok(Brdf::Plastic(Plastic::new(ior, diffuse)?));
    };
    let facets = roughness.facets()?;
    Ok(Brdf::RoughPlastic(if roughness.multiple_scattering {
        RoughPlastic::new(facets, ior, diffuse)?
    } else {
        RoughPlastic::single_scattering(facets, ior, diffuse)?
    }))
}

fn radiance(
    kind: RadianceKind,
    color: Spectrum,
    specularity: f64,
    roughness: f64,
) -> Result<Ward, ModelError> {
    match kind {
        RadianceKind::Plastic => Ward::radiance_plastic(color, specularity, roughness),
        RadianceKind::Metal => Ward::radiance_metal(color, specularity, roughness),
        RadianceKind::Trans {
            transmissivity,
            transmitted_specularity,
        } => Ward::radiance_trans(
            color,
            [specularity, roughness],
            [transmissivity, transmitted_specularity],
        ),
    }
}

fn mixture(
    parts: &[Recipe<[f64; 4], f64>],
    weights: &[f64],
    alike: Option<&Brdf>,
) -> Result<Mixture, ModelError> {
    let known = match alike {
        Some(Brdf::Mixture(mixture)) => mixture.parts(),
        _ => &[],
    };
    let part = |(index, (part, weight)): (usize, (&Recipe<[f64; 4], f64>, &f64))| {
        let alike = known.get(index).map(|(_, model)| model);
        Ok((*weight, part.brdf(alike)?))
    };
    let parts = parts.iter().zip(weights).enumerate().map(part);
    Mixture::new(parts.collect::<Result<_, _>>()?)
}

fn single(lanes: [f64; 4]) -> Spectrum {
    Spectrum::from_lanes(lanes.map(|lane| lane as f32))
}
