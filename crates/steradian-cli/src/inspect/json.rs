//! An inspection as one JSON object, `"schema": "steradian.inspect/1"`; lengths are in metres, areas in m².

use std::path::Path;

use serde_json::{Value, json};
use steradian::geometry::Bounds;
use steradian::light::Light;
use steradian::scene::Scene;
use steradian::sensor::{Kind, Sensor};
use steradian::shape::{Placed, ShapeId};

use super::findings::Finding;
use super::{Inspection, contents};

/// Name and version of the format.
const SCHEMA: &str = "steradian.inspect/1";

impl Inspection<'_> {
    /// The object.
    pub fn json(&self, file: &Path) -> Value {
        let scene = self.scene;
        json!({
            "schema": SCHEMA,
            "version": env!("CARGO_PKG_VERSION"),
            "file": file.display().to_string(),
            "scene": scene.name(),
            "scene_hash": self.hash,
            "lanes": scene.lanes().names(),
            "luminous_efficacy": scene.reported_efficacy(),
            "bounds": scene.surfaces().bounds().map(|bounds| limits(&bounds)),
            "area": contents::total_area(scene),
            "triangles": self.triangles.count(),
            "pieces": self.pieces,
            "sheet_edges": self.sheet_edges,
            "shapes": shapes(scene),
            "materials": materials(scene),
            "lights": scene.lights().iter().map(|one| light(scene, one)).collect::<Vec<_>>(),
            "sensors": scene.sensors().iter().map(|one| sensor(scene, one)).collect::<Vec<_>>(),
            "findings": self.findings.iter().map(Finding::json).collect::<Vec<_>>(),
            "unsampled": self.unsampled,
            "warnings": scene.warnings(),
        })
    }
}

fn limits(bounds: &Bounds) -> Value {
    json!({ "min": bounds.min().to_array(), "max": bounds.max().to_array() })
}

fn shapes(scene: &Scene) -> Vec<Value> {
    let numbered = scene.surfaces().shapes().iter().zip(0..);
    let shape = |(placed, number): (&Placed, u32)| {
        let [front, back] = contents::sides(scene, placed);
        json!({
            "name": scene.shape_name(ShapeId(number)),
            "kind": placed.form.kind(),
            "triangles": contents::triangles(&placed.form),
            "area": Some(placed.form.area()).filter(|area| area.is_finite()),
            "bounds": placed.form.bounds().map(|bounds| limits(&bounds)),
            "front": front,
            "back": back,
            "emits": contents::emits(scene, placed),
        })
    };
    numbered.map(shape).collect()
}

fn materials(scene: &Scene) -> Vec<Value> {
    let material = |material: contents::ListedMaterial| {
        json!({
            "name": material.name,
            "reflectance": material.reflectance,
            "transmittance": material.transmittance,
            "varies": material.varies,
            "lets_pass": material.lets_pass,
            "mirror": material.is_mirror,
        })
    };
    let listed = contents::listed_materials(scene);
    listed.into_iter().map(material).collect()
}

fn light(scene: &Scene, light: &Light) -> Value {
    let power = contents::power(scene, light);
    let power = power.into_iter();
    json!({
        "name": light.name,
        "group": scene.groups()[light.group as usize],
        "kind": contents::light_kind(light),
        "power": power.map(|(value, unit)| json!({ "value": value, "unit": unit })).collect::<Vec<_>>(),
    })
}

fn sensor(scene: &Scene, sensor: &Sensor) -> Value {
    let (kind, at) = match &sensor.kind {
        Kind::Irradiance(points) => ("irradiance", json!({ "points": points.len() })),
        Kind::ScalarIrradiance(points) => ("scalar-irradiance", json!({ "points": points.len() })),
        Kind::Cylindrical(points) => ("cylindrical-irradiance", json!({ "points": points.len() })),
        Kind::Radiance(rays) => ("radiance", json!({ "rays": rays.len() })),
        Kind::Flux { area, .. } => ("flux", json!({ "area": area })),
        Kind::Balance(accounts) => ("balance", json!({ "accounts": accounts.len() })),
        Kind::Camera(camera) => {
            let projection = camera.projection().name();
            let at = json!({ "projection": projection, "resolution": camera.resolution });
            ("camera", at)
        }
    };
    let on = contents::sits_on(scene, sensor).into_iter();
    json!({
        "name": sensor.name,
        "kind": kind,
        "quantities": sensor.readouts.iter().map(|readout| json!({ "name": readout.name, "unit": readout.unit })).collect::<Vec<_>>(),
        "at": at,
        "sits_on": on.map(|(on, points)| json!({ "shape": on.shape, "side": on.side, "points": points })).collect::<Vec<_>>(),
    })
}
