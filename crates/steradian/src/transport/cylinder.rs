//! Meters of cylindrical and semicylindrical irradiance: the mean over the side of a small cylinder, or over half of it.
//!
//! ```text
//! E_z  = (1/2π) ∫ E(n_φ) dφ over the turn       = (1/π) ∫ L sinε dω
//! E_sc = (1/π)  ∫ E(n_φ) dφ over |φ| ≤ 90°      = (1/π) ∫ L sinε (1 + cosα) dω
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E(n_φ) | irradiance of a plane whose normal is across the axis, at angle φ | W/m² |
//! | ε | angle of the incoming direction d_i from the axis | rad |
//! | α | angle about the axis between d_i and the direction that the half faces | rad |
//!
//! Light from d_i on a plane counts with sinε max(0, cos(φ − α)), whose integral over the turn is 2 sinε, and over the half
//! turn sinε (1 + cosα). (EN 12464-1:2021, 3.2 and 4.6; EN 13201-3:2015, eq. 16 and 17, whose E_sc of a lamp this is.)
//!
//! So a path draws a normal, uniformly, and goes on as that of a plane: each weight is bounded as there.

use std::f64::consts::PI;

use super::columns::Place;
use super::exact;
use super::tables::Tables;
use crate::geometry::{Direction, Frame, Point};
use crate::sensor::Cylinder;

/// A small cylinder in kernel coordinates.
pub(super) struct CylinderMeter {
    point: [f32; 3],
    /// Two directions across the axis; the first is what a half faces.
    across: [[f32; 3]; 2],
    /// Angle of the arc that normals are drawn from.
    arc: f64,
}

impl CylinderMeter {
    pub fn new(cylinder: &Cylinder, point: [f32; 3]) -> Self {
        let (first, second) = across(cylinder);
        Self {
            point,
            across: [first, second].map(|axis| axis.to_array().map(|x| x as f32)),
            arc: if cylinder.facing.is_some() {
                PI
            } else {
                2.0 * PI
            },
        }
    }

    /// A plane through the point with a normal drawn by a number from 0 to 1.
    pub fn place(&self, u: f32) -> Place {
        let angle = (f64::from(u) - 0.5) * self.arc;
        let (sine, cosine) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
        let [first, second] = self.across;
        Place {
            point: self.point,
            normal: std::array::from_fn(|axis| cosine * first[axis] + sine * second[axis]),
            clearance: 0.0,
        }
    }
}

fn across(cylinder: &Cylinder) -> (Direction, Direction) {
    let frame = Frame::from_normal(cylinder.axis);
    match cylinder.facing {
        None => (frame.tangent(), frame.bitangent()),
        Some(facing) => {
            let side = cylinder.axis.cross(facing);
            (facing, Direction::new(side).unwrap_or(frame.bitangent()))
        }
    }
}

/// What lights without extent give at a point: Σ E_n sinε/π, or Σ E_n sinε (1 + cosα)/π; E_n by column.
pub(super) fn exact(tables: &Tables<'_>, cylinder: &Cylinder, point: Point) -> Vec<f64> {
    exact::weighted(tables, point, None, 0.0, |towards| {
        weight(cylinder, towards)
    })
}

/// sinε/π, and times 1 + cosα for a half.
fn weight(cylinder: &Cylinder, towards: Direction) -> f64 {
    let (first, second) = across(cylinder);
    let (x, y) = (towards.dot(first), towards.dot(second));
    let sine = (x * x + y * y).sqrt();
    match cylinder.facing {
        None => sine / PI,
        Some(_) => (sine + x) / PI,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    fn direction(x: f64, y: f64, z: f64) -> Direction {
        Direction::new(Vector::new(x, y, z)).unwrap()
    }

    fn cylinder(facing: Option<Direction>) -> Cylinder {
        Cylinder {
            position: Point::ORIGIN,
            axis: direction(0.0, 0.0, 1.0),
            facing,
            clearance: 0.0,
        }
    }

    /// Against the mean of max(0, cosθ) over the normals that paths draw, by the midpoint rule: 2/n² where the cosine has its kinks.
    #[test]
    fn weights_are_means_over_the_normals() {
        const STEPS: u32 = 20_000;
        for facing in [None, Some(direction(0.6, 0.8, 0.0))] {
            let cylinder = cylinder(facing);
            let meter = CylinderMeter::new(&cylinder, [0.0; 3]);
            for towards in [
                direction(1.0, 0.0, 0.0),
                direction(-0.3, 0.2, 0.5),
                direction(0.1, -0.9, -2.0),
                direction(0.0, 0.0, 1.0),
            ] {
                let cosine = |step: u32| {
                    let u = (f64::from(step) + 0.5) / f64::from(STEPS);
                    let normal = meter.place(u as f32).normal.map(f64::from);
                    let dot = normal.iter().zip(towards.to_array()).map(|(a, b)| a * b);
                    dot.sum::<f64>().max(0.0)
                };
                let mean = (0..STEPS).map(cosine).sum::<f64>() / f64::from(STEPS);
                // Normals are rounded to single precision.
                assert!(
                    (mean - weight(&cylinder, towards)).abs() < 1e-6,
                    "{facing:?} {towards:?}"
                );
            }
        }
    }
}
