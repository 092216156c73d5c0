//! Images: passes of equal effort, a reconstruction filter, and an error for every pixel.
//!
//! A film is sampled in R passes (4 unless asked otherwise), each with its own random numbers and the same number n of samples in every pixel
//! of a tile. With the film positions (x, y) uniform in their pixel, a pass estimates each pixel i by
//!
//! L̂_i = Σ_pixels j  (1/n_j) Σ_{samples k in j}  f(x_k − x_i) f(y_k − y_i) L(x_k, y_k)
//!
//! with f the [`Filter`] of integral 1. It is never divided by the sum of the weights that fell on a pixel, which would bias
//! it; pixels in a margin around the image are sampled too, so that borders are as right as the middle.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L | what the sampler returns for a position, four channels | the image's |
//! | x, y | film position, pixel i has its centre at (i + ½) | pixels |
//! | f | filter along one axis | 1/pixel |
//! | n_j | samples of pixel j in one pass | – |
//!
//! Samples that choose their own places, as paths from the lights do, are [splatted](Splat) on top.
//!
//! The value of a pixel is the mean over passes, its standard error their spread over √R. As filters overlap, neighbours are correlated.
//!
//! A tolerance is judged tile by tile (32 × 32 pixels): the mean over its pixels of half-width / allowed half-width must not
//! exceed 1, the allowed one being max(ε v, ε · 1 % of the image's mean, absolute tolerance). Half-widths are those of the weighted
//! channels with their errors added as if fully correlated, which errs on the safe side. A pilot of 4 samples a pixel and pass, which is
//! discarded, fixes n for each tile, and the number of splats; there is no second run, since the mean over a thousand pixels is known well.

mod exposure;
mod filter;
mod ledger;
mod session;
mod splat;
mod tile;

pub use exposure::{Exposure, merge_exposures};
pub use filter::Filter;
pub use session::expose;
pub use splat::Splat;

use std::ops::Range;

/// Passes of an image unless asked otherwise.
pub const PASSES: u32 = 4;

/// Width and height of a tile in pixels.
pub const TILE: u32 = 32;

/// Channels of a sample.
pub const CHANNELS: usize = 4;

/// What an image is made on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Pixels in a row.
    pub width: u32,
    /// Rows, from the top.
    pub height: u32,
    /// Reconstruction filter.
    pub filter: Filter,
    /// Identity of the film in the random numbers: a hash of the camera's name.
    pub key: u64,
    /// Weights of the channels in the scalar that a tolerance is about.
    pub weights: [f64; CHANNELS],
}

/// Computes what arrives at positions of the film.
pub trait PixelSampler: Sync {
    /// Scratch memory of one thread.
    type Workspace: Send;

    /// Scratch memory for one thread.
    fn new_workspace(&self) -> Self::Workspace;

    /// Fills `out` with one sample for each position of the batch. It must depend on the sample's position, key and
    /// index only.
    fn sample(
        &self,
        batch: &PixelBatch<'_>,
        workspace: &mut Self::Workspace,
        out: &mut [[f32; CHANNELS]],
    );

    /// Whether there are samples, too, that choose their own places: as many a pass as pixels have
    /// samples, or what a tolerance needs.
    fn has_splats(&self) -> bool {
        false
    }

    /// Adds to `out` what samples of these indices bring. It must depend on key and indices only.
    fn splat(
        &self,
        _indices: Range<u32>,
        _key: u64,
        _workspace: &mut Self::Workspace,
        _out: &mut Vec<Splat>,
    ) {
    }
}

/// At most [`BATCH`](super::BATCH) film positions, by columns of equal length.
#[derive(Clone, Copy, Debug)]
pub struct PixelBatch<'a> {
    /// Film positions from the left in pixels; in the margin also below 0 and above the width.
    pub x: &'a [f32],
    /// Film positions from the top in pixels.
    pub y: &'a [f32],
    /// Dimensions 2 and 3 of block 0 of each sample's random numbers; 0 and 1 have become its position.
    pub lens: [&'a [f32]; 2],
    /// Sample indices, for [`block`](crate::sampling::block)s from number 1.
    pub indices: &'a [u32],
    /// Keys of the random numbers.
    pub keys: &'a [u64],
}

impl PixelBatch<'_> {
    /// Number of positions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }
}
