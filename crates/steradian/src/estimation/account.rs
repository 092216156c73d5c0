//! What a crew works on when it estimates streams: batches go out, their sums come in.

use std::time::Duration;

use super::cells::Cells;
use super::crew::{Ledger, Standing, Worker};
use super::schedule::Schedule;
use super::{EstimationError, Integrand, Phase, Run, SampleBatch, Tally};

/// Samples an integrand.
pub(super) struct Sampling<'a, I: Integrand>(pub(super) &'a I);

/// A batch and its sums.
pub(super) struct Parcel {
    runs: Vec<Run>,
    tally: Tally,
}

impl<I: Integrand> Worker for Sampling<'_, I> {
    type Job = Parcel;
    type Workspace = I::Workspace;

    fn new_workspace(&self) -> I::Workspace {
        self.0.new_workspace()
    }

    fn perform(&self, parcel: &mut Parcel, workspace: &mut I::Workspace) {
        parcel.tally.reset(parcel.runs.len());
        self.0.sample(
            &SampleBatch { runs: &parcel.runs },
            workspace,
            &mut parcel.tally,
        );
    }
}

/// What is to be done, in which part of the procedure, and when it began.
pub(super) struct Work {
    pub(super) schedule: Schedule,
    pub(super) phase: Phase,
    pub(super) begin: Duration,
}

/// Fills cells from a schedule.
pub(super) struct Account<'c> {
    work: Work,
    cells: &'c mut Cells,
    columns: usize,
    relative_error: &'c (dyn Fn(&Cells) -> Option<f64> + Sync),
    planned: u64,
    samples: u64,
    spare: Vec<Parcel>,
}

impl<'c> Account<'c> {
    pub(super) fn new(
        work: Work,
        cells: &'c mut Cells,
        columns: usize,
        relative_error: &'c (dyn Fn(&Cells) -> Option<f64> + Sync),
    ) -> Self {
        let planned = work.schedule.remaining();
        Self {
            work,
            cells,
            columns,
            relative_error,
            planned,
            samples: 0,
            spare: Vec::new(),
        }
    }
}

impl Ledger for Account<'_> {
    type Job = Parcel;

    fn issue(&mut self) -> Option<Parcel> {
        let new = || Parcel {
            runs: Vec::new(),
            tally: Tally::new(self.columns),
        };
        let mut parcel = self.spare.pop().unwrap_or_else(new);
        self.work.schedule.next_batch(&mut parcel.runs);
        (!parcel.runs.is_empty()).then_some(parcel)
    }

    fn merge(&mut self, parcel: Parcel) -> Result<(), EstimationError> {
        self.samples += SampleBatch { runs: &parcel.runs }.count() as u64;
        self.cells.add(&parcel.runs, &parcel.tally)?;
        self.spare.push(parcel);
        Ok(())
    }

    fn is_complete(&self) -> bool {
        self.samples == self.planned
    }

    fn standing(&self) -> Standing {
        let relative_error = (self.relative_error)(self.cells);
        let &Work { phase, begin, .. } = &self.work;
        Standing {
            phase,
            begin,
            samples: self.samples,
            planned: self.planned,
            relative_error,
        }
    }
}
