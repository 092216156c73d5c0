//! Reconstruction filters, normalised by their known integral: f with ∫ f dx = 1 along each axis.
//!
//! | filter | f(x) for x up to its reach | N | reach in pixels |
//! |---|---|---|---|
//! | box | 1 | 1 | ½ |
//! | Gaussian, σ = ½ | (exp(−x²/2σ²) − exp(−2²/2σ²)) / N, continuous at its end | σ√(2π) erf(2/(σ√2)) − 4 exp(−2²/2σ²) | 2 |
//! | Blackman–Harris | Σ_k a_k cos(kπx/2) / N, k = 0 … 3 | 4 a₀ | 2 |
//!
//! The window has σ = 0.55 pixel, a little softer than the Gaussian. As its spectrum vanishes at all whole numbers of cycles a pixel, the weights
//! of one sample add up to 1 wherever it falls; those of the Gaussian do so within 1.5 %, and on average.
//!
//! A sample reaches four pixels along each axis; their weights are evaluated as polynomials of its place between the two middle ones, fitted
//! once at Chebyshev points (within 3·10⁻⁶ of f) and scaled so that their own integral is 1.
//!
//! Source of the a_k: F. Harris, *On the use of windows for harmonic analysis with the discrete Fourier transform* (Proc. IEEE 66, 1978), the
//! minimum 4-term window of table I.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// How samples are spread over pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Filter {
    /// A Gaussian of σ = ½ pixel, cut at 2 pixels.
    #[default]
    Gaussian,
    /// A sample counts for the pixel it is in.
    Box,
    /// The four-term window of Blackman and Harris, ending at 2 pixels.
    BlackmanHarris,
}

/// Standard deviation of the Gaussian in pixels.
const SIGMA: f64 = 0.5;
/// Where the Gaussian and the window end.
const RADIUS: f64 = 2.0;
/// The window's terms.
const BLACKMAN_HARRIS: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];
/// Pixels a sample reaches along each axis.
pub(super) const TAPS: usize = 4;
const COEFFICIENTS: usize = 9;

impl Filter {
    /// Pixels by which samples reach beyond their own.
    pub(super) fn margin(self) -> u32 {
        match self {
            Self::Gaussian | Self::BlackmanHarris => 2,
            Self::Box => 0,
        }
    }

    /// f at `x` pixels from the centre, per pixel.
    fn at(self, x: f64) -> f64 {
        match self {
            Self::Gaussian => gaussian(x),
            Self::Box => f64::from(u8::from((-0.5..0.5).contains(&x))),
            Self::BlackmanHarris => blackman_harris(x),
        }
    }
}

fn gaussian(x: f64) -> f64 {
    let bell = |x: f64| libm::exp(-x * x / (2.0 * SIGMA * SIGMA));
    let whole = SIGMA * (2.0 * PI).sqrt() * libm::erf(RADIUS / (SIGMA * SQRT_2));
    let integral = whole - 2.0 * RADIUS * bell(RADIUS);
    if x.abs() < RADIUS {
        (bell(x) - bell(RADIUS)) / integral
    } else {
        0.0
    }
}

fn blackman_harris(x: f64) -> f64 {
    if x.abs() > RADIUS {
        return 0.0;
    }
    let term = |(k, a): (usize, &f64)| a * libm::cos(k as f64 * FRAC_PI_2 * x);
    let sum: f64 = BLACKMAN_HARRIS.iter().enumerate().map(term).sum();
    sum / (2.0 * RADIUS * BLACKMAN_HARRIS[0])
}

/// The weights of the four pixels around a sample, along one axis: for each power of s = 2t − 1, a coefficient for each tap.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights([[f32; TAPS]; COEFFICIENTS]);

impl Weights {
    /// Those of a filter that reaches four pixels.
    pub(super) fn of(filter: Filter) -> Self {
        let taps: [_; TAPS] = std::array::from_fn(|tap| fit(|t| filter.at(t + 1.0 - tap as f64)));
        let integral: f64 = taps.iter().map(integral).sum();
        Self(std::array::from_fn(|power| {
            taps.map(|tap| (tap[power] / integral) as f32)
        }))
    }

    /// Weights of four neighbouring pixels, the sample being `t` in [0, 1] from the centre of the second to that of the third.
    #[inline(always)]
    pub(super) fn at(&self, t: f32) -> [f32; TAPS] {
        let s = 2.0 * t - 1.0;
        let mut sum = self.0[COEFFICIENTS - 1];
        for row in self.0[..COEFFICIENTS - 1].iter().rev() {
            sum = std::array::from_fn(|tap| sum[tap] * s + row[tap]);
        }
        sum
    }
}

