//! Lights that no sensor can see, because a closed surface lies between.
//!
//! The test is one-sided: a light is named only if a shape of the scene that is closed and opaque has all of the light on one side and all
//! sensors on the other, as a sun outside a room without windows. Then not even reflected light passes. A light that is hidden in any
//! other way is not found; no light is named that any sensor could see. Light from infinitely far away is outside of every
//! closed surface. A light or sensor with extent counts as the convex hull of its corners.

use super::Scene;
use crate::geometry::Point;
use crate::light::{Kind as LightKind, Light};
use crate::sensor::{Camera, FluxSurface, Kind as SensorKind, Projection, Sensor};
use crate::shape::{Enclosure, Form, ShapeId, Side};

/// Points of one sensor or light beyond which the test is not made, as each is held against all of the surface.
const MOST_POINTS: usize = 4096;

/// A light that no sensor can see.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub struct Unseen {
    /// Number of the light.
    pub light: usize,
    /// The closed shape that separates it from all sensors.
    pub shape: ShapeId,
    /// The side of the shape that the light is on.
    pub side: Side,
}

impl Scene {
    /// The lights that no sensor can see, each with the first shape that hides it; none if any material lets light pass.
    pub fn unseen_lights(&self) -> Vec<Unseen> {
        if !self.is_opaque || self.sensors.is_empty() {
            return Vec::new();
        }
        let mut unseen: Vec<Unseen> = Vec::new();
        for (number, placed) in (0..).zip(self.surfaces().shapes()) {
            let Some(enclosure) = Enclosure::of(&placed.form, self.surfaces().clearance()) else {
                continue;
            };
            let hidden = self.hidden_by(ShapeId(number), &enclosure);
            unseen.extend(
                hidden
                    .filter(|one| unseen.iter().all(|other| other.light != one.light))
                    .collect::<Vec<_>>(),
            );
        }
        unseen.sort_by_key(|one| one.light);
        unseen
    }

    fn hidden_by<'a>(
        &'a self,
        shape: ShapeId,
        enclosure: &'a Enclosure<'_>,
    ) -> impl Iterator<Item = Unseen> + 'a {
        let sensors = self.side_of_sensors(enclosure);
        let lights = self.lights().iter().enumerate();
        lights.filter_map(move |(light, description)| {
            let side = self.side_of_light(enclosure, description)?;
            (side != sensors?).then_some(Unseen { light, shape, side })
        })
    }

    /// The side that all sensors are on.
    fn side_of_sensors(&self, enclosure: &Enclosure) -> Option<Side> {
        let mut sides = self.sensors().iter().flat_map(|sensor| self.hulls(sensor));
        let first = enclosure.side_of_hull(&sides.next()?)?;
        sides
            .all(|hull| enclosure.side_of_hull(&hull) == Some(first))
            .then_some(first)
    }

    fn side_of_light(&self, enclosure: &Enclosure, light: &Light) -> Option<Side> {
        match &light.kind {
            LightKind::Point(point) => enclosure.side_of(point.position),
            LightKind::Spot(spot) => enclosure.side_of(spot.position),
            LightKind::Directional { .. } | LightKind::Environment { .. } => Some(Side::Outside),
            LightKind::Area(area) => {
                enclosure.side_of_hull(&corners(&self.surfaces().shape(area.shape).form)?)
            }
        }
    }

    /// Sets of points whose convex hulls contain all places where a sensor's rays start.
    fn hulls(&self, sensor: &Sensor) -> Vec<Vec<Point>> {
        let unknown = || vec![vec![]];
        match &sensor.kind {
            SensorKind::Irradiance(receivers) if receivers.len() <= MOST_POINTS => {
                let off = 4.0 * self.surfaces().clearance();
                let start = |receiver: &crate::sensor::Receiver| {
                    vec![receiver.position + receiver.normal * off.max(receiver.clearance)]
                };
                receivers.iter().map(start).collect()
            }
            SensorKind::ScalarIrradiance(points) if points.len() <= MOST_POINTS => {
                points.iter().map(|point| vec![*point]).collect()
            }
            SensorKind::Radiance(rays) if rays.len() <= MOST_POINTS => {
                rays.iter().map(|ray| vec![ray.0]).collect()
            }
            SensorKind::Flux { surface, .. } => match surface {
                FluxSurface::Virtual(form) => vec![corners(form).unwrap_or_default()],
                FluxSurface::Shapes { shapes, .. } => {
                    let form = |id: &ShapeId| corners(&self.surfaces().shape(*id).form);
                    shapes
                        .iter()
                        .map(|id| form(id).unwrap_or_default())
                        .collect()
                }
            },
            SensorKind::Camera(camera) => vec![lens(camera)],
            _ => unknown(),
        }
    }
}

/// Points whose convex hull contains a form; `None` for an infinite one.
fn corners(form: &Form) -> Option<Vec<Point>> {
    match form {
        Form::Parallelogram(form) => Some(form.corners().to_vec()),
        Form::Mesh(mesh) if mesh.vertices.len() <= MOST_POINTS => Some(mesh.vertices.clone()),
        _ => form.bounds().map(|bounds| bounds.corners().to_vec()),
    }
}

/// Points whose convex hull contains the starts of a camera's rays.
fn lens(camera: &Camera) -> Vec<Point> {
    let [right, down] = [camera.frame().tangent(), camera.frame().bitangent()];
    let reach = match camera.projection() {
        Projection::ThinLens {
            aperture_radius, ..
        } => [aperture_radius.to_metres(); 2],
        Projection::Orthographic { width } => {
            let [columns, rows] = camera.resolution.map(f64::from);
            // Two pixels more on each side, as filters reach beyond the borders.
            let pixel = width.to_metres() / columns;
            [columns, rows].map(|pixels| (0.5 * pixels + 2.0) * pixel)
        }
        Projection::Perspective { .. } | Projection::Panorama | Projection::Fisheye { .. } => {
            return vec![camera.position];
        }
    };
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    signs
        .map(|(a, b)| camera.position + right * (a * reach[0]) + down * (b * reach[1]))
        .to_vec()
}
