//! Lights that no sensor can see, because a closed surface lies between.
//!
//! The test is one-sided: a light is named only if a shape of the scene that is closed and opaque has all of the light on one side and all
//! sensors on the other, as a sun outside a room without windows. Then not even reflected light passes. A light that is hidden in any
//! other way is not found; no light is named that any sensor could see. Light from infinitely far away is outside of every
//! closed surface. A light or sensor with extent counts as the convex hull of its corners.

use super::Scene;
use crate::geometry::Point;
use crate::light::{Kind as LightKind, Light};
use crate::sensor::{
    Camera, Cylinder, FluxSurface, Kind as SensorKind, Projection, Receiver, Sensor,
};
use crate::shape::{Enclosure, Form, ShapeId, Side};

/// Points beyond which a light or sensor with extent counts as its bounding box.
const MOST_CORNERS: usize = 64;
/// Pairs of a triangle and a point beyond which a shape is not asked, as each answer visits all triangles.
const MOST_PAIRS: usize = 2_000_000;

/// Points whose convex hull contains all places where something is; none if that is unknown.
type Hull = Vec<Point>;

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
        if !self.is_opaque {
            return Vec::new();
        }
        let search = Search::new(self);
        let shapes = (0..self.surfaces().shapes().len() as u32).map(ShapeId);
        let mut unseen: Vec<Unseen> = shapes.flat_map(|shape| search.hidden_by(shape)).collect();
        // The sort is stable, so that the first shape stays first.
        unseen.sort_by_key(|one| one.light);
        unseen.dedup_by_key(|one| one.light);
        unseen
    }
}

/// Where the lights and sensors are.
struct Search<'a> {
    scene: &'a Scene,
    /// Of each light; none for those that are infinitely far away.
    lights: Vec<Option<Hull>>,
    sensors: Vec<Hull>,
    /// Points of all hulls.
    points: usize,
}

impl<'a> Search<'a> {
    fn new(scene: &'a Scene) -> Self {
        let lights = scene.lights().iter().map(|light| place_of(scene, light));
        let lights: Vec<_> = lights.collect();
        let sensors = scene.sensors().iter();
        let sensors: Vec<_> = sensors.flat_map(|sensor| hulls(scene, sensor)).collect();
        let points = lights.iter().flatten().chain(&sensors).map(Vec::len).sum();
        Self {
            scene,
            lights,
            sensors,
            points,
        }
    }

    /// The lights that a shape hides from all sensors.
    fn hidden_by(&self, shape: ShapeId) -> Vec<Unseen> {
        let Some(enclosure) = self.enclosure(shape) else {
            return Vec::new();
        };
        let Some(seeing) = self.side_of_sensors(&enclosure) else {
            return Vec::new();
        };
        let side_of = |light: &Option<Hull>| match light {
            Some(hull) => enclosure.side_of_hull(hull),
            None => Some(Side::Outside),
        };
        let sides = self.lights.iter().map(side_of).enumerate();
        let hidden = sides.filter_map(|(light, side)| {
            let side = side.filter(|side| *side != seeing)?;
            Some(Unseen { light, shape, side })
        });
        hidden.collect()
    }

    /// The enclosure that a shape is, if there may be anything inside.
    fn enclosure(&self, shape: ShapeId) -> Option<Enclosure<'a>> {
        let surfaces = self.scene.surfaces();
        let form = &surfaces.shape(shape).form;
        let bounds = form.bounds()?;
        let is_within = |hull: &Hull| hull.first().is_some_and(|point| bounds.contains(*point));
        let mut hulls = self.lights.iter().flatten().chain(&self.sensors);
        let worth = match form {
            Form::Mesh(mesh) => mesh.triangles.len() * self.points <= MOST_PAIRS,
            _ => true,
        };
        (worth && hulls.any(is_within)).then(|| Enclosure::of(form, surfaces.clearance()))?
    }

    /// The side that all sensors are on.
    fn side_of_sensors(&self, enclosure: &Enclosure) -> Option<Side> {
        let mut sides = self.sensors.iter().map(|hull| enclosure.side_of_hull(hull));
        let first = sides.next()??;
        sides.all(|side| side == Some(first)).then_some(first)
    }
}

/// Where a light is; `None` if infinitely far away.
fn place_of(scene: &Scene, light: &Light) -> Option<Hull> {
    match &light.kind {
        LightKind::Point(point) => Some(vec![point.position]),
        LightKind::Spot(spot) => Some(vec![spot.position]),
        LightKind::Directional { .. }
        | LightKind::Environment { .. }
        | LightKind::EnvironmentMap { .. } => None,
        LightKind::Area(area) => Some(corners(&scene.surfaces().shape(area.shape).form)),
        LightKind::Luminaire(luminaire) => Some(match luminaire.surface() {
            Some((shape, _)) => corners(&scene.surfaces().shape(shape).form),
            None => vec![luminaire.position],
        }),
    }
}

/// Where all rays of a sensor start.
fn hulls(scene: &Scene, sensor: &Sensor) -> Vec<Hull> {
    let surfaces = scene.surfaces();
    match &sensor.kind {
        SensorKind::Irradiance(places) => {
            let receivers = scene.receivers(places, 0..places.len());
            // Off the surface that they may lie on.
            let off = |receiver: &Receiver| receiver.clearance.max(4.0 * surfaces.clearance());
            let start = |one: &Receiver| vec![one.position + one.normal * off(one)];
            receivers.iter().map(start).collect()
        }
        SensorKind::Cylindrical(cylinders) => {
            let start = |one: &Cylinder| vec![one.position + one.axis * one.clearance];
            cylinders.iter().map(start).collect()
        }
        SensorKind::ScalarIrradiance(points) => points.iter().map(|point| vec![*point]).collect(),
        SensorKind::Radiance(rays) => rays.iter().map(|ray| vec![ray.0]).collect(),
        SensorKind::Flux { surface, .. } => match surface {
            FluxSurface::Virtual(form) => vec![corners(form)],
            FluxSurface::Shapes { shapes, .. } => {
                let form = |id: &ShapeId| &surfaces.shape(*id).form;
                shapes.iter().map(|id| corners(form(id))).collect()
            }
        },
        SensorKind::Camera(camera) => vec![lens(camera)],
        SensorKind::Balance(_) => vec![],
    }
}

/// The corners of a form, or of its bounding box; none for an infinite one.
fn corners(form: &Form) -> Hull {
    match form {
        Form::Parallelogram(form) => form.corners().to_vec(),
        Form::Mesh(mesh) if mesh.vertices.len() <= MOST_CORNERS => mesh.vertices.clone(),
        _ => form
            .bounds()
            .map_or_else(Vec::new, |bounds| bounds.corners().to_vec()),
    }
}

/// Points whose convex hull contains the starts of a camera's rays.
fn lens(camera: &Camera) -> Hull {
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
