//! What the tests of this module share.

use proptest::prelude::*;

use super::{Direction, Vector};

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

#[test]
fn closeness_refuses_what_is_further_and_what_is_not_a_number() {
    assert!(close(1.0, 1.5, 0.5));
    assert!(!close(1.0, 1.5, 0.4));
    assert!(!close(f64::NAN, 1.0, 1.0));
}
