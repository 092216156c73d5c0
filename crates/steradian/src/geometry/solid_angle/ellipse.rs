//! Discs and ellipses.
//!
//! The rays from the observer through an ellipse form an elliptic cone. With the centre c and the half axes u, v relative to
//! the observer, the matrix u uᵀ + v vᵀ − c cᵀ has the eigenvalues μ₁ ≥ μ₂ ≥ 0 ≥ −m; the cone's half angles α ≥ β have
//! tan²α = μ₁/m and tan²β = μ₂/m, and μ₁ μ₂ m = V² with V = |c·(u × v)|. Then
//!
//! ω = (4V/(m + μ₁)^{3/2}) ∫₀^{π/2} sin²ψ / ((cos²ψ + p sin²ψ) √(cos²ψ + k′² sin²ψ)) dψ,  p = m/(m + μ₁), k′² = (m + μ₂)/(m + μ₁)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ω | solid angle | sr |
//! | c, u, v | centre and half axes, from the observer | m |
//! | α, β | half angles of the cone along its two planes of symmetry | rad |
//!
//! Derivation: ω = ∬ dx dy/(1 + x² + y²)^{3/2} over the ellipse with half axes tanα, tanβ gives, integrated along its radius,
//! ω = 2π − (4 tanβ cosα/tanα) Π(1 − tan²β/tan²α, k), which is the form of F. Paxton, "Solid Angle Calculation for a Circular Disk", Rev. Sci.
//! Instrum. 30 (4), 1959, eqs. 11–13, and J. T. Conway, Nucl. Instrum. Methods A 614, 2010. It cancels for narrow
//! cones. The change of parameter n → k²/n of DLMF 19.7.8 turns 2π − Π(n) into Π(k²/n) − K, and that difference is the
//! single positive integral above, a complete elliptic integral without cancellation at any distance.
//!
//! For a disc of radius R, whose centre lies at the height h over the observer and ρ aside, μ₁ = R², V = R² h, and m is the root of
//! m² + (R² − ρ² − h²) m = R² h².
//!
//! Limits: as the observer comes to the plane, ω tends to 2π inside the rim, 0 outside and, along the normal, π on the rim
//! itself; in the plane it is 0. An ellipse without area fills 0.

use super::super::direction::Direction;
use super::super::elliptic;
use super::super::point::{Point, Vector};
use crate::quantity::{Length, SolidAngle};

/// The solid angle of a disc from anywhere, seen from either side. A disc of no or negative radius, or of NaN, fills nothing.
///
/// Relative error: some 10⁻¹⁵, times 1 + distance/height close to the plane, where h itself is uncertain by rounding.
///
/// ```
/// use steradian::geometry::{Direction, Point, solid_angle};
/// use steradian::quantity::{Length, SolidAngle};
/// // From the axis, 3 m before a disc of 4 m: 2π (1 − 3/5).
/// let disc = |x| solid_angle::of_disc(Point::ORIGIN, Point::new(x, 0.0, 3.0), Direction::Z, Length::from_metres(4.0));
/// assert!((disc(0.0) / SolidAngle::HEMISPHERE - 0.4).abs() < 1e-15);
/// assert!(disc(1.0) < disc(0.0));
/// ```
pub fn of_disc(observer: Point, center: Point, normal: Direction, radius: Length) -> SolidAngle {
    let to_center = center - observer;
    let size = radius.to_metres().max(to_center.length());
    let radius = radius.to_metres() / size;
    let height = normal.dot(to_center).abs() / size;
    let aside = normal.cross(to_center).length() / size;
    if !(radius > 0.0 && height > 0.0) {
        return SolidAngle::ZERO;
    }
    let square = radius * radius;
    let middle = (radius - aside) * (radius + aside) - height * height;
    let distances = [aside - radius, aside + radius].map(|x| (x * x + height * height).sqrt());
    let root = distances[0] * distances[1];
    let m = if middle > 0.0 {
        2.0 * square * height * height / (root + middle)
    } else {
        (root - middle) / 2.0
    };
    let narrow = if m > 0.0 {
        square * height * height / m
    } else {
        square
    };
    of_cone(square * height, [square, narrow], m)
}

