//! Which emitter a place samples: by power where there are few, by what it may bring to the place where there are many.

use super::columns::Place;
use super::light_tree::Receiving;
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
    /// A direction towards it.
    pub fn towards(&self, tables: &Tables, place: &Place, u: [f32; 2]) -> Option<Towards> {
        let emitter = &tables.emitters[self.number];
        match self.triangle {
            Some(triangle) => towards_triangle(tables, emitter, triangle, (place, u)),
            None => towards(tables, emitter, place, u),
        }
    }
}

/// One of the candidates by power or by importance, and the number that is left to use; none where none may contribute.
///
/// The first number is that of one of so many strata. The second one serves to refine it, as its 24 bits do not part many lights and then
/// the points of one.
pub(super) fn choose(
    tables: &Tables,
    candidates: Candidates,
    ([u, v], (stratum, strata)): ([f32; 2], (u32, u32)),
    at: impl FnOnce() -> Receiving,
) -> Option<(Sampled, f32)> {
    let Choice::ByImportance { samples } = candidates.choice else {
        return Some(by_power(tables, candidates, u));
    };
    let fine = f64::from(hash::mix_32(v.to_bits())) * 0.5_f64.powi(56);
    let u = (f64::from(stratum) + f64::from(u) + fine) / f64::from(strata);
    let chosen = tables.selection(candidates)?.choose(&at(), u)?;
    let sampled = Sampled {
        number: chosen.emitter,
        triangle: chosen.triangle,
        rate: samples as f32 * chosen.probability,
    };
    Some((sampled, chosen.u))
}

/// One of the candidates by power.
pub(super) fn by_power(tables: &Tables, candidates: Candidates, u: f32) -> (Sampled, f32) {
    let count = candidates.count;
    let sampled = |number| Sampled {
        number,
        triangle: None,
        rate: tables.rate_by_power(candidates, number),
    };
    if count == 1 {
        return (sampled(0), u);
    }
    let u = u * tables.cumulative[count - 1];
    let index = tables
        .cumulative
        .partition_point(|sum| *sum <= u)
        .min(count - 1);
    let before = if index == 0 {
        0.0
    } else {
        tables.cumulative[index - 1]
    };
    let rest = (u - before) / tables.emitters[index].probability;
    (sampled(index), rest.clamp(0.0, 1.0 - 0.5 * f32::EPSILON))
}
