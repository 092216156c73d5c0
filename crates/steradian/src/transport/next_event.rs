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

use steradian_kernel::Work;

use super::columns::{Place, Shadows, Vertices, Workspace};
use super::interaction::Hit;
use super::path::Tracer;
use super::tables::{Candidates, Emitter, EmitterShape, Tables};
use crate::sampling::{sincos, warp};

/// One pass over the vertices of a batch.
pub(super) struct NextEvent<'a> {
    pub tracer: &'a Tracer<'a>,
    /// The emitters to sample.
    pub candidates: Candidates,
    /// The receiver takes light from the whole sphere, not foreshortened.
    pub spherical: bool,
}

/// A sampled direction towards an emitter.
struct Towards {
    /// Unit vector from the vertex.
    direction: Vec3,
    /// Where the shadow ray ends; the direction itself for light from infinitely far away.
    end: Vec3,
    infinite: bool,
    /// E_n per unit of the emitter's power.
    per_power: f32,
    /// Density in solid angle; infinite for a light without extent.
    density: f32,
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
        ) = (&emitter.shape, self.spherical)
        {
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
        let (shadows, vertices) = (&mut workspace.shadows, &workspace.vertices);
        let tables = self.tracer.tables;
        tables
            .scene
            .surfaces()
            .occluded(&shadows.rays, &mut shadows.occluded, self.tracer.set);
        for i in 0..vertices.len() {
            let gain = shadows.gain[i];
            if shadows.occluded[i] || gain == 0.0 {
                continue;
            }
            let emitter = &tables.emitters[shadows.emitter[i] as usize];
            let response = &vertices.response;
            self.tracer.add(
                &mut workspace.gathered,
                emitter.group,
                vertices.identity.slot[i],
                |lane| response[lane][i] * emitter.power[lane] * gain,
            );
        }
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

/// A parallelogram as the vectorised loop reads it.
#[derive(Copy, Clone)]
struct Panel {
    origin: [f32; 3],
    edges: [[f32; 3]; 2],
    normal: [f32; 3],
    area: f32,
    two_sided: bool,
    probability: f32,
}

/// Samples one panel at every vertex: the same numbers as [`NextEvent::sample`], over columns.
struct SamplePanel<'a> {
    panel: Panel,
    vertices: &'a Vertices,
    numbers: [&'a [f32]; 2],
    shadows: &'a mut Shadows,
}

impl Work for SamplePanel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (vertices, n) = (self.vertices, self.vertices.len());
        let [u, v] = self.numbers.map(|column| &column[..n]);
        let (px, py, pz) = (&vertices.x[..n], &vertices.y[..n], &vertices.z[..n]);
        let (nx, ny, nz) = (
            &vertices.normal_x[..n],
            &vertices.normal_y[..n],
            &vertices.normal_z[..n],
        );
        let clearance = &vertices.clearance[..n];
        let rays = &mut self.shadows.rays;
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
        let (t_max, gain) = (&mut rays.t_max[..n], &mut self.shadows.gain[..n]);
        for i in 0..n {
            let normal = [nx[i], ny[i], nz[i]];
            let (end, weight) = self
                .panel
                .sample([px[i], py[i], pz[i]], normal, [u[i], v[i]]);
            let valid = if weight > 0.0 { 1.0 } else { 0.0 };
            (ox[i], oy[i], oz[i]) = (
                px[i] + nx[i] * clearance[i],
                py[i] + ny[i] * clearance[i],
                pz[i] + nz[i] * clearance[i],
            );
            (dx[i], dy[i], dz[i]) = (
                (end[0] - ox[i]) * valid,
                (end[1] - oy[i]) * valid,
                (end[2] - oz[i]) * valid,
            );
            t_max[i] = 1.0;
            gain[i] = weight;
        }
    }
}

