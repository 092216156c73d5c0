//! `energy`, against the table of what happens in time.

use serde_json::Value;
use steradian_tests::cases::{Case, TIME_SKIPS, time_table};
use steradian_tests::command::{Folder, steradian};

/// The integral that a command prints as JSON.
fn integral(arguments: &[&str]) -> Value {
    let arguments = [&["energy"], arguments, &["--format", "json"]].concat();
    let mut object: Value = serde_json::from_str(&steradian(&arguments).fine()).unwrap();
    object["integrals"][0].take()
}

fn number(object: &Value, path: &str) -> f64 {
    let found = object.pointer(path).and_then(Value::as_f64);
    found.unwrap_or_else(|| panic!("no {path} in {object}"))
}

/// The record of a case as a file.
fn record(folder: &Folder, case: &Case) -> String {
    let rows = case
        .numbers("time_s")
        .into_iter()
        .zip(case.numbers("flux_W"));
    let rows: String = rows
        .map(|(time, flux)| format!("{time:?},{flux:?}\n"))
        .collect();
    folder.write("record.csv", &format!("time (s),flux (W)\n{rows}"))
}

fn with_unit(case: &Case, key: &str, unit: &str) -> String {
    format!("{:?}{unit}", case.number(key))
}

/// The kinds of cases that `energy` answers.
const ANSWERED: [&str; 5] = [
    "piecewise_linear_flux",
    "step_flux",
    "sinusoidal_flux",
    "exponential_decay",
    "photon_count",
];

/// What a command says to each number that a case expects; none for a kind that another test runs, or that is skipped.
fn answers(case: &Case) -> Option<Vec<(&'static str, f64)>> {
    let folder = Folder::new();
    let text = |key: &str, unit: &str| with_unit(case, key, unit);
    Some(match case.kind() {
        "piecewise_linear_flux" => {
            let found = integral(&[&record(&folder, case)]);
            vec![
                ("energy_J", number(&found, "/value")),
                ("mean_W", number(&found, "/mean/value")),
            ]
        }
        "step_flux" => {
            let found = integral(&[&record(&folder, case), "--rule", "held"]);
            vec![("energy_J", number(&found, "/value"))]
        }
        "sinusoidal_flux" => {
            let found = integral(&[
                "--sinusoid",
                &format!("offset={}", text("offset", "W")),
                &format!("amplitude={}", text("amplitude", "W")),
                &format!("omega={}", text("omega", "rad/s")),
                &format!("phase={}", text("phase", "rad")),
                "--duration",
                &text("duration_s", "s"),
            ]);
            vec![("energy_J", number(&found, "/value"))]
        }
        "exponential_decay" => {
            let found = integral(&[
                "--exponential",
                &format!("initial={}", text("P0", "W")),
                &format!("tau={}", text("tau_s", "s")),
                "--duration",
                &text("duration_s", "s"),
            ]);
            vec![
                ("energy_J", number(&found, "/value")),
                ("total_J", number(&found, "/eventually/value")),
            ]
        }
        "photon_count" => {
            let found = integral(&[
                "--constant",
                &text("power_W", "W"),
                "--duration",
                &text("duration_s", "s"),
                "--wavelength",
                &text("wavelength_nm", "nm"),
            ]);
            vec![("photons", number(&found, "/photons/value"))]
        }
        _ => return None,
    })
}

/// The cases that `energy` answers: all but the doses, which are measured in a scene, and those that are skipped.
#[test]
fn records_and_formulas_agree_with_the_table() {
    let mut worst = 0.0_f64;
    let mut count = 0;
    for case in time_table() {
        let Some(answers) = answers(&case) else {
            assert!(!ANSWERED.contains(&case.kind()), "{}", case.id);
            continue;
        };
        assert_eq!(answers.len(), case.expect.len(), "{}", case.id);
        for (name, found) in answers {
            let error = (found / case.expected(name) - 1.0).abs();
            println!("{} {name}: {found:?} ({error:.1e})", case.id);
            (worst, count) = (worst.max(error), count + 1);
        }
    }
    println!("{count} numbers, the worst off by {worst:.1e}");
    // The reference is good to 1e-12.
    assert!(count == 15 && worst <= 1e-12, "{count}: {worst:e}");
}

