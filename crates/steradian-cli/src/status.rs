//! How the command ends.

use std::io::{self, Write};
use std::process::ExitCode;

use steradian::estimation::EstimationError;
use steradian::exchange::ExchangeError;
use steradian::measurement::ScheduleError;
use steradian::time::TimeError;
use steradian::transport::SimulationError;
use steradian_io::diagnostic::{self, Diagnostic};
use steradian_io::report::ReportError;
use steradian_io::report::stored::StoredError;

/// It ran.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All is well: exit status 0.
    Fine,
    /// A tolerance was not met, a check failed, or light was left out: exit status 1.
    NotAsAsked,
}

impl Outcome {
    /// Fine if `good`.
    pub fn fine_if(good: bool) -> Self {
        if good { Self::Fine } else { Self::NotAsAsked }
    }
}

/// It did not run: exit status 2.
#[derive(Debug)]
pub enum Failure {
    /// Something is wrong with an input file.
    Input(Vec<Diagnostic>),
    /// Whoever read the output has gone; this is no error.
    BrokenPipe,
    /// Anything else.
    Other(anyhow::Error),
}

impl Failure {
    /// A message of our own.
    pub fn message(text: impl Into<String>) -> Self {
        Self::Other(anyhow::Error::msg(text.into()))
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            Self::BrokenPipe
        } else {
            Self::Other(error.into())
        }
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Output(refused) => refused.into(),
            error => Self::Other(error.into()),
        }
    }
}

impl From<StoredError> for Failure {
    fn from(error: StoredError) -> Self {
        Self::Other(error.into())
    }
}

impl From<EstimationError> for Failure {
    fn from(error: EstimationError) -> Self {
        Self::Other(error.into())
    }
}

impl From<ExchangeError> for Failure {
    fn from(error: ExchangeError) -> Self {
        Self::Other(error.into())
    }
}

impl From<SimulationError> for Failure {
    fn from(error: SimulationError) -> Self {
        Self::Other(error.into())
    }
}

impl From<TimeError> for Failure {
    fn from(error: TimeError) -> Self {
        Self::Other(error.into())
    }
}

impl From<ScheduleError> for Failure {
    fn from(error: ScheduleError) -> Self {
        Self::Other(error.into())
    }
}

/// Tells what went wrong on standard error and gives the exit status.
pub fn exit_code(result: Result<Outcome, Failure>) -> ExitCode {
    match result {
        Ok(Outcome::Fine) | Err(Failure::BrokenPipe) => ExitCode::SUCCESS,
        Ok(Outcome::NotAsAsked) => ExitCode::from(1),
        Err(Failure::Input(diagnostics)) => fail(&diagnostic::render(&diagnostics, is_terminal())),
        Err(Failure::Other(error)) => fail(&format!("error: {error:#}\n")),
    }
}

/// Prints a remark on standard error; if nobody listens, that is fine.
pub fn remark(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}

fn fail(text: &str) -> ExitCode {
    remark(text.trim_end());
    ExitCode::from(2)
}

fn is_terminal() -> bool {
    io::IsTerminal::is_terminal(&io::stderr())
}
