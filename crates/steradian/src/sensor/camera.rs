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

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let (eye, target) = (Point::new(1.0, 1.0, 1.0), Point::new(1.0, 5.0, 1.0));
        let up = Vector::new(0.0, 0.3, 2.0);
        Camera::new(eye, target, up, Angle::from_degrees(90.0), [400, 200]).unwrap()
    }

    #[test]
    fn the_middle_looks_ahead_and_the_edges_along_the_field_of_view() {
        let expected = [
            ([200.0, 100.0], [0.0, 1.0, 0.0]),
            ([400.0, 100.0], [1.0, 1.0, 0.0]),
            ([0.0, 100.0], [-1.0, 1.0, 0.0]),
            ([200.0, 0.0], [0.0, 1.0, 0.5]),
            ([200.0, 200.0], [0.0, 1.0, -0.5]),
        ];
        for (film, direction) in expected {
            let found = camera().direction(film);
            assert!(
                (found - Vector::from(direction)).length() < 1e-15,
                "{film:?}: {found:?}"
            );
        }
    }

    #[test]
    fn another_resolution_shows_the_same_view() {
        let small = camera().with_resolution([40, 20]);
        let difference = small.direction([7.0, 3.0]) - camera().direction([70.0, 30.0]);
        assert!(difference.length() < 1e-15);
        assert_eq!(small.axes(), camera().axes());
    }

    #[test]
    fn a_camera_needs_a_direction_and_an_up() {
        let fov = Angle::from_degrees(60.0);
        let new = |target, up| Camera::new(Point::ORIGIN, target, up, fov, [2, 2]);
        let (x, z) = (Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 0.0, 1.0));
        assert!(new(Point::ORIGIN, z).is_none());
        assert!(new(Point::ORIGIN + x, x * -2.0).is_none());
        assert!(new(Point::ORIGIN + x * f64::NAN, z).is_none());
    }
}
