//! Spherical coordinates of directions.
//!
//! A direction is given by its angle θ from the Z axis and its azimuth φ, counted from X towards Y:
//!
//! d = (sinθ cosφ, sinθ sinφ, cosθ),  dω = sinθ dθ dφ
//!
//! | symbol | meaning | range |
//! |---|---|---|
//! | d | direction of unit length | |
//! | θ | polar angle, from the Z axis | 0 … π rad |
//! | φ | azimuth, from X counter-clockwise seen from +Z | 0 … 2π rad |
//! | ω | solid angle | sr |
//!
//! In the [`Frame`](super::Frame) of a surface, θ is the angle from the normal. At the poles φ is undefined and
//! read as 0. The solid angle of a patch θ₁…θ₂ × φ₁…φ₂ is ∫∫ sinθ dθ dφ = (cosθ₁ − cosθ₂)(φ₂ − φ₁).
//!
//! ```
//! use steradian::geometry::Spherical;
//! use steradian::quantity::Angle;
//! let east_and_up = Spherical::new(Angle::from_degrees(60.0), Angle::from_degrees(90.0));
//! let [x, y, z] = east_and_up.to_direction().to_array();
//! assert!(x.abs() < 1e-15);
//! assert!((y - 3.0_f64.sqrt() / 2.0).abs() < 1e-15);
//! assert!((z - 0.5).abs() < 1e-15);
//! ```

use std::f64::consts::TAU;

use super::direction::Direction;
use super::point::Vector;
use crate::quantity::{Angle, ProjectedSolidAngle, SolidAngle};

/// A direction as polar angle and azimuth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spherical {
    /// θ, from the Z axis.
    pub theta: Angle,
    /// φ, from X towards Y.
    pub phi: Angle,
}

impl Spherical {
    /// The direction at θ from Z and at the azimuth φ. Any angles will do; they need not be reduced.
    pub const fn new(theta: Angle, phi: Angle) -> Self {
        Self { theta, phi }
    }

    /// The coordinates of a direction, with θ in 0 … π and φ in 0 … 2π. Precise to rounding near the poles too,
    /// where an arc cosine would lose half the digits.
    pub fn from_direction(direction: Direction) -> Self {
        let [x, y, z] = direction.to_array();
        let theta = libm::atan2((x * x + y * y).sqrt(), z);
        let azimuth = libm::atan2(y, x);
        let phi = if azimuth < 0.0 {
            azimuth + TAU
        } else {
            azimuth + 0.0
        };
        Self::new(
            Angle::from_radians(theta),
            Angle::from_radians(if theta == 0.0 { 0.0 } else { phi }),
        )
    }

    /// d = (sinθ cosφ, sinθ sinφ, cosθ).
    pub fn to_direction(self) -> Direction {
        let (sin_theta, cos_theta) = libm::sincos(self.theta.to_radians());
        let (sin_phi, cos_phi) = libm::sincos(self.phi.to_radians());
        Direction::from_unit(Vector::new(
            sin_theta * cos_phi,
            sin_theta * sin_phi,
            cos_theta,
        ))
    }
}

/// The directions with θ₁ ≤ θ ≤ θ₂ and φ₁ ≤ φ ≤ φ₂, a rectangle of latitude and longitude.
///
/// ```
/// use steradian::geometry::SphericalPatch;
/// use steradian::quantity::{Angle, SolidAngle};
/// let octant = SphericalPatch::new([Angle::ZERO, Angle::QUARTER_TURN], [Angle::ZERO, Angle::QUARTER_TURN]).unwrap();
/// assert!((octant.solid_angle() / SolidAngle::SPHERE - 1.0 / 8.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalPatch {
    theta: [Angle; 2],
    phi: [Angle; 2],
}

/// Why two ranges of angles bound no patch.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PatchError {
    /// θ must rise within 0 … π.
    #[error("the polar angle must rise within 0 to 180 deg, but goes from {from} to {to} deg", from = .0[0].to_degrees(), to = .0[1].to_degrees())]
    Theta([Angle; 2]),
    /// φ must rise by at most a full turn.
    #[error("the azimuth must rise by at most 360 deg, but goes from {from} to {to} deg", from = .0[0].to_degrees(), to = .0[1].to_degrees())]
    Phi([Angle; 2]),
}

impl SphericalPatch {
    /// The patch between two polar angles and two azimuths.
    ///
    /// # Errors
    /// If θ does not rise within 0 … π, or φ does not rise by at most 2π.
    pub fn new(theta: [Angle; 2], phi: [Angle; 2]) -> Result<Self, PatchError> {
        if !(Angle::ZERO <= theta[0] && theta[0] <= theta[1] && theta[1] <= Angle::HALF_TURN) {
            return Err(PatchError::Theta(theta));
        }
        let turn = phi[1] - phi[0];
        if !(Angle::ZERO <= turn && turn <= Angle::FULL_TURN * (1.0 + 2.0 * f64::EPSILON)) {
            return Err(PatchError::Phi(phi));
        }
        Ok(Self { theta, phi })
    }

    /// θ₁ and θ₂.
    pub const fn theta(&self) -> [Angle; 2] {
        self.theta
    }

    /// φ₁ and φ₂.
    pub const fn phi(&self) -> [Angle; 2] {
        self.phi
    }

