//! The outlines of an object on the sphere of directions around the observer.

use std::f64::consts::TAU;

use steradian::geometry::{
    Direction, Frame, Point, Spherical, SphericalPatch, Vector, solid_angle,
};
use steradian::quantity::Angle;

use super::object::{Object, faces, shows_front};
use crate::status::Failure;

/// Points of a round outline.
const ROUND: u32 = 360;
/// Longest step along a straight edge, in radians.
const STEP: f64 = 0.02;
/// More triangles than these are not drawn.
const MOST_TRIANGLES: usize = 20_000;

/// Closed outlines, one or several. What is inside any of them is filled.
pub fn outlines(object: &Object, observer: Point) -> Result<Vec<Vec<Direction>>, Failure> {
    Ok(match object {
        Object::Sphere { center, radius } => {
            let towards = *center - observer;
            let sin = radius.to_metres() / towards.length();
            let axis = Direction::new(towards)
                .ok()
                .filter(|_| sin < 1.0)
                .ok_or_else(inside)?;
            vec![ring(axis, libm::asin(sin))]
        }
        Object::Cap(half_angle) => vec![ring(Direction::Z, half_angle.to_radians())],
        Object::Disc {
            center,
            normal,
            radius,
        } => {
            let frame = Frame::from_normal(*normal);
            let axes = [frame.tangent(), frame.bitangent()].map(|axis| axis * radius.to_metres());
            vec![ellipse(*center - observer, axes)]
        }
        Object::Ellipse { center, half_axes } => vec![ellipse(*center - observer, *half_axes)],
        Object::Polygon(corners) => vec![straight(corners.iter().map(|&corner| corner - observer))],
        Object::SphericalPolygon(corners) => {
            vec![straight(corners.iter().map(|&corner| Vector::from(corner)))]
        }
        Object::Box(bounds) => {
            let turned = faces(bounds)
                .into_iter()
                .filter(|face| shows_front(observer, &face[..3]));
            turned
                .map(|face| straight(face.map(|corner| corner - observer)))
                .collect()
        }
        Object::Mesh(triangles) => mesh(triangles, observer)?,
        Object::Patch(patch) => vec![around_patch(patch)],
    })
}

fn inside() -> Failure {
    Failure::message(
        "the observer is inside the object, which fills all directions: there is nothing to draw",
    )
}

fn mesh(triangles: &[[Point; 3]], observer: Point) -> Result<Vec<Vec<Direction>>, Failure> {
    if triangles.len() > MOST_TRIANGLES {
        return Err(Failure::message(format!(
            "a mesh of more than {MOST_TRIANGLES} triangles is not drawn"
        )));
    }
    // Of a closed mesh seen from outside the fronts hide the backs.
    let winding = solid_angle::winding_number(observer, triangles.iter().copied());
    let has_backs = winding.abs() > 1e-9;
    let drawn = triangles
        .iter()
        .filter(|corners| has_backs || shows_front(observer, &corners[..]));
    Ok(drawn
        .map(|corners| straight(corners.map(|corner| corner - observer)))
        .collect())
}

fn ring(axis: Direction, half_angle: f64) -> Vec<Direction> {
    let frame = Frame::from_normal(axis);
    let at = |phi| {
        Spherical::new(Angle::from_radians(half_angle), Angle::from_radians(phi)).to_direction()
    };
    round_angles().map(|phi| frame.to_world(at(phi))).collect()
}

fn ellipse(center: Vector, [u, v]: [Vector; 2]) -> Vec<Direction> {
    round_angles()
        .filter_map(|t| Direction::new(center + u * libm::cos(t) + v * libm::sin(t)).ok())
        .collect()
}

fn round_angles() -> impl Iterator<Item = f64> {
    (0..ROUND).map(|index| TAU * f64::from(index) / f64::from(ROUND))
}

/// The arcs of great circles between corners, in small steps.
fn straight(corners: impl IntoIterator<Item = Vector>) -> Vec<Direction> {
    let corners: Vec<Direction> = corners
        .into_iter()
        .filter_map(|corner| Direction::new(corner).ok())
        .collect();
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges.flat_map(|(from, to)| arc(*from, *to)).collect()
}

/// From one direction up to but without another.
pub fn arc(from: Direction, to: Direction) -> Vec<Direction> {
    let steps = (libm::acos(from.dot(to).clamp(-1.0, 1.0)) / STEP)
        .ceil()
        .max(1.0) as u32;
    // Points on the chord are spread less evenly than on the arc, which does not matter for steps so small or long.
    let at = |index| {
        let t = f64::from(index) / f64::from(steps);
        Direction::new(from * (1.0 - t) + to * t).ok()
    };
    (0..steps).filter_map(at).collect()
}

fn around_patch(patch: &SphericalPatch) -> Vec<Direction> {
    let ([top, bottom], [west, east]) = (patch.theta(), patch.phi());
    let corners = [(top, west), (bottom, west), (bottom, east), (top, east)];
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let steps = ROUND / 2;
    sides
        .flat_map(|(&(theta, phi), &(next_theta, next_phi))| {
            (0..steps).map(move |index| {
                let t = f64::from(index) / f64::from(steps);
                Spherical::new(theta + (next_theta - theta) * t, phi + (next_phi - phi) * t)
                    .to_direction()
            })
        })
        .collect()
}
