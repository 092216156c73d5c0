//! `steradian inspect`: what a scene holds, with its totals, before anything is simulated.

use std::path::PathBuf;

use clap::Args;
use steradian::light::{Kind as LightKind, Light};
use steradian::material::MaterialId;
use steradian::quantity::Area;
use steradian::scene::Scene;
use steradian::sensor::{Kind as SensorKind, Sensor};
use steradian::shape::{Form, ShapeId};
use steradian::transport::unsampled;
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{exact, significant};

use crate::status::{Failure, Outcome};
use crate::{load, output};

/// Digits of what is printed for orientation.
const DIGITS: i32 = 6;

/// What a scene holds: shapes with areas, materials, lights with their flux, sensors, and what is wrong
///
/// Nothing is simulated. Light that no estimator can follow, such as that of a point lamp seen in a mirror, is listed too.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Scene file (TOML), or a mesh file (OBJ, PLY, STL)
    scene: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  steradian inspect scenes/cornell-box.toml
  steradian inspect scenes/lamps-equal.toml";

/// Prints the lists.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let loaded = load::scene(&arguments.scene)?;
    let scene = &loaded.scene;
    let unsampled = unsampled(scene);
    let mut sections = vec![
        heading(scene, &loaded.hash),
        shapes(scene).to_string(),
        materials(scene).to_string(),
        lights(scene).to_string(),
        sensors(scene).to_string(),
    ];
    let missing = unsampled
        .iter()
        .map(|class| format!("Not sampled: {class}\n"));
    let warnings = scene
        .warnings()
        .iter()
        .map(|warning| format!("Warning: {warning}\n"));
    sections.push(missing.chain(warnings).collect());
    sections.retain(|section| !section.is_empty());
    output::print(&sections.join("\n"))?;
    Ok(Outcome::fine_if(unsampled.is_empty()))
}

fn heading(scene: &Scene, hash: &str) -> String {
    let lanes = scene.lanes().names().join(", ");
    let efficacy = scene.luminous_efficacy();
    format!(
        "{}\nlanes: {lanes}; K = {efficacy}; scene {}\n",
        scene.name(),
        hash.get(..16).unwrap_or(hash)
    )
}

fn shapes(scene: &Scene) -> Columns {
    let mut columns = Columns::new(["shape", "kind", "area (m2)", "front", "back", "emits"]);
    for (placed, number) in scene.surfaces().shapes().iter().zip(0..) {
        let parts: Vec<_> = placed
            .parts
            .iter()
            .map(|part| scene.parts()[part.0 as usize])
            .collect();
        let light = parts.iter().find_map(|part| part.light);
        columns.row([
            scene.shape_name(ShapeId(number)).to_owned(),
            placed.form.kind().to_owned(),
            area(&placed.form),
            distinct(parts.iter().map(|part| material_name(scene, part.front))),
            distinct(parts.iter().map(|part| material_name(scene, part.back))),
            light.map_or_else(String::new, |light| {
                scene.lights()[light.0 as usize].name.clone()
            }),
        ]);
    }
    columns
}

fn material_name(scene: &Scene, id: MaterialId) -> String {
    if id == MaterialId::BLACK {
        "(none)".to_owned()
    } else {
        scene.materials()[id.0 as usize].0.clone()
    }
}

fn area(form: &Form) -> String {
    if form.area().is_finite() {
        significant(form.area(), DIGITS)
    } else {
        "infinite".to_owned()
    }
}

/// The different names in order of appearance.
fn distinct(names: impl Iterator<Item = String>) -> String {
    let mut seen: Vec<String> = Vec::new();
    for name in names {
        if !seen.contains(&name) {
            seen.push(name);
        }
    }
    seen.join(", ")
}

fn materials(scene: &Scene) -> Columns {
    let lanes = scene.lanes().count();
    let mut columns = Columns::new([
        "material".to_owned(),
        format!("reflectance ({})", scene.lanes().names().join(", ")),
    ]);
    let used = |id: MaterialId| {
        scene
            .parts()
            .iter()
            .any(|part| part.front == id || part.back == id)
    };
    let ids = (0..).map(MaterialId).zip(scene.materials());
    for (id, (_, material)) in ids.filter(|(id, _)| *id != MaterialId::BLACK || used(*id)) {
        let reflectance = material.reflectance().to_lanes();
        let kind = if material.is_specular() {
            " (mirror)"
        } else {
            ""
        };
        let values: Vec<String> = reflectance[..lanes]
            .iter()
            .map(|value| significant(f64::from(*value), DIGITS))
            .collect();
        columns.row([
            material_name(scene, id),
            format!("{}{kind}", values.join(", ")),
        ]);
    }
    columns
}

