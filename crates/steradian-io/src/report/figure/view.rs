//! From where the points of a sensor are looked at: floors and tables from above, walls from their front.
//!
//! A plane that is less than 60° from level is seen from above, with x to the right and y up. A steeper one is seen from the
//! side that its normal points to: to the right runs the level direction in it, and up the other one, for a wall z.

use steradian::geometry::Vector;
use steradian::sensor::Layout;

/// Cosine of the steepest tilt that is seen from above.
const STEEPEST: f64 = 0.5;
/// Two directions whose cosine is this near to 1 have the same name.
const SAME: f64 = 1.0 - 1e-9;

/// Two directions of space, which are right and up in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    right: Vector,
    up: Vector,
}

impl View {
    /// From above.
    pub const ABOVE: Self = Self {
        right: Vector::new(1.0, 0.0, 0.0),
        up: Vector::new(0.0, 1.0, 0.0),
    };

    /// Of a grid whose points have this normal.
    pub fn of(layout: &Layout, normal: Option<[f64; 3]>) -> Self {
        let [first, second] = layout.edges.map(vector);
        let plane = first.cross(second);
        let towards = normal.map_or(plane, vector);
        let plane = if plane.dot(towards) < 0.0 {
            -plane
        } else {
            plane
        };
        if plane.length() <= 0.0 || plane.z.abs() >= STEEPEST * plane.length() {
            return Self::ABOVE;
        }
        let level = Vector::new(-plane.y, plane.x, 0.0);
        let right = level * (1.0 / level.length());
        let up = plane.cross(right) * (1.0 / plane.length());
        Self { right, up }
    }

    /// Where a point of space is in the picture, in metres.
    pub fn place(&self, point: [f64; 3]) -> [f64; 2] {
        let point = vector(point);
        [self.right, self.up].map(|axis| axis.dot(point) + 0.0)
    }

    /// What the axes of the picture show.
    pub fn axes(&self) -> [String; 2] {
        let name = |axis: Vector, other: &str| {
            let along = [("x", axis.x), ("y", axis.y), ("z", axis.z)];
            let named = along.into_iter().find(|(_, cosine)| cosine.abs() > SAME);
            let sign = |cosine: f64| if cosine < 0.0 { "−" } else { "" };
            match named {
                Some((name, cosine)) => format!("{}{name} (m)", sign(cosine)),
                None => format!("{other} (m)"),
            }
        };
        [name(self.right, "to the right"), name(self.up, "upwards")]
    }
}

fn vector([x, y, z]: [f64; 3]) -> Vector {
    Vector::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(edges: [[f64; 3]; 2]) -> Layout {
        Layout {
            origin: [0.0; 3],
            edges,
            count: [2, 2],
        }
    }

    #[test]
    fn level_grids_are_seen_from_above_whatever_their_normal() {
        let floor = grid([[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]]);
        let ceiling = grid([[0.0, 3.0, 0.0], [2.0, 0.0, 0.0]]);
        for (layout, normal) in [
            (floor, None),
            (ceiling, None),
            (floor, Some([1.0, 0.0, 0.0])),
        ] {
            assert_eq!(View::of(&layout, normal), View::ABOVE);
        }
        assert_eq!(View::ABOVE.place([1.0, 2.0, 3.0]), [1.0, 2.0]);
    }

    /// Who looks at the front of a wall at y = 0 that faces −y has x to the right; at one that faces +y, −x.
    #[test]
    fn walls_are_seen_from_their_front() {
        let wall = grid([[2.0, 0.0, 0.0], [0.0, 0.0, 3.0]]);
        let view = View::of(&wall, Some([0.0, -1.0, 0.0]));
        assert_eq!(view.axes(), ["x (m)", "z (m)"]);
        assert_eq!(view.place([1.0, 5.0, 2.0]), [1.0, 2.0]);
        let other = View::of(&wall, Some([0.0, 1.0, 0.0]));
        assert_eq!(other.axes(), ["−x (m)", "z (m)"]);
        assert_eq!(other.place([1.0, 5.0, 2.0]), [-1.0, 2.0]);
    }

    #[test]
    fn a_wall_across_has_its_own_axis() {
        let wall = grid([[1.0, 1.0, 0.0], [0.0, 0.0, 3.0]]);
        let view = View::of(&wall, None);
        assert_eq!(view.axes(), ["to the right (m)", "z (m)"]);
        let [right, up] = view.place([1.0, 1.0, 2.0]);
        assert!((right - 2.0_f64.sqrt()).abs() < 1e-12 && (up - 2.0).abs() < 1e-12);
    }
}
