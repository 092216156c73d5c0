//! ∫ ∫ ln r over two straight edges, by the cheapest way that keeps the digits.
//!
//! | edges | way |
//! |---|---|
//! | parallel | the closed form |
//! | some lengths apart | a product of two Gauss rules |
//! | skew | the closed form |
//! | else, where a closed form would lose digits: nearly parallel, or far off in comparison with the shorter | the closed form along the longer edge, graded Gauss rules along the other |

use super::closed_forms;
use super::outline::Edge;
use crate::geometry::Vector;
use crate::geometry::gauss::{self, MAX_ORDER};

/// What is left out of an integral of this kind, in units of the product of the lengths: half a unit in the last place.
const TOLERANCE: f64 = f64::EPSILON / 4.0;

/// ∫ ∫ ln |x − y| ds dt over the edges a ∋ x and b ∋ y.
pub(super) fn over_edges(a: &Edge, b: &Edge) -> f64 {
    closed_forms::over_parallel_edges(a, b)
        .or_else(|| far_apart(a, b))
        .or_else(|| closed_forms::over_skew_edges(a, b))
        .unwrap_or_else(|| {
            if a.length < b.length {
                graded(a, b)
            } else {
                graded(b, a)
            }
        })
}

/// ∫ ln |x − y| dt over the edge y ∈ b, seen from the point x: with the edge's ends at u₁, u₂ along the line from the foot of x,
/// u₂ ln r₂ − u₁ ln r₁ − (u₂ − u₁) + ϱ ψ, where ϱ is the distance of the line and ψ the angle that b subtends.
pub(super) fn along(b: &Edge, x: Vector) -> f64 {
    let (to_start, to_end) = (b.start - x, b.end - x);
    let (from, to) = (to_start.dot(b.direction), to_end.dot(b.direction));
    let nearer = if from.abs() < to.abs() {
        to_start
    } else {
        to_end
    };
    let distance = nearer.cross(b.direction).length();
    let subtended = libm::atan2(distance * b.length, distance * distance + from * to);
    to * half_logarithm(to_end) - from * half_logarithm(to_start) - b.length + distance * subtended
}

/// ln |v|; 0 for v = 0, where it is multiplied with 0.
fn half_logarithm(v: Vector) -> f64 {
    let square = v.length_squared();
    if square > 0.0 {
        0.5 * libm::log(square)
    } else {
        0.0
    }
}

/// A product of Gauss rules, if the edges are so far apart that few nodes are enough.
///
/// ln r along a has its singularities at the complex points s of the line with r = 0, whose distance from the middle of a is
/// that of y. With the half lengths e and the distance D of the middles it is at least κ = (D − e_b)/e_a half lengths, and
/// ϱ ≥ κ + √(κ² − 1). The Chebyshev coefficients of ln r² fall as (4/k) ϱ⁻ᵏ, so that the error is below (5/n) ϱ⁻²ⁿ of
/// the length.
pub(super) fn far_apart(a: &Edge, b: &Edge) -> Option<f64> {
    let apart = (b.middle() - a.middle()).length();
    let order = |edge: &Edge, other: &Edge| {
        let kappa = (2.0 * apart - other.length) / edge.length;
        let order = gauss::order_for(kappa + (kappa * kappa - 1.0).max(0.0).sqrt(), TOLERANCE)?;
        Some(order.next_multiple_of(2))
    };
    Some(product_rule(a, order(a, b)?, b, order(b, a)?))
}

/// Orders are even. Four nodes at a time have the same weight, so that one logarithm serves four.
fn product_rule(a: &Edge, order_a: usize, b: &Edge, order_b: usize) -> f64 {
    let apart = a.middle() - b.middle();
    let (half_a, half_b) = (
        a.direction * (0.5 * a.length),
        b.direction * (0.5 * b.length),
    );
    let mut sum = 0.0;
    for &(x, weight_x) in &gauss::rule(order_a)[..order_a / 2] {
        let (here, there) = (apart + half_a * x, apart - half_a * x);
        let squares = [here.length_squared(), there.length_squared()];
        let shifts = [2.0 * here.dot(half_b), 2.0 * there.dot(half_b)];
        for &(y, weight_y) in &gauss::rule(order_b)[..order_b / 2] {
            let square = y * y * half_b.length_squared();
            let pair = |k: usize| {
                (squares[k] + square) * (squares[k] + square) - y * y * shifts[k] * shifts[k]
            };
            sum += weight_x * weight_y * libm::log(pair(0) * pair(1));
        }
    }
    0.125 * a.length * b.length * sum
}

/// Gauss rules along a of the closed form along b, on panels that get shorter towards the singularities: the feet of
/// b's ends on the line through a, and the point where the lines come closest.
///
/// Each panel is so short that [`order_for`](gauss::order_for) finds a rule, or so short that, the integrand being
/// continuous, what happens inside is lost in rounding.
pub(super) fn graded(a: &Edge, b: &Edge) -> f64 {
    let singularities = [foot(a, b.start), foot(a, b.end), closest_approach(a, b)];
    graded_panel(a, b, [0.0, a.length], &singularities)
}

/// A panel's length below which it is no longer divided, as a share of the edge: its square is 2⁻⁵⁶.
const SHORTEST: f64 = 4e-9;

fn graded_panel(a: &Edge, b: &Edge, [from, to]: [f64; 2], singularities: &[(f64, f64); 3]) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let rho = |&(re, im): &(f64, f64)| gauss::ellipse_through((re - middle) / half, im / half);
    let rho = singularities.iter().map(rho).fold(f64::INFINITY, f64::min);
    let order =
        gauss::order_for(rho, TOLERANCE).or((to - from < SHORTEST * a.length).then_some(MAX_ORDER));
    if let Some(order) = order {
        return gauss::integrate(order, [from, to], |s| along(b, a.at(s)));
    }
    let is_inside = |&&(re, im): &&(f64, f64)| im < half && (re - middle).abs() < 0.99 * half;
    let cut = singularities
        .iter()
        .find(is_inside)
        .map_or(middle, |&(re, _)| re);
    graded_panel(a, b, [from, cut], singularities) + graded_panel(a, b, [cut, to], singularities)
}

/// Where along a the point comes closest, and how close.
fn foot(a: &Edge, point: Vector) -> (f64, f64) {
    let offset = point - a.start;
    (offset.dot(a.direction), offset.cross(a.direction).length())
}

/// The same for the line through b: the root s of ϱ(s)² = h² + (s − s₀)² sin²α, with h the distance of the lines and α their
/// angle.
fn closest_approach(a: &Edge, b: &Edge) -> (f64, f64) {
    let normal = a.direction.cross(b.direction);
    let sin_square = normal.length_squared();
    if sin_square < f64::EPSILON * f64::EPSILON {
        return (f64::INFINITY, 0.0);
    }
    let offset = b.start - a.start;
    let at = offset.cross(b.direction).dot(normal) / sin_square;
    (at, offset.dot(normal).abs() / sin_square)
}
