//! Meshes: in closed form from inside and if convex, else with rays.

use std::cmp::Ordering;
use std::f64::consts::PI;

use steradian::estimation::{Estimate, Plan};
use steradian::exchange::MeshView;
use steradian::geometry::{Bounds, Direction, Point, configuration_factor, solid_angle};
use steradian::quantity::SolidAngle;

use crate::progress::Watch;
use crate::status::Failure;

/// A vertex may lie this part of the mesh's diameter before the plane of a triangle of a convex mesh: rounding of coordinates
/// in single precision.
const FLATNESS: f64 = 1e-6;
/// Rounding of winding numbers.
const ROUNDING: f64 = 1e-9;

/// How rays are sent, where they are needed.
pub struct Sampling {
    /// How many.
    pub plan: Plan,
    /// Who is told.
    pub watch: Watch,
}

/// How an observer sees a mesh.
enum Situation {
    /// It is all around.
    Inside,
    /// It is closed and convex, and the observer outside.
    Convex,
    /// The observer is on a triangle of a closed mesh.
    Touching { is_convex: bool },
    /// Parts may hide each other, or it is open.
    Any,
}

impl Situation {
    fn of(triangles: &[[Point; 3]], observer: Point) -> Self {
        let winding = solid_angle::winding_number(observer, triangles.iter().copied()).abs();
        let is = |number: f64| (winding - number).abs() < ROUNDING;
        match () {
            () if is(1.0) => Self::Inside,
            () if is(0.5) => Self::Touching {
                is_convex: is_convex(triangles),
            },
            () if is(0.0) && is_convex(triangles) => Self::Convex,
            () => Self::Any,
        }
    }
}

/// ω in sr.
pub fn solid_angle(
    triangles: &[[Point; 3]],
    observer: Point,
    sampling: &mut Sampling,
) -> Result<Estimate, Failure> {
    match Situation::of(triangles, observer) {
        Situation::Inside => Ok(Estimate::closed_form(SolidAngle::SPHERE.to_steradians())),
        Situation::Convex | Situation::Touching { is_convex: true } => {
            let found = solid_angle::of_convex_mesh(observer, triangles.iter().copied());
            Ok(Estimate::closed_form(found.to_steradians()))
        }
        Situation::Touching { is_convex: false } => Err(touching()),
        Situation::Any => {
            let view = view(triangles, observer)?;
            Ok(view.solid_angle(&sampling.plan, &mut sampling.watch)?)
        }
    }
}

/// Ω in sr for an element of this normal.
pub fn projected_solid_angle(
    triangles: &[[Point; 3]],
    observer: Point,
    normal: Direction,
    sampling: &mut Sampling,
) -> Result<Estimate, Failure> {
    let factor = |corners: &[Point; 3]| configuration_factor::of_polygon(observer, normal, corners);
    match Situation::of(triangles, observer) {
        Situation::Inside => Ok(Estimate::closed_form(PI)),
        // Each direction that meets it meets two triangles.
        Situation::Convex => {
            let sum: f64 = triangles.iter().map(factor).sum();
            Ok(Estimate::closed_form(PI * sum / 2.0))
        }
        Situation::Touching { .. } => Err(touching()),
        Situation::Any => {
            let view = view(triangles, observer)?;
            Ok(view.projected_solid_angle(normal, &sampling.plan, &mut sampling.watch)?)
        }
    }
}

fn touching() -> Failure {
    Failure::message(
        "the observer lies on a face of the mesh: rays cannot tell its sides; move it a little",
    )
}

fn view(triangles: &[[Point; 3]], observer: Point) -> Result<MeshView, Failure> {
    MeshView::new(triangles, observer).map_err(|error| Failure::message(error.to_string()))
}

fn by_coordinates(a: &[f64; 3], b: &[f64; 3]) -> Ordering {
    let mut orders = a.iter().zip(b).map(|(x, y)| x.total_cmp(y));
    orders
        .find(|order| order.is_ne())
        .unwrap_or(Ordering::Equal)
}

/// Whether no vertex is before the plane of any triangle, all of which face outwards or all inwards.
fn is_convex(triangles: &[[Point; 3]]) -> bool {
    let mut vertices: Vec<[f64; 3]> = triangles.iter().flatten().map(|p| p.to_array()).collect();
    vertices.sort_unstable_by(by_coordinates);
    vertices.dedup();
    let vertices = || vertices.iter().copied().map(Point::from);
    let slack = FLATNESS * Bounds::around(vertices()).diagonal().to_metres();
    let is_behind = |triangle: &[Point; 3], side: f64| {
        let [a, b, c] = *triangle;
        Direction::new((b - a).cross(c - a)).map_or(true, |normal| {
            vertices().all(|vertex| side * normal.dot(vertex - a) <= slack)
        })
    };
    [1.0, -1.0]
        .iter()
        .any(|&side| triangles.iter().all(|triangle| is_behind(triangle, side)))
}
