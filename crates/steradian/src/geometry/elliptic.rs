//! Complete elliptic integrals, from one routine.
//!
//! The general complete elliptic integral is
//!
//! cel(k′, p, a, b) = ∫₀^{π/2} (a cos²φ + b sin²φ) / ((cos²φ + p sin²φ) √(cos²φ + k′² sin²φ)) dφ
//!
//! | integral | from `cel`, with k² + k′² = 1 |
//! |---|---|
//! | first kind, K(k) | cel(k′, 1, 1, 1) |
//! | second kind, E(k) | cel(k′, 1, 1, k′²) |
//! | third kind, Π(n, k) | cel(k′, 1 − n, 1, 1) |
//!
//! Being linear in a and b it gives sums of the three kinds without the cancellation of their separate values.
//!
//! Source: R. Bulirsch, "Numerical Calculation of Elliptic Integrals and Elliptic Functions III", Numerische Mathematik
//! 13, 1969, pp. 305–315; DLMF §19.2(iii). It is an arithmetic-geometric mean and needs nothing but square roots, where
//! Carlson's forms would need logarithms too. Valid for k′ > 0 and p > 0; the error is some 2⁻⁵².

use std::f64::consts::FRAC_PI_2;

/// The steps converge quadratically: with half the digits right, the next step has them all.
const HALF_THE_DIGITS: f64 = 1e-8;

/// cel(k′, p, a, b) for k′ > 0 and p > 0; NaN for others.
pub(crate) fn complete(complementary_modulus: f64, p: f64, a: f64, b: f64) -> f64 {
    if !(complementary_modulus > 0.0 && p > 0.0) {
        return f64::NAN;
    }
    let (mut lower, mut mean, mut product) = (complementary_modulus, 1.0, complementary_modulus);
    let mut root = p.sqrt();
    let (mut a, mut b) = (a, b / root);
    loop {
        let ratio = product / root;
        (a, b) = (a + b / root, 2.0 * (b + a * ratio));
        root += ratio;
        let upper = mean;
        mean += lower;
        if (upper - lower).abs() <= upper * HALF_THE_DIGITS {
            return FRAC_PI_2 * (b + a * mean) / (mean * (mean + root));
        }
        lower = 2.0 * product.sqrt();
        product = lower * mean;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;
    use proptest::prelude::*;

    /// The integral by the trapezoidal rule, which converges exponentially as the integrand is periodic and smooth.
    fn quadrature(k: f64, p: f64, a: f64, b: f64) -> f64 {
        let steps = 4096;
        let term = |index| {
            let (sin, cos) = libm::sincos(FRAC_PI_2 * f64::from(index) / f64::from(steps));
            let (s, c) = (sin * sin, cos * cos);
            let half = if index == 0 || index == steps {
                0.5
            } else {
                1.0
            };
            half * (a * c + b * s) / ((c + p * s) * (c + k * k * s).sqrt())
        };
        (0..=steps).map(term).sum::<f64>() * FRAC_PI_2 / f64::from(steps)
    }

    #[test]
    fn known_values() {
        let half = 0.5_f64.sqrt();
        // DLMF 19.6.1, and the lemniscate constant K(1/√2) = Γ(1/4)²/(4√π).
        assert!(close(complete(1.0, 1.0, 1.0, 1.0), FRAC_PI_2, 1e-16));
        assert!(close(
            complete(half, 1.0, 1.0, 1.0),
            1.854_074_677_301_371_9,
            1e-15
        ));
        assert!(close(
            complete(half, 1.0, 1.0, 0.5),
            1.350_643_881_047_675_5,
            1e-15
        ));
        // Π(n, 0) = π/(2 √(1 − n)).
        assert!(close(complete(1.0, 0.25, 1.0, 1.0), 2.0 * FRAC_PI_2, 1e-15));
        assert!(complete(0.0, 1.0, 1.0, 1.0).is_nan());
        assert!(complete(1.0, -1.0, 1.0, 1.0).is_nan());
    }

    proptest! {
        #[test]
        fn it_is_the_integral(k in 0.02..3.0_f64, p in 0.001..9.0_f64, a in 0.0..2.0_f64, b in 0.0..2.0_f64) {
            let found = complete(k, p, a, b);
            prop_assert!(close(found, quadrature(k, p, a, b), 1e-13 * found + 1e-13));
        }

        #[test]
        fn legendres_relation(k in 1e-6..0.999_999_f64) {
            // E K′ + E′ K − K K′ = π/2, DLMF 19.7.1.
            let prime = ((1.0 - k) * (1.0 + k)).sqrt();
            let [first, first_prime] = [prime, k].map(|c| complete(c, 1.0, 1.0, 1.0));
            let [second, second_prime] = [prime, k].map(|c| complete(c, 1.0, 1.0, c * c));
            let sum = second * first_prime + second_prime * first - first * first_prime;
            prop_assert!(close(sum, FRAC_PI_2, 1e-14 * (1.0 + first * first_prime)));
        }
    }
}