impl Panel {
    /// End of the shadow ray, and the weighted irradiance per unit of radiance: 0 where there is none.
    #[inline(always)]
    fn sample(&self, vertex: [f32; 3], normal: [f32; 3], u: [f32; 2]) -> ([f32; 3], f32) {
        let point: [f32; 3] = std::array::from_fn(|k| {
            self.origin[k] + self.edges[0][k] * u[0] + self.edges[1][k] * u[1]
        });
        let span: [f32; 3] = std::array::from_fn(|k| point[k] - vertex[k]);
        let squared = dot(span, span);
        let inverse = 1.0 / squared.sqrt();
        let cos_theta = dot(span, normal) * inverse;
        let cos_light = -dot(span, self.normal) * inverse;
        let seen = if self.two_sided {
            cos_light.abs()
        } else {
            cos_light
        };
        let density = squared * self.probability / (self.area * seen);
        let ratio = cos_theta * FRAC_1_PI / density;
        let weight = cos_theta / (density * (1.0 + ratio * ratio));
        let usable = seen > 0.0 && cos_theta > 0.0 && density > 0.0 && density < f32::INFINITY;
        let off = clearance(point, self.area.sqrt()).copysign(cos_light);
        let end = std::array::from_fn(|k| point[k] + self.normal[k] * off);
        (end, if usable { weight } else { 0.0 })
    }
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
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

/// 1 − cosθ_max of a sphere's cone; `None` from inside and for a sphere with ports.
fn cone(axis: Vec3, radius: f32, whole: bool) -> Option<f32> {
    let sin2 = radius * radius / axis.length_squared();
    (whole && sin2 < 1.0).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
}

fn towards(tables: &Tables, emitter: &Emitter, place: &Place, u: [f32; 2]) -> Option<Towards> {
    let vertex = Vec3::from_array(place.point);
    match &emitter.shape {
        EmitterShape::Parallelogram {
            origin,
            edges,
            normal,
            area,
        } => {
            let [a, b] = edges.map(Vec3::from_array);
            let point = Vec3::from_array(*origin) + a * u[0] + b * u[1];
            by_area(
                vertex,
                point,
                Vec3::from_array(*normal),
                *area,
                emitter.two_sided,
            )
        }
        EmitterShape::Triangles {
            first,
            cumulative,
            area,
        } => {
            let (point, normal) = triangle_point(tables, *first, cumulative, u)?;
            by_area(vertex, point, normal, *area, emitter.two_sided)
        }
        EmitterShape::Disc {
            center,
            normal,
            axes,
            inner,
            outer,
            area,
        } => {
            let radius = (inner * inner + (outer * outer - inner * inner) * u[0]).sqrt();
            let (sin, cos) = sincos::sin_cos_two_pi(u[1]);
            let [a, b] = axes.map(Vec3::from_array);
            let point = Vec3::from_array(*center) + a * (radius * cos) + b * (radius * sin);
            by_area(
                vertex,
                point,
                Vec3::from_array(*normal),
                *area,
                emitter.two_sided,
            )
        }
        EmitterShape::Sphere { .. } => towards_sphere(emitter, vertex, u),
        EmitterShape::Point { position } => {
            towards_point(vertex, Vec3::from_array(*position), |_| 1.0)
        }
        EmitterShape::Spot {
            position,
            axis,
            beam,
        } => {
            let axis = Vec3::from_array(*axis);
            towards_point(vertex, Vec3::from_array(*position), |direction| {
                beam.falloff(f64::from(-direction.dot(axis))) as f32
            })
        }
        EmitterShape::Directional { towards } => {
            let direction = Vec3::from_array(*towards);
            Some(Towards {
                direction,
                end: direction,
                infinite: true,
                per_power: 1.0,
                density: f32::INFINITY,
            })
        }
    }
}

fn towards_point(vertex: Vec3, position: Vec3, falloff: impl Fn(Vec3) -> f32) -> Option<Towards> {
    let span = position - vertex;
    let squared = span.length_squared();
    let direction = span / squared.sqrt();
    let per_power = falloff(direction) / squared;
    (per_power > 0.0 && per_power.is_finite()).then_some(Towards {
        direction,
        end: position,
        infinite: false,
        per_power,
        density: f32::INFINITY,
    })
}

fn by_area(vertex: Vec3, point: Vec3, normal: Vec3, area: f32, two_sided: bool) -> Option<Towards> {
    let span = point - vertex;
    let squared = span.length_squared();
    let direction = span / squared.sqrt();
    let cos_light = -direction.dot(normal);
    let facing = if cos_light < 0.0 { -normal } else { normal };
    let seen = if two_sided {
        cos_light.abs()
    } else {
        cos_light
    };
    let density = squared / (area * seen);
    let usable = seen > 0.0 && density > 0.0 && density.is_finite();
    let end = point + facing * clearance(point.into(), area.sqrt());
    usable.then_some(Towards {
        direction,
        end,
        infinite: false,
        per_power: 1.0 / density,
        density,
    })
}

/// How far off its surface a sampled point must be moved to clear it: γ(8) of its coordinates and the shape's size.
#[inline(always)]
fn clearance(point: [f32; 3], size: f32) -> f32 {
    (point[0].abs() + point[1].abs() + point[2].abs() + size) * (8.0 * 0.5 * f32::EPSILON) * 2.0
}

fn triangle_point(
    tables: &Tables,
    first: u32,
    cumulative: &[f32],
    u: [f32; 2],
) -> Option<(Vec3, Vec3)> {
    let index = cumulative
        .partition_point(|share| *share <= u[0])
        .min(cumulative.len().checked_sub(1)?);
    let before = if index == 0 {
        0.0
    } else {
        cumulative[index - 1]
    };
    let within = ((u[0] - before) / (cumulative[index] - before)).clamp(0.0, 1.0);
    let record = &tables.scene.surfaces().triangles()[first as usize + index];
    let [a, b] = record.edges.map(Vec3::from_array);
    let root = within.sqrt();
    let point = Vec3::from_array(record.origin) + a * (1.0 - root) + b * (u[1] * root);
    Some((point, Vec3::from_array(record.normal)))
}

fn towards_sphere(emitter: &Emitter, vertex: Vec3, u: [f32; 2]) -> Option<Towards> {
    let EmitterShape::Sphere {
        center,
        radius,
        inside,
        ports,
    } = &emitter.shape
    else {
        return None;
    };
    let (center, radius) = (Vec3::from_array(*center), *radius);
    let axis = center - vertex;
    match cone(axis, radius, ports.is_empty()) {
        Some(_) if *inside && !emitter.two_sided => None,
        Some(one_minus_cos_max) => {
            Some(in_cone(axis, center, radius, one_minus_cos_max, vertex, u))
        }
        None => {
            let outwards = Vec3::from_array(warp::sphere(u[0], u[1]));
            let open = ports
                .iter()
                .any(|(direction, cos)| outwards.dot(Vec3::from_array(*direction)) > *cos);
            let normal = if *inside { -outwards } else { outwards };
            let area = 4.0 * PI * radius * radius;
            if open {
                None
            } else {
                by_area(
                    vertex,
                    center + outwards * radius,
                    normal,
                    area,
                    emitter.two_sided,
                )
            }
        }
    }
}

fn in_cone(
    axis: Vec3,
    center: Vec3,
    radius: f32,
    one_minus_cos_max: f32,
    vertex: Vec3,
    u: [f32; 2],
) -> Towards {
    let one_minus_cos = u[0] * one_minus_cos_max;
    let sin2 = one_minus_cos * (2.0 - one_minus_cos);
    let (sin_phi, cos_phi) = sincos::sin_cos_two_pi(u[1]);
    let (sin, cos) = (sin2.sqrt(), 1.0 - one_minus_cos);
    let distance = axis.length();
    let local = [sin * cos_phi, sin * sin_phi, cos];
    let direction = Vec3::from_array(super::scatter::to_world((axis / distance).into(), local));
    let reach = distance * cos
        - (radius * radius - distance * distance * sin2)
            .max(0.0)
            .sqrt();
    let outwards = (vertex + direction * reach - center).normalize();
    let point = center + outwards * radius;
    let end = point + outwards * clearance((point.abs() + center.abs()).into(), radius);
    let density = 1.0 / (TAU * one_minus_cos_max);
    Towards {
        direction,
        end,
        infinite: false,
        per_power: 1.0 / density,
        density,
    }
}
