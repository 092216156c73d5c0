//! The imaginary part of the dilogarithm in the unit disc.
//!
//! Li₂(z) = Σ zⁿ/n², so that Im Li₂(e^(−x+iθ)) = Σ e^(−nx) sin(nθ)/n². With u = −ln(1 − z),
//!
//! Li₂(z) = u − u²/4 + Σ B₂ₘ u²ᵐ⁺¹/(2m + 1)!
//!
//! (L. Lewin, *Polylogarithms and Associated Functions*, 1981, § 1.3), which is used for Re z ≤ ½; beyond, Euler's
//! Li₂(z) = π²/6 − ln z ln(1 − z) − Li₂(1 − z) (ibid., eq. 1.11). In both cases |u| ≤ π/3, and eleven terms leave an error
//! below 2⁻⁵³.

/// Im Li₂(e^(−x+iθ)) for x ≥ 0 and 0 < θ < π, by the angle, its sine and cosine, x and e⁻ˣ.
pub(crate) fn imaginary_part(angle: &Angle, x: f64, decay: f64) -> f64 {
    let &Angle {
        theta,
        sin,
        cos,
        twice_sin_square_of_half,
    } = angle;
    let rest = 1.0 - decay;
    let real = rest + decay * twice_sin_square_of_half; // Re(1 − z), without cancellation
    let imaginary = decay * sin; // −Im(1 − z)
    let phase = libm::atan2(imaginary, real);
    let logarithm = 0.5 * libm::log(real * real + imaginary * imaginary);
    if decay * cos <= 0.5 {
        imaginary_part_of_series(-logarithm, phase)
    } else {
        -x * phase - theta * logarithm - imaginary_part_of_series(x, -theta)
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

/// Im(u − u²/4 + Σ B₂ₘ u²ᵐ⁺¹/(2m + 1)!) of u = re + i im.
fn imaginary_part_of_series(re: f64, im: f64) -> f64 {
    let (square_re, square_im) = (re * re - im * im, 2.0 * re * im);
    let (mut sum_re, mut sum_im) = (0.0, 0.0);
    for coefficient in COEFFICIENTS.iter().rev() {
        let shifted = sum_re + coefficient;
        sum_re = shifted * square_re - sum_im * square_im;
        sum_im = shifted * square_im + sum_im * square_re;
    }
    im + im * sum_re + re * sum_im - 0.25 * square_im
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::gauss;
    use crate::geometry::testing::close;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn at(theta: f64, x: f64) -> f64 {
        imaginary_part(
            &Angle::new(libm::sin(theta), libm::cos(theta)),
            x,
            libm::exp(-x),
        )
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
