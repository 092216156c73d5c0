//! Points of a rectangle, uniform in solid angle.
//!
//! In the frame of the rectangle, which spans [x₀, x₁] × [y₀, y₁] at the distance z of its plane, the part up to x fills
//!
//! ω(x) = g(σ(x)) − g(σ(x₀)) ,  g(σ) = asin(k₁σ) − asin(k₀σ) ,  σ = x/√(x² + z²) ,  k = y/√(y² + z²)
//!
//! With g given, the sine of asin(k₁σ) = g + asin(k₀σ) solves to
//!
//! σ = sin g / √(k₀² + k₁² − 2 k₀ k₁ cos g)
//!
//! and on the line of that x the solid angle grows as t = y/√(x² + y² + z²).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ω | solid angle of the rectangle | sr |
//! | σ | sine of the angle between the plane x = 0 and that through x and the y axis | – |
//! | k | sine of the angle between the plane y = 0 and that through y and the x axis | – |
//!
//! Density: 1/ω per steradian, so a sample of radiance L has the weight Lω: an unoccluded rectangle of constant radiance is
//! estimated without variance, and no weight exceeds that.
//!
//! Precision: relative errors of some 2⁻⁵²/α for a rectangle that subtends the angle α.
//!
//! Source: C. Ureña, M. Fajardo & A. King, *An area-preserving parametrization for spherical rectangles* (EGSR 2013), eq. 6,
//! written with arc sines instead of the corners' angles, which would cancel for small rectangles.
//!
//! ```
//! use steradian::geometry::Vector;
//! use steradian::sampling::spherical_rectangle::SphericalRectangle;
//! // A face of the cube around the observer fills 4π/6; its middle is the middle of the square.
//! let edges = [Vector::new(2.0, 0.0, 0.0), Vector::new(0.0, 2.0, 0.0)];
//! let face = SphericalRectangle::new(Vector::new(-1.0, -1.0, 1.0), edges).unwrap();
//! assert!((face.solid_angle().to_steradians() - 4.0 * std::f64::consts::PI / 6.0).abs() < 1e-15);
//! assert_eq!(face.sample([0.5, 0.5]), Vector::new(0.0, 0.0, 1.0));
//! ```

use crate::geometry::{Direction, Vector};
use crate::quantity::SolidAngle;

/// Cosine of the edges' angle up to which a parallelogram is a rectangle.
const SQUARENESS: f64 = 1e-9;

/// A rectangle as seen by an observer at the origin.
#[derive(Copy, Clone, Debug)]
pub struct SphericalRectangle {
    axes: [Vector; 3],
    x: [f64; 2],
    y: [f64; 2],
    z: f64,
    sines: Sines,
    /// g at x₀.
    start: f64,
    solid_angle: f64,
}

impl SphericalRectangle {
    /// The rectangle with this corner, relative to the observer, and these edges; `None` if the edges are not perpendicular
    /// (to 1e-9) or it is seen edge-on.
    pub fn new(corner: Vector, edges: [Vector; 2]) -> Option<Self> {
        let unit = |v: Vector| Direction::new(v).ok().map(Direction::to_vector);
        let (along, up) = (unit(edges[0])?, unit(edges[1])?);
        let normal = along.cross(up);
        let height = corner.dot(normal);
        let (z, normal) = (height.abs(), if height < 0.0 { -normal } else { normal });
        let span = |axis: Vector, edge: Vector| {
            let low = corner.dot(axis);
            [low, low + edge.length()]
        };
        let (x, y) = (span(along, edges[0]), span(up, edges[1]));
        let sines = Sines::new(y, edges[1].length(), z);
        let [start, end] = x.map(|x| sines.gap(x / libm::hypot(x, z), z / libm::hypot(x, z)));
        let usable = along.dot(up).abs() < SQUARENESS && z > 0.0 && end > start;
        usable.then_some(Self {
            axes: [along, up, normal],
            x,
            y,
            z,
            sines,
            start,
            solid_angle: end - start,
        })
    }

    /// ω, one over the density.
    pub fn solid_angle(&self) -> SolidAngle {
        SolidAngle::from_steradians(self.solid_angle)
    }

    /// From the observer to a point of the rectangle, drawn with uniform density 1/ω.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Vector {
        let sine = self.sines.sine_at(self.start + u * self.solid_angle);
        let x = self.z * sine / ((1.0 - sine) * (1.0 + sine)).max(0.0).sqrt();
        let x = x.clamp(self.x[0], self.x[1]);
        let distance = libm::hypot(x, self.z);
        let [from, to] = self.y.map(|y| y / libm::hypot(y, distance));
        let sine = from + v * (to - from);
        let y = distance * sine / ((1.0 - sine) * (1.0 + sine)).max(0.0).sqrt();
        let y = y.clamp(self.y[0], self.y[1]);
        self.axes[0] * x + self.axes[1] * y + self.axes[2] * self.z
    }

    /// The numbers that [`sample`](Self::sample) maps to a point of the rectangle.
    pub fn inverse(&self, point: Vector) -> [f64; 2] {
        let [x, y] = [self.axes[0].dot(point), self.axes[1].dot(point)];
        let distance = libm::hypot(x, self.z);
        let gap = self.sines.gap(x / distance, self.z / distance);
        let [from, to] = self.y.map(|y| y / libm::hypot(y, distance));
        let across = (y / libm::hypot(y, distance) - from) / (to - from);
        [(gap - self.start) / self.solid_angle, across]
    }
}

