//! Path classes that no active estimator can sample.
//!
//! A light without extent is found by next-event estimation only, and a polished surface couples single directions only. What such a surface throws from
//! such a light is [traced from the light](super::light_tracing), to where it is scattered or counted. So what is missing is told, never left out in
//! silence:
//!
//! | sensor | what is missing |
//! |---|---|
//! | camera | what a polished surface in view shows: the image of the light, and the image of what the light was thrown on |
//! | irradiance at points | what a polished surface sends to them last |
//! | radiance | all of it |
//! | flux | nothing |
//!
//! and all of it from lights at a point that are too far away for paths from there, and from parallel light by way of infinite planes.

use crate::brdf::Scatter;
use crate::geometry::{Direction, Point, Vector};
use crate::light::{self, Light};
use crate::material::{ColorLanes, Material, MaterialId, Site};
use crate::scene::Scene;
use crate::sensor::{Camera, Entry, FluxOf, FluxSurface, Kind, Sensor};
use crate::shape::{Form, PartId, ShapeId};
use crate::spectrum::Wavelengths;

/// One sentence for each class that is missing from readings of some sensors.
pub(super) fn unsampled<'s>(
    scene: &Scene,
    sensors: impl Iterator<Item = &'s Sensor> + Clone,
) -> Vec<String> {
    let lack = sensors.clone().filter_map(lack).max();
    let mut classes = lacking(scene, lack);
    for sensor in sensors.filter(|sensor| counts_what_leaves_a_pane(scene, sensor)) {
        let through = |light: &Light| {
            let (light, sensor) = (&light.name, &sensor.name);
            format!("light of `{light}` in flux `{sensor}` of a pane")
        };
        let far = lamps(scene).filter(|light| is_out_of_reach(scene, light));
        classes.extend(far.map(through));
    }
    classes
}

fn lacking(scene: &Scene, lack: Option<Lack>) -> Vec<String> {
    thrown(scene, |light, material| match lack {
        _ if is_untraced(scene, light, material) => Some(""),
        Some(Lack::Straight) => Some(", as polished surfaces show it to points of readings"),
        Some(Lack::Whole) => Some(""),
        None => None,
    })
}

/// What a meter does not have of light that polished surfaces throw.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Lack {
    Straight,
    Whole,
}

fn lack(sensor: &Sensor) -> Option<Lack> {
    match sensor.kind {
        Kind::Flux { .. } | Kind::Balance(_) | Kind::Camera(_) => None,
        Kind::Irradiance(_) | Kind::ScalarIrradiance(_) | Kind::Cylindrical(_) => {
            Some(Lack::Straight)
        }
        Kind::Radiance(_) => Some(Lack::Whole),
    }
}

/// One sentence for each class that is missing from any of a scene's sensors, or that a sensor would lack if it has none.
pub fn unsampled_by_any(scene: &Scene) -> Vec<String> {
    if scene.sensors().is_empty() {
        return lacking(scene, Some(Lack::Whole));
    }
    let mut classes = unsampled(scene, scene.sensors().iter());
    for sensor in scene.sensors() {
        let Kind::Camera(camera) = &sensor.kind else {
            continue;
        };
        for class in unsampled_in_picture(scene, camera) {
            if !classes.contains(&class) {
                classes.push(class);
            }
        }
    }
    classes
}

/// One sentence for each class that is missing from a picture, which has what [light tracing](super::light_tracing) finds.
pub(super) fn unsampled_in_picture(scene: &Scene, camera: &Camera) -> Vec<String> {
    if lamps(scene).next().is_none() {
        return vec![];
    }
    let seen = polished_shapes(scene);
    let mut seen = seen.iter().map(|id| &scene.surfaces().shape(*id).form);
    let is_seen = seen.any(|form| form.bounds().is_none_or(|bounds| camera.may_see(&bounds)));
    thrown(scene, |light, material| {
        if is_untraced(scene, light, material) {
            Some("")
        } else {
            is_seen.then_some(", as polished surfaces show it to the camera")
        }
    })
}

