//! The threads: workers take jobs, the caller's thread watches.
//!
//! Jobs are numbered as they are handed out and merged in that order, whichever worker finishes first: results cannot
//! depend on how many workers there are.

use std::any::Any;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::{EstimationError, Observer, Phase, Progress};

const BETWEEN_UPDATES: Duration = Duration::from_millis(100);

/// Does jobs, each on one thread.
pub(crate) trait Worker: Sync {
    type Job: Send;
    type Workspace: Send;

    fn new_workspace(&self) -> Self::Workspace;

    fn perform(&self, job: &mut Self::Job, workspace: &mut Self::Workspace);
}

/// Hands out jobs and takes them back in the same order.
pub(crate) trait Ledger: Send {
    type Job: Send;

    /// The next job, none when all are out.
    fn issue(&mut self) -> Option<Self::Job>;

    fn merge(&mut self, job: Self::Job) -> Result<(), EstimationError>;

    /// Whether every job has come back.
    fn is_complete(&self) -> bool;

    fn standing(&self) -> Standing;
}

/// The part of a progress that does not need a clock.
pub(crate) struct Standing {
    pub(crate) phase: Phase,
    /// When the samples that are counted here began.
    pub(crate) begin: Duration,
    pub(crate) samples: u64,
    pub(crate) planned: u64,
    pub(crate) relative_error: Option<f64>,
}

/// Workers' memory, clock and observer of one estimation.
pub(crate) struct Crew<'a, W: Worker> {
    worker: W,
    workspaces: Vec<W::Workspace>,
    observer: &'a mut dyn Observer,
    start: Instant,
    limit: Option<Duration>,
    next_update: Duration,
}

struct State<L: Ledger> {
    ledger: L,
    issued: u64,
    merged: u64,
    waiting: BTreeMap<u64, L::Job>,
    working: usize,
    stop: bool,
    fault: Option<EstimationError>,
}

struct Shared<L: Ledger> {
    state: Mutex<State<L>>,
    changed: Condvar,
}

impl<'a, W: Worker> Crew<'a, W> {
    pub(crate) fn new(
        worker: W,
        threads: usize,
        limit: Option<Duration>,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let workspaces = (0..threads).map(|_| worker.new_workspace()).collect();
        Self {
            worker,
            workspaces,
            observer,
            start: Instant::now(),
            limit,
            next_update: BETWEEN_UPDATES,
        }
    }

    pub(crate) fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    /// Works through the ledger; `Break` if the observer or the clock ended it before.
    pub(crate) fn run<L: Ledger<Job = W::Job>>(
        &mut self,
        ledger: L,
    ) -> Result<ControlFlow<()>, EstimationError> {
        let mut workspaces = std::mem::take(&mut self.workspaces);
        let shared = Shared::new(ledger, workspaces.len());
        let panics = std::thread::scope(|scope| {
            let (shared, worker) = (&shared, &self.worker);
            let work = |workspace| scope.spawn(move || shared.work(worker, workspace));
            let handles: Vec<_> = workspaces.iter_mut().map(work).collect();
            let clock = (self.start, self.limit);
            watch(shared, clock, self.observer, &mut self.next_update);
            handles
                .into_iter()
                .filter_map(|handle| handle.join().err())
                .collect::<Vec<_>>()
        });
        self.workspaces = workspaces;
        shared.finish(panics)
    }
}

/// Looks after the clock and the observer until all workers have left.
fn watch<L: Ledger>(
    shared: &Shared<L>,
    (start, limit): (Instant, Option<Duration>),
    observer: &mut dyn Observer,
    next_update: &mut Duration,
) {
    let mut state = shared.lock();
    while state.working > 0 {
        let now = start.elapsed();
        state.stop |= limit.is_some_and(|limit| now >= limit);
        if now >= *next_update {
            let progress = progress(&state.ledger.standing(), now);
            drop(state);
            *next_update = now + BETWEEN_UPDATES;
            let verdict = observer.update(&progress);
            state = shared.lock();
            state.stop |= verdict.is_break();
        }
        let next = limit
            .filter(|limit| *limit > now)
            .map_or(*next_update, |limit| limit.min(*next_update));
        let patience = next
            .saturating_sub(start.elapsed())
            .max(Duration::from_millis(1));
        state = shared.wait(state, patience);
    }
}

fn progress(standing: &Standing, now: Duration) -> Progress {
    let &Standing {
        phase,
        begin,
        samples,
        planned,
        relative_error,
    } = standing;
    let seconds =
        now.saturating_sub(begin).as_secs_f64() * (planned - samples) as f64 / samples as f64;
    let remaining = Duration::try_from_secs_f64(seconds).ok();
    Progress {
        phase,
        samples,
        planned,
        finished: samples as f64 / planned.max(1) as f64,
        elapsed: now,
        remaining,
        relative_error,
    }
}

impl<L: Ledger> Shared<L> {
    fn new(ledger: L, workers: usize) -> Self {
        let state = State {
            ledger,
            issued: 0,
            merged: 0,
            waiting: BTreeMap::new(),
            working: workers,
            stop: false,
            fault: None,
        };
        Self {
            state: Mutex::new(state),
            changed: Condvar::new(),
        }
    }

    /// A worker that panics does so between locks, so poisoning tells nothing.
    fn lock(&self) -> MutexGuard<'_, State<L>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'s>(
        &'s self,
        state: MutexGuard<'s, State<L>>,
        patience: Duration,
    ) -> MutexGuard<'s, State<L>> {
        self.changed
            .wait_timeout(state, patience)
            .unwrap_or_else(PoisonError::into_inner)
            .0
    }

    fn work<W: Worker<Job = L::Job>>(&self, worker: &W, workspace: &mut W::Workspace) {
        let _leaving = Leaving(self);
        while let Some((number, mut job)) = self.issue() {
            worker.perform(&mut job, workspace);
            self.lock().deliver(number, job);
        }
    }

    /// Holds the lock for the call only, which a `while let` on the guard would not.
    fn issue(&self) -> Option<(u64, L::Job)> {
        self.lock().issue()
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
            None if state.ledger.is_complete() => Ok(ControlFlow::Continue(())),
            None => Ok(ControlFlow::Break(())),
        }
    }
}

fn message_of(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(ToString::to_string);
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned())
}

/// Counts a worker out when it leaves, also by a panic, which stops the others.
struct Leaving<'s, L: Ledger>(&'s Shared<L>);

impl<L: Ledger> Drop for Leaving<'_, L> {
    fn drop(&mut self) {
        let mut state = self.0.lock();
        state.working -= 1;
        state.stop |= std::thread::panicking();
        self.0.changed.notify_all();
    }
}

impl<L: Ledger> State<L> {
    fn issue(&mut self) -> Option<(u64, L::Job)> {
        if self.stop {
            return None;
        }
        let job = self.ledger.issue()?;
        self.issued += 1;
        Some((self.issued - 1, job))
    }

    fn deliver(&mut self, number: u64, job: L::Job) {
        self.waiting.insert(number, job);
        while let Some(job) = self.waiting.remove(&self.merged) {
            self.merged += 1;
            if let Err(fault) = self.ledger.merge(job) {
                self.stop = true;
                self.fault.get_or_insert(fault);
            }
        }
    }
}
