//! Orthonormal frames: local coordinates in which a given normal is the third axis.
//!
//! In the frame of a surface point the polar angle of a direction is its angle from the normal, so that
//! cosθ is its third component. Warps, reflection models and spherical coordinates all work there.
//!
//! Built without branches or square roots after Duff, Burgess, Christensen, Hery, Kensler, Liani & Villemin,
//! "Building an Orthonormal Basis, Revisited", JCGT 6 (1), 2017, listing 3. The tangents turn continuously with
//! the normal except where it crosses the plane z = 0.

use super::direction::Direction;
use super::point::Vector;

/// Three perpendicular directions, right-handed: tangent × bitangent = normal.
///
/// ```
/// use steradian::geometry::{Direction, Frame};
/// let frame = Frame::from_normal(Direction::X);
/// assert_eq!(frame.to_local(Direction::X), Direction::Z);
/// assert_eq!(frame.to_world(Direction::Z), Direction::X);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    tangent: Direction,
    bitangent: Direction,
    normal: Direction,
}

impl Frame {
    /// The world's own axes.
    pub const WORLD: Self = Self {
        tangent: Direction::X,
        bitangent: Direction::Y,
        normal: Direction::Z,
    };

    /// A frame around `normal`; which tangents it gets is a fixed but arbitrary function of the normal.
    pub fn from_normal(normal: Direction) -> Self {
        let [x, y, z] = normal.to_array();
        let sign = 1.0_f64.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        Self {
            tangent: Direction::from_unit(Vector::new(1.0 + sign * x * x * a, sign * b, -sign * x)),
            bitangent: Direction::from_unit(Vector::new(b, sign + y * y * a, -y)),
            normal,
        }
    }

    /// The frame around `normal` whose tangent is the part of `towards` that is perpendicular to it; `None` if
    /// `towards` is parallel to the normal, zero or not finite.
    pub fn from_normal_and_tangent(normal: Direction, towards: Vector) -> Option<Self> {
        let part = Direction::new(towards).ok()?;
        let tangent = part.to_vector() - normal * normal.dot(part);
        // Below this length the difference above is mostly rounding.
        let tangent = (tangent.length() > 1e-8).then_some(tangent)?;
        let tangent = Direction::new(tangent - normal * normal.dot(tangent)).ok()?;
        Some(Self {
            tangent,
            bitangent: Direction::new(normal.cross(tangent)).ok()?,
            normal,
        })
    }

    /// The first axis.
    pub const fn tangent(&self) -> Direction {
        self.tangent
    }

    /// The second axis.
    pub const fn bitangent(&self) -> Direction {
        self.bitangent
    }

    /// The third axis.
    pub const fn normal(&self) -> Direction {
        self.normal
    }

    /// A world direction in the frame's coordinates: its third component is the cosine with the normal.
    #[inline]
    pub fn to_local(&self, direction: Direction) -> Direction {
        Direction::from_unit(self.vector_to_local(direction.into()))
    }

    /// A direction in the frame's coordinates, in world coordinates.
    #[inline]
    pub fn to_world(&self, direction: Direction) -> Direction {
        Direction::from_unit(self.vector_to_world(direction.into()))
    }

    /// A world vector in the frame's coordinates.
    #[inline]
    pub fn vector_to_local(&self, vector: Vector) -> Vector {
        Vector::new(
            self.tangent.dot(vector),
            self.bitangent.dot(vector),
            self.normal.dot(vector),
        )
    }

    /// A vector in the frame's coordinates, in world coordinates.
    #[inline]
    pub fn vector_to_world(&self, vector: Vector) -> Vector {
        self.tangent * vector.x + self.bitangent * vector.y + self.normal * vector.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, close};
    use proptest::prelude::*;

    fn assert_orthonormal(frame: &Frame) {
        let [t, b, n] = [frame.tangent, frame.bitangent, frame.normal];
        for (axis, other) in [(t, b), (b, n), (n, t)] {
            assert!(axis.dot(other).abs() < 4.0 * f64::EPSILON, "{frame:?}");
            assert!(
                close(axis.to_vector().length(), 1.0, 4.0 * f64::EPSILON),
                "{frame:?}"
            );
        }
        assert!(
            close(t.cross(b).dot(n.to_vector()), 1.0, 8.0 * f64::EPSILON),
            "{frame:?}"
        );
    }

    #[test]
    fn the_poles_and_the_equator_are_no_exception() {
        for z in [1.0, -1.0, 0.0, -0.0, 1e-300, -1e-300] {
            for (x, y) in [(0.0, 0.0), (1.0, 0.0), (-0.6, 0.8), (1e-9, -1e-9)] {
                if let Ok(normal) = Direction::new(Vector::new(x, y, z)) {
                    assert_orthonormal(&Frame::from_normal(normal));
                }
            }
        }
    }

    #[test]
    fn a_parallel_tangent_gives_no_frame() {
        assert_eq!(
            Frame::from_normal_and_tangent(Direction::Z, Vector::new(0.0, 0.0, 2.0)),
            None
        );
        assert_eq!(
            Frame::from_normal_and_tangent(Direction::Z, Vector::new(1e-12, 0.0, -1.0)),
            None
        );
        assert_eq!(
            Frame::from_normal_and_tangent(Direction::Z, Vector::ZERO),
            None
        );
        assert_eq!(
            Frame::from_normal_and_tangent(Direction::Z, Vector::new(3.0, 0.0, 9.0)),
            Some(Frame::WORLD)
        );
    }

    proptest! {
        #[test]
        fn frames_are_orthonormal(normal in any_direction(), towards in any_direction()) {
            assert_orthonormal(&Frame::from_normal(normal));
            if let Some(frame) = Frame::from_normal_and_tangent(normal, towards.into()) {
                assert_orthonormal(&frame);
                prop_assert!(frame.tangent().dot(towards) >= 0.0);
            }
        }

        #[test]
        fn local_and_world_are_inverse(normal in any_direction(), direction in any_direction()) {
            let frame = Frame::from_normal(normal);
            let back = frame.to_world(frame.to_local(direction));
            prop_assert!((back.to_vector() - direction.to_vector()).length() < 8.0 * f64::EPSILON);
            prop_assert!(close(frame.to_local(direction).z(), normal.dot(direction), f64::EPSILON));
        }
    }
}
