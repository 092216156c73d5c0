//! Where paths from lights begin: aimed at polished shapes, each light at each shape by itself.
//!
//! A path that is sent to a shape counts only if that is what it meets first; so lights and shapes divide all paths among them, however the
//! shapes' balls overlap. A light at a point sends into the cone that the ball around a shape subtends (a beam narrower than that into
//! the beam) or to the points of a rectangle, parallel light through the disc of that ball or through a parallelogram:
//!
//! Φ = I(d) ω/P or E A/P
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | I, E | intensity in the direction drawn; irradiance facing the light | W/sr, W/m² |
//! | ω, A | solid angle of the cone, area of the disc | sr, m² |
//! | P | probability of this light and shape | 1 |
//!
//! For a point, a part of the paths from a light at a point to a plane is [aimed](super::focus) at its image; ω is then the inverse of the density of both.
//!
//! P goes by the flux that the light sends into the cone in the mean over all its directions, a tenth of it evenly. An infinite plane takes all
//! directions of a light at a point; parallel light is not sent there.

use std::f64::consts::PI;

use glam::Vec3;

use super::ball::{Ball, Obstacles};
use super::bundle::{Bundle, Panel, Target};
use super::focus::{Focus, Plane};
use crate::geometry::Vector;
use crate::material::Site;
use crate::sampling::discrete::Discrete;
use crate::shape::{Form, ShapeId};
use crate::spectrum::Wavelengths;
use crate::transport::tables::{Emitter, EmitterShape, Lanes4, Tables};
use crate::transport::unsampled::{is_out_of_reach, polished_shapes};

/// More pairs of lights and shapes than this are not told apart: each light is sent to all shapes at once.
const PAIRS: usize = 1 << 16;
/// The part of all paths that is dealt out evenly.
const EVENLY: f64 = 0.1;
/// The part of the paths to a plane, for a point, that are aimed at its image.
const FOCUSED: f64 = 0.25;

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
    /// Of the target.
    plane: Option<Plane>,
}

/// How a path begins.
pub(super) struct Start {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    pub flux: Lanes4,
    /// Of the light.
    pub group: u32,
    pub target: Option<ShapeId>,
}

impl Aims {
    /// `None` if there is no such light or nothing polished that it could be sent to.
    pub fn new(tables: &Tables<'_>) -> Option<Self> {
        Self::up_to(PAIRS, tables)
    }

    /// With so many pairs at most that are told apart.
    fn up_to(pairs: usize, tables: &Tables<'_>) -> Option<Self> {
        let surfaces = tables.scene.surfaces();
        let lamps = tables.extended..tables.emitters.len();
        if lamps.is_empty() {
            return None;
        }
        let obstacles = Obstacles::new(surfaces);
        let targets = targets(tables, lamps.len(), pairs);
        let of_lamp = |emitter: usize| {
            let light = &tables.scene.lights()[tables.emitters[emitter].light];
            let is_near = !is_out_of_reach(tables.scene, light);
            let obstacles = &obstacles;
            let aim = move |target: &Target| {
                let bundle = Bundle::new((surfaces, obstacles), light, target)?;
                Some(Aim {
                    emitter,
                    target: target.shape,
                    bundle,
                    plane: target.plane,
                })
            };
            targets.iter().filter(move |_| is_near).filter_map(aim)
        };
        let aims: Vec<_> = lamps.flat_map(of_lamp).collect();
        let weights: Vec<_> = aims.iter().map(|aim| aim.weight(tables)).collect();
        let even = EVENLY * weights.iter().sum::<f64>() / weights.len() as f64;
        let weights = weights.iter().map(|weight| (1.0 - EVENLY) * weight + even);
        let choice = Discrete::new(&weights.collect::<Vec<_>>())?;
        Some(Self { aims, choice })
    }

