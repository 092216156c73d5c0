//! Balls around what paths from lights are sent to.

use crate::geometry::{Bounds, Direction, Point};
use crate::shape::Form;

/// What a shape fits into.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    pub center: Point,
    pub radius: f64,
}

impl Ball {
    /// Around a shape, `margin` wider; `None` around a plane.
    pub fn around(form: &Form, margin: f64) -> Option<Self> {
        let ball = match form {
            Form::Sphere(sphere) => Self::new(sphere.center, sphere.radius),
            Form::Disc(disc) => Self::new(disc.center, disc.radius),
            Form::Parallelogram(form) => Self::around_points(&form.corners())?,
            Form::Mesh(mesh) => Self::around_points(&mesh.vertices)?,
            Form::Plane { .. } => return None,
        };
        Some(Self::new(ball.center, ball.radius + margin))
    }

    /// Around balls; `None` if one of them is that of a plane.
    pub fn around_all(balls: impl Iterator<Item = Option<Self>>) -> Option<Self> {
        let balls = balls.collect::<Option<Vec<_>>>()?;
        let centers: Vec<_> = balls.iter().map(|ball| ball.center).collect();
        let center = Self::around_points(&centers)?.center;
        let reach = |ball: &Self| (ball.center - center).length() + ball.radius;
        let radius = balls.iter().map(reach).fold(0.0, f64::max);
        Some(Self::new(center, radius))
    }

    fn new(center: Point, radius: f64) -> Self {
        Self { center, radius }
    }

    fn around_points(points: &[Point]) -> Option<Self> {
        let center = Bounds::around(points.iter().copied()).center()?;
        let reach = points.iter().map(|point| (*point - center).length());
        Some(Self::new(center, reach.fold(0.0, f64::max)))
    }

    /// How far from the middle, against parallel light, a form may stop what comes to the ball.
    pub fn upstream(&self, form: &Form, direction: Direction) -> f64 {
        let Form::Plane { point, normal } = form else {
            let corners = form.bounds().map(|bounds| bounds.corners());
            let way = |corner: Point| (self.center - corner).dot(direction.to_vector());
            return corners.into_iter().flatten().map(way).fold(0.0, f64::max);
        };
        let slope = normal.dot(direction);
        if slope == 0.0 {
            return 0.0;
        }
        let tilt = (1.0 - slope * slope).max(0.0).sqrt() / slope.abs();
        (self.center - *point).dot(normal.to_vector()) / slope + self.radius * tilt
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    #[test]
    fn parallel_light_starts_before_planes_that_cross_it() {
        let ball = Ball::new(Point::new(0.0, 0.0, 5.0), 1.0);
        let ground = Form::Plane {
            point: Point::ORIGIN,
            normal: Direction::Z,
        };
        let up = Direction::new(Vector::new(0.6, 0.0, 0.8)).unwrap();
        // 5 m above it along a slope of .8; the ball's rim is .6/.8 of its radius further.
        assert!((ball.upstream(&ground, up) - (5.0 / 0.8 + 0.75)).abs() < 1e-12);
        assert!(ball.upstream(&ground, -up) < 0.0, "behind it");
    }

    #[test]
    fn a_ball_around_balls_holds_them() {
        let [a, b] = [0.0, 4.0].map(|x| Ball::new(Point::new(x, 0.0, 0.0), 1.0));
        let all = Ball::around_all([Some(a), Some(b)].into_iter()).unwrap();
        assert_eq!((all.center, all.radius), (Point::new(2.0, 0.0, 0.0), 3.0));
        assert!(Ball::around_all([Some(a), None].into_iter()).is_none());
    }
}
