//! Paths aimed at the place that they are for, by way of a plane.
//!
//! What a plane throws on surfaces at a distance r of a point weighs as 1/r² there, and comes from directions about that of the point's image, or about
//! the point itself where it is beyond the plane. So a part of the paths from a light at a point to a plane shape takes a direction of the density
//!
//! q(ω) = 1/(2π (t + s) ln(1 + 2/s)),  t = 1 − cosθ,
//!
//! and others are drawn evenly; each counts by the density of both together.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | θ | angle from the direction in which the image is | rad |
//! | s | where the density ends to grow: within an angle of √(2s) | 1 |
//!
//! A place at a distance d of the light's image is seen from there within sinθ ≤ r/d of the point, so that 1/(q r²) is bounded down to r = d √(2s), a thousandth of d.
//!
//! Source: E. Veach & L. Guibas, *Optimally combining sampling techniques for Monte Carlo rendering* (SIGGRAPH 1995), §3.4 (one sample of several densities).

use std::f64::consts::TAU;

use crate::geometry::{Direction, Frame, Vector};
use crate::shape::{Form, Surfaces};

const SHARPEST: f64 = 5e-7;

/// In kernel coordinates.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    point: Vector,
    normal: Direction,
}

/// Directions about one.
pub(super) struct Focus(Frame);

impl Plane {
    pub fn of(form: &Form, surfaces: &Surfaces) -> Option<Self> {
        let (point, normal) = match form {
            Form::Parallelogram(form) => (form.origin, form.normal),
            Form::Plane { point, normal } => (*point, *normal),
            Form::Mesh(_) | Form::Sphere(_) | Form::Disc(_) => return None,
        };
        let point = point - surfaces.origin();
        Some(Self { point, normal })
    }

    /// For light at a point that goes to a place by way of the plane; `None` where it is there already.
    pub fn focus(&self, light: Vector, place: Vector) -> Option<Focus> {
        let height = |of: Vector| (of - self.point).dot(self.normal.to_vector());
        let is_beyond = height(light) * height(place) < 0.0;
        let step = if is_beyond { 0.0 } else { 2.0 * height(place) };
        let image = place - self.normal * step;
        let axis = Direction::new(image - light).ok()?;
        Some(Focus(Frame::from_normal(axis)))
    }
}

impl Focus {
    pub fn sample(&self, [u, v]: [f32; 2]) -> Vector {
        let growth = libm::expm1(f64::from(u) * libm::log1p(2.0 / SHARPEST));
        let t = (SHARPEST * growth).min(2.0);
        let (sine, turn) = ((t * (2.0 - t)).sqrt(), TAU * f64::from(v));
        let local = Vector::new(sine * libm::cos(turn), sine * libm::sin(turn), 1.0 - t);
        self.0.vector_to_world(local)
    }

    /// By solid angle.
    pub fn density(&self, direction: Vector) -> f64 {
        // 1 − cosθ would cancel.
        let apart = direction - self.0.normal().to_vector();
        let t = 0.5 * apart.dot(apart);
        1.0 / (TAU * (t + SHARPEST) * libm::log1p(2.0 / SHARPEST))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::sampling::block;
    use crate::sampling::testing::assert_mean;

    /// Directions d drawn with the density q have ⟨f/q⟩ = ∫ f dω: 4π for 1, 0 for d·a with any a, 4π/3 for its square.
    #[test]
    fn samples_have_the_density() {
        let axis = Vector::new(0.3, -0.4, 0.5);
        let focus = Focus(Frame::from_normal(Direction::new(axis).unwrap()));
        let drawn = |index: u32| {
            let [u, v, ..] = block::sample(3, index, 0);
            focus.sample([u, v])
        };
        let all: Vec<_> = (0..1 << 14).map(drawn).collect();
        let check = |of: &dyn Fn(Vector) -> f64, expected: f64| {
            let weighed: Vec<_> = all.iter().map(|d| of(*d) / focus.density(*d)).collect();
            assert_mean(&weighed, expected, 1e-3);
        };
        check(&|_| 1.0, 2.0 * TAU);
        check(&|d| d.x, 0.0);
        check(&|d| d.y * d.y, 2.0 * TAU / 3.0);
    }

    /// Light at (0, 0, 2) over the plane z = 0 is sent to (1, 0, 1) as to (1, 0, −1), and to (1, 0, −1) straight.
    #[test]
    fn an_image_is_behind_the_plane() {
        let plane = Plane {
            point: Vector::new(5.0, 5.0, 0.0),
            normal: Direction::Z,
        };
        let light = Point::new(0.0, 0.0, 2.0) - Point::ORIGIN;
        let expected = Direction::new(Vector::new(1.0, 0.0, -3.0)).unwrap();
        for z in [1.0, -1.0] {
            let focus = plane.focus(light, Vector::new(1.0, 0.0, z)).unwrap();
            let off = focus.0.normal().to_vector() - expected.to_vector();
            assert!(off.length() < 1e-12);
        }
        assert!(
            plane
                .focus(light, light - Vector::new(0.0, 0.0, 4.0))
                .is_some()
        );
    }
}
