//! The rays of a camera in f32, for batches: the twin of [`Camera::ray`].
//!
//! Every mapping is written so that it needs no function beyond the square root and the sine of a fraction of a turn: with
//! s = r sin(α/2) an equisolid fisheye has sinθ = 2s √(1 − s²) and cosθ = 1 − 2s², and so on.

use std::f32::consts::TAU;

use glam::Vec3;

use crate::geometry::{Direction, Vector};
use crate::sampling::sincos::sin_cos_two_pi;
use crate::sampling::warp;
use crate::sensor::{Camera, Fisheye, Projection};

/// The numbers that a projection needs for every ray.
pub(super) struct Optics {
    /// Right, down and ahead.
    axes: [Vec3; 3],
    /// The plane's (a, b) = film position × scale + offset.
    scale: [f32; 2],
    offset: [f32; 2],
    mapping: Mapping,
}

/// The projection, prepared.
enum Mapping {
    /// tan(fov/2).
    Perspective(f32),
    ThinLens {
        /// tan(fov/2) · d.
        half_width: f32,
        radius: f32,
        distance: f32,
    },
    /// Half the width of the picture.
    Orthographic(f32),
    Panorama,
    /// The half angle of view in turns.
    Equidistant(f32),
    /// sin(fov/4).
    Equisolid(f32),
    /// sin(fov/2).
    Hemispherical(f32),
}

impl Mapping {
    fn new(projection: Projection) -> Self {
        match projection {
            Projection::Perspective { fov } => Self::Perspective((fov / 2.0).tan() as f32),
            Projection::ThinLens {
                fov,
                aperture_radius,
                focus_distance,
            } => Self::ThinLens {
                half_width: ((fov / 2.0).tan() * focus_distance.to_metres()) as f32,
                radius: aperture_radius.to_metres() as f32,
                distance: focus_distance.to_metres() as f32,
            },
            Projection::Orthographic { width } => {
                Self::Orthographic((0.5 * width.to_metres()) as f32)
            }
            Projection::Panorama => Self::Panorama,
            Projection::Fisheye { mapping, fov } => match mapping {
                Fisheye::Equidistant => Self::Equidistant((fov.to_degrees() / 720.0) as f32),
                Fisheye::Equisolid => Self::Equisolid((fov / 4.0).sin() as f32),
                Fisheye::Hemispherical => Self::Hemispherical((fov / 2.0).sin() as f32),
            },
        }
    }

    /// Start and direction in the camera's frame.
    #[inline(always)]
    fn ray(&self, a: f32, b: f32, numbers: [f32; 2]) -> Option<(Vec3, Vec3)> {
        let square = a * a + b * b;
        let towards = match *self {
            Self::Perspective(half) => Vec3::new(a * half, b * half, 1.0).normalize(),
            Self::ThinLens {
                half_width,
                radius,
                distance,
            } => {
                let [u, v] = warp::disc(numbers[0], numbers[1]);
                let start = Vec3::new(u * radius, v * radius, 0.0);
                let sharp = Vec3::new(a * half_width, b * half_width, distance);
                return Some((start, (sharp - start).normalize()));
            }
            Self::Orthographic(half) => return Some((Vec3::new(a * half, b * half, 0.0), Vec3::Z)),
            Self::Panorama => {
                let (sine, cosine) = sin_cos_two_pi(0.5 * a);
                let (down, ring) = sin_cos_two_pi(0.25 * b);
                Vec3::new(ring * sine, down, ring * cosine)
            }
            _ if square > 1.0 => return None,
            Self::Equidistant(turns) => {
                let radius = square.sqrt();
                let (sine, cosine) = sin_cos_two_pi(radius * turns);
                let across = if radius > 0.0 {
                    sine / radius
                } else {
                    TAU * turns
                };
                Vec3::new(a * across, b * across, cosine)
            }
            Self::Equisolid(sine) => {
                let s = square * (sine * sine);
                let across = 2.0 * sine * (1.0 - s).max(0.0).sqrt();
                Vec3::new(a * across, b * across, 1.0 - 2.0 * s)
            }
            Self::Hemispherical(sine) => {
                let ahead = (1.0 - square * (sine * sine)).max(0.0).sqrt();
                Vec3::new(a * sine, b * sine, ahead)
            }
        };
        Some((Vec3::ZERO, towards))
    }
}

