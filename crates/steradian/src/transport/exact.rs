//! The parts of a reading that a closed form gives: lights without extent at a point, and emission. [`Rosters`](super::roster::Rosters) add
//! extended lights in full view.

use steradian_kernel::{InstructionSet, RayBatch};

use super::channels::counts;
use super::tables::Tables;
use super::transmittance::Transmittance;
use crate::geometry::{Direction, Point};
use crate::light::{Kind, Light, LightSample, LuminaireLight, Outlet};
use crate::material::Hue;
use crate::scene::Scene;
use crate::sensor::FluxOf;
use crate::shape::Placed;
use crate::spectrum::{MAX_LANES, Wavelengths};

/// Irradiance by lights without extent, E = Σ E_n cosθ · V, by column; scalar irradiance Σ E_n · V without a normal. Of more
/// lights than [are summed](super::tables::SUMMED_LIGHTS) it knows nothing.
pub(super) fn irradiance(
    tables: &Tables<'_>,
    point: Point,
    normal: Option<Direction>,
    clearance: f64,
) -> Vec<f64> {
    weighted(tables, point, normal, clearance, |_| 1.0)
}

/// The same with the light from each direction weighted.
pub(super) fn weighted(
    tables: &Tables<'_>,
    point: Point,
    normal: Option<Direction>,
    clearance: f64,
    weight: impl Fn(Direction) -> f64,
) -> Vec<f64> {
    let scene = tables.scene;
    let count = scene.lanes().count();
    let mut columns = vec![0.0; scene.columns()];
    if !tables.sums_lights() {
        return columns;
    }
    let mut shadows = Vec::new();
    let mut rays = RayBatch::default();
    for light in scene.lights().iter().filter(|light| light.is_delta()) {
        let facing = normal.map_or_else(|| towards(&light.kind, point), Some);
        let Some(sample) = facing.and_then(|normal| {
            light.sample(point, normal, [0.0; 2], |_| {
                unreachable!("lights without extent have no form")
            })
        }) else {
            continue;
        };
        if sample
            .irradiance
            .iter()
            .all(|lane| lane.to_watts_per_square_metre() == 0.0)
        {
            continue;
        }
        let start =
            point + facing.map_or(crate::geometry::Vector::ZERO, |normal| normal * clearance);
        let (span, reach) = match sample.distance.is_finite() {
            true => (end(&light.kind, point, &sample) - start, 1.0),
            false => (sample.direction.to_vector(), f32::INFINITY),
        };
        rays.push(
            scene.surfaces().to_kernel(start),
            span.to_array().map(|x| x as f32),
            reach,
        );
        shadows.push((light, sample));
    }
    let mut transmittance = Transmittance::default();
    let none = Wavelengths::default();
    transmittance.trace(tables, &rays, |_| &none, InstructionSet::detect());
    for (i, (light, sample)) in shadows.iter().enumerate() {
        let through = transmittance.of(i);
        let irradiance = sample
            .irradiance
            .map(|lane| lane.to_watts_per_square_metre() * weight(sample.direction));
        let in_colours = scene.lanes().is_spectral() && tables.lets_pass;
        let channels = if in_colours && through != [1.0; 4] {
            through_colours(tables, &alone(&rays, i), light, irradiance)
        } else {
            let part = |lane: usize| irradiance[lane] * f64::from(through[lane]);
            scene.channels(light, std::array::from_fn(part))
        };
        let column = &mut columns[sample.group as usize * count..][..count];
        column
            .iter_mut()
            .zip(channels)
            .for_each(|(sum, channel)| *sum += channel);
    }
    columns
}

