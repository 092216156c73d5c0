//! The rays from a light without extent to a polished shape: to the ball around it, or to a parallelogram itself.
//!
//! | bundle | of | drawn evenly by |
//! |---|---|---|
//! | cone | light at a point, to a ball | solid angle |
//! | window | light at a point, to a rectangle | solid angle |
//! | shaft | parallel light, to a ball | area facing the light |
//! | prism | parallel light, to a parallelogram | area facing the light |

use std::f64::consts::{PI, TAU};

use super::ball::{Ball, Obstacles};
use super::focus::Plane;
use crate::geometry::{Direction, Frame, Point, Vector};
use crate::light::{Beam, Kind, Light, Outlet};
use crate::sampling::spherical_rectangle::SphericalRectangle;
use crate::sampling::warp;
use crate::shape::{ShapeId, Surfaces};

/// What rays are sent to.
pub(super) struct Target {
    /// None: whatever is polished.
    pub shape: Option<ShapeId>,
    /// Around all of it that is bounded.
    pub ball: Option<Ball>,
    /// What it is, if it is a parallelogram.
    pub panel: Option<Panel>,
    /// The plane that it lies in, if it is known to.
    pub plane: Option<Plane>,
    /// Whether there are planes, of which only light at a point finds the polish.
    pub has_planes: bool,
}

/// A parallelogram.
#[derive(Clone, Copy)]
pub(super) struct Panel {
    pub corner: Point,
    pub edges: [Vector; 2],
}

/// Rays that are drawn evenly by solid angle or by area.
pub(super) enum Bundle {
    Cone(Cone),
    Window(Window),
    Shaft(Shaft),
    Prism(Prism),
}

/// From a point in kernel coordinates.
pub(super) struct Window {
    apex: [f32; 3],
    rectangle: SphericalRectangle,
}

/// From a parallelogram in kernel coordinates.
pub(super) struct Prism {
    corner: Vector,
    edges: [Vector; 2],
    direction: [f32; 3],
    /// Facing the light.
    area: f64,
}

/// From a point in kernel coordinates.
#[derive(Clone, Copy)]
pub(super) struct Cone {
    apex: [f32; 3],
    frame: Frame,
    one_minus_cos: f64,
}

/// Through a disc, along the normal of its frame, in kernel coordinates.
pub(super) struct Shaft {
    middle: Vector,
    frame: Frame,
    radius: f64,
}

