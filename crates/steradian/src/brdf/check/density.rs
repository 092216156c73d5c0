//! Cells of the sphere that follow a density, and the density's share in each.
//!
//! A side of the surface is a rectangle in 1 − |cosθ| and φ, in which equal areas are equal solid angles, and whose edge is the
//! horizon. It is halved across its longer side, as measured on the sphere, until a cell holds few of a pilot's directions:
//! cells of a sharp lobe are small, whatever its width. The share of a cell is ∫ pdf dω by Gauss's rule of order 5, halved in both
//! directions until it no longer changes, and on towards any direction drawn where the density is so high that the rule cannot have
//! seen it: the rim of a cell may hold the edge of a streak that lies between all its nodes.

use std::f64::consts::TAU;

use crate::geometry::{Direction, gauss};

const ORDER: usize = 5;
/// Parts of a cell's share, and of 1, that may be missed.
const RELATIVE: f64 = 2e-4;
const ABSOLUTE: f64 = 1e-6;
/// Enough for the edges of tabulated patches.
const DEEPEST_RULE: u32 = 7;
/// Levels more towards what the rule cannot have seen: cells there are as small as 2⁻¹⁶ of a leaf.
const DEEPER: u32 = 9;
/// A density this many times the mean of its cell was not seen.
const STEEPEST: f64 = 8.0;
const DEEPEST_CELL: u32 = 64;

/// A direction by its side (false: above), 1 − |cosθ| and φ in 0 … 2π.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    below: bool,
    at: [f64; 2],
}

impl Spot {
    pub(super) fn of(direction: Direction) -> Self {
        let [x, y, z] = direction.to_array();
        let turn = libm::atan2(y, x);
        let phi = if turn < 0.0 { turn + TAU } else { turn };
        Self {
            below: z < 0.0,
            at: [(x * x + y * y) / (1.0 + z.abs()), phi],
        }
    }

    fn direction(&self) -> Direction {
        let [u, phi] = self.at;
        let z = if self.below { u - 1.0 } else { 1.0 - u };
        Direction::from_polar(sin_of(u), z, phi)
    }
}

/// A part of one side.
#[derive(Clone, Copy, Debug)]
struct Cell {
    below: bool,
    low: [f64; 2],
    high: [f64; 2],
}

/// How many directions came to a cell, and which part of all directions is expected there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Share {
    pub found: usize,
    pub expected: f64,
}

/// Cells in which at most `most` of the pilot's directions lie, with the counts of `drawn` and the shares of `pdf`.
pub(super) fn shares(
    pdf: &impl Fn(Direction) -> f64,
    pilot: &[Spot],
    drawn: &[Spot],
    most: usize,
) -> Vec<Share> {
    let mut shares = Vec::new();
    for below in [false, true] {
        let side = Cell {
            below,
            low: [0.0; 2],
            high: [1.0, TAU],
        };
        let of_side = |spots: &[Spot]| {
            spots
                .iter()
                .copied()
                .filter(|spot| spot.below == below)
                .collect()
        };
        side.divide(
            pdf,
            (of_side(pilot), of_side(drawn)),
            (most, DEEPEST_CELL),
            &mut shares,
        );
    }
    shares
}

impl Cell {
    fn divide(
        &self,
        pdf: &impl Fn(Direction) -> f64,
        (pilot, drawn): (Vec<Spot>, Vec<Spot>),
        (most, depth): (usize, u32),
        shares: &mut Vec<Share>,
    ) {
        if pilot.len() <= most || depth == 0 {
            let witness = |spot: &Spot| (*spot, pdf(spot.direction()));
            let witnesses: Vec<_> = pilot.iter().chain(&drawn).map(witness).collect();
            shares.push(Share {
                found: drawn.len(),
                expected: self.refined(pdf, self.by_rule(pdf), &witnesses, 0),
            });
            return;
        }
        let axis = self.longer_side();
        let middle = 0.5 * (self.low[axis] + self.high[axis]);
        let lower = |spot: &Spot| spot.at[axis] < middle;
        let (pilot, drawn) = (split(pilot, lower), split(drawn, lower));
        for (half, spots) in self
            .halves(axis)
            .into_iter()
            .zip([(pilot.0, drawn.0), (pilot.1, drawn.1)])
        {
            half.divide(pdf, spots, (most, depth - 1), shares);
        }
    }

