//! Which dimming of light groups gives wanted readings, and how well the answer is known. Nothing is traced again.
//!
//! Light is linear in its sources. With factors x_g on the groups that vary, a reading at point i is
//!
//! ```text
//! Eᵢ(x) = Bᵢ + Σ_g x_g E_gi
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Bᵢ | what all other groups add to the reading | that of the reading |
//! | E_gi | what group g adds as the result stands | that of the reading |
//! | x_g | the factor on it, from a lower to an upper bound | – |
//!
//! Targets ask for a mean, a point, a least or a greatest reading of a sensor. The factors minimise Σ ((E(x) − target)/target)²
//! within their bounds. Means and points are linear in x. A least or greatest reading is that of one point, found anew until it
//! stays the same (Newton's method on a piecewise linear function). An inequality counts only where it would else be broken.
//!
//! All this is done again with each replicate left out, and the [jackknife] gives each factor its error:
//! the errors of all coefficients, with their covariances. The achieved readings, on the other hand, are those of the
//! factors found, taken as exact: what a run of the scene with lights so dimmed would find.

mod goal;
mod least_squares;

use thiserror::Error;

use super::Measurements;
use crate::estimation::{Estimate, jackknife};
use goal::Goal;
use least_squares::{Row, bounded};

/// Rounds after which targets that pull at ever other points are given up.
const MAX_ROUNDS: usize = 200;

/// Which reading of a sensor a target is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TargetOf {
    /// The mean over its points.
    Mean,
    /// The least.
    Min,
    /// The greatest.
    Max,
    /// That of the point with this number.
    Point(usize),
}

/// How a reading compares with what is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// The same.
    Equal,
    /// No less.
    AtLeast,
    /// No more.
    AtMost,
}

/// A wanted reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Name of the sensor.
    pub sensor: String,
    /// Number of the quantity among those that the sensor reports.
    pub quantity: usize,
    /// Which reading.
    pub of: TargetOf,
    /// How it compares.
    pub relation: Relation,
    /// What is wanted, in the unit of the quantity.
    pub value: f64,
}

/// A light group whose factor is sought.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// Its name.
    pub group: String,
    /// Least and greatest factor.
    pub bounds: [f64; 2],
}

/// The factor of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedFactor {
    /// The light group.
    pub group: String,
    /// The factor, on top of what the group gives already.
    pub factor: Estimate,
    /// The bound that holds it, if one does.
    pub held_at: Option<f64>,
}

/// What the factors make of a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Achieved {
    /// What was wanted.
    pub target: Target,
    /// Unit of the reading.
    pub unit: String,
    /// The reading with the factors found.
    pub reading: Estimate,
    /// Whether it is as wanted.
    pub met: bool,
}

/// Factors, and what they achieve.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// In the order of what may vary.
    pub factors: Vec<SolvedFactor>,
    /// In the order of the targets.
    pub targets: Vec<Achieved>,
}

/// Why there is no solution.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SolveError {
    /// No such sensor.
    #[error("there is no sensor `{0}`")]
    UnknownSensor(String),
    /// No such light group.
    #[error("there is no light group `{0}`")]
    UnknownGroup(String),
    /// No such point or quantity.
    #[error("sensor `{sensor}` has no {what}")]
    Missing {
        /// The sensor.
        sensor: String,
        /// What it has not.
        what: String,
    },
    /// Bounds that leave no room, or a target that is no number.
    #[error("{0}")]
    Number(String),
    /// A group whose light reaches no target.
    #[error("light group `{0}` adds nothing to any target, so that its factor could be anything")]
    NoInfluence(String),
    /// More factors than targets that decide.
    #[error(
        "{factors} factors are sought, but the targets leave a choice: give more targets, or vary fewer groups"
    )]
    Undetermined {
        /// Number of factors.
        factors: usize,
    },
    /// The least or greatest reading jumps from point to point.
    #[error(
        "the targets contradict each other: whatever the factors, another point has the least or greatest reading"
    )]
    Unsettled,
}

