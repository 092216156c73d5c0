//! An author's numbers for the lanes.

use std::sync::Arc;

use super::Curve;

/// A number for each lane, as an author writes it.
#[derive(Clone, Debug, PartialEq)]
pub enum LaneValues {
    /// The same in every lane.
    Uniform(f64),
    /// Linear Rec.709 (in `rgb` and `spectral`).
    Rgb([f64; 3]),
    /// By band name (only in `broadband` mode).
    Bands(Vec<(String, f64)>),
    /// By wavelength (only in `spectral` mode).
    Curve {
        /// Reflectance, or the shape of an emission.
        curve: Arc<Curve>,
        /// The wavelengths in nm that a light's power in watts refers to.
        watts: [f64; 2],
    },
}

impl LaneValues {
    /// A reflectance, or an emission whose watts are those of its whole table.
    pub fn table(curve: Curve) -> Self {
        let watts = curve.range();
        Self::Curve {
            curve: Arc::new(curve),
            watts,
        }
    }
}
