//! The matrix in one pass: rows are jobs of the estimation's threads and come out in order.

use std::time::Duration;

use steradian_kernel::InstructionSet;

use super::assembly::Assembly;
use super::effort::{Found, Rule};
use super::facets::Facets;
use super::grouping::Groups;
use super::pairs::{PairCaster, PairWorkspace};
use super::rays::{RayCaster, RayWorkspace, Source, Traced};
use super::row::{Entry, Row};
use super::uncertain::Uncertain;
use crate::estimation::crew::{Crew, Worker};
use crate::estimation::{EstimationError, Observer, Plan};
use crate::sampling::hash::{combine, key_of_name};

/// How factors are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Technique {
    /// Pair by pair: exactly where nothing stands between, else by rays between the two. Reciprocity is exact, and small factors are
    /// known as well as large ones. The cost grows as n². Spheres and discs get rows by rays.
    Pairs,
    /// Whole rows by rays. Closure is exact, and the error of a factor is that of counting: with N rays about √(F/N).
    Rays,
}

/// What is asked of [`matrix`] beside the plan.
#[derive(Clone, Copy, Debug)]
pub struct MatrixOptions {
    /// How factors are found.
    pub technique: Technique,
    /// Whether rows of pairs come with [`Rest`](super::Rest) too, for which rays are sent.
    pub rest: bool,
    /// Instruction set of the ray queries; has no influence on the result.
    pub instruction_set: InstructionSet,
}

/// Why there is no matrix.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExchangeError {
    /// Nothing of finite area.
    #[error("the scene has no surface of finite area")]
    NoSurface,
    /// The plan asks for what a matrix does not have.
    #[error("{0}")]
    Plan(&'static str),
    /// The threads or the plan failed.
    #[error(transparent)]
    Estimation(#[from] EstimationError),
}

/// How it went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MatrixSummary {
    /// Rows that were handed out.
    pub rows: usize,
    /// Rows that missed the tolerance.
    pub missed: usize,
    /// Factors that are not 0 and were found by a formula.
    pub closed_forms: u64,
    /// Sampled factors.
    pub estimates: u64,
    /// Sampled factors of which no sample was seen: their standard error is all that is known of them.
    pub unseen: u64,
    /// Rays.
    pub samples: u64,
    /// Whether every row is there.
    pub complete: bool,
    /// The row whose sum is farthest from 1.
    pub closure: Option<Residual>,
    /// The pair whose A_i F_ij and A_j F_ji are farthest apart, where the two were found independently.
    pub reciprocity: Option<Residual>,
}

/// How far something is from what it should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The surfaces it is about, the same twice for a row.
    pub surfaces: [usize; 2],
    /// The difference.
    pub difference: Uncertain,
    /// The difference in standard errors.
    pub deviation: f64,
}

impl Residual {
    /// Rounding of closed forms and of the geometry in f32, which no standard error covers.
    pub const ROUNDING: f64 = 1e-6;

    pub(super) fn new(surfaces: [usize; 2], difference: Uncertain) -> Self {
        let deviation = difference.deviation(0.0, Self::ROUNDING);
        Self {
            surfaces,
            difference,
            deviation,
        }
    }

    /// Whether chance explains it, given that it is the worst of `count`, with a false alarm in 10 000 matrices.
    pub fn is_explained(&self, count: usize) -> bool {
        let alarm = 1e-4 / count.max(1) as f64;
        self.difference.agrees_with(0.0, Self::ROUNDING, alarm)
    }

    /// The worse of two.
    pub(super) fn worse(self, other: Option<Self>) -> Self {
        match other {
            Some(other) if other.deviation >= self.deviation => other,
            _ => self,
        }
    }
}

