//! Which of many extended lamps a still point has to sample.
//!
//! | a lamp of constant radiance | what a point does | |
//! |---|---|---|
//! | in full view, E = π L F | adds it in closed form | [`shaft`](super::shaft) |
//! | hidden, below the horizon or shining elsewhere | nothing | [`hiding`] |
//! | any other, *open* | samples it | [`aim`](super::aim) |
//!
//! What is between a point and all lamps of a plane is [asked once](search), and then of fewer lamps where something is. Lamps of the first two kinds are
//! *known*: neither light samples nor a point's own directions look for them.
//!
//! Of more lamps than points sample each of, a sample takes one of the open ones with the probability
//!
//! p = Ω L/Σ Ω L ,  Ω = ∫ cosθ dω  (∫ dω at scalar irradiance),
//!
//! so that all samples have the same weight Σ Ω L but for shadows. This holds where all lamps are of one of these kinds and the open ones
//! are [aimed at](super::aim::is_aimed_at), so that no other direction need know p; elsewhere the [tree](super::light_tree) chooses among all.
//! Shares are kept as integers out of 2³¹, at least 1: each open lamp takes 8 bytes a point, and is found however little it brings.

mod groups;
mod hiding;
mod search;

#[cfg(test)]
mod tests;

use std::ops::Range;
use std::sync::Arc;

use super::aim::is_aimed_at;
use super::choice::Sampled;
use super::shaft::View;
use super::tables::{ALL_LIGHTS, CHOSEN_LIGHTS, MOST_FACETS, Outline, Tables};
use groups::Groups;
use search::{Search, Seen};

/// What shares are parts of.
const ALL: f64 = (1_u32 << 31) as f64;

/// What a point knows of the extended lamps.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Roster {
    /// A bit for each emitter whose light is known.
    known: Box<[u64]>,
    /// Those left, if they are all that are sampled.
    open: Option<Box<[Open]>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Open {
    emitter: u32,
    /// Of the shares up to and including its own.
    sum: u32,
}

impl Roster {
    /// Whether an emitter is among those whose light is known.
    #[inline(always)]
    pub fn knows(&self, emitter: usize) -> bool {
        let bits = self.known.get(emitter / 64);
        bits.is_some_and(|bits| bits >> (emitter % 64) & 1 == 1)
    }

    /// Whether no lamp need be sampled.
    pub fn knows_all(&self) -> bool {
        self.open.as_ref().is_some_and(|open| open.is_empty())
    }

    /// Whether emitters are chosen from here, rather than from the tree.
    pub fn chooses(&self) -> bool {
        self.open.is_some()
    }

    /// An open lamp for one of some samples, and what is left of the number.
    pub fn choose(&self, u: f64) -> Option<(Sampled, f32)> {
        let open = self.open.as_deref()?;
        let total = f64::from(open.last()?.sum);
        let wanted = u * total;
        let index = open.partition_point(|one| f64::from(one.sum) <= wanted);
        let one = open.get(index)?;
        let before = index.checked_sub(1).map_or(0, |last| open[last].sum);
        let share = f64::from(one.sum - before);
        let sampled = Sampled {
            number: one.emitter as usize,
            triangle: None,
            rate: (f64::from(CHOSEN_LIGHTS) * share / total) as f32,
        };
        let rest = (wanted - f64::from(before)) / share;
        Some((sampled, (rest as f32).clamp(0.0, 1.0 - 0.5 * f32::EPSILON)))
    }

    fn know(&mut self, emitter: usize) {
        self.known[emitter / 64] |= 1 << (emitter % 64);
    }
}

/// The rosters of a batch of paths, by slot.
#[derive(Default)]
pub(super) struct RosterColumn {
    /// First that of paths that know nothing.
    rosters: Vec<Arc<Roster>>,
    numbers: Vec<u32>,
}

impl RosterColumn {
    /// So many paths that know nothing.
    pub fn reset(&mut self, slots: usize) {
        self.rosters.truncate(1);
        self.rosters.resize_with(1, Arc::default);
        self.numbers.clear();
        self.numbers.resize(slots, 0);
    }

    pub fn set(&mut self, slots: Range<usize>, roster: &Arc<Roster>) {
        self.numbers[slots].fill(self.rosters.len() as u32);
        self.rosters.push(Arc::clone(roster));
    }

    #[inline(always)]
    pub fn of(&self, slot: u32) -> &Roster {
        &self.rosters[self.numbers[slot as usize] as usize]
    }
}

