//! Where paths from lights begin: aimed at polished shapes, each light at each shape by itself.
//!
//! A path that is sent to a shape counts only if that is what it meets first; so lights and shapes divide all paths among them, however the
//! shapes' balls overlap. A light at a point sends into the cone that the ball around a shape subtends (a beam narrower than that into
//! the beam), parallel light through the disc of that ball:
//!
//! Φ = I(d) ω/P or E A/P
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | I, E | intensity in the direction drawn; irradiance facing the light | W/sr, W/m² |
//! | ω, A | solid angle of the cone, area of the disc | sr, m² |
//! | P | probability of this light and shape | 1 |
//!
//! P goes by the flux that the light sends into the cone in the mean over all its directions, a tenth of it evenly. An infinite plane takes all
//! directions of a light at a point; parallel light is not sent there.

use std::f64::consts::{PI, TAU};

use glam::Vec3;

use crate::geometry::{Bounds, Direction, Frame, Point, Vector};
use crate::light::{Beam, Kind, Light, Outlet};
use crate::sampling::discrete::Discrete;
use crate::sampling::warp;
use crate::shape::{Form, ShapeId};
use crate::spectrum::Wavelengths;
use crate::transport::tables::{Emitter, EmitterShape, Lanes4, Tables};
use crate::transport::unsampled::polished_shapes;

/// More pairs of lights and shapes than this are not told apart: each light is sent to all shapes at once.
const PAIRS: usize = 1 << 16;

/// All pairs of a light and what it is sent to.
pub(in crate::transport) struct Aims {
    aims: Vec<Aim>,
    choice: Discrete,
}

/// A light and a polished shape.
struct Aim {
    /// Number of the emitter.
    emitter: usize,
    /// None: whatever is polished.
    target: Option<ShapeId>,
    bundle: Bundle,
}

/// The rays from a light to a ball.
enum Bundle {
    /// From a point into a cone.
    Cone {
        apex: [f32; 3],
        frame: Frame,
        one_minus_cos: f64,
    },
    /// Through a disc.
    Parallel {
        middle: Vector,
        frame: Frame,
        radius: f64,
    },
}

/// How a path begins.
pub(super) struct Start {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    pub flux: Lanes4,
    pub target: Option<ShapeId>,
}

/// What a shape fits into: nothing smaller than all space for a plane.
#[derive(Clone, Copy)]
struct Ball {
    center: Point,
    radius: f64,
}

impl Aims {
    /// `None` if there is no such light or nothing polished that it could be sent to.
    pub fn new(tables: &Tables<'_>) -> Option<Self> {
        let surfaces = tables.scene.surfaces();
        let lamps: Vec<_> = (tables.extended..tables.emitters.len()).collect();
        let shapes = polished_shapes(tables.scene);
        let balls = shapes
            .iter()
            .map(|id| (Some(*id), ball(&surfaces.shape(*id).form)));
        let mut targets: Vec<_> = balls.collect();
        if targets.len() * lamps.len() > PAIRS {
            targets = vec![(None, around(targets.iter().map(|(_, ball)| *ball)))];
        }
        let pairs = lamps
            .iter()
            .flat_map(|lamp| targets.iter().map(move |target| (*lamp, target)));
        let aims = pairs.filter_map(|(emitter, (target, ball))| {
            let light = &tables.scene.lights()[tables.emitters[emitter].light];
            let bundle = Bundle::new(tables, light, ball.as_ref())?;
            Some(Aim {
                emitter,
                target: *target,
                bundle,
            })
        });
        let aims: Vec<_> = aims.collect();
        let weights: Vec<_> = aims.iter().map(|aim| aim.weight(tables)).collect();
        let total: f64 = weights.iter().sum();
        let floor = 0.1 * total / weights.len() as f64;
        let weights: Vec<_> = weights.iter().map(|weight| 0.9 * weight + floor).collect();
        Some(Self {
            choice: Discrete::new(&weights)?,
            aims,
        })
    }