fn lights(scene: &Scene) -> Columns {
    let mut columns = Columns::new(["light", "group", "kind", "power"]);
    for light in scene.lights() {
        let group = scene.groups()[light.group as usize].clone();
        let (kind, power) = power(scene, light);
        columns.row([light.name.clone(), group, kind.to_owned(), power]);
    }
    columns
}

/// What a light is and its flux; for light from infinitely far away, what arrives instead.
fn power(scene: &Scene, light: &Light) -> (&'static str, String) {
    let watts = |flux: [steradian::quantity::Flux; 4]| flux.map(|lane| lane.to_watts());
    match &light.kind {
        LightKind::Point(point) => ("point", amount(scene, watts(point.flux()), "W", "lm")),
        LightKind::Spot(spot) => ("spot", amount(scene, watts(spot.flux()), "W", "lm")),
        LightKind::Directional { irradiance, .. } => (
            "directional",
            amount(
                scene,
                irradiance.map(|lane| lane.to_watts_per_square_metre()),
                "W/m2",
                "lx",
            ),
        ),
        LightKind::Environment { radiance } => {
            let lanes = radiance.map(|lane| lane.to_watts_per_square_metre_steradian());
            ("environment", amount(scene, lanes, "W/(m2 sr)", "cd/m2"))
        }
        LightKind::Area(area) => {
            let surface = scene.surfaces().shape(area.shape).form.area();
            let flux = area.flux(Area::from_square_metres(surface));
            ("area", amount(scene, watts(flux), "W", "lm"))
        }
    }
}

/// A light's lanes in the units that the sensors use.
fn amount(scene: &Scene, lanes: [f64; 4], radiant: &str, photometric: &str) -> String {
    let weighted = |weights: &[f64]| {
        weights
            .iter()
            .zip(lanes)
            .map(|(weight, lane)| weight * lane)
            .sum::<f64>()
    };
    let uses = |wanted: bool| {
        scene
            .sensors()
            .iter()
            .flat_map(|sensor| &sensor.readouts)
            .any(|readout| readout.photometric == wanted)
    };
    let in_watts = uses(false).then(|| {
        format!(
            "{} {radiant}",
            significant(weighted(&scene.lanes().radiant_weights()), DIGITS)
        )
    });
    let efficacy = scene.luminous_efficacy().to_lumens_per_watt();
    let light = scene
        .lanes()
        .light_weights()
        .filter(|_| uses(true))
        .map(|weights| efficacy * weighted(&weights));
    let in_lumens = light.map(|value| format!("{} {photometric}", significant(value, DIGITS)));
    in_watts
        .into_iter()
        .chain(in_lumens)
        .collect::<Vec<_>>()
        .join(" = ")
}

fn sensors(scene: &Scene) -> Columns {
    let mut columns = Columns::new(["sensor", "reads", "at"]);
    for sensor in scene.sensors() {
        let quantities = sensor
            .readouts
            .iter()
            .map(|readout| format!("{} ({})", readout.name, readout.unit));
        columns.row([
            sensor.name.clone(),
            quantities.collect::<Vec<_>>().join(", "),
            extent(sensor),
        ]);
    }
    columns
}

fn extent(sensor: &Sensor) -> String {
    match &sensor.kind {
        SensorKind::Irradiance(points) => plural(points.len(), "point"),
        SensorKind::ScalarIrradiance(points) => plural(points.len(), "point"),
        SensorKind::Radiance(rays) => plural(rays.len(), "ray"),
        SensorKind::Flux { area, .. } => format!("{} m2", exact(*area)),
        SensorKind::Camera(camera) => {
            let [width, height] = camera.resolution;
            format!("{width} x {height} pixels")
        }
    }
}

fn plural(count: usize, noun: &str) -> String {
    if count == 1 {
        format!("1 {noun}")
    } else {
        format!("{count} {noun}s")
    }
}
