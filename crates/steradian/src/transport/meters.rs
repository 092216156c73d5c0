//! Meters: what each reading of a run samples, and the part of it that is known exactly.
//!
//! | stream | start of its paths | scale of what they gather |
//! |---|---|---|
//! | irradiance | cosθ/π about the normal | π |
//! | scalar irradiance | uniform over the sphere | 4π |
//! | cylindrical irradiance | uniform about the axis, then cosθ/π about that normal | π |
//! | flux | uniform over the surface, then cosθ/π | πA |
//! | radiance | the surface that the ray meets | 1 |
//!
//! A point sees up to 16 384 lights without extent exactly: E = Σ I cosθ/r² · V in f64, with no sampling error; so it does those extended lights
//! that nothing [may hide](super::shaft). A ray sees the emission of the surface it meets exactly. What surfaces reflect is
//! sampled.

use std::ops::Range;
use std::sync::Arc;

use steradian_kernel::{HitBatch, MISS, RayBatch};

use super::columns::Place;
use super::cylinder::{self, CylinderMeter};
use super::exact;
use super::flux::FluxMeter;
use super::interaction::hit;
use super::roster::{Roster, Rosters};
use super::scattering::Encounter;
use super::shaft::View;
use super::tables::{Model, Side, Tables};
use crate::geometry::{Direction, Point};
use crate::light::Light;
use crate::scene::Scene;
use crate::sensor::{Cylinder, Kind, Receiver, Sensor, SitsOn};
use crate::shape::Form;

/// What one stream samples.
pub(super) enum Meter<'a> {
    /// A point that takes light from the hemisphere of its normal.
    Irradiance { place: Place, roster: Arc<Roster> },
    /// A point that takes light from everywhere.
    Scalar { place: Place, roster: Arc<Roster> },
    /// A point that takes light from hemispheres of normals about an axis.
    Cylinder(CylinderMeter),
    /// The reflecting surface that a ray meets.
    Surface(Encounter),
    /// A ray, of which nothing is known beforehand.
    Ray {
        origin: [f32; 3],
        direction: [f32; 3],
    },
    /// A surface.
    Flux(FluxMeter<'a>),
}

impl Meter<'_> {
    fn along(rays: &RayBatch, index: usize) -> Self {
        let ray = rays.ray(index);
        Self::Ray {
            origin: ray.origin,
            direction: ray.direction,
        }
    }
}

/// A reading before sampling.
pub(super) struct Prepared<'a> {
    pub index: usize,
    pub position: Option<Point>,
    pub normal: Option<Direction>,
    pub sits_on: Option<SitsOn>,
    /// What it is about, where that is no point.
    pub about: Option<String>,
    /// The exact part of each column.
    pub exact: Vec<f64>,
    /// Columns whose exact part is all there is.
    pub closed: Vec<bool>,
    /// What is left to sample, until a stream takes it.
    pub meter: Option<Meter<'a>>,
    /// Whether a stream samples it.
    pub is_sampled: bool,
}

impl Prepared<'_> {
    /// A reading of nowhere in particular, of which nothing is sampled.
    pub fn closed_form(exact: Vec<f64>, closed: Vec<bool>) -> Self {
        Self {
            index: 0,
            position: None,
            normal: None,
            sits_on: None,
            about: None,
            exact,
            closed,
            meter: None,
            is_sampled: false,
        }
    }
}

pub(super) struct Context<'t, 'a> {
    tables: &'t Tables<'a>,
    pub scene: &'a Scene,
    pub max_depth: u32,
    rosters: Rosters,
    /// Columns in which no light has any power.
    pub dark: Vec<bool>,
    /// By light and channel, whether it has any power.
    shines: Vec<Vec<bool>>,
    /// By light and channel, whether a surface may reflect it.
    reflected: Vec<Vec<bool>>,
}

impl<'t, 'a> Context<'t, 'a> {
    pub fn new(tables: &'t Tables<'a>, max_depth: u32) -> Self {
        let scene = tables.scene;
        let mut context = Context {
            tables,
            scene,
            max_depth,
            rosters: Rosters::new(tables),
            dark: vec![],
            shines: vec![],
            reflected: vec![],
        };
        let has_power = |light: &Light| {
            let powers = scene.channels(light, light.power()).into_iter();
            powers.map(|power| power > 0.0).collect()
        };
        context.shines = scene.lights().iter().map(has_power).collect();
        let lights = scene.lights().iter();
        context.reflected = lights.map(|light| context.reflected(light)).collect();
        context.dark = context.columns_where(|_| true);
        context
    }

