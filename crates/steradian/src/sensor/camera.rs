//! A perspective camera: radiance arriving at a point through a plane of pixels.
//!
//! Pixel (x, y) of film position (f_x, f_y), in pixels from the upper left corner, looks along
//! w + (2f_x/W − 1)·tan(fov/2)·right − (2f_y/W − H/W)·tan(fov/2)·up, where fov is the full horizontal angle of view.

use crate::geometry::{Direction, Point, Vector};
use crate::quantity::Angle;

/// A perspective camera.
#[derive(Clone, Debug)]
pub struct Camera {
    /// The eye.
    pub position: Point,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    forward: Vector,
    right: Vector,
    up: Vector,
}

impl Camera {
    /// `None` when `look_at` is the position or `up` is along the view.
    pub fn new(
        position: Point,
        look_at: Point,
        up: Vector,
        fov: Angle,
        resolution: [u32; 2],
    ) -> Option<Self> {
        let forward = Direction::new(look_at - position).ok()?;
        let right = Direction::new(forward.to_vector().cross(up)).ok()?;
        let true_up = right.to_vector().cross(forward.to_vector());
        let half = libm::tan(0.5 * fov.to_radians());
        Some(Self {
            position,
            resolution,
            forward: forward.to_vector(),
            right: right.to_vector() * half,
            up: true_up * half,
        })
    }

    /// Direction (not normalised) through a film position in pixels.
    pub fn direction(&self, film: [f64; 2]) -> Vector {
        let [width, height] = self.resolution.map(f64::from);
        let x = 2.0 * film[0] / width - 1.0;
        let y = (2.0 * film[1] - height) / width;
        self.forward + self.right * x - self.up * y
    }

    /// The same view in another resolution.
    pub fn with_resolution(&self, resolution: [u32; 2]) -> Self {
        Self {
            resolution,
            ..self.clone()
        }
    }

    /// Forward, right and up vectors that [`direction`](Self::direction) combines.
    pub fn axes(&self) -> [Vector; 3] {
        [self.forward, self.right, self.up]
    }
}
