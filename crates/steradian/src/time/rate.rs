//! Quantities that flow, and what they add up to.

use std::ops::{Div, Mul};

use super::Interval;
use crate::quantity::{
    Energy, Flux, Illuminance, Irradiance, LuminousEnergy, LuminousExposure, LuminousFlux,
    Quantity, RadiantExposure, Time,
};

/// A quantity whose integral over time has a name.
pub trait Rate: Quantity + Mul<Time, Output = Self::Total> {
    /// Its integral over time.
    type Total: Quantity + Div<Time, Output = Self>;
}

impl Rate for Flux {
    type Total = Energy;
}

impl Rate for Irradiance {
    type Total = RadiantExposure;
}

impl Rate for LuminousFlux {
    type Total = LuminousEnergy;
}

impl Rate for Illuminance {
    type Total = LuminousExposure;
}

/// What a rate did in an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary<R: Rate> {
    /// When.
    pub interval: Interval,
    /// Its integral.
    pub total: R::Total,
    /// The integral divided by the duration.
    pub mean: R,
    /// The least that it was.
    pub least: R,
    /// The greatest that it was.
    pub greatest: R,
}

impl<R: Rate> Summary<R> {
    pub(super) fn new(interval: Interval, total: R::Total, [least, greatest]: [R; 2]) -> Self {
        Self {
            interval,
            total,
            mean: total / interval.duration(),
            least,
            greatest,
        }
    }
}
