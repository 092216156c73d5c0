//! Closed environments, where light is reflected again and again.

use std::f64::consts::PI;

use steradian::geometry::{Point, Vector};
use steradian::quantity::Angle;
use steradian::scene::description::{FluxOf, MaterialDescription, SceneDescription};

use super::table::triple;
use super::{Case, Experiment};
use crate::scenes::*;

pub(super) fn experiments(case: &Case) -> Option<Vec<Experiment>> {
    Some(vec![match case.kind() {
        "integrating_sphere" => integrating_sphere(case),
        "spherical_enclosure_zones" => zones(case),
        "furnace_emitting_walls" => furnace(case),
        "furnace_truncated_bounces" => truncated_furnace(case),
        "white_furnace_object" => white_object(case),
        "convex_object_in_uniform_environment" => convex_object(case),
        "concave_hemisphere_bowl" => bowl(case),
        "infinite_parallel_plates" => plates(case),
        "concentric_spheres" => concentric_spheres(case),
        "closed_room_mean_irradiance" => closed_room(case),
        "box_radiosity_constant_faces" => black_box(case),
        "box_radiosity_continuous" => continuous_box(case),
        _ => return None,
    }])
}

/// A beam of 60° half angle starts in the centre, away from the port; the point that is read lies outside of it, so that
/// its irradiance is the indirect one, which is the same everywhere.
fn integrating_sphere(case: &Case) -> Experiment {
    let (radius, fraction) = (case.number("sphere_radius"), case.number("port_fraction"));
    let cos = 1.0 - 2.0 * fraction;
    let sin = (1.0 - cos * cos).sqrt();
    let wall = hollow_sphere(Point::ORIGIN, radius, &[(UP, libm::acos(cos).to_degrees())]);
    let lamp = spot(
        Point::ORIGIN,
        DOWN,
        even_beam(60.0),
        flux(case.number("input_flux")),
    );
    let scene = scene(
        [lambertian("white", case.number("reflectance"))],
        [wall.named("wall").made_of("white")],
        [lamp],
    );
    let point = irradiance_at([(p(radius, 0.0, 0.0), v(-1.0, 0.0, 0.0))]);
    let port = disc(p(0.0, 0.0, radius * cos), DOWN, radius * sin);
    let area = 4.0 * PI * radius * radius;
    long_paths(case.number("reflectance"), Experiment::new(scene))
        .read("wall_irradiance_indirect", point)
        .read_again("multiplier_M", "wall_irradiance_indirect")
        .with_factor(area / case.number("input_flux"))
        .read_again("radiance", "wall_irradiance_indirect")
        .with_factor(1.0 / PI)
        .read("port_flux", flux_through(port))
        .read("absorbed_by_wall", flux_of("wall", FluxOf::Absorbed))
}

/// Paths of a hundred bounces are dear: without a pilot, and with the number of samples that leaves a standard error of
/// .18 % at their relative variance of 1.3.
fn long_paths(reflectance: f64, experiment: Experiment) -> Experiment {
    if reflectance >= 0.98 {
        experiment.with_samples(400_000)
    } else {
        experiment
    }
}

/// Each zone is the sphere without the caps above and below it.
fn zones(case: &Case) -> Experiment {
    let edges = case.numbers("polar_zone_edges_deg");
    let (exitances, reflectances) = (case.numbers("exitance"), case.numbers("reflectance"));
    let name = |zone: usize| format!("zone {zone}");
    let materials: Vec<MaterialDescription> = (0..exitances.len())
        .map(|zone| lambertian(&name(zone), reflectances[zone]))
        .collect();
    let shape = |zone: usize| {
        let caps = [(UP, edges[zone]), (DOWN, 180.0 - edges[zone + 1])];
        let ports: Vec<_> = caps.into_iter().filter(|cap| cap.1 > 0.0).collect();
        let shape = hollow_sphere(Point::ORIGIN, 1.0, &ports).made_of(&name(zone));
        if exitances[zone] > 0.0 {
            shape.emitting(exitance(exitances[zone]))
        } else {
            shape
        }
    };
    let shapes: Vec<_> = (0..exitances.len()).map(shape).collect();
    let start = Experiment::new(scene(materials, shapes, [])).read(
        "irradiance_everywhere",
        irradiance_at([(p(0.0, 0.0, -1.0), UP)]),
    );
    (0..exitances.len()).fold(start, |experiment, zone| {
        let middle = Angle::from_degrees(0.5 * (edges[zone] + edges[zone + 1]));
        let ray = v(middle.sin(), 0.0, middle.cos());
        experiment
            .read(
                &format!("radiosity_zone{zone}"),
                radiance_along(Point::ORIGIN, ray),
            )
            .with_factor(PI)
    })
}

