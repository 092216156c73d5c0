//! Owen's nested uniform scrambling by a hash.
//!
//! Nested scrambling flips each binary digit of a coordinate by a random bit that depends on all digits above it. It turns a
//! net into a random net whose points are each uniform, so the mean of an integrand over them is unbiased
//! (Owen 1995, *Randomly permuted (t,m,s)-nets and (t,s)-sequences*). Stored with the digits reversed (first digit in the lowest
//! bit), "depends on the digits above" becomes "depends on the lower bits", which multiplication and addition obey by themselves:
//! one short hash scrambles all 32 digits (Laine & Karras 2011; Burley 2020, *Practical hash-based Owen scrambling*, JCGT 9(4)).
//! The constants are those of N. Vegdahl, *Building a better LK hash* (2021, the revised final hash): the ones printed in Burley's paper leave
//! scrambles of different seeds correlated.

/// Scrambles a coordinate stored with its digits reversed; the result is reversed too.
#[inline(always)]
#[must_use]
pub const fn scramble_reversed(digits: u32, seed: u32) -> u32 {
    let mut x = digits;
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// Shuffles the order of a sequence: the first 2ᵏ indices land in one aligned run of 2ᵏ, for every k.
#[inline(always)]
#[must_use]
pub const fn shuffle(index: u32, seed: u32) -> u32 {
    scramble_reversed(index.reverse_bits(), seed).reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::hash::mix_32;

    #[test]
    fn lower_bits_never_depend_on_higher_ones() {
        for trial in 0..1000 {
            let (digits, seed, bit) = (mix_32(trial), mix_32(trial + 5000), trial % 32);
            let difference =
                scramble_reversed(digits, seed) ^ scramble_reversed(digits ^ (1 << bit), seed);
            assert_eq!(difference & ((1_u32 << bit) - 1), 0);
            assert_eq!(
                (difference >> bit) & 1,
                1,
                "each digit is permuted, not lost"
            );
        }
    }

    #[test]
    fn shuffling_keeps_aligned_runs_together() {
        for seed in (0..50).map(mix_32) {
            let mut run: Vec<u32> = (0..64).map(|index| shuffle(index, seed)).collect();
            run.sort_unstable();
            let first = run[0];
            assert_eq!(first % 64, 0);
            assert!(
                run.iter()
                    .zip(first..)
                    .all(|(&index, expected)| index == expected)
            );
        }
    }

    /// Flips of the digit at depth k over seeds are fair coins: 4000 seeds, 5 σ over 16 digits (false alarm 1e-5).
    #[test]
    fn digits_flip_with_probability_one_half() {
        for digit in 0..16 {
            let seeds = 4000;
            let flips: u32 = (0..seeds)
                .map(|seed| (scramble_reversed(0x5555, mix_32(seed)) ^ 0x5555) >> digit & 1)
                .sum();
            let sigma = (f64::from(seeds) / 4.0).sqrt();
            assert!(
                (f64::from(flips) - f64::from(seeds) / 2.0).abs() < 5.0 * sigma,
                "digit {digit}: {flips}"
            );
        }
    }
}