/// Finds the matrix of `groups` row by row and hands each row to `sink`, in order. Only the rows in work and what reciprocity
/// carries over to later rows are kept in memory.
///
/// A tolerance is about factors of at least `floor` = min(1 %, 1/n), n the number of groups: the half-width of the interval is at most the
/// tolerance × max(F, floor). The result does not depend on the number of threads. An observer that breaks leaves the rows that
/// were finished.
///
/// # Errors
/// If the plan has shards or a time without a tolerance, or is wrong in itself.
pub fn matrix(
    facets: &Facets<'_>,
    groups: &Groups,
    options: &MatrixOptions,
    plan: &Plan,
    observer: &mut dyn Observer,
    sink: &mut (dyn FnMut(Row) + Send),
) -> Result<MatrixSummary, ExchangeError> {
    check_plan(plan)?;
    let floor = (1.0 / groups.count() as f64).min(0.01);
    let (rule, set) = (Rule::new(plan, floor), options.instruction_set);
    let by_pairs = options.technique == Technique::Pairs;
    let facets_themselves: Vec<u32> = (0..facets.count() as u32).collect();
    let columns = if by_pairs {
        &facets_themselves
    } else {
        groups.of_facet()
    };
    let surveyor = Surveyor {
        rays: RayCaster {
            facets,
            columns,
            set,
        },
        pairs: PairCaster { facets, rule, set },
        options: *options,
        columns: if by_pairs {
            facets.count()
        } else {
            groups.count()
        },
    };
    let mut summary = MatrixSummary::default();
    let mut crew = Crew::new(surveyor, plan.threads, None::<Duration>, observer);
    let ledger = Assembly::new(facets, groups, by_pairs, sink, &mut summary);
    summary.complete = crew.run(ledger)?.is_continue();
    Ok(summary)
}

pub(super) fn check_plan(plan: &Plan) -> Result<(), ExchangeError> {
    plan.check_without_rms()?;
    if plan.shard.is_some() || plan.stop.time.is_some() || plan.stop.abs_error.is_some() {
        let message = "a matrix takes a relative tolerance or a number of samples, and is not cut into shards";
        return Err(ExchangeError::Plan(message));
    }
    Ok(())
}

/// Finds what is asked of one facet.
pub(super) struct Surveyor<'a> {
    rays: RayCaster<'a>,
    pairs: PairCaster<'a>,
    options: MatrixOptions,
    columns: usize,
}

/// A facet and what was found.
pub(super) struct Survey {
    pub facet: usize,
    pub traced: Option<Traced>,
    /// Exchange areas with facets of higher numbers.
    pub pairs: Vec<Entry>,
    pub samples: u64,
    pub converged: bool,
}

impl Survey {
    pub fn of(facet: usize) -> Self {
        Self {
            facet,
            traced: None,
            pairs: Vec::new(),
            samples: 0,
            converged: true,
        }
    }
}

/// Rays of each replicate in the pilot of a row.
const PILOT: u32 = 1024;

/// Scratch of a thread.
pub(super) struct Workspace {
    rays: RayWorkspace,
    pairs: PairWorkspace,
}

impl Surveyor<'_> {
    /// A row by rays, or its rest alone.
    fn trace(&self, survey: &mut Survey, rest_only: bool, workspace: &mut RayWorkspace) {
        let identity = combine(key_of_name("row"), survey.facet as u64);
        let rule = &self.pairs.rule;
        let (traced, samples, converged) = rule.sample(identity, PILOT, |attempt| {
            let (source, samples) = (Source::Facet(survey.facet), attempt.samples);
            let traced = self
                .rays
                .row(source, attempt.key, rule.replicates, samples, workspace);
            let factors = traced
                .entries
                .iter()
                .filter(|_| !rest_only)
                .map(Entry::factor);
            let excess = factors
                .chain([traced.rest.sky])
                .map(|factor| rule.excess(&factor));
            Found {
                excess: excess.fold(0.0, f64::max),
                order: Rule::ORDER,
                value: traced,
            }
        });
        survey.traced = Some(traced);
        survey.samples += samples;
        survey.converged &= converged;
    }

    fn pair_up(&self, survey: &mut Survey, workspace: &mut PairWorkspace) {
        for to in survey.facet + 1..self.pairs.facets.count() {
            let Some(found) = self.pairs.exchange(survey.facet, to, workspace) else {
                continue;
            };
            survey.pairs.push(found.area);
            survey.samples += found.samples;
            survey.converged &= found.converged;
        }
    }
}

impl Worker for Surveyor<'_> {
    type Job = Survey;
    type Workspace = Workspace;

    fn new_workspace(&self) -> Workspace {
        Workspace {
            rays: RayWorkspace::new(self.columns),
            pairs: PairWorkspace::default(),
        }
    }

    fn perform(&self, survey: &mut Survey, workspace: &mut Workspace) {
        let is_polygon = self.rays.facets.list()[survey.facet].polygon().is_some();
        if self.options.technique == Technique::Rays || !is_polygon {
            return self.trace(survey, false, &mut workspace.rays);
        }
        self.pair_up(survey, &mut workspace.pairs);
        if self.options.rest {
            self.trace(survey, true, &mut workspace.rays);
        }
    }
}
