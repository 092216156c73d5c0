//! What is estimated: the contract between a sampler and the engine.

use super::Tally;

/// The most samples in one batch.
pub const BATCH: usize = 1024;

/// Something that can be sampled: a set of streams, each the mean of a vector of columns over its samples.
///
/// Sample `first + i` of a [`Run`] must be a function of the run's key and of that index only
/// (see [`crate::sampling::block`]), whatever else is in the batch: this is what makes results reproducible.
pub trait Integrand: Sync {
    /// Scratch memory of one thread.
    type Workspace: Send;

    /// Number of streams, for instance points and flux surfaces.
    fn streams(&self) -> usize;

    /// Number of columns every sample has, for instance lanes × light groups.
    fn columns(&self) -> usize;

    /// The sensor a stream belongs to. The streams of a sensor share the floor of the tolerance and their pooled variance.
    fn sensor_of(&self, stream: usize) -> usize;

    /// The identity of a stream, the same in every run: a hash of the sensor's name and the index in it.
    fn stream_key(&self, stream: usize) -> u64;

    /// Weight of each column of a stream in the scalar that a tolerance is about, for instance luminance weights.
    fn weights(&self, stream: usize) -> &[f64];

    /// The part of the scalar that is known exactly and is added to the estimate before a relative tolerance is judged.
    fn offset(&self, _stream: usize) -> f64 {
        0.0
    }

    /// How many paths a sample of a stream is made of: pilots count these, as paths that share little tell as much of how a stream varies as samples do.
    fn paths_of_a_sample(&self, _stream: usize) -> u32 {
        1
    }

    /// Scratch memory for one thread.
    fn new_workspace(&self) -> Self::Workspace;

    /// Samples every run of the batch into `tally`, whose runs are numbered as in `batch.runs`.
    fn sample(&self, batch: &SampleBatch<'_>, workspace: &mut Self::Workspace, tally: &mut Tally);
}

/// Consecutive samples `first .. first + count` of one replicate of one stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// The stream.
    pub stream: u32,
    /// Its replicate.
    pub replicate: u32,
    /// Index of the first sample.
    pub first: u32,
    /// Number of samples, at least one.
    pub count: u32,
    /// Key of the replicate's random numbers.
    pub key: u64,
}

/// Runs to be sampled together; their counts add up to at most [`BATCH`].
#[derive(Clone, Copy, Debug)]
pub struct SampleBatch<'a> {
    /// The runs, of one or several streams.
    pub runs: &'a [Run],
}

impl SampleBatch<'_> {
    /// Number of samples in all runs.
    #[must_use]
    pub fn count(&self) -> usize {
        self.runs.iter().map(|run| run.count as usize).sum()
    }
}
