//! Polygons, discs and spheres, each with each.
//!
//! | from, to | way |
//! |---|---|
//! | polygon, polygon | [`between_polygons`](super::between_polygons) |
//! | sphere, polygon or disc in front of whose plane it lies | ω/4π: [`from_sphere_to_plane_surface`] |
//! | coaxial discs | [`between_coaxial_discs`] |
//! | sphere, sphere | the single integral of [`between_spheres`] |
//! | any other pair | the configuration factor, which is a closed form, integrated over the first surface adaptively |
//!
//! Flat surfaces send and receive with their fronts, spheres with their outsides.

use std::f64::consts::{PI, TAU};

use super::cubature::{self, Integral};
use super::polygons::exchange_area_of_polygons;
use super::{
    DimensionError, between_coaxial_discs, between_spheres, dimensions,
    from_sphere_to_plane_surface,
};
use crate::geometry::{
    Direction, Frame, Point, Polygon, Vector, configuration_factor, solid_angle,
};
use crate::quantity::{Area, Length};

/// What sends or receives.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// The front of a polygon.
    Polygon(Polygon),
    /// The front of a disc.
    Disc {
        /// Its centre.
        center: Point,
        /// Where its front faces.
        normal: Direction,
        /// Its radius.
        radius: Length,
    },
    /// The outside of a sphere.
    Sphere {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: Length,
    },
}

/// A form factor, and how it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor {
    /// F₁₂.
    pub value: f64,
    /// How far the value may be off; 0 for a closed form, which is precise to rounding.
    pub error: f64,
}

/// F₁₂ between two surfaces that do not intersect. `tolerance` is the relative error that is sought where there is no closed form.
///
/// # Errors
/// If a radius is not positive or a sphere intersects the other surface.
///
/// ```
/// use steradian::geometry::{Direction, Point, form_factor::{self, Surface}};
/// use steradian::quantity::Length;
/// let one = Length::from_metres(1.0);
/// let disc = Surface::Disc { center: Point::ORIGIN, normal: Direction::Z, radius: one };
/// let sphere = Surface::Sphere { center: Point::new(0.0, 0.0, 2.0), radius: one };
/// let found = form_factor::between(&sphere, &disc, 1e-9)?;
/// assert!((found.value - 0.5 * (1.0 - 0.8_f64.sqrt())).abs() < 1e-15);
/// assert_eq!(found.error, 0.0);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between(from: &Surface, to: &Surface, tolerance: f64) -> Result<Factor, DimensionError> {
    from.check()?;
    to.check()?;
    check_apart(from, to)?;
    check_apart(to, from)?;
    if let (
        &Surface::Sphere { center, radius },
        &Surface::Sphere {
            center: other,
            radius: to,
        },
    ) = (from, to)
    {
        let value = between_spheres([radius, to], center.distance(other))?;
        return Ok(Factor {
            value,
            error: 1e-12 * value,
        });
    }
    let closed = closed_form(from, to)
        .or_else(|| closed_form(to, from).map(|back| back * (to.area() / from.area())));
    Ok(match closed {
        Some(value) => Factor { value, error: 0.0 },
        None => by_quadrature(from, to, tolerance),
    })
}

fn closed_form(from: &Surface, to: &Surface) -> Option<f64> {
    match (from, to) {
        (Surface::Polygon(a), Surface::Polygon(b)) => {
            Some(exchange_area_of_polygons(a, b) / a.area())
        }
        (Surface::Sphere { center, radius }, _) => {
            let height = to.height(*center)?;
            if height <= -radius.to_metres() {
                return Some(0.0);
            }
            (height >= radius.to_metres())
                .then(|| from_sphere_to_plane_surface(to.solid_angle(*center)))
        }
        (
            &Surface::Disc {
                center,
                normal,
                radius,
            },
            &Surface::Disc {
                center: other,
                normal: facing,
                radius: to,
            },
        ) => {
            let step = other - center;
            let is_coaxial =
                normal.cross(step) == Vector::ZERO && normal.cross(facing) == Vector::ZERO;
            let is_facing = normal.dot(step) > 0.0 && facing.dot(step) < 0.0;
            (is_coaxial && is_facing)
                .then(|| between_coaxial_discs([radius, to], center.distance(other)).ok())?
        }
        _ => None,
    }
}

