//! A list of steps run one after the other, each with its time, and a summary at the end.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

/// How a step ended.
enum Outcome {
    Passed,
    Failed(String),
    Skipped(String),
}

/// The steps run so far.
#[derive(Default)]
pub struct Steps {
    done: Vec<(String, Outcome, Duration)>,
}

impl Steps {
    /// Runs one step; a failure is kept and the next step runs all the same.
    pub fn run(&mut self, name: &str, step: impl FnOnce() -> Result<(), String>) {
        println!("── {name}");
        let start = Instant::now();
        let outcome = step().map_or_else(Outcome::Failed, |()| Outcome::Passed);
        if let Outcome::Failed(message) = &outcome {
            println!("{message}");
        }
        self.done.push((name.to_owned(), outcome, start.elapsed()));
    }

    /// Notes a step that cannot run here.
    pub fn skip(&mut self, name: &str, reason: &str) {
        let outcome = Outcome::Skipped(reason.to_owned());
        self.done.push((name.to_owned(), outcome, Duration::ZERO));
    }

    /// Prints the table of steps and times; an error if one failed.
    pub fn finish(self) -> Result<(), String> {
        println!();
        for (name, outcome, time) in &self.done {
            println!("{}", line(name, outcome, *time));
        }
        let count =
            |wanted: fn(&Outcome) -> bool| self.done.iter().filter(|step| wanted(&step.1)).count();
        let failed = count(|outcome| matches!(outcome, Outcome::Failed(_)));
        let skipped = count(|outcome| matches!(outcome, Outcome::Skipped(_)));
        let total: Duration = self.done.iter().map(|step| step.2).sum();
        let passed = self.done.len() - failed - skipped;
        println!("          {:7.1} s  in all", total.as_secs_f64());
        println!("{passed} passed, {failed} failed, {skipped} skipped");
        if failed == 0 {
            Ok(())
        } else {
            Err("FAILED".to_owned())
        }
    }
}

fn line(name: &str, outcome: &Outcome, time: Duration) -> String {
    let seconds = time.as_secs_f64();
    match outcome {
        Outcome::Passed => format!("  ok      {seconds:7.1} s  {name}"),
        Outcome::Failed(_) => format!("  FAILED  {seconds:7.1} s  {name}"),
        Outcome::Skipped(reason) => format!("  skipped            {name}: {reason}"),
    }
}

/// A `cargo` command in the folder `root`.
pub fn cargo(root: &Path, arguments: &[&str]) -> Command {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root).args(arguments);
    command
}

/// Runs a command to its end; an error if it cannot start or does not succeed.
pub fn succeed(command: &mut Command) -> Result<(), String> {
    let shown = format!("{command:?}");
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{shown}: {status}")),
        Err(error) => Err(format!("{shown}: {error}")),
    }
}

/// The standard output of a command that succeeds.
pub fn output(command: &mut Command) -> Result<String, String> {
    let shown = format!("{command:?}");
    let output = command
        .output()
        .map_err(|error| format!("{shown}: {error}"))?;
    if !output.status.success() {
        return Err(format!(
            "{shown}: {}\n{}",
            output.status,
            String::from_utf8_lossy(&output.stderr)
        ));
    }
    String::from_utf8(output.stdout).map_err(|error| format!("{shown}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_step_fails_the_run_and_the_others_still_run() {
        let mut steps = Steps::default();
        steps.run("first", || Err("no".to_owned()));
        let mut ran = false;
        steps.run("second", || {
            ran = true;
            Ok(())
        });
        assert!(steps.finish().is_err());
        assert!(ran);
    }

    #[test]
    fn a_skipped_step_does_not_fail_the_run() {
        let mut steps = Steps::default();
        steps.skip("links", "no browser");
        assert!(steps.finish().is_ok());
    }
}
