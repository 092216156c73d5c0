//! Checks of numbers at pairs of directions.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::Effort;
use super::chance::uniform_pairs;
use super::finding::{Check, Finding, Place};
use super::views::{polar, views};
use crate::brdf::{Brdf, Scatter};
use crate::geometry::Direction;
use crate::quantity::Spectrum;
use crate::sampling::hash::combine;

/// Kernels in double precision are symmetric but for rounding; values are rounded to single precision.
const ROUNDING: f64 = 1e-4;
/// Values below this are as good as 0, in 1/sr.
const NOTHING: f64 = 1e-9;
/// Angles to the horizon at which a cosine is tiny or 0.
const GRAZING: [f64; 4] = [0.0, 1e-12, 1e-6, 1e-3];

/// ρ, pdf, weights and shares are finite and not negative, on the horizon too.
pub fn values(model: &Brdf, effort: &Effort) -> Finding {
    let mut finding = Finding::new(Check::Values, 0.0);
    let mut bad = 0.0;
    let mut see = |numbers: &[f64], place: Place| {
        let wrong = numbers
            .iter()
            .filter(|x| !(x.is_finite() && **x >= 0.0))
            .count();
        bad += wrong as f64;
        if wrong > 0 || finding.place.is_none() {
            finding.see(bad, place);
        }
    };
    for (wo, wi) in pairs(model, effort).chain(grazing_pairs()) {
        let place = Place {
            wi: Some(wi),
            ..Place::view(wo)
        };
        see(&numbers(model.evaluate(wo, wi)), place);
        see(&[model.pdf(wo, wi)], place);
    }
    for (wo, wi) in grazing_pairs() {
        see(&numbers(model.albedo(wo)), Place::view(wo));
        see(&numbers(model.transmittance(wo)), Place::view(wo));
        let sampled = model.sample(wo, [0.3, 0.7]);
        let weight = sampled.map_or(Spectrum::ZERO, |scatter| scatter.weight());
        see(
            &numbers(weight),
            Place {
                wi: Some(wi),
                ..Place::view(wo)
            },
        );
    }
    finding.worst = bad;
    finding
}

/// ρ(a, b)/n_a² = ρ(b, a)/n_b² at directions from everywhere and at directions that the model draws.
pub fn reciprocity(model: &Brdf, effort: &Effort) -> Finding {
    let mut finding = Finding::new(Check::Reciprocity, ROUNDING);
    for (wo, wi) in pairs(model, effort) {
        let there = numbers(model.evaluate(wo, wi));
        let scale = model.radiance_scale(wo, wi);
        let back = numbers(model.evaluate(wi, wo)).map(|value| value * scale);
        for lane in 0..there.len() {
            let place = Place {
                wo,
                wi: Some(wi),
                lane: Some(lane),
            };
            finding.see(difference(there[lane], back[lane]), place);
        }
    }
    finding
}

/// A sample's value and density are those of `evaluate` and `pdf`.
pub fn agreement(model: &Brdf, effort: &Effort) -> Finding {
    let mut finding = Finding::new(Check::Agreement, ROUNDING);
    for (wo, scatter) in samples(model, effort) {
        let Scatter::Finite { wi, value, pdf } = scatter else {
            continue;
        };
        let place = Place {
            wi: Some(wi),
            ..Place::view(wo)
        };
        finding.see(difference(pdf, model.pdf(wo, wi)), place);
        let (told, evaluated) = (numbers(value), numbers(model.evaluate(wo, wi)));
        for lane in 0..told.len() {
            let place = Place {
                lane: Some(lane),
                ..place
            };
            finding.see(difference(told[lane], evaluated[lane]), place);
        }
    }
    finding
}

/// Relative to the larger of both.
fn difference(a: f64, b: f64) -> f64 {
    let largest = a.abs().max(b.abs());
    if largest < NOTHING {
        return 0.0;
    }
    (a - b).abs() / largest
}

/// Pairs of directions from everywhere, then pairs of a view and a direction drawn for it.
fn pairs<'a>(
    model: &'a Brdf,
    effort: &Effort,
) -> impl Iterator<Item = (Direction, Direction)> + 'a {
    let count = effort.samples / 16;
    let anywhere = |seed| uniform_pairs(combine(effort.seed, seed), count).map(direction);
    let free = anywhere(10).zip(anywhere(11));
    free.chain(samples(model, effort).map(|(wo, scatter)| (wo, scatter.wi())))
}

/// Samples of each view.
fn samples<'a>(
    model: &'a Brdf,
    effort: &Effort,
) -> impl Iterator<Item = (Direction, Scatter)> + 'a {
    let (seed, count) = (effort.seed, effort.samples / 16);
    views(model)
        .into_iter()
        .enumerate()
        .flat_map(move |(index, wo)| {
            let key = combine(combine(seed, 12), index as u64);
            uniform_pairs(key, count).filter_map(move |u| Some((wo, model.sample(wo, u)?)))
        })
}

/// Evenly from all directions.
fn direction([u, v]: [f64; 2]) -> Direction {
    let cos = 2.0 * u - 1.0;
    Direction::from_polar((1.0 - cos * cos).max(0.0).sqrt(), cos, TAU * v)
}

/// On the horizon and just above and below it, beside and across.
fn grazing_pairs() -> impl Iterator<Item = (Direction, Direction)> {
    let edges = GRAZING
        .into_iter()
        .flat_map(|angle| [FRAC_PI_2 - angle, FRAC_PI_2 + angle]);
    edges.flat_map(|theta| {
        let wo = polar(theta, 0.0);
        [(theta, 0.0), (theta, 3.0), (0.5, 1.0), (2.5, 1.0)]
            .map(|(theta, phi)| (wo, polar(theta, phi)))
    })
}

fn numbers(spectrum: Spectrum) -> [f64; Spectrum::LANES] {
    spectrum.to_lanes().map(f64::from)
}
