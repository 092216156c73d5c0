//! The scene as the batched loops read it: f32 tables in kernel coordinates, one entry a side of a part, one a light.

use crate::geometry::Point;
use crate::light::{Beam, Kind, LightId};
use crate::material::{Material, MaterialId};
use crate::scene::Scene;
use crate::shape::{Form, Sphere};
use crate::spectrum::MAX_LANES;

/// Lanes of the batched loops.
pub(super) type Lanes4 = [f32; MAX_LANES];

/// Meters sample every light up to this number of lights, and one chosen by power beyond.
pub(super) const ALL_LIGHTS: usize = 10;

/// How a side reflects.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Model {
    Black,
    Lambertian,
    Mirror,
}

/// One side of a part: what it reflects and emits.
#[derive(Copy, Clone, Debug)]
pub(super) struct Side {
    pub reflectance: Lanes4,
    pub radiance: Lanes4,
    pub model: Model,
    /// Number of the emitter in [`Tables::emitters`], or [`NO_EMITTER`] where next-event estimation cannot find it.
    pub emitter: u32,
    pub group: u32,
    pub emits: bool,
}

/// Marks emission that only a surface's own directions find.
pub(super) const NO_EMITTER: u32 = u32::MAX;

/// A light that next-event estimation samples.
#[derive(Clone, Debug)]
pub(super) struct Emitter {
    pub shape: EmitterShape,
    /// Radiance, intensity, or irradiance facing the light, by kind.
    pub power: Lanes4,
    pub group: u32,
    pub two_sided: bool,
    /// Probability of this emitter when one is chosen by power.
    pub probability: f32,
}

/// Geometry of an emitter.
#[derive(Clone, Debug)]
pub(super) enum EmitterShape {
    Parallelogram {
        origin: [f32; 3],
        edges: [[f32; 3]; 2],
        normal: [f32; 3],
        area: f32,
    },
    /// Triangles `first..` of the scene, chosen by cumulative share of the area.
    Triangles {
        first: u32,
        cumulative: Vec<f32>,
        area: f32,
    },
    /// Seen from outside a cone; from inside, or with ports, by area.
    Sphere {
        center: [f32; 3],
        radius: f32,
        inside: bool,
        ports: Vec<([f32; 3], f32)>,
    },
    Disc {
        center: [f32; 3],
        normal: [f32; 3],
        axes: [[f32; 3]; 2],
        inner: f32,
        outer: f32,
        area: f32,
    },
    Point {
        position: [f32; 3],
    },
    Spot {
        position: [f32; 3],
        axis: [f32; 3],
        beam: Beam,
    },
    Directional {
        towards: [f32; 3],
    },
}

impl EmitterShape {
    pub fn is_delta(&self) -> bool {
        matches!(
            self,
            Self::Point { .. } | Self::Spot { .. } | Self::Directional { .. }
        )
    }
}

/// All tables of a scene.
pub(super) struct Tables<'a> {
    pub scene: &'a Scene,
    pub lanes: usize,
    /// Side 2·part is the front of a part, 2·part + 1 its back.
    pub sides: Vec<Side>,
    pub emitters: Vec<Emitter>,
    /// Number of emitters with extent; they come first.
    pub extended: usize,
    /// Cumulative probability of the emitters.
    pub cumulative: Vec<f32>,
    /// Radiance of everywhere, by group.
    pub environment: Vec<(u32, Lanes4)>,
}

impl<'a> Tables<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let lights = scene.lights();
        let (delta, extent): (Vec<_>, Vec<_>) =
            (0..lights.len()).partition(|&index| lights[index].is_delta());
        let mut emitters = Vec::new();
        let mut emitter_of_light = vec![NO_EMITTER; lights.len()];
        let mut extended = 0;
        for index in extent.into_iter().chain(delta) {
            if let Some(emitter) = emitter(scene, LightId(index as u32)) {
                emitter_of_light[index] = emitters.len() as u32;
                extended += usize::from(!emitter.shape.is_delta());
                emitters.push(Emitter {
                    group: lights[index].group,
                    ..emitter
                });
            }
        }
        let cumulative = choose_by_power(scene, &mut emitters);
        let sides = scene.parts().iter().flat_map(|part| {
            let light = part.light.map(|id| (id, emitter_of_light[id.0 as usize]));
            [
                side(scene, part.front, light, true),
                side(scene, part.back, light, false),
            ]
        });
        let sides: Vec<_> = sides.collect();
        let environment = scene
            .environment()
            .map(|(group, radiance)| (group, radiance.map(|x| x as f32)))
            .collect();
        Self {
            scene,
            lanes: scene.lanes().count(),
            sides,
            emitters,
            extended,
            cumulative,
            environment,
        }
    }

    /// Emitters for the vertices of a path: one chosen by power among all.
    pub fn for_surfaces(&self) -> Candidates {
        Candidates {
            count: self.emitters.len(),
            all: false,
        }
    }

    /// Emitters for a meter; without `delta` those of lights without extent are left out.
    pub fn for_meters(&self, delta: bool) -> Candidates {
        let count = if delta {
            self.emitters.len()
        } else {
            self.extended
        };
        Candidates {
            count,
            all: count <= ALL_LIGHTS,
        }
    }

    /// Probability of an emitter among candidates.
    #[inline(always)]
    pub fn probability(&self, candidates: Candidates, emitter: usize) -> f32 {
        if candidates.all {
            1.0
        } else {
            self.emitters[emitter].probability / self.cumulative[candidates.count - 1]
        }
    }
}

