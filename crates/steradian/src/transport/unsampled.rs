//! Path classes that no active estimator can sample.
//!
//! A light without extent is found by next-event estimation only, and a polished surface couples single directions only:
//! the light that such a surface throws from such a light onto other surfaces, and its image there, are not sampled. They
//! are told, never left out in silence. What a pane lets straight through is not among them, as next-event rays pass, except in the
//! flux that leaves the pane itself, where no ray is left to pass.

use crate::brdf::Scatter;
use crate::geometry::{Direction, Vector};
use crate::light::Light;
use crate::material::{ColorLanes, Material, MaterialId, Site};
use crate::scene::Scene;
use crate::sensor::{FluxOf, FluxSurface, Kind};
use crate::shape::PartId;
use crate::spectrum::Wavelengths;

/// One sentence for each class that is missing.
pub fn unsampled(scene: &Scene) -> Vec<String> {
    let lamps = || scene.lights().iter().filter(|light| light.is_delta());
    if lamps().next().is_none() {
        return vec![];
    }
    let mut used: Vec<_> = scene
        .parts()
        .iter()
        .flat_map(|p| [p.front, p.back])
        .collect();
    used.sort_unstable_by_key(|id| id.0);
    used.dedup();
    let polished: Vec<_> = used
        .into_iter()
        .filter_map(|id| Some((id, missing(scene.material(id))?)))
        .collect();
    let of_lamp = |name: &str| {
        let sentence = |(id, what): &(MaterialId, &str)| {
            let material = &scene.materials()[id.0 as usize].0;
            format!("light of `{name}` {what} of material `{material}`")
        };
        polished.iter().map(sentence).collect::<Vec<_>>()
    };
    let mut classes: Vec<_> = lamps().flat_map(|light| of_lamp(&light.name)).collect();
    for name in fluxes_of_panes(scene) {
        let through =
            |light: &Light| format!("light of `{}` in flux `{name}` of a pane", light.name);
        classes.extend(lamps().map(through));
    }
    classes
}

/// Sensors that count what leaves a pane.
fn fluxes_of_panes(scene: &Scene) -> impl Iterator<Item = &str> {
    let is_pane = |part: &PartId| {
        let part = scene.parts()[part.0 as usize];
        [part.front, part.back].map(|id| scene.material(id).is_pane()) != [false; 2]
    };
    let concerned = scene
        .sensors()
        .iter()
        .filter(move |sensor| match &sensor.kind {
            Kind::Flux {
                surface: FluxSurface::Shapes { shapes, .. },
                of,
                ..
            } if *of != FluxOf::Incident => {
                let mut placed = shapes.iter().map(|id| scene.surfaces().shape(*id));
                placed.any(|shape| shape.parts.iter().any(is_pane))
            }
            _ => false,
        });
    concerned.map(|sensor| sensor.name.as_str())
}

/// What a material does to light in single directions, if anything.
fn missing(material: &Material) -> Option<&'static str> {
    let [reflects, refracts] = single_directions(material);
    Some(match (reflects, refracts && !material.is_pane()) {
        (true, false) if material.is_pane() => "reflected by panes",
        (true, false) if material.is_specular() => "reflected by mirrors",
        (true, false) => "reflected by the polish",
        (true, true) => "reflected and refracted by surfaces",
        (false, true) => "refracted by surfaces",
        (false, false) => return None,
    })
}

/// How many numbers a model is asked with: one that takes its single directions less often goes unnoticed.
const NUMBERS: u32 = 1024;

/// Whether a model takes single directions on this side of the surface, and on the other one.
fn single_directions(material: &Material) -> [bool; 2] {
    let colors = ColorLanes::Grey;
    let Some(brdf) = material.brdf(&Site::NOWHERE, &colors, &Wavelengths::default()) else {
        return [false; 2];
    };
    let mut found = [false; 2];
    let slanting = Direction::new(Vector::new(0.6, 0.0, 0.8));
    for wo in slanting.into_iter().flat_map(|wo| [wo, -wo]) {
        for number in 0..NUMBERS {
            let u = (f64::from(number) + 0.5) / f64::from(NUMBERS);
            if let Some(scatter @ Scatter::Specular { .. }) = brdf.sample(wo, [u, 0.5]) {
                found[usize::from(scatter.is_transmitted(wo))] = true;
            }
        }
    }
    found
}
