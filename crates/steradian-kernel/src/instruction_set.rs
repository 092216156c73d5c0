//! Which vector instructions the machine has, and how to compile a loop for them.

use crate::simd::{Scalar, Simd};

/// The instruction set a batched loop is compiled for. Results are the same bits for all of them.
///
/// A set that the machine lacks is replaced by the best one it has, so every value is safe to use everywhere.
#[derive(Copy, Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum InstructionSet {
    /// What every machine of the target has.
    Scalar,
    /// x86-64 with AVX2, BMI1, BMI2, LZCNT and POPCNT.
    Avx2,
    /// The same with AVX-512 F, BW, CD, DQ and VL.
    Avx512,
}

/// Work that can be compiled for any instruction set.
pub(crate) trait Kernel {
    type Output;
    /// Implementations are `#[inline(always)]`: that is how their code gets into the function compiled for `S`.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

impl InstructionSet {
    /// The best set of this machine.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        return x86::detect();
        #[cfg(not(target_arch = "x86_64"))]
        Self::Scalar
    }

    /// All sets of this machine, the plainest first.
    pub fn available() -> Vec<Self> {
        [Self::Scalar, Self::Avx2, Self::Avx512]
            .into_iter()
            .filter(|&set| set <= Self::detect())
            .collect()
    }

    /// Does `work` in a function compiled for this instruction set.
    ///
    /// ```
    /// use steradian_kernel::{InstructionSet, Work};
    ///
    /// struct Double<'a>(&'a mut [f32]);
    ///
    /// impl Work for Double<'_> {
    ///     type Output = ();
    ///     #[inline(always)]
    ///     fn run(self) {
    ///         self.0.iter_mut().for_each(|x| *x *= 2.0);
    ///     }
    /// }
    ///
    /// let mut column = [0.5_f32; 64];
    /// InstructionSet::detect().run(Double(&mut column));
    /// assert_eq!(column, [1.0; 64]);
    /// ```
    #[inline]
    pub fn run<W: Work>(self, work: W) -> W::Output {
        self.dispatch(Plain(work))
    }

    #[inline]
    pub(crate) fn dispatch<K: Kernel>(self, kernel: K) -> K::Output {
        match self.min(Self::detect()) {
            Self::Scalar => kernel.run(Scalar),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: the set is not above the detected one, so the machine has the features of the callee.
            Self::Avx2 => unsafe { x86::run_avx2(kernel) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: as above.
            Self::Avx512 => unsafe { x86::run_avx512(kernel) },
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => kernel.run(Scalar),
        }
    }
}

/// A loop that the compiler vectorises for the instruction set it runs with.
///
/// [`run`](Self::run) must be `#[inline(always)]`, as must be what it calls: only code that is inlined into the
/// function compiled for the set is compiled for it. (A closure cannot be marked so, which is why this is a trait.)
/// Multiply-adds are not fused, so the bits are the same for every set.
pub trait Work {
    /// What the loop gives.
    type Output;

    /// The loop.
    fn run(self) -> Self::Output;
}

struct Plain<W>(W);

impl<W: Work> Kernel for Plain<W> {
    type Output = W::Output;
    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> W::Output {
        self.0.run()
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{InstructionSet, Kernel};
    use crate::simd::{Avx2, Avx512};
    use std::arch::is_x86_feature_detected as has;

    #[inline]
    pub(super) fn detect() -> InstructionSet {
        let avx2 = has!("avx2") && has!("bmi1") && has!("bmi2") && has!("lzcnt") && has!("popcnt");
        let avx512 = has!("avx512f")
            && has!("avx512bw")
            && has!("avx512cd")
            && has!("avx512dq")
            && has!("avx512vl");
        match (avx2, avx512) {
            (true, true) => InstructionSet::Avx512,
            (true, false) => InstructionSet::Avx2,
            _ => InstructionSet::Scalar,
        }
    }

    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
    pub(super) fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
        kernel.run(Avx2::new())
    }

    #[target_feature(
        enable = "avx2,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512bw,avx512cd,avx512dq,avx512vl"
    )]
    pub(super) fn run_avx512<K: Kernel>(kernel: K) -> K::Output {
        kernel.run(Avx512::new())
    }
}

#[cfg(test)]
mod tests {
    use super::{InstructionSet, Work};

    struct Sum<'a>(&'a [i32]);

    impl Work for Sum<'_> {
        type Output = i32;
        #[inline(always)]
        fn run(self) -> i32 {
            self.0.iter().sum()
        }
    }

    #[test]
    fn every_set_runs_even_where_the_machine_lacks_it() {
        for set in [
            InstructionSet::Scalar,
            InstructionSet::Avx2,
            InstructionSet::Avx512,
        ] {
            assert_eq!(set.run(Sum(&[1, 2, 3])), 6);
        }
    }

    #[test]
    fn the_detected_set_is_the_last_available_one() {
        let available = InstructionSet::available();
        assert_eq!(available.first(), Some(&InstructionSet::Scalar));
        assert_eq!(available.last(), Some(&InstructionSet::detect()));
    }
}
