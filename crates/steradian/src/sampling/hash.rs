//! Mixing functions: how a name and a few integers become the key of a random stream.
//!
//! All are pure integer arithmetic with wrap-around, so a key is the same on every platform and in every version that keeps
//! the golden values at the foot of this file. They scatter keys; they are not cryptographic.
//!
//! Sources: the 32-bit finaliser is the lowest-bias two-round multiply-xorshift of C. Wellons, *Prospecting for hash functions*
//! (2018, constants by T. Ettinger, 2022); the 64-bit one is the variant 13 of D. Stafford (2011) used in *SplitMix*
//! (Steele, Lea & Flood 2014, *Fast splittable pseudorandom number generators*, OOPSLA); strings go through FNV-1a
//! (Fowler, Noll & Vo; IETF draft-eastlake-fnv) and then through the 64-bit finaliser.

/// The odd integer nearest 2³²/φ: steps of it visit 32-bit words evenly.
pub(crate) const GOLDEN_32: u32 = 0x9e37_79b9;
const GOLDEN_64: u64 = 0x9e37_79b9_7f4a_7c15;
const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;

/// A bijection of 32-bit words in which every input bit flips every output bit with probability close to ½.
#[inline(always)]
#[must_use]
pub const fn mix_32(word: u32) -> u32 {
    let mut x = word;
    x ^= x >> 16;
    x = x.wrapping_mul(0x21f0_aaad);
    x ^= x >> 15;
    x = x.wrapping_mul(0xd35a_2d97);
    x ^ (x >> 15)
}

/// A bijection of 64-bit words in which every input bit flips every output bit with probability close to ½.
#[inline]
#[must_use]
pub const fn mix_64(word: u64) -> u64 {
    let mut x = word;
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A key made of a key and one more word; the order of words matters.
///
/// ```
/// use steradian::sampling::hash::{combine, key_of_name};
///
/// let desk = key_of_name("desk");
/// assert_ne!(combine(combine(desk, 1), 2), combine(combine(desk, 2), 1));
/// ```
#[inline]
#[must_use]
pub const fn combine(key: u64, word: u64) -> u64 {
    mix_64(key.wrapping_add(GOLDEN_64) ^ mix_64(word.wrapping_add(GOLDEN_64)).rotate_left(25))
}

/// The key of a name, for instance of a sensor.
#[must_use]
pub const fn key_of_name(name: &str) -> u64 {
    let bytes = name.as_bytes();
    let mut hash = FNV_OFFSET;
    let mut position = 0;
    while position < bytes.len() {
        hash = (hash ^ bytes[position] as u64).wrapping_mul(FNV_PRIME);
        position += 1;
    }
    mix_64(hash)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixers_keep_their_values() {
        assert_eq!([mix_32(0), mix_32(1), mix_32(2)], GOLDEN_MIX_32);
        assert_eq!([mix_64(0), mix_64(1), mix_64(GOLDEN_64)], GOLDEN_MIX_64);
        assert_eq!(key_of_name(""), mix_64(FNV_OFFSET));
        assert_eq!([key_of_name("desk"), combine(1, 2)], GOLDEN_KEYS);
    }

    const GOLDEN_MIX_32: [u32; 3] = [0, 0x06d3_fa73, 0x0da7_f4e7];
    /// The last is the first output of SplitMix64 seeded with 0, as published.
    const GOLDEN_MIX_64: [u64; 3] = [0, 0x5692_161d_100b_05e5, 0xe220_a839_7b1d_cdaf];
    const GOLDEN_KEYS: [u64; 2] = [0xe07d_2ce0_07af_8921, 0x8bb3_b60c_0e84_9230];

    /// Fraction of flipped output bits over all input bits and 4096 words: mean ½, σ of one (in, out) pair 1/128.
    #[test]
    fn every_input_bit_flips_half_of_the_output() {
        for input in 0..32 {
            let mut flips = [0_u32; 32];
            for word in 0..4096_u32 {
                let word = word.wrapping_mul(GOLDEN_32);
                let difference = mix_32(word) ^ mix_32(word ^ (1 << input));
                for (bit, count) in flips.iter_mut().enumerate() {
                    *count += (difference >> bit) & 1;
                }
            }
            // 6 σ over 1024 pairs: false alarm 2e-6, plus the bias of the mixer (below .4 %).
            for count in flips {
                assert!((f64::from(count) / 4096.0 - 0.5).abs() < 6.0 / 128.0 + 0.004);
            }
        }
    }
}
