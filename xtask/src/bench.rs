//! The benchmark suite: runs the programs of `benchmarks/suite`, which take turns with peers, and prints one table, ratios first.
//!
//! It writes nothing but the table: what is worth keeping goes into `benchmarks/LOG.md` by hand.

mod figures;
mod options;
mod table;

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::json::{self, Value};
use crate::steps::{cargo, output};
use figures::{Figure, Line};
use options::{Options, Part};

/// What the programs of the suite have said.
#[derive(Default)]
struct Said {
    figures: Vec<Figure>,
    notes: Vec<String>,
    missing: Vec<(String, String)>,
    failed: Vec<String>,
}

/// Runs the parts that are asked for. An error names those that failed, after the table of all others.
pub fn run(root: &Path, words: &[&str]) -> Result<(), String> {
    if let ["--help" | "-h"] = words {
        println!("{}", options::usage());
        return Ok(());
    }
    let options = Options::read(words, |name| std::env::var_os(name).map(PathBuf::from))?;
    numpy(&python(&options))?;
    let common = common(root, &options)?;
    let mut said = Said::default();
    for part in &options.parts {
        eprintln!("── {}", part.name);
        if let Err(message) = measure(root, part, &options, &common, &mut said) {
            said.failed.push(format!("{}: {message}", part.name));
        }
    }
    said.print();
    if said.failed.is_empty() {
        Ok(())
    } else {
        Err(said.failed.join("\n"))
    }
}

/// The Python that runs all programs.
fn python(options: &Options) -> PathBuf {
    let given = options.path("--mitsuba").cloned();
    given.unwrap_or_else(|| "python3".into())
}

/// An error that says how to get numpy, which most programs need.
fn numpy(python: &Path) -> Result<(), String> {
    let tried = Command::new(python)
        .args(["-c", "import numpy"])
        .stderr(Stdio::null())
        .status();
    if tried.is_ok_and(|status| status.success()) {
        return Ok(());
    }
    Err(format!(
        "{} has no numpy: `python3 -m venv venv && venv/bin/pip install numpy mitsuba`, then --mitsuba venv/bin/python",
        python.display()
    ))
}

/// The flags that every program understands.
fn common(root: &Path, options: &Options) -> Result<Vec<String>, String> {
    let build = ["build", "--release", "--package", "steradian-cli"];
    let program = executable(root, &build, "steradian")?;
    let rounds = options.rounds.to_string();
    let cache = root.join("target").join("bench");
    let mut words = vec![
        "--program".to_owned(),
        program,
        "--rounds".to_owned(),
        rounds,
        "--cache".to_owned(),
        cache.display().to_string(),
    ];
    if options.quick {
        words.push("--quick".to_owned());
    }
    Ok(words)
}

/// Runs the program of a part to its end and keeps what it says.
fn measure(
    root: &Path,
    part: &Part,
    options: &Options,
    common: &[String],
    said: &mut Said,
) -> Result<(), String> {
    let python = python(options);
    let mut command = Command::new(&python);
    command.arg(root.join("benchmarks/suite").join(part.program));
    command
        .args(common)
        .args(part.arguments)
        .args(peers(root, part, options)?);
    let shown = format!("{}", python.display());
    let spawned = command.stdout(Stdio::piped()).spawn();
    let mut child = spawned.map_err(|error| format!("{shown}: {error}"))?;
    if let Some(stdout) = child.stdout.take() {
        for line in BufReader::new(stdout).lines() {
            said.hear(&line.map_err(|error| format!("{shown}: {error}"))?)?;
        }
    }
    match child.wait() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{}: {status}", part.program)),
        Err(error) => Err(format!("{shown}: {error}")),
    }
}

/// The flags that only the program of this part understands.
fn peers(root: &Path, part: &Part, options: &Options) -> Result<Vec<String>, String> {
    let wanted: &[&str] = match part.program {
        "kernel.py" => &["--embree"],
        "grid.py" => &["--radiance"],
        "pictures.py" => &["--cycles", "--bathroom"],
        _ => &[],
    };
    let mut words = Vec::new();
    for &flag in wanted {
        if let Some(path) = options.path(flag) {
            words.extend([flag.to_owned(), path.display().to_string()]);
        }
    }
    if matches!(part.name, "kernel" | "triangles") {
        let build = [
            "bench",
            "--package",
            "steradian-benches",
            "--bench",
            "kernel_embree",
            "--no-run",
        ];
        words.extend([
            "--kernel".to_owned(),
            executable(root, &build, "kernel_embree")?,
        ]);
    }
    Ok(words)
}

/// Builds with cargo and returns where the executable of a target lies.
fn executable(root: &Path, build: &[&str], target: &str) -> Result<String, String> {
    let messages = output(cargo(root, build).args(["--quiet", "--message-format", "json"]))?;
    let found = messages
        .lines()
        .filter_map(|line| json::parse(line).ok())
        .find_map(|message| {
            let name = message.get("target")?.get("name")?.text()?.to_owned();
            let path = message.get("executable").and_then(Value::text)?.to_owned();
            (name == target).then_some(path)
        });
    found.ok_or_else(|| format!("cargo {}: no executable {target}", build.join(" ")))
}

impl Said {
    fn hear(&mut self, line: &str) -> Result<(), String> {
        match figures::read(line)? {
            Line::Figure(figure) => self.figures.push(figure),
            Line::Note(note) => self.notes.push(note),
            Line::Missing { peer, install } => self.missing.push((peer, install)),
        }
        Ok(())
    }

    fn print(&self) {
        let rows = figures::rows(&self.figures);
        println!("{}", table::render(&rows));
        for note in &self.notes {
            println!("{note}");
        }
        let mut told: Vec<&(String, String)> = Vec::new();
        for missing in &self.missing {
            if !told.contains(&missing) {
                told.push(missing);
                println!("{} is missing: {}", missing.0, missing.1);
            }
        }
        let met = rows.iter().filter(|row| row.is_met() == Some(true)).count();
        let goals = rows.iter().filter(|row| row.is_met().is_some()).count();
        println!("{met} of {goals} goals met; a ratio above 1 says that ours is better");
    }
}