impl Bundle {
    /// `None` where the light sends nothing to the ball, and for parallel light without one.
    pub fn new(
        (surfaces, obstacles): (&Surfaces, &Obstacles<'_>),
        light: &Light,
        target: &Target,
    ) -> Option<Self> {
        let from = |position: Point, start: Point, beam| {
            Self::from_point(surfaces, (position, start), beam, target)
        };
        match &light.kind {
            Kind::Point(light) => from(light.position, light.position, None),
            Kind::Spot(light) => {
                let beam = Some((light.axis, light.beam));
                from(light.position, light.position, beam)
            }
            Kind::Luminaire(light) => match light.outlet {
                Outlet::Point { end } => from(light.position, end, None),
                Outlet::Surface { .. } => None,
            },
            Kind::Directional { direction, .. } => {
                let ball = target.ball.as_ref()?;
                let reach = obstacles.upstream(ball, *direction) + surfaces.clearance();
                Some(Self::along(surfaces, *direction, (ball, reach), target))
            }
            _ => None,
        }
    }

    /// Of light at a point that rays leave from `start`.
    fn from_point(
        surfaces: &Surfaces,
        (position, start): (Point, Point),
        beam: Option<(Direction, Beam)>,
        target: &Target,
    ) -> Option<Self> {
        let apex = surfaces.to_kernel(start);
        let ball = target.ball.filter(|_| !target.has_planes);
        let cone = Cone::around(apex, ball.map(|ball| (ball.center - position, ball.radius)));
        let cone = Self::Cone(match beam {
            Some((axis, beam)) => cone.within(axis, cutoff(beam))?,
            None => cone,
        });
        let window = target.panel.and_then(|panel| {
            let way = (panel.corner - start).length();
            let panel = panel.wider(surfaces.clearance().max(ROUNDING_OF_WAYS * way));
            let rectangle = SphericalRectangle::new(panel.corner - start, panel.edges)?;
            Some(Self::Window(Window { apex, rectangle }))
        });
        let window = window.filter(|window| window.measure() < cone.measure());
        Some(window.unwrap_or(cone))
    }

    /// Of parallel light that starts so far before a ball.
    fn along(
        surfaces: &Surfaces,
        direction: Direction,
        (ball, reach): (&Ball, f64),
        target: &Target,
    ) -> Self {
        let Some(panel) = target.panel else {
            return Self::Shaft(Shaft::new(surfaces, direction, (ball, reach)));
        };
        let reach = reach + ball.radius;
        let panel = panel.wider(surfaces.clearance().max(ROUNDING_OF_WAYS * reach));
        Self::Prism(Prism::new(surfaces, direction, (panel, reach)))
    }

    /// Solid angle or area.
    pub fn measure(&self) -> f64 {
        match self {
            Self::Cone(cone) => TAU * cone.one_minus_cos,
            Self::Window(window) => window.rectangle.solid_angle().to_steradians(),
            Self::Shaft(shaft) => PI * shaft.radius * shaft.radius,
            Self::Prism(prism) => prism.area,
        }
    }

    /// Where all rays start, of light at a point.
    pub fn apex(&self) -> Option<[f32; 3]> {
        match self {
            Self::Cone(Cone { apex, .. }) | Self::Window(Window { apex, .. }) => Some(*apex),
            Self::Shaft(_) | Self::Prism(_) => None,
        }
    }

    /// Start and direction of a ray.
    pub fn sample(&self, [u, v]: [f32; 2]) -> ([f32; 3], [f32; 3]) {
        match self {
            Self::Cone(cone) => {
                let local = warp::cone(u, v, cone.one_minus_cos as f32);
                let local = Vector::from(local.map(f64::from));
                (cone.apex, single(cone.frame.vector_to_world(local)))
            }
            Self::Window(window) => {
                let way = window.rectangle.sample([u, v].map(f64::from));
                (window.apex, single(way))
            }
            Self::Prism(prism) => {
                let [a, b] = prism.edges;
                let start = prism.corner + a * f64::from(u) + b * f64::from(v);
                (single(start), prism.direction)
            }
            Self::Shaft(shaft) => {
                let [x, y] = warp::disc(u, v).map(f64::from);
                let offset = Vector::new(x, y, 0.0) * shaft.radius;
                let start = shaft.middle + shaft.frame.vector_to_world(offset);
                (single(start), single(shaft.frame.normal().to_vector()))
            }
        }
    }
}

impl Cone {
    /// Around a ball at this place from the apex; of all directions from within it, or without one.
    fn around(apex: [f32; 3], ball: Option<(Vector, f64)>) -> Self {
        let outside = ball.filter(|(axis, radius)| axis.length() > *radius);
        let cone = outside.and_then(|(axis, radius)| {
            let sine = radius / axis.length();
            let one_minus_cos = sine * sine / (1.0 + (1.0 - sine * sine).sqrt());
            let axis = Direction::new(axis).ok()?;
            Some((Frame::from_normal(axis), one_minus_cos))
        });
        let (frame, one_minus_cos) = cone.unwrap_or((Frame::from_normal(Direction::Z), 2.0));
        Self {
            apex,
            frame,
            one_minus_cos,
        }
    }

