//! Scenes: from a description to an immutable, validated scene.

mod appearance;
mod balance;
mod box_form;
mod cameras;
mod channels;
mod curves;
pub mod description;
mod forms;
mod geometry;
mod grids;
mod lights;
mod lone_material;
mod luminaires;
mod materials;
mod mixtures;
mod problem;
mod receivers;
mod recipes;
mod reliefs;
mod remarks;
mod sensors;
mod spectral_readouts;
mod unseen;

use std::sync::Arc;

pub use balance::energy_balance;
pub use channels::CAMERA_CHANNELS;
use curves::Curves;
pub use lone_material::LoneMaterial;
use problem::Fault;
pub use problem::{Part, Place, Problem};
pub use unseen::Unseen;

use crate::geometry::Point;
use crate::light::{Kind, Light, LightId};
use crate::material::{Material, MaterialId};
use crate::quantity::LuminousEfficacy;
use crate::sensor::Sensor;
use crate::shape::{Parallelogram, ShapeId, Surfaces};
use crate::spectrum::{Curve, CurveId, Lanes, MAX_LANES};
use crate::time::Schedule;
use description::{MaterialDescription, MaterialModel, SceneDescription};

/// What one part of a shape is made of.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct PartProperties {
    /// Material of the front.
    pub front: MaterialId,
    /// Material of the back.
    pub back: MaterialId,
    /// The light that this part belongs to.
    pub light: Option<LightId>,
}

/// A validated scene, ready to be simulated.
pub struct Scene {
    name: String,
    lanes: Lanes,
    efficacy: f64,
    links_watts_and_lumens: bool,
    groups: Vec<String>,
    schedules: Vec<Option<Schedule>>,
    surfaces: Surfaces,
    shape_names: Vec<String>,
    parts: Vec<PartProperties>,
    materials: Vec<(String, Material)>,
    lights: Vec<Light>,
    curves: Vec<Arc<Curve>>,
    sensors: Vec<Sensor>,
    portals: Vec<Parallelogram>,
    warnings: Vec<String>,
    /// No material lets light pass.
    is_opaque: bool,
}

impl Scene {
    /// Validates `description`, or says everything that is wrong with it.
    ///
    /// # Errors
    /// All problems together; those of sensors leave out what other problems already explain.
    pub fn new(description: &SceneDescription) -> Result<Self, Vec<Problem>> {
        let mut problems = Vec::new();
        check_light(description, &mut problems);
        check_sensors(description, &mut problems);
        Self::validated(description, problems)
    }

    /// The same for what is asked of surfaces alone, such as form factors: a scene without lights and sensors will do.
    ///
    /// # Errors
    /// All problems together.
    pub fn of_surfaces(description: &SceneDescription) -> Result<Self, Vec<Problem>> {
        Self::validated(description, Vec::new())
    }

    fn validated(
        description: &SceneDescription,
        mut problems: Vec<Problem>,
    ) -> Result<Self, Vec<Problem>> {
        match Self::prepare(description, &mut problems) {
            Some(scene) if problems.is_empty() => Ok(scene),
            _ => Err(problems),
        }
    }

    fn prepare(description: &SceneDescription, problems: &mut Vec<Problem>) -> Option<Self> {
        let lanes = channels::lanes(description, problems)?;
        let mut curves = Curves::default();
        let efficacy = efficacy(description, problems);
        let materials = materials::prepare(&description.materials, &lanes, &mut curves, problems);
        let mut forms = forms::prepare(&description.shapes, &materials, problems);
        let mut placed = std::mem::take(&mut forms.placed);
        let mut lights = lights::Builder::new(&lanes, efficacy, &mut curves);
        lights.add_emission(&description.shapes, &mut forms, &placed, problems);
        let mounting = luminaires::Mounting::new(&mut forms, &mut placed, &description.lights);
        lights.add_lights(&description.lights, mounting, problems);
        let surfaces = Surfaces::new(placed, anchor(description))
            .map_err(|error| problems.push(Problem::of(Part::Scene, error.to_string())))
            .ok()?;
        let context = sensors::Context {
            lanes: &lanes,
            efficacy,
            surfaces: &surfaces,
            forms: &forms,
            lights: &lights,
            description,
        };
        let sensors = sensors::prepare(&context, problems);
        Some(Self {
            name: description.name.clone(),
            links_watts_and_lumens: !lanes.is_spectral() && sensors::crosses(&sensors, &lights),
            efficacy,
            groups: lights.groups,
            schedules: lights.schedules,
            surfaces,
            shape_names: forms.names,
            portals: forms.portals,
            parts: forms.parts,
            materials: materials.materials,
            lights: lights.lights,
            curves: curves.0,
            sensors,
            warnings: warnings(description, &lanes),
            is_opaque: description.materials.iter().all(stops_light),
            lanes,
        })
    }

    /// The title.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What the lanes mean.
    pub fn lanes(&self) -> &Lanes {
        &self.lanes
    }

    /// K of this run.
    pub fn luminous_efficacy(&self) -> LuminousEfficacy {
        LuminousEfficacy::from_lumens_per_watt(self.efficacy)
    }

