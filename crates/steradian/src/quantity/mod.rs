//! Quantities with units: every number of light, space and time that enters or leaves Steradian.
//!
//! A quantity is a newtype over its SI value. It is made and read through functions that say the unit
//! ([`Flux::from_watts`], [`Angle::to_degrees`]), parsed from text that carries one (`"75 W/sr"`) and printed
//! with its SI unit. Two quantities add only if they are of the same kind, and multiply only if the product
//! has a name: those products, and the quotients that follow from them, are listed in the source of the
//! `laws` module and nowhere else.
//!
//! | radiant | symbol · unit | photometric | symbol · unit |
//! |---|---|---|---|
//! | [`Energy`] | Q · J | [`LuminousEnergy`] | Qᵥ · lm s |
//! | [`Flux`] | Φ · W | [`LuminousFlux`] | Φᵥ · lm |
//! | [`Irradiance`] | E · W/m² | [`Illuminance`] | Eᵥ · lx |
//! | [`ScalarIrradiance`] | E₀ · W/m² | — | |
//! | [`Exitance`] | M · W/m² | [`LuminousExitance`] | Mᵥ · lm/m² |
//! | [`RadiantExposure`] | H · J/m² | [`LuminousExposure`] | Hᵥ · lx s |
//! | [`Intensity`] | I · W/sr | [`LuminousIntensity`] | Iᵥ · cd |
//! | [`Radiance`] | L · W/(m² sr) | [`Luminance`] | Lᵥ · cd/m² |
//!
//! and of space and time [`Length`] (m), [`Area`] (m²), [`Angle`] (rad), [`SolidAngle`] and
//! [`ProjectedSolidAngle`] (sr), [`Time`] (s), [`AngularFrequency`] (rad/s), [`Temperature`] (K), [`Absorption`] (1/m). [`LuminousEfficacy`] (lm/W) leads from the left half to the right.
//!
//! Radiant quantities hold either one number (`Flux`, short for `Flux<f64>`) or one number a lane
//! (`Flux<Spectrum>`). Lanes are always radiant, so photometric quantities hold one number.
//!
//! ```
//! use steradian::quantity::{Area, Flux, Intensity, Irradiance, Length};
//!
//! let lamp: Intensity = "100 W/sr".parse()?;
//! let on_the_desk = lamp.normal_irradiance_at(Length::from_metres(2.0)); // E = I / r²
//! assert_eq!(on_the_desk, Irradiance::from_watts_per_square_metre(25.0));
//!
//! let caught: Flux = on_the_desk * "50 cm2".parse::<Area>()?;
//! assert_eq!(caught.to_string(), "0.125 W");
//! # Ok::<(), steradian::quantity::ParseQuantityError>(())
//! ```
//!
//! A sum of different kinds has no meaning and does not compile, not even when the units are equal:
//!
//! ```compile_fail,E0308
//! use steradian::quantity::{Exitance, Irradiance};
//! let arriving = Irradiance::from_watts_per_square_metre(1.0);
//! let leaving = Exitance::from_watts_per_square_metre(1.0);
//! let nonsense = arriving + leaving;
//! ```
//!
//! Nor does a product without a name:
//!
//! ```compile_fail,E0277
//! use steradian::quantity::{Flux, Radiance};
//! let nonsense = Flux::from_watts(1.0) * Radiance::from_watts_per_square_metre_steradian(1.0);
//! ```
//!
//! A plane sees a solid angle foreshortened, so radiance times a plain solid angle is no irradiance:
//!
//! ```compile_fail,E0308
//! use steradian::quantity::{Irradiance, Radiance, SolidAngle};
//! let sky = Radiance::from_watts_per_square_metre_steradian(1.0);
//! let irradiance: Irradiance = sky * SolidAngle::HEMISPHERE;
//! ```

mod absorption;
mod amount;
mod angle;
mod area;
mod define;
mod efficacy;
mod laws;
mod length;
mod parse;
mod photometric;
mod radiant;
mod spectrum;
mod temperature;
mod time;
mod unit;
mod value;

pub use absorption::Absorption;
pub use amount::Amount;
pub use angle::{Angle, ProjectedSolidAngle, SolidAngle};
pub use area::Area;
pub use efficacy::LuminousEfficacy;
pub use length::Length;
pub use parse::{Expected, ParseQuantityError};
pub use photometric::{
    Illuminance, Luminance, LuminousEnergy, LuminousExitance, LuminousExposure, LuminousFlux,
    LuminousIntensity,
};
pub use radiant::{
    Energy, Exitance, Flux, Intensity, Irradiance, Radiance, RadiantExposure, ScalarIrradiance,
};
pub use spectrum::Spectrum;
pub use temperature::Temperature;
pub use time::{AngularFrequency, Time};
pub use unit::{Unit, UnitTable};
pub use value::{Quantity, Value};
