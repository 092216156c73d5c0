//! Next-event estimation: light sampled directly, from surfaces and from meters alike.
//!
//! A vertex that responds with R per unit of irradiance gains R·E_n·cosθ·V, with E_n = I/r² of a light without extent and
//! L/p of an area light sampled with density p in solid angle. A point drawn by area has p = r²/(A cosθ_l); a sphere
//! seen from outside is drawn uniformly in its cone, p = 1/(2π(1 − cosθ_max)).
//!
//! An area light's sample carries the power-heuristic weight against the vertex's own density cosθ/π (1/4π for a
//! meter of scalar irradiance), which bounds it: see [`path`](super::path).

use std::f32::consts::{FRAC_1_PI, PI, TAU};

use glam::Vec3;

use super::columns::{Shadows, Vertices, Workspace};
use super::interaction::Hit;
use super::panel::{Panel, SamplePanel};
use super::path::Tracer;
use super::profile::Stage;
use super::tables::{Candidates, EmitterShape, Tables};
use super::towards::{cone, towards};

/// One pass over the vertices of a batch.
pub(super) struct NextEvent<'a> {
    pub tracer: &'a Tracer<'a>,
    /// The emitters to sample.
    pub candidates: Candidates,
    /// The receiver takes light from the whole sphere, not foreshortened.
    pub spherical: bool,
}

