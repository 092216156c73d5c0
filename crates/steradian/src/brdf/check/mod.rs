//! Whether a model keeps the contract of [`brdf`](super): reciprocity, energy, and a sampler that does what it says.
//!
//! | [`Check`] | law | what [`Finding::worst`] is | unit |
//! |---|---|---|---|
//! | `Values` | ρ, pdf, weights, shares ≥ 0 and finite | how many numbers are not | 1 |
//! | `Reciprocity` | ρ(a, b)/n_a² = ρ(b, a)/n_b² | largest relative difference | 1 |
//! | `Energy` | albedo + transmittance ≤ 1 | largest sum | 1 |
//! | `Agreement` | a sample's ρ and density are those of `evaluate` and `pdf` | largest relative difference | 1 |
//! | `Density` | ∫ pdf dω ≤ 1 | largest integral | 1 |
//! | `Sampling` | directions have the density pdf | χ² as standard deviations | 1 |
//! | `MeanWeight` | E[ρ \|cosθ_i\|/pdf] = albedo, transmittance | largest difference over what chance allows | 1 |
//! | `Furnace` | albedo + transmittance = 1 of a model without loss | largest difference from 1 | 1 |
//!
//! Checks by chance draw from [`Effort::seed`], so that an answer repeats bit for bit; a model that is right fails any of them with
//! the probability [`Effort::false_alarms`] at most, shared between the tests of a check after Z. Šidák, *Journal of the American
//! Statistical Association* 62 (1967) 626.
//!
//! ```
//! use steradian::brdf::check::{Effort, check};
//! use steradian::brdf::{Brdf, Lambertian};
//! use steradian::quantity::Spectrum;
//! let grey = Brdf::Lambertian(Lambertian { reflectance: Spectrum::splat(0.5) });
//! assert!(check(&grey, &Effort::QUICK).iter().all(|finding| finding.passed()));
//! // Paint that sends back more than it receives.
//! let wrong = Brdf::Lambertian(Lambertian { reflectance: Spectrum::splat(1.25) });
//! let findings = check(&wrong, &Effort::QUICK);
//! let failed: Vec<_> = findings.iter().filter(|finding| !finding.passed()).collect();
//! assert_eq!((failed.len(), failed[0].check.name(), failed[0].worst), (1, "energy", 1.25));
//! ```

mod chance;
mod density;
mod energy;
mod finding;
mod furnace;
mod sampling;
mod shares;
mod values;
mod views;
mod weights;

pub use energy::energy;
pub use finding::{Check, Finding, Place};
pub use furnace::{FURNACE_ANGLES, FURNACE_TOLERANCE, FurnaceRow, furnace, furnace_finding};
pub use sampling::sampling;
pub use shares::{albedo_error, hemispherical};
pub use values::{agreement, reciprocity, values};
pub use views::views;
pub use weights::{MeanWeight, mean_weight, mean_weights};

use super::Brdf;

/// How long checks look, and how rarely they may be wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Directions drawn for each view.
    pub samples: u32,
    /// Probability at most of each check by chance to refuse a model that is right.
    pub false_alarms: f64,
    /// Of the numbers drawn.
    pub seed: u64,
}

impl Effort {
    /// For tests: differences of some per cent are seen.
    pub const QUICK: Self = Self {
        samples: 1 << 12,
        false_alarms: 1e-6,
        seed: 1,
    };
    /// Differences of some tenths of a per cent are seen.
    pub const FULL: Self = Self {
        samples: 1 << 16,
        ..Self::QUICK
    };
}

/// Every check of one model.
pub fn check(model: &Brdf, effort: &Effort) -> Vec<Finding> {
    let [density, sampling] = sampling(model, effort);
    vec![
        values(model, effort),
        reciprocity(model, effort),
        energy(model),
        agreement(model, effort),
        density,
        sampling,
        mean_weight(model, effort),
    ]
}

#[cfg(test)]
mod tests;
