//! The index of refraction of a conductor, η + iκ, a pair for each lane.
//!
//! Relative to the medium in front of the surface. η = 0 with κ > 0 reflects everything at any angle: the metal of a
//! white furnace.
//!
//! ```
//! use steradian::brdf::ComplexIndex;
//! let gold = ComplexIndex::new([0.15557; 4], [3.6024; 4])?;
//! assert!((gold.reflectance(1.0)[0] - 0.956_522).abs() < 1e-6);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use super::ModelError;
use super::error::{in_range, lanes_in_range};
use super::fresnel::{conductor, conductor_average};

/// η and κ of each lane.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct ComplexIndex {
    eta: [f64; 4],
    kappa: [f64; 4],
}

impl ComplexIndex {
    /// Reflects everything.
    pub const PERFECT: Self = Self {
        eta: [0.0; 4],
        kappa: [1.0; 4],
    };

    /// From η and κ of each lane.
    ///
    /// # Errors
    /// If a number lies outside 0 … 1000 or both are 0.
    pub fn new(eta: [f64; 4], kappa: [f64; 4]) -> Result<Self, ModelError> {
        lanes_in_range("eta", eta, [0.0, 1000.0])?;
        lanes_in_range("kappa", kappa, [0.0, 1000.0])?;
        for (n, k) in eta.into_iter().zip(kappa) {
            in_range("eta + kappa", n + k, [1e-6, 2000.0])?;
        }
        Ok(Self { eta, kappa })
    }

    /// η and κ.
    pub(super) const fn parts(&self) -> [[f64; 4]; 2] {
        [self.eta, self.kappa]
    }

    /// Reflectance of unpolarised light at this angle.
    pub fn reflectance(&self, cos_incident: f64) -> [f64; 4] {
        std::array::from_fn(|lane| conductor(cos_incident, self.eta[lane], self.kappa[lane]).mean())
    }

    /// Reflectance of light that comes evenly from everywhere.
    pub fn average_reflectance(&self) -> [f64; 4] {
        std::array::from_fn(|lane| conductor_average(self.eta[lane], self.kappa[lane]))
    }
}
