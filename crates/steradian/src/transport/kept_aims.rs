//! How the emitters are aimed at from the last meter: prepared once, however many of its samples choose them.
//!
//! A meter that stays where it is samples few of many lamps again and again, those that bring it most. Each of the aims kept has a place of its own
//! by the number of its emitter, which another one may take; so memory is bounded, and used again. What is kept changes no result.
//!
//! Tables for many samples take as long as some dozens of them: they are made for lamps that are chosen as often in a batch in the mean, whatever
//! has been chosen so far.

use super::aim::{Aim, Scratch, is_aimed_at};
use super::choice::Sampled;
use super::columns::{BATCH, Place};
use super::tables::Tables;

/// Aims kept, a power of two.
const KEPT: usize = 256;

/// Samples in the mean of a batch that are worth tables.
const MANY: f32 = 32.0;

/// A meter.
#[derive(Copy, Clone, PartialEq)]
pub(super) struct Meter {
    pub place: Place,
    /// Where its rays start.
    pub start: [f32; 3],
    /// Whether it takes light from the whole sphere, not foreshortened.
    pub is_spherical: bool,
    /// Whether it stays there for many samples.
    pub is_still: bool,
}

/// Aims from one meter.
#[derive(Default)]
pub(super) struct KeptAims {
    meter: Option<Meter>,
    /// Of this meter: what was kept in another round is of no use.
    round: u64,
    /// By the last digits of the emitters' numbers.
    kept: Vec<Kept>,
    scratch: Scratch,
}

#[derive(Default)]
struct Kept {
    /// Round and number of the emitter.
    of: (u64, usize),
    is_aimed_at: bool,
    aim: Aim,
}

impl KeptAims {
    /// How an emitter is aimed at from a meter; `None` where that cannot be done.
    pub fn at(&mut self, meter: &Meter, tables: &Tables<'_>, sampled: Sampled) -> Option<&Aim> {
        let number = sampled.number;
        if self.meter != Some(*meter) {
            self.meter = Some(*meter);
            self.round += 1;
        }
        let place = number % KEPT;
        if place >= self.kept.len() {
            self.kept.resize_with(place + 1, Kept::default);
        }
        let kept = &mut self.kept[place];
        if kept.of != (self.round, number) {
            kept.of = (self.round, number);
            kept.turn(meter, tables, sampled, &mut self.scratch);
        }
        kept.is_aimed_at.then_some(&kept.aim)
    }
}

impl Kept {
    fn turn(
        &mut self,
        meter: &Meter,
        tables: &Tables<'_>,
        sampled: Sampled,
        scratch: &mut Scratch,
    ) {
        let emitter = &tables.emitters[sampled.number];
        self.is_aimed_at = is_aimed_at(tables, emitter, meter.start);
        if self.is_aimed_at {
            let from = (&meter.place, meter.is_spherical);
            self.aim.turn(tables, emitter, from, scratch);
            if meter.is_still && sampled.rate * BATCH as f32 >= MANY {
                self.aim.prepare();
            }
        }
    }
}
