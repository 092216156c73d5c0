//! Reflected directions: how paths leave their vertices.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;

use super::columns::{Identity, Place, Workspace};
use super::path::Tracer;
use crate::sampling::{block, hash, warp};

/// Sends every path on, or ends it by roulette; `segment` is the number of segments so far.
pub(super) fn reflect(tracer: &Tracer, workspace: &mut Workspace, segment: u32) {
    draw(tracer, workspace, segment);
    lambertian(workspace, segment);
    mirror(workspace, segment);
}

/// Block `segment` of random numbers: two for the direction, two for the light at the next vertex.
fn draw(tracer: &Tracer, workspace: &mut Workspace, segment: u32) {
    fill(
        tracer,
        &workspace.vertices.identity,
        segment,
        &mut workspace.uniforms,
    );
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
fn lambertian(workspace: &mut Workspace, segment: u32) {
    let (vertices, flights) = (&workspace.vertices, &mut workspace.flights);
    for i in 0..vertices.len() {
        let response: [f32; 4] = std::array::from_fn(|lane| vertices.response[lane][i] * PI);
        let Some(throughput) = survive(response, &vertices.identity, i, segment) else {
            continue;
        };
        let place = vertices.place(i);
        let local = warp::cosine_hemisphere(workspace.uniforms[0][i], workspace.uniforms[1][i]);
        let direction = to_world(place.normal, local);
        leave(
            flights,
            place,
            direction,
            throughput,
            local[2] * FRAC_1_PI,
            &vertices.identity,
            i,
        );
        flights.light_u.push(workspace.uniforms[2][i]);
        flights.light_v.push(workspace.uniforms[3][i]);
    }
}

fn mirror(workspace: &mut Workspace, segment: u32) {
    let (mirrors, flights) = (&workspace.mirrors, &mut workspace.flights);
    for i in 0..mirrors.len() {
        let response = std::array::from_fn(|lane| mirrors.response[lane][i]);
        let Some(throughput) = survive(response, &mirrors.identity, i, segment) else {
            continue;
        };
        let place = mirrors.place(i);
        let viewer = Vec3::from_array(workspace.viewer.each_ref().map(|column| column[i]));
        let normal = Vec3::from_array(place.normal);
        let direction = (2.0 * normal.dot(viewer) * normal - viewer).normalize();
        leave(
            flights,
            place,
            direction.into(),
            throughput,
            f32::INFINITY,
            &mirrors.identity,
            i,
        );
        flights.light_u.push(mirrors.light_u[i]);
        flights.light_v.push(mirrors.light_v[i]);
    }
}

/// Adds a flight that leaves `place`.
#[inline(always)]
pub(super) fn leave(
    flights: &mut super::columns::Flights,
    place: Place,
    direction: [f32; 3],
    throughput: [f32; 4],
    pdf: f32,
    identity: &Identity,
    i: usize,
) {
    flights.rays.push(place.cleared(), direction, f32::INFINITY);
    flights
        .identity
        .push(identity.slot[i], identity.key[i], identity.index[i]);
    for (column, lane) in flights.throughput.iter_mut().zip(throughput) {
        column.push(lane);
    }
    flights.pdf.push(pdf);
}

/// Roulette: survives with q = min(1, greatest lane), throughput/q.
#[inline(always)]
fn survive(throughput: [f32; 4], identity: &Identity, i: usize, segment: u32) -> Option<[f32; 4]> {
    let q = throughput
        .iter()
        .fold(0.0_f32, |greatest, lane| greatest.max(*lane));
    if q >= 1.0 {
        return Some(throughput);
    }
    if roulette_number(identity.key[i], identity.index[i], segment) >= q {
        return None;
    }
    Some(throughput.map(|lane| lane / q))
}

/// A uniform number in [0, 1) that depends on the path and the segment only.
#[inline(always)]
fn roulette_number(key: u64, index: u32, segment: u32) -> f32 {
    let word = hash::mix_64(
        key ^ u64::from(index) << 32 ^ u64::from(segment).wrapping_mul(0x9e37_79b9_7f4a_7c15),
    );
    (word >> 40) as f32 * (1.0 / (1 << 24) as f32)
}

/// A local direction in the frame of `normal` (Duff et al., *Building an orthonormal basis, revisited*, JCGT 2017).
#[inline(always)]
pub(super) fn to_world(normal: [f32; 3], local: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = normal;
    let sign = 1.0_f32.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    let tangent = [1.0 + sign * x * x * a, sign * b, -sign * x];
    let bitangent = [b, sign + y * y * a, -y];
    std::array::from_fn(|axis| {
        tangent[axis] * local[0] + bitangent[axis] * local[1] + normal[axis] * local[2]
    })
}
