//! `steradian brdf check`: whether models keep their contract.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use steradian::brdf::check::{self, Effort, Finding, FurnaceRow, Place};
use steradian::geometry::{Direction, Spherical};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::significant;

use super::corners::{self, Furnace};
use super::model::{self, Model, Settings};
use crate::engine::Threads;
use crate::output::{self, Format};
use crate::status::{Failure, Outcome};

/// Whether models keep reciprocity and energy, and whether their samples have the density they claim
///
/// Looked at from 0, 30, 60, 80 and 88° to the normal, on both sides where light goes through, and every three degrees for energy:
///
///   values       no number is negative, infinite or NaN, on the horizon neither
///   reciprocity  ρ(a, b)/n_a² = ρ(b, a)/n_b²: relative difference
///   energy       albedo + transmittance ≤ 1, in every lane
///   agreement    a sample tells the value and density that evaluate and pdf give for it
///   density      ∫ pdf dω ≤ 1
///   sampling     χ² of samples against ∫ pdf dω in cells that follow the lobes, as standard deviations
///   mean weight  E[ρ cosθ/pdf] = albedo, and = transmittance: difference over what chance and the method allow
///   furnace      albedo + transmittance = 1 within .2 % of the model set to lose nothing, over roughness and angle
///
/// A model that is right fails a check by chance with a probability below 1e-6; the same seed gives the same answer. Without a model, every model is
/// checked at the ends of its parameters' ranges. Exit status 1 when a check fails.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// A model such as rough-conductor, or a file of measured data; all models if there is none
    #[arg(value_name = "MODEL|FILE")]
    model: Option<String>,
    #[command(flatten)]
    settings: Settings,
    /// How long to look: quick sees differences of some per cent, full of some tenths of a per cent. Default: full for one model, else quick
    #[arg(long, value_enum)]
    effort: Option<EffortName>,
    /// Seed of the samples
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    threads: Threads,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// How long to look.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum EffortName {
    /// 4096 samples a view
    Quick,
    /// 65536 samples a view
    Full,
}

const EXAMPLES: &str = "\
Examples:
  steradian brdf check rough-conductor --set metal=gold --set alpha=0.3
  steradian brdf check rough-dielectric --set ior=1.5 --set alpha=0.1 --format json
  steradian brdf check";

/// What was found of one model.
struct Report {
    title: String,
    lanes: Vec<String>,
    findings: Vec<Finding>,
    furnace: Vec<FurnaceRow>,
}

/// Prints what was found.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let effort = Effort {
        seed: arguments.seed,
        ..effort(arguments)
    };
    let reports = match &arguments.model {
        Some(name) => vec![of_model(name, &arguments.settings, &effort)?],
        None if arguments.settings.set.is_empty() => of_all(arguments, &effort)?,
        None => return Err(Failure::message("--set goes with a model")),
    };
    let is_single = arguments.model.is_some();
    output::print(&match arguments.format {
        Format::Json => json(&reports),
        Format::Table if is_single => reports.iter().map(table).collect(),
        Format::Table => overview(&reports),
    })?;
    Ok(Outcome::fine_if(reports.iter().all(Report::passed)))
}

fn effort(arguments: &Arguments) -> Effort {
    let asked = arguments.effort.unwrap_or(match arguments.model {
        Some(_) => EffortName::Full,
        None => EffortName::Quick,
    });
    match asked {
        EffortName::Quick => Effort::QUICK,
        EffortName::Full => Effort::FULL,
    }
}

impl Report {
    fn passed(&self) -> bool {
        self.findings.iter().all(Finding::passed)
    }
}

/// The checks of one model, with its furnace if it can be set to lose nothing.
fn of_model(name: &str, settings: &Settings, effort: &Effort) -> Result<Report, Failure> {
    let model = model::read(name, settings)?;
    let mut report = checked(&model, effort);
    if let Some(furnace) = corners::furnace(name, settings) {
        report.furnace = furnace_rows(name, &furnace, effort)?;
        report
            .findings
            .push(check::furnace_finding(&report.furnace));
    }
    Ok(report)
}

fn checked(model: &Model, effort: &Effort) -> Report {
    Report {
        title: model.title.clone(),
        lanes: model.lanes.clone(),
        findings: check::check(&model.brdf, effort),
        furnace: Vec::new(),
    }
}

fn furnace_rows(
    name: &str,
    furnace: &Furnace,
    effort: &Effort,
) -> Result<Vec<FurnaceRow>, Failure> {
    // A fifth of a per cent must be seen.
    let effort = Effort {
        samples: Effort::FULL.samples,
        ..*effort
    };
    let row = |&roughness: &f64| {
        let set = furnace.settings(roughness);
        let settings = Settings {
            set,
            wavelength: None,
        };
        let model = model::read(name, &settings)?;
        Ok(check::furnace(
            &model.brdf,
            model.lanes.len(),
            roughness,
            &effort,
        ))
    };
    furnace.roughnesses.iter().map(row).collect()
}

/// Every model at its corners, and the furnaces; corners are shared between threads and come back in order.
fn of_all(arguments: &Arguments, effort: &Effort) -> Result<Vec<Report>, Failure> {
    let corners = corners::all();
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..arguments.threads.count().max(1) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(corner) = corners.get(index) else {
                        break;
                    };
                    let report = corner_report(corner, arguments, effort);
                    if let Ok(mut done) = done.lock() {
                        done.push((index, report));
                    }
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, report)| report).collect()
}