/// Any enclosure will do: a box, seen from a point off its centre.
fn furnace_scene(case: &Case) -> SceneDescription {
    let walls = room(p(1.0, 2.0, 3.0))
        .made_of("wall")
        .emitting(radiance(case.number("wall_emission_radiance")));
    scene(
        [lambertian("wall", case.number("wall_albedo"))],
        [walls],
        [],
    )
}

const OFF_CENTRE: Point = Point::new(0.4, 0.7, 1.1);
const SLANTED: Vector = Vector::new(0.3, 0.5, -0.8);

fn furnace(case: &Case) -> Experiment {
    long_paths(
        case.number("wall_albedo"),
        Experiment::new(furnace_scene(case)),
    )
    .read("radiance", radiance_along(OFF_CENTRE, SLANTED))
    .read("irradiance", irradiance_at([(p(0.4, 0.7, 0.0), UP)]))
}

/// As many segments as vertices with emission.
fn truncated_furnace(case: &Case) -> Experiment {
    Experiment::new(furnace_scene(case))
        .with_max_depth(case.number("path_vertices_with_emission") as u32)
        .read("value", radiance_along(OFF_CENTRE, SLANTED))
}

/// A ball on a box: light is reflected between the two.
fn white_object(case: &Case) -> Experiment {
    let shapes = [
        solid(p(-2.0, -2.0, -1.0), p(2.0, 2.0, 0.0)).made_of("white"),
        ball(p(0.0, 0.0, 1.0), 1.0).made_of("white"),
    ];
    let scene = scene(
        [lambertian("white", case.number("object_albedo"))],
        shapes,
        [environment(case.number("environment_radiance"))],
    );
    Experiment::new(scene).read(
        "value",
        radiance_along(p(3.0, 0.0, 1.0), v(-2.0, 0.0, -0.8)),
    )
}

fn convex_object(case: &Case) -> Experiment {
    let scene = scene(
        [lambertian("grey", case.number("albedo"))],
        [ball(Point::ORIGIN, 1.0).made_of("grey")],
        [environment(case.number("environment_radiance"))],
    );
    Experiment::new(scene).read("value", radiance_along(p(3.0, 0.5, 0.2), v(-1.0, 0.0, 0.0)))
}

fn bowl(case: &Case) -> Experiment {
    let scene = scene(
        [lambertian("grey", case.number("albedo"))],
        [hollow_sphere(Point::ORIGIN, 1.0, &[(UP, 90.0)]).made_of("grey")],
        [environment(case.number("environment_radiance"))],
    );
    Experiment::new(scene).read(
        "radiosity_over_pi",
        radiance_along(p(0.0, 0.0, 1.0), v(0.3, 0.1, -1.0)),
    )
}

fn plates(case: &Case) -> Experiment {
    let lower = ground(0.0)
        .made_of("lower")
        .emitting(exitance(case.number("exitance1")));
    let materials = [
        lambertian("lower", case.number("reflectance1")),
        lambertian("upper", case.number("reflectance2")),
    ];
    Experiment::new(scene(materials, [lower, ground(1.0).made_of("upper")], []))
        .read("B1", radiance_along(p(0.0, 0.0, 0.5), DOWN))
        .with_factor(PI)
        .read("B2", radiance_along(p(0.0, 0.0, 0.5), UP))
        .with_factor(PI)
        .read("irradiance2", irradiance_at([(p(0.0, 0.0, 1.0), DOWN)]))
}

fn concentric_spheres(case: &Case) -> Experiment {
    let (inner, outer) = (case.number("inner_radius"), case.number("outer_radius"));
    let shapes = [
        ball(Point::ORIGIN, inner)
            .made_of("inner")
            .emitting(exitance(case.number("inner_exitance"))),
        hollow_sphere(Point::ORIGIN, outer, &[]).made_of("outer"),
    ];
    let materials = [
        lambertian("inner", case.number("inner_reflectance")),
        lambertian("outer", case.number("outer_reflectance")),
    ];
    let between = p(0.5 * (inner + outer), 0.0, 0.0);
    let (inwards, outwards) = (v(-1.0, 0.0, 0.0), v(1.0, 0.0, 0.0));
    Experiment::new(scene(materials, shapes, []))
        .read("B_inner", radiance_along(between, inwards))
        .with_factor(PI)
        .read("B_outer", radiance_along(between, outwards))
        .with_factor(PI)
        .read(
            "irradiance_inner",
            irradiance_at([(p(inner, 0.0, 0.0), outwards)]),
        )
        .read(
            "irradiance_outer",
            irradiance_at([(p(outer, 0.0, 0.0), inwards)]),
        )
}

