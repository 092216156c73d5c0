//! How large a polygon with holes looks: its outline less its holes.

use super::Polygon;
use crate::geometry::{Direction, Point, configuration_factor, solid_angle};
use crate::quantity::SolidAngle;

impl Polygon {
    /// The solid angle of the polygon without its holes, seen from either side.
    ///
    /// ```
    /// use steradian::geometry::{Point, Polygon};
    /// let square = |half: f64| {
    ///     [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| Point::new(x, y, 0.0)).to_vec()
    /// };
    /// // A square of half side a, seen from the height h over its centre, fills 4 asin(a²/(a² + h²)).
    /// let frame = Polygon::new(square(2.0), vec![square(1.0)])?;
    /// let found = frame.solid_angle_from(Point::new(0.0, 0.0, 1.0));
    /// assert!((found.to_steradians() - 1.614785769613).abs() < 1e-12); // 4 (asin(4/5) − asin(1/2))
    /// # Ok::<(), steradian::geometry::PolygonError>(())
    /// ```
    pub fn solid_angle_from(&self, observer: Point) -> SolidAngle {
        let holes: SolidAngle = self
            .holes()
            .map(|hole| solid_angle::of_polygon(observer, hole))
            .sum();
        solid_angle::of_polygon(observer, self.outline()) - holes
    }

    /// The configuration factor of the polygon without its holes, from an element at `position`; either side counts.
    pub fn configuration_factor_from(&self, position: Point, normal: Direction) -> f64 {
        let holes: f64 = self
            .holes()
            .map(|hole| configuration_factor::of_polygon(position, normal, hole))
            .sum();
        configuration_factor::of_polygon(position, normal, self.outline()) - holes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_triangles_fill_the_view_of_the_polygon(eye in any_vector(3.0), normal in any_direction()) {
            prop_assume!(eye.z.abs() > 1e-2);
            let square = |half: f64, x: f64| {
                let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
                corners.map(|(u, v)| Point::new(u + x, v, 0.0)).to_vec()
            };
            let polygon = Polygon::new(square(2.0, 0.0), vec![square(0.5, 1.0), square(0.3, -1.0)]).unwrap();
            let eye = Point::ORIGIN + eye;
            let solid_angle: SolidAngle =
                polygon.triangle_corners().map(|corners| solid_angle::of_triangle(eye, corners)).sum();
            prop_assert!(close(polygon.solid_angle_from(eye).to_steradians(), solid_angle.to_steradians(), 1e-12));
            let factor: f64 =
                polygon.triangle_corners().map(|corners| configuration_factor::of_polygon(eye, normal, &corners)).sum();
            prop_assert!(close(polygon.configuration_factor_from(eye, normal), factor, 1e-12));
        }
    }
}
