//! Reciprocity and closure imposed on a matrix that has errors.
//!
//! Exchange areas G_ij = A_i F_ij that are known with standard errors s_ij are changed as little as possible,
//!
//! Σ_{i≤j} (G'_ij − G_ij)²/s_ij² → least ,  G'_ij = G'_ji ,  Σ_j G'_ij = A_i ,  G'_ij ≥ 0
//!
//! With a multiplier λ for each row the solution is G'_ij = G_ij + s_ij² (λ_i + λ_j), and the rows' sums give the linear equations
//!
//! Σ_j s_ij² (λ_i + λ_j) = A_i − Σ_j G_ij
//!
//! whose matrix is symmetric and not negative; they are solved by conjugate gradients. A G' below 0 is set to 0 and kept there, and
//! the rest is solved again. Where a pair was found twice, independently, the two are first averaged by their weights. Factors known
//! exactly are not touched.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | G, G' | exchange areas before and after | m² |
//! | s | standard error of G; the weight is 1/s² | m² |
//! | λ | multipliers | 1/m² |
//!
//! Sources: J. van Leersum, Int. J. Heat Fluid Flow 10 (1), 1989, and R. P. Taylor & R. Luck, J. Thermophys. Heat Transfer 9 (4), 1995, for
//! least squares under both constraints; K. J. Daun, D. P. Morton & J. R. Howell, J. Heat Transfer 127 (8), 2005, for G ≥ 0.
//!
//! Smoothing hides no error: the standard errors of the factors stay those they were found with, and [`Smoothed`] tells the changes.

use std::collections::BTreeMap;

use super::row::Row;
use super::uncertain::{IndependentSum, Uncertain};
use crate::estimation::Method;

/// The equations are solved until their residual is this part of the areas.
const TOLERANCE: f64 = 1e-13;
const MOST_ITERATIONS: usize = 10_000;

/// How much was changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Smoothed {
    /// Sampled factors, of which there is one for each pair.
    pub factors: usize,
    /// Root mean square of the changes in standard errors: near or below 1 where the errors explain them.
    pub rms_deviation: f64,
    /// The greatest change in standard errors.
    pub greatest_deviation: f64,
    /// The greatest change of a factor.
    pub greatest_change: f64,
    /// Factors that would have become negative and are 0.
    pub zeroed: usize,
    /// What is left of the greatest |Σ_j F_ij − 1|: not 0 only if factors known exactly contradict closure.
    pub residual: f64,
}

/// A pair with its exchange area.
struct Pair {
    from: usize,
    to: usize,
    /// G and s².
    found: f64,
    variance: f64,
    fixed: bool,
    area: f64,
}

/// Makes the rows of a closed enclosure reciprocal and closed.
///
/// # Panics
/// If there are not as many areas as rows.
pub fn smooth(rows: &mut [Row], areas: &[f64]) -> Smoothed {
    assert_eq!(rows.len(), areas.len(), "an area for every row");
    let mut pairs = pairs(rows, areas);
    let mut report = Smoothed::default();
    loop {
        adjust(&mut pairs, areas);
        let negative = pairs.iter_mut().filter(|pair| pair.area < 0.0);
        let zeroed = negative
            .map(|pair| (pair.fixed, pair.area) = (true, 0.0))
            .count();
        report.zeroed += zeroed;
        if zeroed == 0 {
            break;
        }
    }
    tell(&pairs, areas, &mut report);
    write_back(rows, areas, &pairs);
    let sums = rows.iter().map(|row| (row.sum.value - 1.0).abs());
    report.residual = sums.fold(0.0, f64::max);
    report
}

/// Every pair once, with what is known of it.
fn pairs(rows: &[Row], areas: &[f64]) -> Vec<Pair> {
    let mut found: BTreeMap<(usize, usize), Vec<Uncertain>> = BTreeMap::new();
    for row in rows {
        for entry in &row.entries {
            let to = entry.to as usize;
            let pair = (row.from.min(to), row.from.max(to));
            found
                .entry(pair)
                .or_default()
                .push(entry.factor().scaled(areas[row.from]));
        }
    }
    let pair = |((from, to), found): ((usize, usize), Vec<Uncertain>)| {
        let best = mean(&found);
        let variance = best.std_error * best.std_error;
        Pair {
            from,
            to,
            found: best.value,
            variance,
            fixed: variance == 0.0,
            area: best.value,
        }
    };
    found.into_iter().map(pair).collect()
}

