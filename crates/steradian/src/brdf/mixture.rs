//! Several models side by side on one surface, such as a mesh, a print or a dirty pane: each covers a share of the area.
//!
//! ρ = Σ w_k ρ_k, and so are albedo and transmittance; Σ w_k ≤ 1, and what is missing is black.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ρ_k | value of a part | 1/sr |
//! | w_k | share of the area that the part covers | 1 |
//!
//! A part is drawn with probability w_k/Σw; of finite parts the density is the mixture of all. Source: linearity of the
//! reflection integral; valid where the pattern is finer than what is resolved. Parts that transmit light must agree on the
//! change of index.
//!
//! ```
//! use steradian::brdf::{Brdf, Lambertian, Mirror, Mixture};
//! use steradian::geometry::Direction;
//! use steradian::quantity::Spectrum;
//! let paint = Brdf::Lambertian(Lambertian { reflectance: Spectrum::splat(0.5) });
//! let foil = Brdf::Mirror(Mirror { reflectance: Spectrum::splat(0.9) });
//! // .75 · .5 + .25 · .9
//! let flakes = Mixture::new(vec![(0.75, paint), (0.25, foil)])?;
//! assert!((flakes.albedo(Direction::Z).mean() - 0.6).abs() < 1e-6);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::sync::Arc;

use super::error::in_range;
use super::sampling::BELOW_ONE;
use super::{Brdf, ModelError, Scatter};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// Parts and their shares.
#[derive(Clone, Debug, PartialEq)]
pub struct Mixture {
    parts: Arc<[(f64, Brdf)]>,
    /// Σ w_k.
    covered: f64,
}

impl Mixture {
    /// From shares of the area and models.
    ///
    /// # Errors
    /// If a share lies outside 0 … 1, if they add up to more than 1, or if parts change the index by different ratios.
    pub fn new(parts: Vec<(f64, Brdf)>) -> Result<Self, ModelError> {
        for (weight, _) in &parts {
            in_range("weight", *weight, [0.0, 1.0])?;
        }
        let covered: f64 = parts.iter().map(|(weight, _)| weight).sum();
        if covered > 1.0 + 1e-9 {
            return Err(ModelError::GainsEnergy {
                parts: "weights",
                sum: covered,
            });
        }
        let mut indices = parts.iter().filter_map(|(_, model)| model.interior_index());
        if let Some(first) = indices.next()
            && let Some(other) = indices.find(|index| *index != first)
        {
            return Err(ModelError::DifferentIndices { first, other });
        }
        Ok(Self {
            parts: parts.into(),
            covered,
        })
    }

    /// The models with their shares.
    pub fn parts(&self) -> &[(f64, Brdf)] {
        &self.parts
    }

    /// Σ w_k ρ_k(d_e, d_i).
    pub fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        self.sum(|part| part.evaluate(wo, wi))
    }

    /// A direction of one part.
    pub fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let mut place = u[0] * self.covered;
        let (weight, part) = self.parts.iter().find(|(weight, _)| {
            let inside = place < *weight;
            if !inside {
                place -= weight;
            }
            inside
        })?;
        match part.sample(wo, [(place / weight).min(BELOW_ONE), u[1]])? {
            Scatter::Finite { wi, .. } => {
                Scatter::finite(wi, self.evaluate(wo, wi), self.pdf(wo, wi))
            }
            Scatter::Specular { wi, reflectance } => Some(Scatter::Specular {
                wi,
                reflectance: reflectance * self.covered,
            }),
        }
    }

    /// Σ w_k pdf_k/Σ w_k.
    pub fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let densities = self.parts.iter();
        let sum: f64 = densities
            .map(|(weight, part)| weight * part.pdf(wo, wi))
            .sum();
        if self.covered > 0.0 {
            sum / self.covered
        } else {
            0.0
        }
    }

    /// Σ w_k albedo_k.
    pub fn albedo(&self, wo: Direction) -> Spectrum {
        self.sum(|part| part.albedo(wo))
    }

    /// Σ w_k transmittance_k.
    pub fn transmittance(&self, wo: Direction) -> Spectrum {
        self.sum(|part| part.transmittance(wo))
    }

    /// The index inside over the index outside, if a part is an interface.
    pub(super) fn interior_index(&self) -> Option<f64> {
        let mut parts = self.parts.iter();
        parts.find_map(|(_, part)| part.interior_index())
    }

    fn sum(&self, value: impl Fn(&Brdf) -> Spectrum) -> Spectrum {
        let terms = self.parts.iter();
        terms.fold(Spectrum::ZERO, |sum, (weight, part)| {
            sum + value(part) * *weight
        })
    }
}
