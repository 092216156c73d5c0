//! In which pieces the samples are taken.
//!
//! A cell is one replicate of one stream. Its samples are cut into runs at 64, 128, 256, 512, 1024, 2048, 3072, …: a rule of the
//! sample index only, so that sums folded over runs have the same bits however far and in however many goes the cell is filled.
//! Slices go round the cells, the first run of each, then the second of each, so that all cells fill up evenly.

use super::{BATCH, Run};

/// A cell to be filled from sample `next` up to sample `end`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Task {
    pub(super) stream: u32,
    pub(super) replicate: u32,
    pub(super) key: u64,
    pub(super) next: u64,
    pub(super) end: u64,
}

/// Hands out batches of runs until all tasks are done.
pub(super) struct Schedule {
    tasks: Vec<Task>,
    cursor: usize,
}

const FIRST_RUN: u64 = 64;

/// Where the run that starts at `first` ends.
fn end_of_run(first: u64) -> u64 {
    let batch = BATCH as u64;
    if first < batch {
        (2 * first).max(FIRST_RUN)
    } else {
        (first / batch + 1) * batch
    }
}

/// The least number of samples, at least `count`, whose binary form has four leading digits only:
/// nearly whole nets, at most an eighth too many.
pub(super) fn round_up(count: u64) -> u64 {
    let unit = 1 << (64 - count.leading_zeros()).saturating_sub(4);
    count.div_ceil(unit) * unit
}

impl Schedule {
    pub(super) fn new(mut tasks: Vec<Task>) -> Self {
        tasks.retain(|task| task.next < task.end);
        Self { tasks, cursor: 0 }
    }

    /// Samples still to be handed out.
    pub(super) fn remaining(&self) -> u64 {
        self.tasks.iter().map(|task| task.end - task.next).sum()
    }

    /// Puts the next batch into `runs`; none are left if it stays empty.
    pub(super) fn next_batch(&mut self, runs: &mut Vec<Run>) {
        runs.clear();
        let mut room = BATCH as u64;
        while let Some(run) = self.peek().filter(|run| u64::from(run.count) <= room) {
            room -= u64::from(run.count);
            runs.push(run);
            self.advance(run.count);
        }
    }

    fn peek(&self) -> Option<Run> {
        let task = self.tasks.get(self.cursor)?;
        let end = end_of_run(task.next).min(task.end);
        // `Plan::check` keeps indices within 32 bits; a run is at most a batch long.
        let (first, count) = (task.next as u32, (end - task.next) as u32);
        Some(Run {
            stream: task.stream,
            replicate: task.replicate,
            first,
            count,
            key: task.key,
        })
    }

    fn advance(&mut self, count: u32) {
        self.tasks[self.cursor].next += u64::from(count);
        self.cursor += 1;
        if self.cursor == self.tasks.len() {
            self.tasks.retain(|task| task.next < task.end);
            self.cursor = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs_of(lengths: &[(u64, u64)]) -> Vec<Vec<Run>> {
        let task = |(stream, &(next, end)): (usize, &(u64, u64))| Task {
            stream: stream as u32,
            replicate: 0,
            key: 0,
            next,
            end,
        };
        let mut schedule = Schedule::new(lengths.iter().enumerate().map(task).collect());
        let (mut batches, mut runs) = (Vec::new(), Vec::new());
        loop {
            schedule.next_batch(&mut runs);
            if runs.is_empty() {
                return batches;
            }
            batches.push(runs.clone());
        }
    }

    #[test]
    fn batches_are_full_and_cells_are_covered_once_in_order() {
        let lengths = [(0, 5000), (0, 64), (0, 0), (640, 4097), (0, 1)];
        let batches = runs_of(&lengths);
        assert!(
            batches
                .iter()
                .all(|runs| runs.iter().map(|run| run.count as usize).sum::<usize>() <= BATCH)
        );
        for (stream, (start, end)) in lengths.into_iter().enumerate() {
            let own = batches
                .iter()
                .flatten()
                .filter(|run| run.stream == stream as u32);
            let reached = own.fold(start, |next, run| {
                assert_eq!(u64::from(run.first), next);
                next + u64::from(run.count)
            });
            assert_eq!(reached, end);
        }
    }

    #[test]
    fn filling_in_two_goes_cuts_at_the_same_places() {
        let cuts = |parts: &[(u64, u64)]| -> Vec<u32> {
            parts
                .iter()
                .flat_map(|&part| runs_of(&[part]))
                .flatten()
                .map(|run| run.first)
                .collect()
        };
        assert_eq!(
            cuts(&[(0, 5120)]),
            cuts(&[(0, 256), (256, 2048), (2048, 5120)])
        );
    }

    #[test]
    fn small_cells_share_a_batch() {
        let batches = runs_of(&[(0, 64); 100]);
        assert_eq!(
            batches.iter().map(Vec::len).collect::<Vec<_>>(),
            [16, 16, 16, 16, 16, 16, 4]
        );
    }

    #[test]
    fn rounding_keeps_four_binary_digits() {
        assert_eq!(
            [1, 15, 16, 17, 31, 33, 1000].map(round_up),
            [1, 15, 16, 18, 32, 36, 1024]
        );
    }
}
