//! A Lambertian emitter on a shape: the same radiance L from every point and in every direction of its emitting side.
//!
//! Φ = π L A for each emitting side, M = π L. Seen from a receiver, a sampled point of area density 1/A has the
//! density p = r²/(A cosθ_l) in solid angle; a whole sphere seen from outside is sampled uniformly in the cone it subtends,
//! p = 1/(2π(1 − cos θ_max)) with sin θ_max = R/d. E_n = L/p.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L | radiance | W/(m² sr) |
//! | M | exitance | W/m² |
//! | A | area | m² |
//! | θ_l | angle at the light | rad |

use std::f64::consts::TAU;

use super::{Density, Incident};
use crate::geometry::{Direction, Frame, Point};
use crate::material::Texture;
use crate::quantity::{Area, Exitance, Flux, Radiance, SolidAngle};
use crate::shape::{Form, ShapeId, Sphere};
use crate::spectrum::MAX_LANES;

/// An emitting shape.
#[derive(Clone, Debug)]
pub struct AreaLight {
    /// The shape.
    pub shape: ShapeId,
    /// L of each lane, where all textures are 1.
    pub radiance: [Radiance; MAX_LANES],
    /// How L varies over the shape: factors.
    pub textures: Vec<Texture>,
    /// Both sides emit.
    pub two_sided: bool,
}

impl AreaLight {
    /// Φ = πLA of all emitting sides.
    pub fn flux(&self, area: Area) -> [Flux; MAX_LANES] {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        self.radiance
            .map(|radiance| Exitance::from_lambertian_radiance(radiance) * area * sides)
    }

    pub(crate) fn incident(&self, form: &Form, point: Point, u: [f64; 2]) -> Option<Incident> {
        let (direction, distance, pdf) = match form {
            Form::Sphere(sphere) if is_outside(sphere, point) => {
                self.towards_sphere(sphere, point, u)?
            }
            _ => towards_area(form, self.two_sided, point, u)?,
        };
        let patch = SolidAngle::from_steradians(1.0 / pdf);
        Some(Incident {
            direction,
            distance,
            normal_irradiance: self
                .radiance
                .map(|radiance| radiance.normal_irradiance_over(patch)),
            density: Density::SolidAngle(pdf),
        })
    }

    fn towards_sphere(
        &self,
        sphere: &Sphere,
        point: Point,
        u: [f64; 2],
    ) -> Option<(Direction, f64, f64)> {
        if sphere.inside && !self.two_sided {
            return None;
        }
        let axis = sphere.center - point;
        let distance = axis.length();
        let sin2_max = (sphere.radius / distance) * (sphere.radius / distance);
        let one_minus_cos_max = sin2_max / (1.0 + (1.0 - sin2_max).sqrt());
        let one_minus_cos = u[0] * one_minus_cos_max;
        let sin2 = one_minus_cos * (2.0 - one_minus_cos);
        let (sin, cos) = (sin2.sqrt(), 1.0 - one_minus_cos);
        let local = Direction::from_polar(sin, cos, TAU * u[1]);
        let direction = Frame::from_normal(Direction::new(axis).ok()?).to_world(local);
        let half_chord = sphere.radius * sphere.radius - distance * distance * sin2;
        let reach = distance * cos - half_chord.max(0.0).sqrt();
        Some((direction, reach, 1.0 / (TAU * one_minus_cos_max)))
    }
}

/// Direction to a point drawn by area, its distance, and the density p.
pub(super) fn towards_area(
    form: &Form,
    two_sided: bool,
    point: Point,
    u: [f64; 2],
) -> Option<(Direction, f64, f64)> {
    let sample = form.sample_area(u)?;
    let towards = sample.point - point;
    let direction = Direction::new(towards).ok()?;
    let cos_light = -direction.dot(sample.normal);
    let seen = if two_sided {
        cos_light.abs()
    } else {
        cos_light
    };
    let pdf = towards.dot(towards) / (form.sampling_area() * seen);
    (seen > 0.0).then_some((direction, towards.length(), pdf))
}

/// Whether the cone of a sphere can be used.
fn is_outside(sphere: &Sphere, point: Point) -> bool {
    (point - sphere.center).length() > sphere.radius && sphere.ports.is_empty()
}