/// The solid angle of an ellipse by its centre and half axes, from anywhere and seen from either side. The half axes may be
/// any conjugate ones: the outline is c + u cos t + v sin t.
///
/// Relative error: some 10⁻¹⁴, and more close to the plane as for a disc.
///
/// ```
/// use steradian::geometry::{Direction, Point, Vector, solid_angle};
/// use steradian::quantity::Length;
/// let (eye, center) = (Point::ORIGIN, Point::new(1.0, 0.0, 2.0));
/// let disc = solid_angle::of_disc(eye, center, Direction::Z, Length::from_metres(3.0));
/// let ellipse = solid_angle::of_ellipse(eye, center, [Vector::new(0.0, 3.0, 0.0), Vector::new(3.0, 0.0, 0.0)]);
/// assert!((ellipse / disc - 1.0).abs() < 1e-14);
/// ```
pub fn of_ellipse(observer: Point, center: Point, half_axes: [Vector; 2]) -> SolidAngle {
    let to_center = center - observer;
    let size = half_axes
        .map(Vector::max_component)
        .into_iter()
        .fold(to_center.max_component(), f64::max);
    let [u, v, c] = [half_axes[0], half_axes[1], to_center].map(|vector| vector / size);
    let volume = c.dot(u.cross(v)).abs();
    if volume.is_nan() || volume == 0.0 {
        return SolidAngle::ZERO;
    }
    let [wide, narrow, m] = semi_axes(u, v, c, volume);
    of_cone(volume, [wide, narrow], m)
}

/// μ₁, μ₂ and m; see the module. The one least in magnitude, which rounding would spoil, is taken from their product V².
pub(in crate::geometry) fn semi_axes(u: Vector, v: Vector, c: Vector, volume: f64) -> [f64; 3] {
    let axis = Direction::new(c).unwrap_or(Direction::Z);
    // With the axis along the centre the matrix of a far or narrow ellipse is graded, and Jacobi keeps small eigenvalues.
    let frame = super::super::frame::Frame::from_normal(axis);
    let [u, v] = [u, v].map(|vector| frame.vector_to_local(vector).to_array());
    let distance = c.length();
    let entry = |i: usize, j: usize| {
        let center = if i == 2 && j == 2 {
            distance * distance
        } else {
            0.0
        };
        u[i] * u[j] + v[i] * v[j] - center
    };
    let matrix = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
    let mut values = super::jacobi::eigenvalues(matrix);
    values.sort_by(|a, b| b.total_cmp(a));
    let [mut wide, mut narrow, mut m] = [values[0], values[1], -values[2]];
    if m < narrow.abs() {
        m = volume / wide * (volume / narrow);
    } else {
        narrow = volume / wide * (volume / m);
        wide = wide.max(narrow);
    }
    [wide, narrow, m]
}