fn by_quadrature(from: &Surface, to: &Surface, tolerance: f64) -> Factor {
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

impl Surface {
    /// The area of one side.
    pub fn area(&self) -> Area {
        match self {
            Self::Polygon(polygon) => polygon.area(),
            Self::Disc { radius, .. } => radius.squared() * PI,
            Self::Sphere { radius, .. } => radius.squared() * (2.0 * TAU),
        }
    }

    /// The other side of a flat surface; a sphere has none that can be seen.
    pub fn back(&self) -> Option<Self> {
        match self {
            Self::Polygon(polygon) => {
                let reversed = |ring: &[Point]| ring.iter().rev().copied().collect();
                let holes = polygon.holes().map(reversed).collect();
                let tolerance = Length::from_metres(f64::INFINITY);
                Polygon::with_tolerance(reversed(polygon.outline()), holes, tolerance)
                    .ok()
                    .map(Self::Polygon)
            }
            &Self::Disc {
                center,
                normal,
                radius,
            } => Some(Self::Disc {
                center,
                normal: -normal,
                radius,
            }),
            Self::Sphere { .. } => None,
        }
    }

    /// The configuration factor from an element: of the front of a flat surface, the outside of a sphere.
    pub fn seen_from(&self, position: Point, normal: Direction) -> f64 {
        if self.height(position).is_some_and(|height| height <= 0.0) {
            return 0.0;
        }
        match self {
            Self::Polygon(polygon) => polygon.configuration_factor_from(position, normal),
            &Self::Disc {
                center,
                normal: axis,
                radius,
            } => configuration_factor::of_disc(position, normal, center, axis, radius),
            &Self::Sphere { center, radius } => {
                configuration_factor::of_sphere(position, normal, center, radius)
            }
        }
    }

    /// How high a point is over the front of a flat surface's plane.
    fn height(&self, point: Point) -> Option<f64> {
        match self {
            Self::Polygon(polygon) => Some(polygon.normal().dot(point - polygon.outline()[0])),
            Self::Disc { center, normal, .. } => Some(normal.dot(point - *center)),
            Self::Sphere { .. } => None,
        }
    }

    fn solid_angle(&self, observer: Point) -> crate::quantity::SolidAngle {
        match self {
            Self::Polygon(polygon) => polygon.solid_angle_from(observer),
            &Self::Disc {
                center,
                normal,
                radius,
            } => solid_angle::of_disc(observer, center, normal, radius),
            &Self::Sphere { center, radius } => solid_angle::of_sphere(observer, center, radius),
        }
    }

    fn check(&self) -> Result<(), DimensionError> {
        match self {
            Self::Polygon(_) => Ok(()),
            Self::Disc { radius, .. } => {
                dimensions::positive("radius of the disc", *radius).map(drop)
            }
            Self::Sphere { radius, .. } => {
                dimensions::positive("radius of the sphere", *radius).map(drop)
            }
        }
    }

    /// The distance from a point to the nearest point of a flat surface.
    fn distance(&self, point: Point) -> Option<f64> {
        let height = self.height(point)?.abs();
        let aside = match self {
            &Self::Disc {
                center,
                normal,
                radius,
            } => {
                ((point - center) - normal * normal.dot(point - center)).length()
                    - radius.to_metres()
            }
            Self::Polygon(polygon) => distance_aside(polygon, point),
            Self::Sphere { .. } => return None,
        };
        Some(libm::hypot(height, aside.max(0.0)))
    }
}

/// How far the foot of a point in a polygon's plane lies outside the polygon.
fn distance_aside(polygon: &Polygon, point: Point) -> f64 {
    let normal = polygon.normal();
    let foot = point - normal * normal.dot(point - polygon.outline()[0]);
    let from_triangle = |corners: [Point; 3]| {
        let edges = [0, 1, 2].map(|k| (corners[k], corners[(k + 1) % 3]));
        let is_left = |&(a, b): &(Point, Point)| normal.dot((b - a).cross(foot - a)) >= 0.0;
        if edges.iter().all(is_left) {
            return 0.0;
        }
        let from_edge = |(a, b): (Point, Point)| {
            let t = ((foot - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            foot.distance(a.lerp(b, t)).to_metres()
        };
        edges
            .map(from_edge)
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    };
    polygon
        .triangle_corners()
        .map(from_triangle)
        .fold(f64::INFINITY, f64::min)
}

fn check_apart(sphere: &Surface, other: &Surface) -> Result<(), DimensionError> {
    if let Surface::Sphere { center, radius } = sphere
        && other
            .distance(*center)
            .is_some_and(|distance| distance < radius.to_metres() * (1.0 - 1e-12))
    {
        return Err(DimensionError::Intersecting(
            "the sphere intersects the other surface",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;

    fn polygon(corners: &[[f64; 3]]) -> Surface {
        Surface::Polygon(
            Polygon::new(
                corners.iter().map(|&corner| corner.into()).collect(),
                vec![],
            )
            .unwrap(),
        )
    }

    fn disc(center: [f64; 3], normal: [f64; 3], radius: f64) -> Surface {
        Surface::Disc {
            center: center.into(),
            normal: Direction::new(normal.into()).unwrap(),
            radius: Length::from_metres(radius),
        }
    }

    fn sphere(center: [f64; 3], radius: f64) -> Surface {
        Surface::Sphere {
            center: center.into(),
            radius: Length::from_metres(radius),
        }
    }

    fn surfaces() -> [Surface; 5] {
        [
            polygon(&[
                [0.0, 0.0, 0.0],
                [2.0, 0.0, 0.0],
                [2.0, 1.0, 0.0],
                [0.0, 1.0, 0.0],
            ]),
            disc([0.3, 0.2, 2.0], [0.1, 0.3, -1.0], 0.7),
            sphere([1.2, 0.5, 1.0], 0.4),
            disc([-0.8, 0.5, 0.7], [1.0, 0.1, 0.2], 0.4),
            sphere([1.2, 3.0, 0.1], 0.5),
        ]
    }

    #[test]
    fn all_pairs_are_reciprocal_within_their_errors() {
        for from in &surfaces() {
            for to in surfaces().iter().filter(|&to| to != from) {
                let (forth, back) = (
                    between(from, to, 1e-6).unwrap(),
                    between(to, from, 1e-6).unwrap(),
                );
                let ratio = to.area() / from.area();
                let allowed = forth.error + back.error * ratio + 1e-14;
                assert!(
                    close(forth.value, back.value * ratio, allowed),
                    "{from:?} {to:?} {forth:?} {back:?}"
                );
                assert!(
                    forth.error <= 1e-6 * forth.value,
                    "{from:?} {to:?} {forth:?}"
                );
            }
        }
    }

    #[test]
    fn closed_forms_agree_with_the_quadrature() {
        let far_sphere = sphere([0.4, 0.3, 3.0], 0.5);
        let coaxial = [
            disc([0.0; 3], [0.0, 0.0, 1.0], 1.0),
            disc([0.0, 0.0, 1.5], [0.0, 0.0, -1.0], 0.6),
        ];
        let [floor, tilted, ..] = surfaces();
        for (from, to) in [
            (&far_sphere, &floor),
            (&far_sphere, &coaxial[0]),
            (&coaxial[0], &coaxial[1]),
            (&floor, &far_sphere),
        ] {
            let (closed, sum) = (
                between(from, to, 1e-9).unwrap(),
                by_quadrature(from, to, 1e-9),
            );
            assert_eq!(closed.error, 0.0);
            assert!(
                close(closed.value, sum.value, sum.error),
                "{from:?} {to:?} {closed:?} {sum:?}"
            );
        }
        assert!(between(&tilted, &floor, 1e-9).unwrap().error > 0.0);
    }

    #[test]
    fn both_sides_of_a_wall_that_cuts_the_view() {
        let wall = disc([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], 1.0);
        let ball = sphere([0.0, 2.0, 0.0], 0.9);
        let front = between(&ball, &wall, 1e-7).unwrap();
        let back = between(&ball, &wall.back().unwrap(), 1e-7).unwrap();
        assert!(close(front.value, back.value, front.error + back.error));
        assert!(front.value > 0.0 && ball.back().is_none());
    }

    #[test]
    fn what_intersects_or_has_no_size_is_refused() {
        let [floor, ..] = surfaces();
        let error = |from: &Surface, to: &Surface| between(from, to, 1e-6).unwrap_err().to_string();
        for ball in [sphere([1.0, 0.5, 0.3], 0.4), sphere([-0.2, 0.5, 0.0], 0.4)] {
            assert_eq!(
                error(&ball, &floor),
                "the sphere intersects the other surface"
            );
            assert_eq!(
                error(&floor, &ball),
                "the sphere intersects the other surface"
            );
        }
        assert!(between(&sphere([-0.5, 0.5, 0.0], 0.4), &floor, 1e-6).is_ok());
        assert!(
            error(&sphere([0.0; 3], 1.0), &sphere([1.0; 3], 1.0))
                .contains("distance of the centres")
        );
        assert!(
            error(&disc([0.0; 3], [0.0, 0.0, 1.0], -1.0), &floor)
                .contains("radius of the disc is -1 m")
        );
    }
}
