//! Columns of a batch of paths: structures of arrays, so that loops run over paths.

use glam::Vec3;
use steradian_kernel::{HitBatch, RayBatch};

use super::branching::Stem;
use super::interaction::Hit;
use super::kept_aims::KeptAims;
use super::light_tree::Receiving;
use super::media::AIR;
use super::patterned::Patterned;
use super::profile::StopWatch;
use super::roster::RosterColumn;
use super::scattering::{Encounter, Metals};
use super::tables::{Emitter, EmitterShape, Tables};
use super::transmittance::Transmittance;
use crate::material::Site;
use crate::spectrum::{MAX_LANES, Wavelengths};

/// Paths traced together.
pub(super) const BATCH: usize = 1024;

/// Which stream and sample a path draws its random numbers from, and where its light is added.
#[derive(Default)]
pub(super) struct Identity {
    pub slot: Vec<u32>,
    pub key: Vec<u64>,
    pub index: Vec<u32>,
}

impl Identity {
    pub fn clear(&mut self) {
        self.slot.clear();
        self.key.clear();
        self.index.clear();
    }

    pub fn push(&mut self, slot: u32, key: u64, index: u32) {
        self.slot.push(slot);
        self.key.push(key);
        self.index.push(index);
    }

    pub fn copy_from(&mut self, other: &Self) {
        self.slot.clone_from(&other.slot);
        self.key.clone_from(&other.key);
        self.index.clone_from(&other.index);
    }

    pub fn len(&self) -> usize {
        self.slot.len()
    }

    /// Slot, key and index of a row.
    pub fn at(&self, i: usize) -> (u32, u64, u32) {
        (self.slot[i], self.key[i], self.index[i])
    }
}

/// Paths on their way to the next surface.
#[derive(Default)]
pub(super) struct Flights {
    pub rays: RayBatch,
    pub identity: Identity,
    pub throughput: [Vec<f32>; MAX_LANES],
    /// Density of the direction in 1/sr; infinite where no light sampling competes.
    pub pdf: Vec<f32>,
    /// Numbers that the next vertex samples a light with.
    pub light_u: Vec<f32>,
    pub light_v: Vec<f32>,
    /// Metres since the path left its last vertex, through surfaces that let it pass.
    pub travelled: Vec<f32>,
}

impl Flights {
    pub fn clear(&mut self) {
        self.rays.clear();
        self.identity.clear();
        self.throughput.iter_mut().for_each(Vec::clear);
        for column in [
            &mut self.pdf,
            &mut self.light_u,
            &mut self.light_v,
            &mut self.travelled,
        ] {
            column.clear();
        }
    }

    pub fn len(&self) -> usize {
        self.identity.len()
    }

    /// Adds a flight.
    pub fn push(&mut self, flight: Flight) {
        self.rays
            .push(flight.origin, flight.direction, f32::INFINITY);
        self.identity
            .push(flight.identity.0, flight.identity.1, flight.identity.2);
        for (column, lane) in self.throughput.iter_mut().zip(flight.throughput) {
            column.push(lane);
        }
        self.pdf.push(flight.pdf);
        self.light_u.push(flight.light[0]);
        self.light_v.push(flight.light[1]);
        self.travelled.push(0.0);
    }

    /// The flight of row `i` goes on from `origin` as if nothing were there, having travelled so far.
    pub fn pass_on(&mut self, from: &Self, i: usize, origin: [f32; 3], travelled: f32) {
        let rays = &from.rays;
        self.push(Flight {
            origin,
            direction: [
                rays.direction_x[i],
                rays.direction_y[i],
                rays.direction_z[i],
            ],
            throughput: from.throughput.each_ref().map(|lane| lane[i]),
            pdf: from.pdf[i],
            identity: from.identity.at(i),
            light: [from.light_u[i], from.light_v[i]],
        });
        if let Some(last) = self.travelled.last_mut() {
            *last = travelled;
        }
    }

