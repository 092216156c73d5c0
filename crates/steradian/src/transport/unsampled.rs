//! Path classes that no active estimator can sample.
//!
//! A light without extent is found by next-event estimation only, and a mirror reflects one direction only: the light
//! that a mirror throws from such a light onto other surfaces, and its image in the mirror, are not sampled. They are
//! told, never left out in silence.

use crate::scene::Scene;

/// One sentence for each class that is missing.
pub fn unsampled(scene: &Scene) -> Vec<String> {
    let mirrors: Vec<_> = scene
        .materials()
        .iter()
        .filter(|(_, material)| material.is_specular())
        .map(|(name, _)| name.as_str())
        .collect();
    let used = |name: &&str| {
        let is = |id: crate::material::MaterialId| scene.materials()[id.0 as usize].0 == *name;
        scene
            .parts()
            .iter()
            .any(|part| is(part.front) || is(part.back))
    };
    let mirrors: Vec<_> = mirrors.into_iter().filter(used).collect();
    let lights = scene.lights().iter().filter(|light| light.is_delta());
    let pairs = lights.flat_map(|light| mirrors.iter().map(move |mirror| (light, mirror)));
    pairs
        .map(|(light, mirror)| {
            format!(
                "light of `{}` reflected by mirrors of material `{mirror}`",
                light.name
            )
        })
        .collect()
}
