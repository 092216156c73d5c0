//! What a reader of a spectral result should know of its spectra.

use super::description::{LaneValues, MaterialModel, SceneDescription};
use crate::spectrum::Grid;

/// Lights without a spectrum, and tables that end within the run's wavelengths.
pub(super) fn spectral(description: &SceneDescription, grid: &Grid) -> Vec<String> {
    let mut remarks = Vec::new();
    let plain: Vec<String> = sources(description)
        .filter(|(_, spectrum)| spectrum.is_none())
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    if !plain.is_empty() {
        let names = plain.join(", ");
        remarks.push(format!(
            "lights without a spectrum have equal energy at every wavelength (illuminant E): {names}"
        ));
    }
    for (name, spectrum) in sources(description) {
        if let Some([low, high]) = spectrum.and_then(|spectrum| short(spectrum, grid)) {
            remarks.push(format!(
                "light `{name}`: its table goes from {low} to {high} nm; beyond it emits nothing"
            ));
        }
    }
    for material in &description.materials {
        let name = &material.name;
        let short = factors(&material.model)
            .into_iter()
            .find_map(|values| short(values, grid));
        if let Some([low, high]) = short {
            remarks.push(format!(
                "material `{name}`: its table goes from {low} to {high} nm and keeps its last value beyond"
            ));
        }
    }
    remarks
}

/// The numbers in lanes of a model.
fn factors(model: &MaterialModel) -> Vec<&LaneValues> {
    match model {
        MaterialModel::Lambertian { reflectance } => vec![&reflectance.factor],
        MaterialModel::Mirror { reflectance } => vec![reflectance],
        MaterialModel::Recipe(recipe) => recipe
            .all_lanes()
            .into_iter()
            .map(|lanes| &lanes.factor)
            .collect(),
        MaterialModel::TwoSided { .. }
        | MaterialModel::Mixture { .. }
        | MaterialModel::Metal { .. } => vec![],
    }
}

/// Name and spectrum of everything that emits.
fn sources(description: &SceneDescription) -> impl Iterator<Item = (String, Option<&LaneValues>)> {
    let named = |name: &Option<String>, kind: &str, index: usize| {
        name.clone().unwrap_or_else(|| format!("{kind} {index}"))
    };
    let shapes = description.shapes.iter().enumerate();
    let shapes = shapes.filter_map(move |(index, shape)| {
        let emission = shape.emission.as_ref()?;
        let name = named(&shape.name, shape.geometry.kind(), index);
        Some((name, emission.spectrum.as_ref()))
    });
    let lights = description.lights.iter().enumerate();
    let lights = lights
        .map(move |(index, light)| (named(&light.name, "light", index), light.spectrum.as_ref()));
    shapes.chain(lights)
}

/// The range of a table that ends within the run's wavelengths.
fn short(values: &LaneValues, grid: &Grid) -> Option<[f64; 2]> {
    let LaneValues::Curve { curve, .. } = values else {
        return None;
    };
    let ([low, high], [first, last]) = (curve.range(), grid.range());
    (low > first || high < last).then_some([low, high])
}
