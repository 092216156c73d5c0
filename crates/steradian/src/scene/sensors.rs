//! Sensors: what they measure in world coordinates, and what they report.

use std::cell::LazyCell;

use super::cameras::camera_of;
use super::description::{
    self, Bins, Receivers, SceneDescription, SensorDescription, SensorKind, Side,
};
use super::forms::Forms;
use super::geometry::virtual_form;
use super::grids::layout_of;
use super::lights::Builder;
use super::receivers::{direction_of, no_points};
use super::spectral_readouts;
use super::{Fault, Part, Problem};
use crate::geometry::{Direction, Point, Vector};
use crate::sensor::readout::Quantity;
use crate::sensor::{
    Cylinder, FluxOf, FluxSurface, Kind, Layout, Readout, Receiver, Response, Sensor, readout,
};
use crate::shape::{ShapeId, Solid, Surfaces};
use crate::spectrum::Lanes;

/// What preparing a sensor needs to know.
pub(super) struct Context<'a> {
    pub lanes: &'a Lanes,
    pub efficacy: f64,
    pub surfaces: &'a Surfaces,
    pub forms: &'a Forms,
    pub lights: &'a Builder<'a>,
    pub description: &'a SceneDescription,
}

pub(super) fn prepare(context: &Context, problems: &mut Vec<Problem>) -> Vec<Sensor> {
    let descriptions = &context.description.sensors;
    let mut sensors = Vec::new();
    for (index, description) in descriptions.iter().enumerate() {
        let (part, name) = (Part::Sensor(index), &description.name);
        if descriptions[..index]
            .iter()
            .any(|other| other.name == *name)
        {
            let message = format!("sensor `{name}` is defined twice");
            problems.push(Problem::at(part, "name", message));
        }
        if context.needs_failed_shape(&description.kind) {
            continue;
        }
        match context.sensor(description) {
            Ok(sensor) => sensors.push((index, sensor)),
            Err((key, message)) => problems.push(Problem::at(part, key, message)),
        }
    }
    context.check_positions(&sensors, problems);
    sensors.into_iter().map(|(_, sensor)| sensor).collect()
}

/// Whether a reading of `sensors` depends on the link between watts and lumens.
pub(super) fn crosses(sensors: &[Sensor], lights: &Builder) -> bool {
    let reads = |photometric| {
        sensors.iter().any(|sensor| {
            sensor
                .readouts
                .iter()
                .any(|readout| readout.photometric == photometric)
        })
    };
    (lights.any_radiant && reads(true)) || (lights.any_photometric && reads(false))
}

