//! What a point receives of an extended light in full view: a closed form.
//!
//! A light of constant radiance L of which nothing is hidden gives
//!
//! E = π L F  at a surface,  E₀ = L ω  from everywhere
//!
//! with its configuration factor F and its solid angle ω, both in closed form. That nothing is hidden is proven by a question to the
//! kernel: no surface reaches into the *shaft*, a convex region that holds every shadow ray which sampling might trace.
//!
//! | light | shaft |
//! |---|---|
//! | convex facet | the pyramid from the start of the rays, up to the facet's plane less the clearance of its points |
//! | sphere | a pyramid of 32 sides around its cone, up to the circle where the cone touches it |
//! | disc | the pyramid over a polygon of 32 sides around it, like that of a facet |
//!
//! all cut at the receiver's horizon. Rays start where a receiver's do, above the surface that it sits on, so that what only touches the
//! receiver or the light does not count; what touches the shaft from the side does. So does a surface that lets a part of the light
//! pass. Of the light itself the facet is left out of the question, other facets of it are not.
//!
//! Source: E. A. Haines & J. R. Wallace, *Shaft culling for efficient ray-cast radiosity* (Eurographics Workshop on Rendering 1991).

use std::f64::consts::PI;

use super::tables::{Emitter, Facet, Outline, Tables, circumscribed};
use super::towards::clearance;
use crate::geometry::{Direction, Frame, Point, Vector, configuration_factor, solid_angle};
use crate::quantity::Length;
use crate::shape::Disc;

/// A point that receives light.
#[derive(Copy, Clone)]
pub(super) struct View {
    pub position: Point,
    /// None if it takes light from everywhere.
    pub normal: Option<Direction>,
    /// Where its rays start.
    pub start: Point,
}

impl View {
    pub fn new(position: Point, normal: Option<Direction>, clearance: f64) -> Self {
        let off = normal.map_or(Vector::ZERO, |normal| normal * clearance);
        Self {
            position,
            normal,
            start: position + off,
        }
    }

    /// ∫ cosθ dω over an emitter, or ∫ dω; none if something may hide a part of it, or no closed form is known.
    pub fn of(&self, tables: &Tables<'_>, emitter: &Emitter) -> Option<f64> {
        match emitter.outline.as_ref()? {
            Outline::Facets(facets) => {
                let share = |facet: &Facet| {
                    self.of_flat(tables, facet, emitter.two_sided, || {
                        self.integral(&facet.corners)
                    })
                };
                facets.iter().map(share).sum()
            }
            Outline::Disc(disc, around) => self.of_flat(tables, around, emitter.two_sided, || {
                self.integral_of_disc(disc, disc.radius)
                    - self.integral_of_disc(disc, disc.inner_radius)
            }),
            Outline::Sphere { center, radius } => self.of_sphere(tables, emitter, *center, *radius),
        }
    }

    fn of_flat(
        &self,
        tables: &Tables<'_>,
        facet: &Facet,
        two_sided: bool,
        integral: impl FnOnce() -> f64,
    ) -> Option<f64> {
        if !self.may_see(facet, two_sided) {
            return Some(0.0);
        }
        let corners = &facet.corners;
        let lengths = corners.iter().map(|corner| (*corner - self.start).length());
        let size = 2.0 * lengths.fold(0.0, f64::max);
        let kernel = |corner: &Point| tables.scene.surfaces().to_kernel(*corner);
        let off = corners
            .iter()
            .map(|corner| clearance(kernel(corner), size as f32));
        let off = f64::from(off.fold(0.0, f32::max));
        let towards = facet.normal.to_vector() * -facet.height_of(self.start).signum();
        let mut shaft = self.shaft();
        shaft.around(corners);
        shaft.end(towards, corners[0] - towards * off);
        let own = |primitive: u32| facet.primitives.contains(&primitive);
        shaft.is_clear(tables, &own).then(integral)
    }

    fn integral(&self, corners: &[Point]) -> f64 {
        match self.normal {
            Some(normal) => PI * configuration_factor::of_polygon(self.position, normal, corners),
            None => solid_angle::of_polygon(self.position, corners).to_steradians(),
        }
    }

