//! Progress and time of a run in blocks.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::{Piece, points_of};
use crate::estimation::{Observer, Phase, Plan, Progress};

/// Shows an observer the run as a whole, and shares out its time.
pub(super) struct Watch<'o> {
    observer: &'o mut dyn Observer,
    start: Instant,
    several: bool,
    /// Points of the blocks that are done, of the one in work, and of all.
    done: usize,
    at_work: usize,
    all: usize,
    stopped: bool,
}

impl<'o> Watch<'o> {
    pub fn new(observer: &'o mut dyn Observer, blocks: &[Vec<Piece>]) -> Self {
        Self {
            observer,
            start: Instant::now(),
            several: blocks.len() > 1,
            done: 0,
            at_work: 0,
            all: blocks.iter().map(|block| points_of(block)).sum(),
            stopped: false,
        }
    }

    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// The plan of a block of so many points: with its share of the time that is left.
    pub fn begin(&mut self, points: usize, plan: &Plan) -> Plan {
        self.at_work = points;
        let left = (self.all - self.done).max(1);
        let elapsed = self.start.elapsed();
        let share = |time: Duration| {
            let time = time.saturating_sub(elapsed);
            time.mul_f64(points as f64 / left as f64)
        };
        let mut plan = plan.clone();
        plan.stop.time = plan.stop.time.map(share);
        plan
    }

    /// A block is done; the observer is asked, however short it was.
    pub fn end(&mut self) {
        self.done += self.at_work;
        self.at_work = 0;
        if self.done < self.all && !self.stopped {
            // What an observer says is kept in `stopped`.
            let _ = self.update(&Progress {
                phase: Phase::Final,
                samples: 0,
                planned: 0,
                finished: 0.0,
                elapsed: self.start.elapsed(),
                remaining: None,
                relative_error: None,
            });
        }
    }

    /// The same progress, but of all blocks.
    fn overall(&self, progress: &Progress) -> Progress {
        let of_block = match progress.phase {
            Phase::Pilot => 0.0,
            Phase::Final => progress.finished,
            Phase::Rerun => 1.0,
        };
        let points = self.done as f64 + of_block * self.at_work as f64;
        let finished = points / self.all.max(1) as f64;
        let elapsed = self.start.elapsed();
        let remaining = elapsed.as_secs_f64() * (1.0 - finished) / finished;
        Progress {
            finished,
            elapsed,
            remaining: Duration::try_from_secs_f64(remaining).ok(),
            ..*progress
        }
    }
}

impl Observer for Watch<'_> {
    fn update(&mut self, progress: &Progress) -> ControlFlow<()> {
        let verdict = if self.several {
            let overall = self.overall(progress);
            self.observer.update(&overall)
        } else {
            self.observer.update(progress)
        };
        self.stopped |= verdict.is_break();
        verdict
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Size, cut};
    use super::*;

    /// A half of the points have a half of the time; what the first block left over goes to the others.
    #[test]
    fn time_is_shared_out_by_points() {
        let (mut silent, plan) = (
            crate::estimation::Silent,
            Plan {
                stop: crate::estimation::Stopping::at_time(Duration::from_secs(1000)),
                ..Plan::default()
            },
        );
        let sizes = [8, 4, 4].map(|points| Size {
            points,
            can_be_cut: true,
        });
        let mut watch = Watch::new(&mut silent, &cut(&sizes, 8));
        let seconds = |plan: &Plan| plan.stop.time.unwrap().as_secs_f64();
        let first = seconds(&watch.begin(8, &plan));
        watch.end();
        let second = seconds(&watch.begin(8, &plan));
        assert!((499.0..=500.0).contains(&first), "{first}");
        assert!((999.0..=1000.0).contains(&second), "{second}");
    }

    /// Half-way through the second of two equal blocks, three quarters are done; pilots count nothing.
    #[test]
    fn an_observer_sees_all_blocks() {
        let mut seen = Vec::new();
        let mut observer = |progress: &Progress| {
            seen.push(progress.finished);
            ControlFlow::Continue(())
        };
        let size = Size {
            points: 16,
            can_be_cut: true,
        };
        let mut watch = Watch::new(&mut observer, &cut(&[size], 8));
        let told = |phase| Progress {
            phase,
            samples: 0,
            planned: 0,
            finished: 0.5,
            elapsed: Duration::ZERO,
            remaining: None,
            relative_error: None,
        };
        watch.begin(8, &Plan::default());
        let _ = watch.update(&told(Phase::Pilot));
        let _ = watch.update(&told(Phase::Final));
        watch.end();
        watch.begin(8, &Plan::default());
        let _ = watch.update(&told(Phase::Final));
        watch.end();
        assert_eq!(seen, [0.0, 0.25, 0.5, 0.75]);
    }
}
