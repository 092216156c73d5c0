//! Recipes in the lanes of a run, checked at their factors and at all wavelengths.

use std::convert::Infallible;

use super::Fault;
use super::curves::Curves;
use super::description::{LaneValues, Scalar, Varying};
use super::materials::{check_shares, hue, textures, tint};
use crate::brdf::measured::Reading;
use crate::brdf::{Measured, ModelError};
use crate::material::{Hue, PreparedRecipe, Recipe, Role, Roughness, Tint, Turn};
use crate::spectrum::{Curve, Lanes, Metal};

/// Distance in nm of the wavelengths at which a model is checked.
const STEP: f64 = 5.0;

/// A recipe as an author states it.
pub(super) type Stated = Recipe<Varying, Scalar>;

pub(super) fn prepare(
    stated: &Stated,
    lanes: &Lanes,
    curves: &mut Curves,
) -> Result<PreparedRecipe, Fault> {
    let recipe = stated.turn(&mut InLanes { lanes, curves })?;
    let mut wavelengths = wavelengths(lanes);
    let mut next = || {
        let wavelength = wavelengths.next()?;
        let Ok(values) = recipe.turn(&mut AtFactors { curves, wavelength });
        Some(values)
    };
    let fault = |error| fault(stated, error);
    let Some(first) = next() else {
        return Err(("model", "a run has a wavelength".into()));
    };
    let base = first.brdf(None).map_err(fault)?;
    while let Some(values) = next().filter(|values| *values != first) {
        values.brdf(Some(&base)).map_err(fault)?;
    }
    Ok(PreparedRecipe::new(recipe.clone(), base))
}

/// A metal by name, in what the lanes of the run can be told by.
pub(super) fn metal(
    metal: Metal,
    roughness: Option<Roughness>,
    lanes: &Lanes,
) -> Result<Stated, Fault> {
    let found = metal.in_lanes(lanes);
    let found = found.map_err(|error| ("metal", error.to_string()))?;
    let [eta, kappa] = found.map(|part| match part.curve {
        Some(curve) => Varying::from(LaneValues::table(Curve::clone(&curve))),
        None if lanes.is_rgb() => {
            let [r, g, b, _] = part.lanes;
            LaneValues::Rgb([r, g, b]).into()
        }
        None => LaneValues::Uniform(part.lanes[0]).into(),
    });
    Ok(Recipe::Conductor {
        eta,
        kappa,
        roughness,
    })
}

/// The wavelengths of the run, or one that stands for none.
fn wavelengths(lanes: &Lanes) -> impl Iterator<Item = f64> + use<> {
    let [low, high] = lanes.grid().map_or([0.0; 2], |grid| grid.range());
    let steps = ((high - low) / STEP).ceil() as u32;
    (0..=steps).map(move |step| (low + STEP * f64::from(step)).min(high))
}

/// What is wrong, in the words of the scene file.
fn fault(stated: &Stated, error: ModelError) -> Fault {
    match error {
        ModelError::OutOfRange {
            parameter,
            low,
            high,
            found,
        } => {
            let parameter = stated.key(parameter, found);
            let error = ModelError::OutOfRange {
                parameter,
                low,
                high,
                found,
            };
            (parameter, error.to_string())
        }
        ModelError::GainsEnergy { parts, sum } => (stated.key(parts, sum), error.to_string()),
        ModelError::DifferentIndices { .. } => ("of", error.to_string()),
    }
}

/// Turns what an author states into the lanes of the run.
struct InLanes<'a> {
    lanes: &'a Lanes,
    curves: &'a mut Curves,
}

impl Turn<'_, Varying, Scalar> for InLanes<'_> {
    type Lanes = Tint;
    type Number = Scalar;
    type Error = Fault;

    fn lanes(&mut self, key: &'static str, role: Role, values: &Varying) -> Result<Tint, Fault> {
        let found = match role {
            Role::Share => tint(values, self.lanes, self.curves),
            Role::Coefficient => self.factor(values),
        };
        found.map_err(|message| (key, message))
    }

