//! A sky of constant radiance, with a ground, a horizon, roofs and façades.

use steradian::geometry::{Point, Vector};
use steradian::quantity::Angle;
use steradian::scene::description::{SceneDescription, ShapeDescription};

use super::{Case, Experiment};
use crate::scenes::*;

pub(super) fn experiments(case: &Case) -> Option<Vec<Experiment>> {
    Some(match case.kind() {
        "uniform_sky_tilted" => vec![tilted(case, scene([], [ground(0.0)], sky()))],
        "uniform_sky_plus_ground" => {
            let soil = lambertian("soil", case.number("ground_reflectance"));
            vec![tilted(
                case,
                scene([soil], [ground(0.0).made_of("soil")], sky()),
            )]
        }
        "uniform_sky_horizon_cut" => vec![horizon(case)],
        "environment_linear" => vec![constant_environment(case)],
        _ => return None,
    })
}

fn sky() -> [steradian::scene::description::LightDescription; 1] {
    [environment(1.0)]
}

/// A receiver a metre above the ground, its normal leaning by the tilt.
fn tilted(case: &Case, scene: SceneDescription) -> Experiment {
    let tilt = Angle::from_degrees(case.number("tilt_deg"));
    let receiver = (p(0.0, 0.0, 1.0), v(tilt.sin(), 0.0, tilt.cos()));
    Experiment::new(scene).read("value", irradiance_at([receiver]))
}

/// A black sphere around the receiver is open above the horizon.
fn horizon(case: &Case) -> Experiment {
    let open = 90.0 - case.number("horizon_elevation_deg");
    let shell = hollow_sphere(Point::ORIGIN, 1.0, &[(UP, open)]);
    Experiment::new(scene([], [shell], sky())).read("value", irradiance_at([(Point::ORIGIN, UP)]))
}

fn constant_environment(case: &Case) -> Experiment {
    assert_eq!(case.number("b"), 0.0, "{} is not constant", case.id);
    let receiver = (Point::ORIGIN, case.vector("normal"));
    Experiment::new(scene([], [], [environment(case.number("a"))]))
        .read("value", irradiance_at([receiver]))
}

/// Percent of the horizontal irradiance π of a sky of radiance 1. A window is a rare event of even weight, which
/// quasi-Monte Carlo points find more evenly than the plan of a tolerance assumes: so many samples do.
pub(super) fn sky_component(
    shapes: Vec<ShapeDescription>,
    points: Vec<(String, Point, Vector)>,
) -> Experiment {
    Experiment::new(scene([], shapes, sky()))
        .with_samples(1 << 21)
        .read_points(points)
        .times(100.0 / std::f64::consts::PI)
}
