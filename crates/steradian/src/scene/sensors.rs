//! Sensors: receivers in world coordinates, what they sit on, and what they report.

use steradian_kernel::{HitBatch, InstructionSet, MISS, RayBatch};

use super::description::{self, Receivers, SceneDescription, SensorDescription, SensorKind, Side};
use super::forms::{Forms, virtual_form};
use super::lights::Builder;
use super::{Part, Problem};
use crate::geometry::{Direction, Point, Vector};
use crate::sampling::{block, hash};
use crate::sensor::{
    Camera, FluxOf, FluxSurface, Kind, Readout, Receiver, Response, Sensor, SitsOn, readout,
};
use crate::shape::{ShapeId, Surfaces};
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
    if descriptions.is_empty() {
        problems.push(
            Problem::of(Part::Scene, "the scene has no sensor")
                .with_hint("add a [[sensors]] entry"),
        );
    }
    let mut sensors = Vec::new();
    for (index, description) in descriptions.iter().enumerate() {
        if descriptions[..index]
            .iter()
            .any(|other| other.name == description.name)
        {
            problems.push(Problem::at(
                Part::Sensor(index),
                "name",
                format!("sensor `{}` is defined twice", description.name),
            ));
        }
        match context.sensor(index, description) {
            Ok(sensor) => {
                context.check_position(index, &sensor, problems);
                sensors.push(sensor);
            }
            Err((key, message)) => problems.push(Problem::at(Part::Sensor(index), key, message)),
        }
    }
    sensors
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

