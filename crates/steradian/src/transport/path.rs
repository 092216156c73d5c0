//! The path estimator: the reflection integral applied again and again, for a batch of paths at a time.
//!
//! L(d_e) = L_emitted + ∫ ρ(d_e, d_i) L(p, −d_i) cosθ_i dω_i. At every surface the integral is estimated twice: by a
//! sample of the lights (next-event estimation) and by following one sampled direction, which may meet a light by
//! itself. Both estimates of the same light are combined by the power heuristic
//!
//! w_a = p_a² / (p_a² + p_b²)
//!
//! whose weighted contribution ρ·L·cosθ·w_a/p_a never exceeds ρ·L·cosθ/(2 p_b): the sample of a light is bounded by the
//! density of the surface's own sampling, and the other way round, so no weight is unbounded near a light.
//!
//! Lambertian surfaces and mirrors are columns of the batch; surfaces of any other model are asked vertex by vertex (see
//! [`scattering`](super::scattering)). Panes and surfaces that are not opaque let a part of the light pass straight: a path goes on
//! behind them with the probability of that part, as rays to lights do with its weight, and is at no vertex there.
//!
//! A path ends by roulette with survival probability q = min(1, 4 × greatest lane of its throughput): the first
//! reflections are followed without its noise, and the throughput of a survivor is never raised above ¼, so that weights
//! stay bounded at any reflectance; without roulette only `max_depth` ends a path.
//!
//! Sources: J. Kajiya, *The rendering equation* (SIGGRAPH 1986); E. Veach, *Robust Monte Carlo methods for light
//! transport simulation* (1997), eq. 9.13 (power heuristic) and §10.4.1 (roulette).

use glam::Vec3;
use steradian_kernel::{InstructionSet, MISS};

use super::aim::is_aimed_at;
use super::appearance::site_towards;
use super::columns::{BATCH, Flights, Luggage, Place, Vertices, Workspace};
use super::interaction::{Hit, hit};
use super::light_tree::Receiving;
use super::media::AIR;
use super::next_event::NextEvent;
use super::patterned::Patterned;
use super::plain::ArrivePlainly;
use super::profile::Stage;
use super::roster::Roster;
use super::scatter;
use super::scattering::Encounter;
use super::tables::{
    Candidates, Everywhere, Lanes4, Model, NO_EMITTER, OPAQUE, Receiver, Side, Tables,
};
use crate::material::Site;
use crate::sampling::hash;
use crate::spectrum::Wavelengths;

/// Traces batches of paths through a scene.
pub(super) struct Tracer<'a> {
    pub tables: &'a Tables<'a>,
    pub set: InstructionSet,
    /// Longest path in segments.
    pub max_depth: u32,
    /// All groups gather in the first columns (pictures).
    pub merge_groups: bool,
}