/// What all points of a run know of their lamps.
pub(super) struct Rosters {
    groups: Groups,
    /// Channels of the power of each light.
    channels: Vec<Vec<f64>>,
    /// By emitter, what shares are in proportion to besides Ω.
    strengths: Vec<f64>,
    /// Whether points choose among open lamps.
    choose: bool,
}

impl Rosters {
    pub fn new(tables: &Tables<'_>) -> Self {
        let (scene, groups) = (tables.scene, Groups::new(tables));
        let lights = scene.lights().iter();
        let greatest = tables.strengths.iter().copied().fold(0.0, f64::max);
        let are_all = groups.lamps.len() == tables.extended && tables.sums_lights();
        Self {
            channels: lights
                .map(|light| scene.channels(light, light.power()))
                .collect(),
            // A lamp of no luminance in the mean still has lanes.
            strengths: tables
                .strengths
                .iter()
                .map(|one| one.max(1e-3 * greatest))
                .collect(),
            choose: are_all && tables.extended > ALL_LIGHTS,
            groups,
        }
    }

    /// What a point knows; adds the light of lamps in full view.
    pub fn at(&self, tables: &Tables<'_>, view: &View, columns: &mut [f64]) -> Arc<Roster> {
        if self.groups.lamps.is_empty() {
            return Arc::default();
        }
        let search = Search::new(tables, &self.groups, view);
        let mut roster = Roster {
            known: vec![0; tables.extended.div_ceil(64)].into(),
            open: None,
        };
        let mut open = vec![];
        for (emitter, pieces) in &self.groups.lamps {
            let seen = &search.seen[pieces.clone()];
            if seen.contains(&Seen::Perhaps) {
                open.push(*emitter);
                continue;
            }
            roster.know(*emitter);
            let share = share(tables, view, (*emitter, seen), |seen| seen == Seen::Whole);
            self.add(tables, *emitter, share, columns);
        }
        self.open(tables, view, open, &mut roster);
        Arc::new(roster)
    }

    fn add(&self, tables: &Tables<'_>, emitter: usize, share: f64, columns: &mut [f64]) {
        if share == 0.0 {
            return;
        }
        let emitter = &tables.emitters[emitter];
        let channels = &self.channels[emitter.light];
        let column = &mut columns[emitter.group as usize * channels.len()..];
        for (sum, channel) in column.iter_mut().zip(channels) {
            *sum += share * channel;
        }
    }

    /// Shares out the samples among the open lamps.
    fn open(&self, tables: &Tables<'_>, view: &View, open: Vec<usize>, roster: &mut Roster) {
        let start = tables.scene.surfaces().to_kernel(view.start);
        let aimed = |emitter: &usize| is_aimed_at(tables, &tables.emitters[*emitter], start);
        if !self.choose || !open.iter().all(aimed) {
            return;
        }
        let weight = |emitter: &usize| {
            let seen = &[Seen::Perhaps; MOST_FACETS];
            self.strengths[*emitter] * share(tables, view, (*emitter, seen), |_| true)
        };
        let weights: Vec<_> = open.iter().map(weight).collect();
        let total: f64 = weights.iter().sum();
        let mut sum = 0;
        let of_one = |(emitter, weight): (usize, f64)| {
            sum += ((weight / total * ALL) as u32).max(1);
            Open {
                emitter: emitter as u32,
                sum,
            }
        };
        roster.open = Some(open.into_iter().zip(weights).map(of_one).collect());
    }
}

/// ∫ cosθ dω, or ∫ dω, over the pieces of a lamp that are seen as wanted.
fn share(
    tables: &Tables<'_>,
    view: &View,
    (emitter, seen): (usize, &[Seen]),
    wanted: impl Fn(Seen) -> bool,
) -> f64 {
    let emitter = &tables.emitters[emitter];
    let first = seen.first().is_some_and(|seen| wanted(*seen));
    match &emitter.outline {
        Some(Outline::Facets(facets)) => {
            let facets = facets.iter().zip(seen);
            let facets = facets
                .filter(|(facet, seen)| wanted(**seen) && view.may_see(facet, emitter.two_sided));
            facets.map(|(facet, _)| view.of_facet(facet)).sum()
        }
        Some(Outline::Disc(disc, around)) if first && view.may_see(around, emitter.two_sided) => {
            view.of_disc(disc)
        }
        Some(Outline::Sphere { center, radius }) if first => view.of_sphere(*center, *radius),
        Some(Outline::Disc(..) | Outline::Sphere { .. }) | None => 0.0,
    }
}
