//! Directions drawn against the density that is told for them, by χ².
//!
//! The cells cover the whole sphere; one more cell holds the draws without a direction and those of smooth surfaces, of which
//! 1 − ∫ pdf dω is expected. Cells of less than ten expected draws are taken together with it.

use super::Effort;
use super::chance::{normal_limit, normal_of_chi_squared, share_of_alarms, uniform_pairs};
use super::density::{Share, Spot, shares};
use super::finding::{Check, Finding, Place};
use super::views::views;
use crate::brdf::{Brdf, Scatter};
use crate::geometry::Direction;
use crate::sampling::hash::combine;

/// ∫ pdf is known to about this, as it is needed for the rest.
const QUADRATURE_ERROR: f64 = 1e-4;
/// What the integral of a density may exceed 1 by.
const INTEGRAL_ERROR: f64 = 1e-3;
/// A cell holds at most one of this many draws of the pilot.
const CELLS: usize = 96;
const FEWEST: f64 = 10.0;

/// The integral of the density, and χ² of the samples of each view.
pub fn sampling(model: &Brdf, effort: &Effort) -> [Finding; 2] {
    let views = views(model);
    let alarms = share_of_alarms(effort.false_alarms, views.len());
    let mut density = Finding::new(Check::Density, 1.0 + INTEGRAL_ERROR);
    let mut sampling = Finding::new(Check::Sampling, normal_limit(alarms));
    for (index, &wo) in views.iter().enumerate() {
        let key = combine(effort.seed, 20 + index as u64);
        let shares = shares_of(model, wo, key, effort.samples);
        let integral = shares.iter().map(|share| share.expected).sum();
        density.see(integral, Place::view(wo));
        sampling.see(excess(&shares, effort.samples), Place::view(wo));
    }
    [density, sampling]
}

fn shares_of(model: &Brdf, wo: Direction, key: u64, samples: u32) -> Vec<Share> {
    let draw = |key: u64, count: u32| -> Vec<Spot> {
        let scatters = uniform_pairs(key, count).filter_map(|u| model.sample(wo, u));
        let finite = scatters.filter(|scatter| matches!(scatter, Scatter::Finite { .. }));
        finite.map(|scatter| Spot::of(scatter.wi())).collect()
    };
    let pilot = draw(combine(key, 1), samples / 4);
    let drawn = draw(combine(key, 2), samples);
    shares(
        &|wi| model.pdf(wo, wi),
        &pilot,
        &drawn,
        samples as usize / 4 / CELLS,
    )
}

/// χ² as standard deviations; the variance of the rest includes the error of the quadrature.
pub(super) fn excess(shares: &[Share], samples: u32) -> f64 {
    let samples = f64::from(samples);
    let (mut sum, mut used) = (0.0, 0.0);
    let mut rest = [samples, samples];
    for share in shares {
        let [found, expected] = [share.found as f64, share.expected * samples];
        if !expected.is_finite() {
            return f64::INFINITY;
        }
        if expected >= FEWEST {
            rest = [rest[0] - found, rest[1] - expected];
            sum += term(found, expected);
            used += 1.0;
        }
    }
    let off = rest[0] - rest[1];
    let variance = rest[1].max(1.0) + (QUADRATURE_ERROR * samples) * (QUADRATURE_ERROR * samples);
    normal_of_chi_squared(sum + off * off / variance, used + 1.0)
}

fn term(found: f64, expected: f64) -> f64 {
    (found - expected) * (found - expected) / expected
}