/// By the weights 1/s²; the same number twice is known no better than once.
fn mean(found: &[Uncertain]) -> Uncertain {
    let [one, other] = found else {
        return found[0];
    };
    let same = (one.value - other.value).abs() <= 1e-9 * one.value.abs();
    if same || one.std_error == 0.0 || other.std_error == 0.0 {
        return if other.std_error == 0.0 { *other } else { *one };
    }
    let weights = [one, other].map(|x| 1.0 / (x.std_error * x.std_error));
    let total = weights[0] + weights[1];
    let mut sum = IndependentSum::default();
    sum.add(*one, weights[0] / total);
    sum.add(*other, weights[1] / total);
    sum.total()
}

/// Solves for the multipliers and applies them to what is not fixed.
fn adjust(pairs: &mut [Pair], areas: &[f64]) {
    let mut missing = areas.to_vec();
    for pair in pairs.iter() {
        let area = if pair.fixed { pair.area } else { pair.found };
        missing[pair.from] -= area;
        if pair.to != pair.from {
            missing[pair.to] -= area;
        }
    }
    let lambda = conjugate_gradients(pairs, &missing, areas);
    for pair in pairs.iter_mut().filter(|pair| !pair.fixed) {
        pair.area = pair.found + pair.variance * step(pair, &lambda);
    }
}

/// λ_i + λ_j, or λ_i for a surface with itself, whose area counts in one row once.
fn step(pair: &Pair, lambda: &[f64]) -> f64 {
    match pair.from == pair.to {
        true => lambda[pair.from],
        false => lambda[pair.from] + lambda[pair.to],
    }
}

fn apply(pairs: &[Pair], lambda: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; lambda.len()];
    for pair in pairs.iter().filter(|pair| !pair.fixed) {
        let change = pair.variance * step(pair, lambda);
        sums[pair.from] += change;
        if pair.to != pair.from {
            sums[pair.to] += change;
        }
    }
    sums
}

/// Solves with the diagonal as preconditioner; rows without any error have no multiplier.
fn conjugate_gradients(pairs: &[Pair], right: &[f64], areas: &[f64]) -> Vec<f64> {
    let mut diagonal = vec![0.0; right.len()];
    for pair in pairs.iter().filter(|pair| !pair.fixed) {
        diagonal[pair.from] += pair.variance;
        if pair.to != pair.from {
            diagonal[pair.to] += pair.variance;
        }
    }
    let precondition = |r: &[f64]| -> Vec<f64> {
        r.iter()
            .zip(&diagonal)
            .map(|(r, d)| if *d > 0.0 { r / d } else { 0.0 })
            .collect()
    };
    let free = right.iter().zip(&diagonal);
    let mut residual: Vec<f64> = free.map(|(r, d)| if *d > 0.0 { *r } else { 0.0 }).collect();
    let mut x = vec![0.0; right.len()];
    let mut z = precondition(&residual);
    let mut direction = z.clone();
    let mut product = dot(&residual, &z);
    for _ in 0..MOST_ITERATIONS {
        let worst = residual.iter().zip(areas).map(|(r, a)| r.abs() / a);
        if worst.fold(0.0, f64::max) <= TOLERANCE {
            break;
        }
        let image = apply(pairs, &direction);
        let curvature = dot(&direction, &image);
        if curvature <= 0.0 {
            break;
        }
        let length = product / curvature;
        for i in 0..x.len() {
            x[i] += length * direction[i];
            residual[i] -= length * image[i];
        }
        z = precondition(&residual);
        let next = dot(&residual, &z);
        let turn = next / product;
        product = next;
        direction
            .iter_mut()
            .zip(&z)
            .for_each(|(d, z)| *d = z + turn * *d);
    }
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn tell(pairs: &[Pair], areas: &[f64], report: &mut Smoothed) {
    let mut squares = 0.0;
    for pair in pairs.iter().filter(|pair| pair.variance > 0.0) {
        let change = (pair.area - pair.found).abs();
        let deviation = change / pair.variance.sqrt();
        squares += deviation * deviation;
        report.factors += 1;
        report.greatest_deviation = report.greatest_deviation.max(deviation);
        let smaller = areas[pair.from].min(areas[pair.to]);
        report.greatest_change = report.greatest_change.max(change / smaller);
    }
    if report.factors > 0 {
        report.rms_deviation = (squares / report.factors as f64).sqrt();
    }
}

fn write_back(rows: &mut [Row], areas: &[f64], pairs: &[Pair]) {
    let by_surfaces: BTreeMap<(usize, usize), &Pair> = pairs
        .iter()
        .map(|pair| ((pair.from, pair.to), pair))
        .collect();
    for row in rows {
        for entry in row
            .entries
            .iter_mut()
            .filter(|entry| entry.method == Method::Estimate)
        {
            let to = entry.to as usize;
            if let Some(pair) = by_surfaces.get(&(row.from.min(to), row.from.max(to))) {
                entry.value = pair.area / areas[row.from];
            }
        }
        row.sum.value = row.entries.iter().map(|entry| entry.value).sum();
    }
}
