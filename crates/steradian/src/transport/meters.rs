//! Meters: what each reading of a run samples, and the part of it that is known exactly.
//!
//! | stream | start of its paths | scale of what they gather |
//! |---|---|---|
//! | irradiance | cosθ/π about the normal | π |
//! | scalar irradiance | uniform over the sphere | 4π |
//! | flux | uniform over the surface, then cosθ/π | πA |
//! | radiance | the surface that the ray meets | 1 |
//!
//! A point sees lights without extent exactly: E = Σ I cosθ/r² · V in f64, with no sampling error. A ray sees the
//! emission of the surface it meets exactly. What surfaces reflect is sampled.

use steradian_kernel::{HitBatch, MISS, RayBatch};

use super::columns::Place;
use super::exact;
use super::flux::FluxMeter;
use super::interaction::hit;
use super::tables::{Model, OPAQUE, Side, Tables};
use crate::geometry::{Direction, Point};
use crate::light::Light;
use crate::material::Site;
use crate::scene::Scene;
use crate::sensor::{FluxOf, FluxSurface, Kind, Receiver, Sensor, SitsOn};
use crate::shape::Form;

/// What one stream samples.
pub(super) enum Meter<'a> {
    /// A point that takes light from the hemisphere of its normal.
    Irradiance(Place),
    /// A point that takes light from everywhere.
    Scalar(Place),
    /// The reflecting surface that a ray meets.
    Surface {
        place: Place,
        side: u32,
        viewer: [f32; 3],
        site: Site,
    },
    /// A ray, of which nothing is known beforehand.
    Ray {
        origin: [f32; 3],
        direction: [f32; 3],
    },
    /// A surface.
    Flux(FluxMeter<'a>),
}

/// A reading before sampling.
pub(super) struct Prepared<'a> {
    pub index: usize,
    pub position: Option<Point>,
    pub normal: Option<Direction>,
    pub sits_on: Option<SitsOn>,
    /// The exact part of each column.
    pub exact: Vec<f64>,
    /// Columns whose exact part is all there is.
    pub closed: Vec<bool>,
    /// What is left to sample.
    pub meter: Option<Meter<'a>>,
    /// The stream that samples it.
    pub stream: Option<usize>,
}

/// Prepares all readings of a sensor.
pub(super) fn prepare<'a>(
    tables: &Tables<'a>,
    sensor: &'a Sensor,
    max_depth: u32,
) -> Vec<Prepared<'a>> {
    let context = Context::new(tables, max_depth);
    match &sensor.kind {
        Kind::Irradiance(receivers) => receivers
            .iter()
            .enumerate()
            .map(|(i, receiver)| context.irradiance(i, receiver))
            .collect(),
        Kind::ScalarIrradiance(points) => points
            .iter()
            .enumerate()
            .map(|(i, point)| context.scalar(i, *point))
            .collect(),
        Kind::Radiance(rays) => context.radiance(rays),
        Kind::Flux { surface, of, .. } => vec![context.flux(surface, *of)],
        Kind::Camera(_) => vec![],
    }
}

struct Context<'t, 'a> {
    tables: &'t Tables<'a>,
    scene: &'a Scene,
    max_depth: u32,
    /// Columns in which no light has any power.
    dark: Vec<bool>,
    /// Columns of which a point receives lights without extent only, by themselves and not by reflection.
    closed_at_points: Vec<bool>,
}

impl<'t, 'a> Context<'t, 'a> {
    fn new(tables: &'t Tables<'a>, max_depth: u32) -> Self {
        let scene = tables.scene;
        let context = Context {
            tables,
            scene,
            max_depth,
            dark: vec![],
            closed_at_points: vec![],
        };
        let reflects = |channel: usize| {
            let by = |side: &Side| side.model != Model::Black && side.may_reflect(channel);
            max_depth >= 2 && tables.sides.iter().any(by)
        };
        let channels = scene.lanes().count();
        let reflects: Vec<bool> = (0..channels).map(reflects).collect();
        let of = |light: &Light| scene.channels(light, light.power());
        let dark = context.columns_where(|light| of(light).iter().map(|x| *x > 0.0).collect());
        let closed_at_points = context.columns_where(|light| {
            let shines = of(light).into_iter().zip(&reflects);
            shines
                .map(|(x, reflects)| x > 0.0 && (*reflects || !light.is_delta()))
                .collect()
        });
        Context {
            dark,
            closed_at_points,
            ..context
        }
    }

    fn columns(&self) -> usize {
        self.scene.columns()
    }

    /// True for the columns to which no light contributes; `contributes` tells for each channel.
    fn columns_where(&self, contributes: impl Fn(&Light) -> Vec<bool>) -> Vec<bool> {
        let channels = self.scene.lanes().count();
        let mut none = vec![true; self.columns()];
        for light in self.scene.lights() {
            let columns = &mut none[light.group as usize * channels..][..channels];
            for (none, contributes) in columns.iter_mut().zip(contributes(light)) {
                *none &= !contributes;
            }
        }
        none
    }

