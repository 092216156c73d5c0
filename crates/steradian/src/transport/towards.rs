//! One sampled direction towards a light, of any kind.
//!
//! A point drawn by area has the density p = r²/(A cosθ_l) in solid angle; a sphere seen from outside is drawn uniformly
//! in its cone, p = 1/(2π(1 − cosθ_max)).

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use super::columns::Place;
use super::tables::{Emitter, EmitterShape, Tables};
use crate::sampling::{sincos, warp};

/// A sampled direction towards an emitter.
pub(super) struct Towards {
    /// Unit vector from the vertex.
    pub direction: Vec3,
    /// Where the shadow ray ends; the direction itself for light from infinitely far away.
    pub end: Vec3,
    pub infinite: bool,
    /// E_n per unit of the emitter's power.
    pub per_power: f32,
    /// Density in solid angle; infinite for a light without extent.
    pub density: f32,
}

/// 1 − cosθ_max of a sphere's cone; `None` from inside and for a sphere with ports.
#[inline(always)]
pub(super) fn cone(axis: Vec3, radius: f32, whole: bool) -> Option<f32> {
    let sin2 = radius * radius / axis.length_squared();
    (whole && sin2 < 1.0).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
}

/// A direction towards an emitter, with what it emits there.
pub(super) fn towards(
    tables: &Tables,
    emitter: &Emitter,
    place: &Place,
    u: [f32; 2],
) -> Option<Towards> {
    directed(tables, emitter, evenly_towards(tables, emitter, place, u)?)
}

/// With what the emitter sends in this direction, if that is anything.
fn directed(tables: &Tables, emitter: &Emitter, mut towards: Towards) -> Option<Towards> {
    if emitter.is_directed {
        towards.per_power *= tables.factor(emitter, -towards.direction);
    }
    (towards.per_power > 0.0 && towards.per_power.is_finite()).then_some(towards)
}

/// The same of an emitter whose power is the same in all directions.
fn evenly_towards(
    tables: &Tables,
    emitter: &Emitter,
    place: &Place,
    u: [f32; 2],
) -> Option<Towards> {
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
            if cumulative.is_empty() {
                return None;
            }
            let (index, within) = triangle_of(cumulative, u[0]);
            let (point, normal) = triangle_point(tables, first + index as u32, [within, u[1]]);
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
        EmitterShape::Everywhere(map) => {
            let sample = map.sample(u)?;
            let direction = Vec3::from_array(sample.direction.to_array().map(|x| x as f32));
            Some(Towards {
                direction,
                end: direction,
                infinite: true,
                per_power: (1.0 / sample.pdf) as f32,
                density: sample.pdf as f32,
            })
        }
        EmitterShape::Luminaire { position, end } => {
            let towards = towards_point(vertex, Vec3::from_array(*position), |_| 1.0)?;
            Some(Towards {
                end: Vec3::from_array(*end),
                ..towards
            })
        }
        EmitterShape::Portal(portal) => portal.towards(place, u),
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

/// A direction to a point of an emitter that is drawn by area.
pub(super) fn by_area(
    vertex: Vec3,
    point: Vec3,
    normal: Vec3,
    area: f32,
    two_sided: bool,
) -> Option<Towards> {
    let span = point - vertex;
    let squared = span.length_squared();
    let distance = squared.sqrt();
    let direction = span / distance;
    let cos_light = -direction.dot(normal);
    let facing = if cos_light < 0.0 { -normal } else { normal };
    let seen = if two_sided {
        cos_light.abs()
    } else {
        cos_light
    };
    let density = squared / (area * seen);
    let usable = seen > 0.0 && density > 0.0 && density.is_finite();
    let end = point + facing * clearance(point.into(), area.sqrt() + distance);
    usable.then_some(Towards {
        direction,
        end,
        infinite: false,
        per_power: 1.0 / density,
        density,
    })
}

/// How far off its surface a sampled point must be moved to clear it: γ(8) of its coordinates and of `size`, the sum of the
/// shape's size and of the shadow ray's length, of which the ray's span and the place of a hit on it are rounded.
#[inline(always)]
pub(super) fn clearance(point: [f32; 3], size: f32) -> f32 {
    (point[0].abs() + point[1].abs() + point[2].abs() + size) * (8.0 * 0.5 * f32::EPSILON) * 2.0
}

/// A direction towards a point of one triangle of a mesh, with the density that its points have by area of the whole mesh.
pub(super) fn towards_triangle(
    tables: &Tables,
    emitter: &Emitter,
    triangle: u32,
    (place, u): (&Place, [f32; 2]),
) -> Option<Towards> {
    let EmitterShape::Triangles { first, area, .. } = &emitter.shape else {
        return None;
    };
    let (point, normal) = triangle_point(tables, first + triangle, u);
    let vertex = Vec3::from_array(place.point);
    let towards = by_area(vertex, point, normal, *area, emitter.two_sided)?;
    directed(tables, emitter, towards)
}

fn triangle_point(tables: &Tables, number: u32, [u, v]: [f32; 2]) -> (Vec3, Vec3) {
    let record = &tables.scene.surfaces().triangles()[number as usize];
    let [a, b] = record.edges.map(Vec3::from_array);
    let root = u.sqrt();
    let point = Vec3::from_array(record.origin) + a * (1.0 - root) + b * (v * root);
    (point, Vec3::from_array(record.normal))
}

/// The triangle that a number chooses by area, and what is left of the number.
pub(super) fn triangle_of(cumulative: &[f32], u: f32) -> (usize, f32) {
    let last = cumulative.len() - 1;
    let index = cumulative.partition_point(|share| *share <= u).min(last);
    let before = if index == 0 {
        0.0
    } else {
        cumulative[index - 1]
    };
    let within = ((u - before) / (cumulative[index] - before)).clamp(0.0, 1.0);
    (index, within)
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

/// A direction in the cone that a sphere subtends.
#[inline(always)]
pub(super) fn in_cone(
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
    let end = on_sphere(center, radius, vertex, direction);
    let density = 1.0 / (TAU * one_minus_cos_max);
    Towards {
        direction,
        end,
        infinite: false,
        per_power: 1.0 / density,
        density,
    }
}

/// End of a shadow ray from `vertex` that goes in a `direction` to a sphere: where it meets it first, moved off its surface.
#[inline(always)]
pub(super) fn on_sphere(center: Vec3, radius: f32, vertex: Vec3, direction: Vec3) -> Vec3 {
    let axis = center - vertex;
    let along = direction.dot(axis);
    // As a vector, the way past the centre keeps its digits.
    let past = (axis - direction * along).length_squared();
    let reach = along - (radius * radius - past).max(0.0).sqrt();
    let outwards = (vertex + direction * reach - center).normalize();
    let point = center + outwards * radius;
    let coordinates = point.abs() + center.abs();
    point + outwards * clearance(coordinates.into(), radius + axis.length())
}
