//! What the four lanes of a [`Spectrum`](crate::quantity::Spectrum) mean in a run.
//!
//! Transport multiplies and adds lanes and never asks what they stand for; [`Lanes`] is decided once per run and is
//! the only place that knows. In `rgb` the lanes are linear Rec.709 channels, in `broadband` one to four named bands.

mod lanes;
mod values;

pub use lanes::{LaneError, Lanes, MAX_LANES};
pub use values::LaneValues;
