//! Materials by name: the reflectance of each side of a surface.

use std::sync::Arc;

use super::curves::Curves;
use super::description::{self, LaneValues, MaterialDescription, MaterialModel, Varying};
use super::{Fault, Part, Problem, mixtures, recipes, reliefs};
use crate::material::{
    Bitmap, Hue, Material, MaterialId, Model, Opacity, Pattern, Texels, Texture, Tint,
};
use crate::spectrum::{LaneCurve, Lanes};

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
    curves: &mut Curves,
    problems: &mut Vec<Problem>,
) -> Materials {
    let mut prepared = Materials {
        materials: vec![("black".into(), Material::BLACK)],
        sides: Vec::new(),
    };
    for (index, description) in descriptions.iter().enumerate() {
        let (part, name) = (Part::Material(index), &description.name);
        let earlier = &descriptions[..index];
        if earlier.iter().any(|other| other.name == *name) {
            let message = format!("material `{name}` is defined twice");
            problems.push(Problem::of(part, message));
        }
        match one_sided(description, descriptions, lanes, curves) {
            Ok(Some(material)) => {
                let id = MaterialId(prepared.materials.len() as u32);
                prepared.materials.push((name.clone(), material));
                prepared.sides.push((name.clone(), [id, id]));
            }
            Ok(None) => {}
            Err((key, message)) => {
                problems.push(Problem::at(part, key, message));
                prepared.sides.push((name.clone(), [MaterialId::BLACK; 2]));
            }
        }
    }
    add_two_sided(descriptions, &mut prepared, problems);
    prepared
}

/// `None` for a material that names another one for each side.
pub(super) fn one_sided(
    description: &MaterialDescription,
    all: &[MaterialDescription],
    lanes: &Lanes,
    curves: &mut Curves,
) -> Result<Option<Material>, Fault> {
    let fault = |message| ("reflectance", message);
    let model = match &description.model {
        MaterialModel::Lambertian { reflectance } => Model::Lambertian {
            reflectance: tint(reflectance, lanes, curves).map_err(fault)?,
        },
        MaterialModel::Mirror { reflectance } => Model::Mirror {
            reflectance: tint(&reflectance.clone().into(), lanes, curves).map_err(fault)?,
        },
        MaterialModel::Recipe(recipe) => {
            Model::Recipe(Arc::new(recipes::prepare(recipe, lanes, curves)?))
        }
        MaterialModel::Metal { metal, roughness } => {
            let recipe = recipes::metal(*metal, *roughness, lanes)?;
            Model::Recipe(Arc::new(recipes::prepare(&recipe, lanes, curves)?))
        }
        MaterialModel::Mixture { of, weights } => {
            let recipe = mixtures::recipe(of, weights, all, lanes)?;
            Model::Recipe(Arc::new(recipes::prepare(&recipe, lanes, curves)?))
        }
        MaterialModel::TwoSided { .. } if description.opacity.is_some() => {
            let message = "a material of two sides takes the opacity of each: state it there";
            return Err(("opacity", message.into()));
        }
        MaterialModel::TwoSided { .. } if description.relief.is_some() => {
            let message = "a material of two sides takes the relief of each: state it there";
            return Err(("relief", message.into()));
        }
        MaterialModel::TwoSided { .. } => return Ok(None),
    };
    let opacity = description.opacity.as_ref();
    let opacity = opacity
        .map(|opacity| prepare_opacity(opacity, lanes, curves))
        .transpose()
        .map_err(|message| ("opacity", message))?;
    let media = description.media.turn(|key, absorption| {
        recipes::coefficient(absorption, lanes, curves).map_err(|message| (key, message))
    })?;
    Ok(Some(Material {
        model,
        opacity,
        media,
        relief: description
            .relief
            .as_ref()
            .map(reliefs::prepare)
            .transpose()?,
    }))
}

pub(super) fn tint(values: &Varying, lanes: &Lanes, curves: &mut Curves) -> Result<Tint, String> {
    Ok(Tint {
        hue: share(&values.factor, lanes, curves)?,
        textures: textures(&values.textures, lanes, curves)?,
    })
}

