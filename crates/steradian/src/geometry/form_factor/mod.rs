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

//!
//! | surfaces | where |
//! |---|---|
//! | polygons, discs and spheres, each with each | [`between`] |
//! | two polygons | [`between_polygons`] |
//! | rectangles: parallel, perpendicular, with a common edge | [`between_parallel_rectangles`], [`between_perpendicular_rectangles`], [`between_hinged_rectangles`] |
//! | coaxial discs | [`between_coaxial_discs`] |
//! | cylinders: one in another, closed by its ends, side by side | [`ConcentricCylinders`], [`ClosedCylinder`], [`between_parallel_cylinders`] |
//! | spheres: a cap and itself, one in another, side by side, with a disc or any flat surface | [`of_cap_to_itself`], [`from_outer_to_inner_sphere`], [`between_spheres`], [`from_sphere_to_coaxial_disc`], [`from_sphere_to_plane_surface`] |
//! | endless strips | [`between_parallel_strips`], [`between_wedge_sides`], [`between_strips`] |
//!
//! "Howell's catalogue" is J. R. Howell, *A Catalog of Radiation Heat Transfer Configuration Factors*, with its numbers.

mod cubature;
mod cylinders;
mod dimensions;
mod discs;
mod polygons;
mod rectangles;
mod spheres;
mod strips;
mod surfaces;

pub use cylinders::{ClosedCylinder, ConcentricCylinders, between_parallel_cylinders};
pub use dimensions::DimensionError;
pub use discs::between_coaxial_discs;
pub use polygons::{between_polygons, exchange_area_of_polygons};
pub use rectangles::{
    between_hinged_rectangles, between_parallel_rectangles, between_perpendicular_rectangles,
};
pub use spheres::{
    between_spheres, from_outer_to_inner_sphere, from_sphere_to_coaxial_disc,
    from_sphere_to_plane_surface, of_cap_to_itself,
};
pub use strips::{between_parallel_strips, between_strips, between_wedge_sides};
pub use surfaces::{Factor, Surface, between};
