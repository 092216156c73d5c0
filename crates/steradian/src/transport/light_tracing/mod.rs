//! Light tracing: what polished surfaces throw from lights without extent, which no path from a camera finds.
//!
//! Paths are named by what they meet from the light to the eye: L_δ a light without extent, S a polished surface, which couples single
//! directions, D one that scatters into solid angles, E the eye. A path from the camera samples L_δ at each D; so all L_δ D … E
//! are its own, and L_δ S … are none of them. Those that end in D E are sampled here, from the light: what is divided without
//! overlap needs no weights. What is left, L_δ S … S E, is told as [`unsampled`](super::unsampled).
//!
//! A path of flux Φ that meets a surface of model ρ adds to the picture
//!
//! V = Φ ρ(d_e, d_i) |cosθ_e| T N
//!
//! as an area dA has the radiance ρ dΦ/dA and fills N dA |cosθ_e| of the film, N being the [pixels per area](crate::sensor::Sight) at the point. It
//! goes on in a direction of density p with the flux Φ ρ |cosθ_e|/p.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Φ | flux that the path stands for | W |
//! | V | radiance times pixels | W/(m² sr) |
//! | T | transmittance from the point to the eye | 1 |
//! | N | pixels per area that faces the eye | 1/m² |
//!
//! Flux knows no (n_e/n_i)², and normals that are finer than the surface change it by |cosθ_i′ cosθ_e|/(|cosθ_i cosθ_e′|), with ′ for the finer
//! normal. Surfaces that let light pass straight are no meetings, as for paths from the camera, and `max_depth` counts the same segments.
//! V is bounded by the distance of what is in view from the eye, but for finer normals at grazing light.
//!
//! Source: P. Dutré, E. Lafortune & Y. Willems, *Monte Carlo light tracing with direct computation of pixel intensities* (Compugraphics
//! 1993); E. Veach, *Robust Monte Carlo methods for light transport simulation* (1997), §5.2 and §5.3 (adjoint models).

mod aims;
mod arrival;
mod ball;
mod bundle;
mod connections;
mod particles;

pub(super) use aims::Aims;

use std::ops::Range;

use glam::Vec3;
use steradian_kernel::{HitBatch, InstructionSet, MISS, RayBatch};

use self::arrival::{Arrival, Departure};
use self::connections::{Connection, Connections};
use self::particles::Particle;
use super::channels;
use super::columns::BATCH;
use super::interaction::{Hit, hit};
use super::scatter::{number_at, survives};
use super::tables::{Lanes4, Model, OPAQUE, Tables};
use crate::estimation::film::{CHANNELS, Splat};
use crate::geometry::Vector;
use crate::sampling::{block, hash, warp};
use crate::sensor::{Camera, Sight};
use crate::spectrum::{WavelengthDensity, Wavelengths};

/// Sends paths from lights without extent, by way of polished surfaces, to a camera.
pub(super) struct LightTracer<'a> {
    pub tables: &'a Tables<'a>,
    pub set: InstructionSet,
    pub max_depth: u32,
    pub camera: Camera,
    pub aims: Aims,
    /// Of wavelengths; none unless the run is spectral.
    pub density: Option<WavelengthDensity>,
    /// Channels of the film, of a spectral run.
    pub channels: [usize; 4],
}

/// Paths traced together.
#[derive(Default)]
struct Batch {
    wavelengths: Vec<Wavelengths>,
    flying: Vec<Particle>,
    connections: Connections,
}

