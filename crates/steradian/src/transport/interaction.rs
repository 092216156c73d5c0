//! From a hit of the kernel to a point of a surface.
//!
//! The point is rebuilt from the primitive, never as o + t·d, and bounded: for a triangle p = a + u·e₁ + v·e₂ is off by
//! at most γ(8)·(|a| + |u·e₁| + |v·e₂|) along each axis, with γ(n) = nε/(1 − nε) and ε = 2⁻²⁴; for a quadric the same
//! bound holds with |c| + r. Rays leave from the point moved along the normal by the bound's extent in that direction.
//!
//! A ray that starts in the very plane of a triangle sees it edge-on, and rounding alone decides whether it is met. The
//! kernel's sheared corners are off by some ε·(|e₁| + |e₂|), so a ray that leaves a triangle starts at least γ(8)·max(|e₁| + |e₂|)
//! above it, however small the point's coordinates along the normal are.
//!
//! Source: M. Pharr, W. Jakob & G. Humphreys, *Physically Based Rendering* (4th ed. 2023), §6.8.

use glam::{DVec3, Vec3};
use steradian_kernel::{HitBatch, RayBatch};

use super::columns::Place;
use super::tables::Tables;
use crate::shape::{QuadricRecord, TriangleRecord};

/// γ(8) in single precision.
const GAMMA_8: f32 = 8.0 * (0.5 * f32::EPSILON) / (1.0 - 8.0 * (0.5 * f32::EPSILON));

/// A ray's meeting with a surface.
pub(super) struct Hit {
    /// The point, with the normal of the side that was met.
    pub place: Place,
    /// Number of the side.
    pub side: u32,
    /// Number of the primitive.
    pub primitive: u32,
    /// Barycentric weights of the second and third corner of a triangle.
    pub weights: [f32; 2],
    /// From the point back along the ray.
    pub viewer: [f32; 3],
    /// Where the ray began.
    pub origin: [f32; 3],
    /// Squared length of the ray.
    pub distance_squared: f32,
    /// Cosine between the normal and `viewer`.
    pub cos_theta: f32,
}

#[inline(always)]
pub(super) fn hit(tables: &Tables, rays: &RayBatch, hits: &HitBatch, i: usize) -> Hit {
    let surfaces = tables.scene.surfaces();
    let primitive = hits.primitive[i] as usize;
    let direction = Vec3::new(
        rays.direction_x[i],
        rays.direction_y[i],
        rays.direction_z[i],
    );
    let origin = Vec3::new(rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]);
    let triangles = surfaces.triangles();
    let (point, normal, extent, size, part) = if primitive < triangles.len() {
        triangle(&triangles[primitive], hits.u[i], hits.v[i])
    } else {
        quadric(
            &surfaces.quadrics()[primitive - triangles.len()],
            origin,
            direction,
            hits.t[i],
        )
    };
    let against = -normal.dot(direction);
    let front = against > 0.0;
    Hit {
        place: place(point, if front { normal } else { -normal }, extent, size),
        side: 2 * part + u32::from(!front),
        primitive: hits.primitive[i],
        weights: [hits.u[i], hits.v[i]],
        viewer: (-direction).into(),
        origin: origin.into(),
        distance_squared: (point - origin).length_squared(),
        cos_theta: against.abs(),
    }
}

/// A point of a triangle that a ray of this direction meets, and whether it meets the front.
#[inline(always)]
pub(super) fn place_on_triangle(
    record: &TriangleRecord,
    [u, v]: [f32; 2],
    direction: [f32; 3],
) -> (Place, bool) {
    let (point, normal, extent, size, _) = triangle(record, u, v);
    let front = -normal.dot(Vec3::from_array(direction)) > 0.0;
    let facing = if front { normal } else { -normal };
    (place(point, facing, extent, size), front)
}

/// A point facing a direction, of this rounding bound and on a primitive of this size.
#[inline(always)]
fn place(point: Vec3, facing: Vec3, extent: Vec3, size: f32) -> Place {
    Place {
        point: point.into(),
        normal: facing.into(),
        clearance: facing.abs().dot(extent).max(size) * GAMMA_8,
    }
}

impl Hit {
    /// The hit of a ray that had come `travelled` metres before it passed through a surface.
    #[inline(always)]
    pub fn set_back(&mut self, travelled: f32) {
        let way = travelled + self.distance_squared.sqrt();
        let back = Vec3::from_array(self.viewer) * way;
        self.origin = (Vec3::from_array(self.place.point) + back).into();
        self.distance_squared = way * way;
    }
}

#[inline(always)]
fn triangle(record: &TriangleRecord, u: f32, v: f32) -> (Vec3, Vec3, Vec3, f32, u32) {
    let origin = Vec3::from_array(record.origin);
    let edges = record.edges.map(Vec3::from_array);
    let along = [edges[0] * u, edges[1] * v];
    let point = origin + along[0] + along[1];
    let extent = origin.abs() + along[0].abs() + along[1].abs();
    let size = (edges[0].abs() + edges[1].abs()).max_element();
    let normal = Vec3::from_array(record.normal);
    (point, normal, extent, size, record.part)
}

/// The hit in f64, moved onto the surface.
fn quadric(
    record: &QuadricRecord,
    origin: Vec3,
    direction: Vec3,
    t: f32,
) -> (Vec3, Vec3, Vec3, f32, u32) {
    let center = DVec3::from_array(record.center);
    let reached = origin.as_dvec3() + direction.as_dvec3() * f64::from(t);
    let radius = record.signed_radius.abs();
    let (point, normal) = if radius == 0.0 {
        let normal = DVec3::from_array(record.normal);
        (reached - normal * (reached - center).dot(normal), normal)
    } else {
        let outwards = (reached - center).normalize();
        (
            center + outwards * radius,
            outwards * record.signed_radius.signum(),
        )
    };
    let extent = point.as_vec3().abs() + center.as_vec3().abs() + Vec3::splat(radius as f32);
    let (point, normal) = (point.as_vec3(), normal.as_vec3());
    (point, normal, extent, 0.0, record.part)
}