/// k₀ and k₁ with what their small differences need.
#[derive(Copy, Clone, Debug)]
struct Sines {
    k: [f64; 2],
    /// √(1 − k²) of both.
    cosines: [f64; 2],
    /// k₁ − k₀.
    difference: f64,
}

impl Sines {
    fn new([low, high]: [f64; 2], length: f64, z: f64) -> Self {
        let [h0, h1] = [libm::hypot(low, z), libm::hypot(high, z)];
        let difference = if low * high > 0.0 {
            z * z * length * (low + high) / (h0 * h1 * (high * h0 + low * h1))
        } else {
            high / h1 - low / h0
        };
        Self {
            k: [low / h0, high / h1],
            cosines: [z / h0, z / h1],
            difference,
        }
    }

    /// g(σ), from σ and √(1 − σ²).
    fn gap(&self, sine: f64, cosine: f64) -> f64 {
        let [k0, k1] = self.k;
        // 1 − k²σ² as a sum of squares.
        let [c0, c1] = [0, 1].map(|i| libm::hypot(self.cosines[i], self.k[i] * cosine));
        let (first, second) = (k1 * c0, k0 * c1);
        let across = if k0 * k1 > 0.0 {
            self.difference * (k0 + k1) / (first + second)
        } else {
            first - second
        };
        libm::atan2(sine * across, c0 * c1 + k0 * k1 * sine * sine)
    }

    /// σ where g has this value.
    fn sine_at(&self, gap: f64) -> f64 {
        let [k0, k1] = self.k;
        let (sin, cos) = libm::sincos(0.5 * gap);
        let squared = if k0 * k1 > 0.0 {
            self.difference * self.difference + 4.0 * k0 * k1 * sin * sin
        } else {
            (k0 + k1) * (k0 + k1) - 4.0 * k0 * k1 * cos * cos
        };
        (2.0 * sin * cos / squared.sqrt()).clamp(-1.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::any_vector;
    use crate::geometry::{Frame, Point, solid_angle};
    use crate::sampling::testing::{EqualArea, assert_uniform, independent};
    use proptest::prelude::*;

    fn corners(corner: Vector, [a, b]: [Vector; 2]) -> [Vector; 4] {
        [corner, corner + a, corner + a + b, corner + b]
    }

    /// Ahead, beside, huge and near, edge-on but for 1e-3, slender, and 1e-7 across off the axis.
    fn extremes() -> Vec<(Vector, [Vector; 2])> {
        let v = Vector::new;
        let level = |width, depth| [v(width, 0.0, 0.0), v(0.0, depth, 0.0)];
        vec![
            (v(-0.4, -0.7, 1.0), level(1.5, 1.0)),
            (v(2.0, 3.0, 1.0), level(1.0, 2.0)),
            (v(-1e3, -2e3, 0.01), level(3e3, 3e3)),
            (v(-1.0, 0.5, 1e-3), level(2.0, 1.0)),
            (v(1.0, -5.0, -1.0), level(1e-3, 10.0)),
            (
                v(0.5, 0.5, 0.7),
                [v(1e-7, 0.0, 0.0), v(0.0, 0.6e-7, 0.8e-7)],
            ),
        ]
    }

    #[test]
    fn samples_are_uniform_in_solid_angle() {
        for (number, (corner, edges)) in extremes().into_iter().enumerate() {
            let rectangle = SphericalRectangle::new(corner, edges).unwrap();
            let corners = corners(corner, edges);
            let map = EqualArea::around(&corners);
            let samples =
                independent(number as u64, 65_536).map(|u| map.to_plane(rectangle.sample(u)));
            let inside = |d: Vector| {
                let normal = edges[0].cross(edges[1]);
                let t = corner.dot(normal) / d.dot(normal);
                let local = d * t - corner;
                t > 0.0
                    && edges
                        .iter()
                        .all(|e| (0.0..=1.0).contains(&(local.dot(*e) / e.length_squared())))
            };
            assert_uniform(samples, |p| map.direction_at(p).is_some_and(inside));
        }
    }

    #[test]
    fn skew_or_edge_on_is_none() {
        let v = Vector::new;
        let skew = [v(1.0, 0.0, 0.0), v(0.1, 1.0, 0.0)];
        assert!(SphericalRectangle::new(v(0.0, 0.0, 1.0), skew).is_none());
        let level = [v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0)];
        assert!(SphericalRectangle::new(v(1.0, 1.0, 0.0), level).is_none());
    }

    proptest! {
        #[test]
        fn density_and_inverse(
            corner in any_vector(3.0), normal in crate::geometry::testing::any_direction(),
            width in 0.1..4.0_f64, depth in 0.1..4.0_f64, u in 0.01..0.99_f64, v in 0.01..0.99_f64,
        ) {
            let frame = Frame::from_normal(normal);
            let edges = [frame.tangent() * width, frame.bitangent() * depth];
            prop_assume!(corner.dot(normal.to_vector()).abs() > 1e-2);
            let rectangle = SphericalRectangle::new(corner, edges).unwrap();
            let outline = corners(corner, edges).map(|c| Point::ORIGIN + c);
            let expected = solid_angle::of_polygon(Point::ORIGIN, &outline).to_steradians();
            prop_assert!((rectangle.solid_angle().to_steradians() - expected).abs() < 1e-13);
            let found = rectangle.inverse(rectangle.sample([u, v]));
            prop_assert!((found[0] - u).abs() < 1e-9 && (found[1] - v).abs() < 1e-9, "{found:?}");
        }
    }
}
