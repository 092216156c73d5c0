//! Area by quadrature of its definition, beside which the closed forms can be held.
//!
//! A = ∫ dA, summed over n × n cells of the shape's own coordinates with dA taken at the middle of each cell:
//!
//! | shape | coordinates | dA |
//! |---|---|---|
//! | parallelogram | u, v in 0 … 1 | \|e₁ × e₂\| du dv |
//! | triangle | u, v in 0 … 1, point a + u (b − a) + u v (c − b) | u \|(b − a) × (c − b)\| du dv |
//! | disc | ρ in r … R, φ | ρ dρ dφ |
//! | sphere | θ, φ; a cell whose middle is in a port does not count | R² sinθ dθ dφ |
//!
//! The middle rule is exact for the flat shapes; for a sphere its relative error is π²/(24 n²).
//!
//! ```
//! use steradian::geometry::Point;
//! use steradian::shape::{Form, Sphere, quadrature};
//!
//! let ball = Form::Sphere(Sphere { center: Point::ORIGIN, radius: 1.0, inside: false, ports: vec![] });
//! let sum = quadrature::area(&ball, 10).unwrap();
//! assert!((sum / ball.area() - 1.0 - 0.0041).abs() < 1e-4); // π²/2400
//! ```

use std::f64::consts::{PI, TAU};

use super::{Disc, Form, Parallelogram, Sphere, TriangleMesh};
use crate::geometry::Direction;

/// Σ dA over `cells` × `cells` cells of each face, in m²; none for the infinite plane.
pub fn area(form: &Form, cells: u32) -> Option<f64> {
    match form {
        Form::Parallelogram(form) => Some(parallelogram(form, cells)),
        Form::Mesh(form) => Some(mesh(form, cells)),
        Form::Sphere(form) => Some(sphere(form, cells)),
        Form::Disc(form) => Some(disc(form, cells)),
        Form::Plane { .. } => None,
    }
}

/// ∫∫ f(u, v) du dv over the unit square by the middle rule.
fn over_unit_square(cells: u32, f: impl Fn(f64, f64) -> f64) -> f64 {
    let step = 1.0 / f64::from(cells);
    let middle = |cell: u32| (f64::from(cell) + 0.5) * step;
    let row = |i: u32| (0..cells).map(|j| f(middle(i), middle(j))).sum::<f64>();
    (0..cells).map(row).sum::<f64>() * step * step
}

fn parallelogram(form: &Parallelogram, cells: u32) -> f64 {
    let [a, b, c, _] = form.corners();
    let element = (b - a).cross(c - b).length();
    over_unit_square(cells, |_, _| element)
}

fn mesh(form: &TriangleMesh, cells: u32) -> f64 {
    let triangle = |index: usize| {
        let [a, b, c] = form.corners(index);
        let element = (b - a).cross(c - b).length();
        over_unit_square(cells, |u, _| u * element)
    };
    (0..form.triangles.len()).map(triangle).sum()
}

fn disc(form: &Disc, cells: u32) -> f64 {
    let width = form.radius - form.inner_radius;
    over_unit_square(cells, |u, _| (form.inner_radius + u * width) * width * TAU)
}

fn sphere(form: &Sphere, cells: u32) -> f64 {
    let element = |u: f64, v: f64| {
        let (sin_theta, cos_theta) = libm::sincos(PI * u);
        let open = form.in_port(Direction::from_polar(sin_theta, cos_theta, TAU * v));
        if open { 0.0 } else { sin_theta * PI * TAU }
    };
    form.radius * form.radius * over_unit_square(cells, element)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Vector};
    use crate::shape::SpherePort;

    fn deviation(form: &Form, cells: u32) -> f64 {
        area(form, cells).unwrap() / form.area() - 1.0
    }

    #[test]
    fn flat_shapes_are_exact() {
        let edges = [Vector::new(2.0, 0.0, 0.5), Vector::new(-1.0, 3.0, 0.0)];
        let parallelogram =
            Form::Parallelogram(Parallelogram::new(Point::new(1.0, 2.0, 3.0), edges).unwrap());
        let disc = Form::Disc(Disc {
            center: Point::ORIGIN,
            normal: Direction::Z,
            radius: 2.0,
            inner_radius: 0.5,
        });
        let corners = vec![
            Point::ORIGIN,
            Point::new(1.0, 0.0, 0.0),
            Point::new(0.3, 2.0, 1.0),
            Point::new(-1.0, 1.0, 0.0),
        ];
        let mesh = Form::Mesh(TriangleMesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]));
        for form in [parallelogram, disc, mesh] {
            assert!(deviation(&form, 7).abs() < 1e-12, "{form:?}");
        }
    }

    #[test]
    fn a_sphere_has_the_error_of_the_middle_rule() {
        let sphere = Form::Sphere(Sphere {
            center: Point::ORIGIN,
            radius: 0.3,
            inside: false,
            ports: vec![],
        });
        for cells in [8, 16, 64] {
            let expected = PI * PI / (24.0 * f64::from(cells * cells));
            assert!(
                (deviation(&sphere, cells) / expected - 1.0).abs() < 0.02,
                "{cells}"
            );
        }
    }

    /// The edge of a port runs through the cells: of its 2n/3 rows' worth of angle each row is counted or not as a whole,
    /// so that the error is at most half a row of the sphere, π/(2n) · sin 60° of its half-area 2π.
    #[test]
    fn a_port_is_left_out() {
        let port = SpherePort {
            direction: Direction::Z,
            cos_half_angle: 0.5,
        };
        let sphere = Form::Sphere(Sphere {
            center: Point::ORIGIN,
            radius: 1.0,
            inside: true,
            ports: vec![port],
        });
        assert!(deviation(&sphere, 200).abs() < PI / 200.0 * 0.87 * TAU / 2.0 / sphere.area());
    }
}
