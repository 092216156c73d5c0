//! Lights without extent: points, spots, and lines made of many of them.

use serde_json::Value;
use steradian::geometry::{Point, Vector};
use steradian::quantity::Angle;
use steradian::scene::description::{
    LightDescription, PointPower, Repeat, SceneDescription, SpotBeam,
};

use super::table::{number, triple};
use super::{Case, Experiment};
use crate::scenes::*;

pub(super) fn experiments(case: &Case) -> Option<Vec<Experiment>> {
    Some(match case.kind() {
        "point_light" | "several_point_lights" => vec![point_lights(case)],
        "point_light_from_flux" => vec![point_light_from_flux(case)],
        "spot_uniform_cone" => vec![uniform_cone(case)],
        "spot_gltf_KHR_lights_punctual" => vec![smooth_spot(case)],
        "cosine_power_source" => vec![cosine_power(case)],
        "line_source" => finite_line(case),
        "infinite_line_source" => infinite_line(case),
        _ => return None,
    })
}

fn lit_by(light: LightDescription) -> SceneDescription {
    scene([], [], [light])
}

fn point_lights(case: &Case) -> Experiment {
    let light = |light: &Value| {
        let [x, y, z] = triple(&light["position"]);
        point_light(p(x, y, z), intensity(number(&light["intensity"])))
    };
    let lights: Vec<_> = case.list("lights").iter().map(light).collect();
    let receiver = [(case.point("point"), case.vector("normal"))];
    Experiment::new(scene([], [], lights)).read("value", irradiance_at(receiver))
}

fn point_light_from_flux(case: &Case) -> Experiment {
    let light = point_light(
        p(0.0, 0.0, case.number("distance")),
        flux(case.number("flux")),
    );
    Experiment::new(lit_by(light)).read("value", irradiance_at([(Point::ORIGIN, UP)]))
}

/// One metre in front of a light the irradiance is its intensity.
fn uniform_cone(case: &Case) -> Experiment {
    let (position, axis) = (case.point("position"), case.vector("direction"));
    let beam = even_beam(case.number("half_angle_deg"));
    let light = spot(position, axis, beam, flux(case.number("flux")));
    let receiver = (case.point("point"), case.vector("normal"));
    Experiment::new(lit_by(light))
        .read("intensity", irradiance_at([(position + axis, -axis)]))
        .read("E_on_axis", irradiance_at([receiver]))
}

/// The whole beam passes a disc a metre below that is as wide as the cone.
fn smooth_spot(case: &Case) -> Experiment {
    let (position, axis) = (case.point("position"), case.vector("direction"));
    let cutoff = Angle::from_degrees(case.number("outer_deg"));
    let inner = Angle::from_degrees(case.number("inner_deg"));
    let power = intensity(case.number("intensity"));
    let light = spot(position, axis, SpotBeam::Smooth { inner, cutoff }, power);
    let target = disc(position + axis, -axis, 1.001 * cutoff.tan());
    along_x(case, "E_at_x", Experiment::new(lit_by(light))).read("total_flux", flux_through(target))
}

/// The whole beam passes a sphere around the light.
fn cosine_power(case: &Case) -> Experiment {
    let position = case.point("position");
    let power = intensity(case.number("I0"));
    let beam = cosine_beam(case.number("exponent"));
    let light = spot(position, case.vector("direction"), beam, power);
    let experiment = Experiment::new(lit_by(light))
        .read(
            "total_flux",
            flux_through(hollow_sphere(position, 1.0, &[])),
        )
        .read("E_below", irradiance_at([(Point::ORIGIN, UP)]));
    along_x(case, "E_at_x", experiment)
}

fn along_x(case: &Case, prefix: &str, experiment: Experiment) -> Experiment {
    let point = |(name, x): (String, Vec<f64>)| (name, p(x[0], 0.0, 0.0), UP);
    experiment.read_points(case.series(prefix).into_iter().map(point).collect())
}

/// Lights in a row. The midpoint rule of step s errs by at most (s²/24) ∫|f″| dx, and f falls to both sides of one peak,
/// so that ∫|f″| dx ≤ 4 max|f′|.
#[derive(Copy, Clone)]
struct Row {
    height: f64,
    from: f64,
    to: f64,
    per_length: f64,
    lights: u32,
}

/// So many lights are summed exactly.
const SUMMED: u32 = 1000;

/// Of so many some are chosen.
const CHOSEN: u32 = 100_000;

impl Row {
    fn step(self) -> f64 {
        (self.to - self.from) / f64::from(self.lights)
    }

    fn repeated(self, light: impl Fn(Point, PointPower) -> LightDescription) -> SceneDescription {
        let first = p(self.from + 0.5 * self.step(), 0.0, self.height);
        let repeat = Repeat {
            count: vec![self.lights],
            step: vec![Vector::new(self.step(), 0.0, 0.0)],
        };
        let power = intensity(self.per_length * self.step());
        lit_by(LightDescription {
            repeat: Some(repeat),
            ..light(first, power)
        })
    }

    fn bias(self, steepest: f64) -> f64 {
        let step = self.step();
        step * step / 6.0 * self.per_length * steepest / (self.height * self.height * self.height)
    }

    /// f = k h/(x² + h²)^(3/2), steepest at x = h/2: max|f′| = .859 k/h³.
    fn isotropic(self, cut: f64) -> Experiment {
        Experiment::new(self.repeated(point_light))
            .read("E_isotropic", irradiance_at([(Point::ORIGIN, UP)]))
            .with_bias(self.bias(0.859) + cut)
    }

    /// f = k h²/(x² + h²)², steepest at x = h/√5: max|f′| = 1.036 k/h³.
    fn lambertian(self, cut: f64) -> Experiment {
        let light = |position, power| spot(position, DOWN, cosine_beam(1.0), power);
        Experiment::new(self.repeated(light))
            .read("E_lambertian", irradiance_at([(Point::ORIGIN, UP)]))
            .with_bias(self.bias(1.036) + cut)
    }
}

fn finite_line(case: &Case) -> Vec<Experiment> {
    let row = Row {
        height: case.number("height"),
        from: case.number("x_from"),
        to: case.number("x_to"),
        per_length: case.number("intensity_per_length"),
        lights: SUMMED,
    };
    vec![row.isotropic(0.0), row.lambertian(0.0)]
}

/// Beyond ± X = 1000 h the line gives 2k ∫ h/x³ dx = k h/X² at most, or 2k h²/(3X³) with the cosine of the element.
fn infinite_line(case: &Case) -> Vec<Experiment> {
    let (height, per_length) = (case.number("height"), case.number("intensity_per_length"));
    let end = 1000.0 * height;
    let row = Row {
        height,
        from: -end,
        to: end,
        per_length,
        lights: CHOSEN,
    };
    let cut = per_length * height / (end * end);
    vec![row.isotropic(cut), row.lambertian(cut * height / end)]
}