    /// Prepares some readings of a sensor, which are those of its points where it has points.
    pub fn prepare(&self, sensor: &'a Sensor, points: Range<usize>) -> Vec<Prepared<'a>> {
        let first = points.start;
        match &sensor.kind {
            Kind::Irradiance(places) => {
                let receivers = self.scene.receivers(places, points);
                let receivers = (first..).zip(&receivers);
                receivers.map(|(i, one)| self.irradiance(i, one)).collect()
            }
            Kind::ScalarIrradiance(all) => (first..)
                .zip(&all[points])
                .map(|(i, point)| self.scalar(i, *point))
                .collect(),
            Kind::Cylindrical(cylinders) => (first..)
                .zip(&cylinders[points])
                .map(|(i, cylinder)| self.cylinder(i, cylinder))
                .collect(),
            Kind::Radiance(rays) => self.radiance(first, &rays[points]),
            Kind::Flux { surface, of, .. } => vec![self.flux(surface, *of)],
            Kind::Balance(accounts) => self.accounts(accounts),
            Kind::Camera(_) => vec![],
        }
    }

    /// For each channel, whether a surface other than a light's own may reflect it: a flat or convex one does not light itself,
    /// unless light goes through it.
    fn reflected(&self, light: &Light) -> Vec<bool> {
        let surfaces = self.scene.surfaces();
        let own = light.surface().map(|(shape, _)| surfaces.shape(shape));
        let own = own.filter(|placed| is_convex(&placed.form));
        let is_own = |part: usize| {
            own.is_some_and(|placed| placed.parts.iter().any(|id| id.0 as usize == part))
        };
        let reflects = |channel: usize| {
            let mut sides = self.tables.sides.iter().enumerate();
            self.max_depth >= 2
                && sides.any(|(number, side)| {
                    side.may_reflect(channel, light.is_delta())
                        && (side.transmits || !is_own(number / 2))
                })
        };
        (0..self.scene.lanes().count()).map(reflects).collect()
    }

    /// Columns of which a point receives nothing but what is known exactly: lights without extent where they are summed, and these
    /// emitters.
    fn closed_at(&self, known: &Roster) -> Vec<bool> {
        let emitters = self.tables.emitters.iter().enumerate();
        let mut of_emitters = vec![false; self.scene.lights().len()];
        let sums_lights = self.tables.sums_lights();
        emitters.for_each(|(number, emitter)| {
            let summed = sums_lights && emitter.shape.is_delta();
            of_emitters[emitter.light] = summed || known.knows(number);
        });
        self.columns_where(|(light, channel)| self.reflected[light][channel] || !of_emitters[light])
    }

    pub fn columns(&self) -> usize {
        self.scene.columns()
    }

    /// True for the columns to which no light that has any power there contributes; `contributes` is asked for a light and a
    /// channel.
    fn columns_where(&self, contributes: impl Fn((usize, usize)) -> bool) -> Vec<bool> {
        let channels = self.scene.lanes().count();
        let mut none = vec![true; self.columns()];
        for (number, light) in self.scene.lights().iter().enumerate() {
            let columns = &mut none[light.group as usize * channels..][..channels];
            for (channel, none) in columns.iter_mut().enumerate() {
                *none &= !(self.shines[number][channel] && contributes((number, channel)));
            }
        }
        none
    }

    /// Whether a point can receive anything that must be sampled.
    fn samples_points(&self, closed: &[bool]) -> bool {
        self.max_depth >= 1 && closed.contains(&false)
    }

    /// Whether a receiver can: not if nothing shines from everywhere, and no surface above its plane reflects or has light that is
    /// not known.
    fn samples_receiver(&self, receiver: &Receiver, known: &Roster, closed: &[bool]) -> bool {
        let surfaces = self.scene.surfaces();
        let clearance = receiver.clearance.max(surfaces.clearance());
        let is_dark = |side: &Side| {
            side.model == Model::Black && (!side.emits || known.knows(side.emitter as usize))
        };
        let is_dark = |primitive: u32| {
            let part = 2 * surfaces.part_of(primitive) as usize;
            self.tables.sides[part..part + 2].iter().all(is_dark)
        };
        let plane = (receiver.position, receiver.normal);
        self.samples_points(closed)
            && !(self.tables.environment.is_empty()
                && self.tables.sums_lights()
                && surfaces.nothing_above(plane.0, plane.1, clearance, &is_dark))
    }

    /// What a point knows of the extended lights; adds those in full view.
    fn roster(&self, view: &View, exact: &mut [f64]) -> Arc<Roster> {
        if self.max_depth == 0 {
            return Arc::default();
        }
        self.rosters.at(self.tables, view, exact)
    }

    fn irradiance(&self, index: usize, receiver: &Receiver) -> Prepared<'a> {
        let place = Place {
            point: self.scene.surfaces().to_kernel(receiver.position),
            normal: receiver.normal.to_array().map(|x| x as f32),
            clearance: receiver.clearance as f32,
        };
        let (position, normal) = (receiver.position, Some(receiver.normal));
        let mut exact = exact::irradiance(self.tables, position, normal, receiver.clearance);
        let view = View::new(position, normal, receiver.clearance);
        let roster = self.roster(&view, &mut exact);
        let closed = self.closed_at(&roster);
        Prepared {
            index,
            position: Some(position),
            normal,
            sits_on: receiver.sits_on.clone(),
            about: None,
            meter: self
                .samples_receiver(receiver, &roster, &closed)
                .then_some(Meter::Irradiance { place, roster }),
            exact,
            closed,
            is_sampled: false,
        }
    }

