//! Radiant quantities: light as energy.
//!
//! | symbol | quantity | law | unit |
//! |---|---|---|---|
//! | Q | energy | Q = ∫ Φ dt | J |
//! | Φ | flux | Φ = dQ/dt | W |
//! | E | irradiance | E = dΦ/dA, arriving at a surface | W/m² |
//! | E₀ | scalar irradiance | E₀ = ∫ L dω over all directions, no cosine | W/m² |
//! | M | exitance | M = dΦ/dA, leaving a surface | W/m² |
//! | H | radiant exposure | H = ∫ E dt | J/m² |
//! | I | intensity | I = dΦ/dω | W/sr |
//! | L | radiance | L = d²Φ/(dω dA cosθ) | W/(m² sr) |
//!
//! Names and symbols are those of the CIE's International Lighting Vocabulary (CIE S 017:2020, section 17-21).
//! A point light has an intensity and no radiance; a surface has a radiance; [`Radiance`] times projected area is
//! an [`Intensity`].

use std::f64::consts::PI;

use super::define::quantity;
use super::{Area, Length, SolidAngle, Unit, UnitTable, Value};

const ENERGY: UnitTable = UnitTable {
    quantity: "energy",
    si: "J",
    example: "1.2 kWh",
    units: &[
        Unit::new("J", 1.0, 1.0),
        Unit::new("mJ", 1.0, 1e3),
        Unit::new("kJ", 1e3, 1.0),
        Unit::new("MJ", 1e6, 1.0),
        Unit::new("Wh", 3.6e3, 1.0).or(&["W h"]),
        Unit::new("mWh", 3.6, 1.0).or(&["mW h"]),
        Unit::new("kWh", 3.6e6, 1.0).or(&["kW h"]),
        Unit::new("MWh", 3.6e9, 1.0).or(&["MW h"]),
        Unit::new("W s", 1.0, 1.0).or(&["Ws"]),
    ],
    allows_bare_numbers: false,
};

const FLUX: UnitTable = UnitTable {
    quantity: "flux",
    si: "W",
    example: "60 W",
    units: &[
        Unit::new("W", 1.0, 1.0),
        Unit::new("mW", 1.0, 1e3),
        Unit::new("kW", 1e3, 1.0),
        Unit::new("MW", 1e6, 1.0),
        Unit::new("uW", 1.0, 1e6),
    ],
    allows_bare_numbers: false,
};

const IRRADIANCE: UnitTable = UnitTable {
    quantity: "irradiance",
    si: "W/m²",
    example: "800 W/m2",
    units: &[
        Unit::new("W/m2", 1.0, 1.0),
        Unit::new("mW/m2", 1.0, 1e3),
        Unit::new("kW/m2", 1e3, 1.0),
        Unit::new("W/cm2", 1e4, 1.0),
        Unit::new("mW/cm2", 1e4, 1e3),
        Unit::new("uW/cm2", 1e4, 1e6),
    ],
    allows_bare_numbers: false,
};

const SCALAR_IRRADIANCE: UnitTable = UnitTable {
    quantity: "scalar irradiance",
    ..IRRADIANCE
};

const EXITANCE: UnitTable = UnitTable {
    quantity: "exitance",
    ..IRRADIANCE
};

const RADIANT_EXPOSURE: UnitTable = UnitTable {
    quantity: "radiant exposure",
    si: "J/m²",
    example: "1.2 kWh/m2",
    units: &[
        Unit::new("J/m2", 1.0, 1.0),
        Unit::new("kJ/m2", 1e3, 1.0),
        Unit::new("MJ/m2", 1e6, 1.0),
        Unit::new("J/cm2", 1e4, 1.0),
        Unit::new("mJ/cm2", 1e4, 1e3),
        Unit::new("Wh/m2", 3.6e3, 1.0).or(&["W h/m2"]),
        Unit::new("kWh/m2", 3.6e6, 1.0).or(&["kW h/m2"]),
    ],
    allows_bare_numbers: false,
};