type Fault = (&'static str, String);

impl Context<'_> {
    fn sensor(&self, index: usize, description: &SensorDescription) -> Result<Sensor, Fault> {
        let kind = self.kind(&description.kind, index)?;
        let readouts = self.readouts(
            &kind,
            description.response.unwrap_or(self.description.response),
        )?;
        Ok(Sensor {
            name: description.name.clone(),
            readouts,
            kind,
        })
    }

    fn readouts(&self, kind: &Kind, response: Response) -> Result<Vec<Readout>, Fault> {
        let lights = self.lights;
        let (radiant, photometric) = match response {
            Response::Auto => (
                lights.any_radiant || !lights.any_photometric,
                lights.any_photometric,
            ),
            Response::Radiant => (true, false),
            Response::Photopic => (false, true),
        };
        if photometric && self.lanes.light_weights().is_none() {
            return Err((
                "response",
                "no band of this scene carries light: name one `visible`".into(),
            ));
        }
        let crosses = (photometric && lights.any_radiant) || (radiant && lights.any_photometric);
        if crosses
            && self.lanes.needs_stated_efficacy()
            && self.description.luminous_efficacy.is_none()
        {
            let message = "watts and lumens are linked in band `total` only by a stated luminous_efficacy: give it in [scene], or use spectrum = \"rgb\" or a band `visible`";
            return Err(("response", message.into()));
        }
        let of = |names| readout::readouts(self.lanes, names, radiant, photometric, self.efficacy);
        Ok(match kind {
            Kind::Irradiance(_) => of(readout::IRRADIANCE.into()),
            Kind::ScalarIrradiance(_) => of(readout::SCALAR.into()),
            Kind::Radiance(_) | Kind::Camera(_) => of(readout::RADIANCE.into()),
            Kind::Flux { area, of: what, .. } => {
                let mean = match what {
                    FluxOf::Incident => readout::MEAN_INCIDENT,
                    FluxOf::Leaving => readout::MEAN_LEAVING,
                    FluxOf::Absorbed => readout::MEAN_ABSORBED,
                    FluxOf::Net => readout::MEAN_NET,
                };
                [of(readout::FLUX.into()), of(mean.per(*area))].concat()
            }
        })
    }

    fn kind(&self, kind: &SensorKind, index: usize) -> Result<Kind, Fault> {
        match kind {
            SensorKind::Irradiance(receivers) => {
                Ok(Kind::Irradiance(self.receivers(receivers, index)?))
            }
            SensorKind::ScalarIrradiance { points } => {
                let finite = points.iter().all(|point| point.is_finite());
                if finite && !points.is_empty() {
                    Ok(Kind::ScalarIrradiance(points.clone()))
                } else {
                    Err(no_points("points"))
                }
            }
            SensorKind::Radiance { rays } => {
                let ray = |&(origin, direction): &(Point, Vector)| {
                    direction_of("rays", direction).map(|direction| (origin, direction))
                };
                let rays: Vec<_> = rays.iter().map(ray).collect::<Result<_, _>>()?;
                if rays.is_empty() {
                    Err(no_points("rays"))
                } else {
                    Ok(Kind::Radiance(rays))
                }
            }
            SensorKind::Flux { surface, of } => self.flux(surface, *of),
            SensorKind::Camera(camera) => camera_of(camera),
        }
    }

    fn flux(
        &self,
        surface: &description::FluxSurface,
        of: description::FluxOf,
    ) -> Result<Kind, Fault> {
        let surface = match surface {
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
        };
        let area = match &surface {
            FluxSurface::Shapes { shapes, .. } => shapes
                .iter()
                .map(|id| self.surfaces.shape(*id).form.area())
                .sum(),
            FluxSurface::Virtual(form) => form.area(),
        };
        let of = match of {
            description::FluxOf::Incident => FluxOf::Incident,
            description::FluxOf::Leaving => FluxOf::Leaving,
            description::FluxOf::Absorbed => FluxOf::Absorbed,
            description::FluxOf::Net => FluxOf::Net,
        };
        if of == FluxOf::Absorbed && matches!(surface, FluxSurface::Virtual(_)) {
            return Err((
                "of",
                "a surface that does not block light absorbs nothing: use a shape, or of = \"net\""
                    .into(),
            ));
        }
        if !f64::is_finite(area) {
            return Err(("shape", "the flux of an infinite plane is infinite: measure irradiance, or a finite surface".into()));
        }
        Ok(Kind::Flux { surface, area, of })
    }

    fn shapes(&self, name: &str) -> Result<Vec<ShapeId>, Fault> {
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

    fn receivers(&self, receivers: &Receivers, index: usize) -> Result<Vec<Receiver>, Fault> {
        let points: Vec<(Point, Direction)> = match receivers {
            Receivers::Points(points) => points
                .iter()
                .map(|&(point, normal)| Ok((point, direction_of("points", normal)?)))
                .collect::<Result<_, Fault>>()?,
            Receivers::Grid {
                origin,
                edges,
                count,
                normal,
            } => grid(*origin, *edges, *count, *normal)?,
            Receivers::Shape {
                shape,
                side,
                count,
                offset,
            } => self.over_shape(shape, *side, *count, *offset, index)?,
        };
        if points.is_empty() || points.iter().any(|(point, _)| !point.is_finite()) {
            return Err(no_points("points"));
        }
        Ok(self.receivers_at(&points))
    }

    /// Points of uniform density by area, the same in every run.
    fn over_shape(
        &self,
        name: &str,
        side: Side,
        count: u32,
        offset: f64,
        index: usize,
    ) -> Result<Vec<(Point, Direction)>, Fault> {
        let shapes = self.shapes(name)?;
        let key = hash::combine(hash::key_of_name(name), index as u64);
        let draw = |i: u32| {
            let [u, v, choice, _] = block::sample(key, i, 0).map(f64::from);
            let id = shapes[((choice * shapes.len() as f64) as usize).min(shapes.len() - 1)];
            let sample = self.surfaces.shape(id).form.sample_area([u, v])?;
            let normal = if side == Side::Front {
                sample.normal
            } else {
                -sample.normal
            };
            Some((sample.point + normal.to_vector() * offset, normal))
        };
        let points: Vec<_> = (0..count.saturating_mul(64))
            .filter_map(draw)
            .take(count as usize)
            .collect();
        if points.len() < count as usize {
            Err(("shape", format!("points cannot be spread over `{name}`")))
        } else {
            Ok(points)
        }
    }

    /// Looks from a little above each point back down for the surface it lies on.
    fn receivers_at(&self, points: &[(Point, Direction)]) -> Vec<Receiver> {
        let reach = self.surfaces.clearance();
        let mut rays = RayBatch::default();
        for (point, normal) in points {
            let start = *point + normal.to_vector() * reach;
            let down = (-normal.to_vector()).to_array().map(|x| x as f32);
            rays.push(self.surfaces.to_kernel(start), down, 2.0 * reach as f32);
        }
        let mut hits = HitBatch::default();
        self.surfaces
            .closest(&rays, &mut hits, InstructionSet::detect());
        let found = hits.primitive.iter().zip(points);
        found
            .map(|(&primitive, &(position, normal))| {
                self.receiver(position, normal, primitive, reach)
            })
            .collect()
    }

    fn receiver(&self, position: Point, normal: Direction, primitive: u32, reach: f64) -> Receiver {
        if primitive == MISS {
            return Receiver {
                position,
                normal,
                sits_on: None,
                clearance: 0.0,
            };
        }
        let id = self.surfaces.shape_of(primitive);
        let front = normal.dot(self.surfaces.normal_at(primitive, position)) > 0.0;
        let side = if front { "front" } else { "back" }.to_string();
        let sits_on = Some(SitsOn {
            shape: self.forms.names[id.0 as usize].clone(),
            side,
        });
        Receiver {
            position,
            normal,
            sits_on,
            clearance: reach,
        }
    }

    /// A sensor within a solid sees nothing but its inside, which is never what was meant.
    fn check_position(&self, index: usize, sensor: &Sensor, problems: &mut Vec<Problem>) {
        let (key, points): (_, Vec<Point>) = match &sensor.kind {
            Kind::Irradiance(receivers) => (
                "points",
                receivers.iter().map(|receiver| receiver.position).collect(),
            ),
            Kind::ScalarIrradiance(points) => ("points", points.clone()),
            Kind::Radiance(rays) => ("rays", rays.iter().map(|ray| ray.0).collect()),
            Kind::Camera(camera) => ("position", vec![camera.position]),
            Kind::Flux { .. } => return,
        };
        let margin = self.surfaces.clearance();
        for (shape, name) in self.surfaces.shapes().iter().zip(&self.forms.names) {
            let inside = |point: &&Point| shape.form.encloses(**point, margin);
            if let Some(point) = points.iter().find(inside) {
                let message = format!(
                    "sensor `{}` at {:?} lies inside the solid `{name}`",
                    sensor.name,
                    point.to_array()
                );
                problems.push(
                    Problem::at(Part::Sensor(index), key, message)
                        .with_hint("if the shape is a room, say `inside = true`"),
                );
            }
        }
    }
}

fn no_points(key: &'static str) -> Fault {
    (
        key,
        "give at least one point, with finite coordinates".into(),
    )
}

fn direction_of(key: &'static str, vector: Vector) -> Result<Direction, Fault> {
    Direction::new(vector).map_err(|_| (key, "a normal or direction is finite and not zero".into()))
}

/// Cell centres, row by row along the first edge.
fn grid(
    origin: Point,
    edges: [Vector; 2],
    count: [u32; 2],
    normal: Option<Vector>,
) -> Result<Vec<(Point, Direction)>, Fault> {
    let normal = direction_of("grid", normal.unwrap_or(edges[0].cross(edges[1])))?;
    let at = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    let row = |j: u32| {
        (0..count[0]).map(move |i| {
            (
                origin + edges[0] * at(i, count[0]) + edges[1] * at(j, count[1]),
                normal,
            )
        })
    };
    Ok((0..count[1]).flat_map(row).collect())
}

fn camera_of(camera: &description::CameraDescription) -> Result<Kind, Fault> {
    let degrees = camera.fov.to_degrees();
    if !(degrees > 0.0 && degrees < 180.0) {
        return Err((
            "fov",
            format!("a perspective camera's fov lies between 0 and 180 deg, not {degrees} deg"),
        ));
    }
    if camera
        .resolution
        .iter()
        .any(|&pixels| pixels == 0 || pixels > 65_536)
    {
        return Err((
            "resolution",
            "a picture has 1 to 65536 pixels each way".into(),
        ));
    }
    let prepared = Camera::new(
        camera.position,
        camera.look_at,
        camera.up,
        camera.fov,
        camera.resolution,
    );
    prepared.map(Kind::Camera).ok_or((
        "look_at",
        "look_at differs from position, and up from the direction of view".into(),
    ))
}
