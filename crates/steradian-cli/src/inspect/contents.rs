//! The lists of what a scene holds.

use steradian::geometry::Bounds;
use steradian::light::{Kind as LightKind, Light};
use steradian::material::{Material, MaterialId, Model, Opacity, Tint};
use steradian::quantity::{Area, Flux, Spectrum};
use steradian::scene::{PartProperties, Scene};
use steradian::sensor::{Kind as SensorKind, Sensor, SitsOn};
use steradian::shape::{Form, Placed, ShapeId};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{exact, significant};

/// Digits of what is printed for orientation.
const DIGITS: i32 = 6;

/// Bounds and area of all finite shapes, in a line.
pub fn extent(scene: &Scene) -> String {
    let Some(bounds) = scene.surfaces().bounds() else {
        return String::new();
    };
    format!(
        "bounds {}; area {} m2\n",
        corners(&bounds),
        significant(total_area(scene), DIGITS)
    )
}

/// Area of all finite shapes in m².
pub fn total_area(scene: &Scene) -> f64 {
    let areas = scene
        .surfaces()
        .shapes()
        .iter()
        .map(|placed| placed.form.area());
    areas.filter(|area| area.is_finite()).sum()
}

fn corners(bounds: &Bounds) -> String {
    let corner = |point: [f64; 3]| point.map(|x| significant(x, DIGITS)).join(", ");
    let (min, max) = (bounds.min().to_array(), bounds.max().to_array());
    format!("({}) to ({}) m", corner(min), corner(max))
}

/// One row a shape.
pub fn shapes(scene: &Scene) -> Columns {
    let headings = [
        "shape",
        "kind",
        "triangles",
        "area (m2)",
        "front",
        "back",
        "emits",
    ];
    let mut columns = Columns::new(headings);
    for (placed, number) in scene.surfaces().shapes().iter().zip(0..) {
        let [front, back] = sides(scene, placed).map(|names| names.join(", "));
        columns.row([
            scene.shape_name(ShapeId(number)).to_owned(),
            placed.form.kind().to_owned(),
            triangles(&placed.form).map_or_else(String::new, |count| count.to_string()),
            area(&placed.form),
            front,
            back,
            emits(scene, placed).unwrap_or_default().to_owned(),
        ]);
    }
    columns
}

/// The number of triangles of a form that is made of them.
pub fn triangles(form: &Form) -> Option<usize> {
    match form {
        Form::Mesh(mesh) => Some(mesh.triangles.len()),
        _ => None,
    }
}

/// Names of the materials of the front and of the back.
pub fn sides(scene: &Scene, placed: &Placed) -> [Vec<String>; 2] {
    let of = |side: fn(&PartProperties) -> MaterialId| {
        distinct(parts(scene, placed).map(|part| side(&part)), |id| {
            material_name(scene, id)
        })
    };
    [of(|part| part.front), of(|part| part.back)]
}

/// The light that a shape is.
pub fn emits<'a>(scene: &'a Scene, placed: &Placed) -> Option<&'a str> {
    let light = parts(scene, placed).find_map(|part| part.light)?;
    Some(&scene.lights()[light.0 as usize].name)
}

