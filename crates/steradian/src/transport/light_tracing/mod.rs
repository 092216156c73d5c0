//! Light tracing: what polished surfaces throw from lights without extent, which no path from a sensor finds.
//!
//! Paths are named by what they meet from the light to the sensor: L_δ a light without extent, S a polished surface, which couples single
//! directions, D one that scatters into solid angles, E the eye, M a point at which light is measured, A an area whose flux is. A path from a
//! sensor samples L_δ at each D, M and A; so all L_δ D … and L_δ A are its own, and L_δ S … are none of them. Those are sampled here, from the light:
//! what is divided without overlap needs no weights.
//!
//! | path | sampled | home |
//! |---|---|---|
//! | L_δ S … D E | by a line from D to the [eye](film) | pictures |
//! | L_δ S … D M | by a line from D to the point | [meters](super::thrown) |
//! | L_δ S … A | where it arrives | meters of flux |
//! | L_δ S … S E, L_δ S … S M | not: told as [`unsampled`](super::unsampled) | |
//!
//! A path of flux Φ that meets a surface of model ρ goes on in a direction of density p with the flux Φ ρ |cosθ_e|/p. Flux knows no (n_e/n_i)², and
//! normals that are finer than the surface change it by |cosθ_i′ cosθ_e|/(|cosθ_i cosθ_e′|), with ′ for the finer
//! normal. Surfaces that let light pass straight are no meetings, as for paths from a sensor, and `max_depth` counts the same segments.
//!
//! Source: P. Dutré, E. Lafortune & Y. Willems, *Monte Carlo light tracing with direct computation of pixel intensities* (Compugraphics
//! 1993); E. Veach, *Robust Monte Carlo methods for light transport simulation* (1997), §5.2 and §5.3 (adjoint models).

mod aims;
mod arrival;
mod ball;
mod bundle;
mod connections;
mod film;
mod focus;
mod particles;

pub(super) use arrival::{Arrival, Departure};
pub(super) use connections::{Connection, Connections};
pub(super) use film::{FilmBatch, FilmTracer};
pub(super) use particles::Particle;

use glam::Vec3;
use steradian_kernel::{HitBatch, InstructionSet, MISS, RayBatch};

use self::aims::Aims;
use super::interaction::{Hit, hit};
use super::scatter::{number_at, survives};
use super::tables::{Model, OPAQUE, Tables};
use crate::sampling::{block, hash};
use crate::spectrum::Wavelengths;

/// Sends paths from lights without extent by way of polished surfaces.
pub(super) struct LightTracer<'a> {
    pub tables: &'a Tables<'a>,
    pub set: InstructionSet,
    pub max_depth: u32,
    aims: Aims,
}

/// What a sensor takes of the paths.
pub(super) trait Catch {
    /// Segments from the last surface that a path of this slot meets to the sensor: 0 if the sensor is there.
    fn segments(&self, slot: u32) -> u32;

    /// A path goes so many metres, or on for ever.
    fn fly(&mut self, _: &Particle, _: Option<f32>, _: &Wavelengths) {}

    /// A path arrives at a surface, whether it passes through or not.
    fn arrive(&mut self, _: &Particle, _: &Hit, _: &Wavelengths) {}

    /// A path that has met a polished surface before meets one that scatters. The numbers are its own.
    fn scatter(&mut self, _: &Particle, _: &Arrival<'_>, _: [f32; 2]) {}

    /// A path leaves a surface, or passes through a pane.
    fn leave(&mut self, _: &Particle, _: &Hit, _: &Departure) {}

    /// All paths have come to the next surface.
    fn settle(&mut self, _: &[Wavelengths]) {}
}

/// Paths traced together.
#[derive(Default)]
pub(super) struct Flock {
    flying: Vec<Particle>,
    arriving: Vec<Particle>,
    rays: RayBatch,
    hits: HitBatch,
    /// Rays so far, one that draws a line to a sensor not counted.
    pub traced: u64,
}

impl<'a> LightTracer<'a> {
    /// `None` if there is nothing to trace.
    pub fn new(tables: &'a Tables<'a>, set: InstructionSet, max_depth: u32) -> Option<Self> {
        let aims = Aims::new(tables)?;
        Some(Self {
            tables,
            set,
            max_depth,
            aims,
        })
    }
}

impl LightTracer<'_> {
    /// Lets the path of this slot, key and index start; if it is for a point, it may be aimed there.
    pub fn launch(
        &self,
        identity: (u32, u64, u32),
        point: Option<Vec3>,
        waves: &Wavelengths,
        flock: &mut Flock,
    ) {
        let numbers = block::sample(identity.1, identity.2, 0);
        let start = self.aims.sample(self.tables, numbers, point, waves);
        let path = start.map(|start| Particle::new(start, identity));
        flock.flying.extend(path);
    }

