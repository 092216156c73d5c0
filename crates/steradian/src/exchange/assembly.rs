//! From what was found of facets, in order, to the rows of the matrix.
//!
//! Surveys come in as rows by rays, each by itself, or as exchange areas of pairs, each pair once. A pair belongs to two rows: the part of
//! the later one waits here. Facets that are no polygons are surveyed first, as all other rows have pairs with them.

use std::collections::BTreeMap;
use std::time::Duration;

use super::facets::Facets;
use super::grouping::Groups;
use super::matrix::{MatrixSummary, Residual, Survey};
use super::row::{Entry, Rest, Row};
use super::uncertain::{IndependentSum, Uncertain};
use crate::estimation::crew::{Ledger, Standing};
use crate::estimation::{EstimationError, Method, Phase};

/// Hands out facets and puts rows together.
pub(super) struct Assembly<'a> {
    facets: &'a Facets<'a>,
    groups: &'a Groups,
    by_pairs: bool,
    sink: &'a mut (dyn FnMut(Row) + Send),
    summary: &'a mut MatrixSummary,
    /// Facets in the order of their surveys.
    order: Vec<u32>,
    issued: usize,
    merged: usize,
    emitted: usize,
    /// How many facets must be merged before each row is complete.
    needed: Vec<usize>,
    drafts: Vec<Draft>,
    /// Exchange areas that later rows are compared with.
    mirrored: Vec<Vec<Entry>>,
}

/// A row as far as it is known.
#[derive(Default)]
struct Draft {
    columns: BTreeMap<u32, IndependentSum>,
    /// Of rows by rays, whose columns are not independent.
    sum: Option<IndependentSum>,
    rest: Option<[IndependentSum; 3]>,
    samples: u64,
    missed: bool,
}

impl Draft {
    fn add(&mut self, to: u32, factor: Uncertain, share: f64) {
        self.columns.entry(to).or_default().add(factor, share);
    }

    fn add_rest(&mut self, rest: &Rest, share: f64) {
        let sums = self.rest.get_or_insert_default();
        for (sum, part) in sums.iter_mut().zip([rest.sky, rest.below, rest.other]) {
            sum.add(part, share);
        }
    }

    fn row(self, from: usize) -> Row {
        let entry = |(to, sum): (u32, IndependentSum)| Entry::found(to, sum.total());
        let entries: Vec<Entry> = self.columns.into_iter().map(entry).collect();
        let sum = self.sum.unwrap_or_else(|| {
            let mut sum = IndependentSum::default();
            entries
                .iter()
                .for_each(|entry| sum.add(entry.factor(), 1.0));
            sum
        });
        let rest = self.rest.map(|rest| rest.map(|sum| sum.total()));
        Row {
            from,
            entries,
            sum: sum.total(),
            rest: rest.map(|[sky, below, other]| Rest { sky, below, other }),
            samples: self.samples,
            converged: !self.missed,
        }
    }
}

impl<'a> Assembly<'a> {
    pub fn new(
        facets: &'a Facets<'a>,
        groups: &'a Groups,
        by_pairs: bool,
        sink: &'a mut (dyn FnMut(Row) + Send),
        summary: &'a mut MatrixSummary,
    ) -> Self {
        let is_flat = |facet: &u32| facets.list()[*facet as usize].polygon().is_some();
        let mut order: Vec<u32> = (0..facets.count() as u32).collect();
        let mut first = 0;
        if by_pairs {
            order.sort_by_key(is_flat);
            first = order.iter().filter(|facet| !is_flat(facet)).count();
        }
        let mut needed = vec![order.len(); groups.count()];
        if groups.is_identity() {
            for (position, facet) in order.iter().enumerate() {
                needed[*facet as usize] = first.max(position + 1);
            }
        }
        Self {
            facets,
            groups,
            by_pairs,
            sink,
            summary,
            order,
            issued: 0,
            merged: 0,
            emitted: 0,
            needed,
            drafts: (0..groups.count()).map(|_| Draft::default()).collect(),
            mirrored: vec![Vec::new(); groups.count()],
        }
    }

