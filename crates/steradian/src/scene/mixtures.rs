//! Mixtures of named materials.

use super::Fault;
use super::description::{MaterialDescription, MaterialModel, Recipe};
use super::recipes::{self, Stated};
use crate::spectrum::Lanes;

/// The recipe of these materials side by side.
pub(super) fn recipe(
    of: &[String],
    weights: &[f64],
    all: &[MaterialDescription],
    lanes: &Lanes,
) -> Result<Stated, Fault> {
    if of.is_empty() || of.len() != weights.len() {
        let message = format!(
            "a mixture has a weight for each of its materials: {} and {} are given",
            weights.len(),
            of.len()
        );
        return Err(("weights", message));
    }
    let parts = of.iter().map(|name| part(name, all, lanes));
    Ok(Recipe::Mixture {
        parts: parts.collect::<Result<_, _>>()?,
        weights: weights.to_vec(),
    })
}

fn part(name: &str, all: &[MaterialDescription], lanes: &Lanes) -> Result<Stated, Fault> {
    let named = all.iter().find(|material| material.name == name);
    let material = named.ok_or_else(|| ("of", format!("there is no material `{name}`")))?;
    if material.opacity.is_some() || !material.media.is_clear() {
        let message = format!("`{name}` has an opacity or an absorption: state it at the mixture");
        return Err(("of", message));
    }
    if material.relief.is_some() {
        let message = format!("`{name}` has a relief: state it at the mixture");
        return Err(("of", message));
    }
    match &material.model {
        MaterialModel::Recipe(recipe) => Ok(recipe.clone()),
        MaterialModel::Metal { metal, roughness } => recipes::metal(*metal, *roughness, lanes),
        MaterialModel::Lambertian { reflectance } => Ok(Recipe::Lambertian {
            reflectance: reflectance.clone(),
        }),
        MaterialModel::Mirror { reflectance } => Ok(Recipe::Mirror {
            reflectance: reflectance.clone().into(),
        }),
        MaterialModel::TwoSided { .. } | MaterialModel::Mixture { .. } => {
            let message = format!("`{name}` names others itself: name a material with a model");
            Err(("of", message))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::description::LaneValues;

    fn grey(name: &str) -> MaterialDescription {
        let reflectance = LaneValues::Uniform(0.5).into();
        MaterialDescription::new(name, MaterialModel::Lambertian { reflectance })
    }

    fn mixed(of: &[&str], weights: &[f64], all: &[MaterialDescription]) -> Result<Stated, Fault> {
        let of: Vec<String> = of.iter().map(|name| name.to_string()).collect();
        recipe(&of, weights, all, &Lanes::rgb())
    }

    #[test]
    fn parts_are_the_named_models() {
        let all = [grey("a"), grey("b")];
        let Ok(Recipe::Mixture { parts, weights }) = mixed(&["a", "b"], &[0.25, 0.75], &all) else {
            panic!("no mixture")
        };
        assert_eq!(weights, [0.25, 0.75]);
        assert!(matches!(
            parts[..],
            [Recipe::Lambertian { .. }, Recipe::Lambertian { .. }]
        ));
    }

    #[test]
    fn what_cannot_be_mixed_is_told() {
        let both = MaterialModel::Mixture {
            of: vec!["a".into()],
            weights: vec![1.0],
        };
        let all = [grey("a"), MaterialDescription::new("both", both)];
        let says = |of: &[&str], weights: &[f64]| mixed(of, weights, &all).unwrap_err();
        let (key, message) = says(&["a"], &[0.5, 0.5]);
        assert!(key == "weights" && message.contains("2 and 1 are given"));
        assert_eq!(
            says(&["c"], &[1.0]),
            ("of", "there is no material `c`".into())
        );
        assert!(says(&["both"], &[1.0]).1.contains("names others itself"));
    }
}
