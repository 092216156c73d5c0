//! A number in single precision, or four side by side: importance is the same to the last bit whichever it is computed in.

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::Vec4;

/// What importance is computed in.
///
/// Minimum and maximum are `if a < b { a } else { b }` and `if a > b { a } else { b }`, which is what vector units do.
pub(in crate::transport) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn splat(number: f32) -> Self;
    fn least(self, other: Self) -> Self;
    fn most(self, other: Self) -> Self;
    fn root(self) -> Self;
    fn signed_as(self, other: Self) -> Self;
    /// `yes` where this is greater than the other, else `no`.
    fn if_above(self, other: Self, yes: Self, no: Self) -> Self;
    /// `yes` where this is not less than the other, else `no`.
    fn if_reaching(self, other: Self, yes: Self, no: Self) -> Self;
}

impl Number for f32 {
    #[inline(always)]
    fn splat(number: f32) -> Self {
        number
    }
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        self.copysign(other)
    }
    #[inline(always)]
    fn if_above(self, other: Self, yes: Self, no: Self) -> Self {
        if self > other { yes } else { no }
    }
    #[inline(always)]
    fn if_reaching(self, other: Self, yes: Self, no: Self) -> Self {
        if self >= other { yes } else { no }
    }
}

impl Number for Vec4 {
    #[inline(always)]
    fn splat(number: f32) -> Self {
        Self::splat(number)
    }
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Self::select(self.cmplt(other), self, other)
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        Self::select(self.cmpgt(other), self, other)
    }
    #[inline(always)]
    fn root(self) -> Self {
        Self::from_array(self.to_array().map(f32::sqrt))
    }
    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        self.copysign(other)
    }
    #[inline(always)]
    fn if_above(self, other: Self, yes: Self, no: Self) -> Self {
        Self::select(self.cmpgt(other), yes, no)
    }
    #[inline(always)]
    fn if_reaching(self, other: Self, yes: Self, no: Self) -> Self {
        Self::select(self.cmpge(other), yes, no)
    }
}
