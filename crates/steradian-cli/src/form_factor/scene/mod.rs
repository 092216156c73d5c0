//! The matrix of a scene.

mod element;
mod exchange;
mod plot;
mod sink;
mod summary;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, ValueEnum};
use steradian::estimation::{Plan, Silent, Stopping};
use steradian::exchange::radiosity::{Surroundings, emitted};
use steradian::exchange::smoothing::{Smoothed, smooth};
use steradian::exchange::{
    Element, Facets, Grouping, Groups, MatrixOptions, MatrixSummary, Row, Sides, Technique, matrix,
};
use steradian::quantity::Temperature;
use steradian_io::report::form_factors::FactorReport;
use steradian_kernel::InstructionSet;

use crate::engine::Threads;
use crate::progress::Watch;
use crate::result::VERSION;
use crate::status::{Failure, Outcome, remark};
use crate::{load, output, values};
pub use sink::Format;
use sink::Sink;

/// Half-width of the 95 % interval relative to the factor, where no other rule is given.
const DEFAULT_REL_ERROR: f64 = 0.01;
/// Rays of a row where rays are chosen for the number of facets.
const DEFAULT_RAYS: u64 = 1 << 16;
/// From so many facets on `auto` takes rays: their cost grows as n, that of pairs as n².
const MOST_FOR_PAIRS: usize = 4000;
/// Rays of each facet that find out whether a scene is closed.
const RAYS_FOR_CLOSURE: u64 = 64;

/// What is asked of a scene.
#[derive(Args, Debug)]
#[command(next_help_heading = "Of a scene")]
pub struct SceneArguments {
    /// What a row of the matrix is
    #[arg(
        long,
        value_enum,
        value_name = "WHAT",
        default_value_t,
        requires = "scene"
    )]
    by: By,
    /// All factors: the default
    #[arg(long, requires = "scene", conflicts_with = "between")]
    matrix: bool,
    /// Only the factors between these two rows of the matrix, by their names; all others still stand in the way
    #[arg(long, num_args = 2, value_names = ["A", "B"], requires = "scene", conflicts_with = "exchange")]
    between: Option<Vec<String>>,
    /// Sides of surfaces that take part
    #[arg(
        long,
        value_enum,
        value_name = "SIDES",
        default_value_t,
        requires = "scene"
    )]
    sides: Side,
    /// Add the part of each surface's radiation that goes to the sky: its sky view factor
    #[arg(long, requires = "scene")]
    sky: bool,
    /// Solve the radiative exchange between grey surfaces and print it instead of the factors. The CSV file has a heading with `surface` and
    /// `temperature` (K), `exitance` (W/m2) or `net_flux` (W/m2, 0: insulated), of which each line has one, and perhaps `emissivity`
    /// (else 1 less the material's reflectance); `*` stands for all surfaces that no other line names
    #[arg(long, value_name = "BOUNDARY.csv", requires = "scene")]
    exchange: Option<PathBuf>,
    /// Temperature of what surrounds an open scene, for --exchange
    #[arg(
        long,
        value_name = "TEMPERATURE",
        default_value = "0 K",
        requires = "exchange"
    )]
    surroundings: Temperature,
    /// Change the sampled factors of a closed scene as little as their errors allow so that rows add up to 1 and A1 F12 = A2 F21 hold
    /// exactly, none below 0; how much was changed is printed
    #[arg(long, requires = "scene")]
    smooth: bool,
    /// Draw the matrix in colours, by the logarithm of the factors: FILE.svg, or FILE.png without the names
    #[arg(long, value_name = "FILE", requires = "scene")]
    plot: Option<PathBuf>,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE", requires = "scene")]
    output: Option<PathBuf>,
    #[command(flatten)]
    computation: Computation,
}

/// How factors are found and when to stop.
#[derive(Args, Debug)]
struct Computation {
    /// Pairs: closed forms where nothing stands between, and rays between the two elsewhere. Rays: all of a row from the same rays
    #[arg(
        long,
        value_enum,
        value_name = "METHOD",
        default_value_t,
        requires = "scene"
    )]
    method: Method,
    /// Take this many samples for a pair or a row, whatever the error
    #[arg(long, value_name = "NUMBER", value_parser = values::count, conflicts_with = "rel_error", requires = "scene")]
    samples: Option<u64>,
    /// Seed of all random numbers: the same seed gives the same bits
    #[arg(long, value_name = "NUMBER", default_value_t = 0, requires = "scene")]
    seed: u64,
    #[command(flatten)]
    threads: Threads,
}

