//! The procedure of an image: how many samples each tile gets, and the passes.

use std::ops::ControlFlow;
use std::time::Duration;

use super::exposure::PassImage;
use super::splat::{BUNDLE, Bundle, Splatter};
use super::tile::{BUFFER_SIDE, Job, Painter, RIM, SLICE, Task, Tile, tiles};
use super::{CHANNELS, Exposure, Film, PixelSampler, TILE};
use crate::estimation::cells::half_width_factor;
use crate::estimation::crew::{Crew, Ledger, Standing};
use crate::estimation::plan::LONGEST_REPLICATE;
use crate::estimation::schedule::round_up;
use crate::estimation::{EstimationError, Observer, Phase, Plan};
use crate::sampling::hash::{combine, mix_64};

/// Samples of a pixel in one pass of the pilot.
const PILOT: u64 = 4;
const SAFETY: f64 = 1.4;
/// Part of the time that a timed image plans to use, so that it ends in time.
const USED_TIME: f64 = 0.9;
/// Part of the time that is spent on finding out how fast samples are.
const TRIAL_TIME: f64 = 0.02;

/// Makes an image as the plan says; the replicates of the plan are the passes, `samples` are those of a pixel.
///
/// With `samples` every pixel gets that many, rounded up to a multiple of the passes. With `time` alone a trial measures the
/// speed and the passes get the number that fits. With a tolerance a pilot finds the number for each tile. Shards are passes and
/// need `samples`. An observer that breaks leaves the complete passes.
pub fn expose<S: PixelSampler>(
    sampler: &S,
    film: &Film,
    plan: &Plan,
    observer: &mut dyn Observer,
) -> Result<Exposure, EstimationError> {
    plan.check_without_rms()?;
    if plan.shard.is_some() && plan.stop.samples.is_none() {
        return Err(EstimationError::Plan(
            "shards of an image need a number of samples",
        ));
    }
    if film.width == 0 || film.height == 0 || film.width.max(film.height) > 1 << 20 {
        return Err(EstimationError::Plan(
            "an image has from 1 to 2²⁰ pixels along each side",
        ));
    }
    let limit = plan.stop.time.filter(|_| plan.stop.has_tolerance());
    let crew = Crew::new(Painter::new(sampler, *film), plan.threads, limit, observer);
    let mut session = Session {
        film,
        plan,
        tiles: tiles(film),
        has_splats: sampler.has_splats(),
        crew,
    };
    match (plan.stop.samples, plan.stop.time) {
        (Some(samples), _) => session.fixed(samples),
        (None, Some(time)) if !plan.stop.has_tolerance() => session.timed(time),
        _ => session.until_tolerance(),
    }
}

struct Session<'a, S: PixelSampler> {
    film: &'a Film,
    plan: &'a Plan,
    tiles: Vec<Tile>,
    has_splats: bool,
    crew: Crew<'a, Painter<'a, S>>,
}