const INTENSITY: UnitTable = UnitTable {
    quantity: "intensity",
    si: "W/sr",
    example: "75 W/sr",
    units: &[
        Unit::new("W/sr", 1.0, 1.0),
        Unit::new("mW/sr", 1.0, 1e3),
        Unit::new("kW/sr", 1e3, 1.0),
    ],
    allows_bare_numbers: false,
};

const RADIANCE: UnitTable = UnitTable {
    quantity: "radiance",
    si: "W/(m² sr)",
    example: "10 W/(m2 sr)",
    units: &[
        Unit::new("W/(m2 sr)", 1.0, 1.0),
        Unit::new("mW/(m2 sr)", 1.0, 1e3),
        Unit::new("kW/(m2 sr)", 1e3, 1.0),
        Unit::new("W/(cm2 sr)", 1e4, 1.0),
        Unit::new("mW/(cm2 sr)", 1e4, 1e3),
    ],
    allows_bare_numbers: false,
};

quantity! {
    /// Radiant energy Q = ∫ Φ dt, in J.
    Energy<V>, ENERGY, from_joules, to_joules, "joules"
}

quantity! {
    /// Radiant flux (power) Φ = dQ/dt, in W.
    Flux<V>, FLUX, from_watts, to_watts, "watts"
}

quantity! {
    /// Irradiance E = dΦ/dA: the flux that arrives at a surface, per area, in W/m².
    Irradiance<V>, IRRADIANCE, from_watts_per_square_metre, to_watts_per_square_metre, "watts per square metre"
}

quantity! {
    /// Scalar irradiance (fluence rate) E₀ = ∫ L dω over all directions, in W/m².
    ScalarIrradiance<V>, SCALAR_IRRADIANCE, from_watts_per_square_metre, to_watts_per_square_metre,
    "watts per square metre"
}

quantity! {
    /// Exitance M = dΦ/dA: the flux that leaves a surface, per area, in W/m².
    Exitance<V>, EXITANCE, from_watts_per_square_metre, to_watts_per_square_metre, "watts per square metre"
}

quantity! {
    /// Radiant exposure H = ∫ E dt: the energy that arrives at a surface, per area, in J/m².
    RadiantExposure<V>, RADIANT_EXPOSURE, from_joules_per_square_metre, to_joules_per_square_metre,
    "joules per square metre"
}

quantity! {
    /// Intensity I = dΦ/dω: the flux that leaves a point, per solid angle, in W/sr.
    Intensity<V>, INTENSITY, from_watts_per_steradian, to_watts_per_steradian, "watts per steradian"
}

quantity! {
    /// Radiance L = d²Φ/(dω dA cosθ), in W/(m² sr): what a pixel sees, and what stays when one steps back.
    Radiance<V>, RADIANCE, from_watts_per_square_metre_steradian, to_watts_per_square_metre_steradian,
    "watts per square metre and steradian"
}

impl<V: Value> Intensity<V> {
    /// The inverse-square law E_n = I/r²: the irradiance on a surface that faces the point, at this distance.
    ///
    /// On a surface turned by θ it is E_n cosθ.
    ///
    /// ```
    /// use steradian::quantity::{Intensity, Irradiance, Length};
    /// let lamp = Intensity::from_watts_per_steradian(100.0);
    /// let normal = lamp.normal_irradiance_at(Length::from_metres(2.0_f64.sqrt()));
    /// let floor = normal * 45f64.to_radians().cos(); // 100 cos³45°
    /// assert!((floor.to_watts_per_square_metre() - 35.3553390593).abs() < 1e-10);
    /// ```
    #[inline]
    pub fn normal_irradiance_at(self, distance: Length) -> Irradiance<V> {
        Irradiance(self.0 / distance.squared().0)
    }

