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

use super::tables::{Facet, Tables, circumscribed};
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

    /// ∫ cosθ dω over a whole facet, or ∫ dω.
    pub fn of_facet(&self, facet: &Facet) -> f64 {
        let corners = &facet.corners;
        match self.normal {
            Some(normal) => PI * configuration_factor::of_polygon(self.position, normal, corners),
            None => solid_angle::of_polygon(self.position, corners).to_steradians(),
        }
    }

    /// The same over a disc or ring.
    pub fn of_disc(&self, disc: &Disc) -> f64 {
        self.within(disc, disc.radius) - self.within(disc, disc.inner_radius)
    }

    fn within(&self, disc: &Disc, radius: f64) -> f64 {
        let (position, radius) = (self.position, Length::from_metres(radius));
        let (center, axis) = (disc.center, disc.normal);
        match self.normal {
            Some(normal) => {
                PI * configuration_factor::of_disc(position, normal, center, axis, radius)
            }
            None => solid_angle::of_disc(position, center, axis, radius).to_steradians(),
        }
    }

    /// The same over a sphere.
    pub fn of_sphere(&self, center: Point, radius: f64) -> f64 {
        let (position, length) = (self.position, Length::from_metres(radius));
        match self.normal {
            Some(normal) => PI * configuration_factor::of_sphere(position, normal, center, length),
            None => solid_angle::of_sphere(position, center, length).to_steradians(),
        }
    }

    /// Whether a sphere reaches above the horizon.
    pub fn may_see_sphere(&self, center: Point, radius: f64) -> bool {
        let above = |normal: Direction| normal.dot(center - self.start) > -radius;
        self.normal.is_none_or(above)
    }

    /// Whether a facet shines to where the rays start, and reaches above their horizon.
    pub fn may_see(&self, facet: &Facet, two_sided: bool) -> bool {
        let mut corners = facet.corners.iter();
        let mut reaches =
            |normal: Direction| corners.any(|corner| normal.dot(*corner - self.start) > 0.0);
        facet.faces(self.start, two_sided) && self.normal.is_none_or(&mut reaches)
    }

    /// How far off their plane rays to some corners end: γ(8) of coordinates and of twice their length.
    pub fn clearance(&self, tables: &Tables<'_>, corners: &[Point]) -> f64 {
        let lengths = corners.iter().map(|corner| (*corner - self.start).length());
        let size = 2.0 * lengths.fold(0.0, f64::max);
        let kernel = |corner: &Point| tables.scene.surfaces().to_kernel(*corner);
        let off = corners
            .iter()
            .map(|corner| clearance(kernel(corner), size as f32));
        f64::from(off.fold(0.0, f32::max))
    }

    /// No more than how far off a plane rays end, wherever they do.
    pub fn least_clearance(&self, facet: &Facet) -> f64 {
        f64::from(clearance(
            [0.0; 3],
            facet.height_of(self.start).abs() as f32,
        ))
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

/// A convex region that begins at a point: half-spaces n · x ≤ d with `[n_x, n_y, n_z, d]` in kernel coordinates, n not of unit length.
#[derive(Default)]
pub(super) struct Shaft {
    half_spaces: Vec<[f64; 4]>,
}

impl Shaft {
    pub fn half_spaces(&self) -> &[[f64; 4]] {
        &self.half_spaces
    }

    /// Becomes that to a facet, less what is within a distance of its plane.
    pub fn enclose_facet(&mut self, tables: &Tables<'_>, view: &View, facet: &Facet, off: f64) {
        let origin = tables.scene.surfaces().origin();
        self.begin(origin, view);
        self.around(origin, view.start, &facet.corners);
        let towards = facet.normal.to_vector() * -facet.height_of(view.start).signum();
        self.end(origin, towards, facet.corners[0] - towards * off);
    }

    /// Becomes that to a sphere; false from within.
    pub fn enclose_sphere(
        &mut self,
        tables: &Tables<'_>,
        view: &View,
        (center, radius): (Point, f64),
    ) -> bool {
        let (origin, axis) = (tables.scene.surfaces().origin(), center - view.start);
        let distance = axis.length();
        let (Ok(towards), sine) = (Direction::new(axis), radius / distance) else {
            return false;
        };
        if sine >= 1.0 || (view.position - center).length() <= radius {
            return false;
        }
        self.begin(origin, view);
        self.around(origin, view.start, &pyramid(view.start, towards, sine));
        let reach = distance * (1.0 - sine) * (1.0 + sine);
        let touched = view.start + towards * reach;
        self.end(origin, towards.to_vector(), touched);
        true
    }

    fn begin(&mut self, origin: Point, view: &View) {
        self.half_spaces.clear();
        if let Some(normal) = view.normal {
            self.end(origin, -normal.to_vector(), view.start);
        }
    }

    /// Adds the sides of the pyramid over a convex outline.
    fn around(&mut self, origin: Point, start: Point, corners: &[Point]) {
        let spans = corners.iter().map(|corner| *corner - start);
        let middle = spans.fold(Vector::ZERO, |sum, span| sum + span);
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let normal = (*a - start).cross(*b - *a);
            let outwards = if normal.dot(middle) > 0.0 {
                -normal
            } else {
                normal
            };
            // A side that is no plane bounds nothing.
            if let Ok(outwards) = Direction::new(outwards) {
                self.end(origin, outwards.to_vector(), start);
            }
        }
    }

    /// Ends the region at a plane.
    fn end(&mut self, origin: Point, n: Vector, point: Point) {
        self.half_spaces
            .push([n.x, n.y, n.z, n.dot(point - origin)]);
    }
}