    /// Room for `count` flights.
    pub fn prepare(&mut self, count: usize) {
        self.rays.resize(count);
        for column in self.throughput.iter_mut().chain([&mut self.pdf]) {
            column.resize(count, 0.0);
        }
        self.travelled.clear();
        self.travelled.resize(count, 0.0);
    }

    /// Takes over the identities of the vertices that are left, with new numbers for the next light.
    pub fn inherit(&mut self, identity: &mut Identity, uniforms: &mut [Vec<f32>; 4]) {
        std::mem::swap(&mut self.identity, identity);
        std::mem::swap(&mut self.light_u, &mut uniforms[2]);
        std::mem::swap(&mut self.light_v, &mut uniforms[3]);
    }
}

/// One flight.
pub(super) struct Flight {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    pub throughput: [f32; MAX_LANES],
    pub pdf: f32,
    /// Slot, key and index.
    pub identity: (u32, u64, u32),
    pub light: [f32; 2],
}

/// Paths at a surface or a meter, facing `normal`.
#[derive(Default)]
pub(super) struct Vertices {
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    pub z: Vec<f32>,
    pub normal_x: Vec<f32>,
    pub normal_y: Vec<f32>,
    pub normal_z: Vec<f32>,
    /// Distance along the normal that clears the surface.
    pub clearance: Vec<f32>,
    /// Throughput × ρ: radiance gained per unit of irradiance. For a mirror: throughput × reflectance.
    pub response: [Vec<f32>; MAX_LANES],
    pub identity: Identity,
    pub light_u: Vec<f32>,
    pub light_v: Vec<f32>,
}

impl Vertices {
    pub fn clear(&mut self) {
        self.columns_mut().into_iter().for_each(Vec::clear);
        self.identity.clear();
    }

    pub fn copy_from(&mut self, other: &Self) {
        for (to, from) in self.columns_mut().into_iter().zip(other.columns()) {
            to.clone_from(from);
        }
        self.identity.copy_from(&other.identity);
    }

    fn columns(&self) -> [&Vec<f32>; 9 + MAX_LANES] {
        let [a, b, c, d] = &self.response;
        [
            &self.x,
            &self.y,
            &self.z,
            &self.normal_x,
            &self.normal_y,
            &self.normal_z,
            &self.clearance,
            &self.light_u,
            &self.light_v,
            a,
            b,
            c,
            d,
        ]
    }

    fn columns_mut(&mut self) -> [&mut Vec<f32>; 9 + MAX_LANES] {
        let [a, b, c, d] = &mut self.response;
        [
            &mut self.x,
            &mut self.y,
            &mut self.z,
            &mut self.normal_x,
            &mut self.normal_y,
            &mut self.normal_z,
            &mut self.clearance,
            &mut self.light_u,
            &mut self.light_v,
            a,
            b,
            c,
            d,
        ]
    }

    pub fn len(&self) -> usize {
        self.identity.len()
    }

    pub fn push(
        &mut self,
        place: Place,
        response: [f32; MAX_LANES],
        identity: (u32, u64, u32),
        light: [f32; 2],
    ) {
        self.x.push(place.point[0]);
        self.y.push(place.point[1]);
        self.z.push(place.point[2]);
        self.normal_x.push(place.normal[0]);
        self.normal_y.push(place.normal[1]);
        self.normal_z.push(place.normal[2]);
        self.clearance.push(place.clearance);
        for (column, lane) in self.response.iter_mut().zip(response) {
            column.push(lane);
        }
        self.identity.push(identity.0, identity.1, identity.2);
        self.light_u.push(light[0]);
        self.light_v.push(light[1]);
    }

    /// Adds consecutive samples at one place, the first of this identity, without numbers for a light.
    pub fn repeat(
        &mut self,
        place: &Place,
        response: [f32; MAX_LANES],
        (slot, key, index): (u32, u64, u32),
        count: u32,
    ) {
        let length = self.len() + count as usize;
        let ([x, y, z], [nx, ny, nz], [a, b, c, d]) = (place.point, place.normal, response);
        let row = [x, y, z, nx, ny, nz, place.clearance, 0.0, 0.0, a, b, c, d];
        for (column, value) in self.columns_mut().into_iter().zip(row) {
            column.resize(length, value);
        }
        let identity = &mut self.identity;
        identity.slot.extend(slot..slot + count);
        identity.key.resize(length, key);
        identity.index.extend(index..index + count);
    }