impl<S: PixelSampler> Session<'_, S> {
    fn passes(&self) -> u64 {
        u64::from(self.plan.replicates)
    }

    fn fixed(&mut self, samples: u64) -> Result<Exposure, EstimationError> {
        let lengths = vec![samples.div_ceil(self.passes()); self.tiles.len()];
        let (mut exposure, flow) = self.expose(Phase::Final, &lengths, None)?;
        exposure.conclude(flow.is_continue());
        Ok(exposure)
    }

    fn timed(&mut self, time: Duration) -> Result<Exposure, EstimationError> {
        let mut trial = 1;
        loop {
            let begin = self.crew.elapsed();
            let (mut exposure, flow) =
                self.expose(Phase::Pilot, &vec![trial; self.tiles.len()], None)?;
            let cost = (self.crew.elapsed() - begin).as_secs_f64() / trial as f64;
            if flow.is_break() {
                exposure.conclude(false);
                return Ok(exposure);
            }
            if self.crew.elapsed().as_secs_f64() >= TRIAL_TIME * time.as_secs_f64() {
                let left = time.saturating_sub(self.crew.elapsed()).as_secs_f64();
                let length = (USED_TIME * left / cost) as u64;
                return self.fixed(length.clamp(1, LONGEST_REPLICATE) * self.passes());
            }
            trial *= 2;
        }
    }

    fn until_tolerance(&mut self) -> Result<Exposure, EstimationError> {
        let pilot_lengths = vec![PILOT; self.tiles.len()];
        let (mut pilot, flow) = self.expose(Phase::Pilot, &pilot_lengths, None)?;
        if flow.is_break() {
            pilot.conclude(false);
            return Ok(pilot);
        }
        let excess = self.excess(&pilot);
        let longest = (self.plan.max_samples / self.passes()).clamp(1, LONGEST_REPLICATE);
        let length =
            |excess: &f64| round_up((PILOT as f64 * (SAFETY * excess).powi(2)).ceil() as u64);
        let lengths: Vec<_> = excess
            .iter()
            .map(|excess| length(excess).clamp(1, longest))
            .collect();
        let worst = excess
            .iter()
            .fold(0.0, |worst: f64, &excess| worst.max(excess));
        let (mut exposure, flow) = self.expose(
            Phase::Final,
            &lengths,
            self.plan.stop.rel_error.map(|e| e * worst),
        )?;
        let met = self.excess(&exposure).iter().all(|&excess| excess <= 1.0);
        exposure.conclude(flow.is_continue() && met);
        Ok(exposure)
    }

    /// Mean over the pixels of each tile of half-width / tolerance. Tiles that are all margin take that of the nearest pixels.
    fn excess(&self, exposure: &Exposure) -> Vec<f64> {
        let scalar = |channels: &[f64; CHANNELS]| {
            channels
                .iter()
                .zip(self.film.weights)
                .map(|(c, w)| c * w)
                .sum::<f64>()
        };
        let values: Vec<f64> = exposure.values().iter().map(scalar).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let factor = half_width_factor(self.plan);
        let weights = self.film.weights.map(f64::abs);
        let errors = exposure
            .std_errors()
            .map(|errors| errors.iter().zip(weights).map(|(e, w)| e * w).sum::<f64>());
        let ratio = |(value, error): (&f64, f64)| {
            let tolerance = self.plan.stop.tolerance(*value, mean);
            if error == 0.0 {
                0.0
            } else {
                factor * error / tolerance
            }
        };
        let ratios: Vec<f64> = values.iter().zip(errors).map(ratio).collect();
        self.tiles
            .iter()
            .map(|tile| self.mean_over(tile, &ratios))
            .collect()
    }

    fn mean_over(&self, tile: &Tile, ratios: &[f64]) -> f64 {
        let span = |from: i32, count: u32, size: u32| {
            let inside = |at: i32| at.clamp(0, size as i32 - 1) as usize;
            inside(from)..inside(from + count as i32 - 1) + 1
        };
        let rows = span(tile.top, tile.height, self.film.height);
        let columns = span(tile.left, tile.width, self.film.width);
        let pixels = (rows.len() * columns.len()) as f64;
        let row = |row: usize| {
            ratios[row * self.film.width as usize..][columns.clone()]
                .iter()
                .sum::<f64>()
        };
        rows.map(row).sum::<f64>() / pixels
    }

    /// Samples of a pass that choose their own places.
    fn splats(&self, lengths: &[u64]) -> u32 {
        if !self.has_splats {
            return 0;
        }
        let longest = lengths.iter().copied().max().unwrap_or(0);
        let pixels = u64::from(self.film.width) * u64::from(self.film.height);
        u32::try_from(pixels.saturating_mul(longest)).unwrap_or(u32::MAX)
    }

    /// Runs every pass that this shard owns.
    fn expose(
        &mut self,
        phase: Phase,
        lengths: &[u64],
        relative_error: Option<f64>,
    ) -> Result<(Exposure, ControlFlow<()>), EstimationError> {
        let mut exposure = Exposure::new(self.film, self.plan.replicates);
        let owned: Vec<_> = (0..self.plan.replicates)
            .filter(|&pass| self.plan.owns(pass as usize))
            .collect();
        let a_pass: u64 = self
            .tiles
            .iter()
            .zip(lengths)
            .map(|(tile, length)| tile.pixels() * length)
            .sum();
        let splats = self.splats(lengths);
        let mut standing = Standing {
            phase,
            begin: self.crew.elapsed(),
            samples: 0,
            planned: (a_pass + u64::from(splats)) * owned.len() as u64,
            relative_error,
        };
        for pass in owned {
            let key = combine(
                combine(mix_64(self.plan.seed), u64::from(pass)),
                phase.key(),
            );
            let counts = (lengths, splats);
            let mut image = PassLedger::new(self.film, &self.tiles, counts, key, &mut standing);
            if self.crew.run(&mut image)?.is_break() {
                return Ok((exposure, ControlFlow::Break(())));
            }
            let image = image.into_image();
            exposure.add(&image);
            exposure.count(a_pass);
            if self.plan.shard.is_some() {
                exposure.keep(pass, image);
            }
        }
        Ok((exposure, ControlFlow::Continue(())))
    }
}

