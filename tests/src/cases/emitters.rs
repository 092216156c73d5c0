//! Surfaces that emit, seen from points and through surfaces.

use steradian::geometry::{Point, Vector};
use steradian::scene::description::{SceneDescription, ShapeDescription};

use super::{Case, Experiment};
use crate::scenes::*;

pub(super) fn experiments(case: &Case) -> Option<Vec<Experiment>> {
    Some(match case.kind() {
        "rectangular_emitter" => vec![at_point(case, quadrilateral(&case.points("vertices")))],
        "polygon_emitter" => vec![at_point(case, polygon(case.points("vertices")))],
        "rectangular_emitter_fluence" => vec![fluence(case)],
        "spherical_light" => vec![at_point(
            case,
            ball(case.point("centre"), case.number("radius")),
        )],
        "disc_light" => {
            let (center, axis) = (case.point("centre"), case.vector("axis"));
            vec![at_point(case, disc(center, axis, case.number("radius")))]
        }
        "occluded_rectangular_emitter" => occluded(case),
        "flux_rect_to_parallel_sensor" => vec![rectangle_to_rectangle(case)],
        "flux_disc_to_coaxial_disc_sensor" => vec![disc_to_disc(case)],
        "camera_image_irradiance" => vec![camera_image(case)],
        _ => return None,
    })
}

fn quadrilateral(vertices: &[Point]) -> ShapeDescription {
    rectangle(
        vertices[0],
        [vertices[1] - vertices[0], vertices[3] - vertices[0]],
    )
}

fn emitter(case: &Case, shape: ShapeDescription) -> SceneDescription {
    scene([], [shape.emitting(radiance(case.number("radiance")))], [])
}

fn receiver(case: &Case) -> (Point, Vector) {
    (case.point("point"), case.vector("normal"))
}

fn at_point(case: &Case, shape: ShapeDescription) -> Experiment {
    Experiment::new(emitter(case, shape)).read("value", irradiance_at([receiver(case)]))
}

fn fluence(case: &Case) -> Experiment {
    let shape = quadrilateral(&case.points("vertices"));
    Experiment::new(emitter(case, shape)).read("value", scalar_irradiance_at(case.point("point")))
}

fn occluded(case: &Case) -> Vec<Experiment> {
    let open = emitter(case, quadrilateral(&case.points("emitter")));
    let mut hidden = open.clone();
    hidden.shapes.push(polygon(case.points("occluder")));
    let whole = case.expected("E_unoccluded");
    vec![
        Experiment::new(hidden)
            .read("E", irradiance_at([receiver(case)]))
            .read_again("visible_fraction_of_E", "E")
            .with_factor(1.0 / whole),
        Experiment::new(open).read("E_unoccluded", irradiance_at([receiver(case)])),
    ]
}

/// A rectangle of a table, its front up or down.
fn parallel_rectangle(case: &Case, key: &str) -> ShapeDescription {
    let (x, y) = (
        case.numbers(&format!("{key}/x")),
        case.numbers(&format!("{key}/y")),
    );
    let corner = p(x[0], y[0], case.number(&format!("{key}/z")));
    let mut edges = [v(x[1] - x[0], 0.0, 0.0), v(0.0, y[1] - y[0], 0.0)];
    if case.value(&format!("{key}/facing")) == "-z" {
        edges.reverse();
    }
    rectangle(corner, edges)
}

fn rectangle_to_rectangle(case: &Case) -> Experiment {
    let sensor = || flux_through(parallel_rectangle(case, "sensor"));
    Experiment::new(emitter(case, parallel_rectangle(case, "emitter")))
        .read("flux", sensor())
        .read("mean_irradiance", sensor())
        .as_quantity("mean")
}

fn disc_to_disc(case: &Case) -> Experiment {
    let sensor = disc(
        p(0.0, 0.0, case.number("distance")),
        DOWN,
        case.number("sensor_radius"),
    );
    let shape = disc(Point::ORIGIN, UP, case.number("emitter_radius"));
    Experiment::new(emitter(case, shape)).read("value", flux_through(sensor))
}

/// A point of the image sees the lens, a metre away and 1/N wide, as a disc of the object's radiance. The expected value
/// is the limit of a small aperture, which leaves out terms of 1/(4N²).
fn camera_image(case: &Case) -> Experiment {
    let f_number = case.number("f_number");
    let off_axis = steradian::quantity::Angle::from_degrees(case.number("off_axis_deg")).tan();
    let lens = disc(p(0.0, 0.0, 1.0), DOWN, 0.5 / f_number);
    Experiment::new(emitter(case, lens))
        .read("value", irradiance_at([(p(off_axis, 0.0, 0.0), UP)]))
        .with_bias(0.25 / (f_number * f_number) * case.expected("value"))
}