impl NextEvent<'_> {
    /// Samples one emitter at every vertex, with the light numbers that the vertices carry.
    pub fn gather(&self, workspace: &mut Workspace) {
        let count = workspace.vertices.len();
        if self.candidates.count == 0 || count == 0 {
            return;
        }
        workspace.shadows.reset(count);
        let (vertices, shadows) = (&workspace.vertices, &mut workspace.shadows);
        let numbers = [&vertices.light_u[..], &vertices.light_v[..]];
        if self.candidates.count == 1 {
            self.sample_all(0, vertices, numbers, shadows);
        } else {
            for i in 0..count {
                let (emitter, u) = choose(self.tracer.tables, self.candidates, numbers[0][i]);
                self.sample(i, emitter, [u, numbers[1][i]], vertices, shadows);
            }
        }
        self.settle(workspace);
    }

    /// Samples one given emitter at every vertex, with the last two columns of uniform numbers.
    pub fn gather_from(&self, workspace: &mut Workspace, emitter: usize) {
        workspace.shadows.reset(workspace.vertices.len());
        let numbers = [&workspace.uniforms[2][..], &workspace.uniforms[3][..]];
        self.sample_all(
            emitter,
            &workspace.vertices,
            numbers,
            &mut workspace.shadows,
        );
        self.settle(workspace);
    }

    fn sample_all(
        &self,
        number: usize,
        vertices: &Vertices,
        numbers: [&[f32]; 2],
        shadows: &mut Shadows,
    ) {
        let tables = self.tracer.tables;
        let emitter = &tables.emitters[number];
        if let (
            EmitterShape::Parallelogram {
                origin,
                edges,
                normal,
                area,
            },
            false,
            false,
        ) = (
            &emitter.shape,
            self.spherical,
            tables.has_textures(&emitter.power),
        ) {
            shadows.emitter.fill(number as u32);
            let (origin, edges, normal) = (*origin, *edges, *normal);
            let (area, two_sided, probability) = (
                *area,
                emitter.two_sided,
                tables.probability(self.candidates, number),
            );
            let panel = Panel {
                origin,
                edges,
                normal,
                area,
                two_sided,
                probability,
            };
            self.tracer.set.run(SamplePanel {
                panel,
                vertices,
                numbers,
                shadows,
            });
            return;
        }
        for i in 0..vertices.len() {
            self.sample(i, number, [numbers[0][i], numbers[1][i]], vertices, shadows);
        }
    }

    fn sample(
        &self,
        i: usize,
        number: usize,
        u: [f32; 2],
        vertices: &Vertices,
        shadows: &mut Shadows,
    ) {
        let emitter = &self.tracer.tables.emitters[number];
        let place = vertices.place(i);
        let Some(towards) = towards(self.tracer.tables, emitter, &place, u) else {
            return;
        };
        let cos_theta = towards.direction.dot(Vec3::from_array(place.normal));
        let (foreshortening, own_density) = if self.spherical {
            (1.0, 0.25 * FRAC_1_PI)
        } else {
            (cos_theta, cos_theta * FRAC_1_PI)
        };
        if foreshortening <= 0.0 {
            return;
        }
        let probability = self.tracer.tables.probability(self.candidates, number);
        let ratio = own_density / (towards.density * probability);
        shadows.gain[i] =
            foreshortening * towards.per_power / (probability * (1.0 + ratio * ratio));
        shadows.emitter[i] = number as u32;
        shadows.numbers[i] = u;
        let start = Vec3::from_array(if self.spherical {
            place.point
        } else {
            place.cleared()
        });
        let (span, reach) = if towards.infinite {
            (towards.direction, f32::INFINITY)
        } else {
            (towards.end - start, 1.0)
        };
        shadows.rays.set(i, start.into(), span.into(), reach);
    }

    /// Traces the shadow rays and adds what arrives.
    fn settle(&self, workspace: &mut Workspace) {
        workspace.watch.lap(Stage::Lights);
        let (shadows, vertices) = (&mut workspace.shadows, &workspace.vertices);
        let tables = self.tracer.tables;
        shadows
            .transmittance
            .trace(tables, &shadows.rays, self.tracer.set);
        for i in 0..vertices.len() {
            let gain = shadows.gain[i] * shadows.transmittance.of(i);
            if gain == 0.0 {
                continue;
            }
            let emitter = &tables.emitters[shadows.emitter[i] as usize];
            let (response, slot) = (&vertices.response, vertices.identity.slot[i]);
            let wavelengths = &workspace.wavelengths[slot as usize];
            let power = tables.lanes_at(&emitter.power, wavelengths, || {
                shadows.site(tables, emitter, i)
            });
            self.tracer
                .add(&mut workspace.gathered, emitter.group, slot, |lane| {
                    response[lane][i] * power[lane] * gain
                });
        }
        workspace.watch.lap(Stage::Shadows);
    }

    /// Density with which a hit on an emitter would have been sampled from the ray's origin.
    pub fn density(tables: &Tables, emitter: u32, hit: &Hit, candidates: Candidates) -> f32 {
        let probability = tables.probability(candidates, emitter as usize);
        let emitter = &tables.emitters[emitter as usize];
        let by_area = |area: f32| hit.distance_squared / (area * hit.cos_theta);
        probability
            * match &emitter.shape {
                EmitterShape::Parallelogram { area, .. }
                | EmitterShape::Triangles { area, .. }
                | EmitterShape::Disc { area, .. } => by_area(*area),
                EmitterShape::Sphere {
                    center,
                    radius,
                    ports,
                    ..
                } => {
                    let axis = Vec3::from_array(*center) - Vec3::from_array(hit.origin);
                    match cone(axis, *radius, ports.is_empty()) {
                        Some(one_minus_cos) => 1.0 / (TAU * one_minus_cos),
                        None => by_area(4.0 * PI * radius * radius),
                    }
                }
                EmitterShape::Point { .. }
                | EmitterShape::Spot { .. }
                | EmitterShape::Directional { .. } => 0.0,
            }
    }
}

/// An emitter by power, and the number that is left to use.
fn choose(tables: &Tables, candidates: Candidates, u: f32) -> (usize, f32) {
    let count = candidates.count;
    if count == 1 {
        return (0, u);
    }
    let u = u * tables.cumulative[count - 1];
    let index = tables
        .cumulative
        .partition_point(|sum| *sum <= u)
        .min(count - 1);
    let before = if index == 0 {
        0.0
    } else {
        tables.cumulative[index - 1]
    };
    let rest = (u - before) / tables.emitters[index].probability;
    (index, rest.clamp(0.0, 1.0 - 0.5 * f32::EPSILON))
}

#[cfg(test)]
mod tests;
