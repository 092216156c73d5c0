//! The first four dimensions of Sobol's sequence, without tables and without loops over bits.
//!
//! Digit j of dimension d is the sum modulo 2 of the index bits k with C_d\[j\]\[k\] = 1. For a primitive polynomial p of degree e the
//! direction numbers satisfy v_k = Σ a_m v_{k−m} ⊕ v_{k−e} ⊕ (v_{k−e} ≫ e) (Bratley & Fox 1988, *Algorithm 659*, eq. 2–4). In generating functions, with t
//! marking index bits, z digits and p* the reciprocal polynomial of p,
//!
//! Σ v_k tᵏ = g(t, z) / (p*(t) + (zt)ᵉ) = Σ_q g(t, z) (zt)^{eq} / p*(t)^{q+1},
//!
//! so the digits eq … eq+e−1 read the index through tᵉ𐞥/p*^{q+1}. Halving the range of q and using p*(t)^{2ᵐ} = p*(t^{2ᵐ}) over GF(2) gives five
//! shift-mask-xor steps for the whole 32 × 32 matrix instead of 32; for p = t + 1 they are the well-known steps of the Pascal matrix.
//!
//! | dimension | p | p*(t) | Joe & Kuo's m | g |
//! |---|---|---|---|---|
//! | 0 | (identity: van der Corput) | | | |
//! | 1 | x + 1 | 1 + t | 1 | 1 |
//! | 2 | x² + x + 1 | 1 + t + t² | 1, 3 | 1 + zt |
//! | 3 | x³ + x + 1 | 1 + t² + t³ | 1, 3, 1 | 1 + t + t² + zt + z²t² |
//!
//! Direction numbers: Joe & Kuo 2008, *Constructing Sobol sequences with better two-dimensional projections*, table `new-joe-kuo-6`.
//! Quality: Σ(e−1) = 3, so the block is a (3, 4)-sequence and its first two dimensions are a (0, 2)-sequence in base 2.

/// The four coordinates of a point, each as 32 binary digits *in reversed order* (first digit in the lowest bit).
///
/// ```
/// use steradian::sampling::sobol::point_reversed;
///
/// // Point 1 is (1/2, 1/2, 1/2, 1/2), point 2 is (1/4, 3/4, 3/4, 3/4).
/// assert_eq!(point_reversed(1), [1, 1, 1, 1]);
/// assert_eq!(point_reversed(2), [0b10, 0b11, 0b11, 0b11]);
/// ```
#[inline(always)]
#[must_use]
pub const fn point_reversed(index: u32) -> [u32; 4] {
    [index, pascal(index), quadratic(index), cubic(index)]
}

#[inline(always)]
const fn pascal(index: u32) -> u32 {
    let mut x = index;
    x ^= x >> 16;
    x ^= (x >> 8) & 0x00ff_00ff;
    x ^= (x >> 4) & 0x0f0f_0f0f;
    x ^= (x >> 2) & 0x3333_3333;
    x ^ ((x >> 1) & 0x5555_5555)
}

#[inline(always)]
const fn quadratic(index: u32) -> u32 {
    let mut x = index;
    x ^= x >> 16;
    x ^= ((x >> 8) ^ (x >> 16)) & 0x0000_ffff;
    x ^= ((x >> 4) ^ (x >> 8)) & 0x00ff_00ff;
    x ^= ((x >> 2) ^ (x >> 4)) & 0x0f0f_0f0f;
    x ^ (((x >> 1) ^ (x >> 2)) & 0x3333_3333)
}

#[inline(always)]
const fn cubic(index: u32) -> u32 {
    let mut x = index;
    x ^= ((x >> 16) ^ (x >> 24)) & 0x00ff_ffff;
    x ^= ((x >> 8) ^ (x >> 12)) & 0xff00_0fff;
    x ^= ((x >> 4) ^ (x >> 6)) & 0x3f03_f03f;
    x ^= ((x >> 2) ^ (x >> 3)) & 0xc71c_71c7;
    x ^ (((x >> 1) ^ (x >> 2)) & 0x4924_9249)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Direction numbers by the recurrence itself, first digit in the highest bit: degree, interior coefficients, initial m.
    fn directions(degree: usize, coefficients: &[u32], initial: &[u32]) -> [u32; 32] {
        let mut v = [0_u32; 32];
        for k in 0..32 {
            v[k] = if k < degree {
                initial[k] << (31 - k)
            } else {
                let taps = (1..degree).filter(|m| coefficients[m - 1] == 1);
                taps.fold(v[k - degree] ^ (v[k - degree] >> degree), |sum, m| {
                    sum ^ v[k - m]
                })
            };
        }
        v
    }

    fn by_bits(index: u32, directions: &[u32; 32]) -> u32 {
        let used = (0..32).filter(|k| index >> k & 1 == 1);
        used.fold(0, |sum, k| sum ^ directions[k]).reverse_bits()
    }

    #[test]
    fn shifts_and_masks_are_the_direction_numbers() {
        let tables = [
            directions(1, &[], &[1]),
            directions(2, &[1], &[1, 3]),
            directions(3, &[0, 1], &[1, 3, 1]),
        ];
        let singles = (0..32).map(|bit| 1_u32 << bit);
        let mixed = (0..1000).map(crate::sampling::hash::mix_32);
        for index in singles.chain(mixed) {
            let expected = [
                index,
                by_bits(index, &tables[0]),
                by_bits(index, &tables[1]),
                by_bits(index, &tables[2]),
            ];
            assert_eq!(point_reversed(index), expected, "index {index:#x}");
        }
    }

    /// The first rows of the published sequence (Joe & Kuo's program, points 1–4, dimensions 1–4).
    #[test]
    fn first_points_are_the_published_ones() {
        let published = [
            [0.5; 4],
            [0.25, 0.75, 0.75, 0.75],
            [0.75, 0.25, 0.25, 0.25],
            [0.125, 0.625, 0.375, 0.125],
        ];
        // The published order is by Gray code: the k-th point has index k ⊕ (k ≫ 1).
        let mut ours: Vec<[f64; 4]> = (1..8)
            .map(|i| point_reversed(i).map(|w| f64::from(w.reverse_bits()) / 2_f64.powi(32)))
            .collect();
        ours.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for point in published {
            assert!(ours.contains(&point), "{point:?}");
        }
    }
}
