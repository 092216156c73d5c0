//! Flux that paths from lights carry to a surface, through it and away from it.
//!
//! What arrives counts as for [paths from the surface](super::super::flux), with the same weight; what a model leaves, which no weight tells, by
//! the path that leaves. Light that comes straight from its source is none of this, but where a model sends it on in a single direction.

use glam::Vec3;

use super::super::flux::FluxMeter;
use super::super::interaction::Hit;
use super::super::light_tracing::{Departure, Particle};
use super::super::tables::{Lanes4, Model, Side, Tables};
use crate::geometry::{Direction, Point, Vector};
use crate::sensor::FluxOf;
use crate::shape::{Crossing, Form, Ray};
use crate::spectrum::Wavelengths;

const NOTHING: Lanes4 = [0.0; 4];

/// A surface on which light lands.
pub(super) struct Landing<'a>(pub &'a FluxMeter<'a>);

impl Landing<'_> {
    /// What a flight through a surface that does not block light brings: it stands as far before what it lies on as where paths from it start.
    pub fn passing(
        &self,
        tables: &Tables<'_>,
        particle: &Particle,
        reach: Option<f32>,
        waves: &Wavelengths,
    ) -> Lanes4 {
        let mut sum = NOTHING;
        let (Some(form), Some(ray)) = (self.virtual_form(), ray(tables, particle, reach)) else {
            return sum;
        };
        form.crossings(&ray, |crossing| {
            let kept = particle.kept(tables, crossing.distance as f32, waves);
            let (flux, sign) = (particle.carried(), self.sign(crossing));
            add(&mut sum, |lane| sign * flux[lane] * kept[lane]);
        });
        sum
    }

    fn virtual_form(&self) -> Option<&Form> {
        let (form, parts, _) = self.0.forms.first()?;
        parts.is_none().then_some(form)
    }

    fn sign(&self, crossing: Crossing) -> f32 {
        let is_counted = crossing.from_front == self.0.front;
        let counts = |yes: bool| f32::from(u8::from(yes));
        match self.0.of {
            FluxOf::Incident | FluxOf::Absorbed | FluxOf::Emitted => counts(is_counted),
            FluxOf::Leaving => counts(!is_counted),
            FluxOf::Net => counts(crossing.from_front) - counts(!crossing.from_front),
        }
    }

    /// What arrives at a shape.
    pub fn arriving(
        &self,
        tables: &Tables<'_>,
        particle: &Particle,
        (hit, waves): (&Hit, &Wavelengths),
    ) -> Lanes4 {
        if !self.is_counted(hit) || !self.has(tables, hit) {
            return NOTHING;
        }
        let side = &tables.sides[hit.side as usize];
        let weights = self.0.weights(tables, side, || tables.site(hit), waves);
        let flux = particle.carried();
        std::array::from_fn(|lane| weights[lane] * flux[lane])
    }

    /// What leaves a shape whose model no weight stands for.
    pub fn leaving(
        &self,
        tables: &Tables<'_>,
        particle: &Particle,
        (hit, departure): (&Hit, &Departure),
    ) -> Lanes4 {
        let side = &tables.sides[hit.side as usize];
        if !is_asked(side) || !self.has(tables, hit) {
            return NOTHING;
        }
        let is_beyond = departure.direction.dot(Vec3::from_array(hit.place.normal)) < 0.0;
        let comes = self.is_counted(hit);
        let goes = comes != is_beyond;
        let sign = match self.0.of {
            FluxOf::Incident | FluxOf::Emitted => 0.0,
            FluxOf::Leaving if goes => 1.0,
            FluxOf::Net if goes => -1.0,
            FluxOf::Absorbed if comes => -1.0,
            FluxOf::Leaving | FluxOf::Net | FluxOf::Absorbed => 0.0,
        };
        let flux = particle.carried();
        std::array::from_fn(|lane| sign * flux[lane] * departure.weight[lane])
    }

    /// Whether light came to the side that is counted.
    fn is_counted(&self, hit: &Hit) -> bool {
        hit.side.is_multiple_of(2) == self.0.front
    }

    /// Whether what was met is one of the shapes.
    fn has(&self, tables: &Tables<'_>, hit: &Hit) -> bool {
        let surfaces = tables.scene.surfaces();
        let first = surfaces.first_primitive(surfaces.shape_of(hit.primitive));
        self.0.shapes.binary_search(&first).is_ok()
    }
}

fn add(sum: &mut Lanes4, value: impl Fn(usize) -> f32) {
    for (lane, sum) in sum.iter_mut().enumerate() {
        *sum += value(lane);
    }
}

fn is_asked(side: &Side) -> bool {
    matches!(side.model, Model::Any | Model::Pane)
}

fn ray(tables: &Tables<'_>, particle: &Particle, reach: Option<f32>) -> Option<Ray> {
    let vector = |components: [f32; 3]| Vector::from(components.map(f64::from));
    let origin: Point = tables.scene.surfaces().origin() + vector(particle.origin);
    Some(Ray {
        origin,
        direction: Direction::new(vector(particle.direction)).ok()?,
        reach: reach.map_or(f64::INFINITY, f64::from),
        clearance: tables.scene.surfaces().clearance(),
    })
}
