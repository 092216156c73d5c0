//! Reflected directions: how paths leave their vertices.
//!
//! The loop over Lambertian vertices runs over columns and is vectorised; a path that roulette ends keeps its row, with
//! an invalid ray and no throughput, until the next hits are collected.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;
use steradian_kernel::Work;

use super::columns::{Flight, Flights, Identity, Vertices, Workspace};
use super::path::Tracer;
use super::scattering;
use crate::sampling::{block, hash, warp};
use crate::spectrum::MAX_LANES;

/// Sends every path on, or ends it by roulette; `segment` is the number of segments so far.
pub(super) fn reflect(tracer: &Tracer, workspace: &mut Workspace, segment: u32) {
    fill(
        tracer,
        &workspace.vertices.identity,
        segment,
        &mut workspace.uniforms,
    );
    leave_diffusely(tracer, workspace, Some(segment));
    leave_mirrors(workspace, segment);
    scattering::scatter(tracer, workspace, segment);
}

/// Sends a path out of every vertex with density cosθ/π; without `roulette` (a segment number) all of them survive.
pub(super) fn leave_diffusely(tracer: &Tracer, workspace: &mut Workspace, roulette: Option<u32>) {
    let (vertices, flights) = (&mut workspace.vertices, &mut workspace.flights);
    let mut identity = std::mem::take(&mut vertices.identity);
    let [u, v, ..] = &workspace.uniforms;
    let (u, v) = (&u[..identity.len()], &v[..identity.len()]);
    flights.prepare(identity.len());
    tracer.set.run(LeaveDiffusely {
        vertices,
        identity: &identity,
        u,
        v,
        roulette,
        flights,
    });
    flights.inherit(&mut identity, &mut workspace.uniforms);
    vertices.identity = identity;
    vertices.identity.clear();
}

/// Fills the four columns with one block of random numbers.
pub(super) fn fill(tracer: &Tracer, identity: &Identity, block: u32, uniforms: &mut [Vec<f32>; 4]) {
    let count = identity.len();
    for column in uniforms.iter_mut() {
        column.resize(count, 0.0);
    }
    let [a, b, c, d] = uniforms;
    let out = [
        &mut a[..count],
        &mut b[..count],
        &mut c[..count],
        &mut d[..count],
    ];
    tracer.set.run(block::FillBlock {
        keys: &identity.key,
        indices: &identity.index,
        block,
        out,
    });
}

/// Directions of density cosθ/π: throughput × ρ, whatever the direction.
struct LeaveDiffusely<'a> {
    vertices: &'a Vertices,
    identity: &'a Identity,
    u: &'a [f32],
    v: &'a [f32],
    roulette: Option<u32>,
    flights: &'a mut Flights,
}

impl Work for LeaveDiffusely<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let survival = self.survival();
        self.leave(&survival);
    }
}

impl LeaveDiffusely<'_> {
    /// 1/q of the survivors, 0 of the others.
    #[inline(always)]
    fn survival(&self) -> [f32; super::columns::BATCH] {
        let mut survival = [1.0; super::columns::BATCH];
        let Some(segment) = self.roulette else {
            return survival;
        };
        let n = self.u.len();
        let [a, b, c, d] = self.vertices.response.each_ref().map(|lane| &lane[..n]);
        let (keys, indices) = (&self.identity.key[..n], &self.identity.index[..n]);
        for i in 0..n {
            let greatest = a[i].max(b[i]).max(c[i].max(d[i])) * PI;
            let q = survival_probability(greatest, segment);
            let survives = roulette_number(keys[i], indices[i], segment) < q;
            survival[i] = if survives { 1.0 / q } else { 0.0 };
        }
        survival
    }

    #[inline(always)]
    fn leave(self, survival: &[f32]) {
        let n = self.u.len();
        let vertices = self.vertices;
        let survival = &survival[..n];
        for (lane, out) in self.flights.throughput.iter_mut().enumerate() {
            let (response, out) = (&vertices.response[lane][..n], &mut out[..n]);
            for i in 0..n {
                out[i] = response[i] * PI * survival[i];
            }
        }
        let (u, v) = (self.u, &self.v[..n]);
        let (px, py, pz) = (&vertices.x[..n], &vertices.y[..n], &vertices.z[..n]);
        let (nx, ny, nz) = (
            &vertices.normal_x[..n],
            &vertices.normal_y[..n],
            &vertices.normal_z[..n],
        );
        let clearance = &vertices.clearance[..n];
        let rays = &mut self.flights.rays;
        let (ox, oy, oz) = (
            &mut rays.origin_x[..n],
            &mut rays.origin_y[..n],
            &mut rays.origin_z[..n],
        );
        let (dx, dy, dz) = (
            &mut rays.direction_x[..n],
            &mut rays.direction_y[..n],
            &mut rays.direction_z[..n],
        );
        let (t_max, pdf) = (&mut rays.t_max[..n], &mut self.flights.pdf[..n]);
        for i in 0..n {
            let local = warp::cosine_hemisphere(u[i], v[i]);
            let direction = to_world([nx[i], ny[i], nz[i]], local);
            let alive = if survival[i] > 0.0 { 1.0 } else { 0.0 };
            (ox[i], oy[i], oz[i]) = (
                px[i] + nx[i] * clearance[i],
                py[i] + ny[i] * clearance[i],
                pz[i] + nz[i] * clearance[i],
            );
            (dx[i], dy[i], dz[i]) = (
                direction[0] * alive,
                direction[1] * alive,
                direction[2] * alive,
            );
            t_max[i] = f32::INFINITY;
            pdf[i] = local[2] * FRAC_1_PI;
        }
    }
}