    /// I = E_n r²: the intensity of a point that gives this irradiance on a surface facing it at this distance.
    pub fn from_normal_irradiance(irradiance: Irradiance<V>, distance: Length) -> Self {
        Self(irradiance.0 * distance.squared().0)
    }
}

impl<V: Value> Radiance<V> {
    /// E_n = L Δω: the irradiance on a surface that faces a small solid angle filled with this radiance.
    ///
    /// On a surface turned by θ it is E_n cosθ.
    #[inline]
    pub fn normal_irradiance_over(self, solid_angle: SolidAngle) -> Irradiance<V> {
        Irradiance(self.0 * solid_angle.to_steradians())
    }

    /// L = M/π: the radiance of a surface that emits this exitance equally bright in all directions.
    pub fn from_lambertian_exitance(exitance: Exitance<V>) -> Self {
        Self(exitance.0 / PI)
    }
}

impl<V: Value> Exitance<V> {
    /// M = Φ/A.
    pub fn from_flux(flux: Flux<V>, area: Area) -> Self {
        Self(flux.0 / area.0)
    }

    /// M = π L: the exitance of a surface that is equally bright in all directions.
    pub fn from_lambertian_radiance(radiance: Radiance<V>) -> Self {
        Self(radiance.0 * PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{Quantity, Spectrum};
    use proptest::prelude::*;

    #[test]
    fn units_are_parsed_to_si() {
        assert_eq!(
            "1.2 kWh/m2".parse(),
            Ok(RadiantExposure::from_joules_per_square_metre(4.32e6))
        );
        assert_eq!("2 kW h".parse(), Ok(Energy::from_joules(7.2e6)));
        assert_eq!(
            "5 mW/cm²".parse(),
            Ok(Irradiance::from_watts_per_square_metre(50.0))
        );
        assert_eq!("3 µW".parse(), Ok(Flux::from_watts(3e-6)));
        assert_eq!(
            "7 W/m2/sr".parse(),
            Ok(Radiance::from_watts_per_square_metre_steradian(7.0))
        );
    }

    #[test]
    fn quantities_print_their_si_unit() {
        assert_eq!(
            Intensity::from_watts_per_steradian(75.0).to_string(),
            "75 W/sr"
        );
        assert_eq!(
            Radiance::from_watts_per_square_metre_steradian(0.5).to_string(),
            "0.5 W/(m² sr)"
        );
        assert_eq!(format!("{:.2}", Flux::from_watts(0.005)), "0.01 W");
        assert_eq!(Flux::from_watts(2.5e-7).to_string(), "2.5e-7 W");
        assert_eq!(Energy::from_joules(1e20).to_string(), "1e20 J");
    }

    #[test]
    fn a_lambertian_surface_has_exitance_pi_times_its_radiance() {
        let radiance = Radiance::from_watts_per_square_metre_steradian(Spectrum::splat(2.0));
        let exitance = Exitance::from_lambertian_radiance(radiance);
        assert_eq!(
            exitance.to_watts_per_square_metre(),
            Spectrum::splat(2.0 * std::f32::consts::PI)
        );
        let single = Exitance::from_flux(Flux::from_watts(3.0), Area::from_square_metres(2.0));
        assert_eq!(Radiance::from_lambertian_exitance(single).to_si(), 1.5 / PI);
    }

    proptest! {
        #[test]
        fn printing_and_parsing_round_trip(value in proptest::num::f64::NORMAL) {
            let radiance = Radiance::from_watts_per_square_metre_steradian(value);
            prop_assert_eq!(radiance.to_string().parse(), Ok(radiance));
        }

        #[test]
        fn the_inverse_square_law_inverts(intensity in 1e-3..1e6, distance in 1e-2..1e3) {
            let (intensity, distance) = (Intensity::from_watts_per_steradian(intensity), Length::from_metres(distance));
            let back = Intensity::from_normal_irradiance(intensity.normal_irradiance_at(distance), distance);
            // Two roundings.
            prop_assert!((back / intensity - 1.0).abs() <= f64::EPSILON);
        }
    }
}