impl Context<'_> {
    fn sensor(&self, description: &SensorDescription) -> Result<Sensor, Fault> {
        let kind = self.kind(description)?;
        let readouts = self.readouts(&kind, description)?;
        Ok(Sensor {
            name: description.name.clone(),
            readouts,
            layout: layout(&description.kind)?,
            kind,
        })
    }

    fn readouts(&self, kind: &Kind, sensor: &SensorDescription) -> Result<Vec<Readout>, Fault> {
        let response = sensor
            .response
            .as_ref()
            .unwrap_or(&self.description.response);
        self.check_response(response, sensor)?;
        let units = self.units(response)?;
        let of = |quantity: &Quantity| {
            self.quantity(kind, quantity, units, (response, sensor.bins.as_ref()))
        };
        let quantities = quantities(kind);
        let all: Vec<_> = quantities.iter().map(of).collect::<Result<_, _>>()?;
        Ok(all.concat())
    }

    fn quantity(
        &self,
        kind: &Kind,
        quantity: &Quantity,
        (radiant, photometric): (bool, bool),
        (response, bins): (&Response, Option<&Bins>),
    ) -> Result<Vec<Readout>, Fault> {
        if !self.lanes.is_spectral() {
            let efficacy = self.efficacy;
            return Ok(readout::readouts(
                self.lanes,
                *quantity,
                radiant,
                photometric,
                efficacy,
            ));
        }
        if matches!(kind, Kind::Camera(_)) {
            return Ok(spectral_readouts::of_camera(quantity, radiant, photometric));
        }
        spectral_readouts::readouts(self.lanes, quantity, (radiant, photometric), response, bins)
            .map_err(|message| ("bins", message))
    }

    /// Responses beside watts and lumens are made of wavelengths.
    fn check_response(&self, response: &Response, sensor: &SensorDescription) -> Result<(), Fault> {
        let plain = matches!(
            response,
            Response::Auto | Response::Radiant | Response::Photopic
        );
        if plain && sensor.bins.is_none() {
            return Ok(());
        }
        if !self.lanes.is_spectral() {
            let key = if plain { "bins" } else { "response" };
            return Err((
                key,
                "this needs wavelengths: spectrum = \"spectral\"".into(),
            ));
        }
        if matches!(sensor.kind, SensorKind::Camera(_)) {
            let message = "a camera shows radiance or luminance, and colours: other responses are read by meters";
            return Err(("response", message.into()));
        }
        Ok(())
    }

    /// Whether watts and whether lumens are reported.
    fn units(&self, response: &Response) -> Result<(bool, bool), Fault> {
        let lights = self.lights;
        let (radiant, photometric) = match response {
            Response::Auto => (
                lights.any_radiant || !lights.any_photometric,
                lights.any_photometric,
            ),
            Response::Photopic => (false, true),
            _ => (true, false),
        };
        if self.lanes.is_spectral() {
            return Ok((radiant, photometric));
        }
        if photometric && self.lanes.light_weights().is_none() {
            let message = "no band of this scene carries light: name one `visible`";
            return Err(("response", message.into()));
        }
        let crosses = (photometric && lights.any_radiant) || (radiant && lights.any_photometric);
        let stated = self.description.luminous_efficacy.is_some();
        if crosses && self.lanes.needs_stated_efficacy() && !stated {
            let message = "watts and lumens are linked in band `total` only by a stated luminous_efficacy: give it in [scene], or use spectrum = \"rgb\" or a band `visible`";
            return Err(("response", message.into()));
        }
        Ok((radiant, photometric))
    }

    fn kind(&self, sensor: &SensorDescription) -> Result<Kind, Fault> {
        match &sensor.kind {
            SensorKind::Irradiance(receivers) => {
                Ok(Kind::Irradiance(self.places(receivers, &sensor.name)?))
            }
            SensorKind::ScalarIrradiance { points } => {
                let finite = points.iter().all(|point| point.is_finite());
                if !finite || points.is_empty() {
                    return Err(no_points("points"));
                }
                Ok(Kind::ScalarIrradiance(points.clone()))
            }
            SensorKind::Cylindrical { receivers, facing } => {
                let receivers = self.receivers(receivers, &sensor.name)?;
                cylindrical(&receivers, *facing)
            }
            SensorKind::Radiance { rays } => radiance(rays),
            SensorKind::Flux { surface, of } => self.flux(surface, *of),
            SensorKind::Camera(camera) => camera_of(camera),
            SensorKind::Balance(term) => self.accounts(*term).map(Kind::Balance),
        }
    }

    fn flux(&self, surface: &description::FluxSurface, of: FluxOf) -> Result<Kind, Fault> {
        let surface = self.flux_surface(surface)?;
        let area = match &surface {
            FluxSurface::Shapes { shapes, .. } => {
                let area = |id: &ShapeId| self.surfaces.shape(*id).form.area();
                shapes.iter().map(area).sum()
            }
            FluxSurface::Virtual(form) => form.area(),
        };
        if let (FluxOf::Absorbed | FluxOf::Emitted, FluxSurface::Virtual(_)) = (of, &surface) {
            let message = "a surface that does not block light neither absorbs nor emits: use a shape, or of = \"net\"";
            return Err(("of", message.into()));
        }
        if !f64::is_finite(area) {
            let message = "the flux of an infinite plane is infinite: measure irradiance, or a finite surface";
            return Err(("shape", message.into()));
        }
        Ok(Kind::Flux { surface, area, of })
    }

    fn flux_surface(&self, surface: &description::FluxSurface) -> Result<FluxSurface, Fault> {
        Ok(match surface {
            description::FluxSurface::Shape { name, side } => FluxSurface::Shapes {
                shapes: self.shapes(name)?,
                front: *side == Side::Front,
            },
            description::FluxSurface::Virtual {
                geometry,
                transform,
            } => FluxSurface::Virtual(
                virtual_form(geometry, transform).map_err(|message| ("surface", message))?,
            ),
        })
    }

    /// Whether a sensor is about a shape that has a problem of its own, which says enough.
    fn needs_failed_shape(&self, kind: &SensorKind) -> bool {
        let name = match kind {
            SensorKind::Irradiance(Receivers::Shape { shape, .. })
            | SensorKind::Cylindrical {
                receivers: Receivers::Shape { shape, .. },
                ..
            } => shape,
            SensorKind::Flux {
                surface: description::FluxSurface::Shape { name, .. },
                ..
            } => name,
            _ => return false,
        };
        let mut described = self.description.shapes.iter();
        described.any(|shape| shape.name.as_ref() == Some(name))
            && self.forms.named(&self.description.shapes, name).is_empty()
    }

    /// The shapes of this name.
    pub(super) fn shapes(&self, name: &str) -> Result<Vec<ShapeId>, Fault> {
        let shapes = self.forms.named(&self.description.shapes, name);
        if shapes.is_empty() {
            let known: Vec<_> = self
                .description
                .shapes
                .iter()
                .filter_map(|shape| shape.name.as_ref())
                .map(|name| format!("`{name}`"))
                .collect();
            let known = if known.is_empty() {
                "no shape has a name".into()
            } else {
                format!("named shapes: {}", known.join(", "))
            };
            return Err(("shape", format!("there is no shape `{name}`; {known}")));
        }
        Ok(shapes)
    }

    /// A sensor within a solid sees nothing but its inside, which is never what was meant.
    fn check_positions(&self, sensors: &[(usize, Sensor)], problems: &mut Vec<Problem>) {
        let margin = self.surfaces.clearance();
        for (shape, name) in self.surfaces.shapes().iter().zip(&self.forms.names) {
            let Some(bounds) = shape.form.bounds() else {
                continue;
            };
            let solid = LazyCell::new(|| Solid::of(&shape.form));
            let encloses = |point: Point| solid.is_some_and(|solid| solid.encloses(point, margin));
            for (index, sensor) in sensors {
                let (key, mut points) = positions(&sensor.kind);
                let inside = |point: &Point| bounds.contains(*point) && encloses(*point);
                if let Some(point) = points.find(inside) {
                    let (own, at) = (&sensor.name, point.to_array());
                    let message =
                        format!("sensor `{own}` at {at:?} lies inside the solid `{name}`");
                    problems.push(
                        Problem::at(Part::Sensor(*index), key, message)
                            .with_hint("if the shape is a room, say `inside = true`"),
                    );
                }
            }
        }
    }
}

