//! The ways to ∫ ∫ ln r agree.

use super::super::outline::Edge;
use super::super::{closed_forms, logarithm};
use crate::geometry::Vector;
use crate::geometry::testing::{any_vector, close};
use proptest::prelude::*;

fn edge(start: Vector, end: Vector) -> Edge {
    Edge::new(start, end).unwrap()
}

/// What a closed form may be off by, as a part of the product of the lengths: its four terms are at most 64 times that product
/// times ¼ ln r² + π/4 + ¾ ≤ 4 for edges of at least 1e-4 m within 10 m, each rounded by 2⁻⁵².
const CLOSED_FORM: f64 = 4.0 * 64.0 * 4.0 * f64::EPSILON;

/// What [`logarithm::graded`] may be off by for rounding, as a part of the product of the lengths: the two terms u ln r of its closed
/// form, each by 4 · 2⁻⁵², over the length of its edge.
fn rounding_of_graded(a: &Edge, b: &Edge) -> f64 {
    let reach = (a.middle() - b.middle()).length() + a.length + b.length;
    8.0 * f64::EPSILON * (1.0 + reach * (1.0 + libm::log(reach).abs()) / b.length)
}

fn assert_agreement(a: &Edge, b: &Edge) -> Result<(), TestCaseError> {
    let (a, b) = if a.length < b.length { (a, b) } else { (b, a) };
    let unit = a.length * b.length;
    let (graded, rounding) = (logarithm::graded(a, b), rounding_of_graded(a, b));
    if let Some(closed) =
        closed_forms::over_parallel_edges(a, b).or_else(|| closed_forms::over_skew_edges(a, b))
    {
        prop_assert!(
            close(closed / unit, graded / unit, CLOSED_FORM + rounding),
            "{closed} {graded}"
        );
    }
    if let Some(product) = logarithm::far_apart(a, b) {
        prop_assert!(
            close(product / unit, graded / unit, 1e-14 + rounding),
            "{product} {graded}"
        );
    }
    Ok(())
}

proptest! {
    #[test]
    fn between_edges_anywhere([a, b, c, d] in prop::array::uniform4(any_vector(1.0))) {
        prop_assume!((b - a).length() > 0.01 && (d - c).length() > 0.01);
        assert_agreement(&edge(a, b), &edge(c, d))?;
    }

    #[test]
    fn between_parallel_edges([a, b, c] in prop::array::uniform3(any_vector(1.0)), ratio in -3.0..3.0_f64) {
        prop_assume!((b - a).length() > 0.01 && ratio.abs() > 0.01);
        assert_agreement(&edge(a, b), &edge(c, c + (b - a) * ratio))?;
    }

    #[test]
    fn between_edges_that_meet([a, b, c] in prop::array::uniform3(any_vector(1.0)), t in 0.0..1.0_f64) {
        prop_assume!((b - a).length() > 0.01 && (c - b).length() > 0.01);
        let inside = a + (b - a) * t;
        for (from, to) in [(b, c), (c, a), (a, b), (a, inside), (inside, c)] {
            prop_assume!((to - from).length() > 0.01);
            assert_agreement(&edge(a, b), &edge(from, to))?;
        }
    }

    #[test]
    fn between_edges_that_nearly_touch(
        [a, b, c, d] in prop::array::uniform4(any_vector(1.0)), exponent in -14.0..-2.0_f64, t in 0.0..1.0_f64,
    ) {
        prop_assume!((b - a).length() > 0.1 && (d - c).length() > 0.1);
        let shift = a + (b - a) * t - c + d * libm::exp10(exponent);
        assert_agreement(&edge(a, b), &edge(c + shift, d + shift))?;
        let nearly_parallel = edge(a + c * libm::exp10(exponent), b + d * libm::exp10(exponent));
        assert_agreement(&edge(a, b), &nearly_parallel)?;
    }
}

#[test]
fn a_unit_edge_with_itself() {
    // ∫₀¹ ∫₀¹ ln |s − t| ds dt = −3/2.
    let unit = edge(Vector::ZERO, Vector::new(0.0, 1.0, 0.0));
    assert!(close(logarithm::over_edges(&unit, &unit), -1.5, 1e-15));
    assert!(close(logarithm::graded(&unit, &unit), -1.5, 1e-14));
    assert_eq!(
        logarithm::over_edges(&unit, &unit.reversed()),
        logarithm::over_edges(&unit, &unit)
    );
}

#[test]
fn unit_edges_at_a_right_angle_with_a_common_end() {
    // ∫₀¹ ∫₀¹ ½ ln(s² + t²) ds dt = ½ ln 2 + π/4 − 3/2, and the closed form is used before cosθ makes it vanish.
    let (a, b) = (
        edge(Vector::ZERO, Vector::new(1.0, 0.0, 0.0)),
        edge(Vector::ZERO, Vector::new(0.0, 1.0, 0.0)),
    );
    let expected = 0.5 * libm::log(2.0) + std::f64::consts::FRAC_PI_4 - 1.5;
    assert!(close(logarithm::over_edges(&a, &b), expected, 1e-15));
}
