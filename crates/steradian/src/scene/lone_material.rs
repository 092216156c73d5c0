//! A material without a scene, for looking at its model alone.

use std::borrow::Cow;

use super::curves::Curves;
use super::description::MaterialDescription;
use super::{Part, Problem, materials};
use crate::brdf::Brdf;
use crate::material::{ColorLanes, Material, Site};
use crate::spectrum::{Lanes, MAX_LANES, Wavelengths};

/// A material in the lanes of a run.
pub struct LoneMaterial {
    material: Material,
    colors: ColorLanes,
}

impl LoneMaterial {
    /// Prepares a material that stands for itself.
    ///
    /// # Errors
    /// If a key is wrong, or the material names others.
    pub fn new(description: &MaterialDescription, lanes: &Lanes) -> Result<Self, Problem> {
        let mut curves = Curves::default();
        let part = Part::Material(0);
        let material = materials::one_sided(description, &[], lanes, &mut curves)
            .map_err(|(key, message)| Problem::at(part, key, message))?
            .ok_or_else(|| Problem::at(part, "model", "this material only names others"))?;
        Ok(Self {
            colors: ColorLanes::new(lanes, &curves.0),
            material,
        })
    }

    /// The material.
    pub const fn material(&self) -> &Material {
        &self.material
    }

    /// The model at these wavelengths in nm, which count only where lanes are wavelengths; textures are those of the
    /// origin of texture coordinates. `None` if it is black.
    pub fn brdf(&self, wavelengths: [f64; MAX_LANES]) -> Option<Cow<'_, Brdf>> {
        let places = match &self.colors {
            ColorLanes::Spectral { grid, .. } => wavelengths.map(|nm| grid.place(nm) as f32),
            ColorLanes::Rgb | ColorLanes::Grey => [0.0; MAX_LANES],
        };
        let wavelengths = Wavelengths {
            places,
            weights: [1.0; MAX_LANES],
        };
        self.material
            .brdf(&Site::NOWHERE, &self.colors, &wavelengths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::Lambertian;
    use crate::quantity::Spectrum;
    use crate::scene::description::{LaneValues, MaterialModel};
    use crate::spectrum::{Beyond, Curve};

    fn lambertian(reflectance: LaneValues) -> MaterialDescription {
        let reflectance = reflectance.into();
        MaterialDescription::new("a", MaterialModel::Lambertian { reflectance })
    }

    #[test]
    fn lanes_are_the_wavelengths_that_are_asked_for() {
        let line = Curve::new(vec![(400.0, 0.0), (700.0, 0.75)], Beyond::Held).unwrap();
        let lanes = Lanes::spectral([400.0, 700.0], vec![]).unwrap();
        let alone = LoneMaterial::new(&lambertian(LaneValues::table(line)), &lanes).unwrap();
        let found = alone.brdf([450.0, 500.0, 600.0, 650.0]).unwrap();
        let Brdf::Lambertian(Lambertian { reflectance }) = found.as_ref() else {
            panic!("{found:?}")
        };
        let expected = [0.125, 0.25, 0.5, 0.625];
        let off = reflectance.to_lanes().into_iter().zip(expected);
        assert!(
            off.into_iter()
                .all(|(a, b): (f32, f32)| (a - b).abs() < 1e-6),
            "{reflectance:?}"
        );
    }

    #[test]
    fn materials_that_name_others_do_not_stand_alone() {
        let named = || "other".to_owned();
        let sides = MaterialModel::TwoSided {
            front: named(),
            back: named(),
        };
        let description = MaterialDescription::new("a", sides);
        let problem = LoneMaterial::new(&description, &Lanes::rgb())
            .err()
            .unwrap();
        assert!(problem.message.contains("names others"));
        let grey = LoneMaterial::new(&lambertian(LaneValues::Uniform(0.5)), &Lanes::rgb());
        let found = grey.unwrap();
        let expected = Spectrum::from_lanes([0.5, 0.5, 0.5, 0.0]);
        let brdf = found.brdf([0.0; 4]).unwrap().into_owned();
        assert_eq!(
            brdf,
            Brdf::Lambertian(Lambertian {
                reflectance: expected
            })
        );
    }
}
