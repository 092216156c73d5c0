//! Statistics of a sensor with several points: mean, extremes and uniformities, each with its error.
//!
//! ```text
//! E̅ = (1/N) Σ Eᵢ      U₀ = E_min / E̅      U_d = E_min / E_max
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Eᵢ | reading at point i of N, each of which stands for the same area | that of the reading |
//! | U₀, U_d | uniformity of EN 12464-1 (3.14), and the same against the maximum, its *diversity* | – |
//!
//! Errors are those of the [jackknife](crate::estimation::jackknife) over replicates, for the mean that of its replicates. Minimum, maximum
//! and their ratios are biased: the least of noisy readings is on average too low, and where many points have nearly
//! the same reading its interval is too narrow by that. Compare the readings' own errors with what the points differ by.

use serde::Serialize;

use super::{Gathered, Measurements};
use crate::estimation::Estimate;

/// What the points of a sensor have in common.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Statistics {
    /// Name of the sensor.
    pub sensor: String,
    /// The field's name of the quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// Number of points.
    pub points: usize,
    /// The mean over the points.
    pub mean: Estimate,
    /// The least reading.
    pub min: Extreme,
    /// The greatest reading.
    pub max: Extreme,
    /// U₀ = minimum / mean; none where the mean is zero.
    pub uniformity: Option<Estimate>,
    /// U_d = minimum / maximum; none where the maximum is zero.
    pub diversity: Option<Estimate>,
    /// What each light group gives of the mean, by name.
    pub groups: Vec<(String, Estimate)>,
}

/// A least or greatest reading.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Extreme {
    /// Number of the point within the sensor.
    pub index: usize,
    /// Where, in metres.
    pub position: Option<[f64; 3]>,
    /// The value with its error; biased outwards.
    pub estimate: Estimate,
}

impl Measurements {
    /// The statistics of every quantity of each sensor that has several points.
    pub fn statistics(&self) -> Vec<Statistics> {
        Gathered::of(self).statistics()
    }
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Number of the least value, the first of equal ones.
pub(super) fn lowest(values: &[f64]) -> usize {
    (0..values.len()).fold(0, |best, i| if values[i] < values[best] { i } else { best })
}

/// Number of the greatest value, the first of equal ones.
pub(super) fn highest(values: &[f64]) -> usize {
    (0..values.len()).fold(0, |best, i| if values[i] > values[best] { i } else { best })
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::Synthetic;
    use super::*;
    use crate::estimation::Method;

    /// 2, 4, 6 lx without error: mean 4, U₀ = ½, U_d = ⅓.
    #[test]
    fn closed_forms_have_exact_statistics() {
        let run = Synthetic::new(&["lamp"], &[[2.0], [4.0], [6.0]]).closed();
        let found = &run.statistics()[0];
        assert_eq!(found.mean, Estimate::closed_form(4.0));
        assert_eq!((found.min.index, found.max.index), (0, 2));
        assert_eq!(found.min.estimate.value, 2.0);
        assert_eq!(found.uniformity.map(|u| u.value), Some(0.5));
        assert_eq!(found.diversity.map(|u| u.value), Some(2.0 / 6.0));
        assert_eq!(found.diversity.map(|u| u.method), Some(Method::ClosedForm));
    }

    /// Groups of 1 lx and of 3 lx in the mean, each 10 % off at each of 4 points and 16 replicates: they add up to the mean, and each has the
    /// error of its own replicates, .1 √((1² + 1² + 1² + 1²)/16)/4 = .0125 and three times that, which 15 · 4 squares know to 9 %: five of these.
    #[test]
    fn groups_have_their_part_of_the_mean_with_its_error() {
        let run = Synthetic::new(&["lamp", "window"], &[[1.0, 3.0]; 4]).sampled(5, 0.1);
        let found = &run.statistics()[0];
        let names: Vec<_> = found.groups.iter().map(|(name, _)| &name[..]).collect();
        assert_eq!(names, ["lamp", "window"]);
        let sum: f64 = found.groups.iter().map(|(_, part)| part.value).sum();
        assert!((sum - found.mean.value).abs() < 1e-12);
        for ((_, part), truth) in found.groups.iter().zip([1.0, 3.0]) {
            assert!(
                (part.std_error / (0.0125 * truth) - 1.0).abs() < 0.45,
                "{part:?}"
            );
            assert!(
                (part.value - truth).abs() < 5.0 * part.std_error,
                "{part:?}"
            );
        }
    }

    #[test]
    fn a_single_point_has_none() {
        let run = Synthetic::new(&["lamp"], &[[2.0]]).closed();
        assert!(run.statistics().is_empty());
    }

    /// Of points whose errors are independent the variance of the mean is that of a point over their number.
    #[test]
    fn independent_points_have_a_better_mean() {
        let mut squares = 0.0;
        for seed in 0..200 {
            let run = Synthetic::new(&["lamp"], &[[10.0]; 25]).sampled(seed, 0.1);
            let error = run.statistics()[0].mean.std_error;
            squares += error * error / 200.0;
        }
        // One over √(16 · 25); 200 · 15 squares know it to 1.3 %: five of these.
        assert!((squares.sqrt() * 20.0 - 1.0).abs() < 0.065, "{squares}");
    }

    /// Of 2 000 intervals that hold with probability .95, 1 850 to 1 945 hold but for a probability of 2e-6.
    #[test]
    fn intervals_hold_the_truth() {
        // The points lie far apart against their errors of 1 %/√16.
        let truth = [[2.0], [3.0], [5.0]];
        let expected = [10.0 / 3.0, 2.0, 5.0, 0.6, 0.4];
        let mut held = [0; 5];
        for seed in 0..2000 {
            let run = Synthetic::new(&["lamp"], &truth).sampled(seed, 0.01);
            let found = &run.statistics()[0];
            let estimates = [
                found.mean,
                found.min.estimate,
                found.max.estimate,
                found.uniformity.unwrap(),
                found.diversity.unwrap(),
            ];
            for (held, (found, truth)) in held.iter_mut().zip(estimates.iter().zip(expected)) {
                let [low, high] = found.interval.unwrap();
                *held += usize::from(low <= truth && truth <= high);
            }
        }
        assert!(
            held.iter().all(|held| (1850..=1945).contains(held)),
            "{held:?}"
        );
    }
}
