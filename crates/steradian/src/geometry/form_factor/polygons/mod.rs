//! Any two polygons, convex or not, with holes or not, wherever they are.
//!
//! What lies behind the plane of the other polygon sees nothing of it and is clipped away. Of the rest Stokes's theorem makes
//! a double contour integral (E. M. Sparrow, "A New and Simpler Formulation for Radiative Angle Factors", J. Heat Transfer 85
//! (2), 1963, eq. 13),
//!
//! A₁ F₁₂ = (1/2π) ∮ ∮ ln r dr₁ · dr₂
//!
//! a sum over pairs of edges that needs neither cosines nor visibility and stays finite where edges meet. Each term has a
//! closed form.
//!
//! Polygons that are far away or tiny would lose digits in this sum: the terms are of the order of the edges' product, the
//! result of the areas' product over r². They are integrated over their areas instead.
//!
//! Precision: some 10⁻¹⁵ of √(A₁ A₂) in absolute terms, also where polygons share edges or corners or nearly touch, so that
//! ordinary factors have a relative error below 10⁻¹². Polygons farther apart than 32 times their size, or tiny before a large one,
//! have a relative error of some 10⁻¹³ too, unless they see each other edge on. Between a polygon and one of ε times its size that
//! it nearly touches the relative error is 10⁻¹⁵/ε.

mod areas;
mod closed_forms;
mod logarithm;
mod outline;

use std::f64::consts::TAU;

use crate::geometry::Polygon;
use crate::quantity::Area;
use outline::{Edge, Outline, Scale};

/// F₁₂ from the front of one polygon to the front of another.
///
/// The front is the side from which the outline runs counter-clockwise. Polygons that intersect see each other with the parts
/// in front of both planes. Polygons in the same plane do not see each other, nor does a polygon see itself.
///
/// ```
/// use steradian::geometry::{form_factor, Point, Polygon};
/// let polygon = |corners: [[f64; 3]; 4]| Polygon::new(corners.map(Point::from).to_vec(), vec![]);
/// let floor = polygon([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]])?;
/// let ceiling = polygon([[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]])?;
/// let wall = polygon([[0., 0., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.]])?;
/// let up = form_factor::between_polygons(&floor, &ceiling);
/// let across = form_factor::between_polygons(&floor, &wall);
/// assert!((up - 0.199824895698).abs() < 1e-12);
/// assert!((up + 4.0 * across - 1.0).abs() < 1e-12); // the cube is closed
/// # Ok::<(), steradian::geometry::PolygonError>(())
/// ```
pub fn between_polygons(from: &Polygon, to: &Polygon) -> f64 {
    exchange_area_of_polygons(from, to) / from.area()
}

/// The exchange area A₁ F₁₂ = A₂ F₂₁ of the fronts of two polygons.
pub fn exchange_area_of_polygons(a: &Polygon, b: &Polygon) -> Area {
    let scale = Scale::of(a, b);
    let visible = |polygon, other| Outline::in_front_of(other, polygon, &scale);
    let area = match (visible(a, b), visible(b, a)) {
        (Some(a), Some(b)) => exchange_area(&a, &b),
        _ => 0.0,
    };
    Area::from_square_metres(area * scale.unit * scale.unit)
}

/// Beyond this distance, in radii of both together, the sum over edges loses more digits than areas do.
const FAR: f64 = 32.0;

/// The same for the ratio of the radii.
const UNEQUAL: f64 = 64.0;

fn exchange_area(a: &Outline, b: &Outline) -> f64 {
    let by_areas = if (b.center - a.center).length() > FAR * (a.radius + b.radius) {
        areas::both(a, b)
    } else if b.radius > UNEQUAL * a.radius {
        areas::small_and_large(a, b)
    } else if a.radius > UNEQUAL * b.radius {
        areas::small_and_large(b, a)
    } else {
        None
    };
    by_areas.unwrap_or_else(|| contour_integral(a, b))
}

/// (1/2π) ∮ ∮ ln r dr₁ · dr₂.
fn contour_integral(a: &Outline, b: &Outline) -> f64 {
    let term = |from: &Edge, to: &Edge| {
        let cos = from.direction.dot(to.direction);
        if cos.abs() < f64::EPSILON {
            0.0
        } else {
            cos * logarithm::over_edges(from, to)
        }
    };
    let row = |from: &Edge| b.edges().map(|to| term(from, to)).sum::<f64>();
    a.edges().map(row).sum::<f64>() / TAU
}

#[cfg(test)]
mod tests;
