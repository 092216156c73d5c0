//! From what was found of facets, in order, to the rows of the matrix.

use std::collections::BTreeMap;
use std::time::Duration;

use super::facets::Facets;
use super::grouping::Groups;
use super::matrix::{MatrixSummary, Residual, Survey};
use super::rays::Traced;
use super::row::{Entry, Rest, Row};
use super::uncertain::{IndependentSum, Uncertain};
use crate::estimation::crew::{Ledger, Standing};
use crate::estimation::{EstimationError, Method, Phase};

/// Hands out facets and puts rows together.
pub(super) struct Assembly<'a> {
    facets: &'a Facets<'a>,
    groups: &'a Groups,
    sink: &'a mut (dyn FnMut(Row) + Send),
    summary: &'a mut MatrixSummary,
    issued: usize,
    merged: usize,
    /// Groups of several facets on their way.
    sums: Vec<GroupSum>,
    /// Exchange areas A_i F_ij that later rows are compared with.
    mirrored: Vec<Vec<Entry>>,
}

/// A group's row as far as its facets are known.
#[derive(Default)]
struct GroupSum {
    columns: BTreeMap<u32, IndependentSum>,
    sum: IndependentSum,
    rest: [IndependentSum; 3],
    samples: u64,
    missed: bool,
}

impl GroupSum {
    /// Adds a facet that has this share of the group's area.
    fn add(&mut self, row: &Row, share: f64) {
        for entry in &row.entries {
            self.columns
                .entry(entry.to)
                .or_default()
                .add(entry.factor(), share);
        }
        self.sum.add(row.sum, share);
        if let Some(Rest { sky, below, other }) = row.rest {
            for (sum, part) in self.rest.iter_mut().zip([sky, below, other]) {
                sum.add(part, share);
            }
        }
        self.samples += row.samples;
        self.missed |= !row.converged;
    }

    fn row(self, from: usize) -> Row {
        let entry = |(to, sum): (u32, IndependentSum)| match sum.total() {
            exact if exact.std_error == 0.0 => Entry::exact(to, exact.value),
            found => Entry::estimated(to, found),
        };
        let [sky, below, other] = self.rest.map(|sum| sum.total());
        Row {
            from,
            entries: self.columns.into_iter().map(entry).collect(),
            sum: self.sum.total(),
            rest: Some(Rest { sky, below, other }),
            samples: self.samples,
            converged: !self.missed,
        }
    }
}

impl<'a> Assembly<'a> {
    pub fn new(
        facets: &'a Facets<'a>,
        groups: &'a Groups,
        sink: &'a mut (dyn FnMut(Row) + Send),
        summary: &'a mut MatrixSummary,
    ) -> Self {
        let grouped = if groups.is_identity() {
            0
        } else {
            groups.count()
        };
        Self {
            facets,
            groups,
            sink,
            summary,
            issued: 0,
            merged: 0,
            sums: (0..grouped).map(|_| GroupSum::default()).collect(),
            mirrored: vec![Vec::new(); groups.count()],
        }
    }

    fn take(&mut self, facet: usize, row: Row) {
        if self.groups.is_identity() {
            return self.emit(row);
        }
        let group = self.groups.of_facet()[facet] as usize;
        let share = self.facets.list()[facet].area / self.groups.areas()[group];
        self.sums[group].add(&row, share);
        if self.merged == self.facets.count() {
            for (group, sum) in std::mem::take(&mut self.sums).into_iter().enumerate() {
                self.emit(sum.row(group));
            }
        }
    }

    fn emit(&mut self, row: Row) {
        self.check_closure(&row);
        self.check_reciprocity(&row);
        let exact = row
            .entries
            .iter()
            .filter(|entry| entry.method == Method::ClosedForm);
        let exact = exact.count() as u64;
        self.summary.closed_forms += exact;
        self.summary.estimates += row.entries.len() as u64 - exact;
        self.summary.samples += row.samples;
        self.summary.rows += 1;
        self.summary.missed += usize::from(!row.converged);
        (self.sink)(row);
    }

    fn check_closure(&mut self, row: &Row) {
        let difference = Uncertain {
            value: row.sum.value - 1.0,
            ..row.sum
        };
        let residual = Residual::new([row.from; 2], difference);
        self.summary.closure = Some(residual.worse(self.summary.closure));
    }

    fn check_reciprocity(&mut self, row: &Row) {
        let area = self.groups.areas()[row.from];
        for mirrored in std::mem::take(&mut self.mirrored[row.from]) {
            let mut difference = IndependentSum::default();
            difference.add(mirrored.factor(), 1.0);
            difference.add(seen(row, mirrored.to), -area);
            let residual = Residual::new([mirrored.to as usize, row.from], difference.total());
            self.summary.reciprocity = Some(residual.worse(self.summary.reciprocity));
        }
        for entry in row
            .entries
            .iter()
            .filter(|entry| entry.to as usize > row.from)
        {
            let mirrored = entry.turned(row.from as u32, area);
            self.mirrored[entry.to as usize].push(mirrored);
        }
    }
}

/// A factor of a row; where no ray went, 0 with the deviation that a share has of which N rays see nothing, 1/N.
fn seen(row: &Row, to: u32) -> Uncertain {
    let found = row.factor_to(to as usize);
    if found.value > 0.0 {
        return found;
    }
    Uncertain {
        value: 0.0,
        std_error: 1.0 / row.samples.max(1) as f64,
        degrees: 15.0,
    }
}

fn row_of(from: usize, traced: Traced, samples: u64, converged: bool) -> Row {
    let Traced { entries, sum, rest } = traced;
    Row {
        from,
        entries,
        sum,
        rest: Some(rest),
        samples,
        converged,
    }
}

impl Ledger for Assembly<'_> {
    type Job = Survey;

    fn issue(&mut self) -> Option<Survey> {
        (self.issued < self.facets.count()).then(|| {
            self.issued += 1;
            Survey {
                facet: self.issued - 1,
                traced: None,
                samples: 0,
                converged: false,
            }
        })
    }

    fn merge(&mut self, survey: Survey) -> Result<(), EstimationError> {
        self.merged += 1;
        if let Some(traced) = survey.traced {
            let row = row_of(survey.facet, traced, survey.samples, survey.converged);
            self.take(survey.facet, row);
        }
        Ok(())
    }

    fn is_complete(&self) -> bool {
        self.merged == self.facets.count()
    }

    fn standing(&self) -> Standing {
        Standing {
            phase: Phase::Final,
            begin: Duration::ZERO,
            samples: self.merged as u64,
            planned: self.facets.count() as u64,
            relative_error: None,
        }
    }
}
