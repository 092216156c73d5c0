//! Projections: which ray belongs to a place on the plane of a picture.
//!
//! In the camera's frame x is to the right, y down and z ahead; θ is the angle from ahead, and t = tan(fov/2). The plane's
//! (a, b) is made from film positions as [`camera`](super) says.
//!
//! | projection | ray | solid angle per unit of the plane |
//! |---|---|---|
//! | perspective | (at, bt, 1) | t² / (1 + (a² + b²) t²)^{3/2} |
//! | thin lens | from (Au, Av, 0) through d·(at, bt, 1) | as in perspective, from the middle of the lens |
//! | orthographic | (0, 0, 1) from (a, b, 0)·w/2 | 0 |
//! | panorama | (cosβ sinα, sinβ, cosβ cosα), α = πa, β = πb/2 | ½π² cosβ |
//! | fisheye | θ(r) in the direction of (a, b), r² = a² + b² ≤ 1 | sinθ θ′(r) / r |
//!
//! | fisheye | r, with α = fov/2 | solid angle per unit of the plane |
//! |---|---|---|
//! | equidistant | θ/α | α sinθ/r |
//! | equisolid (equal area) | sin(θ/2) / sin(α/2) | 4 sin²(α/2) |
//! | hemispherical (orthographic projection of the hemisphere) | sinθ / sinα | sin²α / cosθ |
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | fov | full angle of view: across the width, or across the image circle | rad |
//! | A, d | radius of the lens, distance of the plane that is sharp, along the axis | m |
//! | (u, v) | place on the unit disc of the lens | – |
//! | w | width of the picture in the scene | m |
//!
//! In the hemispherical picture dω cosθ is the same for all pixels, so the mean over the circle of 180° times π is the irradiance
//! on a plane that faces the view; in the equisolid one dω is, so it gives the scalar irradiance of the cap.
//!
//! A point at depth z is drawn by a thin lens as a disc of W A |z − d| / (z d t) pixels across, W being the picture's width.
//!
//! Sources: K. Miyamoto, *Fish eye lens* (J. Opt. Soc. Am. 54, 1964) for the fisheyes; R. Cook, T. Porter & L. Carpenter,
//! *Distributed ray tracing* (SIGGRAPH 1984) for the lens.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::geometry::Vector;
use crate::quantity::{Angle, Length};

/// How a camera maps directions to its film.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum Projection {
    /// Through a point on to a plane.
    Perspective {
        /// Full horizontal angle of view, below 180°.
        fov: Angle,
    },
    /// Through a lens that is sharp at one distance.
    ThinLens {
        /// Full horizontal angle of view, below 180°.
        fov: Angle,
        /// Radius of the lens.
        aperture_radius: Length,
        /// Distance of the sharp plane, measured along the axis.
        focus_distance: Length,
    },
    /// Along parallel rays that start on the plane of the camera.
    Orthographic {
        /// Width of the picture in the scene.
        width: Length,
    },
    /// The whole sphere as longitude and latitude; the poles are up and down in the camera's frame.
    Panorama,
    /// A cone of directions as a circle that touches the two nearer borders of the film.
    Fisheye {
        /// How the angle from the axis becomes a radius.
        mapping: Fisheye,
        /// Full angle of the cone: up to 360°, for a hemispherical picture up to 180°.
        fov: Angle,
    },
}

/// How the angle θ from the axis of a fisheye becomes a radius.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Fisheye {
    /// r ∝ θ.
    Equidistant,
    /// r ∝ sin(θ/2): equal areas are equal solid angles.
    Equisolid,
    /// r ∝ sinθ: equal areas are equal projected solid angles.
    Hemispherical,
}