fn leave_mirrors(workspace: &mut Workspace, segment: u32) {
    let (mirrors, flights) = (&workspace.mirrors, &mut workspace.flights);
    for i in 0..mirrors.len() {
        let response: [f32; MAX_LANES] = std::array::from_fn(|lane| mirrors.response[lane][i]);
        let identity = (
            mirrors.identity.slot[i],
            mirrors.identity.key[i],
            mirrors.identity.index[i],
        );
        let greatest = response
            .iter()
            .fold(0.0_f32, |greatest, lane| greatest.max(*lane));
        let Some(q) = survives(greatest, identity, segment) else {
            continue;
        };
        let place = mirrors.place(i);
        let viewer = Vec3::from_array(workspace.viewer.each_ref().map(|column| column[i]));
        let normal = Vec3::from_array(place.normal);
        let direction = (2.0 * normal.dot(viewer) * normal - viewer)
            .normalize()
            .into();
        let (throughput, light) = (
            response.map(|lane| lane / q),
            [mirrors.light_u[i], mirrors.light_v[i]],
        );
        flights.push(Flight {
            origin: place.cleared(),
            direction,
            throughput,
            pdf: f32::INFINITY,
            identity,
            light,
        });
    }
}

/// Throughput below which roulette begins.
const ROULETTE_BELOW: f32 = 0.25;
/// Segments after which a path that loses nothing is ended too, or light between perfect mirrors would be followed for ever.
const ENDLESS: u32 = 4096;

/// q = min(1, throughput / ¼): a survivor's throughput is never above ¼ nor above what it was, so weights stay bounded, and
/// the first, brightest reflections are followed without the noise of roulette.
#[inline(always)]
fn survival_probability(throughput: f32, segment: u32) -> f32 {
    let most = if segment < ENDLESS { 1.0 } else { 0.99 };
    (throughput * (1.0 / ROULETTE_BELOW)).min(most)
}

/// The probability of survival of a path of this throughput, if it survives.
pub(super) fn survives(
    throughput: f32,
    (_, key, index): (u32, u64, u32),
    segment: u32,
) -> Option<f32> {
    let q = survival_probability(throughput, segment);
    (roulette_number(key, index, segment) < q).then_some(q)
}

/// A uniform number in [0, 1) that depends on the path and the segment only.
#[inline(always)]
fn roulette_number(key: u64, index: u32, segment: u32) -> f32 {
    number_at(key, index, segment)
}

/// A uniform number in [0, 1) that depends on the path and on this number of a place only.
#[inline(always)]
pub(super) fn number_at(key: u64, index: u32, segment: u32) -> f32 {
    let path = hash::mix_32((key as u32) ^ hash::mix_32((key >> 32) as u32 ^ index));
    let word = hash::mix_32(path ^ segment.wrapping_mul(0x9e37_79b9));
    (word >> 8) as i32 as f32 * (1.0 / (1 << 24) as f32)
}

/// A local direction in the frame of `normal` (Duff et al., *Building an orthonormal basis, revisited*, JCGT 2017).
#[inline(always)]
pub(super) fn to_world(normal: [f32; 3], local: [f32; 3]) -> [f32; 3] {
    let [tangent, bitangent] = tangents(normal);
    std::array::from_fn(|axis| {
        tangent[axis] * local[0] + bitangent[axis] * local[1] + normal[axis] * local[2]
    })
}

/// The first two axes of that frame.
#[inline(always)]
pub(super) fn tangents([x, y, z]: [f32; 3]) -> [[f32; 3]; 2] {
    let sign = 1.0_f32.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [
        [1.0 + sign * x * x * a, sign * b, -sign * x],
        [b, sign + y * y * a, -y],
    ]
}
