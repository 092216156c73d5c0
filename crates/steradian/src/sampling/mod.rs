//! Random numbers and what is drawn with them: keyed Owen-scrambled Sobol' blocks, warps of the unit square, discrete choices, and
//! shapes by the solid angle or the projected solid angle that they fill.
//!
//! Everything here is a pure function of its arguments with the same bits on every platform.

pub mod block;
pub mod discrete;
pub mod hash;
pub mod owen;
pub mod projected_cap;
pub mod projected_polygon;
pub mod sincos;
pub mod sobol;
pub mod spherical_rectangle;
pub mod spherical_triangle;
pub mod warp;
#[cfg(test)]
pub(crate) mod testing;
