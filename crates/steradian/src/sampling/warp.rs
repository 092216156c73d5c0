//! Maps of the unit square onto what light is integrated over, each with its constant or closed density.
//!
//! A map T with density p takes uniform (u, v) to T(u, v) with ∫ f p = ∬ f(T(u, v)) du dv, so f/p averages to ∫ f. The measure of p is part of its
//! meaning and is named with each map: solid angle (1/sr) or area (1/m², or per unit area on unit discs).
//!
//! | map | onto | density | measure |
//! |---|---|---|---|
//! | [`disc`] | unit disc | 1/π | area |
//! | [`annulus`] | ring r < ρ < R | 1/(π(R² − r²)) | area |
//! | [`triangle`] | triangle, barycentric | 1/A | area |
//! | [`cosine_hemisphere`] | z ≥ 0 | cosθ/π | solid angle |
//! | [`hemisphere`] | z ≥ 0 | 1/(2π) | solid angle |
//! | [`sphere`] | all directions | 1/(4π) | solid angle |
//! | [`cone`] | angles up to α from z | 1/(2π(1 − cosα)) | solid angle |
//!
//! All are branch-free f32 arithmetic for use in loops over batches. Directions are in the local frame, z along the normal.
//!
//! Sources: Shirley & Chiu 1997, *A low distortion map between disk and square*; Malley's method (cosine by projection);
//! Archimedes' hat-box theorem (sphere and cone); Heitz 2019, *A low-distortion map between triangle and square*.

use super::sincos::sin_cos_two_pi;
use std::f32::consts::{FRAC_1_PI, PI};

/// Density of [`sphere`] per steradian, 1/(4π).
pub const SPHERE_DENSITY: f32 = 0.25 * FRAC_1_PI;
/// Density of [`hemisphere`] per steradian, 1/(2π).
pub const HEMISPHERE_DENSITY: f32 = 0.5 * FRAC_1_PI;
/// Density of [`disc`] per unit area, 1/π.
pub const DISC_DENSITY: f32 = FRAC_1_PI;

/// A direction in a local frame.
pub type Direction = [f32; 3];

/// The concentric map as signed radius and cosine, sine of the angle.
#[inline(always)]
fn concentric(u: f32, v: f32) -> (f32, f32, f32) {
    let (a, b) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let wide = a.abs() > b.abs();
    let (radius, other) = if wide { (a, b) } else { (b, a) };
    let eighth = 0.125 * other / if radius == 0.0 { 1.0 } else { radius };
    let (sine, cosine) = sin_cos_two_pi(if wide { eighth } else { 0.25 - eighth });
    (radius, cosine, sine)
}

/// Uniform on the unit disc: concentric squares become concentric circles. Density [`DISC_DENSITY`].
#[inline(always)]
#[must_use]
pub fn disc(u: f32, v: f32) -> [f32; 2] {
    let (radius, cosine, sine) = concentric(u, v);
    [radius * cosine, radius * sine]
}

/// The point of the unit square that [`disc`] maps to a point of the unit disc.
#[must_use]
pub fn disc_inverse([x, y]: [f32; 2]) -> [f32; 2] {
    let radius = (x * x + y * y).sqrt();
    let wide = x.abs() > y.abs();
    let (along, across) = if wide { (x, y) } else { (y, x) };
    let radius = radius.copysign(along);
    let other = radius * libm::atanf(across / if along == 0.0 { 1.0 } else { along }) * (4.0 / PI);
    let (a, b) = if wide {
        (radius, other)
    } else {
        (other, radius)
    };
    [0.5 * (a + 1.0), 0.5 * (b + 1.0)]
}

/// Uniform on the ring between two radii. Density [`annulus_density`].
#[inline(always)]
#[must_use]
pub fn annulus(u: f32, v: f32, inner: f32, outer: f32) -> [f32; 2] {
    let radius = (inner * inner + u * ((outer - inner) * (outer + inner))).sqrt();
    let (sine, cosine) = sin_cos_two_pi(v);
    [radius * cosine, radius * sine]
}