/// A part of the light.
fn share(values: &LaneValues, lanes: &Lanes, curves: &mut Curves) -> Result<Hue, String> {
    let found = lanes
        .reflectance(values)
        .map_err(|error| error.to_string())?;
    Ok(hue(found, curves))
}

pub(super) fn hue(found: LaneCurve, curves: &mut Curves) -> Hue {
    Hue {
        lanes: found.lanes.map(|lane| lane as f32),
        curve: curves.number(found.curve),
    }
}

fn prepare_opacity(
    opacity: &description::Opacity,
    lanes: &Lanes,
    curves: &mut Curves,
) -> Result<Opacity, String> {
    let within = |value: f64| (0.0..=1.0).contains(&value);
    if !within(opacity.factor) || opacity.cutoff.is_some_and(|cutoff| !within(cutoff)) {
        return Err(format!(
            "an opacity and its cutoff lie between 0 and 1, not {} and {:?}",
            opacity.factor, opacity.cutoff
        ));
    }
    let any_colour = Lanes::rgb();
    let lanes = if opacity.textures.iter().all(is_picture) {
        &any_colour
    } else {
        lanes
    };
    Ok(Opacity {
        factor: opacity.factor as f32,
        textures: textures(&opacity.textures, lanes, curves)?,
        cutoff: opacity.cutoff.map(|cutoff| cutoff as f32),
    })
}

/// Whether only alpha is asked of it.
fn is_picture(texture: &description::Texture) -> bool {
    !matches!(texture.pattern, description::Pattern::Checkerboard(_))
}

/// Textures in the lanes of the run.
pub(super) fn textures(
    descriptions: &[description::Texture],
    lanes: &Lanes,
    curves: &mut Curves,
) -> Result<Vec<Texture>, String> {
    let mut prepare = |texture: &description::Texture| {
        let finite = texture
            .placement
            .0
            .as_flattened()
            .iter()
            .all(|x| x.is_finite());
        if !finite {
            return Err("the placement of a texture is finite".to_owned());
        }
        let pattern = match &texture.pattern {
            description::Pattern::Bitmap(bitmap) => {
                check_bitmap(bitmap, lanes)?;
                Pattern::Bitmap(Arc::clone(bitmap))
            }
            description::Pattern::Checkerboard([a, b]) => {
                Pattern::Checkerboard([share(a, lanes, curves)?, share(b, lanes, curves)?])
            }
            description::Pattern::VertexColor => {
                lanes.check_colours().map_err(|error| error.to_string())?;
                Pattern::VertexColor
            }
        };
        Ok(Texture {
            pattern,
            placement: texture.placement.0,
        })
    };
    descriptions.iter().map(&mut prepare).collect()
}

/// Bands know no colours, and no surface reflects more than it receives.
fn check_bitmap(bitmap: &Bitmap, lanes: &Lanes) -> Result<(), String> {
    check_colours(bitmap, lanes)?;
    check_shares(bitmap)
}

/// Bands know no colours.
pub(super) fn check_colours(bitmap: &Bitmap, lanes: &Lanes) -> Result<(), String> {
    lanes.check_colours().map_err(|error| error.to_string())?;
    let grey_only = !(lanes.is_rgb() || lanes.is_spectral());
    let texels = bitmap.texels();
    let coloured = |index| {
        let [r, g, b, _] = texels.at(index);
        r != g || g != b
    };
    if grey_only && (0..texels.len()).any(coloured) {
        return Err(
            "a coloured texture needs `spectrum = \"rgb\"` or `\"spectral\"`: bands know grey only"
                .into(),
        );
    }
    Ok(())
}

/// What no picture of parts or of numbers may exceed.
pub(super) fn check_shares(bitmap: &Bitmap) -> Result<(), String> {
    let texels = bitmap.texels();
    // Codes of 8 and 16 bits lie between 0 and 1 as they are.
    if !matches!(texels, Texels::Float(_)) {
        return Ok(());
    }
    for index in 0..texels.len() {
        let [r, g, b, alpha] = texels.at(index);
        if r.max(g).max(b).max(alpha) > 1.0 {
            return Err(format!(
                "the values of a texture lie between 0 and 1; texel {index} is [{r}, {g}, {b}, {alpha}]"
            ));
        }
    }
    Ok(())
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
