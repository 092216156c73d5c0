//! The threads: workers take batches from the schedule, the caller's thread watches.
//!
//! Batches are numbered as they are handed out and merged in that order, whichever worker finishes first.

use std::any::Any;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::ScopedJoinHandle;
use std::time::{Duration, Instant};

use super::cells::Cells;
use super::schedule::Schedule;
use super::{EstimationError, Integrand, Observer, Phase, Progress, Run, SampleBatch, Tally};

const BETWEEN_UPDATES: Duration = Duration::from_millis(100);

/// Workers' memory, clock and observer of one estimation.
pub(super) struct Crew<'a, I: Integrand> {
    integrand: &'a I,
    workspaces: Vec<I::Workspace>,
    observer: &'a mut dyn Observer,
    start: Instant,
    limit: Option<Duration>,
    next_update: Duration,
}

/// What the watcher is told beside the progress of the schedule.
pub(super) struct Watch<'a> {
    pub(super) phase: Phase,
    pub(super) relative_error: &'a dyn Fn(&Cells) -> Option<f64>,
}

struct Parcel {
    runs: Vec<Run>,
    tally: Tally,
}

struct State<'c> {
    schedule: Schedule,
    cells: &'c mut Cells,
    issued: u64,
    merged: u64,
    samples: u64,
    waiting: BTreeMap<u64, Parcel>,
    spare: Vec<Parcel>,
    working: usize,
    stop: bool,
    fault: Option<EstimationError>,
}

struct Shared<'c> {
    state: Mutex<State<'c>>,
    changed: Condvar,
}

impl<'a, I: Integrand> Crew<'a, I> {
    pub(super) fn new(
        integrand: &'a I,
        threads: usize,
        limit: Option<Duration>,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let workspaces = (0..threads).map(|_| integrand.new_workspace()).collect();
        Self {
            integrand,
            workspaces,
            observer,
            start: Instant::now(),
            limit,
            next_update: BETWEEN_UPDATES,
        }
    }

    pub(super) fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    /// Works through the schedule; `Break` if the observer or the clock ended it before.
    pub(super) fn run(
        &mut self,
        schedule: Schedule,
        cells: &mut Cells,
        watch: &Watch<'_>,
    ) -> Result<ControlFlow<()>, EstimationError> {
        let integrand = self.integrand;
        let mut workspaces = std::mem::take(&mut self.workspaces);
        let planned = schedule.remaining();
        let shared = Shared::new(schedule, cells, workspaces.len());
        let panics = std::thread::scope(|scope| {
            let shared = &shared;
            let work = |workspace| scope.spawn(move || shared.work(integrand, workspace));
            let handles: Vec<_> = workspaces.iter_mut().map(work).collect();
            self.watch(shared, planned, watch);
            handles
                .into_iter()
                .filter_map(|handle: ScopedJoinHandle<'_, ()>| handle.join().err())
                .collect::<Vec<_>>()
        });
        self.workspaces = workspaces;
        shared.finish(panics)
    }

    fn watch(&mut self, shared: &Shared<'_>, planned: u64, watch: &Watch<'_>) {
        let begin = self.elapsed();
        let mut state = shared.lock();
        while state.working > 0 {
            let now = self.elapsed();
            if self.limit.is_some_and(|limit| now >= limit) {
                state.stop = true;
            }
            if now >= self.next_update {
                let progress = progress(&state, planned, begin, now, watch);
                drop(state);
                self.next_update = now + BETWEEN_UPDATES;
                let verdict = self.observer.update(&progress);
                state = shared.lock();
                state.stop |= verdict.is_break();
            }
            state = shared.wait(state, self.patience());
        }
    }

    /// Time to the next thing the watcher has to do.
    fn patience(&self) -> Duration {
        let next = self
            .limit
            .map_or(self.next_update, |limit| limit.min(self.next_update));
        next.saturating_sub(self.elapsed())
            .clamp(Duration::from_millis(1), BETWEEN_UPDATES)
    }
}

fn progress(
    state: &State<'_>,
    planned: u64,
    begin: Duration,
    now: Duration,
    watch: &Watch<'_>,
) -> Progress {
    let left = (planned - state.samples) as f64;
    let rate = state.samples as f64 / (now - begin).as_secs_f64();
    let remaining = (state.samples > 0)
        .then(|| Duration::try_from_secs_f64(left / rate).ok())
        .flatten();
    let relative_error = (watch.relative_error)(state.cells);
    Progress {
        phase: watch.phase,
        samples: state.samples,
        planned,
        elapsed: now,
        remaining,
        relative_error,
    }
}

impl<'c> Shared<'c> {
    fn new(schedule: Schedule, cells: &'c mut Cells, workers: usize) -> Self {
        let state = State {
            schedule,
            cells,
            issued: 0,
            merged: 0,
            samples: 0,
            waiting: BTreeMap::new(),
            spare: Vec::new(),
            working: workers,
            stop: false,
            fault: None,
        };
        Self {
            state: Mutex::new(state),
            changed: Condvar::new(),
        }
    }

