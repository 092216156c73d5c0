//! Photons: the energy of light comes in parts of h ν.
//!
//! ```text
//! E = h c / λ ,   N = Q / E = Q λ / (h c)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E | energy of one photon | J |
//! | λ | wavelength in vacuum | m |
//! | Q, N | energy of monochromatic light, number of its photons | J, 1 |
//! | h, c | constants of Planck and of light, exact since 2019 | J s, m/s |
//!
//! Source: A. Einstein, Ann. Phys. 322 (1905) 132–148. Light of many wavelengths is counted by the response `par`, whose
//! weight is λ/(N_A h c).

use super::blackbody::{LIGHT_SPEED, PLANCK};
use crate::quantity::{Energy, Length};

/// E = h c / λ: the energy of a photon of this wavelength in vacuum.
///
/// ```
/// use steradian::quantity::{Energy, Length};
/// use steradian::spectrum::photon_energy;
///
/// // 6.626e-34 × 2.998e8 / 555e-9 = 3.58e-19 J: a joule of green light has 2.79e18 photons.
/// let photons = Energy::from_joules(1.0) / photon_energy(Length::from_nanometres(555.0));
/// assert!((photons / 2.793_934_694_986_203_6e18 - 1.0).abs() < 1e-15);
/// ```
pub fn photon_energy(wavelength: Length) -> Energy {
    Energy::from_joules(PLANCK * LIGHT_SPEED / wavelength.to_metres())
}
