//! The procedure of an image: how many samples each tile gets, and the passes.

use std::ops::ControlFlow;
use std::time::Duration;

use super::ledger::PassLedger;
use super::tile::{Painter, Tile, tiles};
use super::{CHANNELS, Exposure, Film, PixelSampler, TILE};
use crate::estimation::cells::half_width_factor;
use crate::estimation::crew::{Crew, Standing};
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

/// What one pass takes.
pub(super) struct Effort {
    /// Samples of a pixel, by tile; none: only those that choose their own places.
    pub(super) lengths: Vec<u64>,
    /// Samples that choose their own places.
    pub(super) splats: u32,
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
        let effort = self.evenly(samples.div_ceil(self.passes()));
        let (mut exposure, flow) = self.expose(Phase::Final, &effort, None)?;
        exposure.conclude(flow.is_continue());
        Ok(exposure)
    }

    fn timed(&mut self, time: Duration) -> Result<Exposure, EstimationError> {
        let mut trial = 1;
        loop {
            let begin = self.crew.elapsed();
            let (mut exposure, flow) = self.expose(Phase::Pilot, &self.evenly(trial), None)?;
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
        let effort = self.evenly(PILOT);
        let (mut pilot, flow) = self.expose(Phase::Pilot, &effort, None)?;
        if flow.is_break() {
            pilot.conclude(false);
            return Ok(pilot);
        }
        let excess = self.excess(&pilot, &pilot);
        let Some(of_splats) = self.excess_of_splats(&pilot, effort)? else {
            pilot.conclude(false);
            return Ok(pilot);
        };
        let effort = self.effort(&excess, &of_splats);
        let worst = excess
            .iter()
            .fold(0.0, |worst: f64, &excess| worst.max(excess));
        let (mut exposure, flow) = self.expose(
            Phase::Final,
            &effort,
            self.plan.stop.rel_error.map(|e| e * worst),
        )?;
        let met = self
            .excess(&exposure, &exposure)
            .iter()
            .all(|&excess| excess <= 1.0);
        exposure.conclude(flow.is_continue() && met);
        Ok(exposure)
    }

    /// So many samples of every pixel in a pass, and as many that choose their own places.
    fn evenly(&self, length: u64) -> Effort {
        Effort {
            lengths: vec![length; self.tiles.len()],
            splats: self.splats(length as f64),
        }
    }

    /// Samples that choose their own places, where there are any, by their number for a pixel of the film.
    fn splats(&self, per_pixel: f64) -> u32 {
        let pixels = f64::from(self.film.width) * f64::from(self.film.height);
        let most = if self.has_splats { u32::MAX } else { 0 };
        (pixels * per_pixel).min(f64::from(most)) as u32
    }

    /// The part of a pilot's excess that comes of samples that choose their own places: its passes again without the others.
    /// `None` if they did not come to an end.
    fn excess_of_splats(
        &mut self,
        pilot: &Exposure,
        effort: Effort,
    ) -> Result<Option<Vec<f64>>, EstimationError> {
        if effort.splats == 0 {
            return Ok(Some(vec![0.0; self.tiles.len()]));
        }
        let lengths = Vec::new();
        let (splats, flow) = self.expose(Phase::Pilot, &Effort { lengths, ..effort }, None)?;
        Ok(flow.is_continue().then(|| self.excess(pilot, &splats)))
    }

    /// What should meet the tolerance by what a pilot found: samples that choose their own places so many that they use up at most half of
    /// the variance that a tile may have, and of the others in each tile what uses up the rest.
    fn effort(&self, excess: &[f64], of_splats: &[f64]) -> Effort {
        let longest = (self.plan.max_samples / self.passes()).clamp(1, LONGEST_REPLICATE);
        let needed = |excess: f64| PILOT as f64 * (SAFETY * excess).powi(2);
        let most = of_splats.iter().copied().fold(0.0, f64::max);
        let per_pixel = (2.0 * needed(most)).clamp(1.0, longest as f64);
        let length = |(&excess, &of_splats): (&f64, &f64)| {
            let needs = needed(excess) - needed(of_splats);
            let left = (1.0 - needed(of_splats) / per_pixel).max(0.5);
            round_up((needs.max(0.0) / left).ceil() as u64).clamp(1, longest)
        };
        Effort {
            lengths: excess.iter().zip(of_splats).map(length).collect(),
            splats: self.splats(per_pixel),
        }
    }

    /// Mean over the pixels of each tile of half-width / tolerance, with the errors of `uncertain`. Tiles that are all margin take that of
    /// the nearest pixels.
    fn excess(&self, exposure: &Exposure, uncertain: &Exposure) -> Vec<f64> {
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
        let errors = uncertain
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

    /// Runs every pass that this shard owns.
    fn expose(
        &mut self,
        phase: Phase,
        effort: &Effort,
        relative_error: Option<f64>,
    ) -> Result<(Exposure, ControlFlow<()>), EstimationError> {
        let mut exposure = Exposure::new(self.film, self.plan.replicates);
        let owned: Vec<_> = (0..self.plan.replicates)
            .filter(|&pass| self.plan.owns(pass as usize))
            .collect();
        let tiles = &self.tiles[..effort.lengths.len()];
        let a_pass: u64 = tiles
            .iter()
            .zip(&effort.lengths)
            .map(|(tile, length)| tile.pixels() * length)
            .sum();
        let mut standing = Standing {
            phase,
            begin: self.crew.elapsed(),
            samples: 0,
            planned: (a_pass + u64::from(effort.splats)) * owned.len() as u64,
            relative_error,
        };
        for pass in owned {
            let key = combine(
                combine(mix_64(self.plan.seed), u64::from(pass)),
                phase.key(),
            );
            let mut image = PassLedger::new(self.film, tiles, effort, key, &mut standing);
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

const _: () = assert!((TILE * TILE) as usize <= crate::estimation::BATCH);

#[cfg(test)]
mod tests;