/// How the points of a sensor lie side by side, if they are a grid.
fn layout(kind: &SensorKind) -> Result<Option<Layout>, Fault> {
    match kind {
        SensorKind::Irradiance(receivers) | SensorKind::Cylindrical { receivers, .. } => {
            layout_of(receivers)
        }
        _ => Ok(None),
    }
}

/// What a sensor of this kind reports.
fn quantities(kind: &Kind) -> Vec<Quantity> {
    match kind {
        Kind::Irradiance(_) => vec![readout::IRRADIANCE.into()],
        Kind::ScalarIrradiance(_) => vec![readout::SCALAR.into()],
        Kind::Cylindrical(cylinders) => {
            let is_half = cylinders.iter().any(|one| one.facing.is_some());
            vec![
                if is_half {
                    readout::SEMICYLINDRICAL
                } else {
                    readout::CYLINDRICAL
                }
                .into(),
            ]
        }
        Kind::Radiance(_) | Kind::Camera(_) => vec![readout::RADIANCE.into()],
        Kind::Flux { area, of, .. } => {
            let mean = match of {
                FluxOf::Incident => readout::MEAN_INCIDENT,
                FluxOf::Leaving => readout::MEAN_LEAVING,
                FluxOf::Absorbed => readout::MEAN_ABSORBED,
                FluxOf::Net => readout::MEAN_NET,
                FluxOf::Emitted => readout::MEAN_EMITTED,
            };
            vec![readout::FLUX.into(), mean.per(*area)]
        }
        Kind::Balance(_) => vec![readout::FLUX.into()],
    }
}

/// Where a sensor is, and the key that says so; a surface is nowhere in particular.
fn positions(kind: &Kind) -> (&'static str, Box<dyn Iterator<Item = Point> + '_>) {
    match kind {
        Kind::Irradiance(places) => ("points", Box::new(places.iter().map(|place| place.0))),
        Kind::ScalarIrradiance(points) => ("points", Box::new(points.iter().copied())),
        Kind::Cylindrical(cylinders) => {
            let position = cylinders.iter().map(|cylinder| cylinder.position);
            ("points", Box::new(position))
        }
        Kind::Radiance(rays) => ("rays", Box::new(rays.iter().map(|ray| ray.0))),
        Kind::Camera(camera) => ("position", Box::new(std::iter::once(camera.position))),
        Kind::Flux { .. } | Kind::Balance(_) => ("surface", Box::new(std::iter::empty())),
    }
}

fn radiance(rays: &[(Point, Vector)]) -> Result<Kind, Fault> {
    if rays.is_empty() || rays.iter().any(|(origin, _)| !origin.is_finite()) {
        return Err(no_points("rays"));
    }
    let rays = rays
        .iter()
        .map(|&(origin, direction)| Ok((origin, direction_of("rays", direction)?)));
    Ok(Kind::Radiance(rays.collect::<Result<_, Fault>>()?))
}

/// Cylinders whose axes are the normals of receivers.
fn cylindrical(receivers: &[Receiver], facing: Option<Vector>) -> Result<Kind, Fault> {
    let cylinder = |receiver: &Receiver| {
        let axis = receiver.normal;
        let facing = facing.map(|facing| across(facing, axis)).transpose()?;
        Ok(Cylinder {
            position: receiver.position,
            axis,
            facing,
            clearance: receiver.clearance,
        })
    };
    let cylinders = receivers.iter().map(cylinder);
    Ok(Kind::Cylindrical(cylinders.collect::<Result<_, Fault>>()?))
}

/// The part of a direction across an axis.
fn across(facing: Vector, axis: Direction) -> Result<Direction, Fault> {
    let facing = direction_of("facing", facing)?;
    let across = facing.to_vector() - axis.to_vector() * facing.dot(axis);
    Direction::new(across)
        .ok()
        .filter(|_| across.length() > ALONG)
        .ok_or_else(|| ("facing", "the direction lies along the axis".into()))
}

/// Sine of the least angle between a direction and an axis that it is across.
const ALONG: f64 = 1e-6;
