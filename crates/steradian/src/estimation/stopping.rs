//! The procedure: fixed number, fixed time, or pilot – plan – final for a tolerance.
//!
//! # Reaching a tolerance
//! 1. *Pilot*: at least 4096 paths a stream and 65 536 a sensor, doubled until the effective number (Σx)²/Σx² is at least 100, so
//!    that rare bright samples have shown themselves. It stops at 2²² samples a sensor, or 65 536 a stream if that is more, so that a
//!    stream that sees nothing ends.
//! 2. *Plan*: with hw the half-width the pilot reached and tol the allowed one, n = n_pilot · max(¼, (1.4 hw / tol)²). The variance behind
//!    hw is the larger of the stream's own and v² times the pooled relative variance Σ n·var / Σ v² of its sensor, which protects a stream that
//!    has been lucky so far. The pilot is discarded: a result whose length depended on its own samples would be biased.
//! 3. *Final*: n samples with fresh random numbers. A stream that misses its tolerance runs once more, afresh, with 2n.
//!
//! A [root mean square](rms) over a sensor's streams is reached the same way, with samples shared out among them.
//!
//! The floor of the tolerance is taken from the pilot, so that shards, which all run the whole pilot, agree on it. Where points are
//! measured in blocks, floor, pooled variance and root mean square are those of the sensor's streams in the block, and each block has its
//! own pilot.

use std::ops::ControlFlow;
use std::time::Duration;

use super::account::{Account, Sampling, Work};
use super::cells::{Cells, half_width_factor};
use super::crew::Crew;
use super::plan::LONGEST_REPLICATE;
use super::replicates::share_largest;
use super::schedule::{Schedule, Task, round_up};
use super::sensors::{Sensors, relative_error};
use super::{EstimationError, Integrand, Observer, Phase, Plan, Replicates};
use crate::sampling::hash::{combine, mix_64};

const PILOT_OF_STREAM: u64 = 1 << 12;
const PILOT_OF_SENSOR: u64 = 1 << 16;
const LONGEST_PILOT_OF_STREAM: u64 = 1 << 16;
const LONGEST_PILOT_OF_SENSOR: u64 = 1 << 22;
const EFFECTIVE_SAMPLES: f64 = 100.0;
const SAFETY: f64 = 1.4;
const SMALLEST_FINAL: f64 = 0.25;

/// Estimates every stream of the integrand as the plan says.
///
/// The observer runs on the calling thread and may end the run; what has been sampled by then is returned with
/// `converged` false. The result depends on the integrand, the seed, the replicates and the stopping rule; not on threads,
/// and, once shards are merged, not on shards.
///
/// ```
/// use steradian::estimation::{Integrand, Plan, SampleBatch, Silent, Stopping, Tally, estimate};
/// use steradian::sampling::block;
///
/// /// The mean of u² over [0, 1).
/// struct Square;
///
/// impl Integrand for Square {
///     type Workspace = ();
///     fn streams(&self) -> usize { 1 }
///     fn columns(&self) -> usize { 1 }
///     fn sensor_of(&self, _: usize) -> usize { 0 }
///     fn stream_key(&self, _: usize) -> u64 { 0 }
///     fn weights(&self, _: usize) -> &[f64] { &[1.0] }
///     fn new_workspace(&self) {}
///     fn sample(&self, batch: &SampleBatch<'_>, _: &mut (), tally: &mut Tally) {
///         for (number, run) in batch.runs.iter().enumerate() {
///             for index in run.first..run.first + run.count {
///                 let [u, ..] = block::sample(run.key, index, 0);
///                 tally.sample(number, &[f64::from(u * u)], &[1.0]);
///             }
///         }
///     }
/// }
///
/// let plan = Plan { stop: Stopping::at_rel_error(1e-3), ..Plan::default() };
/// let result = estimate(&Square, &plan, &mut Silent)?;
/// let mean = result[0].combine(&[1.0]);
/// assert!(mean.converged && (mean.value - 1.0 / 3.0).abs() < 1e-3);
/// # Ok::<(), steradian::estimation::EstimationError>(())
/// ```
pub fn estimate<I: Integrand>(
    integrand: &I,
    plan: &Plan,
    observer: &mut dyn Observer,
) -> Result<Vec<Replicates>, EstimationError> {
    plan.check()?;
    check_shape(integrand)?;
    let mut session = Session::new(integrand, plan, observer);
    match (plan.stop.samples, plan.stop.time) {
        (Some(samples), _) => session.fixed(samples),
        (None, Some(time)) if !plan.stop.has_tolerance() => session.timed(time),
        _ => session.until_tolerance(),
    }
}