fn parts<'a>(scene: &'a Scene, placed: &'a Placed) -> impl Iterator<Item = PartProperties> + 'a {
    placed
        .parts
        .iter()
        .map(|part| scene.parts()[part.0 as usize])
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

/// The names of different things in order of appearance.
fn distinct<T: PartialEq + Copy>(
    things: impl Iterator<Item = T>,
    name: impl Fn(T) -> String,
) -> Vec<String> {
    let mut seen: Vec<T> = Vec::new();
    for thing in things {
        if seen.last() != Some(&thing) && !seen.contains(&thing) {
            seen.push(thing);
        }
    }
    seen.into_iter().map(name).collect()
}

/// One row a material that is used or named.
pub fn materials(scene: &Scene) -> Columns {
    let heading = match scene.lanes().is_spectral() {
        true => "reflectance".to_owned(),
        false => format!("reflectance ({})", scene.lanes().names().join(", ")),
    };
    let mut columns = Columns::new(["material".to_owned(), heading, "lets pass".to_owned()]);
    for material in listed_materials(scene) {
        let kind = match &material.transmittance {
            Some(lanes) => format!(" (transmits {})", listed_lanes(lanes)),
            None if material.is_mirror => " (mirror)".to_owned(),
            None => String::new(),
        };
        let values = listed_lanes(&material.reflectance);
        let varies = material.varies.map(|how| format!(" x {how}"));
        let reflectance = format!("{values}{}{kind}", varies.unwrap_or_default());
        columns.row([
            material.name,
            reflectance,
            material.lets_pass.unwrap_or_default(),
        ]);
    }
    columns
}

fn listed_lanes(lanes: &[f32]) -> String {
    let lanes = lanes.iter();
    let lanes: Vec<String> = lanes
        .map(|value| significant(f64::from(*value), DIGITS))
        .collect();
    lanes.join(", ")
}

/// A material of the lists.
pub struct ListedMaterial {
    /// Its name.
    pub name: String,
    /// Of each lane, or of all wavelengths; a factor of what varies.
    pub reflectance: Vec<f32>,
    /// The same of what goes through, if anything does.
    pub transmittance: Option<Vec<f32>>,
    /// What the reflectance is multiplied with.
    pub varies: Option<String>,
    /// What part of the light passes undeviated, if any.
    pub lets_pass: Option<String>,
    /// Whether it is a mirror.
    pub is_mirror: bool,
}

/// All materials but that of shapes without one, unless there are such.
pub fn listed_materials(scene: &Scene) -> Vec<ListedMaterial> {
    let used = |id: MaterialId| {
        let mut parts = scene.parts().iter();
        parts.any(|part| part.front == id || part.back == id)
    };
    let ids = (0..).map(MaterialId).zip(scene.materials());
    let listed = ids.filter(|(id, _)| *id != MaterialId::BLACK || used(*id));
    let lanes = match scene.lanes().is_spectral() {
        true => 1,
        false => scene.lanes().count(),
    };
    let material = |(id, (_, material)): (MaterialId, &(String, Material))| {
        let [reflected, transmitted] = shares(material);
        ListedMaterial {
            name: material_name(scene, id),
            reflectance: reflected[..lanes].to_vec(),
            transmittance: material.transmits().then(|| transmitted[..lanes].to_vec()),
            varies: varies(scene, material),
            lets_pass: material.opacity.as_ref().map(lets_pass),
            is_mirror: matches!(material.model, Model::Mirror { .. }),
        }
    };
    listed.map(material).collect()
}

/// Hemispherical reflectance and transmittance, where the factors stand for what varies.
fn shares(material: &Material) -> [[f32; 4]; 2] {
    match &material.model {
        Model::Recipe(recipe) => recipe.hemispherical().map(Spectrum::to_lanes),
        _ => {
            let tint = material.reflectance();
            [tint.map_or([0.0; 4], |tint| tint.hue.lanes), [0.0; 4]]
        }
    }
}

/// What the model varies with.
fn varies(scene: &Scene, material: &Material) -> Option<String> {
    match &material.model {
        Model::Recipe(recipe) if recipe.constant().is_none() => {
            Some("what varies by place, at the shortest wavelength".into())
        }
        Model::Recipe(_) => None,
        _ => varies_by(scene, material.reflectance()?),
    }
}

fn varies_by(scene: &Scene, tint: &Tint) -> Option<String> {
    let curve = tint.hue.curve.map(|id| {
        let curve = scene.curve(id);
        let [low, high] = [curve.min(), curve.max()].map(|value| significant(value, DIGITS));
        format!("{low} to {high} by wavelength")
    });
    let textures = match tint.textures.len() {
        0 => None,
        count => Some(plural(count, "texture")),
    };
    let parts: Vec<String> = curve.into_iter().chain(textures).collect();
    (!parts.is_empty()).then(|| parts.join(" x "))
}

fn lets_pass(opacity: &Opacity) -> String {
    match opacity.textures.len() {
        0 => significant(1.0 - f64::from(opacity.factor), DIGITS),
        count => plural(count, "texture"),
    }
}

/// One row a light.
pub fn lights(scene: &Scene) -> Columns {
    let mut columns = Columns::new(["light", "group", "kind", "power"]);
    for light in scene.lights() {
        let group = scene.groups()[light.group as usize].clone();
        let values = power(scene, light);
        let values = values
            .iter()
            .map(|(value, unit)| format!("{} {unit}", significant(*value, DIGITS)));
        let values: Vec<String> = values.collect();
        columns.row([
            light.name.clone(),
            group,
            light_kind(light).to_owned(),
            values.join(" = "),
        ]);
    }
    columns
}

/// What a light is called in scene files.
pub fn light_kind(light: &Light) -> &'static str {
    match light.kind {
        LightKind::Point(_) => "point",
        LightKind::Spot(_) => "spot",
        LightKind::Directional { .. } => "directional",
        LightKind::Environment { .. } | LightKind::EnvironmentMap { .. } => "environment",
        LightKind::Area(_) => "area",
        LightKind::Luminaire(_) => "luminaire",
    }
}