    /// A path from one of the lights.
    pub(super) fn sample(
        &self,
        tables: &Tables<'_>,
        choice: f32,
        u: [f32; 2],
        waves: &Wavelengths,
    ) -> Option<Start> {
        let choice = self.choice.choose(choice);
        let aim = &self.aims[choice.index];
        let (origin, direction, measure) = aim.bundle.sample(u);
        let emitter = &tables.emitters[aim.emitter];
        let factor = factor(tables, emitter, direction) * (measure / choice.probability) as f32;
        let power = tables.lanes_at(&emitter.power, waves, || crate::material::Site::NOWHERE);
        (factor > 0.0).then(|| Start {
            origin,
            direction: direction.into(),
            flux: power.map(|lane| lane * factor),
            target: aim.target,
        })
    }
}

impl Aim {
    /// Proportional to the flux that the light sends here if it sends as much in all its directions.
    fn weight(&self, tables: &Tables<'_>) -> f64 {
        let emitter = &tables.emitters[self.emitter];
        let whole = match &emitter.shape {
            EmitterShape::Spot { beam, .. } => beam.solid_angle().to_steradians(),
            EmitterShape::Directional { .. } => {
                let extent = tables
                    .scene
                    .surfaces()
                    .bounds()
                    .map_or(1.0, |all| all.diagonal().to_metres());
                0.25 * PI * extent * extent
            }
            _ => 4.0 * PI,
        };
        f64::from(emitter.probability) * self.bundle.measure() / whole
    }
}

/// What the power of a light without extent is multiplied with in a direction.
fn factor(tables: &Tables<'_>, emitter: &Emitter, direction: Vec3) -> f32 {
    match &emitter.shape {
        EmitterShape::Spot { axis, beam, .. } => {
            beam.falloff(f64::from(direction.dot(Vec3::from_array(*axis)))) as f32
        }
        _ if emitter.is_directed => tables.factor(emitter, direction),
        _ => 1.0,
    }
}

impl Bundle {
    /// `None` where the light sends nothing, or nothing that this knows how to draw.
    fn new(tables: &Tables<'_>, light: &Light, ball: Option<&Ball>) -> Option<Self> {
        match &light.kind {
            Kind::Point(light) => Some(Self::cone(tables, light.position, light.position, ball)),
            Kind::Spot(light) => {
                let cone = Self::cone(tables, light.position, light.position, ball);
                cone.within(light.axis, cutoff(light.beam))
            }
            Kind::Luminaire(light) => match light.outlet {
                Outlet::Point { end } => Some(Self::cone(tables, light.position, end, ball)),
                Outlet::Surface { .. } => None,
            },
            Kind::Directional { direction, .. } => Some(Self::parallel(tables, *direction, ball?)),
            _ => None,
        }
    }

    fn cone(tables: &Tables<'_>, position: Point, start: Point, ball: Option<&Ball>) -> Self {
        let apex = tables.scene.surfaces().to_kernel(start);
        let towards = ball.map(|ball| (ball.center - position, ball.radius));
        let towards = towards.filter(|(axis, radius)| axis.length() > *radius);
        let narrow = towards.and_then(|(axis, radius)| {
            let sine = radius / axis.length();
            let one_minus_cos = sine * sine / (1.0 + (1.0 - sine * sine).sqrt());
            Some((
                Frame::from_normal(Direction::new(axis).ok()?),
                one_minus_cos,
            ))
        });
        let (frame, one_minus_cos) = narrow.unwrap_or((Frame::from_normal(Direction::Z), 2.0));
        Self::Cone {
            apex,
            frame,
            one_minus_cos,
        }
    }

    /// The smaller of this cone and a beam; `None` if they do not meet.
    fn within(self, axis: Direction, cos_cutoff: f64) -> Option<Self> {
        let Self::Cone {
            apex,
            frame,
            one_minus_cos,
        } = self
        else {
            return Some(self);
        };
        let half_angles = libm::acos(1.0 - one_minus_cos) + libm::acos(cos_cutoff);
        if libm::acos(frame.normal().dot(axis).clamp(-1.0, 1.0)) > half_angles + 1e-6 {
            return None;
        }
        Some(if 1.0 - cos_cutoff < one_minus_cos {
            let (frame, one_minus_cos) = (Frame::from_normal(axis), 1.0 - cos_cutoff);
            Self::Cone {
                apex,
                frame,
                one_minus_cos,
            }
        } else {
            self
        })
    }

