//! What statistical tests share: independent samples and the χ² test.

use super::block;
use super::hash::combine;
use crate::geometry::{Direction, Frame, Vector};

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

/// Refuses points of the plane that are not uniform over the region that `inside` accepts, by χ² against the midpoint rule.
///
/// The box around the points is divided into 12 × 12 cells of 48 × 48 midpoints each; cells of which less than a tenth belongs
/// to the region are left out, as the rule is uncertain there. What lies outside the box is not seen: compare the region's
/// size with the sampler's own as well.
#[track_caller]
pub(crate) fn assert_uniform(
    points: impl Iterator<Item = [f64; 2]>,
    inside: impl Fn([f64; 2]) -> bool,
) {
    const CELLS: usize = 12;
    const MIDPOINTS: usize = 48;
    let points: Vec<_> = points.collect();
    let fold = |start: f64, of: fn(f64, f64) -> f64| {
        points
            .iter()
            .fold([start; 2], |best, p| [of(best[0], p[0]), of(best[1], p[1])])
    };
    let (low, high) = (
        fold(f64::INFINITY, f64::min),
        fold(f64::NEG_INFINITY, f64::max),
    );
    let scaled = |p: &[f64; 2]| [0, 1].map(|k| (p[k] - low[k]) / (high[k] - low[k]));
    let counts = histogram(
        CELLS * CELLS,
        points.iter().map(|p| grid_cell(scaled(p), CELLS)),
    );
    let fine = CELLS * MIDPOINTS;
    let at = |i: usize, k: usize| low[k] + (high[k] - low[k]) * (i as f64 + 0.5) / fine as f64;
    let mut sizes = vec![0.0; CELLS * CELLS];
    for (i, j) in (0..fine).flat_map(|i| (0..fine).map(move |j| (i, j))) {
        if inside([at(i, 0), at(j, 1)]) {
            sizes[i / MIDPOINTS * CELLS + j / MIDPOINTS] += 1.0;
        }
    }
    let kept = |cell: &usize| sizes[*cell] >= 0.1 * (MIDPOINTS * MIDPOINTS) as f64;
    let kept: Vec<_> = (0..CELLS * CELLS).filter(kept).collect();
    let of = |cell: &usize| (counts[*cell], sizes[*cell]);
    let (counts, sizes): (Vec<_>, Vec<_>) = kept.iter().map(of).unzip();
    assert_proportional(&counts, &sizes);
}

/// Lambert's equal-area map of the sphere around the middle of some directions: solid angles become areas.
pub(crate) struct EqualArea(Frame);

impl EqualArea {
    pub fn around(vectors: &[Vector]) -> Self {
        let unit = |v: &Vector| *v / v.length();
        let middle = vectors
            .iter()
            .map(unit)
            .fold(Vector::ZERO, |sum, v| sum + v);
        Self(Frame::from_normal(
            Direction::new(middle).expect("directions that do not cancel"),
        ))
    }

    pub fn to_plane(&self, direction: Vector) -> [f64; 2] {
        let d = self.0.vector_to_local(direction / direction.length());
        let scale = (2.0 / (1.0 + d.z)).sqrt();
        [d.x * scale, d.y * scale]
    }

    pub fn direction_at(&self, [x, y]: [f64; 2]) -> Option<Vector> {
        let squared = x * x + y * y;
        let scale = (1.0 - 0.25 * squared).max(0.0).sqrt();
        let local = Vector::new(x * scale, y * scale, 1.0 - 0.5 * squared);
        (squared < 4.0).then(|| self.0.vector_to_world(local))
    }
}

/// Azimuth and z² of a direction: areas of these coordinates are twice its projected solid angles.
pub(crate) fn to_projected(d: Vector) -> [f64; 2] {
    [libm::atan2(d.y, d.x), d.z * d.z]
}

/// The direction above the horizon with these coordinates.
pub(crate) fn from_projected([azimuth, squared]: [f64; 2]) -> Vector {
    let (sin, cos) = libm::sincos(azimuth);
    let r = (1.0 - squared).sqrt();
    Vector::new(r * cos, r * sin, squared.sqrt())
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
