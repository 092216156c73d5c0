//! What a running estimation tells, and how it is stopped from outside.

use std::ops::ControlFlow;
use std::time::Duration;

/// Watches an estimation. Called about ten times a second on the thread that started the estimation.
pub trait Observer {
    /// Takes notice; `Break` ends the estimation, which then returns what there is, not converged.
    fn update(&mut self, progress: &Progress) -> ControlFlow<()>;
}

impl<F: FnMut(&Progress) -> ControlFlow<()>> Observer for F {
    fn update(&mut self, progress: &Progress) -> ControlFlow<()> {
        self(progress)
    }
}

/// An observer that never looks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Observer for Silent {
    fn update(&mut self, _progress: &Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// What part of the procedure is running.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Finding out how many samples a tolerance needs; these samples are discarded.
    Pilot,
    /// The samples of the result.
    Final,
    /// The samples of the result once more, twice as many, for streams that missed the tolerance.
    Rerun,
}

impl Phase {
    /// Keeps the random numbers of the phases apart.
    pub(crate) fn key(self) -> u64 {
        match self {
            Self::Pilot => 0,
            Self::Final => 1,
            Self::Rerun => 2,
        }
    }
}

/// How far an estimation is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The part that is running.
    pub phase: Phase,
    /// Samples done in this phase.
    pub samples: u64,
    /// Samples this phase will take; in a pilot or a timed run, as far as known by now.
    pub planned: u64,
    /// The part of this phase that is done; where points are measured in blocks, the part of all points.
    pub finished: f64,
    /// Time since the start.
    pub elapsed: Duration,
    /// Estimated time to the end of this phase, or of all blocks, once there is something to judge by.
    pub remaining: Option<Duration>,
    /// The largest half-width of a stream's interval, relative to the value (or to 1 % of the sensor's mean if that is larger),
    /// once every stream of the block has one.
    pub relative_error: Option<f64>,
}
