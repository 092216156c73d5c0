//! What a change must pass, and the longer runs.

use std::path::Path;
use std::process::Command;

use crate::steps::{Steps, cargo, succeed};
use crate::{layers, licences, schema};

const TESTS: &str = "steradian-tests";

/// Format, lints (the command without its features, too), layers, licences, tests with documentation tests, every reflection model's checks, generated files.
pub fn test(root: &Path) -> Result<(), String> {
    let run = |arguments: &[&str]| succeed(&mut cargo(root, arguments));
    let mut steps = Steps::default();
    steps.run("format", || run(&["fmt", "--all", "--check"]));
    steps.run("layers", || layers::check(root));
    steps.run("licences", || licences::check(root));
    steps.run("lints", || {
        run(&[
            "clippy",
            "--quiet",
            "--workspace",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ])
    });
    steps.run("without Parquet", || {
        run(&[
            "clippy",
            "--quiet",
            "--package",
            "steradian-cli",
            "--no-default-features",
            "--",
            "-D",
            "warnings",
        ])
    });
    steps.run("tests", || run(&["test", "--quiet", "--workspace"]));
    steps.run("reflection models", || {
        let command = ["run", "--quiet", "--package", "steradian-cli", "--"];
        run(&[&command[..], &["brdf", "check"]].concat())
    });
    steps.run("generated files", || schema::check(root));
    steps.run("documentation", || docs(root));
    programs(root, &mut steps);
    advisories(root, &mut steps);
    steps.finish()
}

/// The statistical tests at full count, optimised: those marked `#[ignore]`.
pub fn statistics(root: &Path) -> Result<(), String> {
    succeed(&mut cargo(
        root,
        &[
            "test",
            "--release",
            "--package",
            TESTS,
            "--",
            "--ignored",
            "--nocapture",
        ],
    ))
}

/// The benchmarks of single functions, all or those whose name holds a filter.
pub fn stages(root: &Path, filter: &[&str]) -> Result<(), String> {
    succeed(cargo(root, &["bench", "--package", "steradian-benches", "--"]).args(filter))
}

/// The documentation, with broken links refused; the course and the example of a lighting study, whose commands must print what
/// their texts say.
pub fn docs(root: &Path) -> Result<(), String> {
    let course = [
        "test",
        "--quiet",
        "--package",
        TESTS,
        "--test",
        "cli",
        "--",
        "course",
        "classroom",
    ];
    succeed(&mut cargo(root, &course))?;
    let pictures = [
        "run",
        "--quiet",
        "--package",
        "steradian-course",
        "--",
        "check",
    ];
    succeed(&mut cargo(root, &pictures))?;
    let arguments = [
        "doc",
        "--quiet",
        "--workspace",
        "--no-deps",
        "--exclude",
        "xtask",
    ];
    succeed(cargo(root, &arguments).env("RUSTDOCFLAGS", "-D warnings"))
}

/// Whether Python can read the programs of the benchmarks, which need other people's programs to run.
fn programs(root: &Path, steps: &mut Steps) {
    if is_installed("python3") {
        steps.run("programs of the benchmarks", || {
            let arguments = ["-m", "compileall", "-q", "benchmarks"];
            succeed(Command::new("python3").current_dir(root).args(arguments))
        });
    } else {
        steps.skip("programs of the benchmarks", "python3 is not installed");
    }
}

fn is_installed(program: &str) -> bool {
    let answer = Command::new(program).arg("--version").output();
    answer.is_ok_and(|output| output.status.success())
}

/// Known vulnerabilities, where cargo-deny is installed.
fn advisories(root: &Path, steps: &mut Steps) {
    if is_installed("cargo-deny") {
        steps.run("advisories", || {
            succeed(&mut cargo(root, &["deny", "check", "advisories"]))
        });
    } else {
        steps.skip("advisories", "cargo-deny is not installed");
    }
}