    fn number(&mut self, key: &'static str, number: &Scalar) -> Result<Scalar, Fault> {
        let picture = number.picture.as_ref();
        let mut placed = picture
            .iter()
            .flat_map(|picture| picture.placement.as_flattened());
        if placed.any(|x| !x.is_finite()) {
            return Err((key, "the placement of a texture is finite".into()));
        }
        if let Some(picture) = picture {
            check_shares(&picture.bitmap).map_err(|message| (key, message))?;
        }
        Ok(number.clone())
    }

    fn table(&mut self, table: &Measured) -> Result<Measured, Fault> {
        let lanes = match self.lanes.grid() {
            Some(grid) => Reading::Wavelengths([grid.range()[0]; 4]),
            None if self.lanes.is_rgb() => Reading::Rgb,
            None => Reading::Luminance,
        };
        let unknown = "this table has colours, which say nothing about wavelengths: state spectrum = \"rgb\", or take a table of spectra";
        table
            .in_lanes(lanes)
            .ok_or_else(|| ("file", unknown.into()))
    }
}

impl InLanes<'_> {
    fn factor(&mut self, values: &Varying) -> Result<Tint, String> {
        Ok(Tint {
            hue: coefficient(&values.factor, self.lanes, self.curves)?,
            textures: textures(&values.textures, self.lanes, self.curves)?,
        })
    }
}

/// A number of at least 0 in the lanes of the run.
pub(super) fn coefficient(
    values: &LaneValues,
    lanes: &Lanes,
    curves: &mut Curves,
) -> Result<Hue, String> {
    let found = lanes
        .coefficient(values)
        .map_err(|error| error.to_string())?;
    Ok(hue(found, curves))
}

/// Values at one wavelength where all textures are 1.
struct AtFactors<'a> {
    curves: &'a Curves,
    wavelength: f64,
}

impl Turn<'_, Tint, Scalar> for AtFactors<'_> {
    type Lanes = [f64; 4];
    type Number = f64;
    type Error = Infallible;

    fn lanes(&mut self, _: &'static str, role: Role, tint: &Tint) -> Result<[f64; 4], Infallible> {
        let curve = tint.hue.curve.map(|id| &self.curves.0[id.0 as usize]);
        let factor = curve.map_or(1.0, |curve| curve.at(self.wavelength));
        let lanes = tint.hue.lanes.map(|lane| f64::from(lane) * factor);
        Ok(lanes.map(|lane| role.limited(lane)))
    }

