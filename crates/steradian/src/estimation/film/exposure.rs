//! The result of an image: mean and spread over passes for every pixel and channel.

use serde::{Deserialize, Serialize};

use super::{CHANNELS, Film};
use crate::estimation::EstimationError;

/// Values of one pass, row by row from the top left.
pub(super) type PassImage = Vec<[f32; CHANNELS]>;

/// An image with its standard errors, or a shard of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exposure {
    width: u32,
    height: u32,
    planned: u32,
    done: u32,
    samples: u64,
    converged: bool,
    means: Vec<[f64; CHANNELS]>,
    /// Sums of squared deviations from the mean.
    squares: Vec<[f64; CHANNELS]>,
    /// The passes themselves, by number, where they are to be merged with others.
    kept: Vec<(u32, PassImage)>,
}

impl Exposure {
    pub(super) fn new(film: &Film, planned: u32) -> Self {
        let blank = vec![[0.0; CHANNELS]; film.width as usize * film.height as usize];
        Self {
            width: film.width,
            height: film.height,
            planned,
            done: 0,
            samples: 0,
            converged: false,
            means: blank.clone(),
            squares: blank,
            kept: Vec::new(),
        }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Complete passes.
    #[must_use]
    pub fn passes(&self) -> u32 {
        self.done
    }

    /// Samples in all complete passes, those of the margin included.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// Whether every tile met its tolerance, or, without one, whether all passes were completed.
    #[must_use]
    pub fn converged(&self) -> bool {
        self.converged
    }

    /// The value of each pixel by channel, row by row from the top left.
    #[must_use]
    pub fn values(&self) -> &[[f64; CHANNELS]] {
        &self.means
    }

    /// The standard error of each pixel by channel; infinite with fewer than two passes.
    pub fn std_errors(&self) -> impl ExactSizeIterator<Item = [f64; CHANNELS]> + '_ {
        let passes = f64::from(self.done);
        let scale = if self.done > 1 {
            1.0 / (passes * (passes - 1.0))
        } else {
            f64::INFINITY
        };
        self.squares.iter().map(move |squares| {
            squares.map(|square| {
                if scale.is_finite() {
                    (square * scale).sqrt()
                } else {
                    f64::INFINITY
                }
            })
        })
    }

    /// Adds a pass by the recurrence of Welford (1962, *Note on a method for calculating corrected sums of squares*), which does
    /// not cancel where passes hardly differ.
    pub(super) fn add(&mut self, pass: &PassImage) {
        self.done += 1;
        let count = f64::from(self.done);
        for ((mean, square), value) in self.means.iter_mut().zip(&mut self.squares).zip(pass) {
            for channel in 0..CHANNELS {
                let value = f64::from(value[channel]);
                let step = value - mean[channel];
                mean[channel] += step / count;
                square[channel] += step * (value - mean[channel]);
            }
        }
    }

    pub(super) fn count(&mut self, samples: u64) {
        self.samples += samples;
    }

    pub(super) fn keep(&mut self, number: u32, pass: PassImage) {
        self.kept.push((number, pass));
    }

    pub(super) fn conclude(&mut self, converged: bool) {
        self.converged = converged;
    }
}

/// The image whose passes are spread over `shards`, bit for bit the one made in one piece.
///
/// Fails if shards are of different images, were interrupted, hold the same pass or miss one.
pub fn merge_exposures(shards: Vec<Exposure>) -> Result<Exposure, EstimationError> {
    let fault = |what: &str| Err(EstimationError::Shards(what.to_owned()));
    let Some(first) = shards.first() else {
        return fault("there are none");
    };
    let shape = |shard: &Exposure| (shard.width, shard.height, shard.planned);
    if shards.iter().any(|shard| shape(shard) != shape(first)) {
        return fault("they are of different images");
    }
    if shards.iter().any(|shard| !shard.converged) {
        return fault("one of them was interrupted");
    }
    let blank = vec![[0.0; CHANNELS]; first.means.len()];
    let mut merged = Exposure {
        means: blank.clone(),
        squares: blank,
        done: 0,
        samples: 0,
        kept: Vec::new(),
        ..*first
    };
    merged.samples = shards.iter().map(|shard| shard.samples).sum();
    let mut passes: Vec<_> = shards.into_iter().flat_map(|shard| shard.kept).collect();
    passes.sort_by_key(|(number, _)| *number);
    if !passes
        .iter()
        .map(|(number, _)| *number)
        .eq(0..merged.planned)
    {
        return fault("every pass must be in exactly one of them");
    }
    passes.iter().for_each(|(_, pass)| merged.add(pass));
    Ok(merged)
}
