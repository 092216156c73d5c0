//! Tables that are shared: made when they are first asked for, and kept.
//!
//! A table depends on the widths of the facets and on indices of refraction, not on colour. Isotropic surfaces share the
//! tables of fixed widths α = (k/64)³, between two of which every share is taken to be linear in ∛α; from α = .05 to 1 this
//! is off by less than 1e-3 at any angle, below that by up to 2 % within a few degrees of the horizon. So a
//! roughness may vary from point to point at no cost. Anisotropic surfaces have tables of exactly their widths.

use std::collections::VecDeque;
use std::fmt;
use std::sync::{Arc, OnceLock, PoisonError, RwLock};

use super::table::Table;
use crate::brdf::sampling::choose;
use crate::geometry::Direction;

/// Intervals of ∛α between 0 and 1.
const WIDTHS: usize = 64;
/// Tables kept for surfaces whose parameters may be asked for again.
const KEPT: usize = 32;

/// Tables of one side or of two.
type Tables<const SIDES: usize> = Arc<[Table; SIDES]>;

/// Tables of all widths.
pub(in crate::brdf) struct Shelf<const SIDES: usize> {
    widths: [OnceLock<Tables<SIDES>>; WIDTHS + 1],
}

impl<const SIDES: usize> Shelf<SIDES> {
    pub(in crate::brdf) const fn new() -> Self {
        Self {
            widths: [const { OnceLock::new() }; WIDTHS + 1],
        }
    }

    /// Between the tables of the two next widths, from how they are made.
    pub(in crate::brdf) fn blend(
        &self,
        alpha: f64,
        make: impl Fn(f64) -> [Table; SIDES],
    ) -> Blend<SIDES> {
        let place = libm::cbrt(alpha) * WIDTHS as f64;
        let node = (place as usize).clamp(1, WIDTHS - 1);
        let width = |node: usize| {
            let root = node as f64 / WIDTHS as f64;
            self.widths[node]
                .get_or_init(|| Arc::new(make(root * root * root)))
                .clone()
        };
        Blend {
            tables: [width(node), width(node + 1)],
            part: place - node as f64,
        }
    }
}

/// What was made for the keys asked for last.
pub(in crate::brdf) struct Recent<K, V>(RwLock<VecDeque<(K, Arc<V>)>>);

impl<K: PartialEq, V> Recent<K, V> {
    pub(in crate::brdf) const fn new() -> Self {
        Self(RwLock::new(VecDeque::new()))
    }

    pub(in crate::brdf) fn get(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        let find = |kept: &VecDeque<(K, Arc<V>)>| {
            let entry = kept.iter().find(|(known, _)| *known == key);
            entry.map(|(_, value)| value.clone())
        };
        let found = find(&self.0.read().unwrap_or_else(PoisonError::into_inner));
        if let Some(value) = found {
            return value;
        }
        let mut kept = self.0.write().unwrap_or_else(PoisonError::into_inner);
        if let Some(value) = find(&kept) {
            return value;
        }
        let value = Arc::new(make());
        kept.truncate(KEPT - 1);
        kept.push_front((key, value.clone()));
        value
    }
}

/// Between two tables of each side.
#[derive(Clone, PartialEq)]
pub(in crate::brdf) struct Blend<const SIDES: usize> {
    tables: [Tables<SIDES>; 2],
    /// Of the second.
    part: f64,
}

impl<const SIDES: usize> fmt::Debug for Blend<SIDES> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Blend").finish_non_exhaustive()
    }
}

impl<const SIDES: usize> Blend<SIDES> {
    /// One table.
    pub(in crate::brdf) fn exactly(tables: Tables<SIDES>) -> Self {
        Self {
            tables: [tables.clone(), tables],
            part: 0.0,
        }
    }

    /// (M, N) of a direction above the surface.
    pub(in crate::brdf) fn at(&self, side: usize, direction: Direction) -> [f64; 2] {
        let first = self.tables[0][side].at(direction);
        if self.part == 0.0 {
            return first;
        }
        let second = self.tables[1][side].at(direction);
        [0, 1].map(|share| first[share] + self.part * (second[share] - first[share]))
    }

    /// M of a direction above the surface.
    pub(in crate::brdf) fn missing(&self, side: usize, direction: Direction) -> f64 {
        self.at(side, direction)[0]
    }

    /// M̄.
    pub(in crate::brdf) fn average(&self, side: usize) -> f64 {
        self.averages(side)[0]
    }

    /// M̄ and N̄.
    pub(in crate::brdf) fn averages(&self, side: usize) -> [f64; 2] {
        let [first, second] = [0, 1].map(|k| self.tables[k][side].averages());
        [0, 1].map(|share| first[share] + self.part * (second[share] - first[share]))
    }

    /// A direction above the surface, of density M cosθ/(π M̄) in the mean over azimuth.
    pub(in crate::brdf) fn sample(&self, side: usize, u: [f64; 2]) -> Direction {
        let (second, u0) = choose(u[0], self.share_of_second(side));
        self.tables[usize::from(second)][side].sample([u0, u[1]])
    }

    /// Its density.
    pub(in crate::brdf) fn pdf(&self, side: usize, direction: Direction) -> f64 {
        let share = self.share_of_second(side);
        let [first, second] = [0, 1].map(|k| self.tables[k][side].pdf(direction));
        first + share * (second - first)
    }

    /// The mean of a function over directions of that density, at 64 heights and azimuths by the golden ratio.
    pub(in crate::brdf) fn mean(&self, side: usize, f: impl Fn(Direction) -> f64) -> f64 {
        const POINTS: u32 = 64;
        let turns = |k| f64::from(k) * 0.618_033_988_749_895;
        let at = |k| [(f64::from(k) + 0.5) / f64::from(POINTS), turns(k).fract()];
        let sum: f64 = (0..POINTS).map(|k| f(self.sample(side, at(k)))).sum();
        sum / f64::from(POINTS)
    }

    /// M at the nodes of the tables, if it does not depend on azimuth.
    pub(super) fn nodes(&self, side: usize) -> Option<Vec<f32>> {
        let [first, second] = [self.tables[0][side].nodes()?, self.tables[1][side].nodes()?];
        Some(mixed(&first, &second, self.part))
    }

    /// The density of [`sample`](Self::sample) over cosθ in each band of the tables.
    pub(super) fn bands(&self, side: usize) -> Vec<f32> {
        let [first, second] = [0, 1].map(|k| self.tables[k][side].bands());
        mixed(&first, &second, self.share_of_second(side))
    }

    fn share_of_second(&self, side: usize) -> f64 {
        self.part * self.tables[1][side].averages()[0] / self.average(side)
    }
}

fn mixed(first: &[f64], second: &[f64], part: f64) -> Vec<f32> {
    let both = first.iter().zip(second);
    both.map(|(a, b)| (a + part * (b - a)) as f32).collect()
}
