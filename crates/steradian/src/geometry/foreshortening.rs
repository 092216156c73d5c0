//! Foreshortening: a surface seen at an angle looks smaller by the cosine.
//!
//! An element dA whose normal makes the angle θ with the line of sight covers dA cosθ across that line, and at
//! the distance r it fills
//!
//! dω = dA cosθ / r²
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | dA | area of the element | m² |
//! | θ | angle between the element's normal and the direction to the observer | rad |
//! | r | distance to the observer | m |
//! | dω | solid angle filled | sr |
//!
//! Exact for an infinitesimal element. For an element of finite size it is an approximation whose relative
//! error shrinks as (size/r)²; [`solid_angle`](super::solid_angle) has the exact values. An element seen from
//! behind counts as zero.
//!
//! ```
//! use steradian::geometry::{Direction, Point, SurfaceElement};
//! use steradian::quantity::Area;
//! let element = SurfaceElement {
//!     position: Point::ORIGIN,
//!     normal: Direction::Z,
//!     area: Area::from_square_metres(0.01),
//! };
//! let above = element.solid_angle_from(Point::new(0.0, 0.0, 2.0));
//! assert_eq!(above.to_steradians(), 0.0025);
//! let aside = element.solid_angle_from(Point::new(3.0, 0.0, 4.0)); // cosθ = 0.8, r = 5
//! assert!((aside.to_steradians() - 0.01 * 0.8 / 25.0).abs() < 1e-18);
//! ```

use super::direction::Direction;
use super::point::Point;
use crate::quantity::{Area, SolidAngle};

/// A small piece of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceElement {
    /// Where it is.
    pub position: Point,
    /// Which way it faces.
    pub normal: Direction,
    /// How large it is.
    pub area: Area,
}

impl SurfaceElement {
    /// dA cosθ: the area across the direction `towards`; 0 from behind.
    pub fn projected_area(&self, towards: Direction) -> Area {
        self.area * self.normal.dot(towards).max(0.0)
    }

    /// dω = dA cosθ / r², as seen from `observer`; 0 from behind and from the element's own position.
    pub fn solid_angle_from(&self, observer: Point) -> SolidAngle {
        let to_observer = observer - self.position;
        match Direction::new(to_observer) {
            Ok(towards) => SolidAngle::of_patch(
                self.projected_area(towards),
                self.position.distance(observer),
            ),
            Err(_) => SolidAngle::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;
    use crate::geometry::{Spherical, solid_angle};
    use crate::quantity::Angle;

    const ELEMENT: SurfaceElement = SurfaceElement {
        position: Point::ORIGIN,
        normal: Direction::Z,
        area: Area::from_square_metres(4.0),
    };

    #[test]
    fn edge_on_and_behind_are_nothing() {
        assert_eq!(ELEMENT.projected_area(Direction::X), Area::ZERO);
        assert_eq!(ELEMENT.projected_area(-Direction::Z), Area::ZERO);
        assert_eq!(
            ELEMENT.solid_angle_from(Point::new(0.0, 0.0, -1.0)),
            SolidAngle::ZERO
        );
        assert_eq!(ELEMENT.solid_angle_from(Point::ORIGIN), SolidAngle::ZERO);
        assert_eq!(ELEMENT.projected_area(Direction::Z), ELEMENT.area);
    }

    #[test]
    fn it_is_the_limit_of_the_exact_solid_angle() {
        // A small right triangle seen from 60° off its normal; the relative error falls with the square of its size.
        let towards =
            Spherical::new(Angle::from_degrees(60.0), Angle::from_degrees(20.0)).to_direction();
        let error = |size: f64| {
            let corners = [(-1.0, -1.0), (2.0, -1.0), (-1.0, 2.0)]
                .map(|(x, y)| Point::new(x * size, y * size, 0.0));
            let element = SurfaceElement {
                area: Area::from_square_metres(4.5 * size * size),
                ..ELEMENT
            };
            let observer = Point::ORIGIN + towards.to_vector();
            element.solid_angle_from(observer) / solid_angle::of_triangle(observer, corners) - 1.0
        };
        assert!(close(error(1e-2), 0.0, 1e-3));
        let order = (error(1e-2) / error(5e-3)).abs();
        assert!(close(order, 4.0, 0.2), "{order}");
    }
}
