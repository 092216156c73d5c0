//! Vectors for AVX2 and AVX-512.
//!
//! Every `unsafe` here calls an intrinsic. Two reasons make that sound, once and for all blocks of this file: an
//! [`Avx2`] or [`Avx512`] is only made inside a function compiled for that set, and a vector only from one of these, so
//! the instructions exist; and loads and stores go through a slice whose length has been checked.

use super::{Floats, Mask, Simd};
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Sub};

/// An intrinsic whose instruction exists, as the head of this file says.
macro_rules! intrinsic {
    ($function:ident $(::<{ $constant:expr }>)? ($($argument:expr),*)) => {
        // SAFETY: the vector or marker at hand proves that the instruction exists; pointers come from checked slices.
        unsafe { $function$(::<{ $constant }>)?($($argument),*) }
    };
}

/// Proof that the machine has AVX2.
#[derive(Copy, Clone)]
pub(crate) struct Avx2(());

impl Avx2 {
    /// Callable only where AVX2 is known to be there.
    #[inline]
    #[target_feature(enable = "avx2")]
    pub(crate) fn new() -> Self {
        Self(())
    }
}

/// Proof that the machine has AVX-512 F, DQ and VL.
#[derive(Copy, Clone)]
pub(crate) struct Avx512(());

impl Avx512 {
    /// Callable only where AVX-512 is known to be there.
    #[inline]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    pub(crate) fn new() -> Self {
        Self(())
    }
}

/// For each mask its lanes in rising order, then zeros.
static FRONT: [[u8; 8]; 256] = lanes_to_the_front();

const fn lanes_to_the_front() -> [[u8; 8]; 256] {
    let mut orders = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut len) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                orders[mask][len] = lane as u8;
                len += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    orders
}

impl Simd for Avx2 {
    type Eight = Avx2x8;
    type Wide = Avx2x8;

    #[inline(always)]
    fn prefetch<T>(self, line: *const T) {
        // SAFETY: a prefetch reads nothing and never faults.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(line.cast()) }
    }

    #[inline(always)]
    fn pairs(self, mask: Mask256, high: Avx2x8, low: [u32; 8], out: &mut [u64; 8]) -> usize {
        let bits = mask.bits() as usize;
        let order = FRONT[bits % 256].as_ptr();
        let order = intrinsic!(_mm_loadl_epi64(order.cast()));
        let order = intrinsic!(_mm256_cvtepu8_epi32(order));
        let low = intrinsic!(_mm256_loadu_si256(low.as_ptr().cast()));
        let low = intrinsic!(_mm256_permutevar8x32_epi32(low, order));
        let high = intrinsic!(_mm256_castps_si256(high.0));
        let high = intrinsic!(_mm256_permutevar8x32_epi32(high, order));
        // Lanes 0, 1, 4, 5 and lanes 2, 3, 6, 7.
        let outer = intrinsic!(_mm256_unpacklo_epi32(low, high));
        let inner = intrinsic!(_mm256_unpackhi_epi32(low, high));
        let first = intrinsic!(_mm256_permute2x128_si256::<{ 0x20 }>(outer, inner));
        let second = intrinsic!(_mm256_permute2x128_si256::<{ 0x31 }>(outer, inner));
        let [front, back] = out.as_chunks_mut::<4>().0 else {
            return 0;
        };
        intrinsic!(_mm256_storeu_si256(front.as_mut_ptr().cast(), first));
        intrinsic!(_mm256_storeu_si256(back.as_mut_ptr().cast(), second));
        bits.count_ones() as usize
    }
}

impl Simd for Avx512 {
    type Eight = Avx512x8;
    type Wide = Avx512x16;

    #[inline(always)]
    fn prefetch<T>(self, line: *const T) {
        // SAFETY: a prefetch reads nothing and never faults.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(line.cast()) }
    }

    #[inline(always)]
    fn pairs(self, mask: Mask8, high: Avx512x8, low: [u32; 8], out: &mut [u64; 8]) -> usize {
        let low = intrinsic!(_mm256_loadu_si256(low.as_ptr().cast()));
        let low = intrinsic!(_mm512_cvtepu32_epi64(low));
        let high = intrinsic!(_mm256_castps_si256(high.0));
        let high = intrinsic!(_mm512_cvtepu32_epi64(high));
        let high = intrinsic!(_mm512_slli_epi64::<{ 32 }>(high));
        let pairs = intrinsic!(_mm512_or_si512(high, low));
        let pairs = intrinsic!(_mm512_maskz_compress_epi64(mask.0, pairs));
        intrinsic!(_mm512_storeu_si512(out.as_mut_ptr().cast(), pairs));
        mask.0.count_ones() as usize
    }
}

macro_rules! operators {
    ($vector:ident, $($operation:ident $method:ident $intrinsic:ident),*) => {$(
        impl $operation for $vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(intrinsic!($intrinsic(self.0, other.0)))
            }
        }
    )*};
}

