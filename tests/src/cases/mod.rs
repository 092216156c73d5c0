//! Table cases: from a line of a table to a scene, and from the readings of the scene back to the table's numbers.
//!
//! Nothing here computes what a case expects; it only says which scene and which sensor stand for it.

mod cie171;
mod emitters;
mod enclosures;
mod experiment;
mod lights;
mod skies;
mod skips;
mod table;

pub use experiment::{Experiment, Outcome, REL_ERROR};
pub use skips::{SKIPS, Skip, TIME_SKIPS, skip_of};
pub use table::{Case, tables, time_table};

/// The scenes that stand for a case; none for a kind that is not known.
pub fn experiments(case: &Case) -> Option<Vec<Experiment>> {
    lights::experiments(case)
        .or_else(|| emitters::experiments(case))
        .or_else(|| skies::experiments(case))
        .or_else(|| enclosures::experiments(case))
        .or_else(|| cie171::experiments(case))
}
