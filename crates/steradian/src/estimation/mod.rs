//! From samples to numbers with error bars.
//!
//! An [`Integrand`] says how to sample; [`estimate`] decides how often, runs the threads and returns [`Replicates`];
//! [`Replicates::combine`] turns them into an [`Estimate`]. Nothing here knows about light.
//!
//! # How the error is found
//! A stream (a point, a flux surface) is estimated R times, each replicate r being the mean x̄_r over its own randomised
//! quasi-Monte Carlo sequence of n samples. The replicates are independent and unbiased, so
//!
//! value = (1/R) Σ x̄_r ,  std_error² = Σ (x̄_r − value)² / (R (R − 1)) ,  interval = value ± t · std_error
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | R | replicates, 16 unless asked otherwise | – |
//! | x̄_r | mean of replicate r in one column, or in a weighted sum of columns | the reading's |
//! | t | quantile of Student's t with R − 1 degrees of freedom | – |
//!
//! The variance of single samples says nothing about a quasi-Monte Carlo mean and is not used for the interval
//! (L'Ecuyer & Lemieux 2002, *Recent advances in randomized quasi-Monte Carlo methods*, §2.2).
//!
//! # When it stops
//! A tolerance ε is met when t · std_error ≤ max(ε |v|, ε · 1 % of the mean over the streams of the sensor, absolute tolerance). See
//! [`Stopping`] for the modes and [`estimate`] for the procedure. The streams of a sensor are
//! those that are estimated together: of a sensor that is measured in blocks, those of one block.
//!
//! # Same bits
//! Sums are folded over runs of samples whose boundaries depend on the sample index alone, in the order of the index; so the
//! result does not depend on threads, on the packing of batches, on shards, or on whether n was reached in one go.

mod account;
mod cells;
pub(crate) mod crew;
mod error;
mod estimate;
pub mod film;
mod integrand;
mod jackknife;
mod plan;
mod progress;
mod replicates;
mod schedule;
mod sensors;
mod shards;
mod stopping;
pub mod student;
mod tally;

pub use error::EstimationError;
pub use estimate::{Estimate, Method};
pub use integrand::{BATCH, Integrand, Run, SampleBatch};
pub use jackknife::jackknife;
pub use plan::{Plan, Stopping};
pub use progress::{Observer, Phase, Progress, Silent};
pub use replicates::{LargestSamples, Replicates};
pub use shards::merge_shards;
pub use stopping::estimate;
pub use tally::Tally;