/// Coefficients in powers of s = 2t − 1 of the polynomial through the Chebyshev points of [0, 1].
fn fit(f: impl Fn(f64) -> f64) -> [f64; COEFFICIENTS] {
    let count = COEFFICIENTS as f64;
    let angle = |node: usize| PI * (node as f64 + 0.5) / count;
    let values: [f64; COEFFICIENTS] =
        std::array::from_fn(|node| f(0.5 + 0.5 * libm::cos(angle(node))));
    let mut polynomials = [[0.0; COEFFICIENTS]; 2];
    let mut sum = [0.0; COEFFICIENTS];
    for degree in 0..COEFFICIENTS {
        polynomials = [polynomials[1], next_chebyshev(degree, &polynomials)];
        let terms =
            (0..COEFFICIENTS).map(|node| values[node] * libm::cos(degree as f64 * angle(node)));
        let coefficient = terms.sum::<f64>() * if degree == 0 { 1.0 } else { 2.0 } / count;
        sum.iter_mut()
            .zip(polynomials[1])
            .for_each(|(sum, power)| *sum += coefficient * power);
    }
    sum
}

/// The Chebyshev polynomial of a degree in powers, from those of the two degrees before: T₀ = 1, T₁ = s, T_k = 2s T_{k−1} − T_{k−2}.
fn next_chebyshev(degree: usize, [before, last]: &[[f64; COEFFICIENTS]; 2]) -> [f64; COEFFICIENTS] {
    let factor = if degree == 1 { 1.0 } else { 2.0 };
    let start = |power: usize| f64::from(u8::from(degree == 0 && power == 0));
    let raised = |power: usize| {
        if power == 0 {
            0.0
        } else {
            factor * last[power - 1]
        }
    };
    std::array::from_fn(|power| start(power) + raised(power) - before[power])
}

/// ∫ over t in [0, 1] of a polynomial in s = 2t − 1.
fn integral(coefficients: &[f64; COEFFICIENTS]) -> f64 {
    coefficients
        .iter()
        .enumerate()
        .step_by(2)
        .map(|(power, coefficient)| coefficient / (power + 1) as f64)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDE: [Filter; 2] = [Filter::Gaussian, Filter::BlackmanHarris];
    const STEPS: i32 = 1 << 14;

    /// ∫ g dx from −2 to 2 by the midpoint rule.
    fn over_reach(g: impl Fn(f64) -> f64) -> f64 {
        let step = 4.0 / f64::from(STEPS);
        let x = |i: i32| -2.0 + step * (f64::from(i) + 0.5);
        step * (0..STEPS).map(|i| g(x(i))).sum::<f64>()
    }

    #[test]
    fn filters_have_integral_one_and_no_direction() {
        for filter in [Filter::Gaussian, Filter::Box, Filter::BlackmanHarris] {
            let integral = over_reach(|x| filter.at(x));
            assert!((integral - 1.0).abs() < 1e-7, "{filter:?}: {integral}");
            assert!(over_reach(|x| x * filter.at(x)).abs() < 1e-12, "{filter:?}");
        }
    }

    /// The variance of the window is R² (1/3 + 2/π² Σ (−1)ᵏ a_k / (k² a₀)).
    #[test]
    fn the_window_is_as_wide_as_documented() {
        let [a0, a1, a2, a3] = BLACKMAN_HARRIS;
        let series = (-a1 + a2 / 4.0 - a3 / 9.0) / a0;
        let variance = 4.0 * (1.0 / 3.0 + 2.0 / (PI * PI) * series);
        let found = over_reach(|x| x * x * Filter::BlackmanHarris.at(x));
        assert!((found - variance).abs() < 1e-6);
        assert!((variance.sqrt() - 0.55).abs() < 0.005);
    }

    #[test]
    fn the_weights_of_one_sample_add_up_to_what_is_documented() {
        for (filter, tolerance) in [(Filter::Gaussian, 0.015), (Filter::BlackmanHarris, 1e-6)] {
            let weights = Weights::of(filter);
            for step in 1..1000 {
                let sum: f32 = weights.at(step as f32 / 1000.0).iter().sum();
                assert!((sum - 1.0).abs() < tolerance, "{filter:?} {step}: {sum}");
            }
        }
    }

    #[test]
    fn polynomials_follow_the_filter() {
        for filter in WIDE {
            let weights = Weights::of(filter);
            for step in 0..=1000 {
                let t = step as f32 / 1000.0;
                for (tap, weight) in weights.at(t).into_iter().enumerate() {
                    let exact = filter.at(f64::from(t) + 1.0 - tap as f64);
                    assert!(
                        (f64::from(weight) - exact).abs() < 3e-6,
                        "{filter:?} {t} {tap}: {weight} {exact}"
                    );
                }
            }
        }
    }

    #[test]
    fn weights_have_integral_one() {
        for filter in WIDE {
            let weights = Weights::of(filter);
            let at = |i: i32| {
                let t = (i as f32 + 0.5) / STEPS as f32;
                weights.at(t).into_iter().map(f64::from).sum::<f64>()
            };
            // The midpoint rule is off by f' at the ends / 24 steps², which is below 1e-9 here.
            let integral = (0..STEPS).map(at).sum::<f64>() / f64::from(STEPS);
            assert!((integral - 1.0).abs() < 1e-7, "{filter:?}");
        }
    }
}