    fn parallel(tables: &Tables<'_>, direction: Direction, ball: &Ball) -> Self {
        let surfaces = tables.scene.surfaces();
        let forms = surfaces.shapes().iter().map(|shape| &shape.form);
        let reach = forms
            .map(|form| upstream(form, direction, ball))
            .fold(ball.radius, f64::max);
        let clearance = ball.radius + surfaces.clearance();
        Self::Parallel {
            middle: ball.center - surfaces.origin() - direction * (reach + clearance),
            frame: Frame::from_normal(direction),
            radius: ball.radius,
        }
    }

    /// ω or A.
    fn measure(&self) -> f64 {
        match self {
            Self::Cone { one_minus_cos, .. } => TAU * one_minus_cos,
            Self::Parallel { radius, .. } => PI * radius * radius,
        }
    }

    /// A ray, and the measure of all.
    fn sample(&self, [u, v]: [f32; 2]) -> ([f32; 3], Vec3, f64) {
        let single = |v: Vector| [v.x, v.y, v.z].map(|x| x as f32);
        let (origin, direction) = match self {
            Self::Cone {
                apex,
                frame,
                one_minus_cos,
            } => {
                let local = warp::cone(u, v, *one_minus_cos as f32).map(f64::from);
                (*apex, frame.vector_to_world(Vector::from(local)))
            }
            Self::Parallel {
                middle,
                frame,
                radius,
            } => {
                let [x, y] = warp::disc(u, v).map(f64::from);
                let offset = frame.vector_to_world(Vector::new(x, y, 0.0));
                (
                    single(*middle + offset * *radius),
                    frame.normal().to_vector(),
                )
            }
        };
        (
            origin,
            Vec3::from_array(single(direction)).normalize(),
            self.measure(),
        )
    }
}

fn cutoff(beam: Beam) -> f64 {
    match beam {
        Beam::Uniform { cos_cutoff }
        | Beam::CosinePower { cos_cutoff, .. }
        | Beam::Smooth { cos_cutoff, .. } => cos_cutoff,
    }
}

/// How far from the middle of a ball, against the light, a form may stop what comes to the ball.
fn upstream(form: &Form, direction: Direction, to: &Ball) -> f64 {
    let along = |point: Point| (to.center - point).dot(direction.to_vector());
    match form {
        Form::Plane { point, normal } => {
            let slope = normal.dot(direction);
            let way = (to.center - *point).dot(normal.to_vector()) / slope;
            let tilt = (1.0 - slope * slope).max(0.0).sqrt() / slope.abs();
            if slope == 0.0 {
                0.0
            } else {
                way + to.radius * tilt
            }
        }
        _ => {
            let corners = form.bounds().map(|bounds| bounds.corners());
            corners.into_iter().flatten().map(along).fold(0.0, f64::max)
        }
    }
}

/// A ball around a shape; `None` around a plane.
fn ball(form: &Form) -> Option<Ball> {
    match form {
        Form::Sphere(sphere) => Some((sphere.center, sphere.radius)),
        Form::Disc(disc) => Some((disc.center, disc.radius)),
        Form::Parallelogram(form) => around_points(&form.corners()),
        Form::Mesh(mesh) => around_points(&mesh.vertices),
        Form::Plane { .. } => None,
    }
    .map(|(center, radius)| Ball {
        center,
        radius: radius * (1.0 + ROUNDING),
    })
}

/// By which a ball is larger than what it holds, whose coordinates are rounded to f32.
const ROUNDING: f64 = 1e-5;

fn around_points(points: &[Point]) -> Option<(Point, f64)> {
    let center = Bounds::around(points.iter().copied()).center()?;
    let squares = points.iter().map(|point| (*point - center).length());
    Some((center, squares.fold(0.0, f64::max)))
}

/// A ball around balls; `None` if there is a plane among them.
fn around(balls: impl Iterator<Item = Option<Ball>> + Clone) -> Option<Ball> {
    let all: Option<Vec<Ball>> = balls.collect();
    let all = all?;
    let (center, _) = around_points(&all.iter().map(|ball| ball.center).collect::<Vec<_>>())?;
    let reach = |ball: &Ball| (ball.center - center).length() + ball.radius;
    let radius = all.iter().map(reach).fold(0.0, f64::max);
    Some(Ball { center, radius })
}