#[test]
fn every_skip_in_time_is_listed_and_counted() {
    let cases = time_table();
    let mut skipped = 0;
    for skip in TIME_SKIPS {
        let matching = cases.iter().filter(|case| case.id.starts_with(skip.prefix));
        assert_eq!(
            matching.count(),
            skip.count,
            "{}: {}",
            skip.prefix,
            skip.reason
        );
        skipped += skip.count;
    }
    let answered = cases
        .iter()
        .filter(|case| ANSWERED.contains(&case.kind()))
        .count();
    let doses = cases
        .iter()
        .filter(|case| case.kind() == "sensor_dose_duty_cycle");
    assert_eq!(skipped + answered + doses.count(), cases.len());
}

#[test]
fn a_meter_becomes_mean_fluxes_that_add_up_to_what_it_counted() {
    let folder = Folder::new();
    let meter = folder.write("meter.csv", "time (h),meter (kWh)\n0,2\n1,2.1\n2,2.4\n");
    let found = integral(&[&meter, "--derivative", "--unit", "kWh"]);
    let close = |path: &str, expected: f64| {
        let error = (number(&found, path) / expected - 1.0).abs();
        // Readings of 2.4 kWh are known to ε × 2.4, their differences to 5 ε of themselves.
        assert!(error <= 50.0 * f64::EPSILON, "{path}: {error:e}");
    };
    close("/rates/0/value", 100.0);
    close("/rates/1/value", 300.0);
    close("/value", 0.4);
    close("/mean/value", 200.0);
    assert_eq!(found["rates"][1]["from"], 3600.0);
    let half = integral(&[&meter, "--derivative", "--from", "30min", "--to", "90min"]);
    assert!((number(&half, "/value") / 720e3 - 1.0).abs() < 1e-13);
    let text = steradian(&["energy", &meter, "--derivative"]).fine();
    assert!(
        text.contains("meter, between its readings:") && text.contains("mean flux (W)"),
        "{text}"
    );
    let told = steradian(&["energy", &meter]).error();
    assert!(
        told.contains("--derivative gives the mean fluxes"),
        "{told}"
    );
}

#[test]
fn several_columns_keep_their_quantities_and_units() {
    let folder = Folder::new();
    let path = folder.write(
        "day.csv",
        "time (h),lamp (W),desk (lx)\n0,10,500\n8,10,500\n",
    );
    let text = steradian(&["energy", &path]).fine();
    for part in [
        "lamp",
        "288000 J",
        "desk",
        "luminous exposure",
        "14400000 lx s",
        "500 lx",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

#[test]
fn mistakes_are_told_with_their_place() {
    let folder = Folder::new();
    let path = folder.write("bad.csv", "time (s),flux (W)\n0,1\n0,x\n");
    let text = steradian(&["energy", &path]).error();
    for part in [
        "bad.csv:3:1",
        "times must increase",
        "bad.csv:3:3",
        "number in W",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let good = folder.write("good.csv", "time (s),flux (W)\n0,1\n9,1\n");
    for (arguments, expected) in [
        (
            vec!["energy", &good, "--to", "10s"],
            "the record goes from 0 s to 9 s",
        ),
        (vec!["energy", &good, "--unit", "lx h"], "no unit of energy"),
        (
            vec!["energy", &good, "--derivative"],
            "leave out --derivative",
        ),
        (
            vec!["energy", "--constant", "5", "--duration", "1s"],
            "no unit",
        ),
        (vec!["energy", "--constant", "5W"], "give --duration"),
        (
            vec![
                "energy",
                "--constant",
                "5lm",
                "--duration",
                "1s",
                "--wavelength",
                "1um",
            ],
            "photons",
        ),
        (
            vec!["energy", "--duty", "on=1W", "period=1h", "--duration", "1s"],
            "`duty` is missing",
        ),
        (
            vec![
                "energy",
                "--duty",
                "on=1W",
                "period=1h",
                "duty=2",
                "--duration",
                "1s",
            ],
            "from 0 to 1",
        ),
        (
            vec![
                "energy",
                "--exponential",
                "initial=1W",
                "tau=2",
                "--duration",
                "1s",
            ],
            "no unit",
        ),
        (
            vec!["energy", "--constant", "5W", "--duration=-1s"],
            "ends after it begins",
        ),
    ] {
        let text = steradian(&arguments).error();
        assert!(text.contains(expected), "{expected} is not in\n{text}");
    }
}
