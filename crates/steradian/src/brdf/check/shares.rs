//! Shares of light from everywhere, and how well shares are known.

use std::f64::consts::TAU;

use super::energy::SHARE_ERROR;
use crate::brdf::Brdf;
use crate::geometry::{Direction, gauss};
use crate::quantity::Spectrum;

/// Panels for closed forms, which have a root at the angle of total reflection, and for shares that are quadratures themselves.
const PANELS: [u32; 2] = [256, 4];
const AZIMUTHS: u32 = 4;

/// Directions for which a model's shares are no closed form: how far off they may be. `None` where they are rounded only.
pub const fn albedo_error(model: &Brdf) -> Option<f64> {
    match model {
        Brdf::Lambertian(_)
        | Brdf::Mirror(_)
        | Brdf::OrenNayar(_)
        | Brdf::EnergyPreservingOrenNayar(_)
        | Brdf::DiffuseTransmission(_)
        | Brdf::SmoothConductor(_)
        | Brdf::SmoothDielectric(_)
        | Brdf::Pane(_) => None,
        Brdf::Phong(_) => Some(2e-4),
        _ => Some(SHARE_ERROR),
    }
}

/// Bihemispherical shares: what is reflected and transmitted of light that comes evenly from all of one side.
///
/// (1/π) ∫ albedo cosθ dω, by Gauss's rule of order 16 in panels of √cosθ and the midpoint rule in azimuth.
///
/// ```
/// use steradian::brdf::check::hemispherical;
/// use steradian::brdf::{Brdf, SmoothDielectric};
/// let glass = Brdf::SmoothDielectric(SmoothDielectric::new(1.5)?);
/// let [reflected, _] = hemispherical(&glass, false);
/// assert!((reflected.mean() - 0.091_778).abs() < 1e-6);
/// # Ok::<(), steradian::brdf::ModelError>(())
/// ```
pub fn hemispherical(model: &Brdf, below: bool) -> [Spectrum; 2] {
    let mut sums = [0.0; 2 * Spectrum::LANES];
    let panels = PANELS[usize::from(albedo_error(model).is_some())];
    for panel in 0..panels {
        for &(node, weight) in gauss::rule(gauss::MAX_ORDER) {
            let root = (f64::from(panel) + 0.5 * (1.0 + node)) / f64::from(panels);
            let cos = root * root;
            let share = 2.0 * weight / f64::from(panels * AZIMUTHS) * cos * root;
            for k in 0..AZIMUTHS {
                let phi = TAU * (f64::from(k) + 0.5) / f64::from(AZIMUTHS);
                let above = Direction::from_polar((1.0 - cos * cos).sqrt(), cos, phi);
                let wo = if below { -above } else { above };
                let lanes = [model.albedo(wo), model.transmittance(wo)].map(Spectrum::to_lanes);
                for (sum, lane) in sums.iter_mut().zip(lanes.as_flattened()) {
                    *sum += share * f64::from(*lane);
                }
            }
        }
    }
    let [a, b, c, d, e, f, g, h] = sums.map(|sum| sum as f32);
    [[a, b, c, d], [e, f, g, h]].map(Spectrum::from_lanes)
}