fn check_shape<I: Integrand>(integrand: &I) -> Result<(), EstimationError> {
    let weighted = |stream| integrand.weights(stream).len() == integrand.columns();
    let fault = if integrand.columns() == 0 || !(0..integrand.streams()).all(weighted) {
        "an integrand needs columns, and a weight for each of them"
    } else if u32::try_from(integrand.streams()).is_err() {
        "there are more than 2³² streams"
    } else {
        return Ok(());
    };
    Err(EstimationError::Plan(fault))
}

struct Session<'a, I: Integrand> {
    integrand: &'a I,
    plan: &'a Plan,
    sensors: Sensors,
    crew: Crew<'a, Sampling<'a, I>>,
    factor: f64,
}

/// What the pilot has decided.
struct Decisions {
    /// Mean of each sensor, for the tolerance floor.
    means: Vec<f64>,
    /// Samples of each replicate, by stream.
    lengths: Vec<u64>,
}

impl<'a, I: Integrand> Session<'a, I> {
    fn new(integrand: &'a I, plan: &'a Plan, observer: &'a mut dyn Observer) -> Self {
        let crew = Crew::new(
            Sampling(integrand),
            plan.threads,
            plan.stop.time.filter(|_| plan.stop.has_tolerance()),
            observer,
        );
        Self {
            integrand,
            plan,
            sensors: Sensors::new(integrand),
            crew,
            factor: half_width_factor(plan),
        }
    }

    fn fixed(&mut self, samples: u64) -> Result<Vec<Replicates>, EstimationError> {
        let mut cells = Cells::new(self.integrand, self.plan);
        let replicates = u64::from(self.plan.replicates);
        let plan = self.plan;
        let owned = |stream: usize, replicate: u32| {
            plan.owns(stream * plan.replicates as usize + replicate as usize)
        };
        let tasks = self.tasks(Phase::Final, |_| (0, samples.div_ceil(replicates)), owned);
        let complete = self.run(Phase::Final, tasks, &mut cells)?.is_continue();
        Ok(self.harvest(&cells, |_| complete))
    }

    /// Doubles n while there is time for it, then adds what still fits.
    fn timed(&mut self, time: Duration) -> Result<Vec<Replicates>, EstimationError> {
        let mut cells = Cells::new(self.integrand, self.plan);
        let (mut done, mut target) = (0, 64);
        loop {
            let tasks = self.tasks(Phase::Final, |_| (done, target), |_, _| true);
            if self.run(Phase::Final, tasks, &mut cells)?.is_break() {
                return Ok(self.harvest(&cells, |_| false));
            }
            done = target;
            let affordable = done as f64 * time.as_secs_f64() / self.crew.elapsed().as_secs_f64();
            target = whole_runs((affordable as u64).min(2 * done)).min(LONGEST_REPLICATE);
            if target <= done {
                return Ok(self.harvest(&cells, |_| true));
            }
        }
    }

    fn until_tolerance(&mut self) -> Result<Vec<Replicates>, EstimationError> {
        let mut pilot = Cells::new(self.integrand, self.plan);
        if self.pilot(&mut pilot)?.is_break() {
            return Ok(self.harvest(&pilot, |_| false));
        }
        let decisions = self.decide(&pilot);
        let mut cells = Cells::new(self.integrand, self.plan);
        let plan = self.plan;
        let tasks = self.tasks(
            Phase::Final,
            |stream| (0, decisions.lengths[stream]),
            |stream, _| plan.owns(stream),
        );
        let complete = self.run(Phase::Final, tasks, &mut cells)?.is_continue();
        if complete {
            self.rerun(&decisions, &mut cells)?;
        }
        let met = self.met(&decisions, &cells);
        Ok(self.harvest(&cells, |stream| complete && met[stream]))
    }

