//! The scene as the batched loops read it: f32 tables in kernel coordinates, one entry a side of a part, one a light.

mod emitters;
mod outlines;
mod sides;

use std::ops::Range;
use std::sync::Arc;

pub(super) use emitters::mean;
use emitters::{emitters, of_light, strengths, weigh_by_power};
pub(super) use outlines::{Facet, MOST_FACETS, Outline, circumscribed};
use sides::{Tints, emitting, metal};

use super::light_tree::{Receiving, Selection};
use super::media::Beside;
use super::plain::PlainTriangles;
use super::portals::Portal;
use crate::brdf::{Later, Metal};
use crate::light::{Beam, EnvironmentMap, Kind, Light};
use crate::material::{ColorLanes, Hue, MaterialId, Opacity, Picture, Tint};
use crate::scene::Scene;
use crate::shape::ShapeId;
use crate::spectrum::{BakedCurve, Curve, MAX_LANES};

/// Lanes of the batched loops.
pub(super) type Lanes4 = [f32; MAX_LANES];

/// Up to this number of emitters meters sample each; beyond it they choose by importance, as vertices of a path always do, at
/// the place.
pub(super) const ALL_LIGHTS: usize = 10;

/// How many emitters a meter chooses by importance for each of its paths, in strata. In a hall with 1 000 and with 10 000 lamps this makes the
/// time to an error least: twice as many take 1.1 times as long, half as many 1.2 times, a single one 2 times.
pub(super) const CHOSEN_LIGHTS: u32 = 4;

/// Points sum the light of lights without extent up to this number of them, and sample it beyond.
///
/// The sum takes a ray for each light, .1 µs in a hall with racks, the choice [`CHOSEN_LIGHTS`] rays for each path, 3 µs: so the sum of as many lights costs what
/// a point's first 550 paths would spend on choices, fewer than points need, and has no error.
pub(super) const SUMMED_LIGHTS: usize = 1 << 14;

/// How a side reflects.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Model {
    Black,
    Lambertian,
    Mirror,
    /// Reflects as a mirror, and lets a part pass straight.
    Pane,
    /// Its [`Brdf`](crate::brdf::Brdf) is asked at each vertex.
    Any,
}

/// Lanes that may vary over a surface or with the wavelength.
#[derive(Copy, Clone, Debug)]
pub(super) struct Tinted {
    /// Where nothing varies.
    pub lanes: Lanes4,
    /// Number among the tints, or [`NO_TINT`].
    pub tint: u32,
}

impl Tinted {
    const BLACK: Self = Self {
        lanes: [0.0; 4],
        tint: NO_TINT,
    };
}

/// One side of a part: what it reflects and emits.
#[derive(Copy, Clone, Debug)]
pub(super) struct Side {
    pub reflectance: Tinted,
    pub radiance: Tinted,
    /// Number among the opacities; none of that number if it is opaque.
    pub opacity: u32,
    pub material: MaterialId,
    /// The model's normal is that of the front, whichever side this is: light goes through.
    pub transmits: bool,
    /// It couples single directions only.
    pub is_specular: bool,
    /// What absorbs before and behind the surface, if light that goes through changes the medium.
    pub media: Option<Beside>,
    pub model: Model,
    /// Number of the emitter in [`Tables::emitters`], or [`NO_EMITTER`] where next-event estimation cannot find it.
    pub emitter: u32,
    pub group: u32,
    pub emits: bool,
}

impl Side {
    /// False only if it reflects nothing of a channel that an estimator could find: of a light without extent a
    /// polished surface shows nothing.
    pub fn may_reflect(&self, channel: usize, delta: bool) -> bool {
        match self.model {
            Model::Black => return false,
            _ if delta && self.is_specular => return false,
            Model::Pane | Model::Any => return true,
            Model::Lambertian | Model::Mirror => {}
        }
        let lane = self.reflectance.lanes.get(channel);
        self.reflectance.tint != NO_TINT || lane.is_none_or(|lane| *lane > 0.0)
    }

    /// Whether a part of the light passes straight through.
    pub fn lets_pass(&self) -> bool {
        self.opacity != OPAQUE || self.model == Model::Pane
    }
}

/// Marks what is the same everywhere and at every wavelength.
pub(super) const NO_TINT: u32 = u32::MAX;

/// Marks sides that let nothing pass.
pub(super) const OPAQUE: u32 = u32::MAX;

/// Marks emission that only a surface's own directions find.
pub(super) const NO_EMITTER: u32 = u32::MAX;

