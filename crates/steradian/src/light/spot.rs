//! A spot light: intensity I(θ) = I₀·f(θ) around an axis, E_n = I(θ)/r².
//!
//! | beam | f(θ) for θ ≤ cutoff | Φ/I₀ |
//! |---|---|---|
//! | uniform | 1 | 2π(1 − cos c) |
//! | cosine power | cosⁿθ | 2π(1 − cosⁿ⁺¹c)/(n + 1) |
//! | smooth | ((cosθ − cos c)/(cos a − cos c))², 1 within a | 2π[(1 − cos a) + (cos a − cos c)/3] |
//!
//! θ is the angle from the axis, c the cutoff and a the inner half angle. The smooth beam is that of the glTF extension
//! KHR_lights_punctual.

use std::f64::consts::TAU;

use super::{Density, Incident};
use crate::geometry::{Direction, Point};
use crate::quantity::{Flux, Intensity, Length, SolidAngle};
use crate::spectrum::MAX_LANES;

/// f(θ).
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum Beam {
    /// Constant.
    Uniform {
        /// cos c.
        cos_cutoff: f64,
    },
    /// cosⁿθ.
    CosinePower {
        /// n.
        exponent: f64,
        /// cos c, at least 0.
        cos_cutoff: f64,
    },
    /// Quadratic in cosθ between a and c.
    Smooth {
        /// cos a.
        cos_inner: f64,
        /// cos c.
        cos_cutoff: f64,
    },
}

impl Beam {
    /// f at the angle whose cosine is given.
    pub fn falloff(&self, cos_theta: f64) -> f64 {
        // The product of unit vectors may exceed 1 by rounding, which a cutoff of 180° would take for outside.
        let cos_theta = cos_theta.clamp(-1.0, 1.0);
        match *self {
            Self::Uniform { cos_cutoff } => f64::from(u8::from(cos_theta >= cos_cutoff)),
            Self::CosinePower { cos_cutoff, .. } if cos_theta < cos_cutoff => 0.0,
            Self::CosinePower { exponent, .. } => libm::pow(cos_theta.max(0.0), exponent),
            Self::Smooth {
                cos_inner,
                cos_cutoff,
            } => {
                let t = ((cos_theta - cos_cutoff) / (cos_inner - cos_cutoff)).clamp(0.0, 1.0);
                t * t
            }
        }
    }

    /// Φ/I₀ = ∫ f dω.
    pub fn solid_angle(&self) -> SolidAngle {
        let over_tau = match *self {
            Self::Uniform { cos_cutoff } => 1.0 - cos_cutoff,
            Self::CosinePower {
                exponent,
                cos_cutoff,
            } => (1.0 - libm::pow(cos_cutoff.max(0.0), exponent + 1.0)) / (exponent + 1.0),
            Self::Smooth {
                cos_inner,
                cos_cutoff,
            } => (1.0 - cos_inner) + (cos_inner - cos_cutoff) / 3.0,
        };
        SolidAngle::from_steradians(TAU * over_tau)
    }
}

/// A spot light.
#[derive(Clone, Debug)]
pub struct SpotLight {
    /// Where.
    pub position: Point,
    /// The axis.
    pub axis: Direction,
    /// The shape of the beam.
    pub beam: Beam,
    /// I₀ of each lane.
    pub peak_intensity: [Intensity; MAX_LANES],
}

impl SpotLight {
    /// Φ of each lane.
    pub fn flux(&self) -> [Flux; MAX_LANES] {
        self.peak_intensity
            .map(|intensity| intensity * self.beam.solid_angle())
    }

    pub(crate) fn incident(&self, point: Point) -> Option<Incident> {
        let towards = self.position - point;
        let distance = towards.length();
        let direction = Direction::new(towards).ok()?;
        let falloff = self.beam.falloff(-direction.dot(self.axis));
        (falloff > 0.0).then(|| Incident {
            direction,
            distance,
            normal_irradiance: self
                .peak_intensity
                .map(|i| (i * falloff).normal_irradiance_at(Length::from_metres(distance))),
            density: Density::Delta,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Midpoint rule in cosθ: error of a piecewise smooth f below (Δcos)·variation ≤ 1e-5 for 2e5 cells.
    #[test]
    fn beam_solid_angle_is_the_integral_of_the_falloff() {
        let beams = [
            Beam::Uniform { cos_cutoff: 0.5 },
            Beam::CosinePower {
                exponent: 3.5,
                cos_cutoff: 0.0,
            },
            Beam::CosinePower {
                exponent: 1.0,
                cos_cutoff: 0.3,
            },
            Beam::Smooth {
                cos_inner: 0.9,
                cos_cutoff: 0.7,
            },
        ];
        for beam in beams {
            let cells = 200_000;
            let sum: f64 = (0..cells)
                .map(|i| beam.falloff(-1.0 + 2.0 * (f64::from(i) + 0.5) / f64::from(cells)))
                .sum();
            let integral = TAU * sum * 2.0 / f64::from(cells);
            assert!(
                (integral - beam.solid_angle().to_steradians()).abs() < TAU * 1e-5,
                "{beam:?}"
            );
        }
    }
}
