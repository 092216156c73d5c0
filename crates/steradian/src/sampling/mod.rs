//! Random numbers and what is drawn with them: keyed Owen-scrambled Sobol' blocks, warps of the unit square, discrete choices.
//!
//! Everything here is a pure function of its arguments with the same bits on every platform.

pub mod block;
pub mod discrete;
pub mod hash;
pub mod owen;
pub mod sincos;
pub mod sobol;
pub mod warp;
#[cfg(test)]
pub(crate) mod testing;