/// The flux of a light in the units that the sensors use; for light from infinitely far away, what arrives instead.
pub fn power(scene: &Scene, light: &Light) -> Vec<(f64, &'static str)> {
    let watts = |flux: [Flux; 4]| flux.map(Flux::to_watts);
    let (lanes, units) = match &light.kind {
        LightKind::Point(point) => (watts(point.flux()), ["W", "lm"]),
        LightKind::Spot(spot) => (watts(spot.flux()), ["W", "lm"]),
        LightKind::Luminaire(luminaire) => (watts(luminaire.flux()), ["W", "lm"]),
        LightKind::Directional { irradiance, .. } => {
            let lanes = irradiance.map(|lane| lane.to_watts_per_square_metre());
            (lanes, ["W/m2", "lx"])
        }
        LightKind::Environment { radiance } => {
            let lanes = radiance.map(|lane| lane.to_watts_per_square_metre_steradian());
            (lanes, ["W/(m2 sr)", "cd/m2"])
        }
        LightKind::EnvironmentMap { radiance, .. } => {
            let lanes = radiance.map(|lane| lane.to_watts_per_square_metre_steradian());
            let units = [
                "W/(m2 sr) where its picture is 1",
                "cd/m2 where its picture is 1",
            ];
            (lanes, units)
        }
        LightKind::Area(area) => {
            let surface = scene.surfaces().shape(area.shape).form.area();
            let flux = area.flux(Area::from_square_metres(surface));
            let units = match area.textures.is_empty() {
                true => ["W", "lm"],
                false => ["W were its texture 1", "lm were its texture 1"],
            };
            (watts(flux), units)
        }
    };
    amount(scene, &scene.channels(light, lanes), units)
}

/// A light's channels in the units that the sensors use.
fn amount(
    scene: &Scene,
    channels: &[f64],
    [radiant, photometric]: [&'static str; 2],
) -> Vec<(f64, &'static str)> {
    let weighted = |weights: Vec<f64>| {
        let terms = weights
            .iter()
            .zip(channels)
            .map(|(weight, channel)| weight * channel);
        terms.sum::<f64>()
    };
    let uses = |wanted: bool| {
        let mut readouts = scene.sensors().iter().flat_map(|sensor| &sensor.readouts);
        readouts.any(|readout| readout.photometric == wanted)
    };
    let watts = uses(false).then(|| (weighted(scene.lanes().radiant_weights()), radiant));
    let lanes = scene.lanes();
    let efficacy = scene.luminous_efficacy().to_lumens_per_watt();
    let seen = match lanes.channel("photopic").filter(|_| lanes.is_spectral()) {
        Some(channel) => Some((lanes.only(Some(channel)), 1.0)),
        None => lanes.light_weights().map(|weights| (weights, efficacy)),
    };
    let seen = seen.filter(|_| uses(true));
    let lumens = seen.map(|(weights, efficacy)| (efficacy * weighted(weights), photometric));
    watts.into_iter().chain(lumens).collect()
}

/// One row a sensor.
pub fn sensors(scene: &Scene) -> Columns {
    let mut columns = Columns::new(["sensor", "reads", "at", "on"]);
    for sensor in scene.sensors() {
        let quantities = sensor.readouts.iter();
        let quantities: Vec<String> = quantities
            .map(|readout| format!("{} ({})", readout.name, readout.unit))
            .collect();
        let on: Vec<String> = sits_on(scene, sensor)
            .into_iter()
            .map(|(on, points)| format!("{} ({}, {})", on.shape, on.side, plural(points, "point")))
            .collect();
        columns.row([
            sensor.name.clone(),
            quantities.join(", "),
            place(sensor),
            on.join(", "),
        ]);
    }
    columns
}

/// The sides of surfaces that a sensor's points lie on, and how many lie on each.
pub fn sits_on(scene: &Scene, sensor: &Sensor) -> Vec<(SitsOn, usize)> {
    let SensorKind::Irradiance(places) = &sensor.kind else {
        return Vec::new();
    };
    let receivers = scene.receivers(places, 0..places.len());
    let mut sides: Vec<(SitsOn, usize)> = Vec::new();
    for on in receivers
        .iter()
        .filter_map(|receiver| receiver.sits_on.as_ref())
    {
        match sides.iter_mut().find(|(side, _)| side == on) {
            Some((_, count)) => *count += 1,
            None => sides.push((on.clone(), 1)),
        }
    }
    sides
}

fn place(sensor: &Sensor) -> String {
    match &sensor.kind {
        SensorKind::Irradiance(points) => plural(points.len(), "point"),
        SensorKind::ScalarIrradiance(points) => plural(points.len(), "point"),
        SensorKind::Cylindrical(points) => plural(points.len(), "point"),
        SensorKind::Radiance(rays) => plural(rays.len(), "ray"),
        SensorKind::Flux { area, .. } => format!("{} m2", exact(*area)),
        SensorKind::Balance(accounts) => plural(accounts.len(), "account"),
        SensorKind::Camera(camera) => {
            let [width, height] = camera.resolution;
            let projection = camera.projection().name();
            format!("{width} x {height} pixels, {projection}")
        }
    }
}

/// A number and what it counts.
pub fn plural(count: usize, noun: &str) -> String {
    if count == 1 {
        format!("1 {noun}")
    } else {
        format!("{count} {noun}s")
    }
}
