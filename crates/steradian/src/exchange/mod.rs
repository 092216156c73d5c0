//! Radiative exchange between the surfaces of a scene: form factors with obstacles, and their matrix.
//!
//! The form factor from surface i to surface j is the part of what leaves i diffusely and evenly that reaches j directly,
//!
//! F_ij = (1/A_i) ∫∫ V cosθ_i cosθ_j / (π r²) dA_j dA_i
//!
//! so that A_i F_ij = A_j F_ji (reciprocity) and, in a closed enclosure, Σ_j F_ij = 1 (closure).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F_ij | form factor from i to j | – |
//! | A | area | m² |
//! | V | 1 where the points see each other, else 0 | – |
//! | θ | angles from the normals | rad |
//! | r | distance of the points | m |
//!
//! Surfaces are [`Facets`], put together by face, object or material as [`Groups`]. [`matrix`] finds one [`Row`] after the other.
//! Every surface stops what meets it, whatever the opacity of its material. Source: M. F. Modest, *Radiative Heat Transfer* (3rd ed. 2013),
//! chapter 4.

mod assembly;
mod effort;
mod element;
mod facets;
mod grouping;
mod matrix;
mod mesh_view;
mod pairs;
mod polygon;
pub mod radiosity;
mod rays;
mod row;
pub mod smoothing;
mod uncertain;

pub use element::{Element, factors_of_element};
pub use facets::{Extent, Facet, Facets, Sides};
pub use grouping::{Grouping, Groups};
pub use matrix::{ExchangeError, MatrixOptions, MatrixSummary, Residual, Technique, matrix};
pub use mesh_view::MeshView;
pub use polygon::ConvexPolygon;
pub use row::{Entry, Rest, Row};
pub use uncertain::{IndependentSum, Uncertain};

#[cfg(test)]
mod tests;
