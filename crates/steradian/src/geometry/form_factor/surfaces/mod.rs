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

mod quadrature;

use std::f64::consts::{PI, TAU};

use super::polygons::exchange_area_of_polygons;
use super::{
    DimensionError, between_coaxial_discs, between_spheres, dimensions,
    from_sphere_to_plane_surface,
};
use crate::geometry::{Direction, Point, Polygon, Vector, configuration_factor, solid_angle};
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
            error: 1e-11 * value,
        });
    }
    let closed = closed_form(from, to)
        .or_else(|| closed_form(to, from).map(|back| back * (to.area() / from.area())));
    Ok(match closed {
        Some(value) => Factor { value, error: 0.0 },
        None => quadrature::mean_factor(from, to, tolerance),
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
mod tests;