impl Measurements {
    /// The factors of some light groups that bring readings nearest to what is wanted.
    ///
    /// # Errors
    /// If a name is unknown, or the targets do not decide the factors.
    pub fn solve(&self, targets: &[Target], vary: &[Vary]) -> Result<Solution, SolveError> {
        check(targets, vary)?;
        let goal = |target| self.goal(target, vary);
        let goals: Vec<Goal> = targets.iter().map(goal).collect::<Result<_, _>>()?;
        if let Some(idle) = idle(&goals, vary) {
            return Err(SolveError::NoInfluence(idle.to_owned()));
        }
        let start: Vec<f64> = vary.iter().map(|vary| vary.bounds[0]).collect();
        let bounds: Vec<[f64; 2]> = vary.iter().map(|vary| vary.bounds).collect();
        let found = settle(&goals, &bounds, &start, None)?;
        let replicates = goals.iter().map(Goal::replicates).max().unwrap_or(0);
        let without: Vec<Vec<f64>> = (0..replicates)
            .map(|replicate| settle(&goals, &bounds, &found, Some(replicate)))
            .collect::<Result<_, _>>()?;
        let factors = vary.iter().enumerate().map(|(number, vary)| {
            let without: Vec<f64> = without.iter().map(|factors| factors[number]).collect();
            let bound = vary
                .bounds
                .into_iter()
                .find(|bound| *bound == found[number]);
            SolvedFactor {
                group: vary.group.clone(),
                factor: self.factor(found[number], &without),
                held_at: bound.filter(|_| without.iter().all(|factor| *factor == found[number])),
            }
        });
        Ok(Solution {
            factors: factors.collect(),
            targets: goals
                .iter()
                .map(|goal| goal.achieved(&found, self.confidence))
                .collect(),
        })
    }

    fn factor(&self, value: f64, without: &[f64]) -> Estimate {
        if without.is_empty() {
            Estimate::closed_form(value)
        } else {
            jackknife(value, without, self.confidence, true)
        }
    }
}

fn check(targets: &[Target], vary: &[Vary]) -> Result<(), SolveError> {
    let number = |text: String| Err(SolveError::Number(text));
    if let Some(target) = targets.iter().find(|target| !target.value.is_finite()) {
        return number(format!("{} is no target", target.value));
    }
    for (index, Vary { group, bounds }) in vary.iter().enumerate() {
        let [low, high] = *bounds;
        if !(low.is_finite() && high.is_finite() && 0.0 <= low && low < high) {
            return number(format!(
                "the factor of `{group}` cannot go from {low} to {high}"
            ));
        }
        if vary[..index].iter().any(|other| other.group == *group) {
            return number(format!("light group `{group}` is to vary twice"));
        }
    }
    Ok(())
}

/// A group that has no part in any target.
fn idle<'a>(goals: &[Goal], vary: &'a [Vary]) -> Option<&'a str> {
    let is_idle = |number: &usize| goals.iter().all(|goal| goal.is_without(*number));
    let idle = (0..vary.len()).find(is_idle)?;
    Some(&vary[idle].group)
}

/// The best factors, from all replicates or with one left out.
fn settle(
    goals: &[Goal],
    bounds: &[[f64; 2]],
    start: &[f64],
    left_out: Option<usize>,
) -> Result<Vec<f64>, SolveError> {
    let state = |pulls: Vec<bool>, factors: &[f64]| {
        let points = goals.iter().map(|goal| goal.point(factors, left_out));
        (pulls, points.collect::<Vec<_>>())
    };
    let pulls = |before: &[bool], factors: &[f64]| -> Vec<bool> {
        let goals = goals.iter().zip(before);
        goals
            .map(|(goal, before)| goal.pulls(*before, factors, left_out))
            .collect()
    };
    let mut now = state(pulls(&vec![false; goals.len()], start), start);
    for _ in 0..MAX_ROUNDS {
        let (pulling, points) = &now;
        let taking_part = goals
            .iter()
            .zip(points)
            .zip(pulling)
            .filter(|(_, pulls)| **pulls);
        let rows: Vec<Row> = taking_part
            .map(|((goal, point), _)| goal.row(*point, left_out))
            .collect();
        let solved = bounded(&rows, bounds);
        let next = state(pulls(pulling, &solved.x), &solved.x);
        if next == now {
            let factors = bounds.len();
            let found = solved.is_unique.then_some(solved.x);
            return found.ok_or(SolveError::Undetermined { factors });
        }
        now = next;
    }
    Err(SolveError::Unsettled)
}

#[cfg(test)]
mod tests;
