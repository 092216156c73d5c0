//! Where a set of lights is, where its light goes, and how much at most.
//!
//! Of a light in the box, the intensity in a direction at the angle θ to the axis is at most
//!
//! I(θ) ≤ I_max cos(max(θ − θ_o, 0)), and 0 where θ > θ_o + θ_e.
//!
//! | symbol | meaning | point | spot | Lambertian |
//! |---|---|---|---|---|
//! | θ_o | within this spread of the axis are the axes of all lights | π | its cutoff | that of the normals |
//! | θ_e | so far beyond goes their light | 0 | 0 | π/2 |
//! | I_max | greatest intensities, added | I | I₀ | L A |
//!
//! The union of two cones is the narrowest cone about both; θ − θ_o only shrinks by it, so that the bound holds for all lights of the
//! union. The measure of a cone, by which splits are compared, is ∫ I/I_max dω:
//!
//! M = 2π(1 − cosθ_o) + (π/2)(2θ_w sinθ_o − cos(θ_o − 2θ_w) − 2θ_o sinθ_o + cosθ_o), θ_w = min(θ_o + θ_e, π).
//!
//! Source: A. Conty Estevez, C. Kulla, *Importance sampling of many lights with adaptive tree splitting* (PACMCGIT 1(2), 2018), §4.1 and
//! algorithm 1. There the power stands in the place of I_max, which a bound of irradiance needs, and spots have θ_o = 0.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

/// Directions in which lights shine.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(in crate::transport) struct Cone {
    pub axis: DVec3,
    /// θ_o in radians.
    pub spread: f64,
    /// θ_e in radians.
    pub reach: f64,
}

impl Cone {
    /// Light that goes everywhere.
    pub const EVERYWHERE: Self = Self {
        axis: DVec3::Z,
        spread: PI,
        reach: 0.0,
    };

    /// One side of a flat Lambertian emitter.
    pub fn of_normal(normal: DVec3) -> Self {
        Self {
            axis: normal,
            spread: 0.0,
            reach: FRAC_PI_2,
        }
    }

    /// The narrowest cone about both.
    pub fn union(self, other: Self) -> Self {
        let reach = self.reach.max(other.reach);
        let (wide, narrow) = match self.spread >= other.spread {
            true => (self, other),
            false => (other, self),
        };
        let apart = angle(wide.axis, narrow.axis);
        if (apart + narrow.spread).min(PI) <= wide.spread {
            return Self { reach, ..wide };
        }
        let spread = 0.5 * (wide.spread + apart + narrow.spread);
        let across = wide.axis.cross(narrow.axis);
        if spread >= PI || across.length_squared() == 0.0 {
            return Self {
                axis: wide.axis,
                spread: PI,
                reach,
            };
        }
        let (sin, cos) = libm::sincos(spread - wide.spread);
        let tangent = across.normalize().cross(wide.axis);
        Self {
            axis: (wide.axis * cos + tangent * sin).normalize(),
            spread,
            reach,
        }
    }

    /// M in steradians.
    pub fn measure(self) -> f64 {
        let (sin, cos) = libm::sincos(self.spread);
        let edge = (self.spread + self.reach).min(PI);
        let beyond = 2.0 * (edge - self.spread) * sin - libm::cos(self.spread - 2.0 * edge) + cos;
        2.0 * PI * (1.0 - cos) + FRAC_PI_2 * beyond
    }
}

/// Of unit vectors; 0 of equal ones.
fn angle(a: DVec3, b: DVec3) -> f64 {
    if a == b {
        return 0.0;
    }
    libm::atan2(a.cross(b).length(), a.dot(b))
}

/// A box about lights in kernel coordinates, the cone of their light, and their greatest intensity together.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(in crate::transport) struct Bounds {
    pub low: DVec3,
    pub high: DVec3,
    pub cone: Cone,
    pub intensity: f64,
}

impl Bounds {
    /// Of one light at these points.
    pub fn around(
        points: impl IntoIterator<Item = DVec3>,
        cone: Cone,
        intensity: f64,
    ) -> Option<Self> {
        let mut points = points.into_iter();
        let first = points.next()?;
        let corners = (first, first);
        let (low, high) = points.fold(corners, |(low, high), point| {
            (low.min(point), high.max(point))
        });
        Some(Self {
            low,
            high,
            cone,
            intensity,
        })
    }

    pub fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            cone: self.cone.union(other.cone),
            intensity: self.intensity + other.intensity,
        }
    }

    /// So many times as bright.
    pub fn times(self, factor: f64) -> Self {
        Self {
            intensity: self.intensity * factor,
            ..self
        }
    }

    pub fn center(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    pub fn extent(&self) -> DVec3 {
        self.high - self.low
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn cone() -> impl Strategy<Value = Cone> {
        let axis = (-1.0..1.0_f64, 0.0..6.3_f64);
        (axis, 0.0..3.1_f64, 0.0..1.6_f64).prop_map(|((z, phi), spread, reach)| {
            let (sin, cos) = libm::sincos(phi);
            let r = (1.0 - z * z).sqrt();
            Cone {
                axis: DVec3::new(r * cos, r * sin, z),
                spread,
                reach,
            }
        })
    }

    /// The bound of the intensity in a direction, per unit of the greatest.
    fn bound(cone: Cone, direction: DVec3) -> f64 {
        let beyond = (angle(cone.axis, direction) - cone.spread).max(0.0);
        match beyond > cone.reach {
            true => 0.0,
            false => libm::cos(beyond),
        }
    }

    proptest! {
        /// No light of a part is lost by the whole: up to the rounding of angles, 1e-12 inside and 1e-9 of the reach outside.
        #[test]
        fn a_union_bounds_both(a in cone(), b in cone(), at in cone()) {
            let mut union = a.union(b);
            union.reach += 1e-9;
            union.spread += 1e-9;
            for part in [a, b] {
                prop_assert!(bound(union, at.axis) >= bound(part, at.axis) - 1e-12);
            }
        }

        /// The measure is the integral of the bound, by the midpoint rule over 20 000 angles: its error is below
        /// (π/20 000)² · 2π · π from the smooth parts, and half a step of 2π/20 000 · π at the edge.
        #[test]
        fn the_measure_is_the_integral(cone in cone()) {
            let n = 20_000;
            let step = PI / f64::from(n);
            let integral: f64 = (0..n)
                .map(|k| (f64::from(k) + 0.5) * step)
                .map(|theta| {
                    let (sin, cos) = libm::sincos(theta);
                    let tangent = cone.axis.any_orthonormal_vector();
                    2.0 * PI * sin * bound(cone, cone.axis * cos + tangent * sin) * step
                })
                .sum();
            prop_assert!((integral - cone.measure()).abs() < 2.0 * PI * step);
        }
    }

    /// Light that goes everywhere fills 4π, that of a flat emitter π, and that of a uniform spot its cone.
    #[test]
    fn measures_of_lights() {
        assert!((Cone::EVERYWHERE.measure() - 4.0 * PI).abs() < 1e-12);
        assert!((Cone::of_normal(DVec3::X).measure() - PI).abs() < 1e-12);
        let spot = Cone {
            axis: DVec3::Z,
            spread: PI / 3.0,
            reach: 0.0,
        };
        assert!((spot.measure() - PI).abs() < 1e-12);
    }
}
