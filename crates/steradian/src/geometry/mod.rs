//! Geometry in `f64`: points and directions, frames, spherical coordinates, foreshortening, and the closed forms
//! for solid angles, configuration factors and form factors.
//!
//! Right-handed coordinates in metres with Z up. Nothing here knows of light: [`solid_angle`],
//! [`configuration_factor`] and [`form_factor`] give numbers that other modules multiply with radiance.

pub mod configuration_factor;
pub mod form_factor;
pub mod solid_angle;

mod bounds;
mod dilogarithm;
mod direction;
mod elliptic;
mod foreshortening;
mod frame;
mod hull;
pub(crate) mod gauss;
mod point;
mod polygon;
mod spherical;
mod transform;

#[cfg(test)]
pub(crate) mod testing;

pub use bounds::Bounds;
pub use direction::{Direction, NoDirection};
pub use foreshortening::SurfaceElement;
pub use frame::Frame;
pub use hull::Hull;
pub use point::{Point, Vector};
pub use polygon::{Polygon, PolygonError};
pub use spherical::{PatchError, Spherical, SphericalPatch};
pub use transform::Transform;