    /// Whether a point can receive anything that must be sampled.
    fn samples_points(&self) -> bool {
        self.max_depth >= 1 && self.closed_at_points.contains(&false)
    }

    /// Whether a receiver can: not if nothing shines from everywhere and no surface reaches above its plane.
    fn samples_receiver(&self, receiver: &Receiver) -> bool {
        let surfaces = self.scene.surfaces();
        let clearance = receiver.clearance.max(surfaces.clearance());
        self.samples_points()
            && !(self.tables.environment.is_empty()
                && surfaces.nothing_above(receiver.position, receiver.normal, clearance))
    }

    fn irradiance(&self, index: usize, receiver: &Receiver) -> Prepared<'a> {
        let place = Place {
            point: self.scene.surfaces().to_kernel(receiver.position),
            normal: receiver.normal.to_array().map(|x| x as f32),
            clearance: receiver.clearance as f32,
        };
        Prepared {
            index,
            position: Some(receiver.position),
            normal: Some(receiver.normal),
            sits_on: receiver.sits_on.clone(),
            exact: exact::irradiance(
                self.tables,
                receiver.position,
                Some(receiver.normal),
                receiver.clearance,
            ),
            closed: self.closed_at_points.clone(),
            meter: self
                .samples_receiver(receiver)
                .then_some(Meter::Irradiance(place)),
            stream: None,
        }
    }

    fn scalar(&self, index: usize, point: Point) -> Prepared<'a> {
        let place = Place {
            point: self.scene.surfaces().to_kernel(point),
            normal: [0.0, 0.0, 1.0],
            clearance: 0.0,
        };
        Prepared {
            index,
            position: Some(point),
            normal: None,
            sits_on: None,
            exact: exact::irradiance(self.tables, point, None, 0.0),
            closed: self.closed_at_points.clone(),
            meter: self.samples_points().then_some(Meter::Scalar(place)),
            stream: None,
        }
    }

    fn radiance(&self, rays: &[(Point, Direction)]) -> Vec<Prepared<'a>> {
        let surfaces = self.scene.surfaces();
        let (mut batch, mut hits) = (RayBatch::default(), HitBatch::default());
        for (origin, direction) in rays {
            batch.push(
                surfaces.to_kernel(*origin),
                direction.to_array().map(|x| x as f32),
                f32::INFINITY,
            );
        }
        surfaces.closest(
            &batch,
            &mut hits,
            steradian_kernel::InstructionSet::detect(),
        );
        let ray = |(index, (origin, direction)): (usize, &(Point, Direction))| {
            let mut exact = vec![0.0; self.columns()];
            let meter = self.first_surface(&batch, &hits, index, &mut exact);
            Prepared {
                index,
                position: Some(*origin),
                normal: Some(*direction),
                sits_on: None,
                exact,
                closed: self.dark.clone(),
                meter,
                stream: None,
            }
        };
        rays.iter().enumerate().map(ray).collect()
    }

    fn first_surface(
        &self,
        rays: &RayBatch,
        hits: &HitBatch,
        index: usize,
        exact: &mut [f64],
    ) -> Option<Meter<'a>> {
        if hits.primitive[index] == MISS {
            exact::environment(self.scene, exact);
            return None;
        }
        let hit = hit(self.tables, rays, hits, index);
        let side = &self.tables.sides[hit.side as usize];
        let emission_varies = side.emits && self.tables.has_textures(&side.radiance);
        if side.opacity != OPAQUE || emission_varies {
            return (self.max_depth >= 1).then_some(Meter::Ray {
                origin: hit.origin,
                direction: hit.viewer.map(|axis| -axis),
            });
        }
        exact::emission(self.scene, hit.side, exact);
        let reflects = side.model != Model::Black && self.max_depth >= 2;
        reflects.then(|| Meter::Surface {
            place: hit.place,
            side: hit.side,
            viewer: hit.viewer,
            site: self.tables.site(&hit),
        })
    }

    fn flux(&self, surface: &'a FluxSurface, of: FluxOf) -> Prepared<'a> {
        let mut exact = vec![0.0; self.columns()];
        let mut forms = Vec::new();
        let mut area = 0.0;
        let mut add = |form: &'a Form, parts| {
            area += form.sampling_area();
            forms.push((form, parts, area));
        };
        let front = match surface {
            FluxSurface::Virtual(form) => {
                add(form, None);
                true
            }
            FluxSurface::Shapes { shapes, front } => {
                for id in shapes {
                    let placed = self.scene.surfaces().shape(*id);
                    add(&placed.form, Some(&placed.parts[..]));
                    exact::emitted_flux(self.scene, placed, *front, of, &mut exact);
                }
                *front
            }
        };
        let forms = forms
            .into_iter()
            .map(|(form, parts, sum)| (form, parts, sum / area))
            .collect();
        let meter = (self.max_depth >= 1).then_some(Meter::Flux(FluxMeter {
            forms,
            area,
            front,
            of,
        }));
        Prepared {
            index: 0,
            position: None,
            normal: None,
            sits_on: None,
            exact,
            closed: self.dark.clone(),
            meter,
            stream: None,
        }
    }
}