    /// Room for more vertices.
    pub fn extend(&mut self, more: usize) -> Room<'_> {
        let (from, count) = (self.len(), self.len() + more);
        for column in self.columns_mut() {
            column.resize(count, 0.0);
        }
        let Identity { slot, key, index } = &mut self.identity;
        slot.resize(count, 0);
        key.resize(count, 0);
        index.resize(count, 0);
        Room {
            point: [&mut self.x, &mut self.y, &mut self.z]
                .map(|column| &mut column[from..][..more]),
            normal: [&mut self.normal_x, &mut self.normal_y, &mut self.normal_z]
                .map(|column| &mut column[from..][..more]),
            clearance: &mut self.clearance[from..][..more],
            response: self
                .response
                .each_mut()
                .map(|column| &mut column[from..][..more]),
            light: [&mut self.light_u, &mut self.light_v].map(|column| &mut column[from..][..more]),
            slot: &mut slot[from..][..more],
            key: &mut key[from..][..more],
            index: &mut index[from..][..more],
        }
    }

    pub fn place(&self, i: usize) -> Place {
        Place {
            point: [self.x[i], self.y[i], self.z[i]],
            normal: [self.normal_x[i], self.normal_y[i], self.normal_z[i]],
            clearance: self.clearance[i],
        }
    }
}

