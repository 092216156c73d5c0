//! A path on its way from a light.

use super::aims::Start;
use super::arrival::Departure;
use crate::shape::ShapeId;
use crate::spectrum::Wavelengths;
use crate::transport::interaction::Hit;
use crate::transport::media::AIR;
use crate::transport::tables::{Lanes4, Tables};

/// A path that carries flux.
#[derive(Clone, Debug)]
pub(in crate::transport) struct Particle {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    /// Flux with which it left the light, by lane.
    pub flux: Lanes4,
    /// What part of it is left.
    pub throughput: Lanes4,
    /// Of the light.
    pub group: u32,
    /// Slot, key and index.
    pub identity: (u32, u64, u32),
    /// The shape that it must meet first; none: any that is polished.
    pub target: Option<ShapeId>,
    /// Meetings so far.
    pub events: u32,
    /// Surfaces passed straight so far.
    pub passes: u32,
    medium: Medium,
}

/// What a path knows of the medium that it is in.
#[derive(Copy, Clone, Debug)]
enum Medium {
    /// Nothing before the first interface, which tells; metres so far.
    Untold(f32),
    Told(u32),
}

impl Particle {
    pub(super) fn new(start: Start, identity: (u32, u64, u32)) -> Self {
        Self {
            origin: start.origin,
            direction: start.direction,
            flux: start.flux,
            throughput: [1.0; 4],
            group: start.group,
            identity,
            target: start.target,
            events: 0,
            passes: 0,
            medium: Medium::Untold(0.0),
        }
    }

    pub fn weighed(mut self, weight: Lanes4) -> Self {
        for (lane, weight) in self.throughput.iter_mut().zip(weight) {
            *lane *= weight;
        }
        self
    }

    /// Flux that is left, by lane.
    pub fn carried(&self) -> Lanes4 {
        std::array::from_fn(|lane| self.flux[lane] * self.throughput[lane])
    }

    /// What part of it is left after some more metres.
    pub fn kept(&self, tables: &Tables<'_>, way: f32, wavelengths: &Wavelengths) -> Lanes4 {
        match self.medium {
            Medium::Untold(_) => [1.0; 4],
            Medium::Told(medium) => tables.attenuation(medium, way, wavelengths),
        }
    }

    /// Goes on behind a surface.
    pub fn passed(self, hit: &Hit) -> Self {
        Self {
            origin: hit.place.beyond(),
            passes: self.passes + 1,
            ..self
        }
    }

    /// Loses what the medium absorbs on a way.
    pub fn travel(&mut self, tables: &Tables<'_>, way: f32, wavelengths: &Wavelengths) {
        match &mut self.medium {
            Medium::Untold(metres) => *metres += way,
            Medium::Told(AIR) => {}
            Medium::Told(medium) => {
                let part = tables.attenuation(*medium, way, wavelengths);
                *self = self.clone().weighed(part);
            }
        }
    }

    /// Learns from a surface that tells what medium lies before it.
    pub fn enter(&mut self, tables: &Tables<'_>, told: Option<u32>, wavelengths: &Wavelengths) {
        if let (Medium::Untold(way), Some(medium)) = (self.medium, told) {
            self.medium = Medium::Told(medium);
            self.travel(tables, way, wavelengths);
        }
    }

    /// Leaves a surface.
    pub fn departed(self, hit: &Hit, departure: &Departure, survival: f32) -> Self {
        let medium = departure.medium.map_or(self.medium, Medium::Told);
        let weight = departure.weight.map(|lane| lane / survival);
        Self {
            origin: hit.place.start(departure.direction).into(),
            direction: departure.direction.into(),
            events: self.events + 1,
            medium,
            ..self.weighed(weight)
        }
    }
}
