//! Form factors by adaptive quadrature over the first surface.

use std::f64::consts::{PI, TAU};

use super::super::cubature::{self, Integral};
use super::{Factor, Surface};
use crate::geometry::{Direction, Frame, Point, Vector};

/// The mean over the first surface of the configuration factor of the second.
pub(super) fn mean_factor(from: &Surface, to: &Surface, tolerance: f64) -> Factor {
    let integrals: Vec<Integral> = match from {
        Surface::Polygon(polygon) => polygon
            .triangle_corners()
            .map(|corners| over_triangle(corners, polygon.normal(), to, tolerance))
            .collect(),
        Surface::Disc {
            center,
            normal,
            radius,
        } => vec![over_disc(
            *center,
            *normal,
            radius.to_metres(),
            to,
            tolerance,
        )],
        Surface::Sphere { center, radius } => {
            vec![over_sphere(*center, radius.to_metres(), to, tolerance)]
        }
    };
    let area = from.area().to_square_metres();
    Factor {
        value: integrals.iter().map(|integral| integral.value).sum::<f64>() / area,
        error: integrals.iter().map(|integral| integral.error).sum::<f64>() / area,
    }
}

fn over_triangle(
    [a, b, c]: [Point; 3],
    normal: Direction,
    to: &Surface,
    tolerance: f64,
) -> Integral {
    let twice_area = (b - a).cross(c - a).length();
    let f = |u: f64, v: f64| twice_area * u * to.seen_from(a + ((b - a) + (c - b) * v) * u, normal);
    cubature::over_unit_square(&f, tolerance)
}

fn over_disc(
    center: Point,
    normal: Direction,
    radius: f64,
    to: &Surface,
    tolerance: f64,
) -> Integral {
    let frame = Frame::from_normal(normal);
    let f = |u: f64, v: f64| {
        let (sin, cos) = libm::sincos(TAU * v);
        let step = frame.vector_to_world(Vector::new(radius * u * cos, radius * u * sin, 0.0));
        TAU * radius * radius * u * to.seen_from(center + step, normal)
    };
    cubature::over_unit_square(&f, tolerance)
}

fn over_sphere(center: Point, radius: f64, to: &Surface, tolerance: f64) -> Integral {
    let f = |u: f64, v: f64| {
        let (sin, cos) = libm::sincos(PI * u);
        let normal = Direction::from_polar(sin, cos, TAU * v);
        TAU * PI * radius * radius * sin * to.seen_from(center + normal * radius, normal)
    };
    cubature::over_unit_square(&f, tolerance)
}
