//! Axis-aligned boxes.

use super::point::{Point, Vector};
use crate::quantity::{Area, Length};

/// The smallest axis-aligned box around a set of points, faces included.
///
/// ```
/// use steradian::geometry::{Bounds, Point};
/// let room = Bounds::around([Point::new(0.0, 5.0, 3.0), Point::new(4.0, 0.0, 0.0)]);
/// assert_eq!(room.max().to_array(), [4.0, 5.0, 3.0]);
/// assert_eq!(room.surface_area().to_square_metres(), 94.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    min: Point,
    max: Point,
}

impl Bounds {
    /// The box around nothing. It contains no point, and its union with any box is that box.
    pub const EMPTY: Self = Self {
        min: Point::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The box around these points. NaN coordinates are passed over.
    pub fn around(points: impl IntoIterator<Item = Point>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::including)
    }

    /// The box around this one and `point`.
    pub const fn including(self, point: Point) -> Self {
        self.union(Self {
            min: point,
            max: point,
        })
    }

    /// The box around both.
    pub const fn union(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self {
            min: Point::new(
                a.min.x.min(b.min.x),
                a.min.y.min(b.min.y),
                a.min.z.min(b.min.z),
            ),
            max: Point::new(
                a.max.x.max(b.max.x),
                a.max.y.max(b.max.y),
                a.max.z.max(b.max.z),
            ),
        }
    }

    /// The corner with the smallest coordinates.
    pub const fn min(&self) -> Point {
        self.min
    }

    /// The corner with the largest coordinates.
    pub const fn max(&self) -> Point {
        self.max
    }

    /// Whether there is no point in it.
    pub const fn is_empty(&self) -> bool {
        !(self.min.x <= self.max.x && self.min.y <= self.max.y && self.min.z <= self.max.z)
    }

    /// Whether `point` is inside or on a face.
    pub fn contains(&self, point: Point) -> bool {
        let (p, min, max) = (point.to_array(), self.min.to_array(), self.max.to_array());
        (0..3).all(|axis| min[axis] <= p[axis] && p[axis] <= max[axis])
    }

    /// The lengths of the edges; 0 if empty.
    pub fn extent(&self) -> Vector {
        if self.is_empty() {
            Vector::ZERO
        } else {
            self.max - self.min
        }
    }

    /// The length of the diagonal; 0 if empty.
    pub fn diagonal(&self) -> Length {
        Length::from_metres(self.extent().length())
    }

    /// The area of the six faces; 0 if empty.
    pub fn surface_area(&self) -> Area {
        let Vector { x, y, z } = self.extent();
        Area::from_square_metres(2.0 * (x * y + y * z + z * x))
    }

    /// The centre, or `None` if empty.
    pub fn center(&self) -> Option<Point> {
        (!self.is_empty()).then(|| self.min.lerp(self.max, 0.5))
    }

    /// The eight corners; bit k of the index says whether coordinate k is the larger one.
    pub fn corners(&self) -> [Point; 8] {
        std::array::from_fn(|index| {
            let pick =
                |axis: usize, low: f64, high: f64| if index >> axis & 1 == 0 { low } else { high };
            Point::new(
                pick(0, self.min.x, self.max.x),
                pick(1, self.min.y, self.max.y),
                pick(2, self.min.z, self.max.z),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::any_vector;
    use proptest::prelude::*;

    #[test]
    fn the_empty_box_is_neutral() {
        let unit = Bounds::around([Point::ORIGIN, Point::new(1.0, 1.0, 1.0)]);
        assert_eq!(Bounds::EMPTY.union(unit), unit);
        assert!(Bounds::EMPTY.is_empty() && !unit.is_empty());
        assert!(!Bounds::EMPTY.contains(Point::ORIGIN));
        assert_eq!(Bounds::EMPTY.center(), None);
        assert_eq!(Bounds::EMPTY.surface_area(), Area::ZERO);
        assert_eq!(Bounds::EMPTY.diagonal(), Length::ZERO);
    }

    #[test]
    fn a_box_around_one_point_is_that_point() {
        let point = Point::new(1.0, 2.0, 3.0);
        let bounds = Bounds::around([point]);
        assert!(bounds.contains(point));
        assert_eq!(
            (bounds.center(), bounds.diagonal()),
            (Some(point), Length::ZERO)
        );
    }

    proptest! {
        #[test]
        fn a_box_contains_what_it_was_made_of(points in prop::collection::vec(any_vector(10.0), 1..9)) {
            let points: Vec<Point> = points.into_iter().map(|v| Point::ORIGIN + v).collect();
            let bounds = Bounds::around(points.iter().copied());
            prop_assert!(points.iter().all(|&p| bounds.contains(p)));
            prop_assert_eq!(Bounds::around(bounds.corners()), bounds);
            for axis in 0..3 {
                prop_assert!(points.iter().any(|p| p.to_array()[axis] == bounds.min().to_array()[axis]));
                prop_assert!(points.iter().any(|p| p.to_array()[axis] == bounds.max().to_array()[axis]));
            }
        }
    }
}