    /// A path from one of the lights, maybe for a point in kernel coordinates.
    pub(super) fn sample(
        &self,
        tables: &Tables<'_>,
        [choice, u, v, part]: [f32; 4],
        point: Option<Vec3>,
        waves: &Wavelengths,
    ) -> Option<Start> {
        let choice = self.choice.choose(choice);
        let aim = &self.aims[choice.index];
        let (origin, direction, measure) = aim.ray([u, v], part, point);
        let emitter = &tables.emitters[aim.emitter];
        let measure = measure / choice.probability;
        let factor = factor(tables, emitter, direction) * measure as f32;
        let power = tables.lanes_at(&emitter.power, waves, || Site::NOWHERE);
        (factor > 0.0).then(|| Start {
            origin,
            direction: direction.into(),
            flux: power.map(|lane| lane * factor),
            group: emitter.group,
            target: aim.target,
        })
    }
}

/// Polished shapes with balls around them, or all of them at once.
fn targets(tables: &Tables<'_>, lamps: usize, pairs: usize) -> Vec<Target> {
    let surfaces = tables.scene.surfaces();
    let shapes = polished_shapes(tables.scene);
    let ball = |id: &ShapeId| Ball::around(&surfaces.shape(*id).form, surfaces.clearance());
    let target = |id: &ShapeId| {
        let ball = ball(id);
        Target {
            shape: Some(*id),
            panel: panel(&surfaces.shape(*id).form),
            plane: Plane::of(&surfaces.shape(*id).form, surfaces),
            has_planes: ball.is_none(),
            ball,
        }
    };
    if shapes.len() * lamps <= pairs {
        return shapes.iter().map(target).collect();
    }
    let balls: Vec<_> = shapes.iter().filter_map(ball).collect();
    vec![Target {
        shape: None,
        ball: Ball::around_all(&balls),
        panel: None,
        plane: None,
        has_planes: balls.len() < shapes.len(),
    }]
}

fn panel(form: &Form) -> Option<Panel> {
    match form {
        Form::Parallelogram(form) => Some(Panel {
            corner: form.origin,
            edges: form.edges,
        }),
        _ => None,
    }
}

impl Aim {
    /// Start and direction of a ray, and the inverse of the density with which it is drawn.
    fn ray(&self, u: [f32; 2], part: f32, point: Option<Vec3>) -> ([f32; 3], Vec3, f64) {
        let unit = |direction: [f32; 3]| Vec3::from_array(direction).normalize();
        let measure = self.bundle.measure();
        let Some((apex, focus)) = point.and_then(|point| self.focus(point)) else {
            let (origin, direction) = self.bundle.sample(u);
            return (origin, unit(direction), measure);
        };
        let direction = if part < FOCUSED as f32 {
            unit(focus.sample(u).to_array().map(|x| x as f32))
        } else {
            unit(self.bundle.sample(u).1)
        };
        let density = focus.density(double(direction));
        let density = (1.0 - FOCUSED) / measure + FOCUSED * density;
        (apex, direction, 1.0 / density)
    }

    fn focus(&self, point: Vec3) -> Option<([f32; 3], Focus)> {
        let apex = self.bundle.apex()?;
        let focus = self
            .plane?
            .focus(double(Vec3::from_array(apex)), double(point))?;
        Some((apex, focus))
    }

    /// Proportional to the flux that the light sends here if it sends as much in all its directions.
    fn weight(&self, tables: &Tables<'_>) -> f64 {
        let emitter = &tables.emitters[self.emitter];
        let whole = match &emitter.shape {
            EmitterShape::Spot { beam, .. } => beam.solid_angle().to_steradians(),
            EmitterShape::Directional { .. } => {
                let bounds = tables.scene.surfaces().bounds();
                let extent = bounds.map_or(1.0, |all| all.diagonal().to_metres());
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

fn double(vector: Vec3) -> Vector {
    Vector::from(vector.to_array().map(f64::from))
}

#[cfg(test)]
mod tests;
