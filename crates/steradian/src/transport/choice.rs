//! Which emitter a place samples: one of several by what it may bring to the place.

use super::columns::Place;
use super::light_tree::{self, LightTree, Receiving};
use super::tables::{Candidates, Choice, Tables};
use super::towards::{Towards, towards, towards_triangle};
use crate::sampling::hash;

/// An emitter, and how many samples it gets in the mean.
#[derive(Copy, Clone, Debug)]
pub(super) struct Sampled {
    pub number: usize,
    /// Which triangle of a mesh, where they are chosen.
    pub triangle: Option<u32>,
    pub rate: f32,
}

impl Sampled {
    /// An emitter that is sampled at every place.
    pub const fn each(number: usize) -> Self {
        Self {
            number,
            triangle: None,
            rate: 1.0,
        }
    }

    /// A direction towards it.
    pub fn towards(&self, tables: &Tables, place: &Place, u: [f32; 2]) -> Option<Towards> {
        let emitter = &tables.emitters[self.number];
        match self.triangle {
            Some(triangle) => towards_triangle(tables, emitter, triangle, (place, u)),
            None => towards(tables, emitter, place, u),
        }
    }
}

/// One of the candidates by importance, and the number that is left to use; none where none may contribute. Where there is no choice, the first.
///
/// The first number is that of one of so many strata. The second one serves to refine it, as its 24 bits do not part many lights and then
/// the points of one.
pub(super) fn choose(
    tables: &Tables,
    candidates: Candidates,
    numbers: ([f32; 2], (u32, u32)),
    at: impl FnOnce() -> Receiving,
) -> Option<(Sampled, f32)> {
    choose_by(tables, candidates, numbers, |tree, u| tree.draw(&at(), u))
}

/// A number of one of so many strata, with more digits by a second one.
#[inline(always)]
pub(super) fn refined([u, v]: [f32; 2], (stratum, strata): (u32, u32)) -> f64 {
    let fine = f64::from(hash::mix_32(v.to_bits())) * 0.5_f64.powi(56);
    (f64::from(stratum) + f64::from(u) + fine) / f64::from(strata)
}

/// The same by whatever draws a light from the tree.
#[inline(always)]
pub(super) fn choose_by(
    tables: &Tables,
    candidates: Candidates,
    ([u, v], stratum): ([f32; 2], (u32, u32)),
    draw: impl FnOnce(&LightTree, f64) -> Option<light_tree::Drawn>,
) -> Option<(Sampled, f32)> {
    let Choice::ByImportance { samples } = candidates.choice else {
        return Some((Sampled::each(0), u));
    };
    let u = refined([u, v], stratum);
    let chosen = tables.selection(candidates)?.choose_by(u, draw)?;
    let sampled = Sampled {
        number: chosen.emitter,
        triangle: chosen.triangle,
        rate: samples as f32 * chosen.probability,
    };
    Some((sampled, chosen.u))
}
