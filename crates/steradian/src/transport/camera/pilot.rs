//! A pilot of a picture: how many branches its camera rays have.

use super::super::branching::Branches;
use super::super::branching::pilot::{KEY, suited};
use super::super::columns::{BATCH, Workspace};
use super::super::run::Branching;
use super::CameraSampler;
use crate::estimation::film::{CHANNELS, Film, PixelBatch};
use crate::sampling::{block, hash};

/// Pixels spread over the film: many, as few of them may have all the variance.
const PIXELS: usize = 512;
const NETS: usize = 2;
const SAMPLES_OF_A_NET: usize = 8;
const STEMS: usize = PIXELS * NETS * SAMPLES_OF_A_NET;
/// Samples of a pixel in a pass, as a rule.
const USUAL_NET: f64 = 16.0;
const PIXELS_OF_A_BATCH: usize = BATCH / (NETS * SAMPLES_OF_A_NET);

impl<'a> CameraSampler<'a> {
    /// The same with as many branches as are wanted: one in a spectral run, where they would share their wavelengths.
    pub fn branching(mut self, branching: Branching, film: &Film, threads: usize) -> Self {
        self.branches = match branching {
            Branching::Suited if self.density.is_none() => self.suited_branches(film, threads),
            Branching::Suited | Branching::Never => Branches::ONE,
        };
        self
    }

    /// They are the same for every seed.
    fn suited_branches(&self, film: &Film, threads: usize) -> Branches {
        let key = hash::combine(film.key, KEY);
        let longer = USUAL_NET / SAMPLES_OF_A_NET as f64;
        suited(threads, (STEMS, NETS), longer, |branches| {
            let mut paths = Workspace::default();
            let batches = 0..PIXELS / PIXELS_OF_A_BATCH;
            let means = batches.map(|batch| self.means(film, (key, batch), (branches, &mut paths)));
            let means = means.collect::<Vec<_>>().concat();
            (means, [paths.watch.times.rays, 0])
        })
    }

    /// Means of the nets of some pixels.
    fn means(
        &self,
        film: &Film,
        (key, batch): (u64, usize),
        (branches, paths): (Branches, &mut Workspace),
    ) -> Vec<f64> {
        let draws: Vec<_> = (0..BATCH).map(|row| draw(film, key, batch, row)).collect();
        let column = |k: usize| draws.iter().map(|draw| draw.film[k]).collect::<Vec<_>>();
        let [x, y, u, v] = [0, 1, 2, 3].map(column);
        let indices: Vec<_> = draws.iter().map(|draw| draw.index).collect();
        let keys: Vec<_> = draws.iter().map(|draw| draw.key).collect();
        let batch = PixelBatch {
            x: &x,
            y: &y,
            lens: [&u, &v],
            indices: &indices,
            keys: &keys,
        };
        let mut values = vec![[0.0; CHANNELS]; BATCH];
        self.sample_by(branches, &batch, paths, &mut values);
        let scalar = |value: &[f32; CHANNELS]| -> f64 {
            let weighted = value.iter().zip(&film.weights);
            weighted.map(|(lane, w)| f64::from(*lane) * w).sum()
        };
        let nets = values.chunks(SAMPLES_OF_A_NET);
        let mean = |net: &[_]| net.iter().map(scalar).sum::<f64>() / net.len() as f64;
        nets.map(mean).collect()
    }
}

struct Draw {
    key: u64,
    index: u32,
    /// Place on the film, and numbers for the lens.
    film: [f32; 4],
}

/// Row by row the samples of a net, the nets of a pixel, the pixels of a batch.
fn draw(film: &Film, key: u64, batch: usize, row: usize) -> Draw {
    let index = (row % SAMPLES_OF_A_NET) as u32;
    let net = batch * PIXELS_OF_A_BATCH * NETS + row / SAMPLES_OF_A_NET;
    let of_pixel = block::sample(key, (net / NETS) as u32, 0);
    let corner = |k: usize, size: u32| (of_pixel[k] * size as f32).floor();
    let key = hash::combine(key, net as u64);
    let [x, y, u, v] = block::sample(key, index, 0);
    Draw {
        key,
        index,
        film: [corner(0, film.width) + x, corner(1, film.height) + y, u, v],
    }
}

#[cfg(test)]
mod tests;
