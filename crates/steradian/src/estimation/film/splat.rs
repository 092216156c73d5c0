//! Samples that choose their own places on the film, such as what paths from the lights bring to it.
//!
//! A pass takes N of them, and pixel i gains
//!
//! (1/N) Σ_k f(x_k − x_i) f(y_k − y_i) V_k
//!
//! where V_k is a value times pixels: what a sample would stand for if it were the only one of the whole film. The sums are in f64 and in
//! the order of the samples, so that they do not depend on threads.

use std::ops::Range;

use super::filter::{TAPS, Weights};
use super::{CHANNELS, Film, Filter};
use crate::estimation::EstimationError;

/// Samples in one job.
pub(super) const BUNDLE: u32 = 4096;

/// What one sample brings to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splat {
    /// From the upper left corner of the film, in pixels.
    pub place: [f64; 2],
    /// Its value times pixels, by channel.
    pub value: [f32; CHANNELS],
}

/// Samples of a range of indices, and what they bring.
pub(super) struct Bundle {
    pub(super) indices: Range<u32>,
    /// Key of the film and the pass.
    pub(super) key: u64,
    pub(super) splats: Vec<Splat>,
}

impl Bundle {
    /// Fails if a splat is not finite.
    pub(super) fn check(&self) -> Result<(), EstimationError> {
        let is_wrong = |splat: &&Splat| !splat.value.iter().sum::<f32>().is_finite();
        let mut wrong = self.splats.iter().filter(is_wrong);
        let Some(first) = wrong.next() else {
            return Ok(());
        };
        let [x, y] = first.place.map(|place| place as f32);
        let count = 1 + wrong.count() as u64;
        Err(EstimationError::NonFinitePixel { x, y, count })
    }
}

/// Adds splats to pixels.
pub(super) struct Splatter {
    film: Film,
    weights: Weights,
}

impl Splatter {
    pub(super) fn new(film: &Film) -> Self {
        Self {
            film: *film,
            weights: Weights::of(film.filter),
        }
    }

    /// Adds a splat by `scale` to the pixels around it, row by row from the top left.
    pub(super) fn add(&self, splat: &Splat, scale: f64, sums: &mut [[f64; CHANNELS]]) {
        let [across, down] = splat.place.map(|place| self.taps(place));
        let width = self.film.width as usize;
        for (row, down) in down
            .iter()
            .filter(|(row, _)| inside(*row, self.film.height))
        {
            for (column, across) in across.iter().filter(|tap| inside(tap.0, self.film.width)) {
                let weight = scale * down * across;
                let pixel = &mut sums[*row as usize * width + *column as usize];
                for (sum, value) in pixel.iter_mut().zip(splat.value) {
                    *sum += weight * f64::from(value);
                }
            }
        }
    }

    /// Pixels along an axis and what a place counts for each.
    fn taps(&self, place: f64) -> [(i64, f64); TAPS] {
        if self.film.filter == Filter::Box {
            let own = place.floor() as i64;
            return std::array::from_fn(|tap| (own + tap as i64, f64::from(u8::from(tap == 0))));
        }
        let middle = place - 0.5;
        let first = middle.floor();
        let weights = self.weights.at((middle - first) as f32);
        std::array::from_fn(|tap| (first as i64 - 1 + tap as i64, f64::from(weights[tap])))
    }
}

fn inside(number: i64, size: u32) -> bool {
    (0..i64::from(size)).contains(&number)
}
