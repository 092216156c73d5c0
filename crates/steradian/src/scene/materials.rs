//! Materials by name: the reflectance of each side of a surface.

use super::description::{LaneValues, MaterialDescription, MaterialModel};
use super::{Part, Problem};
use crate::material::{Material, MaterialId};
use crate::quantity::Spectrum;
use crate::spectrum::Lanes;

/// Prepared materials and the sides that each name stands for.
pub(super) struct Materials {
    /// Name and material, by number; the first is black.
    pub materials: Vec<(String, Material)>,
    sides: Vec<(String, [MaterialId; 2])>,
}

impl Materials {
    /// Front and back of a named material.
    pub fn sides(&self, name: &str) -> Option<[MaterialId; 2]> {
        self.sides
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, sides)| *sides)
    }

    /// What to say when there is none of this name.
    pub fn unknown(&self, name: &str) -> String {
        let known: Vec<_> = self
            .sides
            .iter()
            .map(|(known, _)| format!("`{known}`"))
            .collect();
        match known.is_empty() {
            true => format!("there is no material `{name}`; the scene defines no materials"),
            false => format!(
                "there is no material `{name}`; the scene defines {}",
                known.join(", ")
            ),
        }
    }
}

pub(super) fn prepare(
    descriptions: &[MaterialDescription],
    lanes: &Lanes,
    problems: &mut Vec<Problem>,
) -> Materials {
    let mut prepared = Materials {
        materials: vec![("black".into(), Material::Black)],
        sides: Vec::new(),
    };
    for (index, description) in descriptions.iter().enumerate() {
        let earlier = &descriptions[..index];
        if earlier.iter().any(|other| other.name == description.name) {
            problems.push(Problem::of(
                Part::Material(index),
                format!("material `{}` is defined twice", description.name),
            ));
        }
        if let Some(material) =
            one_sided(&description.model, lanes, Part::Material(index), problems)
        {
            let id = MaterialId(prepared.materials.len() as u32);
            prepared
                .materials
                .push((description.name.clone(), material));
            prepared.sides.push((description.name.clone(), [id, id]));
        }
    }
    add_two_sided(descriptions, &mut prepared, problems);
    prepared
}

fn one_sided(
    model: &MaterialModel,
    lanes: &Lanes,
    part: Part,
    problems: &mut Vec<Problem>,
) -> Option<Material> {
    let mut reflectance = |values: &LaneValues| {
        let lanes = lanes.reflectance(values).unwrap_or_else(|error| {
            problems.push(Problem::at(part, "reflectance", error.to_string()));
            [0.0; 4]
        });
        Spectrum::from_lanes(lanes.map(|lane| lane as f32))
    };
    match model {
        MaterialModel::Lambertian {
            reflectance: values,
        } => Some(Material::Lambertian {
            reflectance: reflectance(&values.factor),
        }),
        MaterialModel::Mirror {
            reflectance: values,
        } => Some(Material::Mirror {
            reflectance: reflectance(values),
        }),
        MaterialModel::TwoSided { .. } => None,
    }
}

fn add_two_sided(
    descriptions: &[MaterialDescription],
    prepared: &mut Materials,
    problems: &mut Vec<Problem>,
) {
    for (index, description) in descriptions.iter().enumerate() {
        let MaterialModel::TwoSided { front, back } = &description.model else {
            continue;
        };
        let mut side = |key, name: &str| {
            let sides = prepared.sides(name).filter(|sides| sides[0] == sides[1]);
            if sides.is_none() {
                let message = if descriptions.iter().any(|other| other.name == name) {
                    format!("`{name}` has two sides itself: name a material with a model")
                } else {
                    prepared.unknown(name)
                };
                problems.push(Problem::at(Part::Material(index), key, message));
            }
            sides.map_or(MaterialId::BLACK, |sides| sides[0])
        };
        let sides = [side("front", front), side("back", back)];
        prepared.sides.push((description.name.clone(), sides));
    }
}
