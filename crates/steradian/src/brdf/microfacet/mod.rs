//! Rough surfaces as many small smooth facets: metals and interfaces of dielectrics.
//!
//! One facet: ρ(d_e, d_i) = F D(m) G₂(d_e, d_i)/(4 cosθ_e cosθ_i), m half-way between d_e and d_i. What facets pass to one another is
//! given back by a second, diffuse lobe, unless the model is asked for single scattering.

mod facets;
mod interface_light;
mod later;
mod metal;
mod quadrature;
mod rough_conductor;
mod rough_dielectric;
mod rough_plastic;
pub(super) mod shelf;
pub(super) mod table;

pub use facets::{Facets, Shadowing, Slopes};
pub(crate) use later::Later;
pub(crate) use metal::Metal;
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;
pub use rough_plastic::RoughPlastic;

use crate::brdf::sampling::above;
use crate::geometry::Direction;

/// The normal that mirrors one direction into the other, both above the surface.
pub(super) fn half_way(wo: Direction, wi: Direction) -> Option<Direction> {
    if !above(wo, wi) {
        return None;
    }
    Direction::new(wo.to_vector() + wi.to_vector()).ok()
}

#[cfg(test)]
mod tests;
