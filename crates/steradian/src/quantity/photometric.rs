//! Photometric quantities: light as the eye weighs it, twins of the radiant ones.
//!
//! Each is its radiant twin weighted with 683 lm/W · V(λ), the photopic luminous efficiency of the CIE 1924
//! observer, and obeys the same laws.
//!
//! | symbol | quantity | unit | twin |
//! |---|---|---|---|
//! | Qᵥ | luminous energy | lm s | energy |
//! | Φᵥ | luminous flux | lm | flux |
//! | Eᵥ | illuminance | lx = lm/m² | irradiance |
//! | Mᵥ | luminous exitance | lm/m² | exitance |
//! | Hᵥ | luminous exposure | lx s | radiant exposure |
//! | Iᵥ | luminous intensity | cd = lm/sr | intensity |
//! | Lᵥ | luminance | cd/m² | radiance |

use std::f64::consts::PI;

use super::define::quantity;
use super::{Area, Length, Unit, UnitTable};

const LUMINOUS_ENERGY: UnitTable = UnitTable {
    quantity: "luminous energy",
    si: "lm s",
    example: "2 klm h",
    units: &[
        Unit::new("lm s", 1.0, 1.0),
        Unit::new("klm s", 1e3, 1.0),
        Unit::new("lm h", 3.6e3, 1.0),
        Unit::new("klm h", 3.6e6, 1.0),
    ],
    allows_bare_numbers: false,
};

const LUMINOUS_FLUX: UnitTable = UnitTable {
    quantity: "luminous flux",
    si: "lm",
    example: "800 lm",
    units: &[
        Unit::new("lm", 1.0, 1.0),
        Unit::new("mlm", 1.0, 1e3),
        Unit::new("klm", 1e3, 1.0),
    ],
    allows_bare_numbers: false,
};

/// The foot of the foot-candle in metres, squared: 0.3048².
const SQUARE_FOOT: f64 = 0.09290304;

const ILLUMINANCE: UnitTable = UnitTable {
    quantity: "illuminance",
    si: "lx",
    example: "500 lx",
    units: &[
        Unit::new("lx", 1.0, 1.0).or(&["lux", "lm/m2"]),
        Unit::new("mlx", 1.0, 1e3),
        Unit::new("klx", 1e3, 1.0),
        Unit::new("fc", 1.0, SQUARE_FOOT).or(&["lm/ft2"]),
    ],
    allows_bare_numbers: false,
};

const LUMINOUS_EXITANCE: UnitTable = UnitTable {
    quantity: "luminous exitance",
    si: "lm/m²",
    example: "500 lm/m2",
    units: &[
        Unit::new("lm/m2", 1.0, 1.0),
        Unit::new("klm/m2", 1e3, 1.0),
        Unit::new("lm/ft2", 1.0, SQUARE_FOOT),
    ],
    allows_bare_numbers: false,
};

const LUMINOUS_EXPOSURE: UnitTable = UnitTable {
    quantity: "luminous exposure",
    si: "lx s",
    example: "50 klx h",
    units: &[
        Unit::new("lx s", 1.0, 1.0).or(&["lm s/m2"]),
        Unit::new("klx s", 1e3, 1.0),
        Unit::new("lx h", 3.6e3, 1.0),
        Unit::new("klx h", 3.6e6, 1.0),
        Unit::new("Mlx h", 3.6e9, 1.0),
    ],
    allows_bare_numbers: false,
};

const LUMINOUS_INTENSITY: UnitTable = UnitTable {
    quantity: "luminous intensity",
    si: "cd",
    example: "120 cd",
    units: &[
        Unit::new("cd", 1.0, 1.0).or(&["lm/sr"]),
        Unit::new("mcd", 1.0, 1e3),
        Unit::new("kcd", 1e3, 1.0),
    ],
    allows_bare_numbers: false,
};

const LUMINANCE: UnitTable = UnitTable {
    quantity: "luminance",
    si: "cd/m²",
    example: "2000 cd/m2",
    units: &[
        Unit::new("cd/m2", 1.0, 1.0).or(&["lm/(m2 sr)"]),
        Unit::new("mcd/m2", 1.0, 1e3),
        Unit::new("kcd/m2", 1e3, 1.0),
        Unit::new("cd/cm2", 1e4, 1.0),
        Unit::new("nit", 1.0, 1.0).or(&["nits"]),
    ],
    allows_bare_numbers: false,
};

quantity! {
    /// Luminous energy Qᵥ = ∫ Φᵥ dt, in lm s.
    LuminousEnergy, LUMINOUS_ENERGY, from_lumen_seconds, to_lumen_seconds, "lumen seconds"
}

quantity! {
    /// Luminous flux Φᵥ, in lm.
    LuminousFlux, LUMINOUS_FLUX, from_lumens, to_lumens, "lumens"
}