    /// ω = ∫∫ sinθ dθ dφ = (cosθ₁ − cosθ₂) Δφ, the difference taken as 2 sin½(θ₁+θ₂) sin½(θ₂−θ₁), which keeps
    /// all digits for narrow patches.
    pub fn solid_angle(&self) -> SolidAngle {
        let [from, to] = self.theta;
        let difference = 2.0 * ((from + to) / 2.0).sin() * ((to - from) / 2.0).sin();
        SolidAngle::from_steradians(difference * self.turn())
    }

    /// Ω = ∫∫ cosθ sinθ dθ dφ = ½ (sin²θ₂ − sin²θ₁) Δφ, for a surface whose normal is the Z axis; directions
    /// below it count as negative. The difference is taken as sin(θ₁+θ₂) sin(θ₂−θ₁).
    pub fn projected_solid_angle(&self) -> ProjectedSolidAngle {
        let [from, to] = self.theta;
        ProjectedSolidAngle::from_steradians(
            (from + to).sin() * (to - from).sin() / 2.0 * self.turn(),
        )
    }

    fn turn(&self) -> f64 {
        (self.phi[1] - self.phi[0]).to_radians()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, close};
    use proptest::prelude::*;

    fn patch(theta: [f64; 2], phi: [f64; 2]) -> SphericalPatch {
        SphericalPatch::new(theta.map(Angle::from_degrees), phi.map(Angle::from_degrees)).unwrap()
    }

    #[test]
    fn axes_have_their_angles() {
        let degrees = |direction| {
            let Spherical { theta, phi } = Spherical::from_direction(direction);
            [theta.to_degrees(), phi.to_degrees()]
        };
        assert_eq!(degrees(Direction::Z), [0.0, 0.0]);
        assert_eq!(degrees(-Direction::Z), [180.0, 180.0]);
        assert_eq!(degrees(Direction::X), [90.0, 0.0]);
        assert_eq!(degrees(Direction::Y), [90.0, 90.0]);
        assert_eq!(degrees(-Direction::X), [90.0, 180.0]);
        assert_eq!(degrees(-Direction::Y), [90.0, 270.0]);
    }

    #[test]
    fn the_whole_sphere_and_the_hemisphere() {
        let sphere = patch([0.0, 180.0], [0.0, 360.0]).solid_angle();
        assert!(close(sphere / SolidAngle::SPHERE, 1.0, 1e-15));
        let hemisphere = patch([0.0, 90.0], [0.0, 360.0]);
        assert!(close(
            hemisphere.solid_angle() / SolidAngle::HEMISPHERE,
            1.0,
            1e-15
        ));
        assert!(close(
            hemisphere.projected_solid_angle() / ProjectedSolidAngle::HEMISPHERE,
            1.0,
            1e-15
        ));
    }

    #[test]
    fn a_tiny_patch_keeps_its_digits() {
        // ω → sinθ Δθ Δφ, with a relative error of Δθ²/24.
        let step = 1e-9;
        let [theta, phi] =
            [[0.5, 0.5 + step], [0.0, step]].map(|range| range.map(Angle::from_radians));
        let found = SphericalPatch::new(theta, phi)
            .unwrap()
            .solid_angle()
            .to_steradians();
        let width = theta[1].to_radians() - 0.5;
        assert!(close(
            found / (libm::sin(0.5 + width / 2.0) * width * step),
            1.0,
            1e-15
        ));
    }

    #[test]
    fn reversed_ranges_are_refused() {
        let new = |theta: [f64; 2], phi: [f64; 2]| {
            SphericalPatch::new(theta.map(Angle::from_radians), phi.map(Angle::from_radians))
        };
        for theta in [[1.0, 0.5], [-0.1, 1.0], [0.0, 3.2], [f64::NAN, 1.0]] {
            assert!(matches!(new(theta, [0.0, 1.0]), Err(PatchError::Theta(_))));
        }
        for phi in [[1.0, 0.5], [0.0, 7.0], [f64::NAN, 1.0]] {
            assert!(matches!(new([0.0, 1.0], phi), Err(PatchError::Phi(_))));
        }
    }

    proptest! {
        #[test]
        fn directions_round_trip(direction in any_direction()) {
            let back = Spherical::from_direction(direction).to_direction();
            // Half an ulp below 2π in φ, the rounding of 2π itself, two arc tangents, and the norm.
            prop_assert!((back.to_vector() - direction.to_vector()).length() < 8.0 * f64::EPSILON);
        }

        #[test]
        fn patches_add_up(cut in 0.0..180.0_f64, azimuth in 0.0..360.0_f64) {
            let parts = [
                patch([0.0, cut], [0.0, azimuth]),
                patch([cut, 180.0], [0.0, azimuth]),
                patch([0.0, 180.0], [azimuth, 360.0]),
            ];
            let sum: SolidAngle = parts.iter().map(SphericalPatch::solid_angle).sum();
            prop_assert!(close(sum / SolidAngle::SPHERE, 1.0, 2e-15));
            let projected: ProjectedSolidAngle = parts.iter().map(SphericalPatch::projected_solid_angle).sum();
            prop_assert!(close(projected.to_steradians(), 0.0, 4e-15));
        }
    }
}