    /// The smaller of this cone and a beam; `None` if they do not meet.
    fn within(self, axis: Direction, cos_cutoff: f64) -> Option<Self> {
        let half_angles = libm::acos(1.0 - self.one_minus_cos) + libm::acos(cos_cutoff);
        let between = libm::acos(self.frame.normal().dot(axis).clamp(-1.0, 1.0));
        let beam = Self {
            frame: Frame::from_normal(axis),
            one_minus_cos: 1.0 - cos_cutoff,
            ..self
        };
        let is_narrower = beam.one_minus_cos < self.one_minus_cos;
        (between <= half_angles + ROUNDING).then_some(if is_narrower { beam } else { self })
    }
}

/// Of angles.
const ROUNDING: f64 = 1e-6;

impl Shaft {
    /// Through a ball, from so far before its middle.
    fn new(surfaces: &Surfaces, direction: Direction, (ball, reach): (&Ball, f64)) -> Self {
        Self {
            middle: ball.center - surfaces.origin() - direction * (reach + ball.radius),
            frame: Frame::from_normal(direction),
            radius: ball.radius,
        }
    }
}

/// Of the places to which rays in f32 lead, relative to the way.
const ROUNDING_OF_WAYS: f64 = 1.0 / (1 << 21) as f64;

impl Panel {
    /// The same with a margin.
    fn wider(self, margin: f64) -> Self {
        let [a, b] = self.edges;
        let sine = a.cross(b).length() / (a.length() * b.length());
        let step = |edge: Vector| edge * (margin / (sine * edge.length()));
        Self {
            corner: self.corner - step(a) - step(b),
            edges: [a, b].map(|edge| edge + step(edge) * 2.0),
        }
    }
}

impl Prism {
    /// Through a parallelogram, from so far before it.
    fn new(
        surfaces: &Surfaces,
        direction: Direction,
        (Panel { corner, edges }, reach): (Panel, f64),
    ) -> Self {
        Self {
            corner: corner - surfaces.origin() - direction * reach,
            edges,
            direction: single(direction.to_vector()),
            area: edges[0].cross(edges[1]).dot(direction.to_vector()).abs(),
        }
    }
}

fn cutoff(beam: Beam) -> f64 {
    match beam {
        Beam::Uniform { cos_cutoff }
        | Beam::CosinePower { cos_cutoff, .. }
        | Beam::Smooth { cos_cutoff, .. } => cos_cutoff,
    }
}

fn single(vector: Vector) -> [f32; 3] {
    vector.to_array().map(|x| x as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{Amount, Radiance};
    use crate::scene::Scene;
    use crate::scene::description::*;

    fn even_sky() -> Scene {
        let radiance = Radiance::from_watts_per_square_metre_steradian(1.0);
        let radiance = Amount::Radiant(radiance);
        let points = vec![Point::ORIGIN];
        let description = SceneDescription {
            lights: vec![LightDescription {
                name: None,
                group: None,
                spectrum: None,
                schedule: None,
                repeat: None,
                kind: LightKind::Environment { radiance },
            }],
            sensors: vec![SensorDescription {
                name: "E".into(),
                response: None,
                bins: None,
                kind: SensorKind::ScalarIrradiance { points },
            }],
            ..SceneDescription::default()
        };
        Scene::new(&description).unwrap()
    }

    /// Rays that leave a lamp beside where it is still reach all of a rectangle seen at a slant, and hardly more.
    #[test]
    fn a_window_is_that_of_where_rays_start() {
        let scene = even_sky();
        let panel = Panel {
            corner: Point::new(3.5, 0.0, 0.0),
            edges: [Vector::new(0.5, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0)],
        };
        let ball = Ball {
            center: Point::new(3.75, 0.5, 0.0),
            radius: 0.56,
        };
        let target = Target {
            shape: None,
            ball: Some(ball),
            panel: Some(panel),
            plane: None,
            has_planes: false,
        };
        let places = (Point::new(0.0, 0.5, 0.05), Point::new(0.001, 0.5, 0.05));
        let bundle = Bundle::from_point(scene.surfaces(), places, None, &target);
        let window = bundle.expect("the lamp shines everywhere");
        let met = |numbers: [f32; 2]| {
            let (start, way) = window.sample(numbers);
            start[0] - way[0] * start[2] / way[2]
        };
        let (near, far) = (met([0.0, 0.5]), met([1.0, 0.5]));
        let (near, far) = (near.min(far), near.max(far));
        let margin = scene.surfaces().clearance().max(4.0 * ROUNDING_OF_WAYS) as f32;
        assert!((3.5 - 4.0 * margin..3.5).contains(&near), "{near}");
        assert!((4.0..4.0 + 4.0 * margin).contains(&far), "{far}");
    }
}
