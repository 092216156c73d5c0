//! Every case of the tables against its closed form: scene in, readings with error bars out.
//!
//! The tables hold reference cases of irradiance and of closed environments, the analytic cases of CIE 171:2006 and cases
//! in their spirit. Run with `--nocapture` to see the table of readings and the list of cases that are skipped.

use std::sync::LazyLock;

use steradian_tests::Certainty;
use steradian_tests::cases::{Case, Outcome, SKIPS, experiments, skip_of, tables};

static CASES: LazyLock<Vec<Case>> = LazyLock::new(tables);

/// All readings of all cases that are run.
static OUTCOMES: LazyLock<Vec<Outcome>> =
    LazyLock::new(|| run_cases().flat_map(outcomes_of).collect());

fn run_cases() -> impl Iterator<Item = &'static Case> {
    CASES.iter().filter(|case| skip_of(&case.id).is_none())
}

fn outcomes_of(case: &Case) -> Vec<Outcome> {
    let experiments = experiments(case).unwrap_or_else(|| panic!("{} has no scene", case.id));
    experiments
        .iter()
        .flat_map(|experiment| experiment.run(case))
        .collect()
}

/// |z| ≤ 4 of each reading: with some 250 readings and 63 degrees of freedom a false alarm has probability 4 %, once for
/// this seed.
#[test]
fn every_reading_agrees_with_its_closed_form() {
    for outcome in OUTCOMES.iter() {
        println!("{}", outcome.row());
    }
    let wrong: Vec<_> = OUTCOMES.iter().filter_map(Outcome::disagreement).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_standard_error_is_below_a_fifth_of_a_percent() {
    for outcome in OUTCOMES.iter() {
        let relative = outcome.estimate.std_error / outcome.expected.abs();
        assert!(
            outcome.expected == 0.0 || relative <= 0.002,
            "{}",
            outcome.row()
        );
    }
}

/// The mean of z² is 63/61 with a standard deviation of 1.5/√n, .1 for 229 readings: .7 and 1.4 are three of them away.
#[test]
fn error_bars_are_as_long_as_the_errors() {
    let scores: Vec<f64> = OUTCOMES
        .iter()
        .filter(|outcome| outcome.is_statistic())
        .map(|outcome| outcome.score() * outcome.score())
        .collect();
    let mean = scores.iter().sum::<f64>() / scores.len() as f64;
    println!("mean z² of {} sampled readings: {mean:.3}", scores.len());
    assert!(scores.len() >= 100, "{} are too few", scores.len());
    assert!((0.7..=1.4).contains(&mean), "mean z² is {mean}");
}

#[test]
fn every_number_of_every_case_is_read() {
    for case in run_cases() {
        let experiments = experiments(case).unwrap_or_else(|| panic!("{} has no scene", case.id));
        let mut read: Vec<_> = experiments
            .iter()
            .flat_map(|experiment| experiment.names())
            .collect();
        let mut expected: Vec<_> = case.expect.keys().map(String::as_str).collect();
        read.sort_unstable();
        expected.sort_unstable();
        assert_eq!(read, expected, "{}", case.id);
    }
}

#[test]
fn every_skip_is_listed_and_counted() {
    for skip in SKIPS {
        let count = CASES
            .iter()
            .filter(|case| case.id.starts_with(skip.prefix))
            .count();
        println!("skipped: {count} × {}: {}", skip.prefix, skip.reason);
        assert_eq!(count, skip.count, "cases of {}", skip.prefix);
    }
    let skipped: usize = SKIPS.iter().map(|skip| skip.count).sum();
    println!("{} cases run, {skipped} skipped", run_cases().count());
    assert_eq!(skipped + run_cases().count(), CASES.len());
}

#[test]
fn lights_without_extent_are_exact() {
    let exact = |kind: &str| {
        OUTCOMES
            .iter()
            .filter(move |outcome| outcome.what.contains(kind))
            .all(|outcome| steradian_tests::certainty(&outcome.estimate) == Certainty::ClosedForm)
    };
    assert!(exact("/point_light/") && exact("/several_point_lights/") && exact("/line_source/"));
}