/// Density of [`annulus`] per area, 1/(π(R² − r²)).
#[inline(always)]
#[must_use]
pub fn annulus_density(inner: f32, outer: f32) -> f32 {
    FRAC_1_PI / ((outer - inner) * (outer + inner))
}

/// Uniform on a triangle, as weights of its three corners. The density is one over the triangle's area.
///
/// ```
/// let weights = steradian::sampling::warp::triangle(0.25, 0.75);
/// assert_eq!(weights, [0.125, 0.625, 0.25]);
/// ```
#[inline(always)]
#[must_use]
pub fn triangle(u: f32, v: f32) -> [f32; 3] {
    let above = v > u;
    let (a, b) = if above {
        (0.5 * u, v - 0.5 * u)
    } else {
        (u - 0.5 * v, 0.5 * v)
    };
    [a, b, (1.0 - a - b).max(0.0)]
}

/// The point of the unit square that [`triangle`] maps to these weights.
#[must_use]
pub fn triangle_inverse([a, b, _]: [f32; 3]) -> [f32; 2] {
    if b > a {
        [2.0 * a, b + a]
    } else {
        [a + b, 2.0 * b]
    }
}

/// Directions in proportion to cosθ. Density cosθ/π per steradian: [`cosine_hemisphere_density`].
#[inline(always)]
#[must_use]
pub fn cosine_hemisphere(u: f32, v: f32) -> Direction {
    let (radius, cosine, sine) = concentric(u, v);
    let z = ((1.0 - radius) * (1.0 + radius)).sqrt();
    [radius * cosine, radius * sine, z]
}

/// Density of [`cosine_hemisphere`] per steradian; zero below the horizon.
#[inline(always)]
#[must_use]
pub fn cosine_hemisphere_density(cos_theta: f32) -> f32 {
    cos_theta.max(0.0) * FRAC_1_PI
}

/// Uniform directions with z ≥ 0. Density [`HEMISPHERE_DENSITY`].
#[inline(always)]
#[must_use]
pub fn hemisphere(u: f32, v: f32) -> Direction {
    cone(u, v, 1.0)
}

/// Uniform directions. Density [`SPHERE_DENSITY`].
#[inline(always)]
#[must_use]
pub fn sphere(u: f32, v: f32) -> Direction {
    cone(u, v, 2.0)
}

/// The point of the unit square that [`sphere`] maps to a direction.
#[must_use]
pub fn sphere_inverse([x, y, z]: Direction) -> [f32; 2] {
    let turn = libm::atan2f(y, x) * (0.5 * FRAC_1_PI);
    [0.5 * (1.0 - z), if turn < 0.0 { turn + 1.0 } else { turn }]
}

/// Uniform directions within an angle α of z, given as 1 − cosα so that the narrowest cones keep their accuracy. Density [`cone_density`].
#[inline(always)]
#[must_use]
pub fn cone(u: f32, v: f32, one_minus_cos: f32) -> Direction {
    let height = u * one_minus_cos;
    let radius = (height * (2.0 - height)).sqrt();
    let (sine, cosine) = sin_cos_two_pi(v);
    [radius * cosine, radius * sine, 1.0 - height]
}

