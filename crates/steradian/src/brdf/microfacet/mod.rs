//! Rough surfaces as many small smooth facets: metals and interfaces of dielectrics.
//!
//! One facet: ρ(d_e, d_i) = F D(m) G₂(d_e, d_i)/(4 cosθ_e cosθ_i), m half-way between d_e and d_i. What facets pass to one another is
//! given back by a second, diffuse lobe, unless the model is asked for single scattering.

mod facets;
mod missing;
mod rough_conductor;
mod rough_dielectric;

pub use facets::{Facets, Shadowing, Slopes};
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;

use crate::geometry::{Direction, gauss};

/// Panels that make an albedo true to 5e-4 for GGX: 32 × 32 points.
const PANELS: u32 = 2;

/// Mean of a function of the unit square whose numbers draw facets seen from `wo`.
///
/// Light of the steepest facets, near u₀ = 1, is what shadowing takes away: u₀ = 1 − s² crowds the points there. In s Gauss's
/// rule of order 16 in each of `panels` panels, in u₁ as many points by the midpoint rule; half of u₁ is enough if the facets
/// are the same on both sides of the plane of `wo`.
fn mean_over_facets<const N: usize>(
    wo: Direction,
    panels: u32,
    f: impl Fn([f64; 2]) -> [f64; N],
) -> [f64; N] {
    let count = panels * gauss::MAX_ORDER as u32;
    let span = if wo.y() == 0.0 { 0.5 } else { 1.0 };
    let mut sum = [0.0; N];
    for panel in 0..panels {
        for &(node, weight) in gauss::rule(gauss::MAX_ORDER) {
            let s = (f64::from(panel) + 0.5 * (1.0 + node)) / f64::from(panels);
            let scale = weight * s / (f64::from(panels) * f64::from(count));
            for j in 0..count {
                let value = f([1.0 - s * s, span * (f64::from(j) + 0.5) / f64::from(count)]);
                (0..N).for_each(|k| sum[k] += scale * value[k]);
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests;