/// The channels of light that comes along a segment through surfaces whose transmittance may depend on the wavelength: by
/// the midpoint rule over the cells of the run's grid.
fn through_colours(
    tables: &Tables<'_>,
    ray: &RayBatch,
    light: &Light,
    irradiance: [f64; MAX_LANES],
) -> Vec<f64> {
    let hue = Hue {
        lanes: irradiance.map(|lane| lane as f32),
        curve: light.spectrum,
    };
    let mut channels = vec![0.0; tables.responses.len()];
    let mut transmittance = Transmittance::default();
    let groups = tables.scene.lanes().grid().into_iter();
    for waves in groups.flat_map(|grid| grid.middles()) {
        transmittance.trace(tables, ray, |_| &waves, InstructionSet::detect());
        let through = transmittance.of(0);
        let arrives = tables.colors.hue(&hue, &waves);
        for (sum, response) in channels.iter_mut().zip(&tables.responses) {
            let counts = counts(response, &waves);
            let lane = |lane: usize| f64::from(counts[lane] * arrives[lane] * through[lane]);
            *sum += (lane(0) + lane(1)) + (lane(2) + lane(3));
        }
    }
    channels
}

fn alone(rays: &RayBatch, i: usize) -> RayBatch {
    let (mut alone, ray) = (RayBatch::default(), rays.ray(i));
    alone.push(ray.origin, ray.direction, ray.t_max);
    alone
}

/// The direction in which a receiver of scalar irradiance faces a light.
fn towards(kind: &Kind, point: Point) -> Option<Direction> {
    match kind {
        Kind::Point(light) => Direction::new(light.position - point).ok(),
        Kind::Spot(light) => Direction::new(light.position - point).ok(),
        Kind::Directional { direction, .. } => Some(-*direction),
        Kind::Luminaire(light) => Direction::new(light.position - point).ok(),
        Kind::Environment { .. } | Kind::EnvironmentMap { .. } | Kind::Area(_) => None,
    }
}

/// Where the shadow ray to a light at a distance ends.
fn end(kind: &Kind, point: Point, sample: &LightSample) -> Point {
    match kind {
        Kind::Luminaire(LuminaireLight {
            outlet: Outlet::Point { end },
            ..
        }) => *end,
        _ => point + sample.direction * sample.distance,
    }
}

/// Adds the radiance of the constant environments.
pub(super) fn environment(scene: &Scene, columns: &mut [f64]) {
    let count = scene.lanes().count();
    for light in scene.environments() {
        columns[light.group as usize * count..][..count]
            .iter_mut()
            .zip(scene.channels(light, light.power()))
            .for_each(|(sum, channel)| *sum += channel);
    }
}

/// Adds the radiance that a side emits towards a direction, unless it varies over the surface.
pub(super) fn emission(scene: &Scene, side: u32, away: Direction, columns: &mut [f64]) {
    let (part, front) = (scene.parts()[side as usize / 2], side.is_multiple_of(2));
    add_emission(
        scene,
        part.light,
        front,
        |light| light.factor(away),
        columns,
    );
}

/// Adds the flux that a shape emits evenly from one side, as far as it counts: all of what leaves, less in a net.
pub(super) fn emitted_flux(
    scene: &Scene,
    placed: &Placed,
    front: bool,
    of: FluxOf,
    columns: &mut [f64],
) {
    let sign = match of {
        FluxOf::Leaving | FluxOf::Emitted => 1.0,
        FluxOf::Net => -1.0,
        FluxOf::Incident | FluxOf::Absorbed => return,
    };
    let light = placed
        .parts
        .first()
        .and_then(|part| scene.parts()[part.0 as usize].light);
    add_emission(
        scene,
        light,
        front,
        |_| sign * std::f64::consts::PI * placed.form.area(),
        columns,
    );
}

fn add_emission(
    scene: &Scene,
    light: Option<crate::light::LightId>,
    front: bool,
    factor: impl Fn(&Light) -> f64,
    columns: &mut [f64],
) {
    let count = scene.lanes().count();
    let Some(light) = light.map(|id| &scene.lights()[id.0 as usize]) else {
        return;
    };
    let varies = matches!(&light.kind, Kind::Area(area) if !area.textures.is_empty());
    if let Some((_, two_sided)) = light.surface()
        && (front || two_sided)
        && !varies
    {
        let factor = factor(light);
        let column = &mut columns[light.group as usize * count..][..count];
        column
            .iter_mut()
            .zip(scene.channels(light, light.power()))
            .for_each(|(sum, channel)| *sum += factor * channel);
    }
}
