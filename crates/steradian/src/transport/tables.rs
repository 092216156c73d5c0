//! The scene as the batched loops read it: f32 tables in kernel coordinates, one entry a side of a part, one a light.

use std::sync::Arc;

use crate::geometry::Point;
use crate::light::{Beam, Kind, Light, LightId};
use crate::material::{self, ColorLanes, Hue, MaterialId, Opacity, Texture, Tint};
use crate::scene::Scene;
use crate::shape::{Form, ShapeId, Sphere};
use crate::spectrum::{BakedCurve, Curve, MAX_LANES};

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
    /// Where it is the same everywhere and at every wavelength.
    pub reflectance: Lanes4,
    /// Number among the tints, or [`NO_TINT`].
    pub reflectance_tint: u32,
    pub radiance: Lanes4,
    pub radiance_tint: u32,
    /// Number among the opacities; none of that number if it is opaque.
    pub opacity: u32,
    pub model: Model,
    /// Number of the emitter in [`Tables::emitters`], or [`NO_EMITTER`] where next-event estimation cannot find it.
    pub emitter: u32,
    pub group: u32,
    pub emits: bool,
}

impl Side {
    /// False only if it reflects nothing of a channel.
    pub fn may_reflect(&self, channel: usize) -> bool {
        self.reflectance_tint != NO_TINT
            || self.reflectance.get(channel).is_none_or(|lane| *lane > 0.0)
    }
}

/// Marks what is the same everywhere and at every wavelength.
pub(super) const NO_TINT: u32 = u32::MAX;

/// Marks sides that let nothing pass.
pub(super) const OPAQUE: u32 = u32::MAX;

/// Marks emission that only a surface's own directions find.
pub(super) const NO_EMITTER: u32 = u32::MAX;

/// A light that next-event estimation samples.
#[derive(Clone, Debug)]
pub(super) struct Emitter {
    pub shape: EmitterShape,
    /// Radiance, intensity, or irradiance facing the light, by kind.
    pub power: Lanes4,
    pub tint: u32,
    /// The emission has textures.
    pub textured: bool,
    /// The shape that emits.
    pub surface: Option<ShapeId>,
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
    /// Radiance of everywhere, by group, with its tint.
    pub environment: Vec<(u32, Lanes4, u32)>,
    /// What varies over surfaces or with the wavelength.
    pub tints: Vec<Tint>,
    /// Of sides that are not opaque.
    pub opacities: Vec<Opacity>,
    /// What curves and colours are in the lanes.
    pub colors: ColorLanes,
    /// The channels of a spectral run.
    pub responses: Vec<BakedCurve>,
}

