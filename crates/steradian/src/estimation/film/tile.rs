//! The jobs of an image: some samples of every pixel of a tile, splatted into a buffer, or some that choose their own places.

use steradian_kernel::{InstructionSet, Work};

use super::filter::{TAPS, Weights};
use super::splat::Bundle;
use super::{CHANNELS, Film, Filter, PixelBatch, PixelSampler, TILE};
use crate::estimation::BATCH;
use crate::estimation::crew::Worker;
use crate::sampling::block;
use crate::sampling::hash::combine;

/// Samples of a pixel in one job: the buffer is f32, and this few additions keep it accurate.
pub(super) const SLICE: u32 = 64;

/// Pixels a buffer holds beyond its tile on each side.
pub(super) const RIM: u32 = 2;
pub(super) const BUFFER_SIDE: u32 = TILE + 2 * RIM;
const BUFFER: usize = (BUFFER_SIDE * BUFFER_SIDE) as usize;

/// Pixels with their place on the film; those in the margin are negative or beyond its size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Tile {
    pub(super) fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

/// All tiles of a film with its margin, row by row.
pub(super) fn tiles(film: &Film) -> Vec<Tile> {
    let margin = film.filter.margin();
    let start = -(margin as i32);
    let spans = |size: u32| {
        let size = size + 2 * margin;
        (0..size)
            .step_by(TILE as usize)
            .map(move |from| (start + from as i32, TILE.min(size - from)))
    };
    let row = |(top, height)| {
        spans(film.width).map(move |(left, width)| Tile {
            left,
            top,
            width,
            height,
        })
    };
    spans(film.height).flat_map(row).collect()
}

/// Samples `first .. first + count` of every pixel of a tile, and what they add up to.
pub(super) struct Job {
    pub(super) number: usize,
    pub(super) tile: Tile,
    pub(super) first: u32,
    pub(super) count: u32,
    /// Key of the pass.
    pub(super) key: u64,
    pub(super) sums: Vec<[f32; CHANNELS]>,
    /// The first sample that is not finite, and how many there are.
    pub(super) fault: Option<([f32; 2], u64)>,
}

impl Job {
    pub(super) fn samples(&self) -> u64 {
        self.tile.pixels() * u64::from(self.count)
    }
}

/// A job of either kind.
pub(super) enum Task {
    Tile(Job),
    Splats(Bundle),
}

/// Samples tiles of a film.
pub(super) struct Painter<'a, S: PixelSampler> {
    sampler: &'a S,
    film: Film,
    weights: Weights,
    instructions: InstructionSet,
}

/// Columns of one batch.
pub(super) struct Columns<W> {
    sampler: W,
    keys: Vec<u64>,
    corners: Vec<[f32; 2]>,
    indices: Vec<u32>,
    numbers: [Vec<f32>; block::DIMENSIONS],
    values: Vec<[f32; CHANNELS]>,
}

impl<'a, S: PixelSampler> Painter<'a, S> {
    pub(super) fn new(sampler: &'a S, film: Film) -> Self {
        Self {
            sampler,
            film,
            weights: Weights::of(film.filter),
            instructions: InstructionSet::detect(),
        }
    }

    /// Keys and corners of the tile's pixels.
    fn lay_out(&self, job: &Job, columns: &mut Columns<S::Workspace>) {
        columns.keys.clear();
        columns.corners.clear();
        for row in 0..job.tile.height {
            for column in 0..job.tile.width {
                let (x, y) = (job.tile.left + column as i32, job.tile.top + row as i32);
                let pixel = u64::from(x as u32) << 32 | u64::from(y as u32);
                columns
                    .keys
                    .push(combine(combine(self.film.key, pixel), job.key));
                columns.corners.push([x as f32, y as f32]);
            }
        }
    }

    /// Draws sample `index` of every pixel.
    fn sample(&self, index: u32, columns: &mut Columns<S::Workspace>) {
        let count = columns.keys.len();
        columns.indices[..count].fill(index);
        let numbers = columns
            .numbers
            .each_mut()
            .map(|column| &mut column[..count]);
        let (keys, indices, corners) = (
            &columns.keys[..],
            &columns.indices[..count],
            &columns.corners[..],
        );
        self.instructions.run(Draw {
            keys,
            indices,
            corners,
            numbers,
        });
        let [x, y, u, v] = columns.numbers.each_ref().map(|column| &column[..count]);
        let batch = PixelBatch {
            x,
            y,
            lens: [u, v],
            indices,
            keys,
        };
        self.sampler
            .sample(&batch, &mut columns.sampler, &mut columns.values[..count]);
    }