impl Optics {
    pub fn new(camera: &Camera) -> Self {
        let frame = camera.frame();
        let axis = |axis: Direction| {
            let Vector { x, y, z } = axis.to_vector();
            Vec3::new(x as f32, y as f32, z as f32)
        };
        let (middle, scale) = camera.middle_and_scale();
        Self {
            axes: [frame.tangent(), frame.bitangent(), frame.normal()].map(axis),
            scale: scale.map(|scale| (1.0 / scale) as f32),
            offset: std::array::from_fn(|axis| (-middle[axis] / scale[axis]) as f32),
            mapping: Mapping::new(camera.projection()),
        }
    }

    /// Whether rays start all over a lens, whose places take two numbers.
    pub fn has_lens(&self) -> bool {
        matches!(self.mapping, Mapping::ThinLens { .. })
    }

    /// Start, from the camera's position, and direction of the ray of a film position; `None` outside an image circle.
    #[inline(always)]
    pub fn ray(&self, x: f32, y: f32, numbers: [f32; 2]) -> Option<(Vec3, Vec3)> {
        let (a, b) = (
            x * self.scale[0] + self.offset[0],
            y * self.scale[1] + self.offset[1],
        );
        let (start, towards) = self.mapping.ray(a, b, numbers)?;
        Some((self.to_world(start), self.to_world(towards)))
    }

    #[inline(always)]
    fn to_world(&self, local: Vec3) -> Vec3 {
        self.axes[0] * local.x + self.axes[1] * local.y + self.axes[2] * local.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::quantity::{Angle, Length};
    use crate::sampling::block;

    fn projections() -> Vec<Projection> {
        let fisheye = |mapping, fov| Projection::Fisheye {
            mapping,
            fov: Angle::from_degrees(fov),
        };
        vec![
            Projection::Perspective {
                fov: Angle::from_degrees(110.0),
            },
            Projection::ThinLens {
                fov: Angle::from_degrees(40.0),
                aperture_radius: Length::from_metres(0.1),
                focus_distance: Length::from_metres(1.5),
            },
            Projection::Orthographic {
                width: Length::from_metres(3.0),
            },
            Projection::Panorama,
            fisheye(Fisheye::Equidistant, 180.0),
            fisheye(Fisheye::Equidistant, 360.0),
            fisheye(Fisheye::Equisolid, 200.0),
            fisheye(Fisheye::Hemispherical, 180.0),
            fisheye(Fisheye::Hemispherical, 30.0),
        ]
    }

    /// The plane's coordinates are rounded to 2⁻²⁴ of its size, and a few more operations follow: a ray of f32 differs by at
    /// most 1e-6. In a hemispherical picture dθ/dr = sin(fov/2)/cosθ magnifies that towards the rim.
    #[test]
    fn rays_are_those_of_the_camera() {
        let (eye, target) = (Point::new(3.0, -2.0, 1.5), Point::new(0.3, 1.0, 1.0));
        for projection in projections() {
            let up = Vector::new(0.0, 0.0, 1.0);
            let camera = Camera::new(eye, target, up, projection, [640, 480]).unwrap();
            let optics = Optics::new(&camera);
            for index in 0..4000 {
                let [x, y, u, v] = block::sample(5, index, 0);
                let (x, y) = (640.0 * x, 480.0 * y);
                let lens = warp::disc(u, v).map(f64::from);
                let found = optics.ray(x, y, [u, v]);
                let Some((start, towards)) = camera.ray([x, y].map(f64::from), lens) else {
                    assert!(found.is_none());
                    continue;
                };
                let (start, towards) = (start - eye, towards.to_vector());
                let found = found.unwrap();
                let differs = |found: Vec3, exact: Vector| {
                    (Vector::from(found.to_array().map(f64::from)) - exact).length()
                };
                assert!(differs(found.0, start) < 1e-6, "{projection:?} {x} {y}");
                let ahead = camera.frame().normal().dot(towards);
                let tolerance = match projection {
                    Projection::Fisheye {
                        mapping: Fisheye::Hemispherical,
                        ..
                    } => 1e-6 / ahead.max(1e-3),
                    _ => 1e-6,
                };
                assert!(
                    differs(found.1, towards) < tolerance,
                    "{projection:?} {x} {y}"
                );
                assert!((found.1.length() - 1.0).abs() < 1e-6);
            }
        }
    }
}