impl<'a> Tables<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let mut tints = Tints::default();
        let (mut emitters, emitter_of_light) = emitters(scene, &mut tints);
        let extended = emitters.iter().filter(|emitter| !emitter.shape.is_delta());
        let extended = extended.count();
        let cumulative = choose_by_power(scene, &mut emitters, &tints.tints);
        let sides = scene.parts().iter().flat_map(|part| {
            let light = part.light.map(|id| (id, emitter_of_light[id.0 as usize]));
            [
                side(scene, part.front, light, true, &mut tints),
                side(scene, part.back, light, false, &mut tints),
            ]
        });
        let sides: Vec<_> = sides.collect();
        let environment = scene.environments().map(|light| {
            let (lanes, tint) = tints.of_light(light, &[]);
            (light.group, lanes, tint)
        });
        let environment = environment.collect();
        let grid = scene.lanes().grid();
        let bake = |curve: &Arc<Curve>| grid.map(|grid| grid.bake(curve));
        Self {
            scene,
            lanes: scene.lanes().carried(),
            sides,
            emitters,
            extended,
            cumulative,
            environment,
            responses: scene.lanes().responses().iter().filter_map(bake).collect(),
            colors: color_lanes(scene),
            tints: tints.tints,
            opacities: tints.opacities,
        }
    }

    /// Whether a tint varies over the surface.
    pub fn has_textures(&self, tint: u32) -> bool {
        let tint = self.tints.get(tint as usize);
        tint.is_some_and(|tint| !tint.textures.is_empty())
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

fn color_lanes(scene: &Scene) -> ColorLanes {
    match scene.lanes().grid() {
        Some(grid) => ColorLanes::Spectral {
            curves: scene
                .curves()
                .iter()
                .map(|curve| grid.bake(curve))
                .collect(),
            grid: *grid,
        },
        None if scene.lanes().is_rgb() => ColorLanes::Rgb,
        None => ColorLanes::Grey,
    }
}

/// Collects what varies.
#[derive(Default)]
struct Tints {
    tints: Vec<Tint>,
    opacities: Vec<Opacity>,
}

impl Tints {
    /// Number of a tint, and its lanes where it has none.
    fn add(&mut self, tint: Tint) -> (Lanes4, u32) {
        if tint.is_constant() {
            return (tint.hue.lanes, NO_TINT);
        }
        let known = self.tints.iter().position(|known| *known == tint);
        let number = known.unwrap_or_else(|| {
            self.tints.push(tint.clone());
            self.tints.len() - 1
        });
        (tint.hue.lanes, number as u32)
    }

    fn of_light(&mut self, light: &Light, textures: &[Texture]) -> (Lanes4, u32) {
        self.add(Tint {
            hue: Hue {
                lanes: light.power().map(|lane| lane as f32),
                curve: light.spectrum,
            },
            textures: textures.to_vec(),
        })
    }

    fn opacity(&mut self, opacity: Option<&Opacity>) -> u32 {
        let Some(opacity) = opacity else {
            return OPAQUE;
        };
        let known = self.opacities.iter().position(|known| known == opacity);
        known.unwrap_or_else(|| {
            self.opacities.push(opacity.clone());
            self.opacities.len() - 1
        }) as u32
    }
}

fn side(
    scene: &Scene,
    material: MaterialId,
    light: Option<(LightId, u32)>,
    front: bool,
    tints: &mut Tints,
) -> Side {
    let material = scene.material(material);
    let is_black = |tint: &Tint| tint.hue.lanes == [0.0; 4];
    let model = match material.model {
        _ if material.reflectance().is_none_or(is_black) => Model::Black,
        material::Model::Black => Model::Black,
        material::Model::Lambertian { .. } => Model::Lambertian,
        material::Model::Mirror { .. } => Model::Mirror,
    };
    let black = ([0.0; 4], NO_TINT);
    let tint = material.reflectance().cloned();
    let (reflectance, reflectance_tint) = tint.map_or(black, |tint| tints.add(tint));
    let mut side = Side {
        reflectance,
        reflectance_tint,
        radiance: [0.0; 4],
        radiance_tint: NO_TINT,
        opacity: tints.opacity(material.opacity.as_ref()),
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
            (side.radiance, side.radiance_tint) = tints.of_light(light, &area.textures);
            (side.emitter, side.group, side.emits) = (emitter, light.group, true);
        }
    }
    side
}

/// Emitters, those with extent first, and the number of that of each light.
fn emitters(scene: &Scene, tints: &mut Tints) -> (Vec<Emitter>, Vec<u32>) {
    let lights = scene.lights();
    let (delta, extent): (Vec<_>, Vec<_>) =
        (0..lights.len()).partition(|&index| lights[index].is_delta());
    let mut emitters = Vec::new();
    let mut emitter_of_light = vec![NO_EMITTER; lights.len()];
    for index in extent.into_iter().chain(delta) {
        if let Some(emitter) = emitter(scene, &lights[index], tints) {
            emitter_of_light[index] = emitters.len() as u32;
            emitters.push(emitter);
        }
    }
    (emitters, emitter_of_light)
}

fn emitter(scene: &Scene, light: &Light, tints: &mut Tints) -> Option<Emitter> {
    let shape = emitter_shape(scene, light)?;
    let area = match &light.kind {
        Kind::Area(area) => Some(area),
        _ => None,
    };
    let textures = area.map_or(&[][..], |area| &area.textures);
    let (power, tint) = tints.of_light(light, textures);
    Some(Emitter {
        shape,
        power,
        tint,
        textured: !textures.is_empty(),
        surface: area.map(|area| area.shape),
        group: light.group,
        two_sided: area.is_some_and(|area| area.two_sided),
        probability: 0.0,
    })
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
        Kind::Area(light) => area_shape(scene, light.shape),
    }
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
fn choose_by_power(scene: &Scene, emitters: &mut [Emitter], tints: &[Tint]) -> Vec<f32> {
    let lanes = scene.lanes();
    // By wavelength the lanes of a light are all alike.
    let weights = if lanes.is_spectral() {
        vec![1.0]
    } else {
        lanes.radiant_weights()
    };
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
        lanes * emitter.shape.power_factor(extent) * emitter.spectral_power(scene, tints)
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

impl Emitter {
    /// Power over all wavelengths of the run, of lanes of 1.
    fn spectral_power(&self, scene: &Scene, tints: &[Tint]) -> f64 {
        let Some(grid) = scene.lanes().grid() else {
            return 1.0;
        };
        let [low, high] = grid.range();
        let tint = tints.get(self.tint as usize);
        tint.and_then(|tint| tint.hue.curve)
            .map_or(high - low, |id| scene.curve(id).integral([low, high]))
    }
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
