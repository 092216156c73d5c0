//! Receivers of irradiance: points, grids and points spread over shapes, and the surfaces they lie on.

use std::ops::Range;

use steradian_kernel::{HitBatch, InstructionSet, MISS, RayBatch};

use super::description::{Receivers, Side};
use super::grids::layout_of;
use super::sensors::Context;
use super::{Fault, Scene};
use crate::geometry::{Direction, Point, Vector};
use crate::sampling::{block, hash};
use crate::sensor::{Layout, Places, Receiver, SitsOn};
use crate::shape::{Form, ShapeId, Surfaces};

/// Points a sensor may have.
const MAX_POINTS: u64 = 10_000_000;

/// Draws for each point that is wanted on a shape with openings.
const DRAWS_PER_POINT: u32 = 64;

impl Scene {
    /// Points of a sensor with what they lie on.
    pub fn receivers(&self, places: &Places, numbers: Range<usize>) -> Vec<Receiver> {
        let surfaces = (&self.surfaces, &self.shape_names[..]);
        on_surfaces(surfaces, places.range(numbers))
    }
}

impl Context<'_> {
    /// Where the points of the sensor of this name are.
    pub(super) fn places(&self, receivers: &Receivers, sensor: &str) -> Result<Places, Fault> {
        let (key, places) = match receivers {
            Receivers::Points(points) => ("points", Places::Listed(given(points)?)),
            Receivers::Grid { normal, .. } => {
                let layout = layout_of(receivers)?;
                let cells = layout.map(|layout| grid(layout, *normal)).transpose()?;
                ("grid", cells.unwrap_or(Places::Listed(vec![])))
            }
            Receivers::Shape {
                shape,
                side,
                count,
                offset,
            } => {
                check_count("count", u64::from(*count))?;
                let points = self.spread(shape, *side, *count, *offset, sensor)?;
                ("offset", Places::Listed(points))
            }
        };
        if places.is_empty() || places.iter().any(|(point, _)| !point.is_finite()) {
            return Err(no_points(key));
        }
        Ok(places)
    }

    /// The same with what they lie on.
    pub(super) fn receivers(
        &self,
        receivers: &Receivers,
        sensor: &str,
    ) -> Result<Vec<Receiver>, Fault> {
        let surfaces = (self.surfaces, &self.forms.names[..]);
        let places = self.places(receivers, sensor)?;
        Ok(on_surfaces(surfaces, places.iter()))
    }

    /// Points of uniform density by area, the same in every run.
    fn spread(
        &self,
        shape: &str,
        side: Side,
        count: u32,
        offset: f64,
        sensor: &str,
    ) -> Result<Vec<(Point, Direction)>, Fault> {
        let shapes = self.shapes(shape)?;
        let area = |id: &ShapeId| self.surfaces.shape(*id).form.sampling_area();
        let total: f64 = shapes.iter().map(area).sum();
        let key = hash::key_of_name(sensor);
        let draw = |index: u32| {
            let [u, v, choice, _] = block::sample(key, index, 0).map(f64::from);
            let mut rest = choice * total;
            let chosen = shapes.iter().find(|id| {
                rest -= area(id);
                rest < 0.0
            })?;
            let form = &self.surfaces.shape(*chosen).form;
            on_side(form, side, offset, [u, v])
        };
        let draws = 0..count.saturating_mul(DRAWS_PER_POINT);
        let points: Vec<_> = draws.filter_map(draw).take(count as usize).collect();
        if points.len() < count as usize {
            return Err(("shape", format!("points cannot be spread over `{shape}`")));
        }
        Ok(points)
    }
}

/// Surfaces with the names of their shapes.
type Named<'a> = (&'a Surfaces, &'a [String]);

/// Looks from a little above each point back down for the surface it lies on.
fn on_surfaces(
    (surfaces, names): Named<'_>,
    points: impl Iterator<Item = (Point, Direction)> + Clone,
) -> Vec<Receiver> {
    let mut rays = RayBatch::default();
    for (point, normal) in points.clone() {
        let reach = surfaces.clearance_at(point);
        let start = point + normal.to_vector() * reach;
        let down = (-normal.to_vector()).to_array().map(|x| x as f32);
        rays.push(surfaces.to_kernel(start), down, 2.0 * reach as f32);
    }
    let mut hits = HitBatch::default();
    surfaces.closest(&rays, &mut hits, InstructionSet::detect());
    let found = hits.primitive.iter().zip(points);
    found
        .map(|(&primitive, place)| receiver((surfaces, names), place, primitive))
        .collect()
}

fn receiver(
    (surfaces, names): Named<'_>,
    (position, normal): (Point, Direction),
    primitive: u32,
) -> Receiver {
    if primitive == MISS {
        return Receiver {
            position,
            normal,
            sits_on: None,
            clearance: 0.0,
        };
    }
    let id = surfaces.shape_of(primitive);
    let front = normal.dot(surfaces.normal_at(primitive, position)) > 0.0;
    Receiver {
        position,
        normal,
        sits_on: Some(SitsOn {
            shape: names[id.0 as usize].clone(),
            side: if front { "front" } else { "back" }.into(),
        }),
        clearance: surfaces.clearance_at(position),
    }
}

fn on_side(form: &Form, side: Side, offset: f64, u: [f64; 2]) -> Option<(Point, Direction)> {
    let sample = form.sample_area(u)?;
    let normal = match side {
        Side::Front => sample.normal,
        Side::Back => -sample.normal,
    };
    Some((sample.point + normal.to_vector() * offset, normal))
}

/// What to say of a sensor without usable points.
pub(super) fn no_points(key: &'static str) -> Fault {
    let message = "give at least one point, with finite coordinates";
    (key, message.into())
}

/// A direction that must not be zero.
pub(super) fn direction_of(key: &'static str, vector: Vector) -> Result<Direction, Fault> {
    let message = "a normal or direction is finite and not zero";
    Direction::new(vector).map_err(|_| (key, message.into()))
}

fn check_count(key: &'static str, count: u64) -> Result<(), Fault> {
    if (1..=MAX_POINTS).contains(&count) {
        return Ok(());
    }
    let message = format!("a sensor has 1 to {MAX_POINTS} points, not {count}");
    Err((key, message))
}

fn given(points: &[(Point, Vector)]) -> Result<Vec<(Point, Direction)>, Fault> {
    let point =
        |&(position, normal): &(Point, Vector)| Ok((position, direction_of("points", normal)?));
    points.iter().map(point).collect()
}

/// Centres of a grid's cells.
fn grid(layout: Layout, normal: Option<Vector>) -> Result<Places, Fault> {
    check_count("count", layout.cells())?;
    let [first, second] = layout.edges.map(Vector::from);
    let normal = direction_of("grid", normal.unwrap_or(first.cross(second)))?;
    Ok(Places::Grid { layout, normal })
}