/// Groupings by name.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum By {
    /// Each plane polygon, disc and sphere
    #[default]
    Face,
    /// Each shape
    Object,
    /// Each material
    Material,
}

/// Sides by name.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum Side {
    /// The sides that normals point to
    #[default]
    Front,
    /// The other sides
    Back,
    /// Both, each for itself
    Both,
}

/// Techniques by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Method {
    /// Pairs, or rays for more than 4000 facets unless --rel-error is given
    #[default]
    Auto,
    /// Pair by pair
    Pairs,
    /// Whole rows
    Rays,
}

impl Computation {
    fn technique(&self, facets: usize, rel_error: Option<f64>) -> Technique {
        let is_large = facets > MOST_FOR_PAIRS && rel_error.is_none();
        match self.method {
            Method::Rays => Technique::Rays,
            Method::Auto if is_large => Technique::Rays,
            Method::Auto | Method::Pairs => Technique::Pairs,
        }
    }

    fn plan(&self, technique: Technique, rel_error: Option<f64>) -> Plan {
        let stop = match (self.samples, rel_error, technique) {
            (Some(samples), _, _) => Stopping::at_samples(samples),
            (None, Some(ratio), _) => Stopping::at_rel_error(ratio),
            (None, None, Technique::Rays) => Stopping::at_samples(DEFAULT_RAYS),
            (None, None, _) => Stopping::at_rel_error(DEFAULT_REL_ERROR),
        };
        Plan {
            seed: self.seed,
            stop,
            threads: self.threads.count(),
            max_samples: 1 << 26,
            ..Plan::default()
        }
    }
}

/// Finds the matrix and writes it.
pub fn run(
    scene: &Path,
    arguments: &SceneArguments,
    element: Option<Element>,
    rel_error: Option<f64>,
    format: Option<Format>,
) -> Result<Outcome, Failure> {
    let loaded = load::surfaces(scene)?;
    let facets = Facets::new(&loaded.scene, arguments.sides.into())?;
    let (facets, groups) = taking_part(facets, arguments)?;
    if let Some(element) = element {
        let plan = arguments.computation.plan(Technique::Pairs, rel_error);
        return element::run(&facets, &groups, element, &plan, arguments, format);
    }
    let technique = arguments.computation.technique(facets.count(), rel_error);
    let options = MatrixOptions {
        technique,
        rest: arguments.sky,
        instruction_set: InstructionSet::detect(),
    };
    let task = Task {
        plan: arguments.computation.plan(technique, rel_error),
        facets: &facets,
        groups: &groups,
        options,
    };
    let report = FactorReport {
        names: groups.names().to_vec(),
        areas: groups.areas().to_vec(),
        scene_hash: loaded.hash,
        seed: task.plan.seed,
        version: VERSION.to_owned(),
        confidence: task.plan.confidence,
    };
    let format = Format::of(format, arguments.output.as_deref())?;
    task.run(arguments, &report, format)
}

/// The facets that take part, and their groups: all, or two.
fn taking_part<'a>(
    facets: Facets<'a>,
    arguments: &SceneArguments,
) -> Result<(Facets<'a>, Groups), Failure> {
    let groups = Groups::new(&facets, arguments.by.into());
    let Some(names) = &arguments.between else {
        return Ok((facets, groups));
    };
    let number = |wanted: &String| {
        let found = groups.names().iter().position(|name| name == wanted);
        found.ok_or_else(|| Failure::message(unknown(wanted, groups.names())))
    };
    let wanted: Vec<usize> = names.iter().map(number).collect::<Result<_, _>>()?;
    let facets = facets.only(|facet| wanted.contains(&(groups.of_facet()[facet] as usize)))?;
    let groups = Groups::new(&facets, arguments.by.into());
    Ok((facets, groups))
}

/// Most names that a message lists.
const MOST_NAMES: usize = 12;

fn unknown(wanted: &str, names: &[String]) -> String {
    let listed: Vec<&str> = names.iter().take(MOST_NAMES).map(String::as_str).collect();
    let more = match names.len().saturating_sub(MOST_NAMES) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!(
        "no surface is called `{wanted}`; there are {}{more}",
        listed.join(", ")
    )
}

/// What is to be computed.
struct Task<'a> {
    facets: &'a Facets<'a>,
    groups: &'a Groups,
    options: MatrixOptions,
    plan: Plan,
}

