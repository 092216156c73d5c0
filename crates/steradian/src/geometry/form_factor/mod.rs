//! Form factors in closed form: how much of what one surface sends out reaches another.
//!
//! The form factor (view factor) from a surface 1 to a surface 2 is the fraction of the diffuse flux leaving 1 that
//! arrives at 2,
//!
//! F₁₂ = 1/A₁ ∫ ∫ cosθ₁ cosθ₂/(π r²) dA₂ dA₁
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F₁₂ | form factor from 1 to 2, 0 … 1 | – |
//! | θ₁, θ₂ | angles between the line of sight and the normals | rad |
//! | r | length of the line of sight | m |
//! | A₁, A₂ | areas | m² |
//!
//! so that A₁ F₁₂ = A₂ F₂₁ (reciprocity), and the factors from a surface to all that surrounds it add up to 1 (closure).
//! Nothing stands in the way: occlusion is the business of transport.

mod polygons;

pub use polygons::{between_polygons, exchange_area_of_polygons};