/// Hands out the tiles of one pass in slices and adds up what they bring.
struct PassLedger<'a> {
    film: &'a Film,
    tiles: &'a [Tile],
    lengths: &'a [u64],
    key: u64,
    standing: &'a mut Standing,
    sums: Vec<[f64; CHANNELS]>,
    number: usize,
    done: u64,
    merged: usize,
    spare: Vec<Vec<[f32; CHANNELS]>>,
    splatter: Splatter,
    /// How many samples choose their own places, are issued, and are merged.
    splats: [u32; 3],
}

impl<'a> PassLedger<'a> {
    fn new(
        film: &'a Film,
        tiles: &'a [Tile],
        (lengths, splats): (&'a [u64], u32),
        key: u64,
        standing: &'a mut Standing,
    ) -> Self {
        let sums = vec![[0.0; CHANNELS]; film.width as usize * film.height as usize];
        Self {
            film,
            tiles,
            lengths,
            key,
            standing,
            sums,
            number: 0,
            done: 0,
            merged: 0,
            spare: Vec::new(),
            splatter: Splatter::new(film),
            splats: [splats, 0, 0],
        }
    }

    fn into_image(self) -> PassImage {
        self.sums
            .into_iter()
            .map(|pixel| pixel.map(|value| value as f32))
            .collect()
    }

    /// Adds the part of a tile's buffer that lies on the image.
    fn add(&mut self, job: &Job) {
        let scale = 1.0 / self.lengths[job.number] as f64;
        let side = BUFFER_SIDE as i32;
        let (left, top) = (job.tile.left - RIM as i32, job.tile.top - RIM as i32);
        let (width, height) = (self.film.width as i32, self.film.height as i32);
        let columns = left.max(0)..(left + side).min(width);
        for row in top.max(0)..(top + side).min(height) {
            let from = ((row - top) * side + columns.start - left) as usize;
            let to = (row * width + columns.start) as usize;
            for (pixel, sum) in self.sums[to..][..columns.len()]
                .iter_mut()
                .zip(&job.sums[from..])
            {
                *pixel =
                    std::array::from_fn(|channel| pixel[channel] + scale * f64::from(sum[channel]));
            }
        }
    }
}

impl PassLedger<'_> {
    fn issue_tile(&mut self) -> Option<Job> {
        let tile = *self.tiles.get(self.number)?;
        let count = (self.lengths[self.number] - self.done).min(u64::from(SLICE)) as u32;
        let sums = self.spare.pop().unwrap_or_default();
        let job = Job {
            number: self.number,
            tile,
            first: self.done as u32,
            count,
            key: self.key,
            sums,
            fault: None,
        };
        self.done += u64::from(count);
        if self.done == self.lengths[self.number] {
            (self.number, self.done) = (self.number + 1, 0);
        }
        Some(job)
    }

    fn issue_splats(&mut self) -> Option<Bundle> {
        let [count, issued, _] = &mut self.splats;
        let indices = *issued..issued.saturating_add(BUNDLE).min(*count);
        *issued = indices.end;
        (!indices.is_empty()).then(|| Bundle {
            indices,
            key: combine(self.film.key, self.key),
            splats: Vec::new(),
        })
    }

    fn merge_tile(&mut self, job: Job) -> Result<(), EstimationError> {
        if let Some(([x, y], count)) = job.fault {
            return Err(EstimationError::NonFinitePixel { x, y, count });
        }
        self.add(&job);
        self.standing.samples += job.samples();
        self.merged += usize::from(u64::from(job.first + job.count) == self.lengths[job.number]);
        self.spare.push(job.sums);
        Ok(())
    }

    fn merge_splats(&mut self, bundle: &Bundle) -> Result<(), EstimationError> {
        bundle.check()?;
        let scale = 1.0 / f64::from(self.splats[0]);
        for splat in &bundle.splats {
            self.splatter.add(splat, scale, &mut self.sums);
        }
        self.standing.samples += bundle.indices.len() as u64;
        self.splats[2] = bundle.indices.end;
        Ok(())
    }
}

impl Ledger for &mut PassLedger<'_> {
    type Job = Task;

    fn issue(&mut self) -> Option<Task> {
        let tile = self.issue_tile().map(Task::Tile);
        tile.or_else(|| self.issue_splats().map(Task::Splats))
    }

    fn merge(&mut self, task: Task) -> Result<(), EstimationError> {
        match task {
            Task::Tile(job) => self.merge_tile(job),
            Task::Splats(bundle) => self.merge_splats(&bundle),
        }
    }

    fn is_complete(&self) -> bool {
        self.merged == self.tiles.len() && self.splats[2] == self.splats[0]
    }

    fn standing(&self) -> Standing {
        Standing { ..*self.standing }
    }
}

const _: () = assert!((TILE * TILE) as usize <= crate::estimation::BATCH);

#[cfg(test)]
mod tests;