    /// K as reports state it; `None` where no band carries light and in `spectral`, which has none.
    pub fn reported_efficacy(&self) -> Option<f64> {
        self.lanes.light_weights().map(|_| self.efficacy)
    }

    /// Whether any reading depends on K: watts in and lumens out, or the other way.
    pub fn links_watts_and_lumens(&self) -> bool {
        self.links_watts_and_lumens
    }

    /// Names of the light groups; a name stands once for each schedule that its lights have.
    pub fn groups(&self) -> &[String] {
        &self.groups
    }

    /// The schedule of each group; none where lights give all they can at all times.
    pub fn schedules(&self) -> &[Option<Schedule>] {
        &self.schedules
    }

    /// The geometry.
    pub fn surfaces(&self) -> &Surfaces {
        &self.surfaces
    }

    /// Name of a shape, or its kind and number.
    pub fn shape_name(&self, id: ShapeId) -> &str {
        &self.shape_names[id.0 as usize]
    }

    /// Openings in the walls of rooms that hold nothing or what lets light pass straight; their fronts are inside.
    pub fn portals(&self) -> &[Parallelogram] {
        &self.portals
    }

    /// Parts of shapes, by number.
    pub fn parts(&self) -> &[PartProperties] {
        &self.parts
    }

    /// Name and material, by number.
    pub fn materials(&self) -> &[(String, Material)] {
        &self.materials
    }

    /// Material with this number.
    pub fn material(&self, id: MaterialId) -> &Material {
        &self.materials[id.0 as usize].1
    }

    /// Lights, by number.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// Curves by number.
    pub fn curves(&self) -> &[Arc<Curve>] {
        &self.curves
    }

    /// The curve with this number.
    pub fn curve(&self, id: CurveId) -> &Curve {
        &self.curves[id.0 as usize]
    }

    /// What a light, or a number of the same spectrum, is in each channel.
    pub fn channels(&self, light: &Light, lanes: [f64; MAX_LANES]) -> Vec<f64> {
        self.lanes
            .channels(lanes, light.spectrum.map(|id| self.curve(id)))
    }

    /// Sensors in file order.
    pub fn sensors(&self) -> &[Sensor] {
        &self.sensors
    }

    /// What a reader of the results should know.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Number of columns of a reading: groups × channels.
    pub fn columns(&self) -> usize {
        self.groups.len() * self.lanes.count()
    }

    /// Whether a picture tells what comes from everywhere.
    pub fn has_environment_map(&self) -> bool {
        let mut lights = self.lights.iter();
        lights.any(|light| matches!(light.kind, Kind::EnvironmentMap { .. }))
    }

    /// The constant environments.
    pub fn environments(&self) -> impl Iterator<Item = &Light> {
        self.lights
            .iter()
            .filter(|light| matches!(light.kind, Kind::Environment { .. }))
    }
}

/// Whether no light passes a surface of this material, those of its parts apart.
fn stops_light(material: &MaterialDescription) -> bool {
    material.opacity.is_none()
        && match &material.model {
            MaterialModel::Recipe(recipe) => !recipe.transmits(),
            MaterialModel::Lambertian { .. }
            | MaterialModel::Mirror { .. }
            | MaterialModel::Mixture { .. }
            | MaterialModel::Metal { .. }
            | MaterialModel::TwoSided { .. } => true,
        }
}

/// What the reader of the file approximated, and what is known of the spectra.
fn warnings(description: &SceneDescription, lanes: &Lanes) -> Vec<String> {
    let mut warnings = description.warnings.clone();
    if let Some(grid) = lanes.grid() {
        warnings.extend(remarks::spectral(description, grid));
    }
    warnings
}

fn check_light(description: &SceneDescription, problems: &mut Vec<Problem>) {
    let mut shapes = description.shapes.iter();
    if description.lights.is_empty() && shapes.all(|shape| shape.emission.is_none()) {
        problems.push(
            Problem::of(Part::Scene, "the scene has no light")
                .with_hint("add a [[lights]] entry, or `emission` to a shape"),
        );
    }
}

fn check_sensors(description: &SceneDescription, problems: &mut Vec<Problem>) {
    if description.sensors.is_empty() {
        problems.push(
            Problem::of(Part::Scene, "the scene has no sensor")
                .with_hint("add a [[sensors]] entry"),
        );
    }
}

/// Where the first sensor is that is at a place.
fn anchor(description: &SceneDescription) -> Point {
    let sensors = description.sensors.iter();
    let mut places = sensors.filter_map(|sensor| sensor.kind.place());
    places
        .find(|place| place.is_finite())
        .unwrap_or(Point::ORIGIN)
}

fn efficacy(description: &SceneDescription, problems: &mut Vec<Problem>) -> f64 {
    let stated = description
        .luminous_efficacy
        .unwrap_or(LuminousEfficacy::RADIANCE_WHITE.to_lumens_per_watt());
    if !(stated > 0.0 && stated <= LuminousEfficacy::MAXIMUM.to_lumens_per_watt()) {
        let message = format!("luminous_efficacy lies above 0 and at most 683 lm/W, not {stated}");
        problems.push(Problem::at(Part::Scene, "luminous_efficacy", message));
    }
    stated
}

#[cfg(test)]
mod tests;