    fn paint(&self, job: &mut Job, columns: &mut Columns<S::Workspace>) {
        job.sums.clear();
        job.sums.resize(BUFFER, [0.0; CHANNELS]);
        self.lay_out(job, columns);
        for index in job.first..job.first + job.count {
            self.sample(index, columns);
            self.splat(job, columns);
        }
    }

    fn splat(&self, job: &mut Job, columns: &Columns<S::Workspace>) {
        let count = columns.keys.len();
        let [x, y] = [0, 1].map(|axis: usize| &columns.numbers[axis][..count]);
        let values = &columns.values[..count];
        check(job, x, y, values);
        let (tile, sums) = (job.tile, &mut job.sums[..]);
        match self.film.filter {
            Filter::Gaussian | Filter::BlackmanHarris => self.instructions.run(Splat {
                weights: &self.weights,
                tile,
                positions: [x, y],
                values,
                sums,
            }),
            Filter::Box => splat_box(tile, values, sums),
        }
    }
}

impl<S: PixelSampler> Worker for Painter<'_, S> {
    type Job = Task;
    type Workspace = Columns<S::Workspace>;

    fn new_workspace(&self) -> Self::Workspace {
        Columns {
            sampler: self.sampler.new_workspace(),
            keys: Vec::with_capacity(BATCH),
            corners: Vec::with_capacity(BATCH),
            indices: vec![0; BATCH],
            numbers: std::array::from_fn(|_| vec![0.0; BATCH]),
            values: vec![[0.0; CHANNELS]; BATCH],
        }
    }

    fn perform(&self, task: &mut Task, columns: &mut Self::Workspace) {
        match task {
            Task::Tile(job) => self.paint(job, columns),
            Task::Splats(bundle) => self.sampler.splat(
                bundle.indices.clone(),
                bundle.key,
                &mut columns.sampler,
                &mut bundle.splats,
            ),
        }
    }
}

/// Block 0 of every sample, its first two dimensions moved to the film.
struct Draw<'a> {
    keys: &'a [u64],
    indices: &'a [u32],
    corners: &'a [[f32; 2]],
    numbers: [&'a mut [f32]; block::DIMENSIONS],
}

impl Work for Draw<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let [x, y, u, v] = self.numbers;
        block::fill_block(self.keys, self.indices, 0, [&mut *x, &mut *y, u, v]);
        for ((x, y), corner) in x.iter_mut().zip(y).zip(self.corners) {
            *x += corner[0];
            *y += corner[1];
        }
    }
}

fn check(job: &mut Job, x: &[f32], y: &[f32], values: &[[f32; CHANNELS]]) {
    for (i, value) in values.iter().enumerate() {
        if !value.iter().sum::<f32>().is_finite() {
            job.fault.get_or_insert(([x[i], y[i]], 0)).1 += 1;
        }
    }
}

/// Adds every sample to the 4 × 4 pixels around it.
struct Splat<'a> {
    weights: &'a Weights,
    tile: Tile,
    positions: [&'a [f32]; 2],
    values: &'a [[f32; CHANNELS]],
    sums: &'a mut [[f32; CHANNELS]],
}

impl Work for Splat<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        // From the film to the buffer, measured between pixel centres; the first tap is one pixel below.
        let offset = RIM as f32 - 0.5;
        let [x, y] = self.positions;
        for ((x, y), value) in x.iter().zip(y).zip(self.values) {
            let column = x - self.tile.left as f32 + offset;
            let row = y - self.tile.top as f32 + offset;
            let (left, top) = (column as usize, row as usize);
            let across = self.weights.at(column - left as f32);
            let down = self.weights.at(row - top as f32);
            for (step, down) in down.into_iter().enumerate() {
                let first = (top + step - 1) * BUFFER_SIDE as usize + left - 1;
                let Some(pixels) = self.sums.get_mut(first..first + TAPS) else {
                    continue;
                };
                for (pixel, across) in pixels.iter_mut().zip(across) {
                    let weight = across * down;
                    *pixel =
                        std::array::from_fn(|channel| pixel[channel] + weight * value[channel]);
                }
            }
        }
    }
}

/// Adds every sample to its own pixel; samples are in the order of the pixels.
fn splat_box(tile: Tile, values: &[[f32; CHANNELS]], sums: &mut [[f32; CHANNELS]]) {
    let rows = sums.chunks_mut(BUFFER_SIDE as usize).skip(RIM as usize);
    for (row, values) in rows.zip(values.chunks(tile.width as usize)) {
        for (pixel, value) in row[RIM as usize..].iter_mut().zip(values) {
            *pixel = std::array::from_fn(|channel| pixel[channel] + value[channel]);
        }
    }
}
