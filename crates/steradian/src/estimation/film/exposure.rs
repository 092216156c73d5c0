//! The result of an image: mean and spread over passes for every pixel and channel.

use serde::{Deserialize, Serialize};

use super::{CHANNELS, Film, TILE};
use crate::estimation::cells::mean_and_variance;
use crate::estimation::student::two_sided_quantile;
use crate::estimation::{Estimate, EstimationError};

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
    /// Mean of each 32 × 32 tile of the image, by pass and then row by row.
    tiles: Vec<[f64; CHANNELS]>,
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
            tiles: Vec::new(),
            kept: Vec::new(),
        }
    }

    /// The same image before its first pass.
    fn blank(&self) -> Self {
        let blank = vec![[0.0; CHANNELS]; self.means.len()];
        Self {
            means: blank.clone(),
            squares: blank,
            done: 0,
            samples: 0,
            tiles: Vec::new(),
            kept: Vec::new(),
            ..*self
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

    /// Columns and rows of the 32 × 32 tiles that the image is cut into; those at the right and bottom may be smaller.
    #[must_use]
    pub fn tile_counts(&self) -> [u32; 2] {
        [self.width.div_ceil(TILE), self.height.div_ceil(TILE)]
    }

    /// The mean over a tile of a weighted sum of channels. Unlike the errors of single pixels put together, its error knows that
    /// neighbouring pixels share samples.
    ///
    /// # Panics
    /// If there is no such tile.
    #[must_use]
    pub fn tile(
        &self,
        column: u32,
        row: u32,
        weights: &[f64; CHANNELS],
        confidence: f64,
    ) -> Estimate {
        let [columns, rows] = self.tile_counts();
        assert!(column < columns && row < rows, "the tile is on the image");
        let passes = self
            .tiles
            .chunks((columns * rows) as usize)
            .map(|pass| &pass[(row * columns + column) as usize]);
        let means = passes.map(|mean| {
            mean.iter()
                .zip(weights)
                .map(|(mean, weight)| mean * weight)
                .sum::<f64>()
        });
        let (value, variance) = mean_and_variance(means);
        let factor = if self.done > 1 {
            two_sided_quantile(confidence, self.done - 1)
        } else {
            f64::INFINITY
        };
        Estimate::sampled(value, variance.sqrt(), factor, self.converged)
    }

    /// Mean of a tile of one pass.
    fn tile_mean(&self, pass: &PassImage, column: u32, row: u32) -> [f64; CHANNELS] {
        let span = |number: u32, size: u32| {
            (number * TILE) as usize..((number + 1) * TILE).min(size) as usize
        };
        let (columns, rows) = (span(column, self.width), span(row, self.height));
        let count = (columns.len() * rows.len()) as f64;
        let mut sum = [0.0; CHANNELS];
        for pixel in rows.flat_map(|row| &pass[row * self.width as usize..][columns.clone()]) {
            sum = std::array::from_fn(|channel| sum[channel] + f64::from(pixel[channel]));
        }
        sum.map(|sum| sum / count)
    }

    /// Adds a pass by the recurrence of Welford (1962, *Note on a method for calculating corrected sums of squares*), which does
    /// not cancel where passes hardly differ.
    pub(super) fn add(&mut self, pass: &PassImage) {
        self.done += 1;
        let [columns, rows] = self.tile_counts();
        for row in 0..rows {
            self.tiles.extend(
                (0..columns)
                    .map(|column| self.tile_mean(pass, column, row))
                    .collect::<Vec<_>>(),
            );
        }
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
    let mut merged = first.blank();
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