    fn integral_of_disc(&self, disc: &Disc, radius: f64) -> f64 {
        let (position, radius) = (self.position, Length::from_metres(radius));
        let (center, axis) = (disc.center, disc.normal);
        match self.normal {
            Some(normal) => {
                PI * configuration_factor::of_disc(position, normal, center, axis, radius)
            }
            None => solid_angle::of_disc(position, center, axis, radius).to_steradians(),
        }
    }

    fn of_sphere(
        &self,
        tables: &Tables<'_>,
        emitter: &Emitter,
        center: Point,
        radius: f64,
    ) -> Option<f64> {
        let axis = center - self.start;
        let distance = axis.length();
        if self
            .normal
            .is_some_and(|normal| normal.dot(axis) <= -radius)
        {
            return Some(0.0);
        }
        let (towards, sine) = (Direction::new(axis).ok()?, radius / distance);
        if sine >= 1.0 || (self.position - center).length() <= radius {
            return None;
        }
        let mut shaft = self.shaft();
        shaft.around(&pyramid(self.start, towards, sine));
        let reach = distance * (1.0 - sine) * (1.0 + sine);
        shaft.end(towards.to_vector(), self.start + towards * reach);
        let first = tables.scene.surfaces().first_primitive(emitter.surface?);
        let (position, length) = (self.position, Length::from_metres(radius));
        shaft
            .is_clear(tables, &|primitive| primitive == first)
            .then(|| match self.normal {
                Some(normal) => {
                    PI * configuration_factor::of_sphere(position, normal, center, length)
                }
                None => solid_angle::of_sphere(position, center, length).to_steradians(),
            })
    }

    /// Whether a facet shines to where the rays start, and reaches above their horizon.
    pub fn may_see(&self, facet: &Facet, two_sided: bool) -> bool {
        let mut corners = facet.corners.iter();
        let mut reaches =
            |normal: Direction| corners.any(|corner| normal.dot(*corner - self.start) > 0.0);
        facet.faces(self.start, two_sided) && self.normal.is_none_or(&mut reaches)
    }

    fn shaft(&self) -> Shaft {
        let mut shaft = Shaft {
            start: self.start,
            half_spaces: vec![],
        };
        if let Some(normal) = self.normal {
            shaft.end(-normal.to_vector(), self.start);
        }
        shaft
    }
}

/// Corners of the pyramid around a cone, one metre along its axis.
fn pyramid(start: Point, axis: Direction, sine: f64) -> Vec<Point> {
    let frame = Frame::from_normal(axis);
    let tangent = sine / ((1.0 - sine) * (1.0 + sine)).sqrt();
    let corner = |[x, y]: [f64; 2]| {
        start
            + axis.to_vector()
            + frame.tangent() * (x * tangent)
            + frame.bitangent() * (y * tangent)
    };
    circumscribed().map(corner).collect()
}

/// A convex region that begins at a point.
struct Shaft {
    start: Point,
    /// Outward normal, not of unit length, and a point of the plane.
    half_spaces: Vec<(Vector, Point)>,
}

impl Shaft {
    /// Adds the sides of the pyramid over a convex outline.
    fn around(&mut self, corners: &[Point]) {
        let middle = corners
            .iter()
            .fold(Vector::ZERO, |sum, c| sum + (*c - self.start));
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let normal = (*a - self.start).cross(*b - *a);
            let outwards = if normal.dot(middle) > 0.0 {
                -normal
            } else {
                normal
            };
            // A side that is no plane bounds nothing.
            if let Ok(outwards) = Direction::new(outwards) {
                self.half_spaces.push((outwards.to_vector(), self.start));
            }
        }
    }

    /// Ends the region at a plane.
    fn end(&mut self, outwards: Vector, point: Point) {
        self.half_spaces.push((outwards, point));
    }

    fn is_clear(&self, tables: &Tables<'_>, ignore: &dyn Fn(u32) -> bool) -> bool {
        let surfaces = tables.scene.surfaces();
        let half_space =
            |(n, point): &(Vector, Point)| [n.x, n.y, n.z, n.dot(*point - surfaces.origin())];
        let half_spaces: Vec<_> = self.half_spaces.iter().map(half_space).collect();
        surfaces.accelerator().region_is_clear(&half_spaces, ignore)
    }
}
