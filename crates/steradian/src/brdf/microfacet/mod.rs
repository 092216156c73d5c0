//! Rough surfaces as many small smooth facets: metals and interfaces of dielectrics.
//!
//! One facet: ρ(d_e, d_i) = F D(m) G₂(d_e, d_i)/(4 cosθ_e cosθ_i), m half-way between d_e and d_i. What facets pass to one another is
//! given back by a second, diffuse lobe, unless the model is asked for single scattering.

mod facets;
mod interface_light;
mod quadrature;
mod rough_conductor;
mod rough_dielectric;
mod shelf;
mod table;

pub use facets::{Facets, Shadowing, Slopes};
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;

#[cfg(test)]
mod tests;
