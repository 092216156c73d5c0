//! Keyed blocks of four random numbers: what a path draws from.
//!
//! A stream of samples has a 64-bit key. Its numbers come in blocks of four, block b being one Owen-scrambled, shuffled Sobol' sequence
//! with its own shuffle and its own four scrambles; blocks are padded side by side (Burley 2020, §5), so a path may draw as many as it
//! likes. A number depends on (key, index, block, dimension) and on nothing else.
//!
//! Within one block and stream the first 2ᵏ indices are a (3, k, 4)-net, and a (0, k, 2)-net in dimensions 0 and 1; different
//! blocks, and different streams, are independent. Numbers are multiples of 2⁻²⁴ in [0, 1): never 1, and each exactly an `f32`.

use super::hash::{GOLDEN_32, mix_32};
use super::{owen, sobol};

/// Dimensions in a block.
pub const DIMENSIONS: usize = 4;

const TO_UNIT: f32 = 1.0 / (1 << 24) as f32;
/// Odd multipliers that tell the shuffle and the four scrambles of a block apart.
const SHUFFLE: u32 = 0x85eb_ca6b;
const SCRAMBLE: [u32; DIMENSIONS] = [0xc2b2_ae35, 0x27d4_eb2f, 0x1656_67b1, 0x2c1b_3c6d];

/// The four numbers of `block` for sample `index` of the stream `key`.
///
/// ```
/// use steradian::sampling::block::sample;
///
/// let [u, v, ..] = sample(7, 0, 0);
/// assert!((0.0..1.0).contains(&u) && (0.0..1.0).contains(&v));
/// ```
#[inline(always)]
#[must_use]
pub fn sample(key: u64, index: u32, block: u32) -> [f32; DIMENSIONS] {
    let low = mix_32(key as u32 ^ block.wrapping_add(1).wrapping_mul(GOLDEN_32));
    let high = mix_32((key >> 32) as u32 ^ low);
    let seed = |multiplier: u32| mix_32(high.wrapping_add(low.wrapping_mul(multiplier)));
    let digits = sobol::point_reversed(owen::shuffle(index, seed(SHUFFLE)));
    let unit = |dimension: usize| {
        to_unit(owen::scramble_reversed(
            digits[dimension],
            seed(SCRAMBLE[dimension]),
        ))
    };
    [unit(0), unit(1), unit(2), unit(3)]
}

/// [`sample`] for many samples at once, bit for bit the same, dimension by dimension in `out`.
///
/// # Panics
/// If `indices` or a column of `out` is shorter than `keys`.
#[inline(always)]
pub fn fill_block(keys: &[u64], indices: &[u32], block: u32, out: [&mut [f32]; DIMENSIONS]) {
    let count = keys.len();
    let indices = &indices[..count];
    let [a, b, c, d] = out.map(|column| &mut column[..count]);
    for i in 0..count {
        [a[i], b[i], c[i], d[i]] = sample(keys[i], indices[i], block);
    }
}

/// [`fill_block`] as work for an [`InstructionSet`](steradian_kernel::InstructionSet).
pub struct FillBlock<'a> {
    /// Keys of the streams.
    pub keys: &'a [u64],
    /// Indices of the samples.
    pub indices: &'a [u32],
    /// Number of the block.
    pub block: u32,
    /// One column a dimension.
    pub out: [&'a mut [f32]; DIMENSIONS],
}

impl steradian_kernel::Work for FillBlock<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        fill_block(self.keys, self.indices, self.block, self.out);
    }
}

