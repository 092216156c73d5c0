//! What can go wrong while estimating.

/// Why an estimation or a merge of shards was refused or given up.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EstimationError {
    /// The plan contradicts itself or asks for what cannot be.
    #[error("{0}")]
    Plan(&'static str),
    /// The integrand returned infinities or not-a-numbers.
    #[error(
        "{count} samples of stream {stream} are not finite numbers, the first of them in replicate {replicate}"
    )]
    NonFinite {
        /// The stream they belong to.
        stream: usize,
        /// The replicate of the first one found.
        replicate: usize,
        /// How many there are in that replicate so far.
        count: u64,
    },
    /// The sampler of an image returned infinities or not-a-numbers.
    #[error(
        "{count} samples of the image are not finite numbers, the first of them at pixel ({x:.1}, {y:.1})"
    )]
    NonFinitePixel {
        /// Film position of the first one from the left.
        x: f32,
        /// Film position of the first one from the top.
        y: f32,
        /// How many there are in its tile so far.
        count: u64,
    },
    /// A worker thread panicked.
    #[error("a worker thread panicked: {0}")]
    Panicked(String),
    /// The shards are not parts of one run.
    #[error("the shards do not fit together: {0}")]
    Shards(String),
}
