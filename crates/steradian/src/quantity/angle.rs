//! Angle, solid angle and projected solid angle.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | θ, φ | plane angle | rad |
//! | ω = a/r² | solid angle: area a on a sphere of radius r, seen from the centre | sr |
//! | Ω = ∫ cosθ dω | projected solid angle: each dω foreshortened at the receiver | sr |
//!
//! A direction's full sphere is 4π sr; the hemisphere is 2π sr but only π sr when projected.

use std::f64::consts::PI;

use super::define::quantity;
use super::{Area, Length, Unit, UnitTable};

const ANGLE: UnitTable = UnitTable {
    quantity: "angle",
    si: "rad",
    example: "30 deg",
    units: &[
        Unit::new("deg", PI, 180.0).or(&["°", "degree", "degrees"]),
        Unit::new("rad", 1.0, 1.0),
        Unit::new("mrad", 1.0, 1e3),
        Unit::new("arcmin", PI, 10800.0),
        Unit::new("arcsec", PI, 648000.0),
    ],
    allows_bare_numbers: false,
};

const STERADIANS: &[Unit] = &[Unit::new("sr", 1.0, 1.0), Unit::new("msr", 1.0, 1e3)];

const SOLID_ANGLE: UnitTable = UnitTable {
    quantity: "solid angle",
    si: "sr",
    example: "0.5 sr",
    units: STERADIANS,
    allows_bare_numbers: false,
};

const PROJECTED_SOLID_ANGLE: UnitTable = UnitTable {
    quantity: "projected solid angle",
    ..SOLID_ANGLE
};

quantity! {
    /// Plane angle, in rad.
    ///
    /// ```
    /// use steradian::quantity::Angle;
    /// assert_eq!("30°".parse(), Ok(Angle::from_degrees(30.0)));
    /// assert!((Angle::from_degrees(30.0).sin() - 0.5).abs() < 1e-15);
    /// ```
    Angle, ANGLE, from_radians, to_radians, "radians"
}

impl Angle {
    /// A quarter turn, π/2.
    pub const QUARTER_TURN: Self = Self(PI / 2.0);
    /// A half turn, π.
    pub const HALF_TURN: Self = Self(PI);
    /// A full turn, 2π.
    pub const FULL_TURN: Self = Self(2.0 * PI);

    /// From degrees.
    pub const fn from_degrees(value: f64) -> Self {
        Self(value * PI / 180.0)
    }

    /// In degrees.
    pub const fn to_degrees(self) -> f64 {
        self.0 * 180.0 / PI
    }

    /// The sine.
    pub fn sin(self) -> f64 {
        libm::sin(self.0)
    }

    /// The cosine.
    pub fn cos(self) -> f64 {
        libm::cos(self.0)
    }

    /// The tangent.
    pub fn tan(self) -> f64 {
        libm::tan(self.0)
    }
}

quantity! {
    /// Solid angle ω = a/r², in sr.
    SolidAngle, SOLID_ANGLE, from_steradians, to_steradians, "steradians"
}

impl SolidAngle {
    /// All directions, 4π sr.
    pub const SPHERE: Self = Self(4.0 * PI);
    /// All directions above a plane, 2π sr.
    pub const HEMISPHERE: Self = Self(2.0 * PI);

    /// ω = a/r²: the solid angle of a patch from its area projected towards the observer.
    ///
    /// Exact on a sphere of radius r; for a flat patch the limit of small area, see
    /// `geometry::solid_angle` for exact values.
    ///
    /// ```
    /// use steradian::quantity::{Area, Length, SolidAngle};
    /// let patch = Area::from_square_metres(0.5);
    /// assert_eq!(SolidAngle::of_patch(patch, Length::from_metres(2.0)).to_steradians(), 0.125);
    /// ```
    pub fn of_patch(projected_area: Area, distance: Length) -> Self {
        Self(projected_area / distance.squared())
    }

    /// Ω = ω cosθ, of a small solid angle at the angle θ from a surface normal.
    pub fn foreshortened(self, cos_theta: f64) -> ProjectedSolidAngle {
        ProjectedSolidAngle(self.0 * cos_theta)
    }
}

quantity! {
    /// Projected solid angle Ω = ∫ cosθ dω, in sr.
    ProjectedSolidAngle, PROJECTED_SOLID_ANGLE, from_steradians, to_steradians, "steradians"
}

impl ProjectedSolidAngle {
    /// All directions above a plane, π sr.
    pub const HEMISPHERE: Self = Self(PI);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn units_of_angle_agree() {
        let right: Angle = "90 deg".parse().unwrap();
        assert_eq!(right, Angle::QUARTER_TURN);
        for text in ["5400 arcmin", "324000arcsec", "1.5707963267948966 rad"] {
            let ratio = text.parse::<Angle>().unwrap() / right;
            assert!((ratio - 1.0).abs() <= f64::EPSILON, "{text}");
        }
        assert_eq!("500 mrad".parse(), Ok(Angle::from_radians(0.5)));
        assert_eq!(Angle::HALF_TURN.to_degrees(), 180.0);
    }

    proptest! {
        #[test]
        fn degrees_round_trip(degrees in -720.0..720.0) {
            // Four roundings of relative size 2⁻⁵³ each.
            let back = Angle::from_degrees(degrees).to_degrees();
            prop_assert!((back - degrees).abs() <= 4.0 * f64::EPSILON / 2.0 * degrees.abs());
        }
    }
}