/// Columns of new vertices, to be filled.
pub(super) struct Room<'a> {
    pub point: [&'a mut [f32]; 3],
    pub normal: [&'a mut [f32]; 3],
    pub clearance: &'a mut [f32],
    pub response: [&'a mut [f32]; MAX_LANES],
    pub light: [&'a mut [f32]; 2],
    pub slot: &'a mut [u32],
    pub key: &'a mut [u64],
    pub index: &'a mut [u32],
}

/// A point of a surface, in kernel coordinates.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) struct Place {
    pub point: [f32; 3],
    pub normal: [f32; 3],
    pub clearance: f32,
}

impl Place {
    /// The point moved off its surface.
    #[inline(always)]
    pub fn cleared(&self) -> [f32; 3] {
        std::array::from_fn(|axis| self.point[axis] + self.normal[axis] * self.clearance)
    }

    /// Where rays in a direction start: off this side or the other.
    #[inline(always)]
    pub fn start(&self, direction: Vec3) -> Vec3 {
        match direction.dot(Vec3::from_array(self.normal)) < 0.0 {
            true => self.beyond().into(),
            false => self.cleared().into(),
        }
    }

    /// The point moved off the other side.
    #[inline(always)]
    pub fn beyond(&self) -> [f32; 3] {
        std::array::from_fn(|axis| self.point[axis] - self.normal[axis] * self.clearance)
    }
}

/// One light sample a vertex, and its shadow ray; a vertex without a sample has an invalid ray and no gain.
#[derive(Default)]
pub(super) struct Shadows {
    pub rays: RayBatch,
    /// Irradiance per unit of the emitter's power, weighted.
    pub gain: Vec<f32>,
    pub emitter: Vec<u32>,
    /// The numbers that the emitter was sampled with, where its emission has textures.
    pub numbers: Vec<[f32; 2]>,
    /// What part of the light gets along the shadow rays.
    pub transmittance: Transmittance,
}

impl Shadows {
    /// What the emitter's surface knows of the point that row `i` sampled.
    pub fn site(&self, tables: &Tables<'_>, emitter: &Emitter, i: usize) -> Site {
        let rays = &self.rays;
        if let EmitterShape::Portal(_) = emitter.shape {
            return tables.site_of_everywhere(emitter, rays.ray(i).direction);
        }
        let end = [
            rays.origin_x[i] + rays.direction_x[i],
            rays.origin_y[i] + rays.direction_y[i],
            rays.origin_z[i] + rays.direction_z[i],
        ];
        tables.site_of_sample(emitter, self.numbers[i], end)
    }

    /// Length of the shadow ray of row `i` in metres.
    pub fn way(&self, i: usize) -> f32 {
        let [x, y, z] = [
            self.rays.direction_x[i],
            self.rays.direction_y[i],
            self.rays.direction_z[i],
        ];
        (x * x + y * y + z * z).sqrt() * self.rays.t_max[i]
    }

    /// Adds a sample.
    pub fn push(&mut self, rays: ([f32; 3], [f32; 3], f32), gain: f32, emitter: u32, u: [f32; 2]) {
        self.rays.push(rays.0, rays.1, rays.2);
        self.gain.push(gain);
        self.emitter.push(emitter);
        self.numbers.push(u);
    }

    /// No samples.
    pub fn clear(&mut self) {
        self.rays.clear();
        self.gain.clear();
        self.emitter.clear();
        self.numbers.clear();
    }

    /// Room for one sample a vertex, all without gain.
    pub fn reset(&mut self, count: usize) {
        self.rays.clear();
        self.rays.resize(count);
        self.gain.clear();
        self.gain.resize(count, 0.0);
        self.emitter.resize(count, 0);
        self.numbers.resize(count, [0.0; 2]);
    }
}

/// What a path carries that no diffuse reflection changes.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) struct Luggage {
    /// The medium that it is in.
    pub medium: u32,
    /// By how much refraction has scaled its radiance against its power: the product of all (n_e/n_i)².
    pub scale: f32,
}

impl Luggage {
    /// Of a path that leaves a sensor.
    pub const NONE: Self = Self {
        medium: AIR,
        scale: 1.0,
    };
}

/// Scratch of one thread.
#[derive(Default)]
pub struct Workspace {
    pub(super) flights: Flights,
    /// Flights that a surface let pass.
    pub(super) passing: Flights,
    /// By slot; of no meaning unless the run is spectral.
    pub(super) wavelengths: Vec<Wavelengths>,
    /// What is known of lamps where paths start.
    pub(super) rosters: RosterColumn,
    /// By slot, where light was last gathered; of no meaning unless emitters are chosen by importance.
    pub(super) receiving: Vec<Receiving>,
    /// By slot.
    pub(super) luggage: Vec<Luggage>,
    pub(super) hits: HitBatch,
    /// Rows of the flights that met plain triangles.
    pub(super) plain: Vec<u32>,
    /// Rows of the others.
    pub(super) others: Vec<u32>,
    /// Those that met diffuse surfaces with textures.
    pub(super) patterned: Vec<Patterned>,
    pub(super) vertices: Vertices,
    pub(super) mirrors: Vertices,
    /// Direction towards the viewer at each of `mirrors`.
    pub(super) viewer: [Vec<f32>; 3],
    /// Paths at surfaces of all other models.
    pub(super) encounters: Vec<Encounter>,
    /// Those of them at rough metals.
    pub(super) metals: Metals,
    /// What each of `shadows` adds to, where they are those of `encounters`.
    pub(super) lit: Vertices,
    pub(super) shadows: Shadows,
    /// How meters aim at lamps.
    pub(super) aims: KeptAims,
    pub(super) uniforms: [Vec<f32>; 4],
    /// What the branches of camera rays begin with.
    pub(super) stem: Stem,
    /// Gathered light: column × slot.
    pub(super) gathered: Vec<f32>,
    pub(super) watch: StopWatch,
}

impl Workspace {
    /// Flight `i` goes on through the surface that it met.
    #[inline(always)]
    pub(super) fn let_pass(&mut self, i: usize, hit: &Hit) {
        let way = hit.distance_squared.sqrt();
        let beyond = hit.place.beyond();
        self.passing.pass_on(&self.flights, i, beyond, way);
    }
}
