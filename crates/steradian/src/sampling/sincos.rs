//! Sine and cosine of a fraction of a turn, for loops over batches.
//!
//! Warps turn a uniform number u into an azimuth 2πu. Taking u itself makes the reduction exact: k = round(4u) is the nearest quarter turn
//! and r = u − k/4 has no rounding error, being a multiple of the last place of u. On |r| ≤ 1/8 two polynomials in r² suffice:
//!
//! sin 2πr ≈ r (s₀ + s₁r² + s₂r⁴ + s₃r⁶) ,  cos 2πr ≈ 1 + r² (c₀ + c₁r² + c₂r⁴ + c₃r⁶)
//!
//! (Chebyshev fits; errors 3·10⁻⁹ and 2·10⁻¹⁰ before rounding). There are no branches and no library calls, so the compiler turns a loop
//! over it into vector code, and no fused operations, so the bits are the same everywhere.

/// Adding and subtracting it rounds to a whole number, which is then in the lowest bits: 1.5 · 2²³.
const ROUND: f32 = 12_582_912.0;
const SINE: [f32; 4] = [std::f32::consts::TAU, -41.341_663, 81.592_543, -75.401_61];
const COSINE: [f32; 4] = [-19.739_209, 64.939_37, -85.448_82, 59.424_106];

/// (sin 2πu, cos 2πu) for |u| ≤ 2¹⁸, each within 1.2·10⁻⁷; exact at multiples of a quarter turn.
///
/// ```
/// use steradian::sampling::sincos::sin_cos_two_pi;
///
/// assert_eq!(sin_cos_two_pi(0.25), (1.0, 0.0));
/// let (sine, cosine) = sin_cos_two_pi(1.0 / 12.0);
/// assert!((sine - 0.5).abs() < 1.2e-7 && (cosine - 0.866_025_4).abs() < 1.2e-7);
/// ```
#[inline(always)]
#[must_use]
pub fn sin_cos_two_pi(u: f32) -> (f32, f32) {
    let shifted = 4.0 * u + ROUND;
    let quarter = shifted.to_bits();
    let r = u - 0.25 * (shifted - ROUND);
    let s = r * r;
    let sine = r * (SINE[0] + s * (SINE[1] + s * (SINE[2] + s * SINE[3])));
    let cosine = 1.0 + s * (COSINE[0] + s * (COSINE[1] + s * (COSINE[2] + s * COSINE[3])));
    let (first, second) = if quarter & 1 == 0 {
        (sine, cosine)
    } else {
        (cosine, sine)
    };
    (
        flip_sign(first, quarter & 2),
        flip_sign(second, quarter.wrapping_add(1) & 2),
    )
}

/// Changes the sign if `flag` is 2, keeps it if 0; a zero stays positive.
#[inline(always)]
fn flip_sign(value: f32, flag: u32) -> f32 {
    f32::from_bits(value.to_bits() ^ (flag << 30)) + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn largest_error(arguments: impl Iterator<Item = f32>) -> f64 {
        arguments.fold(0.0_f64, |worst, u| {
            let (sine, cosine) = sin_cos_two_pi(u);
            let angle = TAU * f64::from(u);
            worst
                .max((f64::from(sine) - libm::sin(angle)).abs())
                .max((f64::from(cosine) - libm::cos(angle)).abs())
        })
    }

    #[test]
    fn the_stated_error_holds_over_a_turn() {
        let error = largest_error((0..1 << 20).map(|i| i as f32 / (1 << 20) as f32));
        assert!(error < 1.2e-7, "{error}");
    }

    #[test]
    fn the_stated_error_holds_for_other_turns_and_tiny_angles() {
        let turns = (-4000..4000).map(|i| i as f32 * 0.730_187);
        let tiny = (0..300).map(|i| f32::from_bits(i * 0x0030_1234));
        assert!(largest_error(turns.chain(tiny).filter(|u| u.abs() <= 262_144.0)) < 1.2e-7);
    }

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(
            [0.0, 0.25, 0.5, 0.75].map(sin_cos_two_pi),
            [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]
        );
    }
}