impl LightTracer<'_> {
    /// Adds what paths of these indices bring.
    pub fn trace(&self, indices: Range<u32>, key: u64, out: &mut Vec<Splat>) {
        let mut from = indices.start;
        while from < indices.end {
            let to = from.saturating_add(BATCH as u32).min(indices.end);
            self.follow(self.launch(from..to, key), out);
            from = to;
        }
    }

    fn launch(&self, indices: Range<u32>, key: u64) -> Batch {
        let mut batch = Batch::default();
        for index in indices {
            let [choice, u, v, w] = block::sample(key, index, 0);
            let waves = self.density.as_ref().map(|density| density.sample(w));
            let waves = waves.unwrap_or_default();
            let slot = batch.wavelengths.len() as u32;
            let identity = (slot, key, index);
            if let Some(start) = self.aims.sample(self.tables, choice, [u, v], &waves) {
                batch.flying.push(Particle::new(start, identity));
            }
            batch.wavelengths.push(waves);
        }
        batch
    }

    fn follow(&self, mut batch: Batch, out: &mut Vec<Splat>) {
        let (mut rays, mut hits) = (RayBatch::default(), HitBatch::default());
        while !batch.flying.is_empty() {
            rays.clear();
            for particle in &batch.flying {
                rays.push(particle.origin, particle.direction, f32::INFINITY);
            }
            let surfaces = self.tables.scene.surfaces();
            surfaces.closest(&rays, &mut hits, self.set);
            for (i, particle) in std::mem::take(&mut batch.flying).into_iter().enumerate() {
                if hits.primitive[i] != MISS {
                    self.arrive(particle, &hit(self.tables, &rays, &hits, i), &mut batch);
                }
            }
            self.settle(&mut batch, out);
        }
    }

    fn arrive(&self, mut particle: Particle, hit: &Hit, batch: &mut Batch) {
        let tables = self.tables;
        let waves = batch.wavelengths[particle.identity.0 as usize];
        let side = &tables.sides[hit.side as usize];
        particle.travel(tables, hit.distance_squared.sqrt(), &waves);
        if side.opacity != OPAQUE {
            let opacity = tables.opacity(side, || tables.site(hit));
            if opacity.is_some_and(|opacity| self.number_for(&particle, hit) >= opacity) {
                batch.flying.push(particle.passed(hit));
                return;
            }
        }
        match side.model {
            Model::Black => {}
            Model::Pane => self.arrive_at_pane(particle, hit, &waves, batch),
            Model::Lambertian | Model::Mirror | Model::Any => {
                self.scatter(particle, &Arrival::new(tables, hit, &waves), batch);
            }
        }
    }

    /// Goes straight through a pane or is reflected, in proportion to the flux that each leaves.
    fn arrive_at_pane(
        &self,
        particle: Particle,
        hit: &Hit,
        waves: &Wavelengths,
        batch: &mut Batch,
    ) {
        let side = &self.tables.sides[hit.side as usize];
        let [reflected, passed] = self.tables.pane(side, hit, waves);
        let lanes = || particle.throughput.iter().take(self.tables.lanes);
        let all: f32 = lanes().sum();
        let left: f32 = lanes()
            .zip(passed)
            .map(|(part, passed)| part * passed)
            .sum();
        let share = left / all;
        if all == 0.0 {
            return;
        }
        // What is left of the number that decided whether the surface is there.
        let opacity = self.tables.opacity(side, || self.tables.site(hit));
        if self.number_for(&particle, hit) / opacity.unwrap_or(1.0) < share {
            let weight = passed.map(|lane| lane / share);
            batch.flying.push(particle.weighed(weight).passed(hit));
        } else if self.is_first_aim(&particle, hit) {
            let weight = reflected.map(|lane| lane / (1.0 - share));
            let departure = arrival::mirrored(hit, weight);
            batch.flying.extend(self.leave(particle, hit, &departure));
        }
    }

    /// Connects what a surface scatters with the eye, and sends the path on.
    fn scatter(&self, mut particle: Particle, arrival: &Arrival<'_>, batch: &mut Batch) {
        let hit = arrival.hit;
        if !self.is_first_aim(&particle, hit) {
            return;
        }
        particle.enter(self.tables, arrival.medium_before(), arrival.wavelengths);
        let (_, key, index) = particle.identity;
        let [a, b, lens @ ..] = block::sample(key, index, particle.events + 1);
        let ends = particle.events + 2;
        if particle.events > 0 && ends <= self.max_depth {
            self.connect(&particle, arrival, lens, &mut batch.connections);
        }
        if ends >= self.max_depth {
            return;
        }
        let departure = arrival.scatter([a, b]);
        if let Some(departure) = departure.filter(|way| particle.events > 0 || way.is_specular) {
            batch.flying.extend(self.leave(particle, hit, &departure));
        }
    }
}