impl Projection {
    /// What it is called in scene files.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Perspective { .. } => "perspective",
            Self::ThinLens { .. } => "thin-lens",
            Self::Orthographic { .. } => "orthographic",
            Self::Panorama => "panorama",
            Self::Fisheye { mapping, .. } => match mapping {
                Fisheye::Equidistant => "fisheye-equidistant",
                Fisheye::Equisolid => "fisheye-equisolid",
                Fisheye::Hemispherical => "fisheye-hemispherical",
            },
        }
    }

    /// Start and direction (not normalised) of the ray of a place on the plane, in the camera's frame.
    pub(super) fn ray(&self, [a, b]: [f64; 2], lens: [f64; 2]) -> Option<(Vector, Vector)> {
        let none = Vector::new(0.0, 0.0, 0.0);
        Some(match *self {
            Self::Perspective { fov } => (none, flat(half_width(fov), [a, b])),
            Self::ThinLens {
                fov,
                aperture_radius,
                focus_distance,
            } => {
                let start = on_lens(aperture_radius, lens);
                let sharp = flat(half_width(fov), [a, b]) * focus_distance.to_metres();
                (start, sharp - start)
            }
            Self::Orthographic { width } => {
                let half = 0.5 * width.to_metres();
                let ahead = Vector::new(0.0, 0.0, 1.0);
                (Vector::new(a * half, b * half, 0.0), ahead)
            }
            Self::Panorama => {
                let (alpha, beta) = (PI * a, FRAC_PI_2 * b);
                let ring = libm::cos(beta);
                let (x, z) = (ring * libm::sin(alpha), ring * libm::cos(alpha));
                (none, Vector::new(x, libm::sin(beta), z))
            }
            Self::Fisheye { mapping, fov } => {
                let radius = libm::hypot(a, b);
                let theta = mapping.angle(fov, radius)?;
                let across = libm::sin(theta) / radius.max(f64::MIN_POSITIVE);
                (none, Vector::new(a * across, b * across, libm::cos(theta)))
            }
        })
    }

    /// The place on the plane whose ray through this place of the lens meets a point of the camera's frame.
    pub(super) fn plane_of(&self, point: Vector, lens: [f64; 2]) -> Option<[f64; 2]> {
        let Vector { x, y, z } = point;
        match *self {
            Self::Perspective { fov } => {
                let unit = z * half_width(fov);
                (z > 0.0).then(|| [x / unit, y / unit])
            }
            Self::ThinLens {
                fov,
                aperture_radius,
                focus_distance,
            } => {
                let (start, distance) =
                    (on_lens(aperture_radius, lens), focus_distance.to_metres());
                let sharp = start + (point - start) * (distance / z);
                let unit = distance * half_width(fov);
                (z > 0.0).then(|| [sharp.x / unit, sharp.y / unit])
            }
            Self::Orthographic { width } => {
                let half = 0.5 * width.to_metres();
                (z >= 0.0).then(|| [x / half, y / half])
            }
            Self::Panorama => {
                let beta = libm::atan2(y, libm::hypot(x, z));
                (point.length() > 0.0).then(|| [libm::atan2(x, z) / PI, beta / FRAC_PI_2])
            }
            Self::Fisheye { mapping, fov } => {
                let across = libm::hypot(x, y);
                let radius = mapping.radius(fov, libm::atan2(across, z))?;
                let [x, y] = if across > 0.0 {
                    [x / across, y / across]
                } else {
                    [1.0, 0.0]
                };
                (point.length() > 0.0).then_some([radius * x, radius * y])
            }
        }
    }

    /// Where the ray to a point of the camera's frame starts, and how much of the plane an area at the point fills that faces the
    /// ray, per square metre: 1/(ω r²) with the solid angle ω per unit of the plane.
    pub(super) fn sight(&self, point: Vector, lens: [f64; 2]) -> Option<(Vector, f64)> {
        let start = match *self {
            Self::Orthographic { width } => {
                let half = 0.5 * width.to_metres();
                return Some((Vector::new(point.x, point.y, 0.0), 1.0 / (half * half)));
            }
            Self::ThinLens {
                aperture_radius, ..
            } => on_lens(aperture_radius, lens),
            _ => Vector::ZERO,
        };
        let way = point - start;
        let plane = match *self {
            Self::ThinLens { fov, .. } => Self::Perspective { fov }.plane_of(way, lens)?,
            _ => self.plane_of(way, lens)?,
        };
        let density = 1.0 / (self.solid_angle_density(plane) * way.dot(way));
        density.is_finite().then_some((start, density))
    }

    /// Solid angle per unit of the plane, in sr.
    pub(super) fn solid_angle_density(&self, [a, b]: [f64; 2]) -> f64 {
        match *self {
            Self::Perspective { fov } | Self::ThinLens { fov, .. } => {
                let half = half_width(fov);
                let distance = flat(half, [a, b]).length();
                half * half / (distance * distance * distance)
            }
            Self::Orthographic { .. } => 0.0,
            Self::Panorama => PI * FRAC_PI_2 * libm::cos(FRAC_PI_2 * b).max(0.0),
            Self::Fisheye { mapping, fov } => mapping.solid_angle_density(fov, libm::hypot(a, b)),
        }
    }
}

fn half_width(fov: Angle) -> f64 {
    (fov / 2.0).tan()
}

fn flat(half_width: f64, [a, b]: [f64; 2]) -> Vector {
    Vector::new(a * half_width, b * half_width, 1.0)
}

fn on_lens(radius: Length, [u, v]: [f64; 2]) -> Vector {
    Vector::new(u * radius.to_metres(), v * radius.to_metres(), 0.0)
}

impl Fisheye {
    /// θ at a radius of the image circle.
    fn angle(self, fov: Angle, radius: f64) -> Option<f64> {
        let half = 0.5 * fov.to_radians();
        (radius <= 1.0).then(|| match self {
            Self::Equidistant => radius * half,
            Self::Equisolid => 2.0 * libm::asin(radius * libm::sin(0.5 * half)),
            Self::Hemispherical => libm::asin(radius * libm::sin(half)),
        })
    }

    /// The radius at which an angle from the axis is drawn.
    fn radius(self, fov: Angle, theta: f64) -> Option<f64> {
        let half = 0.5 * fov.to_radians();
        (theta <= half).then(|| match self {
            Self::Equidistant => theta / half,
            Self::Equisolid => libm::sin(0.5 * theta) / libm::sin(0.5 * half),
            Self::Hemispherical => libm::sin(theta) / libm::sin(half),
        })
    }

    fn solid_angle_density(self, fov: Angle, radius: f64) -> f64 {
        let half = 0.5 * fov.to_radians();
        let Some(theta) = self.angle(fov, radius) else {
            return 0.0;
        };
        match self {
            Self::Equidistant if radius > 0.0 => half * libm::sin(theta) / radius,
            Self::Equidistant => half * half,
            Self::Equisolid => 4.0 * libm::pow(libm::sin(0.5 * half), 2.0),
            Self::Hemispherical => libm::pow(libm::sin(half), 2.0) / libm::cos(theta),
        }
    }
}