/// Whether nothing that a material throws of a light is traced.
fn is_untraced(scene: &Scene, light: &Light, material: MaterialId) -> bool {
    let is_endless = matches!(light.kind, light::Kind::Directional { .. });
    is_out_of_reach(scene, light) || is_endless && is_on_plane(scene, material)
}

/// Whether a light at a point is so far away that rays from there, in f32, would miss what they are sent to: a thousand diagonals of the scene.
pub(super) fn is_out_of_reach(scene: &Scene, light: &Light) -> bool {
    let position = match &light.kind {
        light::Kind::Point(light) => light.position,
        light::Kind::Spot(light) => light.position,
        light::Kind::Luminaire(light) => light.position,
        _ => return false,
    };
    let bounds = scene.surfaces().bounds();
    bounds.is_some_and(|bounds| {
        let reach = 1e3 * bounds.diagonal().to_metres();
        let is_beyond = |center: Point| (position - center).length() > reach;
        bounds.center().is_some_and(is_beyond)
    })
}

fn lamps(scene: &Scene) -> impl Iterator<Item = &Light> {
    scene.lights().iter().filter(|light| light.is_delta())
}

/// What polished materials throw from lights without extent, of which `part` says what is missing, if anything is.
fn thrown(scene: &Scene, part: impl Fn(&Light, MaterialId) -> Option<&'static str>) -> Vec<String> {
    if lamps(scene).next().is_none() {
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
    let of_lamp = |light: &Light| {
        let sentence = |(id, what): &(MaterialId, &str)| {
            let (name, material) = (&light.name, &scene.materials()[id.0 as usize].0);
            let part = part(light, *id)?;
            Some(format!(
                "light of `{name}` {what} of material `{material}`{part}"
            ))
        };
        polished.iter().filter_map(sentence).collect::<Vec<_>>()
    };
    lamps(scene).flat_map(of_lamp).collect()
}

/// Whether a material is that of an infinite plane.
fn is_on_plane(scene: &Scene, material: MaterialId) -> bool {
    let shapes = scene.surfaces().shapes().iter();
    let mut parts = shapes
        .filter(|shape| matches!(shape.form, Form::Plane { .. }))
        .flat_map(|shape| &shape.parts);
    parts.any(|part| {
        let part = scene.parts()[part.0 as usize];
        [part.front, part.back].contains(&material)
    })
}

/// Whether a sensor counts what leaves a pane.
fn counts_what_leaves_a_pane(scene: &Scene, sensor: &Sensor) -> bool {
    let is_pane = |part: &PartId| {
        let part = scene.parts()[part.0 as usize];
        [part.front, part.back].map(|id| scene.material(id).is_pane()) != [false; 2]
    };
    let counts = |surface: &FluxSurface, of: FluxOf| match surface {
        FluxSurface::Shapes { shapes, .. } if of != FluxOf::Incident => {
            let mut placed = shapes.iter().map(|id| scene.surfaces().shape(*id));
            placed.any(|shape| shape.parts.iter().any(is_pane))
        }
        _ => false,
    };
    match &sensor.kind {
        Kind::Flux { surface, of, .. } => counts(surface, *of),
        Kind::Balance(accounts) => accounts.iter().any(|account| match &account.entry {
            Entry::Flux(surface, of) => counts(surface, *of),
            Entry::Lights(_) => false,
        }),
        _ => false,
    }
}

/// Shapes that send light from a single direction into a single direction.
pub(super) fn polished_shapes(scene: &Scene) -> Vec<ShapeId> {
    let materials = scene.materials().iter();
    // A pane lets light straight through, even if it reflects hardly any.
    let polished: Vec<_> = materials
        .map(|(_, material)| material.is_pane() || missing(material).is_some())
        .collect();
    let is_polished = |part: &PartId| {
        let part = scene.parts()[part.0 as usize];
        [part.front, part.back]
            .iter()
            .any(|id| polished[id.0 as usize])
    };
    let shapes = scene.surfaces().shapes().iter().enumerate();
    shapes
        .filter(|(_, shape)| shape.parts.iter().any(is_polished))
        .map(|(number, _)| ShapeId(number as u32))
        .collect()
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