impl Task<'_> {
    fn run(
        &self,
        arguments: &SceneArguments,
        report: &FactorReport,
        format: Format,
    ) -> Result<Outcome, Failure> {
        let boundaries = match &arguments.exchange {
            Some(_) if format == Format::Npz => {
                return Err(Failure::message(
                    "--exchange is printed as table, json or csv",
                ));
            }
            Some(file) => Some(exchange::surfaces(file, self.facets, self.groups)?),
            None => None,
        };
        let keep = boundaries.is_some() || arguments.plot.is_some() || arguments.smooth;
        let silent = boundaries.is_some();
        let mut sink = Sink::new(format, report, arguments.output.as_deref(), silent)?;
        let mut rows = Vec::new();
        let begin = Instant::now();
        let mut watch = Watch::new()?;
        let mut take = |row: Row| {
            if keep {
                rows.push(row.clone());
            }
            if !arguments.smooth {
                sink.take(row);
            }
        };
        let mut summary = matrix(
            self.facets,
            self.groups,
            &self.options,
            &self.plan,
            &mut watch,
            &mut take,
        )?;
        if arguments.between.is_some() {
            summary.closure = None;
        }
        let interrupted = watch.finish();
        let closed = self.is_closed()?;
        let smoothed = match arguments.smooth {
            true => Some(self.smooth(&mut rows, closed && summary.complete)?),
            false => None,
        };
        if smoothed.is_some() {
            rows.iter().cloned().for_each(|row| sink.take(row));
        }
        sink.finish(&summary)?;
        if let Some(smoothed) = &smoothed {
            remark(&summary::of_smoothing(smoothed));
        }
        if let Some(file) = &arguments.plot {
            output::write(&plot::drawing(&rows, report, file)?, Some(file))?;
        }
        if let Some(surfaces) = &boundaries {
            let around = Surroundings {
                exitance: (!closed).then(|| emitted(1.0, arguments.surroundings.to_kelvin())),
                reciprocal: arguments.smooth || self.options.technique == Technique::Pairs,
            };
            let found = exchange::solve(&rows, self.groups, surfaces, around)?;
            let text = exchange::text(&found, report, format);
            output::write(text.as_bytes(), arguments.output.as_deref())?;
        } else if format == Format::Table {
            output::print(&summary::text(
                &summary,
                report,
                self.facets.count(),
                closed,
            ))?;
        }
        remark(&format!("{:.1} s", begin.elapsed().as_secs_f64()));
        Ok(outcome(&summary, closed, interrupted))
    }

    fn smooth(&self, rows: &mut [Row], is_enclosure: bool) -> Result<Smoothed, Failure> {
        if !is_enclosure {
            let message =
                "--smooth needs a complete matrix of a closed scene, for it makes rows add up to 1";
            return Err(Failure::message(message));
        }
        Ok(smooth(rows, self.groups.areas()))
    }

    /// Whether no ray of a few from each facet leaves the scene or meets what is no facet.
    fn is_closed(&self) -> Result<bool, Failure> {
        let whole = Groups::new(self.facets, Grouping::Material);
        let options = MatrixOptions {
            technique: Technique::Rays,
            ..self.options
        };
        let stop = Stopping::at_samples(RAYS_FOR_CLOSURE);
        let plan = Plan {
            stop,
            ..self.plan.clone()
        };
        let mut closed = true;
        matrix(
            self.facets,
            &whole,
            &options,
            &plan,
            &mut Silent,
            &mut |row| {
                let escaped = row.rest.map_or(0.0, |rest| {
                    rest.sky.value + rest.below.value + rest.other.value
                });
                closed &= escaped == 0.0;
            },
        )?;
        Ok(closed)
    }
}

/// Fine if all is there, as precise as asked, and sums that should be 1 are, but for chance.
fn outcome(summary: &MatrixSummary, closed: bool, interrupted: bool) -> Outcome {
    let met = summary.complete && summary.missed == 0 && !interrupted;
    let explained = summary.closure.is_none_or(|worst| {
        let may_be_less = !closed && worst.difference.value < 0.0;
        may_be_less || worst.is_explained(summary.rows)
    });
    let reciprocal = summary
        .reciprocity
        .is_none_or(|worst| worst.is_explained(summary.rows * summary.rows));
    Outcome::fine_if(met && explained && reciprocal)
}

impl From<By> for Grouping {
    fn from(by: By) -> Self {
        match by {
            By::Face => Self::Face,
            By::Object => Self::Object,
            By::Material => Self::Material,
        }
    }
}

impl From<Side> for Sides {
    fn from(side: Side) -> Self {
        match side {
            Side::Front => Self::Front,
            Side::Back => Self::Back,
            Side::Both => Self::Both,
        }
    }
}
