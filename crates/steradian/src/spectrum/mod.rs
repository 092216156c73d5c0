//! Spectra, and what the four lanes of a [`Spectrum`](crate::quantity::Spectrum) mean in a run.
//!
//! Transport multiplies and adds lanes and never asks what they stand for; [`Lanes`] is decided once per run and is
//! the only place that knows. In `rgb` the lanes are linear Rec.709 channels, in `broadband` one to four named bands.
//!
//! Everything that depends on wavelength is a [`Curve`]: [`Illuminant`], [`blackbody`], the [`Observer`]s, the
//! [`Action`] spectra. What is seen is an integral of products of curves:
//!
//! ```
//! use steradian::spectrum::{Action, Illuminant};
//!
//! // A high-pressure sodium lamp turns 58 % of the watt's 683 lm into light.
//! let (lamp, visible) = (Illuminant::Hp1.curve(), [380.0, 780.0]);
//! let efficacy = |action: Action| lamp.product_integral(action.weight(), visible) / lamp.integral(visible);
//! assert!((efficacy(Action::Photopic) - 394.5).abs() < 1.0);
//! ```

mod blackbody;
mod colour;
mod curve;
mod glass;
mod illuminant;
mod lanes;
mod metal;
mod observer;
mod photon;
mod response;
mod tables;
mod upsampling;
mod upsampling_table;
mod values;
mod wavelengths;

pub use blackbody::{blackbody, blackbody_radiance};
pub use colour::{Matrix, apply, chromaticity, rgb_curves, rgb_from_xyz, xyz_from_rgb, xyz_of};
pub use curve::{Beyond, Curve, CurveError};
pub use glass::Glass;
pub use illuminant::{Illuminant, daylight};
pub use lanes::{Channel, LaneCurve, LaneError, Lanes, MAX_LANES, RADIANT, REC709_LUMINANCE};
pub use metal::Metal;
pub use observer::{Observer, photopic, scotopic};
pub use photon::photon_energy;
pub use response::{Action, MELANOPIC_EFFICACY_OF_D65, PHOTOPIC_EFFICACY, SCOTOPIC_EFFICACY};
pub use upsampling::{Sigmoid, sigmoid_at};
pub use upsampling_table::UpsamplingTable;
pub use values::LaneValues;
pub use wavelengths::{BakedCurve, Grid, WavelengthDensity, Wavelengths};

/// What the eye sees, in nm; the range of a spectral run unless stated, and that to which watts without a table refer.
pub const VISIBLE: [f64; 2] = [360.0, 830.0];

/// A curve of a scene, by number.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub struct CurveId(pub u32);
