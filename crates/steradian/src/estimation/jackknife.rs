//! The error of a number that is no sum of columns: a minimum, a ratio, a solution of equations.
//!
//! If θ is a function of means over R independent replicates, and θ₍ᵣ₎ is the same function with replicate r left out, then
//!
//! ```text
//! std_error² = (R − 1)/R · Σᵣ (θ₍ᵣ₎ − θ̄)² ,     θ̄ = (1/R) Σᵣ θ₍ᵣ₎
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | θ | the number | its own |
//! | R | replicates | – |
//!
//! (Efron & Stein 1981, *The jackknife estimate of variance*, eq. 1.6; Miller 1974, *The jackknife — a review*, for the interval by
//! Student's t with R − 1 degrees of freedom.) For a linear θ this is exactly the spread of the replicates. It holds for
//! smooth functions; for a minimum of points that lie within each other's errors it is a rough one, and the value itself is
//! biased: noise makes minima lower and maxima higher.

use super::{Estimate, student};

/// The estimate of a number from its values with each replicate left out in turn.
///
/// ```
/// // Means 1, 2, 3, 4: the mean of the other three is 3, 8/3, 7/3, 2, and the error √(5/12) that of four means.
/// let without = [3.0, 8.0 / 3.0, 7.0 / 3.0, 2.0];
/// let mean = steradian::estimation::jackknife(2.5, &without, 0.95, true);
/// assert!((mean.std_error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
/// ```
#[must_use]
pub fn jackknife(value: f64, without: &[f64], confidence: f64, converged: bool) -> Estimate {
    let count = without.len() as f64;
    if without.len() < 2 {
        return Estimate::sampled(value, f64::INFINITY, 1.0, false);
    }
    let mean = without.iter().sum::<f64>() / count;
    let squares: f64 = without.iter().map(|x| (x - mean) * (x - mean)).sum();
    let std_error = ((count - 1.0) / count * squares).sqrt();
    let factor = student::two_sided_quantile(confidence, without.len() as u32 - 1);
    Estimate::sampled(value, std_error, factor, converged)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_replicate_tells_no_error() {
        let alone = jackknife(3.0, &[3.0], 0.95, true);
        assert!(alone.std_error.is_infinite() && alone.interval.is_none() && !alone.converged);
    }

    /// d(1/x) = −dx/x², and 1e-4 of second order.
    #[test]
    fn a_smooth_function_has_the_error_of_its_slope() {
        let means = [99.0, 100.0, 101.0, 100.0];
        let sum: f64 = means.iter().sum();
        let mean_without: Vec<f64> = means.iter().map(|mean| (sum - mean) / 3.0).collect();
        let inverse_without: Vec<f64> = mean_without.iter().map(|mean| 1.0 / mean).collect();
        let mean = jackknife(100.0, &mean_without, 0.95, true);
        let inverse = jackknife(0.01, &inverse_without, 0.95, true);
        assert!((inverse.std_error / (mean.std_error * 1e-4) - 1.0).abs() < 1e-4);
    }
}
