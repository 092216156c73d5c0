//! Points and vectors.
//!
//! A [`Point`] is a place, a [`Vector`] a difference of places. Their
//! arithmetic is that of affine space: `Point - Point` is a vector, `Point + Vector` a point, and a sum of two
//! points does not exist, for it would depend on where the origin is. Coordinates are metres, in `f64`,
//! right-handed with Z up.
//!
//! ```
//! use steradian::geometry::{Direction, Point, Vector};
//! let lamp = Point::new(0.0, 0.0, 1.0);
//! let desk = Point::new(3.0, 0.0, -3.0);
//! let to_lamp = lamp - desk;
//! assert_eq!(to_lamp, Vector::new(-3.0, 0.0, 4.0));
//! assert_eq!(to_lamp.length(), 5.0);
//! let cos_theta = Direction::new(to_lamp).unwrap().dot(Direction::Z);
//! assert_eq!(cos_theta, 0.8);
//! ```
//!
//! ```compile_fail,E0308
//! use steradian::geometry::Point;
//! let nonsense = Point::ORIGIN + Point::ORIGIN;
//! ```

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use serde::{Deserialize, Serialize};

use crate::quantity::Length;

/// A place, in metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 3]", into = "[f64; 3]")]
pub struct Point {
    /// The first coordinate.
    pub x: f64,
    /// The second coordinate.
    pub y: f64,
    /// The third coordinate, upwards.
    pub z: f64,
}

/// A displacement, or any vector that is not of unit length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 3]", into = "[f64; 3]")]
pub struct Vector {
    /// The first component.
    pub x: f64,
    /// The second component.
    pub y: f64,
    /// The third component, upwards.
    pub z: f64,
}

impl Point {
    /// The place where all coordinates are 0.
    pub const ORIGIN: Self = Self::new(0.0, 0.0, 0.0);

    /// The point of these coordinates in metres.
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The distance to `other`.
    pub fn distance(self, other: Self) -> Length {
        Length::from_metres((other - self).length())
    }

    /// The point at the fraction `t` of the way to `other`.
    pub fn lerp(self, other: Self, t: f64) -> Self {
        self + (other - self) * t
    }

    /// The vector from the origin.
    pub const fn to_vector(self) -> Vector {
        Vector::new(self.x, self.y, self.z)
    }

    /// The coordinates.
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Whether no coordinate is infinite or NaN.
    pub const fn is_finite(self) -> bool {
        self.to_vector().is_finite()
    }
}

impl Vector {
    /// The vector of length 0.
    pub const ZERO: Self = Self::new(0.0, 0.0, 0.0);

    /// The vector of these components.
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The scalar product, |a| |b| cosθ.
    #[inline]
    pub const fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The vector product: perpendicular to both, |a| |b| sinθ long, right-handed.
    #[inline]
    pub const fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// |v|². Overflows beyond lengths of 10¹⁵⁴.
    #[inline]
    pub const fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// |v|.
    #[inline]
    pub fn length(self) -> f64 {
        self.length_squared().sqrt()
    }

    /// The largest magnitude of a component.
    pub const fn max_component(self) -> f64 {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }

    /// The components.
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Whether no component is infinite or NaN.
    pub const fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

impl Sub for Point {
    type Output = Vector;
    #[inline]
    fn sub(self, other: Self) -> Vector {
        Vector::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Add<Vector> for Point {
    type Output = Self;
    #[inline]
    fn add(self, step: Vector) -> Self {
        Self::new(self.x + step.x, self.y + step.y, self.z + step.z)
    }
}

impl Sub<Vector> for Point {
    type Output = Self;
    #[inline]
    fn sub(self, step: Vector) -> Self {
        self + -step
    }
}

impl AddAssign<Vector> for Point {
    #[inline]
    fn add_assign(&mut self, step: Vector) {
        *self = *self + step;
    }
}

impl Add for Vector {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl AddAssign for Vector {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Vector {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl SubAssign for Vector {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Neg for Vector {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl Mul<f64> for Vector {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl Mul<Vector> for f64 {
    type Output = Vector;
    #[inline]
    fn mul(self, vector: Vector) -> Vector {
        vector * self
    }
}

impl Div<f64> for Vector {
    type Output = Self;
    #[inline]
    fn div(self, divisor: f64) -> Self {
        Self::new(self.x / divisor, self.y / divisor, self.z / divisor)
    }
}

impl From<[f64; 3]> for Point {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }
}

impl From<Point> for [f64; 3] {
    fn from(point: Point) -> Self {
        point.to_array()
    }
}

impl From<[f64; 3]> for Vector {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }
}

impl From<Vector> for [f64; 3] {
    fn from(vector: Vector) -> Self {
        vector.to_array()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::any_vector;
    use proptest::prelude::*;

    #[test]
    fn points_are_written_as_arrays() {
        let point: Point = serde_json::from_str("[1, 2.5, -3]").unwrap();
        assert_eq!(point, Point::new(1.0, 2.5, -3.0));
        assert_eq!(serde_json::to_string(&point).unwrap(), "[1.0,2.5,-3.0]");
    }

    #[test]
    fn steps_lead_from_point_to_point() {
        let (here, there) = (Point::new(1.0, 2.0, 3.0), Point::new(5.0, 2.0, 0.0));
        assert_eq!(here + (there - here), there);
        assert_eq!(there - (there - here), here);
        assert_eq!(here.distance(there), Length::from_metres(5.0));
        assert_eq!(here.lerp(there, 0.25), Point::new(2.0, 2.0, 2.25));
    }

    proptest! {
        #[test]
        fn the_cross_product_is_perpendicular(a in any_vector(1.0), b in any_vector(1.0)) {
            prop_assert!(a.cross(b).dot(a).abs() <= 1e-15);
            prop_assert_eq!(a.cross(b), -b.cross(a));
        }

        #[test]
        fn dot_and_cross_share_the_lengths(a in any_vector(1.0), b in any_vector(1.0)) {
            // Lagrange: (a·b)² + |a × b|² = |a|² |b|².
            let sum = a.dot(b) * a.dot(b) + a.cross(b).length_squared();
            prop_assert!((sum - a.length_squared() * b.length_squared()).abs() <= 1e-14);
        }
    }
}
