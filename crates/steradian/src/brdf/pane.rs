//! A thin pane: two parallel interfaces and the absorbing glass between them, seen as one surface.
//!
//! For each polarisation, with r the reflectance of one interface and τ the transmittance of one passage, the bounces
//! between the faces sum to
//!
//! T = (1 − r)² τ/(1 − r² τ²),  R = r (1 + τ T),  τ = τ₀^(1/cosθ_t),
//!
//! and for unpolarised light to the mean of the two polarisations, taken after the sum.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | r | Fresnel reflectance at η, for s or p | 1 |
//! | τ₀, τ | internal transmittance along the normal and along the ray, a number a lane | 1 |
//! | θ_t | angle inside the glass | rad |
//! | R, T | reflectance and transmittance of the pane | 1 |
//!
//! Light goes straight through, displaced by nothing, so that next-event rays may pass. Sampling takes the mirrored or
//! the straight direction with the probability of its share of the mean over lanes: the weight is at most the number of
//! lanes. Source: M. Rubin, Solar Energy Materials 12 (1985) 275; ISO 9050. Valid if the glass is thick against
//! the coherence length (no interference colours) and thin against the scene.
//!
//! ```
//! use steradian::brdf::Pane;
//! use steradian::geometry::Direction;
//! // Clear: T = (1 − r)/(1 + r) with r = .04.
//! let pane = Pane::new(1.5, [1.0; 4])?;
//! assert!((pane.transmittance(Direction::Z).mean() - 0.96 / 1.04).abs() < 1e-6);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use super::error::{in_range, lanes_in_range};
use super::fresnel::{dielectric, refracted_cosine};
use super::{ModelError, Scatter, to_spectrum};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// A thin pane of glass.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Pane {
    eta: f64,
    internal_transmittance: [f64; 4],
}

impl Pane {
    /// From the index of the glass and what one passage along the normal lets through.
    ///
    /// # Errors
    /// If the index lies outside 1 … 10 or a transmittance outside 0 … 1.
    pub fn new(eta: f64, internal_transmittance: [f64; 4]) -> Result<Self, ModelError> {
        let range = [0.0, 1.0];
        Ok(Self {
            eta: in_range("eta", eta, [1.0, 10.0])?,
            internal_transmittance: lanes_in_range(
                "internal transmittance",
                internal_transmittance,
                range,
            )?,
        })
    }

    /// (R, T) of each lane for light at this angle, the same from both sides.
    pub fn shares(&self, cos_incident: f64) -> [(f64, f64); 4] {
        let Some(cos_inside) = refracted_cosine(cos_incident, self.eta) else {
            return [(1.0, 0.0); 4];
        };
        let interface = dielectric(cos_incident, self.eta);
        self.internal_transmittance.map(|normal| {
            let passage = libm::pow(normal, 1.0 / cos_inside);
            let (rs, ts) = bounces(interface.s, passage);
            let (rp, tp) = bounces(interface.p, passage);
            (0.5 * (rs + rp), 0.5 * (ts + tp))
        })
    }

    /// The mirrored or the straight direction.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let (reflected, transmitted) = (self.albedo(wo), self.transmittance(wo));
        let both = reflected.mean() + transmitted.mean();
        if wo.z() == 0.0 || both <= 0.0 {
            return None;
        }
        let share = f64::from(reflected.mean() / both);
        let (wi, reflectance) = if u[0] < share {
            (Direction::Z.mirror(wo), reflected / share)
        } else {
            (-wo, transmitted / (1.0 - share))
        };
        Some(Scatter::Specular { wi, reflectance })
    }

    /// R(θ).
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        to_spectrum(self.shares(wo.z().abs()).map(|(reflected, _)| reflected))
    }

    /// T(θ).
    pub fn transmittance(&self, wo: Direction) -> Spectrum {
        to_spectrum(
            self.shares(wo.z().abs())
                .map(|(_, transmitted)| transmitted),
        )
    }
}

/// (R, T) of all bounces of one polarisation.
fn bounces(interface: f64, passage: f64) -> (f64, f64) {
    if interface >= 1.0 {
        return (1.0, 0.0);
    }
    let once = 1.0 - interface;
    let round = interface * passage;
    let transmitted = once * once * passage / (1.0 - round * round);
    (interface * (1.0 + passage * transmitted), transmitted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::tests::cases::{assert_case, cases_of};

    #[test]
    fn panes_agree_with_the_reference_cases() {
        for case in cases_of("glass_pane", 6) {
            let transmittance = case.number("internal_transmittance_normal");
            let pane = Pane::new(case.number("eta"), [transmittance; 4]).unwrap();
            let (reflected, transmitted) =
                pane.shares(libm::cos(case.number("theta_i_deg").to_radians()))[0];
            assert_case(&case, "reflectance", reflected, 1e-12);
            assert_case(&case, "transmittance", transmitted, 1e-12);
            assert_case(&case, "absorptance", 1.0 - reflected - transmitted, 1e-12);
        }
    }

    #[test]
    fn a_black_pane_still_reflects_at_its_first_face() {
        let pane = Pane::new(1.5, [0.0; 4]).unwrap();
        let (reflected, transmitted) = pane.shares(1.0)[0];
        assert!((reflected - 0.04).abs() < 1e-15 && transmitted == 0.0);
    }
}