/// Radiance from everywhere.
#[derive(Clone, Debug)]
pub(super) struct Everywhere {
    pub group: u32,
    pub radiance: Tinted,
    /// The picture, if it is not the same in all directions.
    pub map: Option<Arc<EnvironmentMap>>,
    /// Numbers of the emitters that sample it: the picture and the [portals](super::portals).
    pub emitters: Range<u32>,
}

/// A light that next-event estimation samples.
#[derive(Clone, Debug)]
pub(super) struct Emitter {
    pub shape: EmitterShape,
    /// The shape in f64, where radiance is the same everywhere.
    pub outline: Option<Outline>,
    /// Number of the light.
    pub light: usize,
    /// Radiance, intensity, or irradiance facing the light, by kind.
    pub power: Tinted,
    /// The shape that emits.
    pub surface: Option<ShapeId>,
    pub group: u32,
    pub two_sided: bool,
    /// Its power has a [factor](crate::light::Light::factor) by direction.
    pub is_directed: bool,
    /// Its share of the power, of which a part is dealt out evenly.
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
    /// A picture of all directions.
    Everywhere(Arc<EnvironmentMap>),
    /// Where light from everywhere comes in.
    Portal(Portal),
    /// A luminaire without extent.
    Luminaire {
        position: [f32; 3],
        /// Where rays to it end.
        end: [f32; 3],
    },
}

impl EmitterShape {
    /// Number of its first triangle in the scene, if it has any.
    fn first_triangle(&self) -> u32 {
        match self {
            Self::Triangles { first, .. } => *first,
            _ => 0,
        }
    }

    pub fn is_delta(&self) -> bool {
        matches!(
            self,
            Self::Point { .. }
                | Self::Spot { .. }
                | Self::Directional { .. }
                | Self::Luminaire { .. }
        )
    }
}

/// All tables of a scene.
pub(super) struct Tables<'a> {
    pub scene: &'a Scene,
    pub lanes: usize,
    /// Side 2·part is the front of a part, 2·part + 1 its back.
    pub sides: Vec<Side>,
    /// By material, those that are rough metals, the same everywhere and at every wavelength.
    pub metals: Vec<Option<(Metal, Option<Later>)>>,
    /// The [plain](super::plain) triangles.
    pub plain: PlainTriangles,
    pub emitters: Vec<Emitter>,
    /// Number of emitters with extent; they come first.
    pub extended: usize,
    /// Radiance, intensity or irradiance of each emitter in watts.
    pub strengths: Vec<f64>,
    /// How one of many is chosen: of all emitters, and of those with extent.
    selections: [Option<Selection>; 2],
    /// What comes from everywhere.
    pub environment: Vec<Everywhere>,
    /// What varies over surfaces or with the wavelength.
    pub tints: Vec<Tint>,
    /// Looked up where a material is met, by material.
    pub pictures: Vec<Vec<Picture>>,
    /// Of sides that are not opaque.
    pub opacities: Vec<Opacity>,
    /// That absorb, on some side of a surface.
    pub media: Vec<Hue>,
    /// A surface somewhere lets a part of the light pass straight through.
    pub lets_pass: bool,
    /// What curves and colours are in the lanes.
    pub colors: ColorLanes,
    /// The channels of a spectral run.
    pub responses: Vec<BakedCurve>,
}

