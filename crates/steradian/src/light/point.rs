//! A point light: dΦ = I dω, so that E_n = I/r².
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | I | intensity | W/sr |
//! | Φ = 4πI | flux | W |
//! | r | distance | m |
//!
//! Source: the inverse-square law, e.g. CIE S 017:2020, 17-21-045 (intensity).

use super::{Density, Incident};
use crate::geometry::{Direction, Point};
use crate::quantity::{Flux, Intensity, Length, SolidAngle};
use crate::spectrum::MAX_LANES;

/// A point light.
#[derive(Clone, Debug)]
pub struct PointLight {
    /// Where.
    pub position: Point,
    /// I of each lane.
    pub intensity: [Intensity; MAX_LANES],
}

impl PointLight {
    /// Φ = 4πI of each lane.
    pub fn flux(&self) -> [Flux; MAX_LANES] {
        self.intensity
            .map(|intensity| intensity * SolidAngle::SPHERE)
    }

    pub(crate) fn incident(&self, point: Point) -> Option<Incident> {
        let towards = self.position - point;
        let distance = towards.length();
        Some(Incident {
            direction: Direction::new(towards).ok()?,
            distance,
            normal_irradiance: self
                .intensity
                .map(|i| i.normal_irradiance_at(Length::from_metres(distance))),
            density: Density::Delta,
        })
    }
}