/// The solid angle of an elliptic cone from V, μ₁ ≥ μ₂ and m.
fn of_cone(volume: f64, [wide, narrow]: [f64; 2], m: f64) -> SolidAngle {
    let sum = m + wide;
    let p = m / sum;
    // Below the least number: the observer is inside the rim, nearer to the plane than can be told.
    if p == 0.0 {
        return SolidAngle::HEMISPHERE;
    }
    let complementary_modulus = ((m + narrow) / sum).sqrt();
    let integral = elliptic::complete(complementary_modulus, p, 0.0, 1.0);
    SolidAngle::from_steradians(4.0 * volume / (sum * sum.sqrt()) * integral)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use proptest::prelude::*;
    use std::f64::consts::{PI, TAU};

    const STEPS: u32 = 1 << 14;

    /// ω = ∮ (1 − h/d) (x dy − y dx)/(x² + y²) along the rim, where d is the distance of its points and x, y are theirs from the
    /// foot of the perpendicular. The trapezoidal rule converges exponentially.
    fn by_quadrature(center: Vector, [u, v]: [Vector; 2]) -> f64 {
        let normal = Direction::new(u.cross(v)).unwrap();
        let height = normal.dot(center).abs();
        let term = |index| {
            let (sin, cos) = libm::sincos(TAU * f64::from(index) / f64::from(STEPS));
            let (point, step) = (center + u * cos + v * sin, v * cos - u * sin);
            let distance = point.length();
            normal.dot(point.cross(step)) / (distance * (distance + height))
        };
        // Opposite terms of a small ellipse nearly cancel: their sum is not rounded to the size of a half axis again and again.
        let pair = |index| term(index) + term(index + STEPS / 2);
        (0..STEPS / 2).map(pair).sum::<f64>() * TAU / f64::from(STEPS)
    }

    fn disc(x: f64, h: f64, radius: f64) -> f64 {
        let center = Point::new(x, 0.0, h);
        of_disc(
            Point::ORIGIN,
            center,
            Direction::Z,
            Length::from_metres(radius),
        )
        .to_steradians()
    }

    #[test]
    fn on_the_axis_at_all_distances() {
        for h in [1e-9, 1e-3, 0.1, 1.0, 10.0, 1e4, 1e9] {
            let slant = f64::sqrt(1.0 + h * h);
            let expected = TAU / (slant * (slant + h));
            assert!(close(disc(0.0, h, 1.0) / expected, 1.0, 2e-15), "{h}");
        }
    }

    #[test]
    fn values_of_paxtons_table() {
        // F. Paxton, Rev. Sci. Instrum. 30, 1959, table I: h/R = 0.5, 1 at ρ/R = 0.5, 1, 2 to seven digits.
        let cases = [(0.5, 1.0, 1.637_103_5), (2.0, 1.0, 0.325_800_2)];
        for (aside, height, expected) in cases {
            assert!(
                close(disc(aside, height, 1.0), expected, 1e-7),
                "{aside} {height}"
            );
        }
    }

    #[test]
    fn limits_in_the_plane_and_on_the_rim() {
        assert_eq!(
            [
                disc(0.5, 0.0, 1.0),
                disc(1.0, 0.0, 1.0),
                disc(0.0, 1.0, 0.0)
            ],
            [0.0; 3]
        );
        assert!(close(disc(0.5, 1e-12, 1.0), TAU, 1e-11));
        assert!(close(disc(0.5, 1e-200, 1.0), TAU, 1e-15));
        assert!(close(disc(1.0, 1e-12, 1.0), PI, 1e-10));
        assert!(close(disc(2.0, 1e-12, 1.0), 0.0, 1e-11));
        assert_eq!(disc(0.0, 1.0, f64::NAN), 0.0);
        assert_eq!(disc(0.0, 1.0, -1.0), 0.0);
    }

    #[test]
    fn far_away_it_is_the_projected_area_over_the_square_of_the_distance() {
        let size = 1e-7;
        let expected = PI * size * size * 0.8;
        assert!(close(disc(0.6, 0.8, size) / expected, 1.0, 1e-13));
        let axes = [
            Vector::new(size, 0.0, 0.0),
            Vector::new(0.0, size / 3.0, 0.0),
        ];
        let ellipse = of_ellipse(Point::ORIGIN, Point::new(0.6, 0.0, 0.8), axes).to_steradians();
        assert!(close(ellipse / (expected / 3.0), 1.0, 1e-13));
    }

    #[test]
    fn a_tiny_ellipse_seen_aslant() {
        let center = Vector::new(
            -1.373_086_790_311_690_1,
            1.670_337_369_283_913_6,
            -0.921_400_379_320_808_4,
        );
        let u = Vector::new(
            -0.430_900_866_247_697_5,
            -1.550_453_529_419_656_9,
            0.511_818_367_208_881_3,
        ) * 0.001;
        let v = Vector::new(
            1.849_713_757_220_976_5,
            0.676_668_892_787_626_7,
            -0.004_780_559_450_395_539,
        ) * 0.001;
        let found = of_ellipse(Point::ORIGIN, Point::ORIGIN + center, [u, v]).to_steradians();
        // By the same quadrature in extended precision.
        assert!(close(found / 7.997_839_282_884_52e-8, 1.0, 1e-13));
        assert!(close(
            by_quadrature(center, [u, v]),
            found,
            1e-14 * (u.length() + v.length())
        ));
    }

    proptest! {
        #[test]
        fn discs_agree_with_quadrature(aside in 0.0..3.0_f64, h in 0.01..5.0_f64, radius in 0.05..3.0_f64) {
            let axes = [Vector::new(radius, 0.0, 0.0), Vector::new(0.0, radius, 0.0)];
            let expected = by_quadrature(Vector::new(aside, 0.0, h), axes);
            prop_assert!(close(disc(aside, h, radius), expected, 3e-14 * expected + 1e-14));
        }

        #[test]
        fn ellipses_agree_with_quadrature(
            center in any_vector(3.0), u in any_vector(2.0), v in any_vector(2.0), shrink in 0.001..1.0_f64,
        ) {
            let (u, v) = (u * shrink, v * shrink);
            let normal = u.cross(v);
            prop_assume!(normal.length() > 0.05 * u.length() * v.length() && u.length() > 1e-3);
            prop_assume!(Direction::new(normal).unwrap().dot(center).abs() > 0.02);
            let expected = by_quadrature(center, [u, v]);
            let found = of_ellipse(Point::ORIGIN, Point::ORIGIN + center, [u, v]).to_steradians();
            // The terms of the sum are of the size of the half axes, whatever their sum.
            let tolerance = 1e-12 * expected + 1e-14 * (u.length() + v.length());
            prop_assert!(close(found, expected, tolerance), "{found} {expected}");
        }

        #[test]
        fn a_disc_is_an_ellipse_wherever_it_is(
            center in any_vector(3.0), normal in any_direction(), log_radius in -6.0..1.0_f64,
        ) {
            prop_assume!(normal.dot(center).abs() > 1e-2);
            let radius = libm::pow(10.0, log_radius);
            let frame = crate::geometry::Frame::from_normal(normal);
            let axes = [frame.tangent() * radius, frame.bitangent() * radius];
            let center = Point::ORIGIN + center;
            let disc = of_disc(Point::ORIGIN, center, normal, Length::from_metres(radius));
            let ellipse = of_ellipse(Point::ORIGIN, center, axes);
            prop_assert!(close(ellipse / disc, 1.0, 1e-12), "{ellipse:?} {disc:?}");
        }

        #[test]
        fn neither_the_unit_of_length_nor_the_choice_of_half_axes_matters(
            center in any_vector(2.0), u in any_vector(1.0), v in any_vector(1.0), scale in 1e-3..1e3_f64, turn in 0.0..TAU,
        ) {
            let normal = u.cross(v);
            prop_assume!(normal.length() > 0.01);
            prop_assume!(Direction::new(normal).unwrap().dot(center).abs() > 0.02);
            let (sin, cos) = libm::sincos(turn);
            let whole = of_ellipse(Point::ORIGIN, Point::ORIGIN + center, [u, v]);
            let turned = [(u * cos + v * sin) * scale, (v * cos - u * sin) * scale];
            let other = of_ellipse(Point::ORIGIN, Point::ORIGIN + center * scale, turned);
            prop_assert!(close(other / whole, 1.0, 1e-12), "{other:?} {whole:?}");
        }
    }
}
