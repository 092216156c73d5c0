//! Directions: vectors of length one.
//!
//! A [`Direction`] is made from a [`Vector`] of any length but zero, once, so that whoever holds one need not ask
//! about its length again. In reflection both directions, towards the light and towards the viewer, point away from
//! the surface.

use std::ops::{Mul, Neg};

use serde::{Deserialize, Serialize};

use super::point::Vector;

/// A vector of length one, to within rounding: | |d| − 1 | ≤ 4·2⁻⁵³.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "[f64; 3]", into = "[f64; 3]")]
pub struct Direction(Vector);

/// A vector without a direction: zero, infinite or NaN.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("[{}, {}, {}] has no direction", .0.x, .0.y, .0.z)]
pub struct NoDirection(pub Vector);

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

    /// (sinθ cosφ, sinθ sinφ, cosθ) from the sine and cosine of θ.
    #[inline]
    pub(crate) fn from_polar(sin_theta: f64, cos_theta: f64, phi: f64) -> Self {
        Self::from_unit(Vector::new(
            sin_theta * libm::cos(phi),
            sin_theta * libm::sin(phi),
            cos_theta,
        ))
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
        let lost = [
            Vector::ZERO,
            Vector::new(f64::NAN, 0.0, 1.0),
            Vector::new(0.0, f64::INFINITY, 0.0),
        ];
        assert!(lost.iter().all(|&vector| Direction::new(vector).is_err()));
    }

    #[test]
    fn an_array_without_direction_is_refused_when_read() {
        let error = serde_json::from_str::<Direction>("[0, 0, 0]")
            .unwrap_err()
            .to_string();
        assert!(error.starts_with("[0, 0, 0] has no direction"), "{error}");
    }

    proptest! {
        #[test]
        fn directions_have_unit_length_and_survive_serialisation(
            v in prop::array::uniform3(-1e3..1e3_f64),
        ) {
            prop_assume!(v != [0.0; 3]);
            let direction = Direction::new(v.into()).unwrap();
            prop_assert!((direction.to_vector().length() - 1.0).abs() <= 2.0 * f64::EPSILON);
            let text = serde_json::to_string(&direction).unwrap();
            prop_assert_eq!(serde_json::from_str::<Direction>(&text).unwrap(), direction);
        }
    }
}