quantity! {
    /// Illuminance Eᵥ = dΦᵥ/dA, arriving at a surface, in lx.
    ///
    /// ```
    /// use steradian::quantity::Illuminance;
    /// let footcandle: Illuminance = "1 fc".parse()?;
    /// assert_eq!(format!("{footcandle:.4}"), "10.7639 lx");
    /// # Ok::<(), steradian::quantity::ParseQuantityError>(())
    /// ```
    Illuminance, ILLUMINANCE, from_lux, to_lux, "lux"
}

quantity! {
    /// Luminous exitance Mᵥ = dΦᵥ/dA, leaving a surface, in lm/m².
    LuminousExitance, LUMINOUS_EXITANCE, from_lumens_per_square_metre, to_lumens_per_square_metre,
    "lumens per square metre"
}

quantity! {
    /// Luminous exposure Hᵥ = ∫ Eᵥ dt, in lx s.
    LuminousExposure, LUMINOUS_EXPOSURE, from_lux_seconds, to_lux_seconds, "lux seconds"
}

quantity! {
    /// Luminous intensity Iᵥ = dΦᵥ/dω, in cd.
    LuminousIntensity, LUMINOUS_INTENSITY, from_candelas, to_candelas, "candelas"
}

quantity! {
    /// Luminance Lᵥ = d²Φᵥ/(dω dA cosθ), in cd/m²: how bright a surface looks.
    Luminance, LUMINANCE, from_candelas_per_square_metre, to_candelas_per_square_metre,
    "candelas per square metre"
}

impl LuminousIntensity {
    /// The inverse-square law Eᵥ = Iᵥ/r², on a surface that faces the point.
    ///
    /// ```
    /// use steradian::quantity::{Illuminance, Length, LuminousIntensity};
    /// let lamp = LuminousIntensity::from_candelas(1000.0);
    /// assert_eq!(lamp.normal_illuminance_at(Length::from_metres(2.0)), Illuminance::from_lux(250.0));
    /// ```
    pub fn normal_illuminance_at(self, distance: Length) -> Illuminance {
        Illuminance(self.0 / distance.squared().0)
    }

    /// Iᵥ = Eᵥ r²: the intensity of a point that gives this illuminance on a surface facing it at this distance.
    pub fn from_normal_illuminance(illuminance: Illuminance, distance: Length) -> Self {
        Self(illuminance.0 * distance.squared().0)
    }
}

impl Luminance {
    /// Lᵥ = Mᵥ/π: the luminance of a surface that emits this exitance equally bright in all directions.
    pub fn from_lambertian_exitance(exitance: LuminousExitance) -> Self {
        Self(exitance.0 / PI)
    }
}

impl LuminousExitance {
    /// Mᵥ = Φᵥ/A.
    pub fn from_flux(flux: LuminousFlux, area: Area) -> Self {
        Self(flux.0 / area.0)
    }

    /// Mᵥ = π Lᵥ: the exitance of a surface that is equally bright in all directions.
    pub fn from_lambertian_luminance(luminance: Luminance) -> Self {
        Self(luminance.0 * PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_parsed_to_si() {
        assert_eq!("1.5 klm".parse(), Ok(LuminousFlux::from_lumens(1500.0)));
        assert_eq!("2 klx".parse(), Ok(Illuminance::from_lux(2000.0)));
        assert_eq!("2 lm/sr".parse(), Ok(LuminousIntensity::from_candelas(2.0)));
        assert_eq!(
            "3 lx h".parse(),
            Ok(LuminousExposure::from_lux_seconds(10_800.0))
        );
        assert_eq!(
            "1 lm·h".parse(),
            Ok(LuminousEnergy::from_lumen_seconds(3600.0))
        );
        for nit in [
            "1 cd/m2",
            "1cd/m²",
            "1 cd/m^2",
            "1 nit",
            "1 lm/m2/sr",
            "1 cd m⁻²",
        ] {
            assert_eq!(
                nit.parse(),
                Ok(Luminance::from_candelas_per_square_metre(1.0)),
                "{nit}"
            );
        }
    }

    #[test]
    fn a_lambertian_disc_of_a_thousand_lumens() {
        let exitance = LuminousExitance::from_flux(
            LuminousFlux::from_lumens(1000.0),
            Area::from_square_metres(0.5),
        );
        let luminance = Luminance::from_lambertian_exitance(exitance);
        assert_eq!(luminance.to_candelas_per_square_metre(), 2000.0 / PI);
        // π · (2000/π) is rounded twice.
        let back = LuminousExitance::from_lambertian_luminance(luminance) / exitance;
        assert!((back - 1.0).abs() <= f64::EPSILON);
    }
}