    /// Follows all paths to their ends; their wavelengths are by slot.
    pub fn follow(&self, flock: &mut Flock, wavelengths: &[Wavelengths], catch: &mut impl Catch) {
        while !flock.flying.is_empty() {
            self.look(flock);
            let mut arriving = std::mem::take(&mut flock.arriving);
            for (i, particle) in arriving.drain(..).enumerate() {
                let waves = &wavelengths[particle.identity.0 as usize];
                if flock.hits.primitive[i] == MISS {
                    catch.fly(&particle, None, waves);
                } else {
                    let hit = hit(self.tables, &flock.rays, &flock.hits, i);
                    catch.fly(&particle, Some(hit.distance_squared.sqrt()), waves);
                    let next = self.arrive(particle, &hit, waves, catch);
                    flock.flying.extend(next);
                }
            }
            flock.arriving = arriving;
            catch.settle(wavelengths);
        }
    }

    /// Finds what those that fly will arrive at.
    fn look(&self, flock: &mut Flock) {
        flock.rays.clear();
        for particle in &flock.flying {
            let (origin, direction) = (particle.origin, particle.direction);
            flock.rays.push(origin, direction, f32::INFINITY);
        }
        flock.traced += flock.flying.len() as u64;
        let surfaces = self.tables.scene.surfaces();
        surfaces.closest(&flock.rays, &mut flock.hits, self.set);
        std::mem::swap(&mut flock.flying, &mut flock.arriving);
    }

    /// The path as it goes on.
    fn arrive(
        &self,
        mut particle: Particle,
        hit: &Hit,
        waves: &Wavelengths,
        catch: &mut impl Catch,
    ) -> Option<Particle> {
        let tables = self.tables;
        let side = &tables.sides[hit.side as usize];
        particle.travel(tables, hit.distance_squared.sqrt(), waves);
        catch.arrive(&particle, hit, waves);
        if side.opacity != OPAQUE {
            let opacity = tables.opacity(side, || tables.site(hit));
            if opacity.is_some_and(|opacity| self.number_for(&particle, hit) >= opacity) {
                return Some(particle.passed(hit));
            }
        }
        match side.model {
            Model::Black => None,
            Model::Pane => self.arrive_at_pane(particle, hit, waves, catch),
            Model::Lambertian | Model::Mirror | Model::Any => {
                self.scatter(particle, &Arrival::new(tables, hit, waves), catch)
            }
        }
    }

    /// Goes straight through a pane or is reflected, in proportion to the flux that each leaves.
    fn arrive_at_pane(
        &self,
        particle: Particle,
        hit: &Hit,
        waves: &Wavelengths,
        catch: &mut impl Catch,
    ) -> Option<Particle> {
        let side = &self.tables.sides[hit.side as usize];
        let [reflected, passed] = self.tables.pane(side, hit, waves);
        let lanes = || particle.throughput.iter().take(self.tables.lanes);
        let all: f32 = lanes().sum();
        if all == 0.0 {
            return None;
        }
        let parts = lanes().zip(passed);
        let share = parts.map(|(part, passed)| part * passed).sum::<f32>() / all;
        let is_aim = self.is_first_aim(&particle, hit);
        // What is left of the number that decided whether the surface is there.
        let opacity = self.tables.opacity(side, || self.tables.site(hit));
        if self.number_for(&particle, hit) / opacity.unwrap_or(1.0) < share {
            let departure = arrival::straight(hit, passed.map(|lane| lane / share));
            if is_aim && particle.events + 2 <= self.max_depth {
                catch.leave(&particle, hit, &departure);
            }
            return Some(particle.weighed(departure.weight).passed(hit));
        }
        let weight = reflected.map(|lane| lane / (1.0 - share));
        is_aim.then(|| self.leave(particle, hit, &arrival::mirrored(hit, weight), catch))?
    }

    /// Tells what a surface scatters, and sends the path on.
    fn scatter(
        &self,
        mut particle: Particle,
        arrival: &Arrival<'_>,
        catch: &mut impl Catch,
    ) -> Option<Particle> {
        let hit = arrival.hit;
        if !self.is_first_aim(&particle, hit) {
            return None;
        }
        particle.enter(self.tables, arrival.medium_before(), arrival.wavelengths);
        let (_, key, index) = particle.identity;
        let [a, b, c, d] = block::sample(key, index, particle.events + 1);
        if particle.events > 0 && particle.events + 2 <= self.max_depth {
            catch.scatter(&particle, arrival, [c, d]);
        }
        let departure = arrival.scatter([a, b])?;
        let is_own = particle.events > 0 || departure.is_specular;
        is_own.then(|| self.leave(particle, hit, &departure, catch))?
    }

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

    /// Leaves a surface, or ends: by roulette, or where too many segments would lead to the sensor.
    fn leave(
        &self,
        particle: Particle,
        hit: &Hit,
        departure: &Departure,
        catch: &mut impl Catch,
    ) -> Option<Particle> {
        let left = particle.events.saturating_add(2);
        if left > self.max_depth {
            return None;
        }
        catch.leave(&particle, hit, departure);
        if left.saturating_add(catch.segments(particle.identity.0)) > self.max_depth {
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
}