    /// The draft of a facet's group, and the share of the group's area that 1 m² of it is.
    fn draft(&mut self, facet: usize) -> (&mut Draft, f64) {
        let group = self.groups.of_facet()[facet] as usize;
        (&mut self.drafts[group], 1.0 / self.groups.areas()[group])
    }

    fn take(&mut self, mut survey: Survey) {
        let (facet, area) = (survey.facet, self.facets.list()[survey.facet].area);
        let by_pairs = self.by_pairs;
        let (draft, per_area) = self.draft(facet);
        draft.samples += survey.samples;
        draft.missed |= !survey.converged;
        if let Some(traced) = survey.traced.take() {
            draft.add_rest(&traced.rest, area * per_area);
            if by_pairs {
                survey
                    .pairs
                    .extend(self.pairs_of_row(facet, &traced.entries));
            } else {
                draft
                    .sum
                    .get_or_insert_default()
                    .add(traced.sum, area * per_area);
                for entry in &traced.entries {
                    draft.add(entry.to, entry.factor(), area * per_area);
                }
            }
        }
        for pair in &survey.pairs {
            self.take_pair(facet, pair);
        }
    }

    /// The exchange areas of a facet that is no polygon, whose row came by rays, with polygons and facets that follow it.
    fn pairs_of_row(&self, facet: usize, entries: &[Entry]) -> Vec<Entry> {
        let list = self.facets.list();
        let is_polygon = list[facet].polygon().is_some();
        let wanted = |entry: &&Entry| {
            let to = entry.to as usize;
            !is_polygon && (list[to].polygon().is_some() || to >= facet)
        };
        let pairs = entries.iter().filter(wanted);
        pairs
            .map(|entry| entry.turned(entry.to, list[facet].area))
            .collect()
    }

    fn take_pair(&mut self, facet: usize, pair: &Entry) {
        let (to, area) = (pair.to as usize, pair.factor());
        let [from_group, to_group] = [facet, to].map(|index| self.groups.of_facet()[index]);
        let (draft, per_area) = self.draft(facet);
        match (facet == to, from_group == to_group) {
            (true, _) => draft.add(to_group, area, per_area),
            (false, true) => draft.add(to_group, area, 2.0 * per_area),
            (false, false) => {
                draft.add(to_group, area, per_area);
                let (draft, per_area) = self.draft(to);
                draft.add(from_group, area, per_area);
            }
        }
    }

    /// Hands out what is complete.
    fn emit_complete(&mut self) {
        while self
            .needed
            .get(self.emitted)
            .is_some_and(|&needed| needed <= self.merged)
        {
            let row = std::mem::take(&mut self.drafts[self.emitted]).row(self.emitted);
            self.emitted += 1;
            self.emit(row);
        }
    }

    fn emit(&mut self, row: Row) {
        self.check_closure(&row);
        if !self.by_pairs {
            self.check_reciprocity(&row);
        }
        for entry in &row.entries {
            match entry.method {
                Method::ClosedForm => self.summary.closed_forms += 1,
                Method::Estimate => self.summary.estimates += 1,
            }
            self.summary.unseen +=
                u64::from(entry.method == Method::Estimate && entry.value == 0.0);
        }
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

impl Ledger for Assembly<'_> {
    type Job = Survey;

    fn issue(&mut self) -> Option<Survey> {
        let facet = self.order.get(self.issued)?;
        self.issued += 1;
        Some(Survey::of(*facet as usize))
    }

    fn merge(&mut self, survey: Survey) -> Result<(), EstimationError> {
        self.merged += 1;
        self.take(survey);
        self.emit_complete();
        Ok(())
    }

    fn is_complete(&self) -> bool {
        self.merged == self.facets.count()
    }

    /// Work in pairs or rows: with pairs, later facets have less to do.
    fn standing(&self) -> Standing {
        let count = self.facets.count() as u64;
        let left = count - self.merged as u64;
        let (samples, planned) = if self.by_pairs {
            let all = count * (count + 1) / 2;
            (all - left * (left + 1) / 2, all)
        } else {
            (self.merged as u64, count)
        };
        Standing {
            phase: Phase::Final,
            begin: Duration::ZERO,
            samples,
            planned,
            relative_error: None,
        }
    }
}