    fn number(&mut self, _: &'static str, number: &Scalar) -> Result<f64, Infallible> {
        Ok(number.factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::{
        Brdf, ComplexIndex, Facets, OrenNayar, Pane, RoughConductor, Shadowing, Slopes,
    };
    use crate::geometry::Direction;
    use crate::material::{Bitmap, Picture, Texels};
    use crate::material::{ColorLanes, Material, Media, Model, Roughness, Site};
    use crate::quantity::Spectrum;
    use crate::spectrum::{Curve, Grid, Wavelengths};
    use std::sync::Arc;

    fn rgb(lanes: [f64; 3]) -> Varying {
        LaneValues::Rgb(lanes).into()
    }

    fn material(stated: &Stated) -> Result<Material, Fault> {
        let recipe = prepare(stated, &Lanes::rgb(), &mut Curves::default())?;
        Ok(Material {
            model: Model::Recipe(Arc::new(recipe)),
            opacity: None,
            media: Media::default(),
            relief: None,
        })
    }

    fn in_rgb(material: &Material) -> Brdf {
        let found = material.brdf(&Site::NOWHERE, &ColorLanes::Rgb, &Wavelengths::default());
        found.unwrap().into_owned()
    }

    #[test]
    fn a_constant_recipe_is_the_model_itself() {
        let plaster = Recipe::OrenNayar {
            reflectance: rgb([0.75, 0.5, 0.25]),
            sigma: 0.3.into(),
        };
        let reflectance = Spectrum::from_lanes([0.75, 0.5, 0.25, 0.0]);
        let expected = OrenNayar::new(reflectance, 0.3).unwrap();
        assert_eq!(
            in_rgb(&material(&plaster).unwrap()),
            Brdf::OrenNayar(expected)
        );
    }

    #[test]
    fn panes_let_light_straight_through() {
        let pane = Recipe::Pane {
            ior: 1.5,
            transmittance: rgb([0.5, 0.75, 1.0]),
        };
        let material = material(&pane).unwrap();
        assert!(material.is_pane() && material.is_specular() && material.transmits());
        let none = Wavelengths::default();
        let share = material.straight_share(-0.6, &Site::NOWHERE, &ColorLanes::Rgb, &none);
        let expected = Pane::new(1.5, [0.5, 0.75, 1.0, 0.0]).unwrap().shares(0.6);
        assert_eq!(share.to_lanes(), expected.map(|(_, passed)| passed as f32));
    }

    #[test]
    fn metals_are_looked_up_at_the_wavelengths_of_a_path() {
        let line = |from, to| {
            let curve = Curve::new(
                vec![(400.0, from), (700.0, to)],
                crate::spectrum::Beyond::Held,
            );
            Varying::from(LaneValues::table(curve.unwrap()))
        };
        let roughness = Roughness {
            slopes: Slopes::Ggx,
            shadowing: Shadowing::HeightCorrelated,
            alpha: [0.5; 2],
            multiple_scattering: true,
        };
        let stated = Recipe::Conductor {
            eta: line(1.0, 0.25),
            kappa: line(2.0, 4.0),
            roughness: Some(roughness),
        };
        let (lanes, mut curves) = (
            Lanes::spectral([400.0, 700.0], vec![]).unwrap(),
            Curves::default(),
        );
        let recipe = prepare(&stated, &lanes, &mut curves).unwrap();
        assert!(recipe.constant().is_none());
        let grid = Grid::new([400.0, 700.0]);
        let colors = ColorLanes::Spectral {
            curves: curves.0.iter().map(|curve| grid.bake(curve)).collect(),
            grid,
        };
        // A third of the way.
        let wavelengths = Wavelengths {
            places: [grid.place(500.0) as f32; 4],
            weights: [1.0; 4],
        };
        let found = recipe.brdf(&Site::NOWHERE, &colors, &wavelengths).unwrap();
        let index = ComplexIndex::new([0.75; 4], [8.0 / 3.0; 4]).unwrap();
        let facets = Facets::isotropic(Slopes::Ggx, 0.5).unwrap();
        let expected = RoughConductor::new(facets, index);
        let wo = Direction::from_polar(0.6, 0.8, 1.0);
        let difference = found.albedo(wo).mean() - expected.albedo(wo).mean();
        assert!(difference.abs() < 1e-5, "{difference}");
    }

    #[test]
    fn pictures_of_numbers_do_not_exceed_1() {
        let bitmap = Bitmap::new(1, 1, Texels::Float(vec![[0.5, 1.5, 0.0, 1.0]])).unwrap();
        let picture = Picture {
            bitmap: Arc::new(bitmap),
            placement: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            channel: 0,
        };
        let plaster = Recipe::OrenNayar {
            reflectance: rgb([0.5; 3]),
            sigma: Scalar {
                factor: 0.3,
                picture: Some(picture),
            },
        };
        let (key, message) = material(&plaster).unwrap_err();
        assert_eq!(key, "sigma");
        assert!(message.contains("between 0 and 1"), "{message}");
    }

    #[test]
    fn what_is_out_of_range_names_its_key() {
        let pane = |ior, transmittance| Recipe::Pane {
            ior,
            transmittance: rgb([transmittance; 3]),
        };
        let says = |stated| material(&stated).unwrap_err();
        assert_eq!(
            says(pane(0.5, 1.0)),
            ("ior", "ior must lie between 1 and 10, got 0.5".into())
        );
        assert_eq!(
            says(pane(1.5, 2.0)),
            (
                "transmittance",
                "a reflectance lies between 0 and 1, not 2".into()
            )
        );
        let bright = Recipe::Phong {
            diffuse: rgb([0.7; 3]),
            glossy: rgb([0.5; 3]),
            exponent: 10.0.into(),
        };
        let (key, message) = says(bright);
        assert!(
            key == "diffuse" && message.contains("add up to 1.2"),
            "{message}"
        );
    }
}
