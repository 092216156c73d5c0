//! Directions towards a triangle, uniform in solid angle.
//!
//! With the corners A, B, C projected onto the unit sphere, a point C′ of the arc from A to C at the arc length s cuts off
//! the triangle ABC′ of the solid angle E,
//!
//! tan(E/2) = p tan(s/2) / (1 + A·B + q tan(s/2)) ,  p = A·(B × T) ,  q = B·T
//!
//! where T is the tangent at A towards C (Van Oosterom & Strackee's formula, with C′ = A cos s + T sin s). Setting E = uω and
//! solving for tan(s/2) gives C′; on the arc from B to C′ the solid angle grows as 1 − cosβ, hence sin(β/2) = √v sin(β′/2).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ω | solid angle of the triangle | sr |
//! | u, v | uniform numbers | – |
//! | s, β | arc lengths from A to C′ and from B to the sample | rad |
//! | β′ | arc length from B to C′ | rad |
//!
//! Density: 1/ω per steradian, so a sample of radiance L has the weight Lω: the estimate of ∫ L dω over an unoccluded triangle of constant
//! radiance has no variance, and no weight exceeds that.
//!
//! Precision: all differences are of corners or half angles, so that relative errors are some 2⁻⁵²/α for a triangle that
//! subtends the angle α, however small, and triangles up to a hemisphere are as good.
//!
//! Source: J. Arvo, *Stratified sampling of spherical triangles* (SIGGRAPH 1995), whose subtractions of angles this form
//! avoids.
//!
//! ```
//! use steradian::geometry::Vector;
//! use steradian::sampling::spherical_triangle::SphericalTriangle;
//! // An octant fills π/2, and half of it lies on either side of the meridian of 45°.
//! let axes = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Vector::from);
//! let octant = SphericalTriangle::new(axes).unwrap();
//! assert!((octant.solid_angle().to_steradians() - 0.5 * std::f64::consts::PI).abs() < 1e-15);
//! let inverse = octant.inverse(octant.sample([0.3, 0.7]));
//! assert!((inverse[0] - 0.3).abs() < 1e-15 && (inverse[1] - 0.7).abs() < 1e-15);
//! ```

use crate::geometry::{Direction, Vector};
use crate::quantity::SolidAngle;

/// A triangle as seen by an observer at the origin.
#[derive(Copy, Clone, Debug)]
pub struct SphericalTriangle {
    /// A and B on the unit sphere.
    corners: [Vector; 2],
    /// T.
    tangent: Vector,
    /// T × A, the normal of the plane of A and C.
    side: Vector,
    p: f64,
    q: f64,
    /// 1 + A·B.
    one_plus_cos: f64,
    half_solid_angle: f64,
}

impl SphericalTriangle {
    /// The triangle with these corners relative to the observer; `None` if it is seen edge-on or its corners have no
    /// direction.
    pub fn new([a, b, c]: [Vector; 3]) -> Option<Self> {
        let unit = |v: Vector| Direction::new(v).ok().map(Direction::to_vector);
        let (first, second, last) = (unit(a)?, unit(b)?, unit(c)?);
        let normal = first.cross(c - a);
        let side = -unit(normal)?;
        let p = (b - a).dot(side) / b.length();
        // Turned round, the corners run the other way.
        let side = if p < 0.0 { -side } else { side };
        let tangent = unit(normal.cross(first))?;
        let q = (b - a).dot(tangent) / b.length();
        let one_plus_cos = 0.5 * (first + second).length_squared();
        let (sin, cos) = (normal.length() / c.length(), first.dot(last));
        let half_solid_angle = libm::atan2(p.abs() * sin, one_plus_cos * (1.0 + cos) + q * sin);
        (half_solid_angle > 0.0).then_some(Self {
            corners: [first, second],
            tangent,
            side,
            p: p.abs(),
            q,
            one_plus_cos,
            half_solid_angle,
        })
    }

    /// ω, one over the density.
    pub fn solid_angle(&self) -> SolidAngle {
        SolidAngle::from_steradians(2.0 * self.half_solid_angle)
    }