    /// A worker that panics leaves the state as it was between two batches, so poisoning tells nothing.
    fn lock(&self) -> MutexGuard<'_, State<'c>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'s>(
        &'s self,
        state: MutexGuard<'s, State<'c>>,
        patience: Duration,
    ) -> MutexGuard<'s, State<'c>> {
        self.changed
            .wait_timeout(state, patience)
            .unwrap_or_else(PoisonError::into_inner)
            .0
    }

    fn work<I: Integrand>(&self, integrand: &I, workspace: &mut I::Workspace) {
        let _leaving = Leaving(self);
        while let Some((number, mut parcel)) = self.issue(integrand) {
            parcel.tally.reset(parcel.runs.len());
            integrand.sample(
                &SampleBatch { runs: &parcel.runs },
                workspace,
                &mut parcel.tally,
            );
            self.lock().deliver(number, parcel);
        }
    }

    fn issue<I: Integrand>(&self, integrand: &I) -> Option<(u64, Parcel)> {
        self.lock().issue(integrand)
    }

    fn finish(self, panics: Vec<Box<dyn Any + Send>>) -> Result<ControlFlow<()>, EstimationError> {
        let state = self
            .state
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(payload) = panics.first() {
            return Err(EstimationError::Panicked(message_of(payload.as_ref())));
        }
        match state.fault {
            Some(fault) => Err(fault),
            None if state.schedule.remaining() > 0 => Ok(ControlFlow::Break(())),
            None => Ok(ControlFlow::Continue(())),
        }
    }
}

fn message_of(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(ToString::to_string);
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned())
}

/// Counts a worker out when it leaves, also by a panic, which stops the others.
struct Leaving<'s, 'c>(&'s Shared<'c>);

impl Drop for Leaving<'_, '_> {
    fn drop(&mut self) {
        let mut state = self.0.lock();
        state.working -= 1;
        state.stop |= std::thread::panicking();
        self.0.changed.notify_all();
    }
}

impl State<'_> {
    fn issue<I: Integrand>(&mut self, integrand: &I) -> Option<(u64, Parcel)> {
        if self.stop {
            return None;
        }
        let new = || Parcel {
            runs: Vec::new(),
            tally: Tally::new(integrand.weights()),
        };
        let mut parcel = self.spare.pop().unwrap_or_else(new);
        self.schedule.next_batch(&mut parcel.runs);
        self.issued += 1;
        (!parcel.runs.is_empty()).then_some((self.issued - 1, parcel))
    }

    fn deliver(&mut self, number: u64, parcel: Parcel) {
        self.waiting.insert(number, parcel);
        while let Some(parcel) = self.waiting.remove(&self.merged) {
            self.merged += 1;
            self.samples += SampleBatch { runs: &parcel.runs }.count() as u64;
            if let Err(fault) = self.cells.add(&parcel.runs, &parcel.tally) {
                self.stop = true;
                self.fault.get_or_insert(fault);
            }
            self.spare.push(parcel);
        }
    }
}
