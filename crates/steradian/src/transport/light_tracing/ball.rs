//! Balls around what paths from lights are sent to, and what may stop parallel light before.

use crate::geometry::{Bounds, Direction, Point};
use crate::shape::{Form, Surfaces};

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

    /// Around balls; `None` if there are none.
    pub fn around_all(balls: &[Self]) -> Option<Self> {
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
}

/// What may stop parallel light: the corners of all that is bounded, and planes.
pub(super) struct Obstacles<'a> {
    corners: Vec<Point>,
    planes: Vec<&'a Form>,
    farthest: f64,
}

/// Starts of parallel light are at most so many diagonals of the scene from its target, for the sake of f32. It matters where a plane that light nearly
/// grazes would stop it farther away.
const FARTHEST: f64 = 1e3;

impl<'a> Obstacles<'a> {
    pub fn new(surfaces: &'a Surfaces) -> Self {
        let bounds = surfaces.bounds();
        let forms = surfaces.shapes().iter().map(|shape| &shape.form);
        let planes = forms.filter(|form| matches!(form, Form::Plane { .. }));
        Self {
            corners: bounds.map_or(vec![], |bounds| bounds.corners().to_vec()),
            planes: planes.collect(),
            farthest: bounds.map_or(f64::MAX, |bounds| FARTHEST * bounds.diagonal().to_metres()),
        }
    }

    /// How far from the middle of a ball, against parallel light, something may stop what comes to it.
    pub fn upstream(&self, ball: &Ball, direction: Direction) -> f64 {
        let way = |corner: &Point| (ball.center - *corner).dot(direction.to_vector());
        let corners = self.corners.iter().map(way);
        let planes = self
            .planes
            .iter()
            .map(|form| crossing(form, ball, direction));
        let reach = corners.chain(planes).fold(ball.radius, f64::max);
        reach.min(self.farthest.max(ball.radius))
    }
}

/// Where against parallel light to a ball a plane crosses it last; nowhere if it is along it.
fn crossing(plane: &Form, ball: &Ball, direction: Direction) -> f64 {
    let Form::Plane { point, normal } = plane else {
        return 0.0;
    };
    let slope = normal.dot(direction);
    if slope == 0.0 {
        return 0.0;
    }
    let tilt = (1.0 - slope * slope).max(0.0).sqrt() / slope.abs();
    (ball.center - *point).dot(normal.to_vector()) / slope + ball.radius * tilt
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
        assert!((crossing(&ground, &ball, up) - (5.0 / 0.8 + 0.75)).abs() < 1e-12);
        assert!(crossing(&ground, &ball, -up) < 0.0, "behind it");
    }

    #[test]
    fn grazing_light_starts_within_reach() {
        let ground = Form::Plane {
            point: Point::ORIGIN,
            normal: Direction::Z,
        };
        let obstacles = Obstacles {
            corners: vec![],
            planes: vec![&ground],
            farthest: 1e4,
        };
        let ball = Ball::new(Point::new(0.0, 0.0, 1.0), 1.0);
        let along = Direction::new(Vector::new(1.0, 0.0, 1e-16)).unwrap();
        assert_eq!(obstacles.upstream(&ball, along), 1e4);
    }

    #[test]
    fn a_ball_around_balls_holds_them() {
        let [a, b] = [0.0, 4.0].map(|x| Ball::new(Point::new(x, 0.0, 0.0), 1.0));
        let all = Ball::around_all(&[a, b]).unwrap();
        assert_eq!((all.center, all.radius), (Point::new(2.0, 0.0, 0.0), 3.0));
        assert!(Ball::around_all(&[]).is_none());
    }
}