    /// A direction of uniform density 1/ω.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Direction {
        let [_, b] = self.corners;
        let towards = self.chord(u);
        let squared = towards.length_squared();
        let sin_half = 0.5 * (v * squared).sqrt();
        // The chord less its part along B is tangent to the sphere there.
        let tangent = towards + b * (0.5 * squared);
        let length = tangent.length();
        let cos_half = ((1.0 - sin_half) * (1.0 + sin_half)).max(0.0).sqrt();
        let scale = if length > 0.0 {
            2.0 * sin_half * cos_half / length
        } else {
            0.0
        };
        let direction = b * (1.0 - 2.0 * sin_half * sin_half) + tangent * scale;
        Direction::from_unit(direction / direction.length())
    }

    /// C′ − B for E = uω.
    fn chord(&self, u: f64) -> Vector {
        let [a, b] = self.corners;
        let (sin, cos) = libm::sincos(u * self.half_solid_angle);
        let (numerator, denominator) = (self.one_plus_cos * sin, self.p * cos - self.q * sin);
        let scale = 2.0 / (numerator * numerator + denominator * denominator);
        let (sin_s, one_minus_cos_s) = (
            numerator * denominator * scale,
            numerator * numerator * scale,
        );
        (a - b) - a * one_minus_cos_s + self.tangent * sin_s
    }

    /// The numbers that [`sample`](Self::sample) maps to a direction within the triangle.
    pub fn inverse(&self, direction: Direction) -> [f64; 2] {
        let [a, b] = self.corners;
        let corner = b.cross(direction.to_vector() - b).cross(self.side);
        let (along, across) = (corner.dot(a), corner.dot(self.tangent));
        let length = libm::hypot(along, across);
        let (sin, cos) = if length == 0.0 {
            (0.0, 1.0)
        } else {
            (across / length, along / length)
        };
        let half = libm::atan2(self.p * sin, self.one_plus_cos * (1.0 + cos) + self.q * sin);
        let chord = (a - b) - a * (1.0 - cos) + self.tangent * sin;
        let reached = direction.to_vector() - b;
        let fraction = reached.length_squared() / chord.length_squared();
        [half / self.half_solid_angle, fraction]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::any_vector;
    use crate::geometry::{Point, solid_angle};
    use crate::sampling::testing::{EqualArea, assert_uniform, independent};
    use proptest::prelude::*;

    /// Near, far off the axis, slender, nearly a hemisphere, edge-on but for 1e-3, and 1e-7 across.
    fn extremes() -> Vec<[Vector; 3]> {
        let corners = [
            [[0.3, -0.2, 1.0], [1.1, 0.4, 0.8], [-0.2, 0.9, 1.2]],
            [[-1e3, -1e3, 0.01], [1e3, -1e3, 0.01], [0.0, 2e3, 0.01]],
            [[5.0, 0.0, 1.0], [5.0, 2.0, 1.0], [5.1, 1.0, 1.0]],
            [[-1.0, 0.0, 1e-3], [2.0, 0.0, 1e-3], [0.5, 1e-2, 1e-3]],
            [[0.6, 0.0, 0.8], [0.6 + 1e-7, 0.0, 0.8], [0.6, 1e-7, 0.8]],
        ];
        corners.map(|corners| corners.map(Vector::from)).to_vec()
    }

    fn contains([a, b, c]: [Vector; 3], d: Vector) -> bool {
        let volume = a.dot((b - a).cross(c - a));
        [(a, b), (b, c), (c, a)]
            .iter()
            .all(|(p, q)| d.dot(p.cross(*q - *p)) * volume >= 0.0)
    }

    #[test]
    fn samples_are_uniform_in_solid_angle() {
        for (number, corners) in extremes().into_iter().enumerate() {
            let triangle = SphericalTriangle::new(corners).unwrap();
            let map = EqualArea::around(&corners);
            let samples = independent(number as u64, 65_536)
                .map(|u| map.to_plane(triangle.sample(u).to_vector()));
            assert_uniform(samples, |p| {
                map.direction_at(p).is_some_and(|d| contains(corners, d))
            });
        }
    }

    #[test]
    fn an_edge_on_triangle_is_none() {
        let flat = [[1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 3.0, 0.0]].map(Vector::from);
        assert!(SphericalTriangle::new(flat).is_none());
        assert!(SphericalTriangle::new([Vector::ZERO; 3]).is_none());
    }

    proptest! {
        #[test]
        fn the_density_is_one_over_the_solid_angle(corners in prop::array::uniform3(any_vector(2.0))) {
            if let Some(triangle) = SphericalTriangle::new(corners) {
                let expected = solid_angle::of_triangle(Point::ORIGIN, corners.map(|c| Point::ORIGIN + c));
                let off = (triangle.solid_angle() - expected).to_steradians().abs();
                prop_assert!(off < 1e-12, "{off}");
            }
        }

        #[test]
        fn the_inverse_leads_back(corners in prop::array::uniform3(any_vector(2.0)), u in 0.01..0.99_f64, v in 0.01..0.99_f64) {
            let triangle = SphericalTriangle::new(corners);
            prop_assume!(triangle.is_some_and(|t| t.solid_angle().to_steradians() > 1e-2));
            let found = triangle.unwrap().inverse(triangle.unwrap().sample([u, v]));
            prop_assert!((found[0] - u).abs() < 1e-9 && (found[1] - v).abs() < 1e-9, "{found:?}");
        }
    }
}
