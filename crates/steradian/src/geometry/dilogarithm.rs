//! The imaginary part of the dilogarithm in the unit disc.
//!
//! Li₂(z) = Σ zⁿ/n², so that Im Li₂(e^(−x+iθ)) = Σ e^(−nx) sin(nθ)/n². With u = −ln(1 − z),
//!
//! Li₂(z) = u − u²/4 + Σ B₂ₘ u²ᵐ⁺¹/(2m + 1)!
//!
//! (L. Lewin, *Polylogarithms and Associated Functions*, 1981, § 1.3), which is used for Re z ≤ ½; beyond, Euler's
//! Li₂(z) = π²/6 − ln z ln(1 − z) − Li₂(1 − z) (ibid., eq. 1.11). In both cases |u| ≤ π/3, and eleven terms leave an error
//! below 2⁻⁵³.

/// Im Li₂(e^(−x+iθ)) for some x ≥ 0, each with e⁻ˣ, and an angle 0 < θ < π.
pub(crate) fn imaginary_parts<const N: usize>(angle: &Angle, points: [[f64; 2]; N]) -> [f64; N] {
    let terms = points.map(|[x, decay]| Term::new(angle, x, decay));
    let series = imaginary_parts_of_series(terms.map(|term| term.u));
    std::array::from_fn(|k| terms[k].shift + terms[k].sign * series[k])
}

/// Im Li₂(z) as a shift and, with a sign, the imaginary part of the series at u.
#[derive(Clone, Copy)]
struct Term {
    u: [f64; 2],
    sign: f64,
    shift: f64,
}

impl Term {
    fn new(angle: &Angle, x: f64, decay: f64) -> Self {
        let &Angle {
            theta,
            sin,
            cos,
            twice_sin_square_of_half,
        } = angle;
        // Re(1 − z), without cancellation, and −Im(1 − z).
        let real = 1.0 - decay + decay * twice_sin_square_of_half;
        let imaginary = decay * sin;
        let phase = libm::atan2(imaginary, real);
        let logarithm = 0.5 * libm::log(real * real + imaginary * imaginary);
        if decay * cos <= 0.5 {
            Self {
                u: [-logarithm, phase],
                sign: 1.0,
                shift: 0.0,
            }
        } else {
            Self {
                u: [x, -theta],
                sign: -1.0,
                shift: -x * phase - theta * logarithm,
            }
        }
    }
}

/// An angle between 0 and π with what is often needed of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Angle {
    pub(crate) theta: f64,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
    twice_sin_square_of_half: f64,
}

impl Angle {
    /// By sine and cosine, sine positive.
    pub(crate) fn new(sin: f64, cos: f64) -> Self {
        let twice_sin_square_of_half = if cos > 0.0 {
            sin * sin / (1.0 + cos)
        } else {
            1.0 - cos
        };
        Self {
            theta: libm::atan2(sin, cos),
            sin,
            cos,
            twice_sin_square_of_half,
        }
    }

    /// π − θ.
    pub(crate) fn supplement(self) -> Self {
        Self::new(self.sin, -self.cos)
    }
}

/// B₂ₘ/(2m + 1)!, m = 1 … 11.
const COEFFICIENTS: [f64; 11] = [
    2.777_777_777_777_777_6e-2,
    -2.777_777_777_777_778e-4,
    4.724_111_866_969_01e-6,
    -9.185_773_074_661_964e-8,
    1.897_886_998_897_1e-9,
    -4.064_761_645_144_225_6e-11,
    8.921_691_020_456_452e-13,
    -1.993_929_586_072_107_4e-14,
    4.518_980_029_619_918e-16,
    -1.035_651_761_218_124_7e-17,
    2.395_218_621_026_187e-19,
];

/// Im(u − u²/4 + Σ B₂ₘ u²ᵐ⁺¹/(2m + 1)!) of each u = re + i im; several at a time, because each step waits for the one before.
fn imaginary_parts_of_series<const N: usize>(points: [[f64; 2]; N]) -> [f64; N] {
    let squares = points.map(|[re, im]| [re * re - im * im, 2.0 * re * im]);
    let mut sums = [[0.0; 2]; N];
    for coefficient in COEFFICIENTS.iter().rev() {
        for k in 0..N {
            let ([sum_re, sum_im], [re, im]) = (sums[k], squares[k]);
            let shifted = sum_re + coefficient;
            sums[k] = [shifted * re - sum_im * im, shifted * im + sum_im * re];
        }
    }
    std::array::from_fn(|k| {
        let ([re, im], [sum_re, sum_im]) = (points[k], sums[k]);
        im + im * sum_re + re * sum_im - 0.25 * squares[k][1]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::gauss;
    use crate::geometry::testing::close;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn at(theta: f64, x: f64) -> f64 {
        let angle = Angle::new(libm::sin(theta), libm::cos(theta));
        imaginary_parts(&angle, [[x, libm::exp(-x)]])[0]
    }

    #[test]
    fn special_values() {
        let catalan = 0.915_965_594_177_219;
        assert!(close(at(FRAC_PI_2, 0.0), catalan, 2e-16));
        // The maximum of Clausen's function is at π/3.
        assert!(close(at(PI / 3.0, 0.0), 1.014_941_606_409_653_6, 4e-16));
        assert!(close(
            at(PI / 3.0 * 2.0, 0.0) * 1.5,
            at(PI / 3.0, 0.0),
            4e-16
        ));
    }

    proptest! {
        #[test]
        fn the_sum_of_the_series(theta in 0.001..3.12_f64, x in 0.3..9.0_f64) {
            let term = |n: f64| libm::exp(-n * x) * libm::sin(n * theta) / (n * n);
            let sum: f64 = (1..150).rev().map(f64::from).map(term).sum();
            prop_assert!(close(at(theta, x), sum, 1e-15));
        }

        #[test]
        fn its_slope_is_an_arc_tangent(theta in 0.1..3.12_f64, x in 0.0..2.0_f64) {
            // d/dx Im Li₂(e^(−x+iθ)) = Im ln(1 − z) = −arctan(e⁻ˣ sinθ/(1 − e⁻ˣ cosθ)), singular at x = ± iθ.
            let slope = |x: f64| -libm::atan2(libm::exp(-x) * libm::sin(theta), 1.0 - libm::exp(-x) * libm::cos(theta));
            let change = gauss::integrate(16, [x, x + 0.05], slope);
            prop_assert!(close(at(theta, x + 0.05) - at(theta, x), change, 1e-15));
        }
    }
}