/// The first emitters of the tables, from which next-event estimation samples all, or one by power.
#[derive(Copy, Clone, Debug)]
pub(super) struct Candidates {
    pub count: usize,
    pub all: bool,
}

fn side(scene: &Scene, material: MaterialId, light: Option<(LightId, u32)>, front: bool) -> Side {
    let material = scene.material(material);
    let model = match material {
        Material::Black => Model::Black,
        Material::Lambertian { .. } => Model::Lambertian,
        Material::Mirror { .. } => Model::Mirror,
    };
    let model = if material.reflectance().is_zero() {
        Model::Black
    } else {
        model
    };
    let reflectance = material.reflectance().to_lanes();
    let mut side = Side {
        reflectance,
        radiance: [0.0; 4],
        model,
        emitter: NO_EMITTER,
        group: 0,
        emits: false,
    };
    if let Some((id, emitter)) = light {
        let light = &scene.lights()[id.0 as usize];
        if let Kind::Area(area) = &light.kind
            && (front || area.two_sided)
        {
            side.radiance = area
                .radiance
                .map(|x| x.to_watts_per_square_metre_steradian() as f32);
            (side.emitter, side.group, side.emits) = (emitter, light.group, true);
        }
    }
    side
}

fn emitter(scene: &Scene, id: LightId) -> Option<Emitter> {
    let kernel = |point: Point| scene.surfaces().to_kernel(point);
    let single = |v: [f64; 3]| v.map(|x| x as f32);
    let (shape, power, two_sided) = match &scene.lights()[id.0 as usize].kind {
        Kind::Point(light) => {
            let power = light.intensity.map(|x| x.to_watts_per_steradian());
            (
                EmitterShape::Point {
                    position: kernel(light.position),
                },
                power,
                false,
            )
        }
        Kind::Spot(light) => {
            let power = light.peak_intensity.map(|x| x.to_watts_per_steradian());
            let axis = single(light.axis.to_array());
            (
                EmitterShape::Spot {
                    position: kernel(light.position),
                    axis,
                    beam: light.beam,
                },
                power,
                false,
            )
        }
        Kind::Directional {
            direction,
            irradiance,
        } => {
            let power = irradiance.map(|x| x.to_watts_per_square_metre());
            (
                EmitterShape::Directional {
                    towards: single((-*direction).to_array()),
                },
                power,
                false,
            )
        }
        Kind::Environment { .. } => return None,
        Kind::Area(light) => {
            let power = light
                .radiance
                .map(|x| x.to_watts_per_square_metre_steradian());
            (area_shape(scene, light.shape)?, power, light.two_sided)
        }
    };
    Some(Emitter {
        shape,
        power: power.map(|x| x as f32),
        group: 0,
        two_sided,
        probability: 0.0,
    })
}

fn area_shape(scene: &Scene, id: crate::shape::ShapeId) -> Option<EmitterShape> {
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
            let frame = crate::geometry::Frame::from_normal(disc.normal);
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
    let port = |port: &crate::shape::SpherePort| {
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

/// Sets each emitter's probability in proportion to its power; returns the cumulative ones.
fn choose_by_power(scene: &Scene, emitters: &mut [Emitter]) -> Vec<f32> {
    let weights = scene.lanes().radiant_weights();
    let extent = scene
        .surfaces()
        .bounds()
        .map_or(1.0, |bounds| bounds.diagonal().to_metres());
    let power = |emitter: &Emitter| -> f64 {
        let lanes: f64 = weights
            .iter()
            .zip(&emitter.power)
            .map(|(w, x)| w * f64::from(*x))
            .sum();
        lanes * emitter.shape.power_factor(extent)
    };
    let powers: Vec<f64> = emitters.iter().map(power).collect();
    let total: f64 = powers.iter().sum();
    let mut sum = 0.0;
    let count = emitters.len() as f64;
    let step = |(emitter, power): (&mut Emitter, f64)| {
        // A light of no luminance in the mean still has lanes: a floor keeps every light possible.
        let probability = if total > 0.0 {
            0.9 * power / total + 0.1 / count
        } else {
            1.0 / count
        };
        emitter.probability = probability as f32;
        sum += probability;
        sum as f32
    };
    emitters.iter_mut().zip(powers).map(step).collect()
}

impl EmitterShape {
    /// Flux per unit of power; parallel light counts with the cross-section of the scene.
    fn power_factor(&self, extent: f64) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Parallelogram { area, .. }
            | Self::Triangles { area, .. }
            | Self::Disc { area, .. } => PI * f64::from(*area),
            Self::Sphere { radius, .. } => 4.0 * PI * PI * f64::from(radius * radius),
            Self::Point { .. } => 4.0 * PI,
            Self::Spot { beam, .. } => beam.solid_angle().to_steradians(),
            Self::Directional { .. } => 0.25 * PI * extent * extent,
        }
    }
}
