//! Four lanes of one radiant number.
//!
//! What a lane means (a channel, a band, a wavelength) is decided once per run; a [`Spectrum`] only carries the
//! four numbers and does the same to each. Sums across lanes have a fixed order, so that the bits are the same
//! on every instruction set.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};

use glam::Vec4;

/// Four `f32` lanes with lane-wise arithmetic.
///
/// ```
/// use steradian::quantity::Spectrum;
/// let light = Spectrum::from_lanes([1.0, 2.0, 3.0, 4.0]);
/// let reflectance = Spectrum::splat(0.5);
/// assert_eq!((light * reflectance).to_lanes(), [0.5, 1.0, 1.5, 2.0]);
/// assert_eq!(light.mean(), 2.5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(transparent)]
pub struct Spectrum(Vec4);

impl Spectrum {
    /// The number of lanes.
    pub const LANES: usize = 4;
    /// 0 in every lane.
    pub const ZERO: Self = Self(Vec4::ZERO);
    /// 1 in every lane.
    pub const ONE: Self = Self(Vec4::ONE);

    /// The same number in every lane.
    #[inline]
    pub const fn splat(value: f32) -> Self {
        Self(Vec4::splat(value))
    }

    /// One number a lane.
    #[inline]
    pub const fn from_lanes(lanes: [f32; 4]) -> Self {
        Self(Vec4::from_array(lanes))
    }

    /// One number a lane.
    #[inline]
    pub const fn to_lanes(self) -> [f32; 4] {
        self.0.to_array()
    }

    /// The largest lane. NaN lanes are passed over unless all are NaN.
    #[inline]
    pub fn max_lane(self) -> f32 {
        let [a, b, c, d] = self.to_lanes();
        a.max(b).max(c.max(d))
    }

    /// The mean of the lanes, (a + b) + (c + d) over 4.
    #[inline]
    pub fn mean(self) -> f32 {
        let [a, b, c, d] = self.to_lanes();
        ((a + b) + (c + d)) * 0.25
    }

    /// Whether every lane is neither infinite nor NaN.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    /// Whether every lane is 0.
    #[inline]
    pub fn is_zero(self) -> bool {
        self == Self::ZERO
    }
}

impl Add for Spectrum {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl AddAssign for Spectrum {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Spectrum {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Neg for Spectrum {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Lane by lane.
impl Mul for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl MulAssign for Spectrum {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Mul<f32> for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f32) -> Self {
        Self(self.0 * factor)
    }
}

impl Div<f32> for Spectrum {
    type Output = Self;
    #[inline]
    fn div(self, divisor: f32) -> Self {
        Self(self.0 / divisor)
    }
}

/// The factor is rounded to `f32` first.
impl Mul<f64> for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        self * factor as f32
    }
}

/// The divisor is rounded to `f32` first.
impl Div<f64> for Spectrum {
    type Output = Self;
    #[inline]
    fn div(self, divisor: f64) -> Self {
        self / divisor as f32
    }
}

impl Sum for Spectrum {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RAMP: Spectrum = Spectrum::from_lanes([1.0, 2.0, 4.0, 8.0]);

    #[test]
    fn arithmetic_is_lane_wise() {
        assert_eq!((RAMP + Spectrum::ONE).to_lanes(), [2.0, 3.0, 5.0, 9.0]);
        assert_eq!((RAMP - RAMP).to_lanes(), [0.0; 4]);
        assert_eq!((RAMP * RAMP).to_lanes(), [1.0, 4.0, 16.0, 64.0]);
        assert_eq!((-RAMP * 0.5_f32).to_lanes(), [-0.5, -1.0, -2.0, -4.0]);
        assert_eq!(RAMP * 3.0_f64, RAMP * 3.0_f32);
        assert_eq!(RAMP / 2.0_f64, RAMP * 0.5_f32);
        assert_eq!([RAMP, RAMP].into_iter().sum::<Spectrum>(), RAMP * 2.0_f32);
    }

    #[test]
    fn lanes_are_summarised() {
        assert_eq!((RAMP.max_lane(), RAMP.mean()), (8.0, 3.75));
        assert!(RAMP.is_finite() && !RAMP.is_zero() && Spectrum::ZERO.is_zero());
        assert!(!Spectrum::from_lanes([0.0, f32::NAN, 0.0, 0.0]).is_finite());
        assert!(!Spectrum::from_lanes([0.0, 0.0, 0.0, f32::INFINITY]).is_finite());
    }

    #[test]
    fn the_mean_has_a_fixed_order() {
        let cancelling = Spectrum::from_lanes([1e8, 1.0, -1e8, 1.0]);
        assert_eq!(
            cancelling.mean(),
            ((1e8_f32 + 1.0) + (-1e8_f32 + 1.0)) * 0.25
        );
    }
}