fn corner_report(
    corner: &corners::Corner,
    arguments: &Arguments,
    effort: &Effort,
) -> Result<Report, Failure> {
    let settings = Settings {
        set: corner.settings.clone(),
        wavelength: arguments.settings.wavelength,
    };
    match &corner.furnace {
        None => Ok(checked(&model::read(&corner.model, &settings)?, effort)),
        Some(furnace) => {
            let rows = furnace_rows(&corner.model, furnace, effort)?;
            Ok(Report {
                title: furnace.title(&corner.model),
                lanes: Vec::new(),
                findings: vec![check::furnace_finding(&rows)],
                furnace: rows,
            })
        }
    }
}

fn table(report: &Report) -> String {
    let mut columns = Columns::new(["check", "worst", "bound", "", "where", "what"]);
    for finding in &report.findings {
        columns.row([
            finding.check.name().to_owned(),
            significant(finding.worst, 4),
            significant(finding.bound, 4),
            verdict(finding.passed()).to_owned(),
            finding
                .place
                .map_or_else(String::new, |place| told(&place, &report.lanes)),
            finding.check.measure().to_owned(),
        ]);
    }
    let furnace = if report.furnace.is_empty() {
        String::new()
    } else {
        format!(
            "\nWhite furnace, lossless: reflected and transmitted light by roughness and angle\n{}",
            furnace_table(&report.furnace)
        )
    };
    format!("{}\n{columns}{furnace}", report.title)
}

fn furnace_table(rows: &[FurnaceRow]) -> String {
    let angles = check::FURNACE_ANGLES.map(|degrees| format!("{degrees}°"));
    let headings = std::iter::once("roughness".to_owned()).chain(angles);
    let mut columns = Columns::new(headings.chain(["std. error".to_owned()]));
    for row in rows {
        let furthest = |[low, high]: [f64; 2]| {
            let share = if 1.0 - low > high - 1.0 { low } else { high };
            format!("{share:.5}")
        };
        let cells = std::iter::once(significant(row.roughness, 4)).chain(row.shares.map(furthest));
        columns.row(cells.chain([significant(row.std_error, 2)]));
    }
    columns.to_string()
}

/// A line a model: its worst values.
fn overview(reports: &[Report]) -> String {
    let mut columns = Columns::new(["model", "", "closest to its bound", "where"]);
    for report in reports {
        let ratio = |finding: &Finding| match finding.bound {
            0.0 => finding.worst,
            bound => finding.worst / bound,
        };
        let failed = report.findings.iter().filter(|finding| !finding.passed());
        let closest = report
            .findings
            .iter()
            .max_by(|a, b| ratio(a).total_cmp(&ratio(b)));
        let mut shown: Vec<&Finding> = failed.collect();
        if shown.is_empty() {
            shown.extend(closest);
        }
        for finding in shown {
            let worst = format!(
                "{} {} of {}",
                finding.check.name(),
                significant(finding.worst, 4),
                significant(finding.bound, 4)
            );
            let place = finding
                .place
                .map_or_else(String::new, |place| told(&place, &report.lanes));
            columns.row([
                report.title.clone(),
                verdict(finding.passed()).to_owned(),
                worst,
                place,
            ]);
        }
    }
    let failed = reports.iter().filter(|report| !report.passed()).count();
    format!("{columns}\n{} checked, {failed} failed\n", reports.len())
}

const fn verdict(passed: bool) -> &'static str {
    if passed { "ok" } else { "FAILED" }
}

fn told(place: &Place, lanes: &[String]) -> String {
    let mut words = vec![format!("θ_o {}", angles(place.wo))];
    words.extend(place.wi.map(|wi| format!("θ_i {}", angles(wi))));
    words.extend(place.lane.and_then(|lane| lanes.get(lane).cloned()));
    words.join(", ")
}

/// θ, and φ where it means anything.
fn angles(direction: Direction) -> String {
    let spherical = Spherical::from_direction(direction);
    let [theta, phi] =
        [spherical.theta, spherical.phi].map(|angle| significant(angle.to_degrees(), 4));
    format!("{theta}° φ {phi}°")
}

fn json(reports: &[Report]) -> String {
    let models: Vec<Value> = reports.iter().map(report_json).collect();
    let object = json!({
        "passed": reports.iter().all(Report::passed),
        "models": models,
    });
    format!("{object:#}\n")
}

fn report_json(report: &Report) -> Value {
    let finding = |finding: &Finding| {
        json!({
            "check": finding.check.name(),
            "measure": finding.check.measure(),
            "worst": finding.worst,
            "bound": finding.bound,
            "passed": finding.passed(),
            "wo": finding.place.map(|place| place.wo.to_array()),
            "wi": finding.place.and_then(|place| place.wi).map(Direction::to_array),
            "lane": finding.place.and_then(|place| report.lanes.get(place.lane?)),
        })
    };
    let row = |row: &FurnaceRow| {
        json!({
            "roughness": row.roughness,
            "angles_deg": check::FURNACE_ANGLES,
            "least": row.shares.map(|[low, _]| low),
            "most": row.shares.map(|[_, high]| high),
            "std_error": row.std_error,
        })
    };
    json!({
        "model": report.title,
        "passed": report.passed(),
        "checks": report.findings.iter().map(finding).collect::<Vec<_>>(),
        "furnace": report.furnace.iter().map(row).collect::<Vec<_>>(),
    })
}