#[inline(always)]
fn to_unit(reversed: u32) -> f32 {
    // Below 2²⁴ the signed conversion is the same number and the one that vector units have.
    (reversed.reverse_bits() >> 8) as i32 as f32 * TO_UNIT
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::hash::{combine, key_of_name};

    /// First values, computed by an independent program with the bit loop of Sobol's construction.
    #[test]
    fn golden_values() {
        let key = key_of_name("desk");
        let grid = |key, index, block| sample(key, index, block).map(|u| (u / TO_UNIT) as u32);
        assert_eq!(grid(0, 0, 0), GOLDEN[0]);
        assert_eq!(grid(key, 0, 0), GOLDEN[1]);
        assert_eq!(grid(key, 1, 0), GOLDEN[2]);
        assert_eq!(grid(key, 12345, 7), GOLDEN[3]);
        assert_eq!(grid(key, u32::MAX, u32::MAX), GOLDEN[4]);
    }

    const GOLDEN: [[u32; 4]; 5] = [
        [2245765, 4509593, 2993388, 4334141],
        [2830725, 1636253, 11077365, 11990544],
        [12029781, 11227408, 3564429, 4944893],
        [9974954, 2041171, 8770906, 9883871],
        [13120937, 6887125, 16647522, 6004739],
    ];

    #[test]
    fn batches_have_the_bits_of_single_samples() {
        let keys: Vec<u64> = (0..1000).map(|i| combine(3, i / 100)).collect();
        let indices: Vec<u32> = (0..1000).map(|i| i * 37).collect();
        let mut out = [const { [0.0; 1000] }; 4];
        let [a, b, c, d] = &mut out;
        fill_block(&keys, &indices, 5, [a, b, c, d]);
        for i in 0..1000 {
            assert_eq!(
                sample(keys[i], indices[i], 5),
                [out[0][i], out[1][i], out[2][i], out[3][i]]
            );
        }
    }

    /// Points in each elementary interval of 2⁻ᵃ × 2⁻ᵇ × … over dimensions given by `bits`.
    fn counts(points: &[[f32; 4]], bits: [u32; 4]) -> Vec<u32> {
        let mut counts = vec![0; 1 << bits.iter().sum::<u32>()];
        for point in points {
            let cell = (0..4).fold(0, |cell, d| {
                cell << bits[d] | (point[d] * (1_u32 << bits[d]) as f32) as usize
            });
            counts[cell] += 1;
        }
        counts
    }

    #[test]
    fn dimensions_zero_and_one_are_nets_of_quality_zero() {
        for (key, block) in [(1, 0), (combine(9, 9), 3), (combine(2, 4), 1000)] {
            for k in 0..=12 {
                let points: Vec<_> = (0..1 << k).map(|i| sample(key, i, block)).collect();
                for a in 0..=k {
                    assert!(
                        counts(&points, [a, k - a, 0, 0])
                            .iter()
                            .all(|&count| count == 1),
                        "k {k} a {a}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_block_is_a_net_of_quality_three() {
        let points: Vec<_> = (0..1 << 9).map(|i| sample(combine(5, 6), i, 2)).collect();
        for code in 0..7_u32.pow(3) {
            let [a, b, c] = [code % 7, code / 7 % 7, code / 49];
            if a + b + c <= 6 {
                assert!(
                    counts(&points, [a, b, c, 6 - a - b - c])
                        .iter()
                        .all(|&count| count == 8)
                );
            }
        }
    }

    /// One sample of each of 2¹⁶ streams is independent of the others, so χ² with 255 degrees of freedom applies;
    /// bounds at 6 σ of its normal limit for 12 statistics (false alarm below 1e-6).
    #[test]
    fn single_samples_of_streams_are_uniform() {
        for index in [0, 1, 1000] {
            let points: Vec<_> = (0..1 << 16)
                .map(|i| sample(combine(11, i), index, 4))
                .collect();
            for bits in [[8, 0, 0, 0], [0, 8, 0, 0], [4, 0, 4, 0], [0, 2, 2, 4]] {
                let chi2: f64 = counts(&points, bits)
                    .iter()
                    .map(|&n| (f64::from(n) - 256.0).powi(2) / 256.0)
                    .sum();
                assert!(
                    (chi2 - 255.0).abs() < 6.0 * (2.0 * 255.0_f64).sqrt(),
                    "index {index} {bits:?}: {chi2}"
                );
            }
        }
    }

    /// Key and block of two siblings, from a number.
    type Pair = fn(u64) -> [(u64, u32); 2];

    /// Means over 8 points of siblings; their correlation over 4096 pairs has σ = 1/64, the bound is 5 σ
    /// over 48 pairs (false alarm 3e-5).
    #[test]
    fn siblings_are_independent() {
        let pairs: [Pair; 3] = [
            |i| [(combine(i, 0), 0), (combine(i, 1), 0)], // replicates
            |i| [(i, 0), (i, 1)],                         // blocks of one unhashed key
            |i| [(combine(i, 7), 3), (combine(i + 1, 7), 3)], // neighbouring streams
        ];
        for (kind, pair) in pairs.iter().enumerate() {
            for d in 0..4 {
                for e in 0..4 {
                    let mean = |(key, block), d: usize| {
                        (0..8)
                            .map(|i| f64::from(sample(key, i, block)[d]))
                            .sum::<f64>()
                            / 8.0
                    };
                    let means = (0..4096).map(pair).map(|[x, y]| (mean(x, d), mean(y, e)));
                    let r = correlation(&means.collect::<Vec<_>>());
                    assert!(r.abs() < 5.0 / 64.0, "kind {kind}, dimensions {d} {e}: {r}");
                }
            }
        }
    }

    fn correlation(pairs: &[(f64, f64)]) -> f64 {
        let n = pairs.len() as f64;
        let (x, y) = pairs
            .iter()
            .fold((0.0, 0.0), |(x, y), pair| (x + pair.0 / n, y + pair.1 / n));
        let moment = |f: fn(f64, f64) -> f64| {
            pairs
                .iter()
                .map(|pair| f(pair.0 - x, pair.1 - y))
                .sum::<f64>()
        };
        moment(|a, b| a * b) / (moment(|a, _| a * a) * moment(|_, b| b * b)).sqrt()
    }

    #[test]
    fn one_is_never_reached() {
        assert_eq!(to_unit(u32::MAX), 1.0 - TO_UNIT);
    }
}