    fn halves(&self, axis: usize) -> [Self; 2] {
        let middle = 0.5 * (self.low[axis] + self.high[axis]);
        let (mut lower, mut upper) = (*self, *self);
        (lower.high[axis], upper.low[axis]) = (middle, middle);
        [lower, upper]
    }

    /// 0 if the cell is longer along the meridian, else 1.
    fn longer_side(&self) -> usize {
        let theta = |u: f64| libm::acos(1.0 - u);
        let along = theta(self.high[0]) - theta(self.low[0]);
        let across = sin_of(self.high[0]) * (self.high[1] - self.low[1]);
        usize::from(across > along)
    }

    /// The sum of the quarters, as soon as it is what the whole gave and as high as where `witnesses` of the density stand.
    fn refined(
        &self,
        pdf: &impl Fn(Direction) -> f64,
        whole: f64,
        witnesses: &[(Spot, f64)],
        depth: u32,
    ) -> f64 {
        let quarters = self.halves(0).map(|half| half.halves(1));
        let parts = quarters.as_flattened();
        let found: Vec<f64> = parts.iter().map(|part| part.by_rule(pdf)).collect();
        let sum: f64 = found.iter().sum();
        let settled = (sum - whole).abs() <= RELATIVE * sum.abs() + ABSOLUTE;
        let goes_on = if depth < DEEPEST_RULE {
            !settled || self.overlooks(witnesses, sum)
        } else {
            depth < DEEPEST_RULE + DEEPER && self.overlooks(witnesses, sum)
        };
        if !goes_on {
            return sum;
        }
        let refine = |(part, found): (&Self, f64)| {
            let inside = witnesses.iter().filter(|(spot, _)| part.holds(spot));
            let inside: Vec<_> = inside.copied().collect();
            part.refined(pdf, found, &inside, depth + 1)
        };
        parts.iter().zip(found).map(refine).sum()
    }

    /// Whether the density is much higher somewhere than the integral makes it on average.
    fn overlooks(&self, witnesses: &[(Spot, f64)], integral: f64) -> bool {
        let peak = witnesses
            .iter()
            .map(|(_, density)| *density)
            .fold(0.0, f64::max);
        peak * self.solid_angle() > STEEPEST * integral
    }

    fn solid_angle(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }

    fn holds(&self, spot: &Spot) -> bool {
        (0..2).all(|k| self.low[k] <= spot.at[k] && spot.at[k] < self.high[k])
    }

    fn by_rule(&self, pdf: &impl Fn(Direction) -> f64) -> f64 {
        let half = [0, 1].map(|k| 0.5 * (self.high[k] - self.low[k]));
        let at = |k: usize, node: f64| self.low[k] + half[k] * (1.0 + node);
        let rule = gauss::rule(ORDER);
        let mut sum = 0.0;
        for &(node, weight) in rule {
            let u = at(0, node);
            for &(other, other_weight) in rule {
                let spot = Spot {
                    below: self.below,
                    at: [u, at(1, other)],
                };
                sum += weight * other_weight * pdf(spot.direction());
            }
        }
        sum * half[0] * half[1]
    }
}

/// sinθ of 1 − cosθ.
fn sin_of(u: f64) -> f64 {
    (u * (2.0 - u)).max(0.0).sqrt()
}

fn split(spots: Vec<Spot>, lower: impl Fn(&Spot) -> bool) -> (Vec<Spot>, Vec<Spot>) {
    spots.into_iter().partition(lower)
}
