//! A row of the matrix.

use serde::{Deserialize, Serialize};

use super::uncertain::Uncertain;
use crate::estimation::Method;

/// One form factor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Number of the surface that is seen.
    pub to: u32,
    /// How it was found; a closed form has no error.
    pub method: Method,
    /// F.
    pub value: f64,
    /// Standard error of F.
    pub std_error: f64,
    /// Degrees of freedom of the standard error.
    #[serde(skip)]
    pub(crate) degrees: f32,
}

impl Entry {
    /// A factor found by a formula.
    pub const fn exact(to: u32, value: f64) -> Self {
        Self {
            to,
            method: Method::ClosedForm,
            value,
            std_error: 0.0,
            degrees: f32::INFINITY,
        }
    }

    /// A sampled factor.
    pub const fn estimated(to: u32, found: Uncertain) -> Self {
        Self {
            to,
            method: Method::Estimate,
            value: found.value,
            std_error: found.std_error,
            degrees: found.degrees as f32,
        }
    }

    /// A factor of either kind: exact if it has no error.
    pub(super) fn found(to: u32, factor: Uncertain) -> Self {
        match factor.std_error == 0.0 && factor.degrees.is_infinite() {
            true => Self::exact(to, factor.value),
            false => Self::estimated(to, factor),
        }
    }

    /// The factor with its error.
    pub fn factor(&self) -> Uncertain {
        Uncertain {
            value: self.value,
            std_error: self.std_error,
            degrees: f64::from(self.degrees),
        }
    }

    /// The same in another unit, for another surface.
    pub(super) fn turned(self, to: u32, factor: f64) -> Self {
        Self {
            to,
            value: self.value * factor,
            std_error: self.std_error * factor,
            ..self
        }
    }
}

/// What becomes of the radiation of one surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Number of the surface.
    pub from: usize,
    /// The factors that are not exactly 0 as far as is known, in the order of surfaces.
    pub entries: Vec<Entry>,
    /// Their sum: 1 in a closed enclosure.
    pub sum: Uncertain,
    /// Where the rest goes, if rays were asked.
    pub rest: Option<Rest>,
    /// Samples that were taken for the row's own part of the matrix.
    pub samples: u64,
    /// Whether the tolerance was met.
    pub converged: bool,
}

/// The part of a surface's radiation that reaches no surface of exchange.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rest {
    /// To infinity above the horizon: the sky view factor.
    pub sky: Uncertain,
    /// To infinity below the horizon.
    pub below: Uncertain,
    /// To surfaces that do not take part: the other sides of facets, and grounds.
    pub other: Uncertain,
}

impl Row {
    /// The factor to a surface; 0 where there is no entry.
    pub fn factor_to(&self, surface: usize) -> Uncertain {
        let found = self
            .entries
            .binary_search_by_key(&(surface as u32), |entry| entry.to);
        found.map_or(Uncertain::exact(0.0), |index| self.entries[index].factor())
    }
}
