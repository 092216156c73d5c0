//! `steradian verify`: closed forms, and scenes with closed-form answers, through the same reader and estimator as any other scene.

mod formulas;
mod suite;

use std::path::Path;

use clap::Args;
use serde_json::json;
use steradian::estimation::{Estimate, Method, Plan, Stopping};
use steradian::measurement::Reading;
use steradian::transport::{MeasureOptions, measure};
use steradian_io::files::MemoryFiles;
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{exact, with_half_width};
use steradian_io::scene_file::read_scene_str;

use crate::engine::Threads;
use crate::load;
use crate::output::{self, Format};
use crate::progress::Watch;
use crate::result::VERSION;
use crate::status::{Failure, Outcome};
use crate::values;
use formulas::Formula;
use suite::{Answer, SUITE, Verified};

/// Deviation in standard errors that a sampled value may show; one correct value in about a thousand shows more.
const MOST_STANDARD_ERRORS: f64 = 4.0;
/// Relative deviation that rounding alone may cause in a value by closed form, which is computed in double precision.
const DOUBLE_ROUNDING: f64 = 1e-9;
/// Relative standard deviation that rounding adds to a sampled value, whose paths are followed in single precision.
const SINGLE_ROUNDING: f64 = 2e-7;

/// Check this program on formulas and scenes whose answers are known in closed form
///
/// Solid angles, form factors and energies are computed and set beside numbers found otherwise. The scenes are part of the program. Each is read and measured like any other; the table shows the value that theory
/// gives, the value measured with its standard error, and their distance z in standard errors. A sampled value passes
/// with |z| < 4, which a correct one fails once in about a thousand; a value by closed form passes when it agrees to
/// rounding, and its relative deviation stands in place of z.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Stop each reading when its 95 % interval is within this part of the value
    #[arg(long, value_name = "RATIO", value_parser = values::ratio, default_value = "1%")]
    rel_error: f64,
    /// Seed of all random numbers
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    threads: Threads,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian verify
  steradian verify --rel-error 0.1% --seed 7
  steradian verify --format json";

/// One answer with what was found.
struct Check {
    name: String,
    quantity: &'static str,
    unit: String,
    expected: f64,
    found: Estimate,
}

/// Measures every scene and compares.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut watch = Watch::new()?;
    let mut checks: Vec<Check> = formulas::all()?.into_iter().map(Check::from).collect();
    for verified in SUITE {
        checks.extend(measured(verified, arguments, &mut watch)?);
    }
    if watch.finish() {
        return Err(Failure::message("stopped by Ctrl-C"));
    }
    output::print(&match arguments.format {
        Format::Table => table(&checks),
        Format::Json => json(&checks, arguments),
    })?;
    Ok(Outcome::fine_if(checks.iter().all(Check::passes)))
}

fn measured(
    verified: &'static Verified,
    arguments: &Arguments,
    watch: &mut Watch,
) -> Result<Vec<Check>, Failure> {
    let read = read_scene_str(verified.file, verified.text, &MemoryFiles::default())
        .map_err(Failure::Input)?;
    let scene = load::validated(read)?.scene;
    let plan = Plan {
        seed: arguments.seed,
        stop: Stopping::at_rel_error(arguments.rel_error),
        threads: arguments.threads.count(),
        ..Plan::default()
    };
    let options = MeasureOptions {
        plan,
        ..MeasureOptions::default()
    };
    let readings = measure(&scene, &options, watch)?.readings();
    verified
        .answers
        .iter()
        .map(|answer| Check::new(verified, answer, &readings))
        .collect()
}

impl Check {
    fn new(
        verified: &Verified,
        answer: &'static Answer,
        readings: &[Reading],
    ) -> Result<Self, Failure> {
        let scene = Path::new(verified.file)
            .file_stem()
            .and_then(|name| name.to_str())
            .unwrap_or(verified.file);
        let name = match answer.group {
            Some(group) => format!("{scene}: {} {} from {group}", answer.sensor, answer.index),
            None => format!("{scene}: {} {}", answer.sensor, answer.index),
        };
        let (unit, found) = answer
            .find(readings)
            .ok_or_else(|| Failure::message(format!("{name}: there is no such reading")))?;
        Ok(Self {
            name,
            quantity: answer.quantity,
            unit,
            expected: answer.value,
            found,
        })
    }

    /// Part of the answer by which the value differs from it.
    fn deviation(&self) -> f64 {
        (self.found.value - self.expected).abs() / self.expected.abs()
    }

    /// Distance from the answer in standard errors, that of rounding included; none for a value by closed form.
    fn distance(&self) -> Option<f64> {
        let rounding = SINGLE_ROUNDING * self.expected.abs();
        let error = (self.found.std_error.powi(2) + rounding.powi(2)).sqrt();
        let sampled = self.found.method == Method::Estimate;
        sampled.then(|| (self.found.value - self.expected) / error)
    }

    fn value(&self) -> String {
        match self.found.method {
            Method::ClosedForm => exact(self.found.value),
            Method::Estimate => with_half_width(self.found.value, self.found.std_error),
        }
    }

    fn passes(&self) -> bool {
        match self.distance() {
            Some(z) => z.abs() < MOST_STANDARD_ERRORS && self.found.converged,
            None => self.deviation() <= DOUBLE_ROUNDING,
        }
    }
}

impl From<Formula> for Check {
    fn from(formula: Formula) -> Self {
        Self {
            name: formula.name.to_owned(),
            quantity: formula.quantity,
            unit: formula.unit.to_owned(),
            expected: formula.expected,
            found: Estimate::closed_form(formula.found),
        }
    }
}

fn table(checks: &[Check]) -> String {
    let headings = [
        "scene: reading",
        "quantity",
        "expected",
        "found ± standard error",
        "z or deviation",
        "",
    ];
    let mut columns = Columns::new(headings).right_aligned(4);
    for check in checks {
        columns.row([
            check.name.clone(),
            format!("{} ({})", check.quantity, check.unit),
            exact(check.expected),
            check.value(),
            check.distance().map_or_else(
                || format!("{:.1e}", check.deviation()),
                |z| format!("{z:.2}"),
            ),
            if check.passes() { "ok" } else { "FAILED" }.to_owned(),
        ]);
    }
    let passed = checks.iter().filter(|check| check.passes()).count();
    format!(
        "{columns}\n{passed} of {} agree with their closed forms.\n",
        checks.len()
    )
}

fn json(checks: &[Check], arguments: &Arguments) -> String {
    let check = |check: &Check| {
        json!({
            "name": check.name,
            "quantity": check.quantity,
            "unit": check.unit,
            "expected": check.expected,
            "value": check.found.value,
            "std_error": check.found.std_error,
            "method": check.found.method,
            "z": check.distance(),
            "deviation": check.deviation(),
            "ok": check.passes(),
        })
    };
    let all = checks.iter().all(Check::passes);
    let checks: Vec<_> = checks.iter().map(check).collect();
    let object = json!({
        "schema": "steradian.verify/1",
        "version": VERSION,
        "seed": arguments.seed,
        "ok": all,
        "checks": checks,
    });
    format!("{object:#}\n")
}
