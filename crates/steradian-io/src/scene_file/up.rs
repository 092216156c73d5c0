//! The axis that points up in a file.
//!
//! Steradian's own z axis points up. What a file with `up = "y"` says is turned by 90° about x, so that
//! (x, y, z) becomes (x, −z, y): y up, and what was nearest to the viewer (z) at −y.

use steradian::geometry::{Direction, Point, Transform, Vector};

use super::value::{Towards, choices};

/// The axis that points up.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum UpAxis {
    Y,
    Z,
}

choices! { UpAxis, "z" => Self::Z, "y" => Self::Y }

impl UpAxis {
    /// A point of a file with this axis, with z up.
    pub fn point(self, point: Point) -> Point {
        match self {
            Self::Z => point,
            Self::Y => Point::new(point.x, -point.z, point.y),
        }
    }

    /// A vector of a file with this axis, with z up.
    pub fn vector(self, vector: Vector) -> Vector {
        match self {
            Self::Z => vector,
            Self::Y => Vector::new(vector.x, -vector.z, vector.y),
        }
    }

    /// A direction of a file with this axis, with z up.
    pub fn direction(self, direction: Towards) -> Vector {
        self.vector(direction.0)
    }

    /// The turn from the coordinates of a file with this axis to z up.
    pub fn turn(self) -> Transform {
        match self {
            Self::Z => Transform::IDENTITY,
            Self::Y => {
                Transform::from_axes([Direction::X, Direction::Z, -Direction::Y].map(Vector::from))
            }
        }
    }

    /// The turn from z up to the coordinates of a file with this axis.
    pub fn turn_back(self) -> Transform {
        match self {
            Self::Z => Transform::IDENTITY,
            Self::Y => {
                Transform::from_axes([Direction::X, -Direction::Z, Direction::Y].map(Vector::from))
            }
        }
    }

    /// A point of a file with this axis, in the coordinates of a file with the axis `other`.
    pub fn point_in(self, other: Self, point: Point) -> Point {
        match (self, other) {
            (Self::Z, Self::Y) => Point::new(point.x, point.z, -point.y),
            (Self::Y, Self::Z) => self.point(point),
            _ => point,
        }
    }
}