impl<'a> Tables<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let mut tints = Tints::default();
        let lights = scene.lights().iter();
        let powers: Vec<_> = lights.map(|light| tints.of_light(light)).collect();
        let materials = scene.materials().iter();
        let pictures = materials.clone().map(|(_, material)| material.pictures());
        let plain: Vec<_> = materials
            .enumerate()
            .map(|(number, (_, material))| tints.of_material(MaterialId(number as u32), material))
            .collect();
        let (mut emitters, emitter_of_light) = emitters(scene, &powers);
        let extended = emitters.iter().filter(|emitter| !emitter.shape.is_delta());
        let extended = extended.count();
        let strengths = strengths(scene, &emitters, &tints.tints);
        weigh_by_power(scene, &mut emitters, &strengths);
        let select = |count: usize| Selection::new(scene, &emitters[..count], &strengths[..count]);
        let (all, deltas) = (emitters.len(), emitters.len() - extended);
        let sums_some = (1..=SUMMED_LIGHTS).contains(&deltas);
        let selections = [
            Some(select(all)).filter(Selection::has_choice),
            (sums_some && extended > ALL_LIGHTS).then(|| select(extended)),
        ];
        let sides = scene.parts().iter().flat_map(|part| {
            [(part.front, true), (part.back, false)].map(|(material, front)| {
                let side = plain[material.0 as usize];
                part.light.map_or(side, |id| {
                    let number = id.0 as usize;
                    let light = (id, powers[number], emitter_of_light[number]);
                    emitting(side, scene, light, front)
                })
            })
        });
        let sides: Vec<_> = sides.collect();
        let lets_pass = sides.iter().any(Side::lets_pass);
        let everywhere = |(number, light): (usize, &Light)| {
            let map = match &light.kind {
                Kind::Environment { .. } => None,
                Kind::EnvironmentMap { map, .. } => Some(Arc::clone(map)),
                _ => return None,
            };
            Some(Everywhere {
                group: light.group,
                radiance: powers[number],
                map,
                emitters: of_light(&emitters, number),
            })
        };
        let environment = scene.lights().iter().enumerate();
        let environment = environment.filter_map(everywhere).collect();
        let grid = scene.lanes().grid();
        let bake = |curve: &Arc<Curve>| grid.map(|grid| grid.bake(curve));
        Self {
            scene,
            lanes: scene.lanes().carried(),
            metals: scene.materials().iter().map(|(_, m)| metal(m)).collect(),
            plain: PlainTriangles::new(scene.surfaces().triangles(), &sides),
            sides,
            emitters,
            extended,
            strengths,
            selections,
            environment,
            responses: scene.lanes().responses().iter().filter_map(bake).collect(),
            colors: ColorLanes::new(scene.lanes(), scene.curves()),
            tints: tints.tints,
            pictures: pictures.collect(),
            opacities: tints.opacities,
            media: tints.media,
            lets_pass,
        }
    }

    /// Whether a tint varies over the surface.
    pub fn has_textures(&self, tinted: &Tinted) -> bool {
        let tint = self.tints.get(tinted.tint as usize);
        tint.is_some_and(|tint| !tint.textures.is_empty())
    }

    /// Whether a side of a part is more than a Lambertian reflector or a mirror.
    pub fn is_any(&self, part: u32, front: bool) -> bool {
        let side = &self.sides[2 * part as usize + usize::from(!front)];
        matches!(side.model, Model::Any | Model::Pane)
    }

    /// Emitters for the vertices of a path: one chosen among all.
    pub fn for_surfaces(&self) -> Candidates {
        let count = self.emitters.len();
        Candidates {
            count,
            choice: if self.selections[0].is_none() {
                Choice::Each
            } else {
                Choice::ByImportance { samples: 1 }
            },
            receiver: Receiver::Surface,
        }
    }

    /// Emitters for a meter; without `delta` those of lights without extent are left out.
    pub fn for_meters(&self, delta: bool, receiver: Receiver) -> Candidates {
        let count = if delta {
            self.emitters.len()
        } else {
            self.extended
        };
        Candidates {
            count,
            choice: if count <= ALL_LIGHTS {
                Choice::Each
            } else {
                Choice::ByImportance {
                    samples: CHOSEN_LIGHTS,
                }
            },
            receiver,
        }
    }

    /// Whether points see lights without extent exactly.
    pub fn sums_lights(&self) -> bool {
        self.emitters.len() - self.extended <= SUMMED_LIGHTS
    }

    /// How one of these candidates is chosen by importance.
    pub fn selection(&self, candidates: Candidates) -> Option<&Selection> {
        let of_extended = candidates.count < self.emitters.len();
        self.selections[usize::from(of_extended)].as_ref()
    }

    /// How many samples an emitter gets in the mean at a place where candidates are sampled; of a mesh, per point of this primitive.
    #[inline(always)]
    pub fn rate(
        &self,
        candidates: Candidates,
        (emitter, primitive): (usize, u32),
        at: impl FnOnce() -> Receiving,
    ) -> f32 {
        let Choice::ByImportance { samples } = candidates.choice else {
            return 1.0;
        };
        let selection = self.selection(candidates);
        selection.map_or(0.0, |selection| {
            let triangle = primitive - self.emitters[emitter].shape.first_triangle();
            samples as f32 * selection.probability(&at(), emitter, triangle)
        })
    }
}

/// The first emitters of the tables, and which of them next-event estimation samples.
#[derive(Copy, Clone, Debug)]
pub(super) struct Candidates {
    pub count: usize,
    pub choice: Choice,
    pub receiver: Receiver,
}

/// Which candidates are sampled.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// Each of them.
    Each,
    /// So many, by what they may send to the place.
    ByImportance { samples: u32 },
}

/// Where light is gathered.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Receiver {
    /// At a vertex of a path.
    Surface,
    /// At a meter that takes light from the hemisphere of its normal, foreshortened.
    Irradiance,
    /// At a meter that takes light from the whole sphere.
    Scalar,
}
