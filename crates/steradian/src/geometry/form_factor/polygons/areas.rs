//! Exchange areas of polygons that are small against their distance, by Gauss quadrature over areas: no digits cancel.
//!
//! The areas are cut into the triangles of a fan, with signs, which a holes' ring or a concave one needs; the integrand is
//! smooth far beyond the outline. In each of a triangle's coordinates the nodes lie within the outline's ball of radius R, and
//! the nearest singularity at κR or more from its middle, so that n nodes leave a relative error of ϱ⁻²ⁿ⁺¹ with
//! ϱ = κ + √(κ² − 1) (see [`gauss`]); the 1 is for the triangle's Jacobian.

use std::f64::consts::{PI, TAU};

use super::outline::{Edge, Outline};
use crate::geometry::Vector;
use crate::geometry::gauss;

/// ∫ ∫ cosθ₁ cosθ₂/(π r²) dA₂ dA₁ by nodes on both areas.
pub(super) fn both(a: &Outline, b: &Outline) -> Option<f64> {
    let apart = (b.center - a.center).length();
    let order = |outline: &Outline, other: &Outline| order(outline, apart - other.radius);
    let (nodes_a, nodes_b) = (nodes(a, order(a, b)?), nodes(b, order(b, a)?));
    let mut sum = 0.0;
    for (x, weight_x) in &nodes_a {
        for (y, weight_y) in &nodes_b {
            let r = *y - *x;
            let square = r.length_squared();
            sum -= weight_x * weight_y * a.normal.dot(r) * b.normal.dot(r) / (square * square);
        }
    }
    Some(sum / PI)
}

/// The same with the configuration factor of the large polygon at nodes on the small one.
pub(super) fn small_and_large(small: &Outline, large: &Outline) -> Option<f64> {
    let distance = large
        .edges()
        .map(|edge| edge.distance(small.center))
        .fold(f64::INFINITY, f64::min);
    let nodes = nodes(small, order(small, distance)?);
    Some(
        nodes
            .iter()
            .map(|&(x, weight)| weight * configuration_factor(x, small.normal, large))
            .sum(),
    )
}

/// The relative error.
const TOLERANCE: f64 = 1e-14;

/// For a function whose singularities are this far from the centre.
fn order(outline: &Outline, distance: f64) -> Option<usize> {
    let kappa = distance / outline.radius;
    let rho = kappa + (kappa * kappa - 1.0).max(0.0).sqrt();
    gauss::order_for(rho, TOLERANCE / rho)
}

/// Lambert's sum (see [`configuration_factor`](crate::geometry::configuration_factor)) for an outline above the horizon.
fn configuration_factor(position: Vector, normal: Vector, outline: &Outline) -> f64 {
    let term = |edge: &Edge| {
        let (from, to) = (edge.start - position, edge.end - position);
        let axis = from.cross(edge.direction * edge.length);
        let length = axis.length();
        if length == 0.0 {
            0.0
        } else {
            libm::atan2(length, from.dot(to)) * normal.dot(axis) / length
        }
    };
    -outline.edges().map(term).sum::<f64>() / TAU
}

/// Nodes and weights of ∫ dA, on the triangles of a fan with their signs.
fn nodes(outline: &Outline, order: usize) -> Vec<(Vector, f64)> {
    let mut nodes = Vec::new();
    for ring in &outline.rings {
        let apex = ring[0].start;
        for edge in &ring[1..ring.len() - 1] {
            let (u, v) = (edge.start - apex, edge.end - edge.start);
            let twice_area = outline.normal.dot(u.cross(v));
            for &(x, weight_x) in gauss::rule(order) {
                for &(y, weight_y) in gauss::rule(order) {
                    let (x, y) = (0.5 + 0.5 * x, 0.5 + 0.5 * y);
                    nodes.push((
                        apex + (u + v * y) * x,
                        0.25 * weight_x * weight_y * x * twice_area,
                    ));
                }
            }
        }
    }
    nodes
}