impl Tracer<'_> {
    /// Number of gathered columns.
    pub fn columns(&self) -> usize {
        let groups = if self.merge_groups {
            1
        } else {
            self.tables.scene.groups().len()
        };
        groups * self.tables.lanes
    }

    /// Empties what `slots` paths gathered.
    pub fn begin(&self, workspace: &mut Workspace, slots: usize) {
        debug_assert!(slots <= BATCH);
        workspace.gathered.clear();
        workspace.gathered.resize(self.columns() * BATCH, 0.0);
        workspace.rosters.reset(slots);
        workspace.wavelengths.clear();
        workspace.wavelengths.resize(slots, Wavelengths::default());
        workspace.receiving.clear();
        workspace.receiving.resize(slots, Receiving::default());
        workspace.luggage.clear();
        workspace.luggage.resize(slots, Luggage::NONE);
        workspace.flights.clear();
        workspace.passing.clear();
        workspace.vertices.clear();
        workspace.mirrors.clear();
        workspace.encounters.clear();
    }

    /// Follows the flights until every path has ended.
    ///
    /// `segments` have been travelled before; `candidates` are the emitters that were sampled where the flights begin.
    pub fn follow(&self, workspace: &mut Workspace, segments: u32, mut candidates: Candidates) {
        for segment in segments.saturating_add(1)..=self.max_depth {
            if workspace.flights.len() == 0 {
                return;
            }
            self.advance(workspace, candidates);
            if segment == self.max_depth {
                return;
            }
            self.reflect(workspace, segment);
            candidates = self.tables.for_surfaces();
        }
    }

    /// Takes every flight to the surface that it meets.
    pub fn advance(&self, workspace: &mut Workspace, candidates: Candidates) {
        workspace.vertices.clear();
        workspace.mirrors.clear();
        workspace.encounters.clear();
        workspace.viewer.iter_mut().for_each(Vec::clear);
        self.arrive_at_hits(workspace, candidates);
        self.pass_on(workspace, candidates);
    }

    fn arrive_at_hits(&self, workspace: &mut Workspace, candidates: Candidates) {
        workspace.watch.times.rays += workspace.flights.len() as u64;
        let surfaces = self.tables.scene.surfaces();
        surfaces.closest(&workspace.flights.rays, &mut workspace.hits, self.set);
        workspace.watch.lap(Stage::Closest);
        self.arrive(workspace, candidates);
        workspace.watch.lap(Stage::Arrive);
    }

    /// Samples the lights at the vertices and sends the paths on; `segment` is the number of segments so far.
    pub fn reflect(&self, workspace: &mut Workspace, segment: u32) {
        let candidates = self.tables.for_surfaces();
        NextEvent {
            tracer: self,
            candidates,
            still: false,
        }
        .gather(workspace);
        scatter::reflect(self, workspace, segment);
        workspace.watch.lap(Stage::Scatter);
    }

    /// Adds emission found at the hits and collects the vertices that reflect.
    fn arrive(&self, workspace: &mut Workspace, candidates: Candidates) {
        let tables = self.tables;
        if !tables.media.is_empty() {
            attenuate(tables, workspace);
        }
        workspace.patterned.clear();
        let mut others = std::mem::take(&mut workspace.others);
        let primitives = &workspace.hits.primitive[..workspace.flights.len()];
        tables
            .plain
            .part(primitives, &mut workspace.plain, &mut others);
        for i in others.iter().map(|&row| row as usize) {
            let slot = workspace.flights.identity.slot[i];
            let wavelengths = &workspace.wavelengths[slot as usize];
            if workspace.hits.primitive[i] == MISS {
                let (flights, gathered) = (&workspace.flights, &mut workspace.gathered);
                let place = (candidates, &workspace.receiving[slot as usize]);
                self.escape((flights, i), wavelengths, place, gathered);
                continue;
            }
            let hit = self.met(workspace, i);
            let side = &tables.sides[hit.side as usize];
            if side.emits {
                let weight = self.emission_weight(
                    side,
                    &hit,
                    workspace.flights.pdf[i],
                    (candidates, &workspace.receiving[slot as usize]),
                    workspace.rosters.of(slot),
                ) * tables.factor_of(side, hit.viewer);
                let radiance = tables.lanes_at(&side.radiance, wavelengths, || tables.site(&hit));
                self.add(&mut workspace.gathered, side.group, slot, |lane| {
                    workspace.flights.throughput[lane][i] * radiance[lane] * weight
                });
            }
            if side.opacity != OPAQUE && self.passes(&workspace.flights, i, side, &hit) {
                workspace.let_pass(i, &hit);
                continue;
            }
            match side.model {
                Model::Black => continue,
                Model::Pane | Model::Any => {
                    self.arrive_at_any(workspace, i);
                    continue;
                }
                Model::Lambertian if tables.has_textures(&side.reflectance) => {
                    self.find_texture(workspace, i, &hit);
                    continue;
                }
                Model::Lambertian | Model::Mirror => {}
            }
            let reflectance = tables.lanes_at(&side.reflectance, wavelengths, || tables.site(&hit));
            let flights = &workspace.flights;
            if side.model == Model::Lambertian {
                let factor = std::f32::consts::FRAC_1_PI;
                let vertices = &mut workspace.vertices;
                push(vertices, flights, i, hit.place, &reflectance, factor);
            } else {
                workspace.mirrored(i, &hit, &reflectance);
            }
        }
        workspace.others = others;
        self.arrive_at_patterned(workspace);
        self.set.run(ArrivePlainly {
            table: &tables.plain,
            triangles: tables.scene.surfaces().triangles(),
            flights: &workspace.flights,
            hits: &workspace.hits,
            rows: &workspace.plain,
            vertices: &mut workspace.vertices,
        });
    }

    /// What flight `i` met, seen from where it left its last vertex.
    #[inline(always)]
    fn met(&self, workspace: &Workspace, i: usize) -> Hit {
        let flights = &workspace.flights;
        let mut hit = hit(self.tables, &flights.rays, &workspace.hits, i);
        if flights.travelled[i] > 0.0 {
            hit.set_back(flights.travelled[i]);
        }
        hit
    }

    /// Collects a vertex of any other model. It finds its hit by itself, so that those of diffuse surfaces need not leave the
    /// registers.
    #[inline(never)]
    fn arrive_at_any(&self, workspace: &mut Workspace, i: usize) {
        let hit = self.met(workspace, i);
        if self.tables.sides[hit.side as usize].model == Model::Pane {
            self.arrive_at_pane(workspace, i, &hit);
            return;
        }
        let site = self.tables.site(&hit);
        let side = &self.tables.sides[hit.side as usize];
        self.tables.fetch_ahead(side, &site);
        let encounter = Encounter::of_flight(&workspace.flights, i, &hit, site);
        workspace.encounters.push(encounter);
    }

    /// Asks for what a diffuse surface with textures shows.
    #[inline(never)]
    fn find_texture(&self, workspace: &mut Workspace, i: usize, hit: &Hit) {
        let site = self.tables.site(hit);
        let side = &self.tables.sides[hit.side as usize];
        self.tables.fetch_ahead(side, &site);
        workspace.patterned.push(Patterned {
            row: i as u32,
            side: hit.side,
            place: hit.place,
            site,
        });
    }

    /// Lets a path go straight through a pane or reflects it, in proportion to the light that each leaves to it: its
    /// greatest lane grows at most to the sum of all.
    fn arrive_at_pane(&self, workspace: &mut Workspace, i: usize, hit: &Hit) {
        let flights = &mut workspace.flights;
        let wavelengths = &workspace.wavelengths[flights.identity.slot[i] as usize];
        let side = &self.tables.sides[hit.side as usize];
        let [reflected, passed] = self.tables.pane(side, hit, wavelengths);
        let lanes = || (0..self.tables.lanes).map(|lane| (lane, flights.throughput[lane][i]));
        let all: f32 = lanes().map(|(_, part)| part).sum();
        let left: f32 = lanes().map(|(lane, part)| part * passed[lane]).sum();
        let share = left / all;
        if all == 0.0 {
            return;
        }
        // What is left of the number that decided whether the surface is there.
        let opacity = self.tables.opacity(side, || self.tables.site(hit));
        if self.number_for(flights, i, hit) / opacity.unwrap_or(1.0) < share {
            for (lane, column) in flights.throughput.iter_mut().enumerate() {
                column[i] *= passed[lane] / share;
            }
            workspace.let_pass(i, hit);
        } else {
            let reflected = reflected.map(|lane| lane / (1.0 - share));
            workspace.mirrored(i, hit, &reflected);
        }
    }

    /// Follows the flights that surfaces let pass until they meet one that does not.
    fn pass_on(&self, workspace: &mut Workspace, candidates: Candidates) {
        while workspace.passing.len() > 0 {
            std::mem::swap(&mut workspace.flights, &mut workspace.passing);
            workspace.passing.clear();
            self.arrive_at_hits(workspace, candidates);
        }
    }

    /// Whether a path goes through a side, with probability 1 − α.
    #[inline(always)]
    fn passes(&self, flights: &Flights, i: usize, side: &Side, hit: &Hit) -> bool {
        let opacity = self.tables.opacity(side, || self.tables.site(hit));
        opacity.is_some_and(|opacity| self.number_for(flights, i, hit) >= opacity)
    }

    /// A uniform number for this meeting of a path and a surface.
    #[inline(always)]
    fn number_for(&self, flights: &Flights, i: usize, hit: &Hit) -> f32 {
        let (_, key, index) = flights.identity.at(i);
        // The numbers for the next light differ from segment to segment.
        let segment = flights.travelled[i].to_bits() ^ hash::mix_32(flights.light_u[i].to_bits());
        let place = hash::mix_32(hit.primitive ^ hash::mix_32(segment));
        scatter::number_at(key, index, place)
    }

    /// Adds what comes from everywhere to a path that met nothing.
    fn escape(
        &self,
        (flights, i): (&Flights, usize),
        wavelengths: &Wavelengths,
        place: (Candidates, &Receiving),
        gathered: &mut [f32],
    ) {
        for everywhere in &self.tables.environment {
            let ray = flights.rays.ray(i);
            let map = everywhere.map.as_ref();
            let site = map.map_or(Site::NOWHERE, |map| site_towards(map, ray.direction));
            let weight = self.everywhere_weight(everywhere, (flights, i), place);
            let radiance = &everywhere.radiance;
            let radiance = self.tables.lanes_at(radiance, wavelengths, || site);
            let slot = flights.identity.slot[i];
            self.add(gathered, everywhere.group, slot, |lane| {
                flights.throughput[lane][i] * radiance[lane] * weight
            });
        }
    }

    /// Power-heuristic weight of light from everywhere that flight `i` met.
    fn everywhere_weight(
        &self,
        everywhere: &Everywhere,
        (flights, i): (&Flights, usize),
        (candidates, at): (Candidates, &Receiving),
    ) -> f32 {
        let ray = flights.rays.ray(i);
        let direction = Vec3::from_array(ray.direction);
        let from = Vec3::from_array(ray.origin) - direction * flights.travelled[i];
        let way = (from, direction);
        let tables = self.tables;
        let is_meter = candidates.receiver != Receiver::Surface;
        if is_meter && everywhere.portals_on(tables, way).next().is_some() {
            return 0.0;
        }
        // A direction along the surface has no density either.
        match tables.density_of_everywhere(everywhere, way, candidates, || *at) {
            0.0 => 1.0,
            density => {
                let ratio = density / flights.pdf[i];
                1.0 / (1.0 + ratio * ratio)
            }
        }
    }

    /// Power-heuristic weight of emission that a sampled direction met.
    ///
    /// It is 0 of light that the `roster` knows at the meter where the path started, or that was gathered there by aiming at it.
    fn emission_weight(
        &self,
        side: &Side,
        hit: &Hit,
        pdf: f32,
        (candidates, at): (Candidates, &Receiving),
        roster: &Roster,
    ) -> f32 {
        if side.emitter == NO_EMITTER {
            return 1.0;
        }
        if candidates.receiver != Receiver::Surface
            && (roster.knows(side.emitter as usize)
                || is_aimed_at(
                    self.tables,
                    &self.tables.emitters[side.emitter as usize],
                    hit.origin,
                ))
        {
            return 0.0;
        }
        let ratio = NextEvent::density(self.tables, side.emitter, hit, (candidates, at)) / pdf;
        1.0 / (1.0 + ratio * ratio)
    }

    /// Adds light of a group to a path.
    #[inline(always)]
    pub fn add(&self, gathered: &mut [f32], group: u32, slot: u32, value: impl Fn(usize) -> f32) {
        let columns = self.columns_of(gathered, group).chunks_mut(BATCH);
        for (lane, column) in columns.enumerate() {
            column[slot as usize] += value(lane);
        }
    }

    /// Where light of a group is gathered, lane by lane.
    #[inline(always)]
    pub fn columns_of<'a>(&self, gathered: &'a mut [f32], group: u32) -> &'a mut [f32] {
        let group = if self.merge_groups { 0 } else { group as usize };
        let lanes = self.tables.lanes * BATCH;
        &mut gathered[group * lanes..(group + 1) * lanes]
    }
}