    fn scalar(&self, index: usize, point: Point) -> Prepared<'a> {
        let place = Place {
            point: self.scene.surfaces().to_kernel(point),
            normal: [0.0, 0.0, 1.0],
            clearance: 0.0,
        };
        let mut exact = exact::irradiance(self.tables, point, None, 0.0);
        let roster = self.roster(&View::new(point, None, 0.0), &mut exact);
        let closed = self.closed_at(&roster);
        Prepared {
            index,
            position: Some(point),
            normal: None,
            sits_on: None,
            about: None,
            meter: self
                .samples_points(&closed)
                .then_some(Meter::Scalar { place, roster }),
            exact,
            closed,
            is_sampled: false,
        }
    }

    fn cylinder(&self, index: usize, cylinder: &Cylinder) -> Prepared<'a> {
        let start = cylinder.position + cylinder.axis * cylinder.clearance;
        let exact = cylinder::exact(self.tables, cylinder, start);
        let closed = self.closed_at(&Roster::default());
        let meter = CylinderMeter::new(cylinder, self.scene.surfaces().to_kernel(start));
        Prepared {
            index,
            position: Some(cylinder.position),
            normal: Some(cylinder.facing.unwrap_or(cylinder.axis)),
            sits_on: None,
            about: None,
            meter: self
                .samples_points(&closed)
                .then_some(Meter::Cylinder(meter)),
            exact,
            closed,
            is_sampled: false,
        }
    }

    fn radiance(&self, first: usize, rays: &[(Point, Direction)]) -> Vec<Prepared<'a>> {
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
            let meter = self.first_surface((&batch, *direction), &hits, index, &mut exact);
            Prepared {
                index: first + index,
                position: Some(*origin),
                normal: Some(*direction),
                sits_on: None,
                about: None,
                exact,
                closed: self.dark.clone(),
                meter,
                is_sampled: false,
            }
        };
        rays.iter().enumerate().map(ray).collect()
    }

    fn first_surface(
        &self,
        (rays, looks): (&RayBatch, Direction),
        hits: &HitBatch,
        index: usize,
        exact: &mut [f64],
    ) -> Option<Meter<'a>> {
        if hits.primitive[index] == MISS && self.scene.has_environment_map() {
            return (self.max_depth >= 1).then(|| Meter::along(rays, index));
        }
        if hits.primitive[index] == MISS {
            exact::environment(self.scene, exact);
            return None;
        }
        let hit = hit(self.tables, rays, hits, index);
        let side = &self.tables.sides[hit.side as usize];
        let emission_varies = side.emits && self.tables.has_textures(&side.radiance);
        if side.lets_pass() || emission_varies {
            return (self.max_depth >= 1).then_some(Meter::Ray {
                origin: hit.origin,
                direction: hit.viewer.map(|axis| -axis),
            });
        }
        exact::emission(self.scene, hit.side, -looks, exact);
        let reflects = side.model != Model::Black && self.max_depth >= 2;
        reflects.then(|| Meter::Surface(Encounter::seen(&hit, self.tables.site(&hit))))
    }
}

/// Whether no point of the front sees another.
fn is_convex(form: &Form) -> bool {
    match form {
        Form::Parallelogram(_) | Form::Disc(_) | Form::Plane { .. } => true,
        Form::Sphere(sphere) => !sphere.inside && sphere.ports.is_empty(),
        Form::Mesh(_) => false,
    }
}
