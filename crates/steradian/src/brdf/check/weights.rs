//! The mean weight of samples against the albedo and the transmittance.
//!
//! Sixteen randomised quasi-Monte Carlo replicates give E[ρ |cosθ_i|/pdf], as a share of power, with a standard error; it may be off by Student's
//! quantile times that, by what is known of the albedo, and by what rare draws can hide: of N draws, a part of ln(1/α)/N
//! is missed with probability α.

use super::Effort;
use super::chance::share_of_alarms;
use super::energy::SHARE_ERROR;
use super::finding::{Check, Finding, Place};
use super::views::views;
use crate::brdf::Brdf;
use crate::estimation::student::two_sided_quantile;
use crate::geometry::Direction;
use crate::quantity::Spectrum;
use crate::sampling::block;
use crate::sampling::hash::combine;

const REPLICATES: u32 = 16;

/// E(weight) of one view, as shares of power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanWeight {
    /// Of light that stays on the side of d_e, lane by lane.
    pub reflected: [f64; 4],
    /// Of light that goes through.
    pub transmitted: [f64; 4],
    /// Standard errors of both.
    pub std_error: [[f64; 4]; 2],
    /// Standard error of their sum, which is not that of its parts: what is not reflected is transmitted.
    pub sum_error: [f64; 4],
    /// The largest weight drawn.
    pub largest: f64,
}

/// E(weight) of one view.
pub fn mean_weights(model: &Brdf, wo: Direction, effort: &Effort) -> MeanWeight {
    let mut largest = 0.0_f64;
    let means: Vec<[f64; 8]> = (0..REPLICATES)
        .map(|replicate| {
            let key = combine(combine(effort.seed, 40), u64::from(replicate));
            replicate_mean(model, wo, key, effort.samples / REPLICATES, &mut largest)
        })
        .collect();
    let of = |part: &dyn Fn(&[f64; 8]) -> f64| mean_and_error(means.iter().map(part));
    let both = [0, 1].map(|side| lanes(|lane| of(&|mean| mean[4 * side + lane])));
    MeanWeight {
        reflected: both[0].map(|(mean, _)| mean),
        transmitted: both[1].map(|(mean, _)| mean),
        std_error: both.map(|side| side.map(|(_, error)| error)),
        sum_error: lanes(|lane| of(&|mean| mean[lane] + mean[4 + lane]).1),
        largest,
    }
}

fn lanes<T>(of: impl FnMut(usize) -> T) -> [T; 4] {
    std::array::from_fn(of)
}

/// Of independent replicates.
fn mean_and_error(means: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = f64::from(REPLICATES);
    let mean = means.clone().sum::<f64>() / count;
    let squares: f64 = means.map(|x| (x - mean) * (x - mean)).sum();
    (mean, (squares / (count * (count - 1.0))).sqrt())
}

/// Reflected lanes, then transmitted ones.
fn replicate_mean(
    model: &Brdf,
    wo: Direction,
    key: u64,
    samples: u32,
    largest: &mut f64,
) -> [f64; 8] {
    let mut sum = [0.0; 8];
    for index in 0..samples {
        let [u, v, ..] = block::sample(key, index, 0).map(f64::from);
        let Some(scatter) = model.sample(wo, [u, v]) else {
            continue;
        };
        let first = if scatter.is_transmitted(wo) { 4 } else { 0 };
        let scale = 1.0 / model.radiance_scale(wo, scatter.wi());
        for (lane, weight) in scatter.weight().to_lanes().into_iter().enumerate() {
            let share = f64::from(weight) * scale;
            *largest = largest.max(share);
            sum[first + lane] += share;
        }
    }
    sum.map(|sum| sum / f64::from(samples))
}

/// E(weight) of every view is its albedo on this side, and its transmittance on the other.
pub fn mean_weight(model: &Brdf, effort: &Effort) -> Finding {
    let views = views(model);
    let alarms = share_of_alarms(effort.false_alarms, views.len() * 8);
    let mut finding = Finding::new(Check::MeanWeight, 1.0);
    for wo in views {
        let found = mean_weights(model, wo, effort);
        let allowed = |std_error: f64| {
            two_sided_quantile(1.0 - alarms, REPLICATES - 1) * std_error + SHARE_ERROR
                - found.largest.max(1.0) * libm::log(alarms) / f64::from(effort.samples)
        };
        let sides = [
            (found.reflected, model.albedo(wo), found.std_error[0]),
            (
                found.transmitted,
                model.transmittance(wo),
                found.std_error[1],
            ),
        ];
        for (mean, share, std_error) in sides {
            for lane in 0..Spectrum::LANES {
                let off = (mean[lane] - f64::from(share.to_lanes()[lane])).abs();
                let place = Place {
                    lane: Some(lane),
                    ..Place::view(wo)
                };
                finding.see(off / allowed(std_error[lane]), place);
            }
        }
    }
    finding
}