impl Workspace {
    /// Collects a mirror of this reflectance, which flight `i` met.
    #[inline(always)]
    fn mirrored(&mut self, i: usize, hit: &Hit, reflectance: &Lanes4) {
        let (mirrors, flights) = (&mut self.mirrors, &self.flights);
        push(mirrors, flights, i, hit.place, reflectance, 1.0);
        for (column, axis) in self.viewer.iter_mut().zip(hit.viewer) {
            column.push(axis);
        }
    }
}

/// Takes from every flight what the medium on its way absorbs.
fn attenuate(tables: &Tables<'_>, workspace: &mut Workspace) {
    let flights = &mut workspace.flights;
    for i in 0..flights.len() {
        let slot = flights.identity.slot[i] as usize;
        let medium = workspace.luggage[slot].medium;
        if medium == AIR {
            continue;
        }
        let way = match workspace.hits.primitive[i] {
            MISS => f32::INFINITY,
            _ => workspace.hits.t[i],
        };
        let part = tables.attenuation(medium, way, &workspace.wavelengths[slot]);
        for (lane, column) in flights.throughput.iter_mut().enumerate() {
            column[i] *= part[lane];
        }
    }
}

/// Collects a diffuse vertex or a mirror of flight `i`.
#[inline(always)]
pub(super) fn push(
    vertices: &mut Vertices,
    flights: &Flights,
    i: usize,
    place: Place,
    reflectance: &Lanes4,
    factor: f32,
) {
    let response =
        std::array::from_fn(|lane| flights.throughput[lane][i] * reflectance[lane] * factor);
    let identity = (
        flights.identity.slot[i],
        flights.identity.key[i],
        flights.identity.index[i],
    );
    vertices.push(
        place,
        response,
        identity,
        [flights.light_u[i], flights.light_v[i]],
    );
}

#[cfg(test)]
mod tests;
