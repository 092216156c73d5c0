//! What statistical tests share: independent samples and the χ² test.

use super::block;
use super::hash::combine;

/// Pairs of uniform numbers, independent because each is the first of a stream of its own.
pub(crate) fn independent(seed: u64, count: u64) -> impl Iterator<Item = [f64; 2]> {
    let first = move |stream| block::sample(combine(seed, stream), 0, 0);
    (0..count).map(move |stream| {
        let [u, v, ..] = first(stream).map(f64::from);
        [u, v]
    })
}

/// How often each of `cells` numbers occurs.
pub(crate) fn histogram(cells: usize, numbers: impl Iterator<Item = usize>) -> Vec<u64> {
    let mut counts = vec![0; cells];
    numbers.for_each(|cell| counts[cell] += 1);
    counts
}

/// The cell of a point of the unit square in a grid of `n` × `n` cells.
pub(crate) fn grid_cell([s, t]: [f64; 2], n: usize) -> usize {
    let along = |x: f64| ((x * n as f64) as usize).min(n - 1);
    along(s) * n + along(t)
}

/// Refuses counts that differ from cells of these relative sizes by more than six standard deviations of χ²: with at
/// least 30 cells a false alarm has a probability below 1e-6, and the seed is fixed.
#[track_caller]
pub(crate) fn assert_proportional(counts: &[u64], sizes: &[f64]) {
    assert_eq!(counts.len(), sizes.len());
    let samples: u64 = counts.iter().sum();
    let scale = samples as f64 / sizes.iter().sum::<f64>();
    let term = |(count, size): (&u64, &f64)| {
        let expected = size * scale;
        (*count as f64 - expected) * (*count as f64 - expected) / expected
    };
    let chi_squared: f64 = counts.iter().zip(sizes).map(term).sum();
    let freedom = counts.len() as f64 - 1.0;
    let limit = freedom + 6.0 * (2.0 * freedom).sqrt();
    assert!(
        chi_squared < limit,
        "χ² {chi_squared} > {limit}: {counts:?}"
    );
}

/// Refuses a mean that is more than six standard errors, and `rounding`, off.
#[track_caller]
pub(crate) fn assert_mean(samples: &[f64], expected: f64, rounding: f64) {
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    let squares: f64 = samples.iter().map(|x| (x - mean) * (x - mean)).sum();
    let error = (squares / (count * (count - 1.0))).sqrt();
    assert!(
        (mean - expected).abs() <= 6.0 * error + rounding,
        "{mean} ± {error}, expected {expected}"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(bend: f64) -> Vec<u64> {
        let bent = independent(1, 65_536).map(move |[u, v]| [u * (1.0 - bend * (1.0 - u)), v]);
        histogram(64, bent.map(|point| grid_cell(point, 8)))
    }

    #[test]
    fn uniform_counts_and_true_means_pass() {
        assert_proportional(&cells(0.0), &[1.0; 64]);
        let numbers: Vec<_> = independent(2, 4096).map(|[u, _]| u).collect();
        assert_mean(&numbers, 0.5, 0.0);
    }

    #[test]
    #[should_panic = "χ²"]
    fn a_density_that_varies_by_ten_per_cent_is_refused() {
        assert_proportional(&cells(0.05), &[1.0; 64]);
    }

    #[test]
    #[should_panic = "expected"]
    fn a_mean_that_is_off_by_seven_errors_is_refused() {
        // σ = 1/√12, so that 7σ/√4096 = .0316.
        let numbers: Vec<_> = independent(2, 4096).map(|[u, _]| u).collect();
        assert_mean(&numbers, 0.54, 0.0);
    }
}
