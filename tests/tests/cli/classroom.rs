//! The example of a lighting study: its commands print what its README says, but for the noise of sampling.

use std::fs;
use std::path::Path;

use steradian_course::commands;
use steradian_tests::command::{Folder, root, steradian_in};

/// Other samples than those of the README may move a value by this part of it; its error bars are below a fifth of that.
const TOLERANCE: f64 = 0.1;
/// With 16 replicates an error bar is itself known to within a factor of two, but once in 10 000 times.
const ERROR_FACTOR: f64 = 2.5;

/// Whether the lines are there, in order; `…` stands for others between them.
fn agrees(shown: &[&str], output: &str) -> bool {
    let mut lines = output.lines();
    let mut wanted = shown.iter().filter(|line| !["", "…"].contains(line));
    wanted.all(|line| lines.any(|found| line_agrees(line, found)))
}

fn line_agrees(shown: &str, found: &str) -> bool {
    let [shown, found] = [shown, found].map(|line| line.split_whitespace().collect::<Vec<_>>());
    let before = [""].iter().chain(&shown);
    let mut words = shown.iter().zip(&found).zip(before);
    shown.len() == found.len()
        && words.all(|((shown, found), before)| word_agrees(shown, found, *before == "±"))
}

fn word_agrees(shown: &str, found: &str, is_error: bool) -> bool {
    if shown == found || shown == "…" {
        return true;
    }
    let [Ok(shown), Ok(found)] = [shown, found].map(|word| {
        let number = word.trim_matches(['(', ')', ',']);
        number.parse::<f64>()
    }) else {
        return false;
    };
    match is_error {
        true => found < shown * ERROR_FACTOR && shown < found * ERROR_FACTOR,
        false => (found - shown).abs() <= TOLERANCE * shown.abs(),
    }
}

#[test]
fn every_command_prints_what_the_readme_says() {
    let example = root().join("examples/classroom");
    let folder = Folder::new();
    for file in ["classroom.toml", "luminaire.ldt"] {
        fs::copy(example.join(file), folder.path(file)).unwrap();
    }
    let readme = fs::read_to_string(example.join("README.md")).unwrap();
    for command in commands(&readme) {
        let words = command.words();
        let arguments: Vec<&str> = words[1..].iter().map(String::as_str).collect();
        let ran = steradian_in(Path::new(&folder.path("")), &arguments);
        let (found, errors) = (ran.stdout(), ran.stderr());
        let shown = command.printed.join("\n");
        assert!(
            ran.status() < 2 && agrees(&command.printed, &found),
            "{}\n--- shown\n{shown}\n--- found\n{found}{errors}",
            command.line
        );
    }
    assert!(commands(&readme).count() >= 6);
}

#[test]
fn numbers_may_differ_by_noise_and_words_not_at_all() {
    let line = "desks illuminance 500 ± 4 lx 0.7";
    for (found, expected) in [
        (line, true),
        ("desks  illuminance  520 ± 6.1 lx  0.71", true),
        ("desks illuminance 560 ± 4 lx 0.7", false),
        ("desks illuminance 500 ± 40 lx 0.7", false),
        ("board illuminance 500 ± 4 lx 0.7", false),
        ("desks illuminance 500 ± 4 lx", false),
    ] {
        assert_eq!(line_agrees(line, found), expected, "{found}");
    }
    assert!(agrees(&["a", "…", "c"], "a\nb\nc\n"));
    assert!(!agrees(&["c", "a"], "a\nb\nc\n"));
}
