//! Progress on a terminal: how far, how long still, and the present error.

use std::io::{IsTerminal, stderr};
use std::ops::ControlFlow;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use steradian::estimation::{Observer, Phase, Progress};

use crate::interrupt::Interrupt;
use crate::status::Failure;

const STEPS: u64 = 1000;
const TEMPLATE: &str = "{prefix} {wide_bar} {percent:>3} %  {msg}";

/// Watches a run: draws on a terminal, and stops the run after Ctrl-C.
pub struct Watch {
    bar: ProgressBar,
    interrupt: Interrupt,
}

impl Watch {
    /// Listens to Ctrl-C; draws if standard error is a terminal.
    pub fn new() -> Result<Self, Failure> {
        let bar = if stderr().is_terminal() {
            ProgressBar::new(STEPS)
        } else {
            ProgressBar::hidden()
        };
        let style =
            ProgressStyle::with_template(TEMPLATE).map_err(|error| Failure::Other(error.into()))?;
        bar.set_style(style);
        Ok(Self {
            bar,
            interrupt: Interrupt::listen()?,
        })
    }

    /// Clears the line; true if Ctrl-C ended the run.
    pub fn finish(self) -> bool {
        self.bar.finish_and_clear();
        self.interrupt.was_pressed()
    }
}

impl Observer for Watch {
    fn update(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.bar.set_prefix(phase(progress.phase));
        let position = STEPS as f64 * progress.finished;
        self.bar.set_position(position as u64);
        self.bar.set_message(message(progress));
        if self.interrupt.was_pressed() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

fn phase(phase: Phase) -> &'static str {
    match phase {
        Phase::Pilot => "pilot   ",
        Phase::Rerun => "again   ",
        _ => "sampling",
    }
}

fn message(progress: &Progress) -> String {
    let error = progress
        .relative_error
        .map(|error| format!("± {:.2} %", 100.0 * error));
    let time = progress
        .remaining
        .map(|left| format!("{} left", rounded(left)));
    [error, time]
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join("  ")
}

fn rounded(time: Duration) -> String {
    match time.as_secs() {
        seconds @ 0..60 => format!("{seconds} s"),
        seconds @ 60..3600 => format!("{} min {:02} s", seconds / 60, seconds % 60),
        seconds => format!("{} h {:02} min", seconds / 3600, seconds / 60 % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_short() {
        let texts = [5, 65, 3725].map(|seconds| rounded(Duration::from_secs(seconds)));
        assert_eq!(texts, ["5 s", "1 min 05 s", "1 h 02 min"]);
    }
}
