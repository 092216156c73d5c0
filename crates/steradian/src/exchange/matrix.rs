//! The matrix in one pass: rows are jobs of the estimation's threads and come out in order.

use std::time::Duration;

use steradian_kernel::InstructionSet;

use super::assembly::Assembly;
use super::effort::Rule;
use super::facets::Facets;
use super::grouping::Groups;
use super::rays::{RayCaster, RayWorkspace, Traced};
use super::row::{Entry, Row};
use super::uncertain::Uncertain;
use crate::estimation::crew::{Crew, Worker};
use crate::estimation::{EstimationError, Observer, Plan};
use crate::sampling::hash::{combine, key_of_name};

/// How factors are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Technique {
    /// Whole rows by rays. Closure is exact, and the error of a factor is that of counting: with N rays about √(F/N).
    Rays,
}

/// What is asked of [`matrix`] beside the plan.
#[derive(Clone, Copy, Debug)]
pub struct MatrixOptions {
    /// How factors are found.
    pub technique: Technique,
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
    /// Factors found by a formula.
    pub closed_forms: u64,
    /// Sampled factors.
    pub estimates: u64,
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
    plan.check()?;
    if plan.shard.is_some() || plan.stop.time.is_some() || plan.stop.abs_error.is_some() {
        let message = "a matrix takes a relative tolerance or a number of samples, and is not cut into shards";
        return Err(ExchangeError::Plan(message));
    }
    let floor = (1.0 / groups.count() as f64).min(0.01);
    let surveyor = Surveyor {
        rays: RayCaster {
            facets,
            columns: groups.of_facet(),
            set: options.instruction_set,
        },
        rule: Rule::new(plan, floor),
        columns: groups.count(),
    };
    let mut summary = MatrixSummary::default();
    let mut crew = Crew::new(surveyor, plan.threads, None::<Duration>, observer);
    let ledger = Assembly::new(facets, groups, sink, &mut summary);
    summary.complete = crew.run(ledger)?.is_continue();
    Ok(summary)
}

/// Finds what is asked of one facet.
pub(super) struct Surveyor<'a> {
    rays: RayCaster<'a>,
    rule: Rule,
    columns: usize,
}

/// A facet and what was found.
pub(super) struct Survey {
    pub facet: usize,
    pub traced: Option<Traced>,
    pub samples: u64,
    pub converged: bool,
}

/// Rays of each replicate in the pilot of a row.
const PILOT: u32 = 1024;

impl Surveyor<'_> {
    fn by_rays(&self, facet: usize, workspace: &mut RayWorkspace) -> (Traced, u64, bool) {
        let identity = combine(key_of_name("row"), facet as u64);
        self.rule.sample(identity, PILOT, |attempt| {
            let replicates = self.rule.replicates;
            let traced = self
                .rays
                .row(facet, attempt.key, replicates, attempt.samples, workspace);
            let factors = traced.entries.iter().map(Entry::factor);
            let excess = factors
                .map(|factor| self.rule.excess(&factor))
                .fold(0.0, f64::max);
            (traced, excess)
        })
    }
}

impl Worker for Surveyor<'_> {
    type Job = Survey;
    type Workspace = RayWorkspace;

    fn new_workspace(&self) -> RayWorkspace {
        RayWorkspace::new(self.columns)
    }

    fn perform(&self, survey: &mut Survey, workspace: &mut RayWorkspace) {
        let (traced, samples, converged) = self.by_rays(survey.facet, workspace);
        survey.traced = Some(traced);
        (survey.samples, survey.converged) = (samples, converged);
    }
}
