//! Light samples of one parallelogram for all vertices of a batch, over columns.

use std::f32::consts::FRAC_1_PI;

use steradian_kernel::Work;

use super::columns::{Shadows, Vertices};
use super::tables::{EmitterShape, Tables};
use super::towards::clearance;

/// A parallelogram as the vectorised loop reads it.
#[derive(Copy, Clone)]
pub(super) struct Panel {
    pub origin: [f32; 3],
    pub edges: [[f32; 3]; 2],
    pub normal: [f32; 3],
    pub area: f32,
    pub two_sided: bool,
    /// Light comes through it from beyond: rays go through its points, from where they start.
    pub is_portal: bool,
}

/// Samples one panel at every vertex: the same numbers as [`NextEvent::sample`], over columns.
pub(super) struct SamplePanel<'a> {
    pub panel: Panel,
    pub vertices: &'a Vertices,
    pub numbers: [&'a [f32]; 2],
    pub shadows: &'a mut Shadows,
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
        let reach = if self.panel.is_portal {
            f32::INFINITY
        } else {
            1.0
        };
        for i in 0..n {
            let normal = [nx[i], ny[i], nz[i]];
            let start = [
                px[i] + nx[i] * clearance[i],
                py[i] + ny[i] * clearance[i],
                pz[i] + nz[i] * clearance[i],
            ];
            let from = match self.panel.is_portal {
                true => start,
                false => [px[i], py[i], pz[i]],
            };
            let (end, weight) = self.panel.sample(from, normal, [u[i], v[i]]);
            let valid = if weight > 0.0 { 1.0 } else { 0.0 };
            (ox[i], oy[i], oz[i]) = start.into();
            (dx[i], dy[i], dz[i]) = (
                (end[0] - ox[i]) * valid,
                (end[1] - oy[i]) * valid,
                (end[2] - oz[i]) * valid,
            );
            t_max[i] = reach;
            gain[i] = weight;
        }
    }
}

impl Panel {
    /// An emitter, if it is one that is as bright everywhere and in all directions, and that no other sampler finds.
    pub fn of(tables: &Tables<'_>, number: usize) -> Option<Self> {
        let emitter = &tables.emitters[number];
        if emitter.is_directed || tables.has_textures(&emitter.power) {
            return None;
        }
        match &emitter.shape {
            EmitterShape::Parallelogram {
                origin,
                edges,
                normal,
                area,
            } => Some(Self {
                origin: *origin,
                edges: *edges,
                normal: *normal,
                area: *area,
                two_sided: emitter.two_sided,
                is_portal: false,
            }),
            EmitterShape::Portal(portal) if tables.emitters.len() == 1 => Some(Self {
                origin: portal.origin.into(),
                edges: portal.edges.map(Into::into),
                normal: portal.normal.into(),
                area: portal.area,
                two_sided: false,
                is_portal: true,
            }),
            _ => None,
        }
    }

    /// End of the shadow ray, and the weighted irradiance per unit of radiance: 0 where there is none.
    #[inline(always)]
    pub fn sample(&self, vertex: [f32; 3], normal: [f32; 3], u: [f32; 2]) -> ([f32; 3], f32) {
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
        let density = squared / (self.area * seen);
        let ratio = cos_theta * FRAC_1_PI / density;
        let weight = cos_theta / (density * (1.0 + ratio * ratio));
        let usable = seen > 0.0 && cos_theta > 0.0 && density > 0.0 && density < f32::INFINITY;
        let size = self.area.sqrt() + squared * inverse;
        let off = match self.is_portal {
            true => 0.0,
            false => clearance(point, size).copysign(cos_light),
        };
        let end = std::array::from_fn(|k| point[k] + self.normal[k] * off);
        (end, if usable { weight } else { 0.0 })
    }
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
