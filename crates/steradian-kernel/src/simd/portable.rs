//! Vectors for every machine: plain arrays, and `f32` itself as the vector of one lane.

use super::{Floats, Mask, Simd};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Sub};

/// The instruction set that is always there.
#[derive(Copy, Clone)]
pub(crate) struct Scalar;

impl Simd for Scalar {
    type Eight = Array;
    type Wide = Array;

    #[inline(always)]
    fn prefetch<T>(self, _: *const T) {}
}

/// Eight numbers in an array.
#[derive(Copy, Clone)]
pub(crate) struct Array([f32; 8]);

/// Eight truth values in the bits of a byte.
#[derive(Copy, Clone)]
pub(crate) struct Bits(u8);

impl Array {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }

    #[inline(always)]
    fn compare(self, other: Self, f: impl Fn(f32, f32) -> bool) -> Bits {
        let bit = |lane: usize| u8::from(f(self.0[lane], other.0[lane])) << lane;
        Bits((0..8).fold(0, |bits, lane| bits | bit(lane)))
    }
}

macro_rules! elementwise {
    ($($operation:ident $method:ident),*) => {$(
        impl $operation for Array {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, |a, b| a.$method(b))
            }
        }
    )*};
}
elementwise!(Add add, Sub sub, Mul mul, Div div);

impl Floats for Array {
    type Set = Scalar;
    type Mask = Bits;
    const LANES: usize = 8;

    #[inline(always)]
    fn splat(_: Scalar, value: f32) -> Self {
        Self([value; 8])
    }
    #[inline(always)]
    fn load(_: Scalar, values: &[f32]) -> Self {
        Self(std::array::from_fn(|lane| values[lane]))
    }
    #[inline(always)]
    fn store(self, values: &mut [f32]) {
        values[..8].copy_from_slice(&self.0);
    }
    #[inline(always)]
    fn minimum(self, other: Self) -> Self {
        self.zip(other, Floats::minimum)
    }
    #[inline(always)]
    fn maximum(self, other: Self) -> Self {
        self.zip(other, Floats::maximum)
    }
    #[inline(always)]
    fn less(self, other: Self) -> Bits {
        self.compare(other, |a, b| a < b)
    }
    #[inline(always)]
    fn less_equal(self, other: Self) -> Bits {
        self.compare(other, |a, b| a <= b)
    }
    #[inline(always)]
    fn select(mask: Bits, yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|lane| {
            if mask.0 >> lane & 1 == 1 {
                yes.0[lane]
            } else {
                no.0[lane]
            }
        }))
    }
}

impl Mask for Bits {
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self.0)
    }
    #[inline(always)]
    fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
}

impl BitAnd for Bits {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for Bits {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Floats for f32 {
    type Set = Scalar;
    type Mask = bool;
    const LANES: usize = 1;

    #[inline(always)]
    fn splat(_: Scalar, value: f32) -> Self {
        value
    }
    #[inline(always)]
    fn load(_: Scalar, values: &[f32]) -> Self {
        values[0]
    }
    #[inline(always)]
    fn store(self, values: &mut [f32]) {
        values[0] = self;
    }
    #[inline(always)]
    fn minimum(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn maximum(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn less_equal(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

impl Mask for bool {
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self)
    }
    #[inline(always)]
    fn without(self, other: Self) -> Self {
        self & !other
    }
}
