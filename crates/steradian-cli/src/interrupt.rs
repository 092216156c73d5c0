//! Ctrl-C: the first ends the run and keeps what there is, the second ends the process.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::status::Failure;

/// Exit status of a process that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

/// Set once Ctrl-C was pressed.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens to Ctrl-C from now on.
    pub fn listen() -> Result<Self, Failure> {
        let interrupt = Self::default();
        let seen = Arc::clone(&interrupt.0);
        ctrlc::set_handler(move || pressed(&seen)).map_err(|error| Failure::Other(error.into()))?;
        Ok(interrupt)
    }

    /// Whether Ctrl-C was pressed.
    pub fn was_pressed(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

#[expect(
    clippy::exit,
    reason = "whoever presses Ctrl-C twice wants the process to end"
)]
fn pressed(seen: &AtomicBool) {
    if seen.swap(true, Ordering::Relaxed) {
        std::process::exit(INTERRUPTED);
    }
}
