//! Points, vectors and directions.
//!
//! A [`Point`] is a place, a [`Vector`] a difference of places, a [`Direction`] a vector of length one. Their
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

/// A vector of length one, to within rounding: | |d| − 1 | ≤ 4·2⁻⁵³.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "[f64; 3]", into = "[f64; 3]")]
pub struct Direction(Vector);

/// A vector without a direction: zero, infinite or NaN.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("[{}, {}, {}] has no direction", .0.x, .0.y, .0.z)]
pub struct NoDirection(pub Vector);

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

impl Direction {
    /// Along the first axis.
    pub const X: Self = Self(Vector::new(1.0, 0.0, 0.0));
    /// Along the second axis.
    pub const Y: Self = Self(Vector::new(0.0, 1.0, 0.0));
    /// Upwards.
    pub const Z: Self = Self(Vector::new(0.0, 0.0, 1.0));

    /// The direction of `vector`, of any finite length but 0, however small or large.
    ///
    /// A vector that is of unit length to within rounding is kept as it is, so that a direction survives being
    /// written and read.
    ///
    /// # Errors
    /// If the vector is zero or not finite.
    pub fn new(vector: Vector) -> Result<Self, NoDirection> {
        if (vector.length_squared() - 1.0).abs() <= 4.0 * f64::EPSILON {
            return Ok(Self(vector));
        }
        let size = vector.max_component();
        if !(vector.is_finite() && size > 0.0) {
            return Err(NoDirection(vector));
        }
        // 1/size would overflow for a subnormal size, so the components are divided one by one.
        let scaled = vector / size;
        Ok(Self(scaled / scaled.length()))
    }

    /// A direction from components known to be of unit length to within rounding.
    #[inline]
    pub(crate) fn from_unit(vector: Vector) -> Self {
        debug_assert!(
            (vector.length_squared() - 1.0).abs() < 1e-12,
            "{vector:?} is not of unit length"
        );
        Self(vector)
    }

    /// The vector of length one.
    #[inline]
    pub const fn to_vector(self) -> Vector {
        self.0
    }

    /// The components.
    pub const fn to_array(self) -> [f64; 3] {
        self.0.to_array()
    }

    /// The first component.
    #[inline]
    pub const fn x(self) -> f64 {
        self.0.x
    }

    /// The second component.
    #[inline]
    pub const fn y(self) -> f64 {
        self.0.y
    }

    /// The third component, upwards.
    #[inline]
    pub const fn z(self) -> f64 {
        self.0.z
    }

    /// The cosine of the angle between two directions; the part of a vector along this direction.
    #[inline]
    pub fn dot(self, other: impl Into<Vector>) -> f64 {
        self.0.dot(other.into())
    }

    /// The vector product: perpendicular to both, right-handed.
    #[inline]
    pub fn cross(self, other: impl Into<Vector>) -> Vector {
        self.0.cross(other.into())
    }

    /// The direction mirrored at this normal: r = 2 (n·d) n − d, with d pointing away from the surface.
    ///
    /// ```
    /// use steradian::geometry::{Direction, Vector};
    /// let incoming = Direction::new(Vector::new(0.6, 0.0, 0.8)).unwrap();
    /// assert_eq!(Direction::Z.mirror(incoming).to_array(), [-0.6, 0.0, 0.8]);
    /// ```
    pub fn mirror(self, direction: Self) -> Self {
        let mirrored = self.0 * (2.0 * self.dot(direction)) - direction.0;
        Self(mirrored / mirrored.length())
    }
}

impl Sub for Point {
    type Output = Vector;
    #[inline]
    fn sub(self, other: Self) -> Vector {
        Vector::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<V: Into<Vector>> Add<V> for Point {
    type Output = Self;
    #[inline]
    fn add(self, step: V) -> Self {
        let step = step.into();
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

impl Neg for Direction {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Mul<f64> for Direction {
    type Output = Vector;
    #[inline]
    fn mul(self, length: f64) -> Vector {
        self.0 * length
    }
}

impl From<Direction> for Vector {
    #[inline]
    fn from(direction: Direction) -> Self {
        direction.0
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

impl TryFrom<[f64; 3]> for Direction {
    type Error = NoDirection;

    fn try_from(components: [f64; 3]) -> Result<Self, NoDirection> {
        Self::new(components.into())
    }
}

impl From<Direction> for [f64; 3] {
    fn from(direction: Direction) -> Self {
        direction.to_array()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn directions_exist_at_any_finite_scale() {
        for size in [5e-324, 1e-300, 1.0, 1e300, f64::MAX] {
            let direction = Direction::new(Vector::new(0.0, -size, 0.0)).unwrap();
            assert_eq!(direction, -Direction::Y);
        }
        for lost in [
            Vector::ZERO,
            Vector::new(f64::NAN, 0.0, 1.0),
            Vector::new(0.0, f64::INFINITY, 0.0),
        ] {
            assert!(Direction::new(lost).is_err());
        }
    }

    #[test]
    fn points_are_written_as_arrays() {
        let point: Point = serde_json::from_str("[1, 2.5, -3]").unwrap();
        assert_eq!(point, Point::new(1.0, 2.5, -3.0));
        assert_eq!(serde_json::to_string(&point).unwrap(), "[1.0,2.5,-3.0]");
        let error = serde_json::from_str::<Direction>("[0, 0, 0]")
            .unwrap_err()
            .to_string();
        assert!(error.starts_with("[0, 0, 0] has no direction"), "{error}");
    }

    proptest! {
        #[test]
        fn directions_have_unit_length_and_survive_serialisation(v in prop::array::uniform3(-1e3..1e3_f64)) {
            prop_assume!(v != [0.0; 3]);
            let direction = Direction::new(v.into()).unwrap();
            prop_assert!((direction.to_vector().length() - 1.0).abs() <= 2.0 * f64::EPSILON);
            let text = serde_json::to_string(&direction).unwrap();
            prop_assert_eq!(serde_json::from_str::<Direction>(&text).unwrap(), direction);
        }

        #[test]
        fn the_cross_product_is_perpendicular(
            a in prop::array::uniform3(-1.0..1.0_f64),
            b in prop::array::uniform3(-1.0..1.0_f64),
        ) {
            let (a, b) = (Vector::from(a), Vector::from(b));
            prop_assert!(a.cross(b).dot(a).abs() <= 1e-15);
            prop_assert_eq!(a.cross(b), -b.cross(a));
        }
    }
}