macro_rules! vector {
    ($(#[$doc:meta])* $vector:ident: $set:ident, $register:ident, $lanes:literal, $mask:ident;
     $add:ident $sub:ident $mul:ident $div:ident $splat:ident $load:ident $store:ident $min:ident $max:ident
     $compare:ident $blend:ident) => {
        $(#[$doc])*
        #[derive(Copy, Clone)]
        pub(crate) struct $vector($register);

        operators!($vector, Add add $add, Sub sub $sub, Mul mul $mul, Div div $div);

        impl Floats for $vector {
            type Set = $set;
            type Mask = $mask;
            const LANES: usize = $lanes;

            #[inline(always)]
            fn splat(_: $set, value: f32) -> Self {
                Self(intrinsic!($splat(value)))
            }
            #[inline(always)]
            fn load(_: $set, values: &[f32]) -> Self {
                let values = &values[..$lanes];
                Self(intrinsic!($load(values.as_ptr())))
            }
            #[inline(always)]
            fn store(self, values: &mut [f32]) {
                let values = &mut values[..$lanes];
                intrinsic!($store(values.as_mut_ptr(), self.0))
            }
            #[inline(always)]
            fn minimum(self, other: Self) -> Self {
                Self(intrinsic!($min(self.0, other.0)))
            }
            #[inline(always)]
            fn maximum(self, other: Self) -> Self {
                Self(intrinsic!($max(self.0, other.0)))
            }
            #[inline(always)]
            fn less(self, other: Self) -> $mask {
                $mask(intrinsic!($compare::<{ _CMP_LT_OQ }>(self.0, other.0)))
            }
            #[inline(always)]
            fn less_equal(self, other: Self) -> $mask {
                $mask(intrinsic!($compare::<{ _CMP_LE_OQ }>(self.0, other.0)))
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                Self($mask::$blend(mask, yes.0, no.0))
            }
        }
    };
}

vector! {
    /// Eight lanes of AVX2.
    Avx2x8: Avx2, __m256, 8, Mask256;
    _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps _mm256_set1_ps _mm256_loadu_ps _mm256_storeu_ps
    _mm256_min_ps _mm256_max_ps _mm256_cmp_ps blend_256
}
vector! {
    /// Eight lanes of AVX-512, whose comparisons yield bits.
    Avx512x8: Avx512, __m256, 8, Mask8;
    _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps _mm256_set1_ps _mm256_loadu_ps _mm256_storeu_ps
    _mm256_min_ps _mm256_max_ps _mm256_cmp_ps_mask blend_256
}
vector! {
    /// Sixteen lanes of AVX-512.
    Avx512x16: Avx512, __m512, 16, Mask16;
    _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps _mm512_set1_ps _mm512_loadu_ps _mm512_storeu_ps
    _mm512_min_ps _mm512_max_ps _mm512_cmp_ps_mask blend_512
}

/// Lanes of ones and zeros.
#[derive(Copy, Clone)]
pub(crate) struct Mask256(__m256);

/// A bit a lane.
#[derive(Copy, Clone)]
pub(crate) struct Mask8(__mmask8);

/// A bit a lane.
#[derive(Copy, Clone)]
pub(crate) struct Mask16(__mmask16);

impl Mask256 {
    #[inline(always)]
    fn blend_256(self, yes: __m256, no: __m256) -> __m256 {
        intrinsic!(_mm256_blendv_ps(no, yes, self.0))
    }
}

impl Mask8 {
    #[inline(always)]
    fn blend_256(self, yes: __m256, no: __m256) -> __m256 {
        intrinsic!(_mm256_mask_blend_ps(self.0, no, yes))
    }
}

impl Mask16 {
    #[inline(always)]
    fn blend_512(self, yes: __m512, no: __m512) -> __m512 {
        intrinsic!(_mm512_mask_blend_ps(self.0, no, yes))
    }
}

impl BitAnd for Mask256 {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(intrinsic!(_mm256_and_ps(self.0, other.0)))
    }
}

impl BitOr for Mask256 {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(intrinsic!(_mm256_or_ps(self.0, other.0)))
    }
}

impl Mask for Mask256 {
    #[inline(always)]
    fn bits(self) -> u32 {
        intrinsic!(_mm256_movemask_ps(self.0)).cast_unsigned()
    }
    #[inline(always)]
    fn without(self, other: Self) -> Self {
        Self(intrinsic!(_mm256_andnot_ps(other.0, self.0)))
    }
}

macro_rules! bit_masks {
    ($($mask:ident),*) => {$(
        impl BitAnd for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                Self(self.0 & other.0)
            }
        }
        impl BitOr for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, other: Self) -> Self {
                Self(self.0 | other.0)
            }
        }
        impl Mask for $mask {
            #[inline(always)]
            fn bits(self) -> u32 {
                u32::from(self.0)
            }
            #[inline(always)]
            fn without(self, other: Self) -> Self {
                Self(self.0 & !other.0)
            }
        }
    )*};
}
bit_masks!(Mask8, Mask16);
