//! Luminous efficacy of radiation, the way from watts to lumens.

use super::define::quantity;
use super::{Unit, UnitTable};

const LUMINOUS_EFFICACY: UnitTable = UnitTable {
    quantity: "luminous efficacy",
    si: "lm/W",
    example: "179 lm/W",
    units: &[Unit::new("lm/W", 1.0, 1.0)],
    allows_bare_numbers: false,
};

quantity! {
    /// Luminous efficacy of radiation K = Φᵥ/Φ, in lm/W.
    ///
    /// ```
    /// use steradian::quantity::{Illuminance, Irradiance, LuminousEfficacy};
    /// let sun = Irradiance::from_watts_per_square_metre(1000.0);
    /// assert_eq!(sun * LuminousEfficacy::RADIANCE_WHITE, Illuminance::from_lux(179_000.0));
    /// ```
    LuminousEfficacy, LUMINOUS_EFFICACY, from_lumens_per_watt, to_lumens_per_watt, "lumens per watt"
}

impl LuminousEfficacy {
    /// 683 lm/W: the efficacy at 540 THz, about 555 nm, which defines the candela (SI brochure, 9th ed., §2.3.1).
    pub const MAXIMUM: Self = Self(683.0);
    /// 179 lm/W: the efficacy that Radiance takes for white light between 380 and 780 nm (Larson & Shakespeare,
    /// *Rendering with Radiance*, 1998). The value a run takes if it is told no other.
    pub const RADIANCE_WHITE: Self = Self(179.0);
}
