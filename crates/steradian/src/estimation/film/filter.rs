//! Reconstruction filters, normalised by their known integral.
//!
//! The Gaussian has σ = ½ pixel and ends at 2 pixels: f(x) = (exp(−x²/2σ²) − exp(−2²/2σ²)) / N along each axis, which is continuous
//! at its edge, with N = σ√(2π) erf(2/(σ√2)) − 4 exp(−2²/2σ²), so that ∫ f dx = 1.
//! A sample reaches four pixels along each axis; their weights are evaluated as polynomials of its place between the two middle ones, fitted
//! once at Chebyshev points (within 3·10⁻⁶ of f) and scaled so that their own integral is 1.

use std::f64::consts::{PI, SQRT_2};

/// How samples are spread over pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Filter {
    /// A Gaussian of σ = ½ pixel, cut at 2 pixels.
    #[default]
    Gaussian,
    /// A sample counts for the pixel it is in.
    Box,
}

/// Standard deviation of the Gaussian in pixels.
const SIGMA: f64 = 0.5;
/// Where it ends.
const RADIUS: f64 = 2.0;
/// Pixels a sample reaches along each axis.
pub(super) const TAPS: usize = 4;
const COEFFICIENTS: usize = 9;

impl Filter {
    /// Pixels by which samples reach beyond their own.
    pub(super) fn margin(self) -> u32 {
        match self {
            Self::Gaussian => 2,
            Self::Box => 0,
        }
    }
}

/// f at `x` pixels from the centre, per pixel.
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

/// The weights of the four pixels around a sample, along one axis: for each power of s = 2t − 1, a coefficient for each tap.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights([[f32; TAPS]; COEFFICIENTS]);

impl Weights {
    pub(super) fn gaussian() -> Self {
        let taps: [_; TAPS] = std::array::from_fn(|tap| fit(|t| gaussian(t + 1.0 - tap as f64)));
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

    #[test]
    fn the_gaussian_has_integral_one() {
        let steps = 4000;
        let sum: f64 = (0..steps)
            .map(|i| gaussian(-2.0 + 4.0 * (f64::from(i) + 0.5) / f64::from(steps)))
            .sum();
        assert!((sum * 4.0 / f64::from(steps) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn polynomials_follow_the_gaussian() {
        let weights = Weights::gaussian();
        for step in 0..=1000 {
            let t = step as f32 / 1000.0;
            for (tap, weight) in weights.at(t).into_iter().enumerate() {
                let exact = gaussian(f64::from(t) + 1.0 - tap as f64);
                assert!(
                    (f64::from(weight) - exact).abs() < 3e-6,
                    "{t} {tap}: {weight} {exact}"
                );
            }
        }
    }

    #[test]
    fn weights_have_integral_one() {
        let weights = Weights::gaussian();
        let steps = 1 << 14;
        let at = |i: i32| {
            weights
                .at((i as f32 + 0.5) / steps as f32)
                .into_iter()
                .map(f64::from)
                .sum::<f64>()
        };
        // The midpoint rule is off by f' at the ends / 24 steps², which is below 1e-9 here.
        assert!(((0..steps).map(at).sum::<f64>() / f64::from(steps) - 1.0).abs() < 1e-7);
    }
}
