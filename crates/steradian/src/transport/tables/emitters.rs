//! Emitters: the lights that next-event estimation samples, and their shares of the power.

use std::ops::Range;
use std::sync::Arc;

use super::outlines::{Outline, outline};
use super::{Emitter, EmitterShape, NO_EMITTER, Tinted};
use crate::geometry::{Frame, Point};
use crate::light::{EnvironmentMap, Kind, Light, Outlet};
use crate::material::Tint;
use crate::scene::Scene;
use crate::shape::{Form, ShapeId, Sphere, SpherePort};
use crate::transport::portals::{Portal, portals};

/// Emitters, those with extent first, and the number of that of each light.
pub(super) fn emitters(scene: &Scene, powers: &[Tinted]) -> (Vec<Emitter>, Vec<u32>) {
    let lights = scene.lights();
    let (delta, extent): (Vec<_>, Vec<_>) =
        (0..lights.len()).partition(|&index| lights[index].is_delta());
    let mut emitters = Vec::new();
    let mut emitter_of_light = vec![NO_EMITTER; lights.len()];
    let portals = portals(scene);
    for index in extent.into_iter().chain(delta) {
        let shape = emitter_shape(scene, &lights[index]);
        let shapes = shape.map(|shape| (shape, outline_of(scene, &lights[index])));
        let portals = portals.iter().cloned();
        let portals =
            portals.map(|(portal, outline)| (EmitterShape::Portal(portal), Some(outline)));
        let portals = portals.filter(|_| comes_from_everywhere(&lights[index]));
        for shape in shapes.into_iter().chain(portals) {
            emitter_of_light[index] = emitters.len() as u32;
            emitters.push(emitter(scene, index, powers[index], shape));
        }
    }
    (emitters, emitter_of_light)
}

/// Those of a light, which stand together.
pub(super) fn of_light(emitters: &[Emitter], light: usize) -> Range<u32> {
    let is_of = |emitter: &&Emitter| emitter.light == light;
    let before = |emitter: &&Emitter| emitter.light != light;
    let count = emitters.iter().filter(is_of).count();
    let first = match count {
        0 => 0,
        _ => emitters.iter().take_while(before).count(),
    };
    first as u32..(first + count) as u32
}

fn comes_from_everywhere(light: &Light) -> bool {
    matches!(
        light.kind,
        Kind::Environment { .. } | Kind::EnvironmentMap { .. }
    )
}

fn outline_of(scene: &Scene, light: &Light) -> Option<Outline> {
    match &light.kind {
        Kind::Area(area) => outline(scene, area),
        _ => None,
    }
}

fn emitter(
    scene: &Scene,
    number: usize,
    power: Tinted,
    (shape, outline): (EmitterShape, Option<Outline>),
) -> Emitter {
    let light = &scene.lights()[number];
    Emitter {
        shape,
        outline,
        light: number,
        power,
        surface: light.surface().map(|(shape, _)| shape),
        group: light.group,
        two_sided: light.surface().is_some_and(|(_, two_sided)| two_sided),
        is_directed: matches!(light.kind, Kind::Luminaire(_)),
        probability: 0.0,
    }
}

fn emitter_shape(scene: &Scene, light: &Light) -> Option<EmitterShape> {
    let kernel = |point: Point| scene.surfaces().to_kernel(point);
    let single = |v: [f64; 3]| v.map(|x| x as f32);
    match &light.kind {
        Kind::Point(light) => Some(EmitterShape::Point {
            position: kernel(light.position),
        }),
        Kind::Spot(light) => Some(EmitterShape::Spot {
            position: kernel(light.position),
            axis: single(light.axis.to_array()),
            beam: light.beam,
        }),
        Kind::Directional { direction, .. } => Some(EmitterShape::Directional {
            towards: single((-*direction).to_array()),
        }),
        Kind::Environment { .. } => None,
        Kind::EnvironmentMap { map, .. } => Some(EmitterShape::Everywhere(Arc::clone(map))),
        Kind::Area(light) => area_shape(scene, light.shape),
        Kind::Luminaire(light) => match light.outlet {
            Outlet::Point { end } => Some(EmitterShape::Luminaire {
                position: kernel(light.position),
                end: kernel(end),
            }),
            Outlet::Surface { shape, .. } => area_shape(scene, shape),
        },
    }
}

fn area_shape(scene: &Scene, id: ShapeId) -> Option<EmitterShape> {
    let surfaces = scene.surfaces();
    let kernel = |point: Point| surfaces.to_kernel(point);
    let single = |v: [f64; 3]| v.map(|x| x as f32);
    Some(match &surfaces.shape(id).form {
        Form::Parallelogram(form) => EmitterShape::Parallelogram {
            origin: kernel(form.origin),
            edges: form.edges.map(|edge| single(edge.to_array())),
            normal: single(form.normal.to_array()),
            area: form.area as f32,
        },
        Form::Mesh(mesh) => EmitterShape::Triangles {
            first: surfaces.first_primitive(id),
            cumulative: mesh.cumulative_share().map(|share| share as f32).collect(),
            area: mesh.area() as f32,
        },
        Form::Sphere(sphere) => sphere_shape(sphere, kernel(sphere.center)),
        Form::Disc(disc) => {
            let frame = Frame::from_normal(disc.normal);
            EmitterShape::Disc {
                center: kernel(disc.center),
                normal: single(disc.normal.to_array()),
                axes: [
                    single(frame.tangent().to_array()),
                    single(frame.bitangent().to_array()),
                ],
                inner: disc.inner_radius as f32,
                outer: disc.radius as f32,
                area: disc.area() as f32,
            }
        }
        Form::Plane { .. } => return None,
    })
}