impl LightTracer<'_> {
    /// Whether a path that has met nothing yet meets what it was sent to; all others may go anywhere.
    fn is_first_aim(&self, particle: &Particle, hit: &Hit) -> bool {
        let met = self.tables.scene.surfaces().shape_of(hit.primitive);
        particle.events > 0 || particle.target.is_none_or(|target| target == met)
    }

    /// A uniform number for this meeting of a path and a surface.
    fn number_for(&self, particle: &Particle, hit: &Hit) -> f32 {
        let (_, key, index) = particle.identity;
        let meeting = hash::mix_32(particle.events ^ hash::mix_32(particle.passes));
        number_at(key, index, hash::mix_32(hit.primitive ^ meeting))
    }

    /// Leaves a surface, or ends by roulette.
    fn leave(&self, particle: Particle, hit: &Hit, departure: &Departure) -> Option<Particle> {
        if particle.events + 2 >= self.max_depth {
            return None;
        }
        let lanes = particle.throughput.iter().zip(departure.weight);
        let lanes = lanes.take(self.tables.lanes);
        let greatest = lanes
            .map(|(part, weight)| part * weight)
            .fold(0.0, f32::max);
        let survival = survives(greatest, particle.identity, particle.events + 1)?;
        Some(particle.departed(hit, departure, survival))
    }

    /// Draws a line from a surface to the eye, by way of this place of the lens.
    fn connect(
        &self,
        particle: &Particle,
        arrival: &Arrival<'_>,
        lens: [f32; 2],
        connections: &mut Connections,
    ) {
        let place = &arrival.hit.place;
        let origin = self.tables.scene.surfaces().origin();
        let point = origin + Vector::from(place.point.map(f64::from));
        let lens = warp::disc(lens[0], lens[1]).map(f64::from);
        let Some(sight) = self.camera.sight(point, lens) else {
            return;
        };
        let places = self.camera.repeats(sight.film);
        let places: Vec<_> = places.filter(|place| self.is_on_film(place)).collect();
        if !places.is_empty() {
            self.draw(particle, arrival, (&sight, &places), connections);
        }
    }

    /// Draws the line of sight for each place on the film that shows it.
    fn draw(
        &self,
        particle: &Particle,
        arrival: &Arrival<'_>,
        (sight, places): (&Sight, &[[f64; 2]]),
        connections: &mut Connections,
    ) {
        let place = &arrival.hit.place;
        let eye = Vec3::from_array(self.tables.scene.surfaces().to_kernel(sight.from));
        let direction = (eye - Vec3::from_array(place.point)).normalize_or_zero();
        let Some(seen) = arrival.towards(direction) else {
            return;
        };
        let start = place.start(direction);
        let value = |lane: usize| {
            let flux = particle.flux[lane] * particle.throughput[lane];
            flux * seen[lane] * sight.pixels_per_area as f32
        };
        for &place in places {
            connections.push(Connection {
                ray: (start.into(), (eye - start).into()),
                place,
                value: std::array::from_fn(value),
                slot: particle.identity.0,
            });
        }
    }

    /// Whether a place reaches a pixel.
    fn is_on_film(&self, place: &[f64; 2]) -> bool {
        let mut pairs = place.iter().zip(self.camera.resolution);
        pairs.all(|(place, size)| (-2.0..=f64::from(size) + 2.0).contains(place))
    }

    fn settle(&self, batch: &mut Batch, out: &mut Vec<Splat>) {
        let wavelengths = &batch.wavelengths;
        batch
            .connections
            .settle(self.tables, wavelengths, self.set, |connection, lanes| {
                let value = self.channels_of(lanes, &wavelengths[connection.slot as usize]);
                out.push(Splat {
                    place: connection.place,
                    value,
                });
            });
    }

    fn channels_of(&self, lanes: Lanes4, wavelengths: &Wavelengths) -> [f32; CHANNELS] {
        if self.density.is_none() {
            let carried = |lane: usize| {
                if lane < self.tables.lanes {
                    lanes[lane]
                } else {
                    0.0
                }
            };
            return std::array::from_fn(carried);
        }
        self.channels.map(|channel| {
            let counts = channels::counts(&self.tables.responses[channel], wavelengths);
            let lane = |lane: usize| lanes[lane] * counts[lane];
            (lane(0) + lane(1)) + (lane(2) + lane(3))
        })
    }
}