    fn pilot(&mut self, cells: &mut Cells) -> Result<ControlFlow<()>, EstimationError> {
        let sensors = &self.sensors;
        let size = |stream: usize| sensors.streams[sensors.of_stream[stream]];
        let least = match self.plan.stop.rms_error {
            Some(_) => rms::PILOT_OF_STREAM,
            None => PILOT_OF_STREAM,
        };
        let paths = |stream| u64::from(self.integrand.paths_of_a_sample(stream));
        let first = |stream| {
            let count = least.max(PILOT_OF_SENSOR.div_ceil(size(stream)));
            count.div_ceil(paths(stream))
        };
        let longest = |stream| LONGEST_PILOT_OF_STREAM.max(LONGEST_PILOT_OF_SENSOR / size(stream));
        let longest: Vec<_> = (0..cells.streams())
            .map(|stream| self.length(longest(stream)))
            .collect();
        let mut lengths: Vec<_> = (0..cells.streams())
            .map(|stream| self.length(first(stream)))
            .collect();
        let mut done = vec![0; lengths.len()];
        while done != lengths {
            let tasks = self.tasks(
                Phase::Pilot,
                |stream| (done[stream], lengths[stream]),
                |_, _| true,
            );
            if self.run(Phase::Pilot, tasks, cells)?.is_break() {
                return Ok(ControlFlow::Break(()));
            }
            done.clone_from(&lengths);
            for stream in 0..lengths.len() {
                if cells.summary(stream).effective_samples < EFFECTIVE_SAMPLES {
                    lengths[stream] = (2 * lengths[stream]).min(longest[stream]).max(done[stream]);
                }
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Samples of one replicate of a stream that is to have `samples`.
    fn length(&self, samples: u64) -> u64 {
        let replicates = u64::from(self.plan.replicates);
        let longest = (self.plan.max_samples / replicates).clamp(1, LONGEST_REPLICATE);
        round_up(samples.div_ceil(replicates)).min(longest)
    }

    fn decide(&self, pilot: &Cells) -> Decisions {
        let means = self.means(pilot);
        let lengths = match self.plan.stop.rms_error {
            Some(wanted) => self.shared_out(pilot, &means, wanted),
            None => self.one_by_one(pilot, &means),
        };
        Decisions { means, lengths }
    }

    /// Of the streams of each sensor.
    fn means(&self, cells: &Cells) -> Vec<f64> {
        let mut means = self.sensors.sum(|stream| self.value(cells, stream));
        let counts = means.iter_mut().zip(&self.sensors.streams);
        counts.for_each(|(mean, &streams)| *mean /= streams.max(1) as f64);
        means
    }

    /// Samples of a replicate with which each stream meets its own tolerance.
    fn one_by_one(&self, pilot: &Cells, means: &[f64]) -> Vec<u64> {
        let summaries: Vec<_> = (0..pilot.streams())
            .map(|stream| pilot.summary(stream))
            .collect();
        let variances = self
            .sensors
            .sum(|stream| summaries[stream].samples as f64 * summaries[stream].variance);
        let squares = self
            .sensors
            .sum(|stream| summaries[stream].mean * summaries[stream].mean);
        let length = |stream: usize| {
            let (sensor, own) = (self.sensors.of_stream[stream], summaries[stream]);
            let samples = own.samples as f64;
            let pooled = if squares[sensor] > 0.0 {
                variances[sensor] / squares[sensor] * own.mean * own.mean / samples
            } else {
                0.0
            };
            let tolerance = self
                .plan
                .stop
                .tolerance(self.value(pilot, stream), means[sensor]);
            let excess = SAFETY * self.factor * own.variance.max(pooled).sqrt() / tolerance;
            // A tolerance of zero belongs to a sensor that saw nothing: no number of samples is known to help.
            let growth = if tolerance > 0.0 {
                SMALLEST_FINAL.max(excess * excess)
            } else {
                1.0
            };
            self.length((samples * growth) as u64)
        };
        (0..pilot.streams()).map(length).collect()
    }

    /// Replaces the streams that missed by ones with twice the samples, if there is time for them.
    fn rerun(&mut self, decisions: &Decisions, cells: &mut Cells) -> Result<(), EstimationError> {
        let plan = self.plan;
        let met = self.met(decisions, cells);
        let missed = |stream: usize| plan.owns(stream) && !met[stream];
        let missed: Vec<bool> = (0..cells.streams()).map(missed).collect();
        let length =
            |stream: usize| self.length(2 * decisions.lengths[stream] * u64::from(plan.replicates));
        let tasks = self.tasks(
            Phase::Rerun,
            |stream| (0, length(stream)),
            |stream, _| missed[stream],
        );
        let mut again = Cells::new(self.integrand, plan);
        if !tasks.is_empty() && self.run(Phase::Rerun, tasks, &mut again)?.is_continue() {
            (0..missed.len())
                .filter(|&stream| missed[stream])
                .for_each(|stream| cells.replace(stream, &again));
        }
        Ok(())
    }

    fn value(&self, cells: &Cells, stream: usize) -> f64 {
        cells.summary(stream).mean + self.integrand.offset(stream)
    }

    /// Which streams meet the tolerance, or are of a sensor that meets it.
    fn met(&self, decisions: &Decisions, cells: &Cells) -> Vec<bool> {
        let means = &decisions.means;
        if let Some(wanted) = self.plan.stop.rms_error {
            return self.met_together(cells, means, wanted);
        }
        let meets = |stream: usize| {
            let mean = means[self.sensors.of_stream[stream]];
            let tolerance = self.plan.stop.tolerance(self.value(cells, stream), mean);
            self.factor * cells.summary(stream).variance.sqrt() <= tolerance
        };
        (0..cells.streams()).map(meets).collect()
    }

    /// Tasks over the `(from, to)` samples of every owned cell.
    fn tasks(
        &self,
        phase: Phase,
        range: impl Fn(usize) -> (u64, u64),
        owned: impl Fn(usize, u32) -> bool,
    ) -> Vec<Task> {
        let mut tasks = Vec::new();
        for stream in 0..self.sensors.of_stream.len() {
            let key = combine(mix_64(self.plan.seed), self.integrand.stream_key(stream));
            let (next, end) = range(stream);
            for replicate in (0..self.plan.replicates).filter(|&replicate| owned(stream, replicate))
            {
                let key = combine(combine(key, u64::from(replicate)), phase.key());
                tasks.push(Task {
                    stream: stream as u32,
                    replicate,
                    key,
                    next,
                    end,
                });
            }
        }
        tasks
    }

    fn run(
        &mut self,
        phase: Phase,
        tasks: Vec<Task>,
        cells: &mut Cells,
    ) -> Result<ControlFlow<()>, EstimationError> {
        let (integrand, sensors, factor) = (self.integrand, &self.sensors, self.factor);
        let relative_error = |cells: &Cells| relative_error(integrand, sensors, cells, factor);
        let work = Work {
            schedule: Schedule::new(tasks),
            phase,
            begin: self.crew.elapsed(),
        };
        let account = Account::new(work, cells, integrand.columns(), &relative_error);
        self.crew.run(account)
    }

    fn harvest(&self, cells: &Cells, converged: impl Fn(usize) -> bool) -> Vec<Replicates> {
        let stream =
            |stream| Replicates::new(self.integrand, self.plan, cells, stream, converged(stream));
        let mut streams: Vec<_> = (0..cells.streams()).map(stream).collect();
        share_largest(&mut streams);
        streams
    }
}

/// The largest multiple of a run boundary not above `count`: there a sum may be continued without changing a bit.
fn whole_runs(count: u64) -> u64 {
    if count < 1024 {
        1 << count.max(1).ilog2()
    } else {
        count / 1024 * 1024
    }
}

mod rms;
#[cfg(test)]
mod tests;