fn sphere_shape(sphere: &Sphere, center: [f32; 3]) -> EmitterShape {
    let port = |port: &SpherePort| {
        (
            port.direction.to_array().map(|x| x as f32),
            port.cos_half_angle as f32,
        )
    };
    let ports = sphere.ports.iter().map(port).collect();
    EmitterShape::Sphere {
        center,
        radius: sphere.radius as f32,
        inside: sphere.inside,
        ports,
    }
}

/// Radiance, intensity or irradiance of each emitter in watts, over all lanes and wavelengths.
pub(super) fn strengths(scene: &Scene, emitters: &[Emitter], tints: &[Tint]) -> Vec<f64> {
    let lanes = scene.lanes();
    // By wavelength the lanes of a light are all alike.
    let weights = if lanes.is_spectral() {
        vec![1.0]
    } else {
        lanes.radiant_weights()
    };
    let strength = |emitter: &Emitter| {
        let lanes: f64 = weights
            .iter()
            .zip(&emitter.power.lanes)
            .map(|(w, x)| w * f64::from(*x))
            .sum();
        lanes * emitter.spectral_power(scene, tints)
    };
    emitters.iter().map(strength).collect()
}

/// Sets each emitter's probability in proportion to its power.
pub(super) fn weigh_by_power(scene: &Scene, emitters: &mut [Emitter], strengths: &[f64]) {
    let extent = scene
        .surfaces()
        .bounds()
        .map_or(1.0, |bounds| bounds.diagonal().to_metres());
    let pairs = emitters.iter().zip(strengths);
    let powers: Vec<f64> = pairs
        .map(|(emitter, strength)| strength * emitter.power_factor(scene, extent))
        .collect();
    let total: f64 = powers.iter().sum();
    let count = emitters.len() as f64;
    for (emitter, power) in emitters.iter_mut().zip(powers) {
        // A light of no luminance in the mean still has lanes: a floor keeps every light possible.
        let probability = if total > 0.0 {
            0.9 * power / total + 0.1 / count
        } else {
            1.0 / count
        };
        emitter.probability = probability as f32;
    }
}

impl Emitter {
    /// Flux per unit of power.
    fn power_factor(&self, scene: &Scene, extent: f64) -> f64 {
        match &scene.lights()[self.light].kind {
            Kind::Luminaire(light) => light.far_field.flux(),
            Kind::EnvironmentMap { map, .. } if !scene.portals().is_empty() => {
                mean(map)
                    * match self.shape {
                        EmitterShape::Portal(_) => self.shape.power_factor(extent),
                        _ => beside_portals(scene, map),
                    }
            }
            _ => self.shape.power_factor(extent),
        }
    }

    /// Power over all wavelengths of the run, of lanes of 1.
    fn spectral_power(&self, scene: &Scene, tints: &[Tint]) -> f64 {
        let Some(grid) = scene.lanes().grid() else {
            return 1.0;
        };
        let [low, high] = grid.range();
        let tint = tints.get(self.power.tint as usize);
        tint.and_then(|tint| tint.hue.curve)
            .map_or(high - low, |id| scene.curve(id).integral([low, high]))
    }
}

/// Flux by which a picture is chosen beside portals: they find its even part, it finds its peaks.
fn beside_portals(scene: &Scene, map: &EnvironmentMap) -> f64 {
    let area: f64 = scene.portals().iter().map(|portal| portal.area).sum();
    let peaks = map.peaks().min(0.99);
    std::f64::consts::PI * area * peaks / (1.0 - peaks)
}

/// Radiance in the mean over all directions.
pub(in crate::transport) fn mean(map: &EnvironmentMap) -> f64 {
    map.integral() / (4.0 * std::f64::consts::PI)
}

impl EmitterShape {
    /// Flux per unit of power; parallel light counts with the cross-section of the scene.
    fn power_factor(&self, extent: f64) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Parallelogram { area, .. }
            | Self::Triangles { area, .. }
            | Self::Disc { area, .. }
            | Self::Portal(Portal { area, .. }) => PI * f64::from(*area),
            Self::Sphere { radius, .. } => 4.0 * PI * PI * f64::from(radius * radius),
            Self::Point { .. } | Self::Luminaire { .. } => 4.0 * PI,
            Self::Spot { beam, .. } => beam.solid_angle().to_steradians(),
            Self::Directional { .. } => 0.25 * PI * extent * extent,
            Self::Everywhere(map) => map.integral() * 0.25 * PI * extent * extent,
        }
    }
}