/// A cube; what leaves the walls of a closed room arrives on them, so the mean of the indirect light is the mean exitance.
pub(super) fn closed_cube(side: f64, lumens: f64, reflectance: f64) -> SceneDescription {
    let half = 0.5 * side;
    SceneDescription {
        spectrum: visible(),
        ..scene(
            [lambertian("wall", reflectance)],
            [room(p(side, side, side)).named("room").made_of("wall")],
            [point_light(p(half, half, half), luminous_flux(lumens))],
        )
    }
}

fn closed_room(case: &Case) -> Experiment {
    let side = (case.number("total_surface") / 6.0).sqrt();
    let scene = closed_cube(side, case.number("source_flux"), case.number("reflectance"));
    Experiment::new(scene)
        .read("mean_total", flux_of("room", FluxOf::Incident))
        .as_quantity("mean")
        .read("mean_indirect", flux_of("room", FluxOf::Leaving))
        .as_quantity("mean")
}

fn radiosity_box(case: &Case) -> (SceneDescription, Vec<String>) {
    let (exitances, reflectances) = (case.numbers("exitance"), case.numbers("reflectance"));
    let names: Vec<String> = case
        .list("faces")
        .iter()
        .filter_map(|name| name.as_str().map(String::from))
        .collect();
    let size = case.numbers("box");
    let faces = room_faces(Point::ORIGIN, p(size[0], size[1], size[2]));
    let shapes = faces.into_iter().enumerate().map(|(i, shape)| {
        let shape = shape.named(&names[i]).made_of(&names[i]);
        if exitances[i] > 0.0 {
            shape.emitting(exitance(exitances[i]))
        } else {
            shape
        }
    });
    let materials = names
        .iter()
        .zip(reflectances)
        .map(|(name, reflectance)| lambertian(name, reflectance));
    (
        scene(
            materials.collect::<Vec<_>>(),
            shapes.collect::<Vec<_>>(),
            [],
        ),
        names,
    )
}

/// Without reflection the exitance of each face is constant, as the case assumes.
fn black_box(case: &Case) -> Experiment {
    let (scene, names) = radiosity_box(case);
    let size = case.numbers("box");
    let centre = p(0.5 * size[0], 0.5 * size[1], 0.5 * size[2]);
    let (x, y) = (v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0));
    let towards = [DOWN, UP, -x, x, -y, y];
    names
        .iter()
        .zip(towards)
        .fold(Experiment::new(scene), |experiment, (name, ray)| {
            experiment
                .read(&format!("H_{name}"), flux_of(name, FluxOf::Incident))
                .as_quantity("mean")
                .read(&format!("B_{name}"), radiance_along(centre, ray))
                .with_factor(PI)
        })
}

/// The table gathers all patches at every point, below its plane too: at the one point within the box the number it calls
/// the irradiance is that of both sides together, as the readings of either side show.
fn continuous_box(case: &Case) -> Experiment {
    let (scene, names) = radiosity_box(case);
    let means = names
        .iter()
        .fold(Experiment::new(scene), |experiment, name| {
            experiment
                .read(&format!("mean_H_{name}"), flux_of(name, FluxOf::Incident))
                .as_quantity("mean")
        });
    let places = case.value("points").as_object().expect("named points");
    let place = |(name, place): (&String, &serde_json::Value)| {
        let [x, y, z] = triple(&place["point"]);
        let [nx, ny, nz] = triple(&place["normal"]);
        (name.clone(), p(x, y, z), v(nx, ny, nz))
    };
    let (inside, walls): (Vec<_>, Vec<_>) = places
        .iter()
        .map(place)
        .partition(|(name, ..)| name == "E_workplane_centre");
    inside
        .iter()
        .fold(means.read_points(walls), |experiment, (name, point, up)| {
            experiment.read_both_sides(name, *point, *up)
        })
}