/// Density of [`cone`] per steradian, 1/(2π(1 − cosα)).
#[inline(always)]
#[must_use]
pub fn cone_density(one_minus_cos: f32) -> f32 {
    HEMISPHERE_DENSITY / one_minus_cos
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{block, hash};
    use proptest::prelude::*;

    const COUNT: u64 = 1 << 16;
    const SIDE: usize = 12;

    /// χ² of 2¹⁶ independent samples against a grid of equal expected counts; `cell` inverts the distribution analytically
    /// and has nothing to do with the map. 143 degrees of freedom, bound 5 σ of the normal limit: false alarm about 1e-5 a test.
    fn check(cell: impl Fn(f32, f32) -> [f64; 2]) {
        let mut counts = [0_u32; SIDE * SIDE];
        for i in 0..COUNT {
            let [u, v, ..] = block::sample(hash::combine(77, i), 0, 0);
            let [a, b] = cell(u, v).map(|x| ((x * SIDE as f64) as usize).min(SIDE - 1));
            counts[a * SIDE + b] += 1;
        }
        let expected = COUNT as f64 / (SIDE * SIDE) as f64;
        let chi2: f64 = counts
            .iter()
            .map(|&count| (f64::from(count) - expected).powi(2) / expected)
            .sum();
        let degrees = (SIDE * SIDE - 1) as f64;
        assert!(
            (chi2 - degrees).abs() < 5.0 * (2.0 * degrees).sqrt(),
            "{chi2}"
        );
    }

    fn turn(x: f32, y: f32) -> f64 {
        libm::atan2(f64::from(y), f64::from(x)) / std::f64::consts::TAU + 0.5
    }

    #[test]
    fn discs_and_rings_are_uniform_in_area() {
        check(|u, v| {
            let [x, y] = disc(u, v);
            [f64::from(x * x + y * y), turn(x, y)]
        });
        check(|u, v| {
            let [x, y] = annulus(u, v, 1.0, 3.0);
            [(f64::from(x * x + y * y) - 1.0) / 8.0, turn(x, y)]
        });
        assert!((annulus_density(1.0, 3.0) * 8.0 * PI - 1.0).abs() < 1e-6);
    }

    #[test]
    fn triangles_are_uniform_in_area() {
        // Given the weight c of one corner, whose distribution is 1 − (1 − c)², the others divide the rest evenly.
        check(|u, v| {
            let [a, b, c] = triangle(u, v).map(f64::from);
            [1.0 - (1.0 - c) * (1.0 - c), a / (a + b)]
        });
        check(|u, v| {
            let [a, b, c] = triangle(u, v).map(f64::from);
            [1.0 - (1.0 - a) * (1.0 - a), b / (b + c)]
        });
    }

    #[test]
    fn directions_have_their_density() {
        check(|u, v| {
            let [x, y, z] = cosine_hemisphere(u, v);
            [f64::from(z * z), turn(x, y)]
        });
        check(|u, v| {
            let [x, y, z] = hemisphere(u, v);
            [f64::from(z), turn(x, y)]
        });
        check(|u, v| {
            let [x, y, z] = sphere(u, v);
            [f64::from(0.5 * (z + 1.0)), turn(x, y)]
        });
        check(|u, v| {
            let [x, y, _] = cone(u, v, 0.25);
            let height = 1.0 - (1.0 - f64::from(x * x + y * y)).sqrt();
            [height / 0.25, turn(x, y)]
        });
        assert!((cone_density(2.0) / SPHERE_DENSITY - 1.0).abs() < 1e-6);
        assert_eq!(cosine_hemisphere_density(-0.5), 0.0);
    }

    #[test]
    fn a_narrow_cone_keeps_its_accuracy() {
        // α = 1e-4: 1 − cosα = 5e-9 is lost in f32 next to 1.
        let [x, y, _] = cone(1.0, 0.125, 5e-9);
        assert!(((x * x + y * y).sqrt() / 1e-4 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_middle_of_the_square_is_the_middle_of_the_disc() {
        assert_eq!(disc(0.5, 0.5), [0.0, 0.0]);
        assert_eq!(cosine_hemisphere(0.5, 0.5), [0.0, 0.0, 1.0]);
    }

    proptest! {
        #[test]
        fn directions_are_unit_vectors(u in 0.0_f32..1.0, v in 0.0_f32..1.0) {
            for [x, y, z] in [cosine_hemisphere(u, v), hemisphere(u, v), sphere(u, v), cone(u, v, 0.3)] {
                prop_assert!((x * x + y * y + z * z - 1.0).abs() < 5e-7);
            }
            prop_assert!(triangle(u, v).iter().all(|&weight| weight >= 0.0));
        }

        #[test]
        fn inverses_lead_back(u in 0.001_f32..0.999, v in 0.001_f32..0.999) {
            let near = |[a, b]: [f32; 2], tolerance: f32| (a - u).abs() < tolerance && (b - v).abs() < tolerance;
            prop_assert!(near(disc_inverse(disc(u, v)), 1e-6));
            prop_assert!(near(triangle_inverse(triangle(u, v)), 1e-6));
            prop_assert!(near(sphere_inverse(sphere(u, v)), 1e-5));
        }
    }
}
