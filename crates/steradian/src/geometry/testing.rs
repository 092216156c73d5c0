//! What the tests of this module share.

use proptest::prelude::*;

use std::f64::consts::TAU;

use super::{Direction, Frame, Spherical, Vector};
use crate::quantity::Angle;

/// Whether two numbers differ by at most `tolerance`.
pub(crate) fn close(found: f64, expected: f64, tolerance: f64) -> bool {
    (found - expected).abs() <= tolerance
}

/// Directions all over the sphere.
pub(crate) fn any_direction() -> impl Strategy<Value = Direction> {
    prop::array::uniform3(-1.0..1.0_f64).prop_filter_map("too short", |v| {
        (Vector::from(v).length() > 0.1).then(|| Direction::new(v.into()).ok())?
    })
}

/// Vectors in a box of side `2 size` around the origin.
pub(crate) fn any_vector(size: f64) -> impl Strategy<Value = Vector> {
    prop::array::uniform3(-size..size).prop_map(Vector::from)
}

/// Corners at one angle from `pole` in radians, counter-clockwise.
pub(crate) fn ring(pole: Direction, half_angle: f64, corners: u32) -> Vec<Direction> {
    let frame = Frame::from_normal(pole);
    let corner = |index| {
        let phi = Angle::from_radians(TAU * f64::from(index) / f64::from(corners));
        frame.to_world(Spherical::new(Angle::from_radians(half_angle), phi).to_direction())
    };
    (0..corners).map(corner).collect()
}

#[test]
fn closeness_refuses_what_is_further_and_what_is_not_a_number() {
    assert!(close(1.0, 1.5, 0.5));
    assert!(!close(1.0, 1.5, 0.4));
    assert!(!close(f64::NAN, 1.0, 1.0));
}
