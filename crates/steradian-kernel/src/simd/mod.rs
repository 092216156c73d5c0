//! Vectors of `f32`, so that one source of the intersection tests serves every width.
//!
//! A value of an instruction set's marker type ([`Avx2`], [`Avx512`]) is a proof that the machine has it: it can only be
//! made inside a function compiled for that set. Vectors are only made from a marker, so their operations are safe.
//!
//! Minimum and maximum are `if a < b { a } else { b }` and `if a > b { a } else { b }`, which is what x86 does; the
//! tests never rely on how they treat NaN beyond that.

mod portable;
#[cfg(target_arch = "x86_64")]
mod x86;

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Sub};

pub(crate) use portable::Scalar;
#[cfg(target_arch = "x86_64")]
pub(crate) use x86::{Avx2, Avx512};

/// An instruction set that is known to be there.
pub(crate) trait Simd: Copy {
    /// Eight lanes: the children of a node, the triangles of a leaf.
    type Eight: Floats<Set = Self>;
    /// As many lanes as a register holds: rays side by side.
    type Wide: Floats<Set = Self>;

    /// Asks for the cache line at `line`; the pointer is never read from.
    fn prefetch<T>(self, line: *const T);

    /// Puts, lane by lane where the mask is set, the bits of `high` above those of `low` to the front of `out`, and says how many.
    /// What is behind them in `out` is overwritten by anything.
    #[inline(always)]
    fn pairs(
        self,
        mask: <Self::Eight as Floats>::Mask,
        high: Self::Eight,
        low: [u32; 8],
        out: &mut [u64; 8],
    ) -> usize {
        let mut column = [0.0; 8];
        high.store(&mut column);
        let (mut lanes, mut len) = (mask.bits(), 0);
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % 8;
            lanes &= lanes - 1;
            out[len % 8] = u64::from(column[lane].to_bits()) << 32 | u64::from(low[lane]);
            len += 1;
        }
        len
    }
}

/// One truth value a lane.
pub(crate) trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> {
    /// Lane `i` in bit `i`.
    fn bits(self) -> u32;
    /// True where this is and the other is not.
    fn without(self, other: Self) -> Self;
}

/// A vector of `f32`.
pub(crate) trait Floats:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    type Set: Copy;
    type Mask: Mask;
    const LANES: usize;

    /// The same number in every lane.
    fn splat(set: Self::Set, value: f32) -> Self;
    /// The first lanes of a slice, which must not be shorter than the vector.
    fn load(set: Self::Set, values: &[f32]) -> Self;
    /// Writes the lanes to the front of a slice, which must not be shorter than the vector.
    fn store(self, values: &mut [f32]);
    fn minimum(self, other: Self) -> Self;
    fn maximum(self, other: Self) -> Self;
    /// Of −0, too, this is +0.
    #[inline(always)]
    fn absolute(self, set: Self::Set) -> Self {
        self.maximum(Self::splat(set, 0.0) - self)
    }
    fn less(self, other: Self) -> Self::Mask;
    fn less_equal(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is set, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
}

#[cfg(test)]
mod tests {
    use super::{Floats, Mask, Simd};
    use crate::InstructionSet;
    use crate::instruction_set::Kernel;

    const A: [f32; 16] = [
        1.0, -2.0, 3.5, 0.0, -0.0, 1e30, -1e-30, 7.0, 9.0, -1.5, 0.1, 0.2, 0.3, 1e10, -4.0, 2.0,
    ];
    const B: [f32; 16] = [
        2.0, -2.0, 1.5, 1.0, 3.0, 1e-30, -1e30, 0.7, 9.5, -1.0, 0.3, 0.2, 0.1, 1e-9, 4.0, -2.0,
    ];

    /// Bits of every operation on the first eight lanes, then on the wide vectors.
    struct Everything;

    impl Kernel for Everything {
        type Output = Vec<u32>;
        #[inline(always)]
        fn run<S: Simd>(self, set: S) -> Vec<u32> {
            let mut all = Vec::new();
            for start in (0..16).step_by(<S::Eight as Floats>::LANES) {
                operations::<S::Eight>(set, start, &mut all);
            }
            let mut wide = Vec::new();
            for start in (0..16).step_by(<S::Wide as Floats>::LANES) {
                operations::<S::Wide>(set, start, &mut wide);
            }
            all.sort_unstable();
            wide.sort_unstable();
            assert_eq!(all, wide);
            pairs(set, &mut all);
            all
        }
    }

    /// Of all lanes that a mask can have.
    fn pairs<S: Simd>(set: S, out: &mut Vec<u32>) {
        let low = std::array::from_fn(|lane| 7 * lane as u32 + 1);
        for lanes in 0..256_u32 {
            let chosen: [f32; 8] = std::array::from_fn(|lane| (lanes >> lane & 1) as f32);
            let zero = S::Eight::splat(set, 0.0);
            let mask = zero.less(S::Eight::load(set, &chosen));
            let mut pairs = [0; 8];
            let len = set.pairs(mask, S::Eight::load(set, &A), low, &mut pairs);
            assert_eq!(len, lanes.count_ones() as usize);
            for pair in &pairs[..len] {
                out.extend([(pair >> 32) as u32, *pair as u32]);
            }
        }
    }

    fn operations<F: Floats>(set: F::Set, start: usize, out: &mut Vec<u32>) {
        let (a, b) = (F::load(set, &A[start..]), F::load(set, &B[start..]));
        let less = a.less(b);
        let chosen = F::select(less & a.less_equal(b), a, F::splat(set, 5.0));
        for vector in [
            a + b,
            a - b,
            a * b,
            a / b,
            a.minimum(b),
            a.maximum(b),
            chosen,
        ] {
            let mut lanes = [0.0; 16];
            vector.store(&mut lanes);
            out.extend(lanes[..F::LANES].iter().map(|x| x.to_bits()));
        }
        for lane in 0..F::LANES {
            let (x, y) = (A[start + lane], B[start + lane]);
            assert_eq!(less.bits() >> lane & 1 == 1, x < y);
            assert_eq!(a.less_equal(b).bits() >> lane & 1 == 1, x <= y);
            assert_eq!((less | b.less(a)).bits() >> lane & 1 == 1, x != y);
            let equal = a.less_equal(b).without(less);
            assert_eq!(equal.bits() >> lane & 1 == 1, x == y);
        }
    }

    #[test]
    fn all_instruction_sets_compute_the_same_bits() {
        let expected = InstructionSet::Scalar.dispatch(Everything);
        for set in InstructionSet::available() {
            assert_eq!(set.dispatch(Everything), expected, "{set:?}");
        }
    }
}
